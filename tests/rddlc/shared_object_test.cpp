// Shared objects made from emitted text.
#include "driver/shared_object.hpp"

#include "driver/cpp_compiler.hpp"
#include "driver/process.hpp"
#include "support/diagnostic.hpp"

#include <rddl/lanes/processor.hpp>
#include <rddl/simulator.h>

#include <dlfcn.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace rddlc {
namespace {

namespace fs = std::filesystem;

const fs::path network = fs::path(RDDLC_SOURCE_FOLDER) / "generated" / "network.cpp";

class SharedObject : public ::testing::Test {
  protected:
    void SetUp() override {
        std::string pattern = (fs::temp_directory_path() / "rddlc-object-XXXXXX").string();
        ASSERT_NE(mkdtemp(pattern.data()), nullptr);
        folder_ = pattern;
    }
    void TearDown() override {
        if (!usual_compiler_.empty()) ::setenv("CXX", usual_compiler_.c_str(), 1);
        fs::remove_all(folder_);
    }

    // For tests of which files are compiled. It takes a third of the time of -O3.
    void compile_with_little_optimisation() {
        usual_compiler_ = fmt::format("{}", fmt::join(cpp_compiler(), " "));
        const fs::path compiler = folder_ / "quick-cc";
        std::ofstream(compiler) << "#!/bin/sh\nexec " << usual_compiler_ << " \"$@\" -O0\n";
        fs::permissions(compiler, fs::perms::owner_all);
        ::setenv("CXX", compiler.c_str(), 1);
    }

    bool builds(const fs::path& object, const std::optional<fs::path>& prepared = {}) {
        Diagnostics diagnostics;
        return build_shared_object(network, object, Processors::LikeThis, {}, diagnostics,
                                   prepared);
    }
    bool builds_for_any(const fs::path& object) {
        Diagnostics diagnostics;
        return build_shared_object(network, object, Processors::Any, {}, diagnostics);
    }

    fs::path folder_;

