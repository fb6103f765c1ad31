// Moves that are looked up are those that the loop over all objects makes.
#include <rddl/object_lanes/many_objects.hpp>
#include <rddl/object_lanes/moves.hpp>
#include <rddl/simulator.hpp>

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace rddl {
namespace {

// Things on a ring of places. One step goes to the next place, with luck; the other goes back and
// needs none; both at once are not looked up, and neither leaves nothing.
constexpr std::size_t ring = 70;
constexpr auto ring_moves = [] {
    constexpr MoveCodes codes{ring};
    std::array<std::array<std::uint8_t, 4>, ring> moves{};
    for (std::size_t place = 0; place < ring; ++place)
        moves[place] = {static_cast<std::uint8_t>(codes.none()),
                        static_cast<std::uint8_t>(codes.drawn((place + 1) % ring)),
                        static_cast<std::uint8_t>(codes.certain((place + ring - 1) % ring)),
                        static_cast<std::uint8_t>(codes.other())};
    return moves;
}();
constexpr auto next_places = [] {
    std::array<std::uint8_t, ring> places{};
    for (std::size_t i = 0; i < ring; ++i) places[i] = static_cast<std::uint8_t>((i + 1) % ring);
    return places;
}();
constexpr auto places_before = [] {
    std::array<std::uint8_t, ring> places{};
    for (std::size_t i = 0; i < ring; ++i)
        places[i] = static_cast<std::uint8_t>((i + ring - 1) % ring);
    return places;
}();

template <class L>
using Ring = std::array<typename L::Bool, ring>;

template <class L>
Context<L> context_of_moves() {
    if constexpr (L::width == 1) {
        return {stream_key(1, 2, 3), 4, {}};
    } else {
        typename L::Word low, high;
        for (int lane = 0; lane < L::width; ++lane) {
            const StreamKey key = stream_key(1, static_cast<std::uint64_t>(lane), 3);
            low.set(lane, key.low);
            high.set(lane, key.high);
        }
        return Context<L>::of(low, high, typename L::Word{std::uint64_t{4}}, true);
    }
}

template <class L>
void expect_moves(const std::vector<std::size_t>& places, bool steps, bool goes_back) {
    using Bool = typename L::Bool;
    Ring<L> at_place, expected, result;
    at_place.fill(Bool(false));
    result.fill(Bool(true));  // what was there does not count
    for (const std::size_t place : places) at_place[place] = Bool(true);
    const Bool step(steps), back(goes_back);
    const auto draw = [](auto& several, auto x) {
        return sample::valid_bernoulli(several, {0, x}, 0.5);
    };
    const auto run = [&](Context<L>& context, Ring<L>& target) {
        for_each_object<ring>(context, [&](auto& several, auto x) {
            elements(target, x) = branch(
                several, step && at_places<places_before>(at_place, x),
                [&] { return draw(several, x); },
                [&] { return back && at_places<next_places>(at_place, x); });
        });
    };
    Context<L> context = context_of_moves<L>(), same_context = context_of_moves<L>();
    run(context, expected);
    move_only_true<ring_moves>(same_context, at_place, tables(step, back), result, draw,
                               [&](Context<L>& its_context) { run(its_context, result); });
    for (std::size_t i = 0; i < ring; ++i)
        for (int lane = 0; lane < L::width; ++lane)
            EXPECT_EQ(get_lane(expected[i], lane), get_lane(result[i], lane)) << i;
}

TEST(Moves, AreThoseOfTheLoop) {
    for (const std::vector<std::size_t>& places :
         std::vector<std::vector<std::size_t>>{{}, {0}, {5}, {63}, {64}, {69}, {3, 9}, {3, 66}})
        for (const bool steps : {false, true})
            for (const bool goes_back : {false, true}) {
                expect_moves<Scalar>(places, steps, goes_back);
                expect_moves<Pack<16>>(places, steps, goes_back);
            }
}

}  // namespace
}  // namespace rddl
