#include "ast/equal.hpp"

#include <algorithm>
#include <tuple>

namespace rddlc::ast {

namespace {

// The fields of each struct that count: all except the spans.
auto fields(const Name& n) {
    return std::tie(n.text);
}
auto fields(const TypedVariable& v) {
    return std::tie(v.variable, v.type);
}
auto fields(const Boolean& b) {
    return std::tie(b.value);
}
auto fields(const Integer& i) {
    return std::tie(i.value);
}
auto fields(const Real& r) {
    return std::tie(r.text);
}
auto fields(const Variable& v) {
    return std::tie(v.name);
}
auto fields(const Literal& l) {
    return std::tie(l.name);
}
auto fields(const Reference& r) {
    return std::tie(r.name, r.primed, r.arguments);
}
auto fields(const Group& g) {
    return std::tie(g.square, g.inner);
}
auto fields(const Unary& u) {
    return std::tie(u.op, u.operand);
}
auto fields(const Binary& b) {
    return std::tie(b.op, b.ampersand, b.left, b.right);
}
auto fields(const Aggregation& a) {
    return std::tie(a.op, a.variables, a.body);
}
auto fields(const If& i) {
    return std::tie(i.condition, i.then_branch, i.else_branch);
}
auto fields(const SwitchCase& c) {
    return std::tie(c.label, c.value);
}
auto fields(const Switch& s) {
    return std::tie(s.subject, s.cases);
}
auto fields(const Call& c) {
    return std::tie(c.function, c.arguments);
}
auto fields(const Distribution& d) {
    return std::tie(d.name, d.arguments);
}
auto fields(const LabelledWeight& w) {
    return std::tie(w.label, w.at_sign, w.weight);
}
auto fields(const DiscreteCases& d) {
    return std::tie(d.name, d.type, d.weights);
}
auto fields(const DiscreteOver& d) {
    return std::tie(d.name, d.variables, d.weight);
}
auto fields(const Determinant& d) {
    return std::tie(d.row, d.column, d.element);
}
auto fields(const MatrixFunction& m) {
    return std::tie(m.name, m.row, m.column, m.element);
}
auto fields(const Slot& s) {
    return std::tie(s.kind, s.name);
}
auto fields(const VectorReference& r) {
    return std::tie(r.name, r.slots);
}
auto fields(const External& e) {
    return std::tie(e.function, e.captured, e.arguments);
}
auto fields(const RandomVector& v) {
    return std::tie(v.name, v.axis, v.arguments);
}
auto fields(const Expr& e) {
    return std::tie(e.node);
}

auto fields(const TypeDeclaration& d) {
    return std::tie(d.name, d.members);
}
auto fields(const PosInf&) {
    return std::tuple<>();
}
auto fields(const NegInf&) {
    return std::tuple<>();
}
auto fields(const Symbol& s) {
    return std::tie(s.name, s.at_sign);
}
auto fields(const Constant& c) {
    return std::tie(c.value);
}
auto fields(const PVariable& p) {
    return std::tie(p.name, p.primed, p.parameters, p.kind, p.range, p.default_value, p.level);
}
auto fields(const Cpf& c) {
    return std::tie(c.name, c.primed, c.parameters, c.body);
}
auto fields(const Requirements& r) {
    return std::tie(r.names);
}
auto fields(const Types& t) {
    return std::tie(t.declarations);
}
auto fields(const PVariables& p) {
    return std::tie(p.declarations);
}
auto fields(const Cpfs& c) {
    return std::tie(c.keyword, c.definitions);
}
auto fields(const Reward& r) {
    return std::tie(r.value);
}
auto fields(const Constraints& c) {
    return std::tie(c.kind, c.conditions);
}
auto fields(const DomainSection& s) {
    return std::tie(s.node);
}
auto fields(const Domain& d) {
    return std::tie(d.name, d.sections);
}
auto fields(const Policy& p) {
    return std::tie(p.name, p.sections);
}

auto fields(const Assignment& a) {
    return std::tie(a.name, a.negated, a.arguments, a.value);
}
auto fields(const DomainName& d) {
    return std::tie(d.name);
}
auto fields(const NonFluentsName& n) {
    return std::tie(n.name);
}
auto fields(const ObjectList& l) {
    return std::tie(l.type, l.objects);
}
auto fields(const Objects& o) {
    return std::tie(o.lists);
}
auto fields(const NonFluentValues& v) {
    return std::tie(v.assignments);
}
auto fields(const InitState& s) {
    return std::tie(s.assignments);
}
auto fields(const MaxNondefActions& m) {
    return std::tie(m.value);
}
auto fields(const Horizon& h) {
    return std::tie(h.value);
}
auto fields(const Discount& d) {
    return std::tie(d.value);
}
auto fields(const InstanceSection& s) {
    return std::tie(s.node);
}
auto fields(const NonFluents& n) {
    return std::tie(n.name, n.sections);
}
auto fields(const Instance& i) {
    return std::tie(i.name, i.sections);
}
auto fields(const Program& p) {
    return std::tie(p.blocks);
}

template <class T>
concept Plain = std::is_arithmetic_v<T> || std::is_enum_v<T> || std::is_same_v<T, std::string>;

template <Plain T>
bool same(const T& a, const T& b) {
    return a == b;
}

// All overloads are declared before the first is used: they call each other.
template <class T>
bool same(const Box<T>& a, const Box<T>& b);
template <class T>
bool same(const std::optional<T>& a, const std::optional<T>& b);
template <class T>
bool same(const std::vector<T>& a, const std::vector<T>& b);
template <class... Ts>
bool same(const std::variant<Ts...>& a, const std::variant<Ts...>& b);

template <class Struct>
requires requires(const Struct& s) {
    fields(s);
}
bool same(const Struct& a, const Struct& b) {
    return std::apply(
        [&](const auto&... left) {
            return std::apply([&](const auto&... right) { return (same(left, right) && ...); },
                              fields(b));
        },
        fields(a));
}

template <class T>
bool same(const Box<T>& a, const Box<T>& b) {
    return same(*a, *b);
}

template <class T>
bool same(const std::optional<T>& a, const std::optional<T>& b) {
    return a.has_value() == b.has_value() && (!a || same(*a, *b));
}

template <class T>
bool same(const std::vector<T>& a, const std::vector<T>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [](const T& left, const T& right) { return same(left, right); });
}

template <class... Ts>
bool same(const std::variant<Ts...>& a, const std::variant<Ts...>& b) {
    if (a.index() != b.index()) return false;
    return std::visit(
        [&](const auto& left) { return same(left, std::get<std::decay_t<decltype(left)>>(b)); }, a);
}

}  // namespace

bool equal(const Program& a, const Program& b) {
    return same(a, b);
}
bool equal(const Expr& a, const Expr& b) {
    return same(a, b);
}

}  // namespace rddlc::ast
