#include "verify/verified_states.hpp"

#include "formats/line_stream.hpp"
#include "formats/trace.hpp"
#include "support/failure.hpp"
#include "support/json_text.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace rddlc::workbench {

namespace {

using nlohmann::json;

constexpr double infinity = std::numeric_limits<double>::infinity();

template <class T>
void store(Record& record, std::size_t offset, T value) {
    std::memcpy(record.data() + offset, &value, sizeof value);
}

bool is_number(const RecordEntry& entry) {
    return entry.fluent->scalar != RDDL_BOOL && !entry.objects;
}

double number_at(const Record& record, const RecordEntry& entry) {
    if (entry.fluent->scalar == RDDL_REAL) return value_at<double>(record.data(), entry);
    return static_cast<double>(value_at<std::int64_t>(record.data(), entry));
}

// `refuse` throws.
json read_line(const std::string& text, const auto& refuse) {
    json line;
    try {
        line = parse_json(text);
    } catch (const RefusedJson& error) {
        refuse(error.byte ? "it is not JSON" : error.what());
    }
    if (!line.is_object()) refuse("it is not a JSON object");
    return line;
}

}  // namespace

RandomStates::RandomStates(const RecordLayout& layout, std::uint64_t seed)
    : layout_(layout), random_(seed) {
    for (const RecordEntry& entry : layout.entries()) {
        const auto bound = [&](const double* bounds, double none) {
            return bounds ? bounds[entry.grounding] : none;
        };
        ranges_.push_back({infinity, -infinity, bound(entry.fluent->lower, -infinity),
                           bound(entry.fluent->upper, infinity)});
    }
}

void RandomStates::see(const Record& state) {
    for (std::size_t i = 0; i < ranges_.size(); ++i) {
        const RecordEntry& entry = layout_.entries()[i];
        if (!is_number(entry)) continue;
        const double value = number_at(state, entry);
        if (!std::isfinite(value)) continue;
        ranges_[i].low = std::min(ranges_[i].low, value);
        ranges_[i].high = std::max(ranges_[i].high, value);
    }
}

void RandomStates::shake(Record& state) {
    constexpr double shares[] = {0.02, 0.1, 0.3, 1.0};
    const double share = shares[random_() % std::size(shares)];
    for (std::size_t i = 0; i < ranges_.size(); ++i)
        if (happens(share)) shake(state, i);
}

void RandomStates::shake(Record& state, std::size_t index) {
    constexpr double largest_int = 9e15;
    const RecordEntry& entry = layout_.entries()[index];
    if (entry.fluent->scalar == RDDL_BOOL) {
        store<std::uint8_t>(state, entry.offset, happens(0.5) ? 1 : 0);
    } else if (entry.objects) {
        const auto count = static_cast<std::uint64_t>(entry.objects->object_count);
        if (count > 0) store(state, entry.offset, static_cast<std::int64_t>(random_() % count));
    } else if (entry.fluent->scalar == RDDL_INT) {
        const double value = std::round(number(ranges_[index]));
        store(state, entry.offset,
              static_cast<std::int64_t>(std::clamp(value, -largest_int, largest_int)));
    } else {
        store(state, entry.offset, number(ranges_[index]));
    }
}

// A sixth of the numbers are bounds.
double RandomStates::number(const Range& range) {
    const double margin = range.low > range.high ? 1 : 0.05 * (range.high - range.low) + 1;
    const double seen_low = range.low > range.high ? 0 : range.low;
    const double seen_high = range.low > range.high ? 0 : range.high;
    const double low = std::isfinite(range.least) ? range.least : seen_low - margin;
    const double high = std::isfinite(range.most) ? range.most : seen_high + margin;
    if (low > high) return low;
    const std::uint64_t which = random_() % 12;
    return which == 0 ? low : which == 1 ? high : between(low, high);
}

bool RandomStates::happens(double probability) {
    return between(0, 1) < probability;
}

// std::uniform_real_distribution is not used, since its numbers differ between libraries.
double RandomStates::between(double low, double high) {
    return low + (high - low) * (static_cast<double>(random_() >> 11) * 0x1p-53);
}

std::vector<RecordedState> read_states(const std::filesystem::path& file,
                                       const rddl_problem& problem, const Record& initial_state) {
    const RecordLayout states(problem, RDDL_STATE), actions(problem, RDDL_ACTION);
    const auto* const defaults = static_cast<const std::byte*>(problem.default_action);
    UsedFiles used;
    LineReader reader(file.string(), used, longest_line(TraceFormat(problem)));
    std::vector<RecordedState> recorded;
    std::int64_t number = 0;
    const auto refuse = [&](const std::string& why) {
        throw Failure(fmt::format("line {} of '{}': {}", number, file.string(), why),
                      "lines are those of a trace (rddl run P --trace FILE) or of rddl replay: "
                      "docs/traces.md");
    };
    const auto next_line = [&]() -> std::optional<std::string> {
        ++number;
        try {
            return reader.next();
        } catch (const LongLine& line) {
            refuse(line.what());
        }
        return std::nullopt;
    };
    while (const auto text = next_line()) {
        if (text->find_first_not_of(" \t\r") == std::string::npos) continue;
        const json line = read_line(*text, refuse);
        if (line.contains("rddl_trace")) {
            if (const auto complaint = complaint_about_header(line, problem)) refuse(*complaint);
            continue;
        }
        if (!line.contains("state")) refuse("it has no state");
        RecordedState& step = recorded.emplace_back(RecordedState{initial_state, {}});
        if (const auto message = states.read(line["state"], step.state.data())) refuse(*message);
        if (!line.contains("action")) continue;
        step.action = Record(defaults, defaults + problem.action_size);
        if (const auto message = actions.read(line["action"], step.action->data()))
            refuse(*message);
    }
    if (recorded.empty()) throw Failure(fmt::format("there is no state in '{}'", file.string()));
    return recorded;
}

}  // namespace rddlc::workbench
