// How programs end that met a mistake of ours.
#include "support/program.hpp"

#include "support/failure.hpp"

#include <gtest/gtest.h>

#include <thread>

namespace rddlc {
namespace {

TEST(InternalErrorDeathTest, SaysWhatAndWhereAndEndsWith70) {
    const auto fail = []() -> ExitStatus {
        own_mistake("a row is missing");
    };
    EXPECT_EXIT(
        std::exit(run_program("rddlc", "1.0", fail)), ::testing::ExitedWithCode(70),
        "rddlc: internal error: a row is missing .*program_test.cpp:[0-9]+, .*please report");
}

TEST(InternalErrorDeathTest, InAThreadDoesSo) {
    const auto fail = []() -> ExitStatus {
        std::thread([] { own_mistake("a row is missing"); }).join();
        return success;
    };
    EXPECT_EXIT(std::exit(run_program("rddlc", "1.0", fail)), ::testing::ExitedWithCode(70),
                "rddlc: internal error: a row is missing .*program_test.cpp:[0-9]+");
}

}  // namespace
}  // namespace rddlc
