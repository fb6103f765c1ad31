// Traces: a header line and one JSON line a step (docs/traces.md).
#pragma once

#include "formats/records_json.hpp"

#include <rddl/simulator.h>

#include <nlohmann/json_fwd.hpp>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace rddlc::workbench {

struct TraceHeader {
    std::string problem;  // as the user named it
    std::vector<std::filesystem::path> files;
    std::string policy;
    std::string engine;
    std::uint64_t seed = 0;
    std::int64_t episodes = 0;
    std::int64_t horizon = 0;  // in force; 0: no horizon
};

// The object of a line of a trace. Throws a Failure without the place, which the caller adds.
nlohmann::json object_of_trace_line(std::string_view line);

// The reason why steps of a trace with this header cannot be made in the problem: another version
// of the format, or another problem. Missing members of the header are accepted.
std::optional<std::string> complaint_about_header(const nlohmann::json& header,
                                                  const rddl_problem& problem);
// The files whose text differs from all of the header's files.
std::vector<std::filesystem::path> changed_files(const nlohmann::json& header,
                                                 const std::vector<std::filesystem::path>& files);

// The header's line, with the line break.
std::string trace_header_line(const TraceHeader& header, const rddl_problem& problem);

// "terminated", "horizon", "invariant", "fault": names of the bits of `causes` as a JSON array.
std::string causes_json(std::uint8_t causes);

// How the records of a problem are written; made once, since a problem may have many values.
struct TraceFormat {
    explicit TraceFormat(const rddl_problem& problem)
        : state(problem, RDDL_STATE),
          action(problem, RDDL_ACTION),
          observation(problem, RDDL_OBSERVATION) {}

    RecordLayout state, action, observation;
};

// How many bytes a line with records of the problem has at most, as it is written here or by
// others, with blanks and more digits.
std::size_t longest_line(const TraceFormat& format);

// The lines of a batch's episodes while they run side by side.
class TraceLines {
  public:
    TraceLines(const rddl_simulator& simulator, const TraceFormat& format,
               std::int64_t environments);

    // Around a step: remember all states, and observations after it.
    void before_step(const rddl_batch& batch);
    void after_step(const rddl_batch& batch);
    // Then one line for each environment that was running; `i` is its place in the batch.
    void add(std::size_t i, std::int64_t episode, std::int64_t step, const std::byte* action,
             double reward, std::uint8_t causes);

    // The lines since it was asked last, episode by episode.
    std::string take();

  private:
    const rddl_simulator& simulator_;
    const TraceFormat& format_;
    const rddl_batch* batch_ = nullptr;  // the one that has just been stepped
    std::vector<std::byte> states_, next_states_, observations_;
    std::vector<std::string> lines_;  // one an environment
};

}  // namespace rddlc::workbench
