#include "check/casts.hpp"

#include "check/open_ends.hpp"
#include "check/types.hpp"
#include "support/match.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <utility>

namespace rddlc::checking {
namespace {

using Kind = model::ValueType::Kind;

// A place whose value has a forbidden type on some path.
struct Misfit {
    Span span;
    model::ValueType found;
    std::string hint = {};  // what is probably meant instead
};
using Misfits = std::vector<Misfit>;

std::string excerpt(const Context& context, Span span) {
    constexpr std::size_t longest = 40;
    std::string text;
    for (const char c : context.sources.text(span)) {
        const bool blank = c == ' ' || c == '\n' || c == '\t' || c == '\r';
        if (!blank) text += c;
        if (blank && !text.empty() && text.back() != ' ') text += ' ';
    }
    return text.size() <= longest ? text : text.substr(0, longest - 3) + "...";
}

std::string fault_message(Span span, model::ValueType found, const Need& need,
                          const Context& context) {
    return fmt::format("'{}' is {}, {} must be {}", excerpt(context, span),
                       describe(context, found), need.what, describe(context, need.type));
}

model::Expr fault_at(Span span, model::ValueType found, const Need& need, const Context& context) {
    return {need.type, span, model::TypeFault{fault_message(span, found, need, context)}};
}

bool keeps_type(Reduction op) {
    return op == Reduction::Sum || op == Reduction::Product || op == Reduction::Minimum ||
           op == Reduction::Maximum;
}

// ------------------------------------------------------------- reals that are declared so

// Finds the real interm-fluents that alone make an expression real: it is an int if they are
// declared so.
class DeclaredReals {
  public:
    explicit DeclaredReals(const Context& context) : context_(context) {}

    // Whether `e` would be an int.
    bool search(const model::Expr& e) {
        if (castable(e.type, model::int_type)) return true;
        return match(
            e.node, [&](const model::Convert& n) { return search(*n.operand); },
            [&](const model::Reference& n) { return note(n); },
            [&](const model::If& n) { return search(*n.then_branch) && search(*n.else_branch); },
            [&](const model::Switch& n) {
                return (!n.default_case || search(**n.default_case)) &&
                       std::ranges::all_of(
                           n.cases, [&](const auto& value) { return !value || search(**value); });
            },
            [&](const model::Apply& n) { return on_ints(n.op) && all(n.operands); },
            [&](const model::Aggregate& n) { return keeps_type(n.op) && search(*n.body); },
            [&](const model::Sample& n) { return is_delta(n.distribution) && all(n.parameters); },
            [](const auto&) { return false; });
    }

    const std::vector<std::string>& names() const { return names_; }

  private:
    bool all(const std::vector<model::Expr>& expressions) {
        return std::ranges::all_of(expressions, [&](const model::Expr& e) { return search(e); });
    }

    bool note(const model::Reference& reference) {
        const model::Fluent& fluent = context_.fluent(reference.fluent);
        if (fluent.role != Role::Interm && fluent.role != Role::Derived) return false;
        if (std::ranges::find(names_, fluent.name) == names_.end()) names_.push_back(fluent.name);
        return true;
    }

    const Context& context_;
    std::vector<std::string> names_;
};

// A real interm-fluent may be whole by its definition; its type is the declared one all the same.
std::string hint_for_declared_reals(const model::Expr& e, const Need& need,
                                    const Context& context) {
    if (need.type != model::int_type || e.type != model::real_type) return "";
    DeclaredReals reals(context);
    if (!reals.search(e) || reals.names().empty()) return "";
    const bool is_one = reals.names().size() == 1;
    return fmt::format("if '{}' {} always whole, declare {} as int",
                       fmt::join(reals.names(), "' and '"), is_one ? "is" : "are",
                       is_one ? "it" : "them");
}

// ------------------------------------------------------------------------------- narrowing

// Rewrites an expression to a lower type, as if each operation worked on what its operands really
// are: `if (c) then 1 else 2.5` is int where c holds.
class Narrowing {
  public:
    Narrowing(const Need& need, const Context& context) : need_(need), context_(context) {}

