#include "solvers/cgp/formula.hpp"

#include <cmath>
#include <optional>

namespace rddlc::solvers {

namespace {

using Term = Formula::Term;

class Simplifier {
  public:
    Formula take() { return std::move(formula_); }
    Formula& formula() { return formula_; }

    int input(int number) {
        Term term;
        term.kind = Term::Kind::Input;
        term.input = number;
        return add(term);
    }
    int constant(double value) {
        Term term;
        term.constant = value == 0 ? 0 : value;  // no -0
        return add(term);
    }

    int call(Function function, int a, int b, int c) {
        const int arity = info_of(function).arity;
        const std::array<int, 3> all{a, arity > 1 ? b : -1, arity > 2 ? c : -1};
        if (const auto value = folded(function, arity, a, b, c)) return constant(*value);
        if (const auto simpler = rewritten(function, a, b, c)) return *simpler;
        Term term;
        term.kind = Term::Kind::Function;
        term.function = function;
        for (std::size_t k = 0; k < 3; ++k)
            term.arguments[k] = static_cast<int>(k) < arity ? all[k] : -1;
        return add(term);
    }

  private:
    int add(const Term& term) {
        const auto [place, is_new] =
            places_.try_emplace(term, static_cast<int>(formula_.terms.size()));
        if (is_new) formula_.terms.push_back(term);
        return place->second;
    }
    const Term& at(int term) const { return formula_.terms[static_cast<std::size_t>(term)]; }

    std::optional<double> value_of(int term) const {
        if (term < 0 || at(term).kind != Term::Kind::Constant) return std::nullopt;
        return at(term).constant;
    }
    bool is(int term, double value) const { return value_of(term) == value; }
    bool calls(int term, Function function) const {
        return at(term).kind == Term::Kind::Function && at(term).function == function;
    }
    bool is_truth(int term) const {
        for (const Function f : {Function::Greater, Function::And, Function::Or, Function::Not})
            if (calls(term, f)) return true;
        return is(term, 0) || is(term, 1);
    }

    std::optional<double> folded(Function function, int arity, int a, int b, int c) const {
        double values[3] = {};
        const int terms[3] = {a, b, c};
        for (int k = 0; k < arity; ++k) {
            const auto value = value_of(terms[k]);
            if (!value) return std::nullopt;
            values[k] = *value;
        }
        return apply(function, values[0], values[1], values[2]);
    }

    // The same value by less, if a rule applies.
    std::optional<int> rewritten(Function function, int a, int b, int c) {
        switch (function) {
            case Function::Add:
                if (is(a, 0)) return b;
                if (is(b, 0)) return a;
                if (calls(b, Function::Negate))
                    return call(Function::Subtract, a, at(b).arguments[0], -1);
                if (a == b) return call(Function::Multiply, constant(2), a, -1);
                break;
            case Function::Subtract:
                if (a == b) return constant(0);
                if (is(b, 0)) return a;
                if (is(a, 0)) return call(Function::Negate, b, -1, -1);
                if (calls(b, Function::Negate))
                    return call(Function::Add, a, at(b).arguments[0], -1);
                break;
            case Function::Multiply:
                if (is(a, 0) || is(b, 0)) return constant(0);
                if (is(a, 1)) return b;
                if (is(b, 1)) return a;
                if (is(a, -1)) return call(Function::Negate, b, -1, -1);
                if (is(b, -1)) return call(Function::Negate, a, -1, -1);
                if (a == b) return call(Function::Square, a, -1, -1);
                break;
            case Function::Divide:
                if (a == b) return constant(1);
                if (is(b, 1)) return a;
                break;
            case Function::Negate:
                if (calls(a, Function::Negate)) return at(a).arguments[0];
                break;
            case Function::Absolute:
                if (calls(a, Function::Negate))
                    return call(Function::Absolute, at(a).arguments[0], -1, -1);
                for (const Function f :
                     {Function::Absolute, Function::Square, Function::Root, Function::Exponential})
                    if (calls(a, f)) return a;
                if (is_truth(a)) return a;
                break;
            case Function::Minimum:
            case Function::Maximum:
                if (a == b) return a;
                break;
            case Function::Square:
                if (calls(a, Function::Negate) || calls(a, Function::Absolute))
                    return call(Function::Square, at(a).arguments[0], -1, -1);
                if (is_truth(a)) return a;
                break;
            case Function::Root:
                if (calls(a, Function::Negate) || calls(a, Function::Absolute))
                    return call(Function::Root, at(a).arguments[0], -1, -1);
                if (is_truth(a)) return a;
                break;
            case Function::Greater:
                if (a == b) return constant(0);
                if (is(b, 0) && is_truth(a)) return a;
                break;
            case Function::If:
                if (const auto condition = value_of(a)) return *condition > 0 ? b : c;
                if (b == c) return b;
                if (is_truth(a) && is(b, 1) && is(c, 0)) return a;
                if (calls(a, Function::Not)) return call(Function::If, at(a).arguments[0], c, b);
                break;
            case Function::And:
                if (const auto value = value_of(a)) return *value > 0 ? truth_of(b) : constant(0);
                if (const auto value = value_of(b)) return *value > 0 ? truth_of(a) : constant(0);
                if (a == b) return truth_of(a);
                break;
            case Function::Or:
                if (const auto value = value_of(a)) return *value > 0 ? constant(1) : truth_of(b);
                if (const auto value = value_of(b)) return *value > 0 ? constant(1) : truth_of(a);
                if (a == b) return truth_of(a);
                break;
            case Function::Not:
                if (calls(a, Function::Not)) return truth_of(at(a).arguments[0]);
                break;
            case Function::Sign:
                if (calls(a, Function::Sign) || is_truth(a)) return a;
                break;
            case Function::Floor:
            case Function::Ceiling:
            case Function::Round:
                for (const Function f :
                     {Function::Floor, Function::Ceiling, Function::Round, Function::Sign})
                    if (calls(a, f)) return a;
                if (is_truth(a)) return a;
                break;
            case Function::Sine:
            case Function::Cosine:
            case Function::Tanh:
            case Function::Exponential:
            case Function::One:
            case Function::Zero:
            case Function::Half:
            case Function::HalfSum:
            case Function::HalfDistance:
            case Function::ScaledExponential:
            case Function::ScaledLength:
            case Function::AbsolutePower:
            case Function::ArcSine:
            case Function::ArcCosine:
            case Function::ArcTangent:
                break;
        }
        return std::nullopt;
    }

