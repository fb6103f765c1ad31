#include "support/template_slots.hpp"

#include <algorithm>
#include <set>
#include <stdexcept>

namespace rddlc {

namespace {

constexpr std::string_view blanks = " \t";

// "prefix${name}rest"; `name` is empty when the text has no slot.
struct Slot {
    std::string_view prefix;
    std::string_view name;
    std::string_view rest;
};

Slot first_slot(std::string_view text) {
    const std::size_t begin = text.find("${");
    if (begin == std::string_view::npos) return {text, {}, {}};
    const std::size_t end = text.find('}', begin);
    if (end == std::string_view::npos || end == begin + 2)
        throw std::logic_error("template: malformed slot in line '" + std::string(text) + "'");
    return {text.substr(0, begin), text.substr(begin + 2, end - begin - 2), text.substr(end + 1)};
}

bool is_blank(std::string_view text) {
    return text.find_first_not_of(blanks) == std::string_view::npos;
}

class Filler {
  public:
    explicit Filler(const SlotValues& values) : values_(values) {}

    std::string fill(std::string_view skeleton) {
        std::string result;
        while (!skeleton.empty()) {
            const std::size_t end = std::min(skeleton.find('\n'), skeleton.size() - 1);
            const std::string_view line = skeleton.substr(0, end + 1);
            result += fill_line(line);
            skeleton.remove_prefix(line.size());
        }
        require_all_used();
        return result;
    }

  private:
    std::string fill_line(std::string_view line) {
        const bool has_break = line.ends_with('\n');
        const std::string_view content = has_break ? line.substr(0, line.size() - 1) : line;
        const Slot slot = first_slot(content);
        if (!slot.name.empty() && is_blank(slot.prefix) && is_blank(slot.rest))
            return indented(value_of(slot.name), slot.prefix);
        return fill_inside(content) + (has_break ? "\n" : "");
    }

    std::string fill_inside(std::string_view text) {
        std::string result;
        while (true) {
            const Slot slot = first_slot(text);
            result += slot.prefix;
            if (slot.name.empty()) return result;
            result += value_of(slot.name);
            text = slot.rest;
        }
    }

    static std::string indented(std::string_view value, std::string_view indentation) {
        std::string result;
        while (!value.empty()) {
            const std::size_t end = std::min(value.find('\n'), value.size());
            if (end > 0) result.append(indentation).append(value.substr(0, end));
            result += '\n';
            value.remove_prefix(std::min(end + 1, value.size()));
        }
        return result;
    }

    const std::string& value_of(std::string_view name) {
        const auto found = values_.find(name);
        if (found == values_.end())
            throw std::logic_error("template: no value for slot '" + std::string(name) + "'");
        used_.insert(found->first);
        return found->second;
    }

    void require_all_used() const {
        for (const auto& [name, value] : values_)
            if (!used_.contains(name))
                throw std::logic_error("template: no slot for value '" + name + "'");
    }

    const SlotValues& values_;
    std::set<std::string_view> used_;
};

}  // namespace

std::string fill_slots(std::string_view skeleton, const SlotValues& values) {
    return Filler(values).fill(skeleton);
}

}  // namespace rddlc
