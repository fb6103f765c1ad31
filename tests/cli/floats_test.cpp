// Simulators that compute in floats follow those that compute in doubles.
#include "program.hpp"

#include <cmath>
#include <sstream>
#include <vector>

namespace rddlc::cli {
namespace {

using nlohmann::json;

class Floats : public Program {
  protected:
    std::vector<json> lines_of(const std::string& name) const {
        std::vector<json> lines;
        std::istringstream text(read_file(folder_ / name));
        for (std::string line; std::getline(text, line);) lines.push_back(json::parse(line));
        return lines;
    }
    void succeed(const std::string& arguments) const {
        const Outcome outcome = run(arguments);
        ASSERT_EQ(outcome.status, 0) << outcome.err;
    }

    // Episodes of random actions in doubles, and what the same actions, with the same seed and no
    // other help, lead to in floats.
    void play(const std::string& example) const {
        const std::string folder = std::string(RDDL_EXAMPLES) + "/" + example;
        const std::string problem = fmt::format("'{0}/domain.rddl' '{0}/instance.rddl' ", folder);
        succeed("run " + problem +
                "--engine=interpreter --episodes 4 --seed 3 --trace exact.jsonl");
        std::string actions;
        for (const json& line : lines_of("exact.jsonl")) {
            const bool is_header = line.contains("rddl_trace");
            const json asked =
                is_header ? line : json{{"episode", line["episode"]}, {"action", line["action"]}};
            actions += asked.dump() + "\n";
        }
        write_file(folder_ / "actions.jsonl", actions);
        succeed("replay " + problem + "--real=float --input actions.jsonl --output floats.jsonl");
    }
};

// The tolerance of reals; relative for those greater than 1. All else is the same.
constexpr double tolerance = 1e-4;

void expect_near(const json& found, const json& exact, const std::string& where) {
    if (exact.is_number_float()) {
        const double value = exact;
        EXPECT_NEAR(found.get<double>(), value, tolerance * std::fmax(1, std::fabs(value)))
            << where;
    } else {
        EXPECT_EQ(found, exact) << where;
    }
}

TEST_F(Floats, FollowDoublesForWholeEpisodes) {
    for (const char* example : {"mountain_car", "cart_pole", "reservoir", "robot"}) {
        play(example);
        const std::vector<json> exact = lines_of("exact.jsonl"), floats = lines_of("floats.jsonl");
        ASSERT_EQ(floats.size() + 1, exact.size()) << "the header has no answer";
        for (std::size_t i = 0; i < floats.size(); ++i) {
            const json& step = exact[i + 1];
            const std::string where = fmt::format("{}, episode {}, step {}", example,
                                                  step["episode"].dump(), step["step"].dump());
            for (const auto& [name, value] : step["next_state"].items())
                expect_near(floats[i]["state"][name], value, where + ": " + name);
            expect_near(floats[i]["reward"], step["reward"], where + ": reward");
            EXPECT_EQ(floats[i]["terminated"], step["terminated"]) << where;
            EXPECT_EQ(floats[i]["truncated"], step["truncated"]) << where;
        }
    }
}

}  // namespace
}  // namespace rddlc::cli
