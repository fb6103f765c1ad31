#include "emit/identifiers.hpp"

#include <algorithm>

namespace rddlc::cpp {
namespace {

bool is_word_character(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
}

}  // namespace

std::string identifier(std::string_view name) {
    std::string result;
    for (char c : name) {
        if (is_word_character(c)) {
            result += c;
        } else if (result.empty() || result.back() != '_') {
            result += '_';
        }
    }
    // A leading underscore or digit is not ours to use.
    if (result.empty() || !is_word_character(result.front()) || result.front() <= '9') {
        result.insert(0, "x");
    }
    if (is_reserved(result)) result += '_';
    return result;
}

Scope::Scope(const Scope* outer, const std::vector<std::string>& names)
    : outer_(outer), taken_(names.begin(), names.end()) {}

std::string Scope::claim(std::string_view wish) {
    const std::string first = identifier(wish);
    std::string name = first;
    if (is_taken(name)) {
        int& number = last_number_.try_emplace(first, 1).first->second;
        do {
            name = first + (first.back() == '_' ? "" : "_") + std::to_string(++number);
        } while (is_taken(name));
    }
    taken_.insert(name);
    claimed_.push_back(name);
    return name;
}

void Scope::release(std::size_t mark) {
    for (; claimed_.size() > mark; claimed_.pop_back()) {
        taken_.erase(claimed_.back());
        // "x_3" frees the number 3 again, so that sister blocks count alike.
        const std::string& name = claimed_.back();
        const std::size_t underscore = name.rfind('_');
        if (underscore != std::string::npos) last_number_.erase(name.substr(0, underscore));
    }
}

bool Scope::is_taken(const std::string& name) const {
    return taken_.contains(name) || (outer_ && outer_->is_taken(name));
}

}  // namespace rddlc::cpp
