#include "engines/interpreted_simulator.hpp"

#include "engines/constant_tables.hpp"
#include "engines/interpreted_details.hpp"
#include "ir/analysis.hpp"
#include "ir/interpreter.hpp"
#include "ir/layout.hpp"

#include <rddl/interface/abi.hpp>

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace rddlc::workbench {

namespace {

rddl_role role_of(Role role) {
    switch (role) {
        case Role::NonFluent:
            return RDDL_NON_FLUENT;
        case Role::State:
            return RDDL_STATE;
        case Role::Action:
            return RDDL_ACTION;
        case Role::Interm:
            return RDDL_INTERM;
        case Role::Derived:
            return RDDL_DERIVED;
        case Role::Observ:
            return RDDL_OBSERVATION;
    }
    return RDDL_NON_FLUENT;
}

rddl_scalar scalar_of(ir::Scalar scalar) {
    switch (scalar) {
        case ir::Scalar::Bool:
            return RDDL_BOOL;
        case ir::Scalar::Int:
            return RDDL_INT;
        case ir::Scalar::Real:
            return RDDL_REAL;
    }
    return RDDL_REAL;
}

// The description of a program. Its names and bounds are those of the program itself, which must
// stay where it is.
class Description {
  public:
    Description(const ir::Program& program, Sources sources, const InterpretedDetails* details)
        : program_(program), sources_(std::move(sources)), details_(details) {
        add_types();
        add_fluents();
        add_constants();
        add_conditions(program.preconditions, preconditions_);
        add_conditions(program.invariants, invariants_);
        add_conditions(program.terminations, terminations_);
        add_sites();
        add_policy();
    }
    Description(const Description&) = delete;
    Description& operator=(const Description&) = delete;

    rddl_problem problem(const std::byte* default_action) const {
        const auto record_size = [&](ir::Storage storage) {
            return static_cast<std::int64_t>(ir::record_layout(program_, storage).size);
        };
        const bool partially_observed = program_.partially_observed();
        return {.struct_size = sizeof(rddl_problem),
                .type_size = sizeof(rddl_type),
                .fluent_size = sizeof(rddl_fluent),
                .condition_size = sizeof(rddl_condition),
                .domain = program_.domain_name.c_str(),
                .instance = program_.instance_name.c_str(),
                .types = types_.data(),
                .type_count = static_cast<std::int32_t>(types_.size()),
                .fluents = fluents_.data(),
                .fluent_count = static_cast<std::int32_t>(fluents_.size()),
                .state_size = record_size(ir::Storage::State),
                .action_size = record_size(ir::Storage::Action),
                .observation_size =
                    record_size(partially_observed ? ir::Storage::Observation : ir::Storage::State),
                .interm_size = details_ ? static_cast<std::int64_t>(details_->interm_size()) : 0,
                .partially_observed = partially_observed,
                .stochastic = ir::is_stochastic(program_),
                .default_action = default_action,
                .horizon = program_.horizon,
                .discount = program_.discount,
                .max_nondef_actions = program_.max_nondef_actions.value_or(-1),
                .preconditions = preconditions_.conditions.data(),
                .precondition_count = preconditions_.count(),
                .invariants = invariants_.conditions.data(),
                .invariant_count = invariants_.count(),
                .terminations = terminations_.conditions.data(),
                .termination_count = terminations_.count(),
                .fingerprint = program_.fingerprint};
    }
    std::span<const rddl::Site> sites() const { return sites_of_program_; }
    std::span<const rddl::Constants> constants() const { return constants_.list(); }
    // Null without a policy block.
    const rddl_policy* policy() const { return policy_ ? &*policy_ : nullptr; }
    std::span<const rddl_type> types() const { return types_; }

  private:
    struct Conditions {
        std::vector<std::string> texts;
        std::vector<rddl_condition> conditions;

        std::int32_t count() const { return static_cast<std::int32_t>(conditions.size()); }
    };

    rddl_source source_of(Span span) const {
        const Position position = sources_.position(span);
        return {sources_[span.file].path().c_str(), position.line, position.column};
    }

    void add_types() {
        for (const ir::ObjectType& type : program_.types) {
            std::vector<const char*>& names = object_names_.emplace_back();
            for (const std::string& object : type.objects) names.push_back(object.c_str());
            types_.push_back({type.name.c_str(), names.data(),
                              static_cast<std::int64_t>(names.size()), type.enumerated});
        }
    }

    void add_fluents() {
        for (const ir::Fluent& fluent : program_.fluents) {
            const std::vector<std::int32_t>& parameters = parameter_types_.emplace_back(
                fluent.parameter_types.begin(), fluent.parameter_types.end());
            fluents_.push_back({.name = fluent.name.c_str(),
                                .role = role_of(fluent.role),
                                .scalar = scalar_of(fluent.scalar),
                                .range_type = fluent.object_type
                                                  ? static_cast<std::int32_t>(*fluent.object_type)
                                                  : -1,
                                .rank = static_cast<std::int32_t>(parameters.size()),
                                .parameter_types = parameters.data(),
                                .count = count_of(fluent),
                                .offset = -1,
                                .lower = fluent.lower->empty() ? nullptr : fluent.lower->data(),
                                .upper = fluent.upper->empty() ? nullptr : fluent.upper->data(),
                                .source = source_of(fluent.span)});
        }
        if (details_)
            for (std::size_t index = 0; index < fluents_.size(); ++index)
                fluents_[index].offset = details_->offset_of(index);
        add_offsets(ir::Storage::State);
        add_offsets(ir::Storage::Action);
        add_offsets(ir::Storage::Observation);
    }

    void add_constants() {
        for (std::size_t index = 0; index < program_.fluents.size(); ++index) {
            const ir::Fluent& fluent = program_.fluents[index];
            if (fluent.role == Role::NonFluent)
                constants_.add(static_cast<std::int32_t>(index), fluent.scalar, fluent.values);
        }
    }

    std::int64_t count_of(const ir::Fluent& fluent) const {
        std::int64_t count = 1;
        for (const std::uint32_t type : fluent.parameter_types)
            count *= static_cast<std::int64_t>(program_.types[type].objects.size());
        return count;
    }

    void add_offsets(ir::Storage storage) {
        for (const ir::Field& field : ir::record_layout(program_, storage).fields)
            if (const auto fluent = program_[field.buffer].fluent)
                fluents_[*fluent].offset = static_cast<std::int64_t>(field.offset);
    }

    void add_conditions(const std::vector<ir::Computation>& all, Conditions& out) {
        for (const ir::Computation& condition : all)
            out.texts.push_back(sources_.text_on_one_line(condition.span));
        for (std::size_t i = 0; i < all.size(); ++i)
            out.conditions.push_back({out.texts[i].c_str(), source_of(all[i].span)});
    }

    void add_sites() {
        for (const ir::Site& site : program_.sites) {
            std::vector<rddl::SiteVariable>& scope = scopes_.emplace_back();
            for (const ir::VariableId id : site.scope)
                scope.push_back({program_[id].name.c_str(), &types_[*program_[id].type]});
            sites_of_program_.push_back({source_of(site.span), site.what.c_str(), scope});
        }
    }

    void add_policy() {
        if (!program_.policy) return;
        const std::size_t memory_size = ir::record_layout(program_, ir::Storage::Memory).size;
        policy_ = {.struct_size = sizeof(rddl_policy),
                   .name = program_.policy->name.c_str(),
                   .source = source_of(program_.policy->span),
                   .memory_size = static_cast<std::int64_t>(memory_size),
                   .stochastic = ir::is_policy_stochastic(program_)};
    }

    const ir::Program& program_;
    Sources sources_;
    const InterpretedDetails* details_;
    std::vector<std::vector<const char*>> object_names_;
    std::vector<std::vector<std::int32_t>> parameter_types_;
    std::vector<std::vector<rddl::SiteVariable>> scopes_;
    std::vector<rddl_type> types_;
    std::vector<rddl_fluent> fluents_;
    std::vector<rddl::Site> sites_of_program_;
    ConstantTables constants_;
    std::optional<rddl_policy> policy_;
    Conditions preconditions_, invariants_, terminations_;
};

// A simulator and all that it refers to. The interpreter's program stays in its place on the heap
// when the interpreter moves.
struct Interpreted {
    Interpreted(ir::Interpreter interpreter, Sources sources, ExternalLibrary the_library,
                std::optional<ir::Details> the_details)
        : library(std::move(the_library)),
          details(the_details ? std::make_unique<InterpretedDetails>(*std::move(the_details),
                                                                     library.functions)
                              : nullptr),
          default_action(interpreter.action_size()),
          description(interpreter.program(), std::move(sources), details.get()),
          problem(description.problem(default_action.data())) {
        interpreter.default_action(default_action.data());
        if (details) details->name_scopes(description.types());
        const rddl::About about{problem, description.sites(), description.constants(),
                                description.policy(), details ? details->get() : nullptr};
        table.emplace(about, std::move(interpreter));
    }

    ExternalLibrary library;
    std::unique_ptr<InterpretedDetails> details;  // null without
    std::vector<std::byte> default_action;
    Description description;
    rddl_problem problem;
    std::optional<rddl::SimulatorTable<ir::Interpreter>> table;
};

}  // namespace

std::shared_ptr<const rddl_simulator> interpreted_simulator(ir::Program program, Sources sources,
                                                            ExternalLibrary library,
                                                            std::optional<ir::Details> details) {
    ir::Interpreter interpreter(std::move(program), library.functions);
    const auto owner = std::make_shared<Interpreted>(std::move(interpreter), std::move(sources),
                                                     std::move(library), std::move(details));
    return {owner, owner->table->get()};
}

}  // namespace rddlc::workbench
