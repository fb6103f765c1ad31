// The view of visualizers on a simulator: on the problem of tests/runtime, which has every kind of
// fluent.
#include "../comma_locale.hpp"
#include "../runtime/tiny_batch.hpp"

#include <gtest/gtest.h>
#include <render/episode_renderer.hpp>
#include <render/panels.hpp>
#include <render/replay_page.hpp>
#include <render/state_text.hpp>
#include <render/visualizer.hpp>

#include <cmath>
#include <cstring>
#include <set>

namespace rddl::render {

namespace {
std::vector<std::byte> bytes_of(const auto& record) {
    std::vector<std::byte> bytes(sizeof record);
    std::memcpy(bytes.data(), &record, sizeof record);
    return bytes;
}

tiny::StateRecord state() {
    tiny::StateRecord record = tiny::blank_states(1)[0];
    record.wear = {0.5, 1.25, 0};
    record.running = {1, 0, 1};
    record.mode = 1;
    record.repairs = 7;
    return record;
}

// Two steps; in the second one the mill is repaired.
std::deque<Step> two_steps() {
    Step first, second;
    first.state = second.state = bytes_of(state());
    first.action = bytes_of(tiny::ActionRecord{});
    second.number = 1;
    tiny::StateRecord later = state();
    later.wear[0] = 0.75;
    second.state = bytes_of(later);
    tiny::ActionRecord action{};
    action.repair = {0, 1, 0};
    second.action = bytes_of(action);
    return {first, second};
}

}  // namespace

TEST(Snapshot, TellsValuesByNameAndObject) {
    const World world(*tiny::simulator());
    const auto steps = two_steps();
    const Snapshot snapshot(world, steps, 0, 10);
    const Values& wear = snapshot["wear"];
    EXPECT_EQ(wear.count(0), 3);
    EXPECT_STREQ(wear.object(0, 1), "mill");
    EXPECT_EQ(wear(0), 0.75);
    EXPECT_EQ(wear(1), 1.25);
    EXPECT_EQ(&snapshot["age|wear|running"], &wear);
    EXPECT_EQ(world.find("age|youth"), nullptr);
    EXPECT_TRUE(snapshot["running"].is(2));
    EXPECT_FALSE(snapshot["running"].is(1));
    EXPECT_EQ(snapshot.number("repairs"), 7);
    EXPECT_STREQ(snapshot["mode"].range()->objects[static_cast<int>(snapshot.number("mode"))],
                 "fast");
    EXPECT_EQ(snapshot.number_in(steps[0], "wear", 0), 0.5);
    EXPECT_EQ(world.name_of(*world.find("wear"), 2), "wear(press)");
}

TEST(Snapshot, HasTheDefaultActionWhereNoneIsTaken) {
    const World world(*tiny::simulator());
    auto steps = two_steps();
    EXPECT_TRUE(Snapshot(world, steps, 0, 10)["repair"].is(1));
    steps.back().action.clear();
    const Snapshot end(world, steps, 0, 10);
    EXPECT_FALSE(end.acts());
    EXPECT_FALSE(end["repair"].is(1));
}

TEST(Snapshot, KnowsNoOtherFluents) {
    const World world(*tiny::simulator());
    const auto steps = two_steps();
    const Snapshot snapshot(world, steps, 0, 10);
    EXPECT_FALSE(snapshot.has("speed"));
    EXPECT_EQ(snapshot.number_or("speed", 3), 3);
    EXPECT_THROW(snapshot["speed"], Error);
    EXPECT_THROW(snapshot.number_in(steps[0], "speed"), Error);
}

TEST(StateText, ListsTrueBoolsAndMarksChanges) {
    const World world(*tiny::simulator());
    const auto steps = two_steps();
    const std::vector<TextLine> lines = state_lines(Snapshot(world, steps, 0, 10));
    ASSERT_EQ(lines.size(), 6u);
    EXPECT_EQ(lines[0].name, "wear(lathe)");
    EXPECT_EQ(lines[0].value, "0.75");
    EXPECT_TRUE(lines[0].changed);
    EXPECT_FALSE(lines[1].changed);
    EXPECT_EQ(lines[3].name, "running");
    EXPECT_EQ(lines[3].value, "lathe press");
    EXPECT_EQ(lines[4].value, "fast");
    EXPECT_EQ(lines[5].value, "7");
}

TEST(StateText, TellsWhatDiffersFromTheDefaultAction) {
    const World world(*tiny::simulator());
    auto steps = two_steps();
    EXPECT_EQ(action_text(Snapshot(world, steps, 0, 10)), "repair(mill)");
    steps.back().action.clear();
    EXPECT_EQ(action_text(Snapshot(world, steps, 0, 10)), "default");
}

TEST(Numbers, AreShortAndWhole) {
    EXPECT_EQ(number_text(0.1), "0.1");
    EXPECT_EQ(number_text(-455901.3), "-455901");
    EXPECT_EQ(number_text(-0.0), "0");
    EXPECT_EQ(number_text(1.0 / 3), "0.3333");
    EXPECT_EQ(number_text(1e20), "1e+20");
    EXPECT_EQ(number_text(NAN), "nan");
    EXPECT_EQ(number_text(-INFINITY), "-inf");
}

TEST(Visualizers, HaveDifferentNamesAndASentence) {
    std::set<std::string_view> names;
    for (const Visualizer* const visualizer : visualizers()) {
        EXPECT_TRUE(names.insert(visualizer->name).second) << visualizer->name;
        EXPECT_FALSE(visualizer->summary.empty()) << visualizer->name;
        EXPECT_EQ(find_visualizer(visualizer->name), visualizer);
    }
    EXPECT_EQ(find_visualizer("nobody"), nullptr);
}

TEST(Visualizers, FallBackToAutoWhereAFluentIsMissing) {
    const World world(*tiny::simulator());
    EXPECT_EQ(visualizer_for(world).name, "auto");
    EXPECT_EQ(missing_fluent(*find_visualizer("mountain_car"), world), "pos|position");
    EXPECT_EQ(missing_fluent(*find_visualizer("chart"), world), "");
    // The name of the domain alone does not make a mountain car.
    rddl_problem problem = *tiny::simulator()->problem;
    problem.domain = "mountain_car";
    rddl_simulator simulator = *tiny::simulator();
    simulator.problem = &problem;
    EXPECT_EQ(visualizer_for(World(simulator)).name, "auto");
}

TEST(Visualizers, ForAnyProblemDrawEveryKindOfFluent) {
    const World world(*tiny::simulator());
    for (const char* const name : {"auto", "chart", "heatmap", "text"}) {
        EpisodeRenderer renderer(world, *find_visualizer(name), 300, 200, 0, 10);
        std::set<std::uint32_t> colours;
        for (Step& step : two_steps()) {
            renderer.add(step);
            const Picture& picture = renderer.picture();
            EXPECT_EQ(picture.pixels.size(), 300u * 200u);
            colours.insert(picture.pixels.begin(), picture.pixels.end());
        }
        EXPECT_GT(colours.size(), 30u) << name;
        EXPECT_TRUE(renderer.svg().ends_with("</svg>\n")) << name;
    }
}

class PicturesInCommaLocale : public CommaLocale {
  protected:
    // The page, which also holds the pictures.
    static std::string drawn() {
        const World world(*tiny::simulator());
        std::string all;
        for (const char* const name : {"auto", "chart", "heatmap", "text"}) {
            EpisodeRenderer renderer(world, *find_visualizer(name), 300, 200, 0, 10);
            ReplayPage page(world, 300, 200, 2.5);
            page.begin_run("run");
            for (Step& step : two_steps()) {
                renderer.add(step);
                page.add(renderer.snapshot(), renderer.picture());
            }
            all += page.html();
        }
        return all;
    }
};

TEST_F(PicturesInCommaLocale, AreTheSame) {
    EXPECT_EQ(number_text(0.1), "0.1");
    EXPECT_EQ(number_text(1234567), "1234567");
    EXPECT_EQ(rounded_text(1 / 3.0, 2), "0.33");
    EXPECT_EQ(rounded_text(-1e-7, 2), "-1e-07");
    const std::string here = drawn();
    end();
    EXPECT_TRUE(here == drawn()) << "pages and their pictures depend on the locale";
}

TEST(EpisodeRenderer, ForgetsWhatWasLongAgo) {
    const World world(*tiny::simulator());
    EpisodeRenderer renderer(world, *find_visualizer("chart"), 300, 200, 0, 0);
    for (std::int64_t k = 0; k < 1500; ++k) {
        Step step = two_steps()[0];
        step.number = k;
        renderer.add(std::move(step));
    }
    EXPECT_EQ(renderer.snapshot().steps().size(), most_steps_remembered);
    EXPECT_EQ(renderer.snapshot().now().number, 1499);
    EXPECT_EQ(renderer.picture().width, 300);
}

TEST(Range, IsThatOfFiniteNumbers) {
    const World world(*tiny::simulator());
    auto steps = two_steps();
    tiny::StateRecord odd = state();
    odd.wear = {INFINITY, NAN, 4};
    steps.back().state = bytes_of(odd);
    const Snapshot snapshot(world, steps, 0, 10);
    const Range range = range_of(snapshot, *world.find("wear"));
    EXPECT_EQ(range.low, 0);
    EXPECT_EQ(range.high, 4);
    EXPECT_EQ(range_of(snapshot, *world.find("running")).high, 1);
}

}  // namespace rddl::render
