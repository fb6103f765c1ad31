// PlanLoops for one instruction set. Included once for each, within a namespace of its own;
// includes nothing that would be compiled for it.

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

// Calls body(first, n) for each period, and for what is left of one in the end.
template <class Body>
inline void for_each_period(std::size_t period, std::size_t count, Body body) {
    for (std::size_t first = 0; first < count; first += period)
        body(first, count - first < period ? count - first : period);
}

// Draws so many numbers from the first one on, whose scales begin at `at`.
inline void draw_part(const NumberNoise& noise, const NumberScales& scales, std::size_t at,
                      std::size_t first, std::size_t count, float* __restrict values,
                      float* __restrict numbers, float* __restrict mirrored) {
    const float *const old = noise.old + first, *const fresh = noise.fresh + first;
    const float *const drawn = noise.drawn + first, *const widths = noise.widths + first;
    const float *const means = scales.means + at, *const deviations = scales.deviations + at;
    const float *const least = scales.least + at, *const most = scales.most + at;
    for (std::size_t k = 0; k < count; ++k) {
        const float value = old[k] * values[k] + fresh[k] * drawn[k];
        const float away = deviations[k] * widths[k] * value;
        values[k] = value;
        numbers[k] = clamped(means[k] + away, least[k], most[k]);
        mirrored[k] = clamped(means[k] - away, least[k], most[k]);
    }
}

// The same of whole periods. Blocks of the same place of a period follow each other, so that what
// belongs to a place stays in registers.
inline void draw_periods(const NumberNoise& noise, const NumberScales& scales, std::size_t count,
                         float* __restrict values, float* __restrict numbers,
                         float* __restrict mirrored) {
    const float *const old = noise.old, *const fresh = noise.fresh;
    const float *const drawn = noise.drawn, *const widths = noise.widths;
    for (std::size_t at = 0; at < scales.period; at += repetitions) {
        float mean[repetitions], deviation[repetitions], least[repetitions], most[repetitions];
        for (std::size_t i = 0; i < repetitions; ++i) {
            mean[i] = scales.means[at + i];
            deviation[i] = scales.deviations[at + i];
            least[i] = scales.least[at + i];
            most[i] = scales.most[at + i];
        }
        for (std::size_t k = at; k < count; k += scales.period)
            for (std::size_t i = 0; i < repetitions; ++i) {
                const float value = old[k + i] * values[k + i] + fresh[k + i] * drawn[k + i];
                const float away = deviation[i] * widths[k + i] * value;
                values[k + i] = value;
                numbers[k + i] = clamped(mean[i] + away, least[i], most[i]);
                mirrored[k + i] = clamped(mean[i] - away, least[i], most[i]);
            }
    }
}

