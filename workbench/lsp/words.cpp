#include "lsp/words.hpp"

#include <algorithm>
#include <unordered_set>

namespace rddlc::lsp {

namespace {

// From grammar/RDDL.g4 (tests/lsp compares).
const std::unordered_set<std::string_view>& reserved_words() {
    static const std::unordered_set<std::string_view> words = {"domain",
                                                               "non-fluents",
                                                               "instance",
                                                               "policy",
                                                               "requirements",
                                                               "types",
                                                               "pvariables",
                                                               "reward",
                                                               "objects",
                                                               "init-state",
                                                               "max-nondef-actions",
                                                               "horizon",
                                                               "discount",
                                                               "cpfs",
                                                               "cdfs",
                                                               "termination",
                                                               "action-preconditions",
                                                               "state-action-constraints",
                                                               "state-invariants",
                                                               "non-fluent",
                                                               "state-fluent",
                                                               "action-fluent",
                                                               "interm-fluent",
                                                               "derived-fluent",
                                                               "observ-fluent",
                                                               "param-fluent",
                                                               "bool",
                                                               "int",
                                                               "real",
                                                               "true",
                                                               "false",
                                                               "forall",
                                                               "exists",
                                                               "argmax",
                                                               "argmin",
                                                               "Discrete",
                                                               "UnnormDiscrete",
                                                               "KronDelta",
                                                               "DiracDelta",
                                                               "Uniform",
                                                               "Bernoulli",
                                                               "Normal",
                                                               "Poisson",
                                                               "Exponential",
                                                               "Weibull",
                                                               "Gamma",
                                                               "Binomial",
                                                               "NegativeBinomial",
                                                               "Beta",
                                                               "Geometric",
                                                               "Pareto",
                                                               "Student",
                                                               "Gumbel",
                                                               "Laplace",
                                                               "Cauchy",
                                                               "Gompertz",
                                                               "ChiSquare",
                                                               "Kumaraswamy",
                                                               "MultivariateNormal",
                                                               "MultivariateStudent",
                                                               "Dirichlet",
                                                               "Multinomial",
                                                               "inverse",
                                                               "pinverse",
                                                               "cholesky",
                                                               "object",
                                                               "default",
                                                               "level",
                                                               "pos-inf",
                                                               "neg-inf",
                                                               "terminate-when",
                                                               "if",
                                                               "then",
                                                               "else",
                                                               "switch",
                                                               "case",
                                                               "det",
                                                               "row",
                                                               "col",
                                                               "terminal",
                                                               "otherwise"};
    return words;
}

bool is_letter(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

bool is_letter_or_digit(char c) {
    return is_letter(c) || (c >= '0' && c <= '9');
}

}  // namespace

bool is_name(std::string_view word) {
    return !word.empty() && is_letter(word.front()) && is_letter_or_digit(word.back()) &&
           std::ranges::all_of(
               word, [](char c) { return is_letter_or_digit(c) || c == '-' || c == '_'; });
}

bool is_reserved(std::string_view word) {
    return reserved_words().contains(word);
}

}  // namespace rddlc::lsp
