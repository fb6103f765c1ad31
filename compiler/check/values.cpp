#include "check/values.hpp"

#include "check/initial_draws.hpp"
#include "check/names.hpp"
#include "check/types.hpp"
#include "support/match.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <unordered_map>
#include <utility>

namespace rddlc::checking {
namespace {

using Kind = model::ValueType::Kind;

std::optional<model::Value> cast(bool value, Kind kind) {
    switch (kind) {
        case Kind::Bool:
            return value;
        case Kind::Int:
            return std::int64_t{value};
        case Kind::Real:
            return value ? 1.0 : 0.0;
        case Kind::Object:
            break;
    }
    return std::nullopt;
}

std::optional<model::Value> cast(std::int64_t value, Kind kind) {
    if (kind == Kind::Int) return value;
    if (kind == Kind::Real) return static_cast<double>(value);
    return std::nullopt;
}

std::optional<model::Value> cast(double value, Kind kind) {
    if (kind == Kind::Real) return value;
    return std::nullopt;
}

std::string fluent_is(const model::Fluent& fluent, const Context& context) {
    if (fluent.range.kind == Kind::Object)
        return fmt::format("'{}' takes objects of type '{}'", fluent.name,
                           context.type(fluent.range.type).name);
    return fmt::format("'{}' is {}", fluent.name, describe(context, fluent.range));
}

void report_value(Code code, Span span, const model::Fluent& fluent, std::string found, Hint hint,
                  Context& context) {
    context.report(
        diagnose(code, span, fmt::format("{}, found {}", fluent_is(fluent, context), found))
            .note(fluent.span, "declared here")
            .with_hint(std::move(hint)));
}

template <class T>
std::optional<model::Value> cast_or_report(T value, std::string_view type, Span span,
                                           const model::Fluent& fluent, Code code,
                                           Context& context) {
    std::optional<model::Value> result = cast(value, fluent.range.kind);
    if (!result)
        report_value(code, span, fluent,
                     fmt::format("the {} '{}'", type, context.sources.text(span)), "", context);
    return result;
}

// Without "@".
Span name_of_symbol(const ast::Symbol& symbol, Span span) {
    if (symbol.at_sign) ++span.begin;
    return span;
}

std::optional<model::Value> object_value(const ast::Symbol& symbol, Span span,
                                         const model::Fluent& fluent, Code code, Context& context) {
    const Object* object = find(context.names.objects, symbol.name);
    if (!object && fluent.range.kind == Kind::Object &&
        (context.names.broken_types.contains(fluent.range.type) ||
         context.names.open_types.contains(fluent.range.type)))
        return std::nullopt;
    if (object && fluent.range == model::ValueType{Kind::Object, object->type})
        return model::Value{object->index};
    const std::string found =
        object ? fmt::format("'{}' of type '{}'", symbol.name, context.type(object->type).name)
               : fmt::format("the unknown name '{}'", symbol.name);
    Hint hint;
    if (!object && fluent.range.kind == Kind::Object)
        hint = suggestion_or_list(context, symbol.name, name_of_symbol(symbol, span),
                                  context.type(fluent.range.type).objects);
    else if (!object)
        hint = hint_for_bool(symbol.name, span);
    report_value(code, span, fluent, found, std::move(hint), context);
    return std::nullopt;
}

}  // namespace

std::optional<model::Value> value_of(const ast::Constant& constant, const model::Fluent& fluent,
                                     Code code, Context& context) {
    const auto infinite = [&](std::string_view text) -> std::optional<model::Value> {
        report_value(code, constant.span, fluent, fmt::format("'{}'", text),
                     "values are finite: write a large number", context);
        return std::nullopt;
    };
    return match(
        constant.value,
        [&](const ast::Boolean& n) {
            return cast_or_report(n.value, "bool", constant.span, fluent, code, context);
        },
        [&](const ast::Integer& n) {
            return cast_or_report(n.value, "int", constant.span, fluent, code, context);
        },
        [&](const ast::Real& n) {
            return cast_or_report(n.value, "real", constant.span, fluent, code, context);
        },
        [&](const ast::PosInf&) { return infinite("pos-inf"); },
        [&](const ast::NegInf&) { return infinite("neg-inf"); },
        [&](const ast::Symbol& n) {
            return object_value(n, constant.span, fluent, code, context);
        });
}

namespace {

// The instance's values of one fluent: the assignments by the groundings that they set.
using Given = std::unordered_map<std::int64_t, const ast::Assignment*>;

struct Section {
    std::string_view name;  // "init-state", "non-fluents"
    Role role;              // of the fluents it may set
};

class Assigner {
  public:
    explicit Assigner(Context& context) : context_(context), given_(context.model.fluents.size()) {}

