#include <rddl/object_lanes/weight_rows.hpp>
#include <rddl/random/distributions.hpp>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace rddl {
namespace {

constexpr std::array draws = {counters_of_loop(3)};

// The draw from the row, and the one from the quotients, with its faults.
template <class R, std::size_t n>
void expect_quotients(const std::array<R, n>& weights, Index object) {
    Context<ScalarOf<R>> context{stream_key(5, 0, 0), 1, {}}, other = context;
    R total{0};
    for (const R weight : weights) total = total + weight;
    const std::int64_t draw = sample::discrete_of_row(context, Place{3, object}, weights);
    EXPECT_EQ(draw, sample::discrete_over(other, Place{3, object}, n,
                                          [&](Index i) { return weights[i] / total; }));
    EXPECT_EQ(context.fault.kind, other.fault.kind) << total;

    Context<ScalarOf<R>> of_step{stream_key(5, 0, 0), 1, {}};
    const StepNumbers<ScalarOf<R>, draws> numbers(of_step);
    if (object < 8) {
        EXPECT_EQ(draw,
                  sample::discrete_of_row(of_step, place_in_row<0>(numbers, 3, object), weights));
        EXPECT_EQ(of_step.fault.kind, other.fault.kind) << total;
    }
}

template <class R, std::size_t n>
void expect_quotients() {
    Context<ScalarOf<R>> context{stream_key(7, 0, 0), 1, {}};
    for (Index object = 0; object < 400; ++object) {
        std::array<R, n> weights;
        for (std::size_t k = 0; k < n; ++k) {
            const R number = uniform_at(context, Place{static_cast<std::uint32_t>(k), object});
            weights[k] = (object + static_cast<Index>(k)) % 3 == 0 ? R{0} : number * R(300);
        }
        expect_quotients(weights, object);
        for (R& weight : weights) weight *= std::numeric_limits<R>::min();
        expect_quotients(weights, object);
        // A limit that is the number of the draw, or its neighbour.
        Context<ScalarOf<R>> own{stream_key(5, 0, 0), 1, {}};
        const R u = uniform_at(own, Place{3, object});
        for (const R first : {u, std::nextafter(u, R{0}), std::nextafter(u, R{1})}) {
            std::array<R, n> near{};
            near[0] = first * R(3);
            near[n - 1] = (1 - first) * R(3);
            expect_quotients(near, object);
        }
    }
}

TEST(WeightRows, AreDiscreteOfTheQuotients) {
    expect_quotients<double, 2>();
    expect_quotients<double, 5>();
    expect_quotients<double, 8>();
    expect_quotients<double, 9>();
    expect_quotients<float, 5>();
}

TEST(WeightRows, FaultLikeTheQuotients) {
    const double infinity = std::numeric_limits<double>::infinity(), nan = std::nan("");
    for (Index object = 0; object < 8; ++object) {
        expect_quotients<double, 4>({0.0, 0.0, 0.0, 0.0}, object);
        expect_quotients<double, 4>({1.0, infinity, 0.0, 0.0}, object);
        expect_quotients<double, 4>({1.0, 2.0, nan, 0.0}, object);
        expect_quotients<double, 4>({1e308, 0.0, 1e308, 1e308}, object);
        expect_quotients<double, 4>({1e-310, 2e-310, 0.0, 1e-310}, object);
    }
}

// Zero times an infinite total is no number.
TEST(WeightRows, FaultWhereTheNumberIsZero) {
    const PlaceOfNumber zero{{3, 0}, 0};
    Context<Scalar> context{stream_key(5, 0, 0), 1, {}};
    const std::array<double, 3> weights{1.0, std::numeric_limits<double>::infinity(), 2.0};
    EXPECT_EQ(sample::discrete_of_row(context, zero, weights), 0);
    EXPECT_EQ(context.fault.kind, FaultKind::Weight);

    Context<ScalarOf<float>> floats{stream_key(5, 0, 0), 1, {}};
    const std::array<float, 2> others{1.0f, std::numeric_limits<float>::infinity()};
    EXPECT_EQ(sample::discrete_of_row(floats, zero, others), 0);
    EXPECT_EQ(floats.fault.kind, FaultKind::Weight);
}

// Packs draw what each environment would.
TEST(WeightRows, PacksDrawTheSame) {
    using L = Pack<16>;
    L::Word low, high;
    for (int lane = 0; lane < 16; ++lane) {
        const StreamKey key = stream_key(5, static_cast<std::uint64_t>(lane), 0);
        low.set(lane, key.low);
        high.set(lane, key.high);
    }
    auto context = Context<L>::of(low, high, L::Word{std::uint64_t{1}}, true);
    std::array<L::Real, 5> weights;
    for (int k = 0; k < 5; ++k)
        for (int lane = 0; lane < 16; ++lane)
            weights[static_cast<std::size_t>(k)].set(lane, (lane * 7 + k * 5) % 11);
    const L::Int drawn = sample::discrete_of_row(context, Place{3, 2}, weights);
    for (int lane = 0; lane < 16; ++lane) {
        Context<Scalar> alone{stream_key(5, static_cast<std::uint64_t>(lane), 0), 1, {}};
        std::array<double, 5> own;
        for (std::size_t k = 0; k < 5; ++k) own[k] = weights[k][lane];
        EXPECT_EQ(drawn[lane], sample::discrete_of_row(alone, Place{3, 2}, own));
    }
}

}  // namespace
}  // namespace rddl
