// The steps of an episode of a trace, read back into records (docs/traces.md).
#pragma once

#include "formats/records_json.hpp"

#include <rddl/simulator.h>

#include <nlohmann/json_fwd.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace rddlc::workbench {

struct TraceStep {
    std::int64_t number = 0;        // steps made in the episode before
    std::vector<std::byte> state;   // records
    std::vector<std::byte> action;  // of the state; empty: the episode ended here
    double reward = 0;              // of the action
    double total = 0;               // rewards of the steps before
    std::string end;                // why the episode ended here: "horizon", ...
};

class TraceSteps {
  public:
    // Reads the episode with that number, or the first one that comes. `name` is the file's in
    // messages. `simulator` must outlive it.
    TraceSteps(const rddl_simulator& simulator, std::optional<std::int64_t> episode,
               std::string name);

    // The next line of the file. Returns a state that is followed by an action, if the line holds
    // one. Throws a Failure with the line's number if it is not a step of this problem; `cut_off`
    // is asked for a line that lacks its line break.
    std::optional<TraceStep> read(std::string_view line);
    // The state that the last step led to, if the trace holds it.
    std::optional<TraceStep> last();
    bool has_last() const { return has_next_state_; }

    // The line that was read last is of another episode, which comes after steps of this one.
    bool is_over() const { return is_over_; }
    // Its episode is read from here on; the line is to be read again.
    void begin_next();

    std::optional<std::int64_t> episode() const { return episode_; }
    std::int64_t horizon() const {
        return horizon_;
    }  // of the header or the problem; 0: no horizon
    // "policy random, seed 0", from the header; empty if it does not say so.
    const std::string& course() const { return course_; }
    bool has_ended() const { return !end_.empty(); }  // the last step says so

  private:
    std::int64_t count_in(const nlohmann::json& line, const char* member,
                          std::int64_t otherwise) const;
    std::optional<TraceStep> read_object(const nlohmann::json& line);
    void read_record(const RecordLayout& layout, const nlohmann::json& line, const char* member,
                     std::vector<std::byte>& record) const;
    [[noreturn]] void fail(const std::string& message) const;

    const rddl_simulator& simulator_;
    const rddl_problem& problem_;
    std::optional<std::int64_t> episode_;
    std::string name_;
    RecordLayout state_layout_, action_layout_;
    std::int64_t line_ = 0;  // the number of the last one, from 1 on
    std::int64_t horizon_;
    std::string course_;
    std::vector<std::byte> state_;  // what the last step led to, or the initial state
    bool has_next_state_ = false;
    std::int64_t next_number_ = 0;
    double total_ = 0;
    std::string end_;
    bool is_over_ = false;
};

}  // namespace rddlc::workbench
