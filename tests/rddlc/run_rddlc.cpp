#include "run_rddlc.hpp"

#include "driver/process.hpp"

#include <stdlib.h>

#include <algorithm>
#include <fstream>
#include <stdexcept>

namespace rddlc::testing {
namespace {

namespace fs = std::filesystem;

constexpr const char* domain = R"(domain lamp {
    types { lamp : object; };
    pvariables {
        on(lamp) : { state-fluent, bool, default = false };
        press(lamp) : { action-fluent, bool, default = false };
    };
    cpfs { on'(?l) = if (press(?l)) then ~on(?l) else on(?l); };
    reward = sum_{?l : lamp} on(?l);
}
)";

constexpr const char* instance = R"(non-fluents n { domain = lamp; objects { lamp : {l1, l2}; }; }
instance two { domain = lamp; non-fluents = n; horizon = 5; discount = 1.0; }
)";

}  // namespace

RddlcTest::RddlcTest() : before_(fs::current_path()) {
    std::string pattern = fs::temp_directory_path() / "rddlc-test-XXXXXX";
    if (!::mkdtemp(pattern.data())) throw std::runtime_error("no temporary folder");
    folder_ = pattern;
    fs::current_path(folder_);
    write("domain.rddl", domain);
    write("instance.rddl", instance);
}

RddlcTest::~RddlcTest() {
    std::error_code ignored;
    fs::current_path(before_, ignored);
    fs::permissions(folder_, fs::perms::owner_all, ignored);
    fs::remove_all(folder_, ignored);
}

Result RddlcTest::rddlc(const std::vector<std::string>& arguments) const {
    return rddlc_with({}, arguments);
}

Result RddlcTest::rddlc_with(const std::vector<std::string>& environment,
                             const std::vector<std::string>& arguments) const {
    std::vector<std::string> command = {"env"};
    command.insert(command.end(), environment.begin(), environment.end());
    command.push_back(RDDLC_PROGRAM);
    command.insert(command.end(), arguments.begin(), arguments.end());
    const auto result = run_process(command);
    return result ? Result{result->status, result->output} : Result{-1, "rddlc does not start"};
}

void RddlcTest::write(const fs::path& file, const std::string& text) {
    std::ofstream(file, std::ios::binary) << text;
}

std::string RddlcTest::read(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

std::vector<std::string> RddlcTest::files() {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(".")) {
        names.push_back(entry.path().filename().string());
    }
    std::ranges::sort(names);
    return names;
}

}  // namespace rddlc::testing
