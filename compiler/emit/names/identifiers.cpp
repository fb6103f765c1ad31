#include "emit/names/identifiers.hpp"

namespace rddlc::cpp {
namespace {

bool is_word_character(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
}

// No name of the user's has one at its end that does not come from here.
std::string unreserved(std::string name) {
    if (is_reserved(name)) name += '_';
    return name;
}

}  // namespace

std::string plain_identifier(std::string_view name) {
    std::string result;
    for (char c : name) {
        if (is_word_character(c)) {
            result += c;
        } else if (result.empty() || result.back() != '_') {
            result += '_';
        }
    }
    if (result.ends_with('_')) result.pop_back();
    // A leading underscore or digit is not ours to use.
    if (result.empty() || !is_word_character(result.front()) || result.front() <= '9') {
        result.insert(0, "x");
    }
    return result;
}

std::string identifier(std::string_view name) {
    return unreserved(plain_identifier(name));
}

std::string external_identifier(std::string_view name) {
    std::string result = plain_identifier(name);
    return is_keyword(result) ? result + '_' : result;
}

Scope::Scope(const Scope* outer, const std::vector<std::string>& names)
    : outer_(outer), taken_(names.begin(), names.end()) {}

std::string Scope::claim(std::string_view wish, Mark mark) {
    const std::string root = std::string(mark.before) + plain_identifier(wish);
    const auto numbered = [&](const std::string& number) {
        return unreserved(root + number + std::string(mark.after));
    };
    const std::string first = numbered("");
    std::string name = first;
    if (is_taken(name)) {
        int& number = last_number_.try_emplace(first, 1).first->second;
        do {
            name = numbered("_" + std::to_string(++number));
        } while (is_taken(name));
    }
    taken_.insert(name);
    claimed_.push_back({name, first});
    return name;
}

void Scope::release(std::size_t mark) {
    for (; claimed_.size() > mark; claimed_.pop_back()) {
        taken_.erase(claimed_.back().name);
        // "x_3" frees the number 3 again, so that sister blocks count alike.
        last_number_.erase(claimed_.back().unnumbered);
    }
}

bool Scope::is_taken(const std::string& name) const {
    return taken_.contains(name) || (outer_ && outer_->is_taken(name));
}

}  // namespace rddlc::cpp
