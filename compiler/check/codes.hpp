// The checker's diagnostic codes. docs/diagnostics/ explains each to the user.
#pragma once

#include "support/diagnostic.hpp"

namespace rddlc::checking {

// 02xx: blocks, names, arity
inline constexpr Code unknown_name{'E', 201};
inline constexpr Code unknown_variable{'E', 202};
inline constexpr Code wrong_arity{'E', 203};
inline constexpr Code missing_block{'E', 204};
inline constexpr Code missing_section{'E', 205};
inline constexpr Code unsupported_horizon{'E', 206};
inline constexpr Code unknown_function{'E', 207};
inline constexpr Code unknown_aggregation{'E', 208};
inline constexpr Code wrong_call_arity{'E', 209};
inline constexpr Code repeated_type{'E', 210};
inline constexpr Code repeated_object{'E', 211};
inline constexpr Code type_without_objects{'E', 212};
inline constexpr Code unknown_type{'E', 213};
inline constexpr Code repeated_fluent{'E', 214};
inline constexpr Code illegal_fluent_name{'E', 215};
inline constexpr Code repeated_variable{'E', 216};
inline constexpr Code ambiguous_name{'E', 217};
inline constexpr Code object_in_domain{'E', 218};
inline constexpr Code unknown_literal{'E', 219};
inline constexpr Code misplaced_prime{'E', 220};
inline constexpr Code round_brackets{'E', 221};
inline constexpr Code one_variable_needed{'E', 222};
inline constexpr Code bad_label{'E', 223};
inline constexpr Code repeated_label{'E', 224};
inline constexpr Code missing_label{'E', 225};
inline constexpr Code bad_vector{'E', 226};
inline constexpr Code bad_matrix{'E', 227};
inline constexpr Code illegal_declaration{'E', 228};
inline constexpr Code bad_policy{'E', 229};
inline constexpr Code too_many_groundings{'E', 230};
inline constexpr Code ambiguous_groundings{'E', 231};

inline constexpr Code repeated_section{'W', 201};
inline constexpr Code unused_fluent{'W', 202};
inline constexpr Code unused_variable{'W', 203};
inline constexpr Code long_body{'W', 204};
inline constexpr Code other_domain{'W', 205};
inline constexpr Code ignored_objects{'W', 206};
inline constexpr Code other_non_fluents{'W', 207};
inline constexpr Code assumed_non_fluents{'W', 208};

// 03xx: types
inline constexpr Code bool_needed{'E', 301};
inline constexpr Code int_needed{'E', 302};
inline constexpr Code number_needed{'E', 303};
inline constexpr Code not_comparable{'E', 304};
inline constexpr Code branches_differ{'E', 305};
inline constexpr Code wrong_argument_type{'E', 306};
inline constexpr Code wrong_cpf_type{'E', 307};
inline constexpr Code bad_switch_subject{'E', 308};
inline constexpr Code not_enumerated{'E', 309};
inline constexpr Code empty_scope{'E', 310};
inline constexpr Code bad_default{'E', 311};
inline constexpr Code object_action{'E', 312};

inline constexpr Code type_fault{'W', 301};
inline constexpr Code constant_condition{'W', 302};
inline constexpr Code compared_comparison{'W', 303};
inline constexpr Code compared_literals{'W', 304};

// 04xx: CPFs and their dependencies
inline constexpr Code missing_cpf{'E', 401};
inline constexpr Code undeclared_cpf{'E', 402};
inline constexpr Code repeated_cpf{'E', 403};
inline constexpr Code wrong_cpf_arity{'E', 404};
inline constexpr Code forgotten_prime{'E', 405};
inline constexpr Code cpf_not_allowed{'E', 406};
inline constexpr Code cyclic_cpfs{'E', 407};
inline constexpr Code illegal_dependency{'E', 408};

inline constexpr Code constraints_not_enforced{'W', 401};
inline constexpr Code derived_is_interm{'W', 402};

// 05xx: values given by the instance
inline constexpr Code not_settable{'E', 501};
inline constexpr Code wrong_grounding{'E', 502};
inline constexpr Code wrong_value{'E', 503};
inline constexpr Code conflicting_values{'E', 504};
inline constexpr Code missing_values{'E', 505};
inline constexpr Code objects_of_unknown_type{'E', 506};
inline constexpr Code extension_needed{'E', 507};

inline constexpr Code idle_action_limit{'W', 501};
inline constexpr Code large_discount{'W', 502};

}  // namespace rddlc::checking