    void assign_all(const std::vector<ast::Assignment>& assignments, const Section& section) {
        for (const ast::Assignment& assignment : assignments) assign(assignment, section);
    }

    void report_missing(model::FluentId id) const {
        const model::Fluent& fluent = context_.fluent(id);
        const bool from_instance = fluent.role == Role::NonFluent || fluent.role == Role::State;
        if (!from_instance || fluent.default_value || faulty_.contains(id)) return;
        const Given& given = given_[id];
        const std::int64_t missing = fluent.values.size() - std::ssize(given);
        std::vector<std::string> first;
        for (std::int64_t i = 0; first.size() < examples_shown && i < fluent.values.size(); ++i) {
            if (!given.contains(i)) first.push_back(grounded_name(fluent, i));
        }
        if (missing > 0) report_missing(fluent, missing, first);
    }

  private:
    static constexpr std::size_t examples_shown = 3;

    void assign(const ast::Assignment& assignment, const Section& section) {
        const model::FluentId* id = settable(assignment, section);
        if (!id || context_.names.broken_fluents.contains(*id)) return;
        model::Fluent& fluent = context_.model.fluents[*id];
        const std::optional<std::int64_t> place = place_of(assignment, fluent);
        if (!place) {
            faulty_.insert(*id);
            return;
        }
        Given& given = given_[*id];
        const ast::Assignment* earlier = std::exchange(given[*place], &assignment);
        if (draw_of(assignment)) {
            if (earlier) report_conflict(assignment, *earlier, fluent, *place);
            check_initial_draw(assignment, *id, grounded_name(fluent, *place), context_);
            return;
        }
        const std::optional<model::Value> value = value_assigned(assignment, fluent);
        if (!value) return;
        if (earlier && (draw_of(*earlier) || *value != fluent.values[*place]))
            report_conflict(assignment, *earlier, fluent, *place);
        fluent.values.set(*place, *value);
    }

    void report_conflict(const ast::Assignment& assignment, const ast::Assignment& earlier,
                         const model::Fluent& fluent, std::int64_t place) {
        context_.report(diagnose(conflicting_values, assignment.span,
                                 fmt::format("'{}' is set twice, to different values",
                                             grounded_name(fluent, place)))
                            .note(earlier.span, "first set here"));
    }

    const model::FluentId* settable(const ast::Assignment& assignment, const Section& section) {
        const std::string& name = assignment.name.text;
        const model::FluentId* id = find(context_.names.fluents, name);
        if (!id) {
            context_.report(
                diagnose(not_settable, assignment.name.span,
                         fmt::format("there is no {} '{}'", name_of(section.role), name))
                    .with_hint(suggestion(context_, name, assignment.name.span,
                                          [&] { return names_of(section.role); })));
            return nullptr;
        }
        const model::Fluent& fluent = context_.fluent(*id);
        if (fluent.role == section.role || context_.names.broken_fluents.contains(*id)) return id;
        context_.report(
            diagnose(not_settable, assignment.name.span,
                     fmt::format("'{}' is {}; '{}' sets {}s only", name, with_article(fluent.role),
                                 section.name, name_of(section.role)))
                .note(fluent.span, "declared here"));
        return nullptr;
    }

    std::vector<std::string> names_of(Role role) const {
        std::vector<std::string> names;
        for (const model::Fluent& fluent : context_.model.fluents)
            if (fluent.role == role) names.push_back(fluent.name);
        return names;
    }

    // The row-major index of the grounding.
    std::optional<std::int64_t> place_of(const ast::Assignment& assignment,
                                         const model::Fluent& fluent) {
        if (assignment.arguments.size() != fluent.parameters.size()) {
            report_argument_count(assignment, fluent);
            return std::nullopt;
        }
        std::int64_t place = 0;
        bool valid = true;
        for (std::size_t i = 0; i < fluent.parameters.size(); ++i) {
            const model::TypeId type = fluent.parameters[i];
            const Object* object = find(context_.names.objects, assignment.arguments[i].name);
            const bool fits = object && object->type == type;
            if (!fits && !context_.names.broken_types.contains(type))
                report_argument(assignment, i, fluent, object);
            valid = valid && fits;
            if (fits) place = place * std::ssize(context_.type(type).objects) + object->index;
        }
        if (!valid) return std::nullopt;
        return place;
    }

    void report_argument_count(const ast::Assignment& assignment, const model::Fluent& fluent) {
        std::vector<std::string> types;
        for (const model::TypeId type : fluent.parameters)
            types.push_back(context_.type(type).name);
        const std::string list = types.empty() ? "" : fmt::format(" ({})", fmt::join(types, ", "));
        context_.report(diagnose(wrong_grounding, assignment.span,
                                 fmt::format("'{}' takes {}{}, found {}", fluent.name,
                                             counted(types.size(), "argument"), list,
                                             assignment.arguments.size()))
                            .note(fluent.span, "declared here"));
    }

