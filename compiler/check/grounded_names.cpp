#include "check/grounded_names.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <set>
#include <tuple>
#include <utility>

namespace rddlc::checking {
namespace {

constexpr std::string_view separator = "__";

using Objects = std::vector<std::string>;
// Objects with the separator behind each, sorted.
using Words = std::vector<std::string>;

struct Pair {
    Objects first, second;  // different objects of one name
};

// Looks for two lists of objects, one for each parameter, that are one text when they are joined.
// Two texts are compared from left to right: one of them is ahead of the other by the rest of an
// object. The continuation depends on this rest and on how many objects both have, and no such
// state is visited twice.
class Search {
  public:
    // The words of each parameter; they outlive it.
    explicit Search(std::vector<const Words*> parameters) : parameters_(std::move(parameters)) {}

    std::optional<Pair> run() {
        const auto is_empty = [](const Words* words) {
            return words->empty();
        };
        if (std::ranges::any_of(parameters_, is_empty)) return std::nullopt;
        for (std::size_t k = 0; k < parameters_.size(); ++k) {
            for (const std::string& word : words_of(k)) {
                for (const std::string& shorter : beginnings(k, word)) {
                    Text ahead, behind;
                    for (std::size_t j = 0; j < k; ++j) {
                        ahead.push_back(words_of(j).front());
                        behind.push_back(words_of(j).front());
                    }
                    ahead.push_back(word);
                    behind.push_back(shorter);
                    if (meet(ahead, behind, word.substr(shorter.size()))) return found_;
                }
            }
        }
        return std::nullopt;
    }

  private:
    using Text = std::vector<std::string>;  // of words

    const Words& words_of(std::size_t parameter) const { return *parameters_[parameter]; }

    // Words of the parameter with which the text begins, shorter ones.
    Words beginnings(std::size_t parameter, const std::string& text) const {
        Words words;
        for (std::size_t end = text.find(separator); end != text.npos;
             end = text.find(separator, end + 1)) {
            const std::string word = text.substr(0, end + separator.size());
            if (word != text && std::ranges::binary_search(words_of(parameter), word))
                words.push_back(word);
        }
        return words;
    }

    // Whether both can be continued to be equal. `rest` is what the one behind lacks.
    bool meet(Text& ahead, Text& behind, const std::string& rest) {
        if (behind.size() == parameters_.size()) return false;
        if (!seen_.emplace(ahead.size(), behind.size(), rest).second) return false;
        const std::size_t next = behind.size();
        for (const std::string& word : beginnings(next, rest)) {
            behind.push_back(word);
            if (meet(ahead, behind, rest.substr(word.size()))) return true;
            behind.pop_back();
        }
        const Words& words = words_of(next);
        for (auto word = std::ranges::lower_bound(words, rest);
             word != words.end() && word->starts_with(rest); ++word) {
            behind.push_back(*word);
            const std::string overhang = word->substr(rest.size());
            if (overhang.empty() ? are_one(ahead, behind) : meet(behind, ahead, overhang))
                return true;
            behind.pop_back();
        }
        return false;
    }

    // Both texts are equal so far.
    bool are_one(Text& a, Text& b) {
        if (a.size() == b.size()) {
            for (std::size_t k = a.size(); k < parameters_.size(); ++k) {
                a.push_back(words_of(k).front());
                b.push_back(words_of(k).front());
            }
            found_ = {objects_of(a), objects_of(b)};
            return true;
        }
        return a.size() < b.size() ? meet(b, a, "") : meet(a, b, "");
    }

    static Objects objects_of(const Text& words) {
        Objects objects;
        for (const std::string& word : words)
            objects.push_back(word.substr(0, word.size() - separator.size()));
        return objects;
    }

    std::vector<const Words*> parameters_;
    std::set<std::tuple<std::size_t, std::size_t, std::string>> seen_;
    Pair found_;
};

bool has_separator(const std::string& object) {
    return object.find(separator) != object.npos || object.starts_with('_');
}

// The words of a type, and whether one of them has a separator inside.
struct NamesOfType {
    Words words;
    bool has_separators = false;
};

NamesOfType names_of(const model::Type& type) {
    NamesOfType names;
    names.has_separators = std::ranges::any_of(type.objects, has_separator);
    for (const std::string& object : type.objects)
        names.words.push_back(object + std::string(separator));
    std::ranges::sort(names.words);
    return names;
}

// The objects by which two groundings differ first.
std::pair<std::string, std::string> difference(const Pair& pair) {
    const auto [a, b] = std::ranges::mismatch(pair.first, pair.second);
    return {*a, *b};
}

void report(const model::Fluent& fluent, const Pair& pair, Context& context) {
    const auto written = [&](const Objects& objects) {
        return fmt::format("{}({})", fluent.name, fmt::join(objects, ", "));
    };
    const auto [longer, shorter] = difference(pair);
    context.report(
        diagnose(ambiguous_groundings, fluent.span,
                 fmt::format("'{}' and '{}' would have one name, '{}___{}'", written(pair.first),
                             written(pair.second), fluent.name, fmt::join(pair.first, "__")))
            .note(context.names.objects.at(longer).span, fmt::format("'{}' declared here", longer))
            .note(context.names.objects.at(shorter).span,
                  fmt::format("'{}' declared here", shorter))
            .with_hint("'__' and '___' separate the parts of grounded names: rename an object"));
}

}  // namespace

void check_grounded_names(Context& context) {
    std::vector<NamesOfType> types;
    for (const model::Type& type : context.model.types) types.push_back(names_of(type));
    std::map<std::vector<model::TypeId>, std::optional<Pair>> found;  // by parameters
    for (const model::Fluent& fluent : context.model.fluents) {
        const auto is_open = [&](model::TypeId type) {
            return context.names.open_types.contains(type);
        };
        if (std::ranges::any_of(fluent.parameters, is_open)) continue;
        const bool is_named = fluent.role == Role::State || fluent.role == Role::Action ||
                              fluent.role == Role::Observ;
        const auto has_separators = [&](model::TypeId type) {
            return types[type].has_separators;
        };
        if (!is_named || std::ranges::none_of(fluent.parameters, has_separators)) continue;
        const auto [pair, is_new] = found.try_emplace(fluent.parameters);
        if (is_new) {
            std::vector<const Words*> words;
            for (const model::TypeId type : fluent.parameters) words.push_back(&types[type].words);
            pair->second = Search(std::move(words)).run();
        }
        if (pair->second) report(fluent, *pair->second, context);
    }
}

}  // namespace rddlc::checking
