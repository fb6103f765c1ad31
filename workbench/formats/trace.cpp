#include "formats/trace.hpp"

#include "driver/version.hpp"
#include "engines/faults.hpp"
#include "support/failure.hpp"
#include "support/json_text.hpp"
#include "support/sha256.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <map>
#include <set>
#include <string_view>

namespace rddlc::workbench {

namespace {

constexpr int format_version = 1;

// A text member of the header or of one of its files; empty if it is absent or not text.
std::string text_of(const nlohmann::json& object, const char* member) {
    const auto found = object.find(member);
    return found != object.end() && found->is_string() ? found->get<std::string>() : "";
}

std::set<std::string> hashes_of(const nlohmann::json& header) {
    std::set<std::string> hashes;
    const auto files = header.find("files");
    if (files == header.end() || !files->is_array()) return hashes;
    for (const auto& file : *files)
        if (file.is_object()) hashes.insert(text_of(file, "sha256"));
    return hashes;
}

// Bytes of its longest name.
std::size_t longest_object(const rddl_type& type) {
    std::size_t longest = 0;
    for (std::int64_t i = 0; i < type.object_count; ++i)
        longest = std::max(longest, std::string_view(type.objects[i]).size());
    return longest;
}

std::size_t longest_values(const RecordLayout& layout) {
    constexpr std::size_t longest_number = 24;
    std::map<const rddl_type*, std::size_t> of_type{{nullptr, longest_number}};
    std::size_t bytes = 0;
    for (const RecordEntry& entry : layout.entries()) {
        if (!of_type.contains(entry.objects))
            of_type[entry.objects] = longest_object(*entry.objects);
        bytes += entry.name.size() + of_type[entry.objects];
    }
    return bytes;
}

}  // namespace

nlohmann::json object_of_trace_line(std::string_view line) {
    nlohmann::json object;
    try {
        object = parse_json(line);
    } catch (const RefusedJson& refused) {
        if (!refused.byte) throw Failure(refused.what());
        const bool is_cut = line.front() == '{' && line.back() != '}';
        throw Failure(is_cut ? "the line is cut off in the middle: the trace is not complete"
                             : "this is not JSON");
    }
    if (!object.is_object()) throw Failure("the line is not a JSON object");
    return object;
}

std::optional<std::string> complaint_about_header(const nlohmann::json& header,
                                                  const rddl_problem& problem) {
    const auto& version_of_trace = header.at("rddl_trace");
    if (version_of_trace != format_version)
        return fmt::format("'rddl_trace' is {}; this program reads version {}",
                           json_line(version_of_trace), format_version);
    const auto differs = [&](const char* member, const char* ours) {
        const std::string theirs = text_of(header, member);
        return !theirs.empty() && theirs != ours;
    };
    if (!differs("domain", problem.domain) && !differs("instance", problem.instance))
        return std::nullopt;
    return fmt::format("the trace is of instance '{}' of domain '{}', not of '{}' of '{}'",
                       text_of(header, "instance"), text_of(header, "domain"), problem.instance,
                       problem.domain);
}

std::vector<std::filesystem::path> changed_files(const nlohmann::json& header,
                                                 const std::vector<std::filesystem::path>& files) {
    const std::set<std::string> known = hashes_of(header);
    std::vector<std::filesystem::path> changed;
    for (const auto& file : files) {
        // Text that came through a pipe cannot be read again.
        std::error_code ignored;
        const bool is_readable = std::filesystem::is_regular_file(file, ignored);
        if (is_readable && !known.empty() && !known.contains(sha256_of_file(file)))
            changed.push_back(file);
    }
    return changed;
}

std::string trace_header_line(const TraceHeader& header, const rddl_problem& problem) {
    nlohmann::ordered_json files = nlohmann::ordered_json::array();
    for (const auto& path : header.files)
        files.push_back({{"path", path.string()}, {"sha256", sha256_of_file(path)}});
    const nlohmann::ordered_json line{
        {"rddl_trace", format_version}, {"rddlc", version},
        {"problem", header.problem},    {"domain", problem.domain},
        {"instance", problem.instance}, {"files", files},
        {"policy", header.policy},      {"engine", header.engine},
        {"seed", header.seed},          {"episodes", header.episodes},
        {"horizon", header.horizon},    {"discount", problem.discount}};
    return json_line(line) + '\n';
}

std::string causes_json(std::uint8_t causes) {
    std::string out;
    const auto add = [&](int bit, const char* name) {
        if (causes & bit) out += (out.empty() ? "\"" : ",\"") + std::string(name) + '"';
    };
    add(RDDL_TERMINATED, "terminated");
    add(RDDL_TRUNCATED_HORIZON, "horizon");
    add(RDDL_TRUNCATED_INVARIANT, "invariant");
    add(RDDL_FAULTED, "fault");
    return '[' + out + ']';
}

std::size_t longest_line(const TraceFormat& format) {
    constexpr std::size_t all_else = std::size_t{1} << 20;  // also a header's names of files
    constexpr std::size_t margin = 4;
    const std::size_t states = 2 * longest_values(format.state);  // this one and the next
    return all_else +
           margin * (states + longest_values(format.action) + longest_values(format.observation));
}

TraceLines::TraceLines(const rddl_simulator& simulator, const TraceFormat& format,
                       std::int64_t environments)
    : simulator_(simulator),
      format_(format),
      states_(static_cast<std::size_t>(environments) * format_.state.size()),
      next_states_(states_.size()),
      observations_(static_cast<std::size_t>(environments) * format_.observation.size()),
      lines_(static_cast<std::size_t>(environments)) {}

void TraceLines::before_step(const rddl_batch& batch) {
    simulator_.get_state(&batch, 0, static_cast<std::int64_t>(lines_.size()), states_.data());
}

void TraceLines::after_step(const rddl_batch& batch) {
    batch_ = &batch;
    const auto count = static_cast<std::int64_t>(lines_.size());
    simulator_.get_state(&batch, 0, count, next_states_.data());
    if (simulator_.problem->partially_observed)
        simulator_.get_observation(&batch, 0, count, observations_.data());
}

void TraceLines::add(std::size_t i, std::int64_t episode, std::int64_t step,
                     const std::byte* action, double reward, std::uint8_t causes) {
    std::string& line = lines_[i];
    line += fmt::format(R"({{"episode":{},"step":{},"state":)", episode, step);
    format_.state.write(line, states_.data() + i * format_.state.size());
    line += R"(,"action":)";
    format_.action.write_changes(line, action,
                                 static_cast<const std::byte*>(simulator_.problem->default_action));
    line += R"(,"reward":)";
    write_real(line, reward);
    line += R"(,"next_state":)";
    format_.state.write(line, next_states_.data() + i * format_.state.size());
    line += R"(,"observation":)";
    if (simulator_.problem->partially_observed)
        format_.observation.write(line, observations_.data() + i * format_.observation.size());
    else
        line += "null";
    line += fmt::format(R"(,"terminated":{},"truncated":{},"causes":{})",
                        (causes & RDDL_TERMINATED) != 0, (causes & ~RDDL_TERMINATED) != 0,
                        causes_json(causes));
    if (causes & RDDL_FAULTED) {
        line += R"(,"fault":)";
        write_string(line, fault_text(simulator_, *batch_, static_cast<std::int64_t>(i)));
    }
    line += "}\n";
}

std::string TraceLines::take() {
    std::string all;
    for (std::string& lines : lines_) {
        all += lines;
        lines.clear();
    }
    return all;
}

}  // namespace rddlc::workbench
