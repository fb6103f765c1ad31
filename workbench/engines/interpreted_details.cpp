#include "engines/interpreted_details.hpp"

#include "ir/layout.hpp"

#include <algorithm>
#include <utility>

namespace rddlc::workbench {

namespace {

std::int64_t offset_in_record(const ir::Program& program, ir::BufferId buffer) {
    const ir::RecordLayout layout = ir::record_layout(program, ir::Storage::Observation);
    const auto field = std::ranges::find(layout.fields, buffer, &ir::Field::buffer);
    return field == layout.fields.end() ? -1 : static_cast<std::int64_t>(field->offset);
}

void compute(const void* self, const std::byte* state, const std::byte* action, std::byte* scratch,
             std::byte* record, rddl::Context<rddl::Scalar>& context) {
    static_cast<const ir::Interpreter*>(self)->step(state, action, scratch, nullptr, record,
                                                    context);
}

}  // namespace

InterpretedDetails::InterpretedDetails(ir::Details details, ir::ExternalFunctions functions)
    : preconditions_(details.preconditions),
      interm_size_(ir::interm_size(details)),
      interpreter_(std::move(details.program), std::move(functions)) {
    const ir::Program& program = interpreter_.program();
    details_.interm_size = interm_size_;
    details_.record_size = ir::record_layout(program, ir::Storage::Observation).size;
    details_.scratch_size = interpreter_.scratch_size();
    details_.compute = compute;
    details_.self = &interpreter_;
}

std::int64_t InterpretedDetails::offset_of(std::size_t fluent) const {
    const auto buffer = interpreter_.program().fluents[fluent].buffer;
    return buffer ? offset_in_record(interpreter_.program(), *buffer) : -1;
}

void InterpretedDetails::name_scopes(std::span<const rddl_type> types) {
    const ir::Program& program = interpreter_.program();
    for (const ir::ConditionTable& condition : preconditions_) {
        std::vector<rddl::SiteVariable>& scope = scopes_.emplace_back();
        for (const ir::VariableId id : condition.scope)
            scope.push_back({program[id].name.c_str(), &types[*program[id].type]});
    }
    for (std::size_t k = 0; k < preconditions_.size(); ++k)
        places_.push_back({offset_in_record(program, preconditions_[k].holds), scopes_[k]});
    details_.preconditions = places_;
}

}  // namespace rddlc::workbench
