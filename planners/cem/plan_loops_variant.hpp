// PlanLoops for one instruction set. Included once for each, within a namespace of its own;
// includes nothing that would be compiled for it.

// 32 bits of a counter and a key, each of which depends on all of theirs ("lowbias32" of Chris
// Wellons' hash prospector, 2018).
inline std::uint32_t noise_bits(std::uint32_t key, std::size_t counter) {
    std::uint32_t bits = key + static_cast<std::uint32_t>(counter) * 0x9E3779B9u;
    bits = (bits ^ (bits >> 16)) * 0x7FEB352Du;
    bits = (bits ^ (bits >> 15)) * 0x846CA68Bu;
    return bits ^ (bits >> 16);
}

// The sum of three numbers of 0 .. 1023 has the mean 1534.5 and the deviation 512.
inline float bell_of(std::uint32_t bits) {
    const std::uint32_t sum = (bits & 1023) + ((bits >> 10) & 1023) + ((bits >> 20) & 1023);
    return (static_cast<float>(static_cast<std::int32_t>(sum)) - 1534.5f) * (1.0f / 512);
}

inline void next_numbers(const NumberNoise& noise, std::size_t plans, float* numbers) {
    const float *const old = noise.old, *const fresh = noise.fresh;
    const std::uint32_t key = noise.key;
    for (std::size_t p = 0; p < plans; ++p)
        numbers[p] = old[p] * numbers[p] + fresh[p] * bell_of(noise_bits(key, p));
}

// 2^x for x <= 0, within 2e-7 of its value. Polynomials are sums of short ones, which do not wait
// for each other.
inline float power_of_two(float x) {
    x = x > -126 ? x : -126;
    const auto whole = static_cast<std::int32_t>(x);
    const float r = x - static_cast<float>(whole), square = r * r;  // r in (-1, 0]
    const float low = (1.0f + 0.69314712f * r) + (0.24022487f + 0.05549252f * r) * square;
    const float high = (0.0095818322f + 0.0012765167f * r) + 0.00010944255f * square;
    return (low + high * (square * square)) * std::bit_cast<float>((whole + 127) << 23);
}

inline void draw_widths(std::uint32_t key, std::size_t plans, float* widths) {
    // Exponents are lowered by 7 and raised again, since power_of_two() takes none above 0.
    constexpr float octaves = 1.5f * 1.44269504f, most_octaves = 7, scale = 128;
    for (std::size_t p = 0; p < plans; ++p)
        widths[p] = scale * power_of_two(octaves * bell_of(noise_bits(key, p)) - most_octaves);
}

inline void next_ranks(const RankNoise& noise, std::size_t plans, std::int32_t* ranks) {
    const std::uint32_t* const keep = noise.keep;
    const std::uint32_t key = noise.key;
    for (std::size_t p = 0; p < plans; ++p) {
        const std::uint32_t bits = noise_bits(key, p);
        ranks[p] = (bits & 255) < keep[p] ? ranks[p] : static_cast<std::int32_t>(bits >> 8);
    }
}

// As std::clamp, but of values, which loops of it take in registers.
template <class Real>
inline Real clamped(Real x, Real least, Real most) {
    const Real below = x < most ? x : most;
    return below > least ? below : least;
}

inline void scale_numbers(float mean, float deviation, bool is_bounded, const float* widths,
                          const float* noise, std::size_t plans, float* numbers) {
    if (is_bounded)
        for (std::size_t p = 0; p < plans; ++p)
            numbers[p] = clamped(mean + deviation * noise[p], -1.0f, 1.0f);
    else
        for (std::size_t p = 0; p < plans; ++p)
            numbers[p] = mean + deviation * widths[p] * noise[p];
}

inline void count_reached(const std::int32_t* thresholds, std::size_t count,
                          const std::int32_t* ranks, std::size_t plans, std::int32_t* reached) {
    // Up to so many, all are compared; of more, they are searched by halves.
    constexpr std::size_t few = 16;
    for (std::size_t p = 0; p < plans; ++p) reached[p] = 0;
    if (count <= few) {
        for (std::size_t k = 0; k < count; ++k) {
            const std::int32_t threshold = thresholds[k];
            for (std::size_t p = 0; p < plans; ++p) reached[p] += ranks[p] >= threshold ? 1 : 0;
        }
        return;
    }
    for (auto half = static_cast<std::int32_t>((count + 1) / 2); half > 0; half /= 2)
        for (std::size_t p = 0; p < plans; ++p)
            reached[p] += ranks[p] >= thresholds[reached[p] + half - 1] ? half : 0;
}