    void report_argument(const ast::Assignment& assignment, std::size_t i,
                         const model::Fluent& fluent, const Object* object) {
        const model::Type& expected = context_.type(fluent.parameters[i]);
        const std::string& name = assignment.arguments[i].name;
        const std::string found =
            object ? fmt::format("'{}' is of type '{}'", name, context_.type(object->type).name)
                   : fmt::format("there is no object '{}'", name);
        context_.report(
            diagnose(wrong_grounding, assignment.argument_spans[i],
                     fmt::format("argument {} of '{}' is of type '{}', but {}", i + 1, fluent.name,
                                 expected.name, found))
                .note(fluent.span, "declared here")
                .with_hint(object ? Hint{}
                                  : suggestion(context_, name,
                                               name_of_symbol(assignment.arguments[i],
                                                              assignment.argument_spans[i]),
                                               [&] { return expected.objects; })));
    }

    std::optional<model::Value> value_assigned(const ast::Assignment& assignment,
                                               const model::Fluent& fluent) {
        if (assignment.value)
            return value_of(std::get<ast::Constant>(*assignment.value), fluent, wrong_value,
                            context_);
        const ast::Constant truth{ast::Boolean{!assignment.negated}, assignment.span};
        return value_of(truth, fluent, wrong_value, context_);
    }

    // p(a, b)
    std::string grounded_name(const model::Fluent& fluent, std::int64_t place) const {
        std::string arguments;
        for (auto type = fluent.parameters.rbegin(); type != fluent.parameters.rend(); ++type) {
            const std::vector<std::string>& objects = context_.type(*type).objects;
            const std::string& object =
                objects[static_cast<std::size_t>(place % std::ssize(objects))];
            place /= std::ssize(objects);
            arguments = arguments.empty() ? object : object + ", " + arguments;
        }
        return arguments.empty() ? fluent.name : fmt::format("{}({})", fluent.name, arguments);
    }

    void report_missing(const model::Fluent& fluent, std::int64_t missing,
                        const std::vector<std::string>& first) const {
        const std::string_view section = fluent.role == Role::State ? "init-state" : "non-fluents";
        std::string message =
            fmt::format("'{}' has neither a default nor a value in the instance", fluent.name);
        if (!fluent.parameters.empty())
            message = fmt::format(
                "'{}' has no default, and the instance gives no value to {} of its {} groundings: "
                "{}{}",
                fluent.name, missing, fluent.values.size(), fmt::join(first, ", "),
                missing > std::ssize(first) ? ", ..." : "");
        context_.report(
            diagnose(missing_values, fluent.span, message)
                .with_hint(fmt::format("give the values in the instance's '{}', or a default here",
                                       section)));
    }

    Context& context_;
    std::vector<Given> given_;                    // by fluent; empty where nothing is given
    std::unordered_set<model::FluentId> faulty_;  // with an assignment that names no grounding
};

model::Value zero_of(Kind kind) {
    if (kind == Kind::Bool) return false;
    if (kind == Kind::Real) return 0.0;
    return std::int64_t{0};
}

void fill_with_defaults(Context& context) {
    for (model::FluentId id = 0; id < context.model.fluents.size(); ++id) {
        model::Fluent& fluent = context.model.fluents[id];
        const bool has_values = fluent.role == Role::NonFluent || fluent.role == Role::State ||
                                fluent.role == Role::Action;
        if (!has_values || context.names.broken_fluents.contains(id)) continue;
        fill_with_default(fluent, context);
    }
}

}  // namespace

void fill_with_default(model::Fluent& fluent, Context& context) {
    fluent.values = Table(context.model.grounding_count(fluent),
                          fluent.default_value.value_or(zero_of(fluent.range.kind)));
}

void assign_values(const Blocks& blocks, Context& context) {
    fill_with_defaults(context);
    Assigner assigner(context);
    if (blocks.non_fluents)
        assigner.assign_all(blocks.non_fluents->assignments, {"non-fluents", Role::NonFluent});
    if (blocks.init_state)
        assigner.assign_all(blocks.init_state->assignments, {"init-state", Role::State});
    for (model::FluentId id = 0; id < context.model.fluents.size(); ++id) {
        const bool is_state = context.fluent(id).role == Role::State;
        if (is_state ? blocks.instance != nullptr : blocks.has_objects) assigner.report_missing(id);
    }
}

}  // namespace rddlc::checking
