// The random numbers of a step (docs/randomness.md), without what only some callers need: numbers
// that are kept for later draws, faults, and streams of medians.
#pragma once

#include <rddl/simulator.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <type_traits>

namespace least_steps {

template <class L>
class Draws {
    using Word = typename L::Word;
    using Element = typename L::Element;

  public:
    using Real = typename L::Real;

    RDDL_INLINE Draws(const Word& step, const Word& key_low, const Word& key_high)
        : schedule_(step, {key_low, key_high}) {}

    // The numbers in [0, 1) of the draws at a site with the indices from `first` on.
    template <std::size_t count, std::size_t first = 0>
    RDDL_INLINE std::array<Real, count> uniforms(std::uint64_t site) const {
        constexpr std::size_t before = first % 2, all = before + count;
        std::array<Real, all + all % 2> numbers;
        for (std::size_t i = 0; i < all; i += 4)
            if (all - i > 2)
                pairs<2>(site, first - before, i, numbers);
            else
                pairs<1>(site, first - before, i, numbers);
        std::array<Real, count> wanted;
        for (std::size_t i = 0; i < count; ++i) wanted[i] = numbers[before + i];
        return wanted;
    }
    RDDL_INLINE Real uniform(std::uint64_t site) const { return uniforms<1>(site)[0]; }

    template <std::size_t count, std::size_t first = 0>
    RDDL_INLINE std::array<Real, count> open_uniforms(std::uint64_t site) const {
        std::array<Real, count> numbers = uniforms<count, first>(site);
        for (Real& number : numbers) number = rddl::open_unit_real(number);
        return numbers;
    }

    // Standard ones.
    template <std::size_t count, std::size_t first = 0>
    RDDL_INLINE std::array<Real, count> normals(std::uint64_t site) const {
        std::array<Real, count> numbers = open_uniforms<count, first>(site);
        if constexpr (count > 1)
            rddl::replace_by_normal_quantiles<count>(numbers.data(), count);
        else
            for (Real& number : numbers) number = rddl::normal_quantile(number);
        return numbers;
    }

    template <std::size_t count>
    RDDL_INLINE std::array<Real, count> exponentials(std::uint64_t site) const {
        std::array<Real, count> numbers = open_uniforms<count>(site);
        for (Real& number : numbers) number = -logarithm(number);
        return numbers;
    }

  private:
    // Each counter of Philox gives two numbers; the rounds of some of them are made in turns.
    template <std::size_t together, std::size_t count>
    RDDL_INLINE void pairs(std::uint64_t site, std::size_t first, std::size_t at,
                           std::array<Real, count>& numbers) const {
        rddl::philox::Block<Word> words[together];
        schedule_.generate(site, static_cast<std::uint64_t>((first + at) / 2), words);
        for (std::size_t k = 0; k < together; ++k) {
            numbers[at + 2 * k] = rddl::unit_real<Element>(words[k][0], words[k][1]);
            numbers[at + 2 * k + 1] = rddl::unit_real<Element>(words[k][2], words[k][3]);
        }
    }
    static RDDL_INLINE Real logarithm(const Real& number) {
        if constexpr (std::is_same_v<Element, double>)
            return rddl::detail::ln_of_positive(number, Real{0.0});
        else
            return rddl::detail::single::ln_of_positive(number);
    }

    rddl::philox::Schedule<rddl::philox::draw_rounds, Word> schedule_;
};

}  // namespace least_steps
