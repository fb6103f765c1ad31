#include "support/option_names.hpp"

#include "support/number_word.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <limits>

namespace rddlc::testing {
namespace {

const std::vector<KnownOption> known = {{"--lr", {"learning_rate"}},
                                        {"--envs", {"environments", "n_envs", "num_envs"}},
                                        {"--minibatch", {"batch_size"}},
                                        {"-o", {}}};

TEST(OptionNames, OfOtherFacesAndProgramsMeanAnOption) {
    EXPECT_EQ(option_meant("--learning-rate", known), "--lr");
    EXPECT_EQ(option_meant("learning_rate", known), "--lr");
    EXPECT_EQ(option_meant("lr", known), "--lr");
    EXPECT_EQ(option_meant("--n-envs", known), "--envs");
    EXPECT_EQ(option_meant("--batch_size", known), "--minibatch");
}

TEST(OptionNames, ThatAreMisspeltMeanTheNearest) {
    EXPECT_EQ(option_meant("--minibach", known), "--minibatch");
    EXPECT_EQ(option_meant("num_env", known), "--envs");
    EXPECT_EQ(option_meant_text("--bach-size", known), "; did you mean '--minibatch'?");
}

TEST(OptionNames, OfNothingMeanNothing) {
    for (const char* const name : {"", "-", "--", "zebra", "\xff"})
        EXPECT_EQ(option_meant(name, known), std::nullopt) << name;
    EXPECT_EQ(option_meant_text("zebra", known), "");
}

TEST(NumberWords, OfIntsThatAreTooLargeTheBoundIsSaid) {
    const auto refused = [](const char* word) {
        return no_number_in_word<std::uint64_t>(word, 0, std::numeric_limits<std::uint64_t>::max());
    };
    EXPECT_EQ(refused("18446744073709551616"),
              "'18446744073709551616' is not an int from 0 to 2^64 - 1");
    EXPECT_EQ(refused("-1"), "'-1' is not an int from 0 on");
    EXPECT_EQ(no_number_in_word<std::int64_t>("9223372036854775808", 1,
                                              std::numeric_limits<std::int64_t>::max()),
              "'9223372036854775808' is not an int from 1 to 2^63 - 1");
    EXPECT_EQ(no_number_in_word<int>("9", 1, 8), "'9' is not an int from 1 to 8");
}

}  // namespace
}  // namespace rddlc::testing
