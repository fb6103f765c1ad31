// Philox4x32: a keyed bijection of 128-bit counters whose values pass as random bits.
// J. Salmon, M. Moraes, R. Dror, D. Shaw, "Parallel random numbers: as easy as 1, 2, 3", SC 2011.
//
// Written once for uint64_t and for packs of them (pack.hpp). A word of Philox is the lower half of
// such a number; whatever stands in its upper half is ignored.
#pragma once

#include <rddl/lanes/pack.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace rddl::philox {

template <class Word>
using Block = std::array<Word, 4>;
template <class Word>
using Key = std::array<Word, 2>;

// Philox passes BigCrush from 7 rounds on; 10 are its authors' margin (section 4 and table 2).
inline constexpr int draw_rounds = 7;
inline constexpr int key_rounds = 10;

constexpr std::uint64_t multiply_low_halves(std::uint64_t a, std::uint64_t b) {
    return (a & 0xFFFFFFFF) * (b & 0xFFFFFFFF);
}

constexpr std::uint64_t upper_halves(std::uint64_t a) {
    return a >> 32;
}

inline constexpr std::uint64_t first_multiplier = 0xD2511F53, second_multiplier = 0xCD9E8D57;

// Word by word, since compilers keep a block that is assigned as a whole in memory.
template <class Word>
RDDL_INLINE void do_round(Block<Word>& words, const Key<Word>& key) {
    const Word first = multiply_low_halves(words[0], Word{first_multiplier});
    const Word second = multiply_low_halves(words[2], Word{second_multiplier});
    words[0] = upper_halves(second) ^ words[1] ^ key[0];
    words[1] = second;
    words[2] = upper_halves(first) ^ words[3] ^ key[1];
    words[3] = first;
}

template <class Word>
RDDL_INLINE Key<Word> next_key(const Key<Word>& key) {
    return {key[0] + Word{std::uint64_t{0x9E3779B9}}, key[1] + Word{std::uint64_t{0xBB67AE85}}};
}

// The same key and counter always give the same four words.
template <int rounds, class Word>
RDDL_INLINE Block<Word> generate(Block<Word> counter, Key<Word> key) {
    for (int round = 0; round < rounds; ++round) {
        do_round(counter, key);
        key = next_key(key);
    }
    return counter;
}

// The part of generate() that is the same for all counters (first, second, third, 0) with the same
// key and first word: the keys of its rounds, and results that the other words do not reach within
// two rounds.
template <int rounds, class Word>
class Schedule {
  public:
    Schedule() = default;
    RDDL_INLINE Schedule(const Word& first, const Key<Word>& key) { begin(first, key); }
    // Begins a new schedule in place, word by word.
    RDDL_INLINE void begin(const Word& first, const Key<Word>& key) {
        const Word product = multiply_low_halves(first, Word{first_multiplier});
        const Word other_product =
            multiply_low_halves(upper_halves(product) ^ key[1], Word{second_multiplier});
        Key<Word> next = next_key(key);
        first_key_ = key[0];
        after_two_rounds_[0] = upper_halves(other_product) ^ next[0];
        after_two_rounds_[1] = other_product;
        after_two_rounds_[2] = product ^ next[1];
        for (Key<Word>& later : later_keys_) {
            next = next_key(next);
            later[0] = next[0];
            later[1] = next[1];
        }
    }

    // The block of a counter. Third, if not Word, is a number of which Word has several, or the
    // reverse; Result is the one of them that has more.
    template <class Third, class Result>
    RDDL_INLINE void generate(std::uint64_t second, const Third& third,
                              Block<Result>& words) const {
        do_two_rounds(second, third, words);
        for_each_later_key([&](const Key<Word>& key)
                               RDDL_INLINE_LAMBDA { do_round(words, to<Result>(key)); });
    }
    // The blocks of several counters, made in turns since each round waits for the one before it.
    template <class Result, std::size_t count>
    RDDL_INLINE void generate(const Result (&second)[count], const Result (&third)[count],
                              Block<Result> (&words)[count]) const {
        for (std::size_t i = 0; i < count; ++i) do_two_rounds(second[i], third[i], words[i]);
        for_each_later_key([&](const Key<Word>& key) RDDL_INLINE_LAMBDA {
            for (Block<Result>& each : words) do_round(each, to<Result>(key));
        });
    }
    // The blocks of neighbours, from `third` on, made in turns since each round waits for the one
    // before it.
    template <class Third, class Result, std::size_t count>
    RDDL_INLINE void generate(std::uint64_t second, const Third& third,
                              Block<Result> (&words)[count]) const {
        for (std::size_t i = 0; i < count; ++i)
            do_two_rounds(second, third + Third{std::uint64_t{i}}, words[i]);
        for_each_later_key([&](const Key<Word>& key) RDDL_INLINE_LAMBDA {
            for (Block<Result>& each : words) do_round(each, to<Result>(key));
        });
    }

  private:
    template <class Result>
    static RDDL_INLINE Key<Result> to(const Key<Word>& key) {
        return {Result(key[0]), Result(key[1])};
    }
    RDDL_INLINE Word with_first_key(std::uint64_t second) const {
        return Word{second} ^ first_key_;
    }
    template <class Second>
    RDDL_INLINE Second with_first_key(const Second& second) const {
        return second ^ Second(first_key_);
    }
    template <class Second, class Third, class Result>
    RDDL_INLINE void do_two_rounds(const Second& second, const Third& third,
                                   Block<Result>& words) const {
        const Third product = multiply_low_halves(third, Third{second_multiplier});
        const Result after_one = Result(upper_halves(product)) ^ Result(with_first_key(second));
        words[0] = Result(product) ^ Result(after_two_rounds_[0]);
        words[1] = Result(after_two_rounds_[1]);
        words[3] = multiply_low_halves(after_one, Result{first_multiplier});
        words[2] = upper_halves(words[3]) ^ Result(after_two_rounds_[2]);
    }
    // The keys are constants, so that all rounds are compiled one after the other.
    template <class Use>
    RDDL_INLINE void for_each_later_key(Use&& use) const {
        [&]<std::size_t... k>(std::index_sequence<k...>) RDDL_INLINE_LAMBDA {
            (use(later_keys_[k]), ...);
        }
        (std::make_index_sequence<rounds - 2>());
    }

    Word first_key_;
    std::array<Word, 3> after_two_rounds_;
    std::array<Key<Word>, rounds - 2> later_keys_;
};

}  // namespace rddl::philox
