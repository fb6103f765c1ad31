// Shared objects made from emitted text.
#include "driver/shared_object.hpp"

#include "driver/process.hpp"
#include "support/diagnostic.hpp"

#include <rddl/simulator.h>

#include <dlfcn.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace rddlc {
namespace {

namespace fs = std::filesystem;

const fs::path network = fs::path(RDDLC_SOURCE_FOLDER) / "generated" / "network.cpp";

class SharedObject : public testing::Test {
  protected:
    void SetUp() override {
        std::string pattern = (fs::temp_directory_path() / "rddlc-object-XXXXXX").string();
        ASSERT_NE(mkdtemp(pattern.data()), nullptr);
        folder_ = pattern;
    }
    void TearDown() override { fs::remove_all(folder_); }

    bool builds(const fs::path& object, const fs::path& batches) {
        Diagnostics diagnostics;
        return build_shared_object(network, object, Processors::LikeThis, {}, diagnostics, batches);
    }

    fs::path folder_;
};

// The states of 40 environments after 30 steps.
std::vector<std::uint8_t> states_of(const fs::path& object) {
    void* const library = ::dlopen(object.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (!library) return {};
    const auto entry =
        reinterpret_cast<rddl_simulator_entry_function>(::dlsym(library, "rddl_simulator_entry"));
    const rddl_simulator& simulator = *entry();
    rddl_batch_options options{};
    options.environment_count = 40;
    options.seed = 7;
    rddl_batch* const batch = simulator.create(&simulator, &options);
    std::vector<std::uint8_t> actions(40 * simulator.problem->action_size);
    const rddl_transition nothing{};
    for (int i = 0; i < 30; ++i) simulator.step(batch, actions.data(), &nothing);
    std::vector<std::uint8_t> states(40 * simulator.problem->state_size);
    simulator.get_state(batch, 0, 40, states.data());
    simulator.destroy(batch);
    ::dlclose(library);
    return states;
}

TEST_F(SharedObject, is_the_same_whether_batches_are_linked_or_compiled) {
    const fs::path batches = folder_ / "batches.o";
    const auto made = run_process(batches_command(batches));
    ASSERT_TRUE(made && made->status == 0) << (made ? made->output : "no C++ compiler");
    ASSERT_TRUE(builds(folder_ / "linked.so", batches));

    // What is no object cannot be linked.
    const fs::path damaged = folder_ / "damaged.o";
    std::ofstream(damaged) << "no object";
    ASSERT_TRUE(builds(folder_ / "whole.so", damaged));

    const auto states = states_of(folder_ / "linked.so");
    EXPECT_FALSE(states.empty());
    EXPECT_EQ(states, states_of(folder_ / "whole.so"));
}

}  // namespace
}  // namespace rddlc
