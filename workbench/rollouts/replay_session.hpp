// Answers the lines of `rddl replay` (docs/traces.md), one environment behind them.
#pragma once

#include "formats/records_json.hpp"
#include "rollouts/violations.hpp"
#include "solvers/batches/batch.hpp"
#include "support/failure.hpp"

#include <rddl/simulator.h>

#include <nlohmann/json_fwd.hpp>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace rddlc::workbench {

struct ReplayOptions {
    std::optional<std::uint64_t> seed = {};  // else that of the trace, else 0
    std::optional<std::int64_t> horizon =
        {};  // otherwise that of the trace, otherwise the instance's; 0: no horizon
    Preconditions preconditions = Preconditions::Ignore;
    // Explains the violation in one line; called for each violated precondition.
    std::function<std::string(const Violation&)> explain = {};
    // Sees the header of a trace.
    std::function<void(const nlohmann::json&)> see_header = {};
};

// The input is a trace of another problem, or in another version of the format: its lines cannot be
// understood.
struct ForeignTrace : Failure {
    using Failure::Failure;
};

class ReplaySession {
  public:
    // `simulator` must outlive the session.
    ReplaySession(const rddl_simulator& simulator, ReplayOptions options);

    // The answer with its line break; empty for blank lines and a trace's header, which stands
    // before all other lines. May throw a ForeignTrace.
    std::string answer(std::string_view line);
    // The answer to a line that cannot even be read.
    std::string refuse(std::string_view why);

  private:
    using Record = std::vector<std::byte>;

    // The request of a line, checked.
    struct Request {
        std::optional<std::int64_t> environment;  // to start an episode of
        bool reset = false;                       // start another episode of the same one
        bool steps = true;
        std::optional<Record> state;
        Record action;
        std::optional<std::int64_t> samples;
    };

    std::string answer_object(const nlohmann::json& line, bool is_first);
    std::string error_line(std::string_view message) const;
    void read_header(const nlohmann::json& header);
    Request read_request(const nlohmann::json& line) const;
    Record read_state(const nlohmann::json& values, bool fresh) const;
    Record read_action(const nlohmann::json& values) const;

    solvers::BatchHandle create(std::int64_t first, std::int64_t count, std::int64_t horizon) const;
    void prepare(const Request& request);
    void require_running() const;
    // Empty if the action is legal, else what is wrong; may replace it.
    std::string check_preconditions(Record& action) const;
    std::string explain(std::int32_t precondition, const Record& action) const;

    std::string describe_start() const;
    std::string step(const Record& action);
    std::string sample(const Record& action, std::int64_t count);
    void add_samples(std::string& out, const Record& action, std::int64_t count);
    void write_outcome(std::string& out, const rddl_batch& batch, std::int64_t place, double reward,
                       std::uint8_t causes) const;

    std::uint8_t causes() const;
    Record state() const;

    const rddl_simulator& simulator_;
    const rddl_problem& problem_;
    ReplayOptions options_;
    std::uint64_t seed_;
    std::int64_t horizon_;  // in force; 0: no horizon
    RecordLayout state_layout_, action_layout_, observation_layout_;
    std::int64_t line_ = 0;         // the number of the last one, from 1 on
    bool has_begun_ = false;        // some line was not blank
    std::int64_t environment_ = 0;  // identity of the one that is stepped
    std::int64_t next_sample_;      // identity of the next environment that draws a sample
    solvers::BatchHandle batch_;
    Record initial_state_;
};

}  // namespace rddlc::workbench
