#include "mutator.hpp"

#include <algorithm>
#include <cctype>
#include <utility>

namespace rddlc::fuzzing {
namespace {

constexpr std::size_t longest_slice = 30;  // tokens

enum class Kind { Blank, Word, Other };

Kind kind_of(char character) {
    const auto byte = static_cast<unsigned char>(character);
    if (std::isspace(byte)) return Kind::Blank;
    if (std::isalnum(byte) || character == '_' || character == '-' || character == '\'' ||
        character == '.' || character == '?' || character == '@') {
        return Kind::Word;
    }
    return Kind::Other;
}

std::string joined(const std::vector<std::string>& tokens) {
    std::string text;
    for (const std::string& token : tokens) text += token;
    return text;
}

}  // namespace

std::vector<std::string> tokens_of(std::string_view text) {
    std::vector<std::string> tokens;
    Kind last = Kind::Other;
    for (const char character : text) {
        const Kind kind = kind_of(character);
        if (tokens.empty() || kind != last || kind == Kind::Other) tokens.emplace_back();
        tokens.back() += character;
        last = kind;
    }
    return tokens;
}

Mutator::Mutator(std::vector<std::string> seeds, std::vector<std::string> words, std::uint64_t seed)
    : words_(std::move(words)), random_(seed) {
    for (const std::string& text : seeds) seeds_.push_back(tokens_of(text));
}

std::string Mutator::next() {
    Tokens tokens = any_seed();
    const std::size_t changes = 1 + below(1 + below(6));
    for (std::size_t i = 0; i < changes && !tokens.empty(); ++i) change(tokens);
    std::string text = joined(tokens);
    if (below(16) == 0 && !text.empty()) {
        text[below(text.size())] = static_cast<char>(below(256));
    }
    return text;
}

std::size_t Mutator::place_in(const Tokens& tokens) {
    std::size_t place = below(tokens.size());
    while (place + 1 < tokens.size() && kind_of(tokens[place][0]) == Kind::Blank) ++place;
    return place;
}

std::string Mutator::any_token(const Tokens& tokens) {
    if (below(3) == 0) return words_[below(words_.size())];
    const Tokens& source = below(4) == 0 ? any_seed() : tokens;
    return source[place_in(source)];
}

void Mutator::change(Tokens& tokens) {
    const std::size_t place = place_in(tokens);
    const auto at = [&] {
        return tokens.begin() + static_cast<std::ptrdiff_t>(place);
    };
    switch (below(7)) {
        case 0:
            tokens.erase(at());
            break;
        case 1:
            tokens.insert(at(), any_token(tokens));
            break;
        case 2:
            tokens.insert(at(), any_token(tokens) + " ");
            break;
        case 3:
            std::swap(tokens[place], tokens[place_in(tokens)]);
            break;
        case 4: {
            const std::size_t count = std::min(below(longest_slice), tokens.size() - place);
            tokens.erase(at(), at() + static_cast<std::ptrdiff_t>(count));
            break;
        }
        case 5:
            insert_slice(tokens, below(2) == 0 ? Tokens(tokens) : any_seed());
            break;
        default:
            tokens[place] = any_token(tokens);
    }
}

void Mutator::insert_slice(Tokens& tokens, const Tokens& source) {
    const std::size_t begin = below(source.size());
    const std::size_t end = std::min(source.size(), begin + below(longest_slice));
    const Tokens slice(source.begin() + static_cast<std::ptrdiff_t>(begin),
                       source.begin() + static_cast<std::ptrdiff_t>(end));
    tokens.insert(tokens.begin() + static_cast<std::ptrdiff_t>(below(tokens.size() + 1)),
                  slice.begin(), slice.end());
}

}  // namespace rddlc::fuzzing