inline void stretch(const std::int32_t* habits, const float* stretches, const std::int32_t* ranks,
                    std::size_t plans, std::int32_t* stretched) {
    constexpr std::int32_t most = rank_count - 1;
    for (std::size_t p = 0; p < plans; ++p) {
        const std::int32_t above = ranks[p] - habits[p];
        const auto rank =
            static_cast<std::int32_t>(static_cast<float>(above > 0 ? above : 0) * stretches[p]);
        stretched[p] = rank < most ? rank : most;
    }
}

inline void keep_habits(const std::int32_t* habits, const std::int32_t* ranks, std::int32_t usual,
                        std::size_t plans, std::int32_t* chosen) {
    for (std::size_t p = 0; p < plans; ++p) chosen[p] = ranks[p] < habits[p] ? usual : chosen[p];
}

// In place of softplus(x): 0, x, and between them the parabola that meets both with their slopes.
// It differs by 0.076 at most, and unlike softplus it reaches the bound.
inline float bent(float x) {
    constexpr float from = half_bend;
    const float within = clamped(x + from, 0.0f, 2 * from);
    return within * within * (1 / (4 * from)) + ((x > from ? x : from) - from);
}

inline float rounded_whole(float x) {
    return __builtin_nearbyintf(x);
}
inline double rounded_whole(double x) {
    return __builtin_nearbyint(x);
}

// Values before they are finished, in the precision of Number.
template <class Number, class Finish>
inline void finish_values(const RealScale& real, const float* numbers, std::size_t plans,
                          double* values, Finish finished) {
    const auto lower = static_cast<Number>(real.lower), upper = static_cast<Number>(real.upper);
    const auto scale = static_cast<Number>(real.scale), centre = static_cast<Number>(real.centre);
    const auto half_width = static_cast<Number>(0.5 * (real.upper - real.lower));
    const auto make_values = [=](auto value_of) {
        if (real.rounds)
            for (std::size_t p = 0; p < plans; ++p)
                values[p] = finished(rounded_whole(value_of(numbers[p])));
        else
            for (std::size_t p = 0; p < plans; ++p) values[p] = finished(value_of(numbers[p]));
    };
    using Range = solvers::RealHead::Range;
    if (real.range == Range::Bounded)
        make_values([=](float u) {
            return lower + (static_cast<Number>(clamped(u, -1.0f, 1.0f)) + 1) * half_width;
        });
    else if (real.range == Range::AboveLower)
        make_values([=](float u) { return lower + scale * static_cast<Number>(bent(u)); });
    else if (real.range == Range::BelowUpper)
        make_values([=](float u) { return upper - scale * static_cast<Number>(bent(u)); });
    else
        make_values([=](float u) { return centre + scale * static_cast<Number>(u); });
}

// Whether the bounds and the default are floats, which arithmetic of floats reaches.
inline bool is_short(const RealScale& real) {
    const auto is_float = [](double x) {
        return static_cast<double>(static_cast<float>(x)) == x;
    };
    if (!is_float(real.lower) || !is_float(real.upper) || !is_float(real.exact_default))
        return false;
    if (real.range != solvers::RealHead::Range::Bounded) return true;
    const auto half_width = static_cast<float>(0.5 * (real.upper - real.lower));
    return static_cast<float>(real.lower) + 2 * half_width == static_cast<float>(real.upper);
}

inline void real_values(const RealScale& real, const float* numbers, std::size_t plans,
                        double* values) {
    constexpr double greatest = std::numeric_limits<float>::max();
    const double least = clamped(real.least, -greatest, greatest);
    const double most = clamped(real.most, -greatest, greatest);
    if (is_short(real)) {
        const auto short_least = static_cast<float>(least), short_most = static_cast<float>(most);
        finish_values<float>(real, numbers, plans, values, [=](float value) {
            return static_cast<double>(clamped(value, short_least, short_most));
        });
        return;
    }
    const double lower = real.lower, upper = real.upper;
    const float short_default = real.short_default;
    const double exact_default = real.exact_default;
    finish_values<double>(real, numbers, plans, values, [=](double value) {
        const auto rounded = static_cast<float>(clamped(value, least, most));
        // The float next to a bound may lie beyond it.
        const double within = clamped(static_cast<double>(rounded), lower, upper);
        return rounded == short_default ? exact_default : within;
    });
}

inline constexpr PlanLoops loops{next_numbers,  draw_widths, next_ranks,  scale_numbers,
                                 count_reached, stretch,     keep_habits, real_values};
