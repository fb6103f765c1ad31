// Types and their objects.
#pragma once

#include "check/blocks.hpp"
#include "check/context.hpp"

namespace rddlc::checking {

// Types in the order of declaration, objects in the order written.
void declare_types(const Blocks& blocks, Context& context);

// The type of that name; reports an unknown name.
std::optional<model::TypeId> resolve_type(const ast::Name& name, Context& context);

// "bool", "int", "real", "an object of type 'res'": as in "found ...".
std::string describe(const Context& context, model::ValueType type);

}  // namespace rddlc::checking