    // 1 where it is above 0.
    int truth_of(int term) {
        return is_truth(term) ? term : call(Function::Greater, term, constant(0), -1);
    }

    Formula formula_;
    std::map<Term, int> places_;
};

// The formula without the terms that no output needs.
Formula without_rest(const Formula& all) {
    std::vector<bool> needed(all.terms.size());
    for (const int output : all.outputs) needed[static_cast<std::size_t>(output)] = true;
    for (std::size_t t = all.terms.size(); t-- > 0;)
        if (needed[t])
            for (const int argument : all.terms[t].arguments)
                if (argument >= 0) needed[static_cast<std::size_t>(argument)] = true;
    Formula kept;
    std::vector<int> places(all.terms.size(), -1);
    for (std::size_t t = 0; t < all.terms.size(); ++t) {
        if (!needed[t]) continue;
        Term term = all.terms[t];
        for (int& argument : term.arguments)
            if (argument >= 0) argument = places[static_cast<std::size_t>(argument)];
        places[t] = static_cast<int>(kept.terms.size());
        kept.terms.push_back(term);
    }
    for (const int output : all.outputs)
        kept.outputs.push_back(places[static_cast<std::size_t>(output)]);
    return kept;
}

}  // namespace

Formula simplified(const Genome& genome) {
    const Activity activity = activity_of(genome);
    Simplifier simplifier;
    std::vector<int> terms(activity.used.size(), -1);
    for (std::size_t a = 0; a < terms.size(); ++a) {
        if (!activity.used[a]) continue;
        const int address = static_cast<int>(a);
        if (address < genome.inputs) {
            terms[a] = simplifier.input(address);
        } else if (address < genome.first_node()) {
            terms[a] = simplifier.constant(
                genome.constants[static_cast<std::size_t>(address - genome.inputs)]);
        } else {
            const Node& node =
                genome.nodes[static_cast<std::size_t>(address - genome.first_node())];
            const auto argument = [&](std::size_t k) {
                return static_cast<int>(k) < info_of(node.function).arity
                           ? terms[static_cast<std::size_t>(node.arguments[k])]
                           : -1;
            };
            terms[a] = simplifier.call(node.function, argument(0), argument(1), argument(2));
        }
    }
    for (const int output : genome.outputs)
        simplifier.formula().outputs.push_back(terms[static_cast<std::size_t>(output)]);
    return without_rest(simplifier.take());
}

int Formula::size() const {
    int functions = 0;
    for (const Term& term : terms) functions += term.kind == Term::Kind::Function;
    return functions;
}

std::vector<double> Formula::evaluate(const std::vector<double>& inputs) const {
    std::vector<double> values;
    const auto value = [&](int term) {
        return term < 0 ? 0 : values[static_cast<std::size_t>(term)];
    };
    for (const Term& term : terms)
        values.push_back(term.kind == Term::Kind::Input
                             ? inputs[static_cast<std::size_t>(term.input)]
                         : term.kind == Term::Kind::Constant
                             ? term.constant
                             : apply(term.function, value(term.arguments[0]),
                                     value(term.arguments[1]), value(term.arguments[2])));
    std::vector<double> results;
    for (const int output : outputs) results.push_back(value(output));
    return results;
}

}  // namespace rddlc::solvers