    // Nothing if no path gives the type. Misfits on other paths become faults.
    Typed at(model::Expr e, model::ValueType to) {
        if (castable(e.type, to)) return convert(std::move(e), to);
        const Span span = e.span;
        return match(
            std::move(e.node), [&](model::Convert&& n) { return at(std::move(*n.operand), to); },
            [&](model::If&& n) { return if_(std::move(n), span, to); },
            [&](model::Switch&& n) { return switch_(std::move(n), span, to); },
            [&](model::Apply&& n) { return apply(std::move(n), span, to); },
            [&](model::Aggregate&& n) { return aggregate(std::move(n), span, to); },
            [&](model::Sample&& n) { return delta(std::move(n), span, to); },
            [&](model::External&& n) -> Typed {
                // The type of an external function's result is not checked, but it is never known
                // to be an object.
                if (is_object(to)) return std::nullopt;
                return model::Expr{to, span, std::move(n)};
            },
            [](auto&&) -> Typed { return std::nullopt; });
    }

    const Misfits& misfits() const { return misfits_; }

  private:
    model::Expr branch(model::ExprBox&& box, model::ValueType to, bool& fits) {
        const Span span = box->span;
        const model::ValueType found = natural_type(*box);
        std::string hint = hint_for_declared_reals(*box, need_, context_);
        const std::size_t before = misfits_.size();
        if (Typed narrowed = at(std::move(*box), to)) {
            fits = true;
            return std::move(*narrowed);
        }
        misfits_.resize(before);
        misfits_.push_back({span, found, std::move(hint)});
        return fault_at(span, found, need_, context_);
    }

    // The type before it was promoted to match the other branches.
    static model::ValueType natural_type(const model::Expr& e) {
        const auto* cast = std::get_if<model::Convert>(&e.node);
        return cast ? cast->operand->type : e.type;
    }

    Typed if_(model::If&& n, Span span, model::ValueType to) {
        bool fits = false;
        model::Expr then_branch = branch(std::move(n.then_branch), to, fits);
        model::Expr else_branch = branch(std::move(n.else_branch), to, fits);
        if (!fits) return std::nullopt;
        return model::Expr{
            to, span,
            model::If{std::move(n.condition), std::move(then_branch), std::move(else_branch)}};
    }

    Typed switch_(model::Switch&& n, Span span, model::ValueType to) {
        bool fits = false;
        for (std::optional<model::ExprBox>& value : n.cases)
            if (value) value = branch(std::move(*value), to, fits);
        if (n.default_case) n.default_case = branch(std::move(*n.default_case), to, fits);
        if (!fits) return std::nullopt;
        return model::Expr{to, span, std::move(n)};
    }

    Typed apply(model::Apply&& n, Span span, model::ValueType to) {
        const std::optional<Operator> op = on_ints(n.op);
        if (!op || to != model::int_type) return std::nullopt;
        for (model::Expr& operand : n.operands) {
            Typed narrowed = at(std::move(operand), to);
            if (!narrowed) return std::nullopt;
            operand = std::move(*narrowed);
        }
        return model::Expr{to, span, model::Apply{*op, std::move(n.operands)}};
    }

    Typed aggregate(model::Aggregate&& n, Span span, model::ValueType to) {
        if (!keeps_type(n.op) || to != model::int_type) return std::nullopt;
        Typed body = at(std::move(*n.body), to);
        if (!body) return std::nullopt;
        return model::Expr{to, span,
                           model::Aggregate{n.op, std::move(n.variables), std::move(*body)}};
    }

    Typed delta(model::Sample&& n, Span span, model::ValueType to) {
        if (!is_delta(n.distribution)) return std::nullopt;
        Typed value = at(std::move(n.parameters[0]), to);
        if (!value) return std::nullopt;
        n.parameters[0] = std::move(*value);
        return model::Expr{to, span, std::move(n)};
    }

