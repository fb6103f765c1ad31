#include "ground/declare.hpp"

#include "model/fingerprint.hpp"

#include <rddl/values/moderate.hpp>

#include <utility>

namespace rddlc::grounding {
namespace {

ir::Storage policy_storage_of(Role role) {
    if (role == Role::State) return ir::Storage::Memory;
    return role == Role::NonFluent ? ir::Storage::Constant : ir::Storage::Scratch;
}

ir::Storage storage_of(Role role) {
    switch (role) {
        case Role::NonFluent:
            return ir::Storage::Constant;
        case Role::State:
            return ir::Storage::State;
        case Role::Action:
            return ir::Storage::Action;
        case Role::Interm:
        case Role::Derived:
            return ir::Storage::Scratch;
        case Role::Observ:
            return ir::Storage::Observation;
    }
    return ir::Storage::Scratch;
}

bool is_object(model::ValueType type) {
    return type.kind == model::ValueType::Kind::Object;
}

ir::BufferId add_buffer(ir::Program& program, ir::Buffer buffer) {
    program.buffers.push_back(std::move(buffer));
    return {static_cast<std::uint32_t>(program.buffers.size() - 1)};
}

// A step finds its values in the records that it is given.
bool is_chosen_outside(const model::Fluent& fluent) {
    return fluent.role == Role::State || fluent.role == Role::Action;
}

ir::Buffer buffer_of(const model::Model& model, bool only_moderate, model::FluentId id) {
    const model::Fluent& fluent = model.fluents[id];
    const bool of_policy = model.is_of_policy(id);
    ir::Buffer buffer{
        .name = fluent.name,
        .storage = of_policy ? policy_storage_of(fluent.role) : storage_of(fluent.role),
        .scalar = scalar_of(fluent.range),
        .shape = {},
        .types = fluent.parameters,
        .fluent = of_policy ? std::nullopt : std::optional(id),
        .values = fluent.values,
        .span = fluent.span};
    if (only_moderate && is_chosen_outside(fluent) && buffer.scalar == ir::Scalar::Real)
        buffer.range = Range{-rddl::moderate, rddl::moderate};
    for (model::TypeId type : fluent.parameters) {
        buffer.shape.push_back(static_cast<std::int64_t>(model.types[type].objects.size()));
    }
    return buffer;
}

ir::Buffer next_of(ir::Buffer state) {
    state.storage =
        state.storage == ir::Storage::Memory ? ir::Storage::NextMemory : ir::Storage::Next;
    state.values = {};
    state.range = {};
    return state;
}

ir::Fluent description_of(const model::Fluent& fluent, ir::BufferId buffer) {
    return {
        .name = fluent.name,
        .role = fluent.role,
        .scalar = scalar_of(fluent.range),
        .object_type = is_object(fluent.range) ? std::optional(fluent.range.type) : std::nullopt,
        .parameter_types = fluent.parameters,
        .buffer = buffer,
        .span = fluent.span,
        .values = fluent.role == Role::NonFluent ? fluent.values : Table(),
        .lower = {},
        .upper = {}};
}

}  // namespace

ir::Scalar scalar_of(model::ValueType type) {
    switch (type.kind) {
        case model::ValueType::Kind::Bool:
            return ir::Scalar::Bool;
        case model::ValueType::Kind::Int:
            return ir::Scalar::Int;
        case model::ValueType::Kind::Real:
            return ir::Scalar::Real;
        case model::ValueType::Kind::Object:
            return ir::Scalar::Int;
    }
    return ir::Scalar::Int;
}

Declarations declare(const model::Model& model, bool only_moderate) {
    Declarations result;
    ir::Program& program = result.program;
    program.only_moderate = only_moderate;
    program.domain_name = model.domain_name;
    program.instance_name = model.instance_name;
    program.horizon = model.horizon;
    program.discount = model.discount;
    program.max_nondef_actions = model.max_nondef_actions;
    for (const model::Type& type : model.types) {
        program.types.push_back({type.name, type.enumerated, type.objects});
    }
    for (model::FluentId id = 0; id < model.fluents.size(); ++id) {
        const model::Fluent& fluent = model.fluents[id];
        FluentBuffers buffers{add_buffer(program, buffer_of(model, only_moderate, id)),
                              std::nullopt};
        if (fluent.role == Role::State) {
            buffers.next = add_buffer(program, next_of(buffer_of(model, only_moderate, id)));
        }
        if (!model.is_of_policy(id))
            program.fluents.push_back(description_of(fluent, buffers.current));
        result.buffers.push_back(buffers);
    }
    return result;
}

}  // namespace rddlc::grounding
