#include "passes/lanes/tabulate_clearances.hpp"

#include "passes/lanes/evaluate_together.hpp"
#include "passes/lanes/quantify_together.hpp"
#include "texts.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

namespace rddlc {
namespace {

struct Wall {
    double x1, y1, x2, y2;
};
// Along the axes, and others.
constexpr std::array<Wall, 6> walls = {{{0, 0, 4, 0},
                                        {4, 0, 4, 4},
                                        {0, 4, 0, 0},
                                        {1, 2.5, 1.75, 2.5},
                                        {2.5, 1, 2.5, 1.375},
                                        {3, 3, 3.3, 3.7}}};

Problem with_walls(const std::string& hit) {
    std::string places;
    for (std::size_t k = 0; k < walls.size(); ++k) {
        const std::string at = "(b" + std::to_string(k + 1) + ") = ";
        places += "X1" + at + std::to_string(walls[k].x1) + "; Y1" + at +
                  std::to_string(walls[k].y1) + "; X2" + at + std::to_string(walls[k].x2) + "; Y2" +
                  at + std::to_string(walls[k].y2) + ";\n";
    }
    return {.pvariables =
                "X1(obj) : { non-fluent, real, default = 4.0 };\n"
                "Y1(obj) : { non-fluent, real, default = 4.0 };\n"
                "X2(obj) : { non-fluent, real, default = 0.0 };\n"
                "Y2(obj) : { non-fluent, real, default = 4.0 };\n"
                "x : { state-fluent, real, default = 2.0 };\n"
                "y : { state-fluent, real, default = 2.0 };\n"
                "dx : { action-fluent, real, default = 0.0 };\n"
                "dy : { action-fluent, real, default = 0.0 };\n"
                "hit(obj) : { interm-fluent, bool };\n"
                "stop : { state-fluent, bool, default = false };\n",
            .cpfs = "hit(?w) = " + hit +
                    ";\nstop' = exists_{?w : obj} [hit(?w)];\n"
                    "x' = x + dx;\ny' = y + dy;\n",
            .non_fluents = places};
}

// The walls from (x, y) to (x + dx, y + dy), by the signs of areas.
const char* const crosses =
    "(((dy * (X1(?w) - (x + dx)) - dx * (Y1(?w) - (y + dy)) > 0.0) ~="
    "  (dy * (X2(?w) - (x + dx)) - dx * (Y2(?w) - (y + dy)) > 0.0)) ^"
    " (((Y2(?w) - Y1(?w)) * (x - X2(?w)) - (X2(?w) - X1(?w)) * (y - Y2(?w)) > 0.0) ~="
    "  ((Y2(?w) - Y1(?w)) * ((x + dx) - X2(?w)) - (X2(?w) - X1(?w)) * ((y + dy) - Y2(?w)) > 0.0)))";

template <class R>
bool is_crossed(const Wall& w, R x, R y, R dx, R dy) {
    const R x1 = static_cast<R>(w.x1), y1 = static_cast<R>(w.y1), x2 = static_cast<R>(w.x2),
            y2 = static_cast<R>(w.y2);
    const auto is_left = [&](R px, R py) {
        return dy * (px - (x + dx)) - dx * (py - (y + dy)) > 0;
    };
    const auto is_above = [&](R px, R py) {
        return (y2 - y1) * (px - x2) - (x2 - x1) * (py - y2) > 0;
    };
    return is_left(x1, y1) != is_left(x2, y2) && is_above(x, y) != is_above(x + dx, y + dy);
}

ir::Program with_clearances(const Problem& problem, passes::Report& report,
                            RealType real = RealType::Double) {
    ir::Program program = grounded_with_many(problem);
    program.real = real;
    for (const Pass pass :
         {passes::evaluate_together, passes::quantify_together, passes::tabulate_clearances})
        program = valid(pass(std::move(program), report));
    return program;
}

const ir::Clearances& clearances_of(const ir::Program& program) {
    const ir::Clearances* found = nullptr;
    for (const ir::Definition& definition : program.step)
        for (const ir::Statement& statement : definition.body)
            if (const auto* loop = std::get_if<ir::Loop>(&statement.form))
                if (loop->clearances) found = &*loop->clearances;
    if (!found) throw std::runtime_error("no table of clearances");
    return *found;
}

// The clearance that rddl/object_lanes/clearance.hpp looks up; 0 outside.
template <class R>
R clearance_at(const ir::Program& program, const ir::Clearances& clearances,
               const std::vector<R>& place) {
    const ir::Buffer& table = program[clearances.table];
    std::int64_t cell = 0;
    for (std::size_t k = 0; k < place.size(); ++k) {
        const R at = (place[k] - static_cast<R>(clearances.begin[k])) *
                     static_cast<R>(clearances.cells_per_unit[k]);
        if (!(at >= 0 && at < static_cast<R>(table.shape[k]))) return 0;
        cell = cell * table.shape[k] + static_cast<std::int64_t>(at);
    }
    return static_cast<R>(std::get<std::int64_t>(table.values[cell])) *
           static_cast<R>(clearances.unit);
}

TEST(TabulateClearances, KnowsHowFarTheWallsAre) {
    passes::Report report;
    const ir::Program program = with_clearances(with_walls(crosses), report);
    EXPECT_EQ(report["loops over the objects near a place"], 1);
    const std::string text = ir::print(program);
    EXPECT_NE(text.find("for w in obj, several at once, near clearances[state.x, state.y] "
                        "of action.dx, action.dy\n"),
              std::string::npos)
        << text;
}

// Beside a wall, and where its line goes on, also with moves that are nearly along it.
template <class R>
void step_near_and_far(RealType real, int trials) {
    passes::Report report;
    const ir::Program program = with_clearances(with_walls(crosses), report, real);
    const ir::Clearances clearances = clearances_of(program);
    std::mt19937_64 random(7);
    const auto number = [&](double low, double high) {
        return static_cast<R>(std::uniform_real_distribution(low, high)(random));
    };
    int clear_count = 0, crossed_count = 0;
    for (int trial = 0; trial < trials; ++trial) {
        const Wall& wall = walls[random() % walls.size()];
        const R along = number(-1.5, 2.5), beside = std::ldexp(number(-1, 1), -(trial % 50));
        const auto on_line = [&](double begin, double end) {
            return static_cast<R>(begin + along * (end - begin) + beside);
        };
        const R x = trial % 3 == 0 ? number(0, 4) : on_line(wall.x1, wall.x2);
        const R y = trial % 3 == 0 ? number(0, 4) : on_line(wall.y1, wall.y2);
        const R clearance = clearance_at<R>(program, clearances, {x, y});
        const double longest = clearance > 0 && trial % 2 == 0 ? clearance : 0.3;
        R dx = number(-longest, longest), dy = number(-longest, longest);
        if (trial % 5 == 1) dx = std::ldexp(dx, -static_cast<int>(random() % 40));
        if (trial % 5 == 2) dy = std::ldexp(dy, -static_cast<int>(random() % 40));
        if (trial % 7 == 0) dy = -2 * beside;
        const bool is_clear =
            std::max(std::fabs(dx), std::fabs(dy)) < clearance &&
            std::min(std::fabs(dx), std::fabs(dy)) >= static_cast<R>(clearances.least_move);
        const bool is_hit = std::ranges::any_of(
            walls, [&](const Wall& each) { return is_crossed(each, x, y, dx, dy); });
        clear_count += is_clear;
        crossed_count += is_hit;
        ASSERT_FALSE(is_clear && is_hit)
            << x << ' ' << y << ' ' << dx << ' ' << dy << ' ' << clearance;
    }
    EXPECT_GT(clear_count, trials / 10);
    EXPECT_GT(crossed_count, trials / 15);
}

TEST(TabulateClearances, IsRightNearAndFar) {
    step_near_and_far<double>(RealType::Double, 300'000);
    step_near_and_far<float>(RealType::Float, 100'000);
}

TEST(TabulateClearances, NeedsNoMoves) {
    passes::Report report;
    const ir::Program program = with_clearances(
        with_walls("abs[x - X1(?w)] < 0.25 ^ abs[y - Y1(?w)] < 0.25 ^ "
                   "(x - X2(?w)) * (x - X2(?w)) + (y - Y2(?w)) * (y - Y2(?w)) > 0.5 ^ "
                   "(x - X2(?w)) * (x - X1(?w)) + (y - Y2(?w)) * (y - Y1(?w)) < 9.0"),
        report);
    const ir::Clearances& clearances = clearances_of(program);
    EXPECT_TRUE(clearances.moves.empty());
    EXPECT_EQ(clearance_at<double>(program, clearances, {0.1, 0.1}), 0);
    EXPECT_GT(clearance_at<double>(program, clearances, {2.0, 1.9}), 0);
}

// A difference of infinities is not a number, for which no comparison but `~=` is true.
TEST(TabulateClearances, LeavesWhatMayOverflow) {
    std::string factors;
    for (int k = 0; k < 11; ++k) factors += " * 1000000000000000000000000000000.0";
    const std::string difference =
        "((x - X1(?w) + dx)" + factors + " - (y - Y1(?w))" + factors + ")";
    passes::Report report;
    with_clearances(with_walls("~(" + difference + " < 5.0) ^ ~(" + difference + " > 5.0) ^ " +
                               difference + " ~= 5.0"),
                    report);
    EXPECT_EQ(report["loops over the objects near a place"], 0);
}

TEST(TabulateClearances, LeavesWhatIsCheapOrNotProved) {
    const std::string crosses_or = std::string(crosses) + " | ";
    for (const std::string& hit :
         {std::string("abs[x - X1(?w)] < 0.25 ^ abs[y - Y1(?w)] < 0.25"),
          crosses_or + "sin[x - X1(?w)] < 0.5", crosses_or + "x * dx + X1(?w) > y",
          crosses_or + "(x - X1(?w) > -9.0 ^ y > Y1(?w) - 9.0)"}) {
        passes::Report report;
        with_clearances(with_walls(hit), report);
        EXPECT_EQ(report["loops over the objects near a place"], 0) << hit;
    }
}

}  // namespace
}  // namespace rddlc