    const Need& need_;
    const Context& context_;
    Misfits misfits_;
};

// The body of an aggregation may have taken in what was meant to be compared with it.
std::string hint_for_open_end(Span span, model::ValueType found, const Need& need,
                              const Scope& scope) {
    if (need.type != model::bool_type || is_object(found)) return "";
    return hint_for_comparison_in_body(span, scope);
}

void warn(const Misfit& misfit, const Need& need, Scope& scope) {
    std::string meant = misfit.hint.empty()
                            ? hint_for_open_end(misfit.span, misfit.found, need, scope)
                            : misfit.hint;
    if (meant.empty()) meant = need.hint;
    scope.context.report(diagnose(type_fault, misfit.span,
                                  fault_message(misfit.span, misfit.found, need, scope.context))
                             .with_hint("a run that gets here stops with a fault" +
                                        (meant.empty() ? "" : "; " + meant)));
}

std::string hint_for(model::ValueType found, const Need& need) {
    if (!need.hint.empty()) return need.hint;
    if (need.type == model::bool_type && !is_object(found))
        return "compare it with something, as in '... > 0'";
    if (need.type == model::int_type && found == model::real_type)
        return "'round[...]', 'floor[...]' and 'ceil[...]' give an int; '/' always gives a real, "
               "'div[a, b]' an int";
    return "";
}

void report_misfit(Span span, model::ValueType found, const Need& need, Scope& scope,
                   std::string hint) {
    if (hint.empty()) hint = hint_for_open_end(span, found, need, scope);
    Diagnostic diagnostic{
        need.code, span,
        fmt::format("{} must be {}, found {}", need.what, describe(scope.context, need.type),
                    describe(scope.context, found))};
    if (need.note) diagnostic.notes.push_back(*need.note);
    diagnostic.hint = hint.empty() ? hint_for(found, need) : std::move(hint);
    scope.context.report(std::move(diagnostic));
}

}  // namespace

bool is_object(model::ValueType type) {
    return type.kind == Kind::Object;
}

bool castable(model::ValueType from, model::ValueType to) {
    if (is_object(from) || is_object(to)) return from == to;
    return from.kind <= to.kind;
}

model::ValueType promoted(model::ValueType a, model::ValueType b) {
    return {std::max(a.kind, b.kind)};
}

model::Expr convert(model::Expr expression, model::ValueType to) {
    if (expression.type == to) return expression;
    const Span span = expression.span;
    return {to, span, model::Convert{std::move(expression)}};
}

Typed try_require(model::Expr expression, const Need& need, Scope& scope) {
    Narrowing narrowing(need, scope.context);
    Typed result = narrowing.at(std::move(expression), need.type);
    if (result)
        for (const Misfit& misfit : narrowing.misfits()) warn(misfit, need, scope);
    return result;
}

Typed require(Typed expression, const Need& need, Scope& scope) {
    if (!expression) return std::nullopt;
    const Span span = expression->span;
    const model::ValueType found = expression->type;
    std::string hint = hint_for_declared_reals(*expression, need, scope.context);
    Typed result = try_require(std::move(*expression), need, scope);
    if (!result) report_misfit(span, found, need, scope, std::move(hint));
    return result;
}

Typed require_bool(Typed expression, std::string what, Scope& scope) {
    return require(std::move(expression), {model::bool_type, std::move(what), bool_needed}, scope);
}

Typed require_int(Typed expression, std::string what, Scope& scope) {
    return require(std::move(expression), {model::int_type, std::move(what), int_needed}, scope);
}

Typed require_number(Typed expression, std::string_view what, Scope& scope) {
    if (!expression || !is_object(expression->type)) return expression;
    scope.context.report({number_needed, expression->span,
                          fmt::format("{} must be a number or a bool, found {}", what,
                                      describe(scope.context, expression->type))});
    return std::nullopt;
}

Typed require_real(Typed expression, std::string_view what, Scope& scope) {
    Typed number = require_number(std::move(expression), what, scope);
    if (!number) return std::nullopt;
    return convert(std::move(*number), model::real_type);
}

model::Expr fault_instead_of(const model::Expr& expression, const Need& need, Scope& scope) {
    warn({expression.span, expression.type, {}}, need, scope);
    return fault_at(expression.span, expression.type, need, scope.context);
}

}  // namespace rddlc::checking
