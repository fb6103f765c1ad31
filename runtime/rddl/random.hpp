// Random numbers as a pure function of what they are for (docs/randomness.md).
//
// An episode has a stream key made from (seed, environment, episode); a draw has the counter
// (step, site, index) in that stream. So a draw depends neither on what was drawn before it nor
// on batches, threads or machines.
#pragma once

#include <rddl/context.hpp>
#include <rddl/lane.hpp>
#include <rddl/philox.hpp>

#include <array>
#include <cstdint>

namespace rddl {

constexpr StreamKey stream_key(std::uint64_t seed, std::uint64_t environment,
                               std::uint64_t episode) {
    using philox::high_word, philox::low_word;
    const philox::Block block = philox::generate(
        {low_word(environment), high_word(environment), low_word(episode), high_word(episode)},
        {low_word(seed), high_word(seed)});
    return {block[0], block[1]};
}

// 53 bits in [0, 1).
constexpr double unit_real(std::uint64_t bits) {
    return static_cast<double>(bits >> 11) * 0x1p-53;
}
// 52 bits in (0, 1), symmetric about 1/2: neither 0 nor 1 occurs.
constexpr double open_unit_real(std::uint64_t bits) {
    return (static_cast<double>(bits >> 12) + 0.5) * 0x1p-52;
}

// The random numbers of one draw, as many as it needs: two from each counter value.
class Draws {
  public:
    constexpr Draws(const Context<Scalar>& context, Place place)
        : counter_{context.step, place.site, place.index, 0},
          key_{context.key.low, context.key.high} {}

    constexpr double uniform() { return unit_real(bits()); }
    constexpr double open_uniform() { return open_unit_real(bits()); }

  private:
    constexpr std::uint64_t bits() {
        if (used_ == block_.size()) refill();
        const std::uint64_t low = block_[used_];
        const std::uint64_t high = block_[used_ + 1];
        used_ += 2;
        return high << 32 | low;
    }
    constexpr void refill() {
        block_ = philox::generate(counter_, key_);
        ++counter_[3];
        used_ = 0;
    }

    philox::Block counter_;
    philox::Key key_;
    philox::Block block_{};
    std::uint32_t used_ = 4;
};

// For draws that need one uniform number.
constexpr double uniform_at(const Context<Scalar>& context, Place place) {
    return Draws(context, place).uniform();
}
constexpr double open_uniform_at(const Context<Scalar>& context, Place place) {
    return Draws(context, place).open_uniform();
}

// For draws that need more: `kernel(draws, parameters...)` in each lane whose parameters are
// valid, zero elsewhere.
template <class Kernel, class... Parameters>
constexpr auto draw_in_each_lane(const Context<Scalar>& context, Place place, bool valid,
                                 Kernel kernel, Parameters... parameters) {
    Draws draws(context, place);
    using Result = decltype(kernel(draws, parameters...));
    return valid ? kernel(draws, parameters...) : Result{};
}

// Rejection loops end after this many attempts. A loop that accepts once in two attempts gets
// here with probability 1e-301, so only parameters like nan or infinity do.
inline constexpr int rejection_limit = 1000;

}  // namespace rddl
