#include "learning/export.hpp"

#include "solvers/cgp/formula.hpp"
#include "solvers/cgp/policy_file.hpp"
#include "solvers/ppo/export.hpp"
#include "solvers/ppo/policy_file.hpp"
#include "support/failure.hpp"

#include <fmt/format.h>

namespace rddlc::workbench {

namespace {

std::string exported_program(const rddl_simulator& simulator, const std::string& text,
                             const std::string& form) {
    const auto found = solvers::read_program(simulator, text);
    if (form == "formula") return solvers::program_formula(found->scope, found->genome);
    if (found->genome.delayed)
        throw Failure(fmt::format("it remembers the step before, as programs of scikit-decide do, "
                                  "and such programs are not written as {}",
                                  form),
                      "--as formula explains it", usage_error);
    const solvers::Formula formula = solvers::simplified(found->genome);
    if (form == "cpp") return solvers::formula_cpp(formula, found->scope);
    if (form == "dot") return solvers::formula_dot(formula, found->scope);
    if (form == "svg") return solvers::formula_svg(formula, found->scope);
    if (form == "py") return solvers::formula_python(formula, found->scope);
    if (form == "latex") return solvers::formula_latex(formula, found->scope);
    throw Failure(fmt::format("programs of CGP are not written as {}", form),
                  "formula, cpp, dot, svg, py and latex are", usage_error);
}

std::string exported_network(const rddl_simulator& simulator, const std::string& text,
                             const std::string& form, std::int64_t memory_limit) {
    const auto model = solvers::read_ppo_policy(simulator, text, memory_limit);
    if (form == "json") return solvers::ppo_policy_text(simulator, *model);
    if (form == "cpp") return solvers::ppo_policy_cpp(*model);
    if (form == "onnx") return solvers::ppo_policy_onnx(*model);
    throw Failure(fmt::format("networks of {} are not written as {}",
                              model->solver == "drp" ? "DRP" : "PPO", form),
                  "json, cpp and onnx are", usage_error);
}

}  // namespace

std::string exported_policy(const rddl_simulator& simulator, const std::string& text,
                            const std::string& form, std::int64_t memory_limit) {
    if (solvers::is_program(text))
        return exported_program(simulator, text, form.empty() ? "formula" : form);
    return exported_network(simulator, text, form.empty() ? "json" : form, memory_limit);
}

}  // namespace rddlc::workbench
