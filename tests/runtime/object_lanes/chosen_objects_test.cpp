// Loops over objects of which an action chooses few give what all iterations give. Also built for
// other instruction sets (CMakeLists.txt).
#include <rddl/object_lanes/chosen_objects.hpp>
#include <rddl/simulator.hpp>

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <cstdint>

namespace rddl {
namespace {

// Every `every`-th object is chosen. Some numbers are not probabilities.
template <std::size_t n>
void expect_the_chosen(std::size_t every, StreamKey key) {
    constexpr auto count = static_cast<Index>(n);
    std::array<bool, n> choices{}, kept{};
    std::array<double, n> chance{};
    for (std::size_t x = 0; x < n; ++x) {
        choices[x] = x % every == every / 2;
        kept[x] = x % 3 == 0;
        chance[x] = x == n / 2 ? 2 : static_cast<double>(x % 10) / 9;
    }
    const auto body = [&](auto& target) {
        return [&](auto& several, auto x) {
            elements(target, x) = branch(
                several, at(choices, x),
                [&] {
                    return sample::bernoulli(several, {3, x, 1}, at(chance, x));
                },
                [&] { return at(kept, x); });
        };
    };
    struct {
        std::array<bool, n> bools{};
        bool behind = true;
    } result;
    std::array<bool, n> expected{};
    Context<Scalar> context{key, 1, {}}, same_context = context;
    for_each_object<count>(context, body(expected));
    for_chosen_objects<count>(same_context, choices, kept, result.bools, body(result.bools));
    EXPECT_EQ(result.bools, expected) << n << " " << every;
    EXPECT_TRUE(result.behind);
    EXPECT_EQ(same_context.fault.kind, context.fault.kind);
    EXPECT_EQ(same_context.fault.place, context.fault.place);
}

TEST(ChosenObjects, AreComputedAlone) {
    const StreamKey key = stream_key(1, 2, 3);
    for (const std::size_t every : {1, 4, 9, 20, 1000}) {
        expect_the_chosen<17>(every, key);
        expect_the_chosen<30>(every, key);
        expect_the_chosen<64>(every, key);
        expect_the_chosen<65>(every, key);
        expect_the_chosen<200>(every, key);
    }
    expect_the_chosen<64>(20, median_key);
}

// Callers write true as any byte but 0.
TEST(ChosenObjects, HaveAnyByteThatIsTrue) {
    std::array<bool, 40> choices{}, kept{}, target{};
    const unsigned char byte = 8;
    __builtin_memcpy(&choices[33], &byte, 1);
    Context<Scalar> context{stream_key(1, 2, 3), 1, {}};
    for_chosen_objects<40>(context, choices, kept, target,
                           [&](auto&, auto x) { elements(target, x) = true; });
    for (std::size_t x = 0; x < target.size(); ++x) EXPECT_EQ(target[x], x == 33);
}

TEST(ChosenObjects, AreAllInPacks) {
    using L = Pack<8>;
    std::array<Mask<8>, 20> choices, kept, target;
    choices.fill(Mask<8>::of_bits(0x0F));
    kept.fill(Mask<8>::of_bits(0x55));
    Context<L> context = Context<L>::of(L::Word{7}, L::Word{9}, L::Word{1}, true);
    for_chosen_objects<20>(context, choices, kept, target, [&](auto&, auto x) {
        elements(target, x) = select(at(choices, x), true, at(kept, x));
    });
    for (const Mask<8>& each : target) EXPECT_EQ(each.bits, 0x5Fu);
}

}  // namespace
}  // namespace rddl
