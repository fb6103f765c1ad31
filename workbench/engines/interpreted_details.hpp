// Intermediate values of a step, by the interpreter.
#pragma once

#include "ir/details.hpp"
#include "ir/interpreter.hpp"

#include <rddl/interface/details.hpp>
#include <rddl/simulator.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace rddlc::workbench {

class InterpretedDetails {
  public:
    // The functions are by ExternalId.
    InterpretedDetails(ir::Details details, ir::ExternalFunctions functions);
    InterpretedDetails(const InterpretedDetails&) = delete;

    // The offset of an interm- or derived-fluent in a record; -1 for others.
    std::int64_t offset_of(std::size_t fluent) const;
    std::size_t interm_size() const { return interm_size_; }

    // The descriptions of the program's types, which must outlive this.
    void name_scopes(std::span<const rddl_type> types);
    const rddl::Details* get() const { return &details_; }

  private:
    std::vector<ir::ConditionTable> preconditions_;
    std::size_t interm_size_;
    ir::Interpreter interpreter_;
    std::vector<std::vector<rddl::SiteVariable>> scopes_;
    std::vector<rddl::ConditionPlaces> places_;
    rddl::Details details_;
};

}  // namespace rddlc::workbench
