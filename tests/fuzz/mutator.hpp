// Damages RDDL: token by token, so that much of it still parses, and now and then byte by byte.
#pragma once

#include <cstdint>
#include <random>
#include <string>
#include <string_view>
#include <vector>

namespace rddlc::fuzzing {

// Words, numbers, operators and runs of blanks; joined they are the text.
std::vector<std::string> tokens_of(std::string_view text);

class Mutator {
  public:
    // `words` are the language's; names and numbers come from the seeds.
    Mutator(std::vector<std::string> seeds, std::vector<std::string> words, std::uint64_t seed);

    // One of the seeds, changed in a few places.
    std::string next();

  private:
    using Tokens = std::vector<std::string>;

    std::size_t below(std::size_t bound) { return random_() % bound; }
    // The place of a token, blanks excepted.
    std::size_t place_in(const Tokens& tokens);
    const Tokens& any_seed() { return seeds_[below(seeds_.size())]; }
    std::string any_token(const Tokens& tokens);
    void change(Tokens& tokens);
    void insert_slice(Tokens& tokens, const Tokens& source);

    std::vector<Tokens> seeds_;
    std::vector<std::string> words_;
    std::mt19937_64 random_;
};

}  // namespace rddlc::fuzzing
