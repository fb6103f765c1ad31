// Recorded transitions: each line of a trace is one by itself (docs/traces.md).
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

struct Transition {
    std::vector<std::byte> state, action, next;  // records; values are finite
    std::optional<double> reward;                // absent where the line has no reward
};

class TransitionReader {
  public:
    // `name` is the file's in messages. `simulator` must outlive it.
    TransitionReader(const rddl_simulator& simulator, std::string name);

    // The transition of the next line of the file. Headers, blank lines and steps that faulted have
    // none. Throws a Failure with file, line and member if the line is not a whole transition, a
    // value is not finite, or an action is outside of its bounds.
    std::optional<Transition> read(std::string_view line);

    std::int64_t faulted() const { return faulted_; }  // steps that were left out

  private:
    std::vector<std::byte> record_of(const RecordLayout& layout, const nlohmann::json& line,
                                     const char* member, std::vector<std::byte> record) const;
    void require_all(const RecordLayout& layout, const nlohmann::json& line, const char* member,
                     bool only_reals) const;
    void require_finite(const RecordLayout& layout, const std::vector<std::byte>& record,
                        const char* member) const;
    void require_bounds(const std::vector<std::byte>& action) const;
    std::optional<double> reward_of(const nlohmann::json& line) const;
    [[noreturn]] void fail(const std::string& message, const std::string& hint = {}) const;

    const rddl_problem& problem_;
    std::string name_;
    RecordLayout states_, actions_;
    std::int64_t line_ = 0;  // the number of the last one, from 1 on
    std::int64_t faulted_ = 0;
};

}  // namespace rddlc::workbench