  private:
    std::string usual_compiler_;  // where another one is set
};

// A compiler that does not know an option of GCC's is asked, and spared it.
TEST_F(SharedObject, passes_no_flag_that_the_compiler_does_not_take) {
    const fs::path compiler = folder_ / "cc";
    std::ofstream(compiler) << "#!/bin/sh\n"
                               "for word; do\n"
                               "    test \"$word\" = -fno-gcse || continue\n"
                               "    echo unknown option $word >&2; exit 1\n"
                               "done\n"
                               "exec c++ \"$@\"\n";
    fs::permissions(compiler, fs::perms::owner_all);
    const std::vector<std::string> some = simulator_flags({compiler.string()});
    const std::vector<std::string> all = simulator_flags({folder_ / "no-compiler"});
    EXPECT_TRUE(std::ranges::count(all, "-fno-gcse"));
    EXPECT_FALSE(std::ranges::count(some, "-fno-gcse"));
    EXPECT_LE(some.size(), all.size() - 1);
}

struct Behaviour {
    std::string instruction_set;
    std::vector<std::uint8_t> states;  // of 40 environments after 30 steps
};

Behaviour behaviour_of(const fs::path& object, int lanes = 0) {
    void* const library = ::dlopen(object.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (!library) return {};
    const auto entry =
        reinterpret_cast<rddl_simulator_entry_function>(::dlsym(library, "rddl_simulator_entry"));
    const rddl_simulator& simulator = *entry();
    rddl_batch_options options{};
    options.environment_count = 40;
    options.seed = 7;
    options.lane_count = lanes;
    rddl_batch* const batch = simulator.create(&simulator, &options);
    std::vector<std::uint8_t> actions(40 * simulator.problem->action_size);
    const rddl_transition nothing{};
    for (int i = 0; i < 30; ++i) simulator.step(batch, actions.data(), &nothing);
    Behaviour behaviour{simulator.instruction_set, {}};
    behaviour.states.resize(40 * simulator.problem->state_size);
    simulator.get_state(batch, 0, 40, behaviour.states.data());
    simulator.destroy(batch);
    ::dlclose(library);
    return behaviour;
}

TEST_F(SharedObject, is_the_same_with_and_without_what_is_prepared) {
    compile_with_little_optimisation();
    ASSERT_TRUE(prepare_runtime(folder_, RealType::Double));
    const fs::path header = folder_ / "simulator.hpp.gch";
    EXPECT_TRUE(fs::exists(header));
    ASSERT_TRUE(builds(folder_ / "prepared.so", folder_));
    EXPECT_TRUE(fs::exists(header));

    // Neither is one: the header is not tried again, and batches are compiled.
    fs::resize_file(header, fs::file_size(header) / 2);
    ASSERT_TRUE(builds(folder_ / "linked.so", folder_));
    EXPECT_FALSE(fs::exists(header));
    std::ofstream(folder_ / "batches.o") << "no object";
    ASSERT_TRUE(builds(folder_ / "damaged.so", folder_));
    ASSERT_TRUE(builds(folder_ / "whole.so"));

    const auto states = behaviour_of(folder_ / "whole.so").states;
    EXPECT_FALSE(states.empty());
    for (const char* name : {"prepared.so", "linked.so", "damaged.so"})
        EXPECT_EQ(behaviour_of(folder_ / name).states, states) << name;
}

#ifdef __x86_64__

void expect_same_bytes_on_each_instruction_set(const fs::path& object) {
    const Behaviour best = behaviour_of(object);
    const struct {
        rddl::InstructionSet set;
        const char *variable, *name;
    } sets[] = {{rddl::InstructionSet::Sse2, "sse2", "SSE2"},
                {rddl::InstructionSet::Avx2, "avx2", "AVX2"},
                {rddl::InstructionSet::Avx512, "avx512", "AVX-512"}};
    for (const auto& [set, variable, name] : sets) {
        if (set > rddl::processor_instruction_set()) continue;
        ::setenv("RDDL_INSTRUCTION_SET", variable, 1);
        const Behaviour behaviour = behaviour_of(object), single = behaviour_of(object, 1);
        ::unsetenv("RDDL_INSTRUCTION_SET");
        EXPECT_EQ(behaviour.instruction_set, name);
        EXPECT_EQ(behaviour.states, best.states) << name;
        EXPECT_EQ(single.states, best.states) << name;
    }
}

// The lines that a program prints; empty if it fails.
std::vector<std::string> lines_of(const std::vector<std::string>& command) {
    const auto result = run_process(command);
    std::vector<std::string> lines;
    if (!result || result->status != 0) return lines;
    std::istringstream stream(result->output);
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    return lines;
}

// Functions that are in the objects of several instruction sets come from the lowest: they must run
// wherever the simulator for SSE2 does.
void expect_shared_functions_of_the_lowest_set(const fs::path& object, const fs::path& lowest) {
    auto command = shared_object_command(network, lowest, Processors::Any);
    std::ranges::replace(command, "-shared", "-c");
    const auto compiled = run_process(command);
    ASSERT_TRUE(compiled && compiled->status == 0);

    std::set<std::string> shared = {"rddl_simulator_entry"};
    for (const std::string& line : lines_of({"nm", lowest.string()})) {
        std::istringstream words(line);
        std::string address, kind, name;
        words >> address >> kind >> name;
        if (kind == "W") shared.insert(name);  // which the linker may merge
    }
    ASSERT_GT(shared.size(), 1u);

    std::string function;
    int instructions = 0;
    for (const std::string& line :
         lines_of({"objdump", "-d", "--no-show-raw-insn", object.string()})) {
        const std::size_t name = line.find('<');
        if (line.ends_with(">:") && name != std::string::npos)
            function = line.substr(name + 1, line.size() - name - 3);
        std::istringstream words(line);
        std::string address, mnemonic;
        words >> address >> mnemonic;
        if (!shared.contains(function) || line.empty() || line[0] != ' ') continue;
        ++instructions;
        EXPECT_FALSE(mnemonic.starts_with("v")) << function << line;
    }
    EXPECT_GT(instructions, 100);
}

// Both in one test: compiling for each instruction set takes nearly all the time.
TEST_F(SharedObject, for_any_processor_has_the_same_bytes_on_each_instruction_set) {
    const fs::path object = folder_ / "any.so";
    ASSERT_TRUE(builds_for_any(object));
    expect_same_bytes_on_each_instruction_set(object);
    expect_shared_functions_of_the_lowest_set(object, folder_ / "lowest.o");
}

#endif

}  // namespace
}  // namespace rddlc
