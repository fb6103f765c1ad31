// A step as rddlc emits them, over the registers of any library: random words by Philox, a
// comparison into a mask, masked selects, a sine and cosine by polynomials, and a gather.
//
// A library is a struct of types and functions: Real and Word (64 bits), `width`, and what has no
// operator in all of them.
#pragma once

constexpr std::size_t environments = 1024;
constexpr std::size_t table_size = 64;

struct Records {
    std::vector<double> place, speed, reward;
    std::array<double, table_size> table;

    Records() : place(environments), speed(environments), reward(environments) {
        for (std::size_t i = 0; i < environments; ++i) place[i] = 1e-3 * static_cast<double>(i);
        for (std::size_t i = 0; i < table_size; ++i) table[i] = 1e-2 * static_cast<double>(i);
    }
};

template <class L>
[[gnu::always_inline]] inline std::array<typename L::Word, 4> philox(
    std::array<typename L::Word, 4> counter, std::uint64_t key) {
    for (int round = 0; round < 7; ++round) {
        const auto first = L::multiply_low_halves(counter[0], L::word(0xD2511F53));
        const auto second = L::multiply_low_halves(counter[2], L::word(0xCD9E8D57));
        counter = {L::high_half(second) ^ counter[1] ^ L::word(key), second,
                   L::high_half(first) ^ counter[3] ^ L::word(key >> 32), first};
        key += 0xBB67AE859E3779B9;
    }
    return counter;
}

template <class L>
[[gnu::always_inline]] inline void step_register(Records& records, std::size_t at,
                                                 std::uint64_t time) {
    const auto words =
        philox<L>({L::counting(at), L::word(time), L::word(3), L::word(0)}, 0x123456789ABCDEF);
    const auto draw = L::unit_real(words[0]);
    const auto x = L::load(&records.place[at]);
    const auto v = L::load(&records.speed[at]);
    const auto z = x * x;
    const auto sine =
        x + x * z * (L::real(-1.0 / 6) + z * (L::real(1.0 / 120) - z * L::real(1.0 / 5040)));
    const auto cosine =
        L::real(1) - z * (L::real(0.5) - z * (L::real(1.0 / 24) - z * L::real(1.0 / 720)));
    const auto slip = L::gather(records.table.data(), words[1] & L::word(table_size - 1));
    const auto force = L::select(L::less(draw, L::real(0.3)), L::real(-1), L::real(1));
    const auto faster = v + L::real(0.02) * (force + L::real(9.8) * sine - slip * cosine * v);
    const auto moved = x + L::real(0.02) * faster;
    const auto lost = L::less(L::real(1.5), moved * moved);
    L::store(L::select(lost, L::real(0), moved), &records.place[at]);
    L::store(L::select(lost, L::real(0), faster), &records.speed[at]);
    L::store(L::select(lost, L::real(0), L::real(1)), &records.reward[at]);
}

// Sixteen environments at a time, in as many registers as that takes.
template <class L>
[[gnu::noinline]] void step(Records& records, std::uint64_t time) {
    for (std::size_t at = 0; at < environments; at += 16)
#pragma GCC unroll 8
        for (std::size_t part = 0; part < 16; part += L::width)
            step_register<L>(records, at + part, time);
}