inline void draw_numbers(const NumberNoise& noise, const NumberScales& scales, std::size_t first,
                         std::size_t count, float* values, float* numbers, float* mirrored) {
    const bool begins_period = first % scales.period == 0;
    const std::size_t whole = begins_period ? count / scales.period * scales.period : 0;
    draw_periods(noise, scales, whole, values, numbers, mirrored);
    for (std::size_t k = whole; k < count;) {
        const std::size_t at = (first + k) % scales.period, rest = scales.period - at;
        const std::size_t n = count - k < rest ? count - k : rest;
        draw_part(noise, scales, at, k, n, values + k, numbers + k, mirrored + k);
        k += n;
    }
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

inline float rounded_whole(float x) {
    return __builtin_nearbyintf(x);
}
inline double rounded_whole(double x) {
    return __builtin_nearbyint(x);
}

// The values of a period, in the precision of Number until they are finished. In place of softplus,
// values with one bound are 0, x, and between them the parabola that meets both with their slopes.
// It differs by 0.076 at most, and unlike softplus it reaches the bound. What is added to the base
// never has the other sign than the scale, since rounding keeps the order of products.
template <class Number, bool any_rounds, bool any_limits, class Finish>
inline void finish_values(const RealScales& reals, const RealScales::Values<Number>& values_of,
                          const float* numbers, std::size_t count, double* __restrict values,
                          Finish finished) {
    const Number *const base = values_of.base.data(), *const scale = values_of.scale.data();
    const Number *const bend = values_of.bend.data(), *const slope = values_of.slope.data();
    const Number* const bend_end = values_of.bend_end.data();
    const Number *const least = values_of.least.data(), *const most = values_of.most.data();
    const float* const rounds = reals.rounds.data();
    for (std::size_t k = 0; k < count; ++k) {
        const auto y = static_cast<Number>(numbers[k]);
        const Number t = y < bend_end[k] ? y : bend_end[k];
        Number value = base[k] + (scale[k] * y + t * (t * bend[k] - slope[k]));
        if constexpr (any_rounds) value = rounds[k] > 0 ? rounded_whole(value) : value;
        if constexpr (any_limits) value = clamped(value, least[k], most[k]);
        values[k] = finished(k, value);
    }
}

template <bool any_rounds>
inline void values_of_period(const RealScales& reals, const float* numbers, std::size_t count,
                             double* values) {
    if (reals.is_short) {
        finish_values<float, any_rounds, any_rounds>(
            reals, reals.short_values, numbers, count, values,
            [](std::size_t, float value) { return static_cast<double>(value); });
        return;
    }
    const double *const lower = reals.lower.data(), *const upper = reals.upper.data();
    const double* const exact_default = reals.exact_default.data();
    const float* const short_default = reals.short_default.data();
    finish_values<double, any_rounds, true>(
        reals, reals.long_values, numbers, count, values, [=](std::size_t k, double value) {
            const auto rounded = static_cast<float>(value);
            // The float next to a bound may lie beyond it.
            const double within = clamped(static_cast<double>(rounded), lower[k], upper[k]);
            return rounded == short_default[k] ? exact_default[k] : within;
        });
}

// The values of whole periods in floats, without roundings: the formula of finish_values(), in
// blocks as those of draw_periods().
inline void short_values_of_periods(const RealScales& reals, const float* __restrict numbers,
                                    std::size_t count, double* __restrict values) {
    const RealScales::Values<float>& values_of = reals.short_values;
    for (std::size_t at = 0; at < reals.period; at += repetitions) {
        float base[repetitions], scale[repetitions], bend[repetitions], slope[repetitions],
            bend_end[repetitions];
        for (std::size_t i = 0; i < repetitions; ++i) {
            base[i] = values_of.base[at + i];
            scale[i] = values_of.scale[at + i];
            bend[i] = values_of.bend[at + i];
            slope[i] = values_of.slope[at + i];
            bend_end[i] = values_of.bend_end[at + i];
        }
        for (std::size_t k = at; k < count; k += reals.period)
            for (std::size_t i = 0; i < repetitions; ++i) {
                const float y = numbers[k + i], t = y < bend_end[i] ? y : bend_end[i];
                values[k + i] =
                    static_cast<double>(base[i] + (scale[i] * y + t * (t * bend[i] - slope[i])));
            }
    }
}

inline void real_values(const RealScales& reals, const float* numbers, std::size_t count,
                        double* values) {
    const bool is_simple = reals.is_short && !reals.any_rounds;
    const std::size_t whole = is_simple ? count / reals.period * reals.period : 0;
    short_values_of_periods(reals, numbers, whole, values);
    numbers += whole;
    values += whole;
    count -= whole;
    for_each_period(reals.period, count, [&](std::size_t first, std::size_t n) {
        if (reals.any_rounds)
            values_of_period<true>(reals, numbers + first, n, values + first);
        else
            values_of_period<false>(reals, numbers + first, n, values + first);
    });
}

inline void add_moments(const Rows& rows, const float* centres, double* sums, double* squares) {
    for (std::size_t first = 0; first < rows.reals; first += slack) {
        const std::size_t width = rows.reals - first < slack ? rows.reals - first : slack;
        double centre[slack]{}, sum[slack]{}, square[slack]{};
        for (std::size_t k = 0; k < width; ++k) centre[k] = static_cast<double>(centres[first + k]);
        for (std::size_t c = 0; c < rows.count; ++c) {
            const float* const row = rows.first + rows.chosen[c] * rows.reals + first;
            const double weight = rows.weights[c];
            for (std::size_t k = 0; k < slack; ++k) {
                const double x = static_cast<double>(row[k]) - centre[k];
                sum[k] += weight * x;
                square[k] += weight * x * x;
            }
        }
        for (std::size_t k = 0; k < width; ++k) {
            sums[first + k] = sum[k];
            squares[first + k] = square[k];
        }
    }
}

inline std::size_t count_above(const double* values, std::size_t count, double limit) {
    std::int64_t above = 0;
    for (std::size_t k = 0; k < count; ++k) above += values[k] > limit ? 1 : 0;
    return static_cast<std::size_t>(above);
}

inline void count_before(const double* values, std::size_t count, std::size_t* before) {
    for (std::size_t i = 0; i < count; ++i) {
        const double value = values[i];
        std::int64_t sum = 0;
        for (std::size_t k = 0; k < i; ++k) sum += values[k] >= value ? 1 : 0;
        for (std::size_t k = i + 1; k < count; ++k) sum += values[k] > value ? 1 : 0;
        before[i] = static_cast<std::size_t>(sum);
    }
}

inline constexpr PlanLoops loops{draw_numbers, next_ranks,  count_reached, stretch,     keep_habits,
                                 real_values,  add_moments, count_above,   count_before};
