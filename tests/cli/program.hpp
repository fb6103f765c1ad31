// The rddl program as a user runs it, in a folder of its own with a small problem. All tests share
// compiled code, except those of the cache.
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace rddlc::cli {

inline std::string read_file(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

inline void write_file(const std::filesystem::path& path, std::string_view text) {
    std::filesystem::create_directories(path.parent_path());
    std::ofstream(path, std::ios::binary) << text;
}

// Tanks that leak at random; a pump fills one of them.
inline constexpr const char* tanks_domain = R"(domain tanks {
    types { tank : object; setting : { @low, @high }; };
    pvariables {
        LEAK(tank) : { non-fluent, real, default = 0.5 };
        water(tank) : { state-fluent, real, default = 5.0 };
        pumped : { state-fluent, int, default = 0 };
        last : { state-fluent, setting, default = @low };
        pump(tank) : { action-fluent, bool, default = false };
        power : { action-fluent, setting, default = @low };
        extra : { action-fluent, real, default = 0.0 };
    };
    cpfs {
        water'(?t) = water(?t) - Exponential(LEAK(?t)) + (if (pump(?t)) then 2.0 else 0.0);
        pumped' = pumped + (sum_{?t : tank} pump(?t));
        last' = power;
    };
    reward = (sum_{?t : tank} water(?t)) + Normal(0.0, 2.0 + extra);
    termination { exists_{?t : tank} [water(?t) < 0.0]; };
    action-preconditions { forall_{?t : tank} [pump(?t) => water(?t) <= 8.0]; extra <= 1.0; extra >= -2.0; };
}
)";
inline constexpr const char* tanks_instance = R"(
non-fluents more { domain = tanks; objects { tank : { t1, t2, t3 }; }; non-fluents { LEAK(t2) = 0.25; }; }
instance tanks_1 { domain = tanks; non-fluents = more; max-nondef-actions = 2; horizon = 12; discount = 0.9; }
)";

struct Outcome {
    int status = -1;
    std::string out, err;
};

// Options that most tests add: no C++ compiler is needed.
inline constexpr const char* interpreted = " --engine interpreter";

inline void expect_part(const std::string& text, const std::string& part) {
    EXPECT_NE(text.find(part), std::string::npos) << part << "\n--- not in\n" << text;
}

inline nlohmann::json without_speed(nlohmann::json summary) {
    for (const char* member : {"seconds", "steps_per_second", "threads", "engine"})
        summary.erase(member);
    return summary;
}

// Every episode ends with a fault in its first step that may fault; with a chance of 0 no episode
// does.
inline std::string faulty_problem(const std::string& chance) {
    return "domain faulty { pvariables { bad : { state-fluent, bool, default = false }; };\n"
           "  cpfs { bad' = Bernoulli(if (bad) then 1.5 else " +
           chance +
           "); }; reward = 0; }\n"
           "non-fluents n { domain = faulty; }\n"
           "instance i { domain = faulty; non-fluents = n; horizon = 3; discount = 1.0; }\n";
}

class Program : public testing::Test {
  protected:
    Program() {
        const auto* const info = testing::UnitTest::GetInstance()->current_test_info();
        folder_ = std::filesystem::path(testing::TempDir()) /
                  fmt::format("rddl-{}-{}", info->test_suite_name(), info->name());
        std::filesystem::remove_all(folder_);
        write_file(folder_ / "domain.rddl", tanks_domain);
        write_file(folder_ / "instance.rddl", tanks_instance);
    }
    ~Program() override { std::filesystem::remove_all(folder_); }

    // The command line behind `environment` (such as "CXX=x "), as the shell reads it.
    std::string command(const std::string& arguments, const std::string& environment = "") const {
        return fmt::format(
            "cd '{0}' && env -u VIRTUAL_ENV -u RDDL_REPOSITORY XDG_CACHE_HOME='{1}' {2} '{3}' {4}",
            folder_.string(), cache().string(), environment, RDDL_PROGRAM, arguments);
    }
    Outcome run(const std::string& arguments, const std::string& environment = "") const {
        const std::filesystem::path out = folder_ / "stdout";
        const std::string all = fmt::format("{} >'{}' 2>'{}'", command(arguments, environment),
                                            out.string(), stderr_file());
        const int status = std::system(all.c_str());
        return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, read_file(out),
                read_file(stderr_file())};
    }
    nlohmann::json run_json(const std::string& arguments, int status = 0) const {
        const Outcome outcome = run(arguments);
        EXPECT_EQ(outcome.status, status) << outcome.err;
        return nlohmann::json::parse(outcome.out);
    }
    std::string stderr_file() const { return (folder_ / "stderr").string(); }
    const std::filesystem::path& cache() const { return cache_; }
    void use_own_cache() { cache_ = folder_ / "cache"; }

    std::filesystem::path folder_;
    std::filesystem::path cache_ = RDDL_TEST_CACHE;
};

}  // namespace rddlc::cli
