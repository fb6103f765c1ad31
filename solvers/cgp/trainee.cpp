#include "solvers/cgp/trainee.hpp"

#include "solvers/cgp/formula.hpp"
#include "solvers/cgp/option_table.hpp"
#include "solvers/cgp/policy_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

namespace rddlc::solvers {

namespace {

Row cgp_row(const CgpProgress& p) {
    return {{"search/evaluations", static_cast<double>(p.evaluations)},
            {"time/evaluations_per_second",
             static_cast<double>(p.evaluations) / std::max(p.seconds, 1e-9)},
            {"search/best", p.best.value},
            {"search/best_steps", p.best.steps},
            {"search/best_nodes", static_cast<double>(p.best.nodes)},
            {"search/mean_of_children", p.mean_of_children},
            {"search/father_replaced", p.replaced ? 1.0 : 0.0},
            {"search/restarts", static_cast<double>(p.restarts)}};
}

std::string cgp_status(const CgpSearch& search) {
    const CgpProgress& p = search.progress();
    return fmt::format(
        "gen {}  {} evaluations/s  {:.6g} in {:.6g} steps  nodes {}  {}", p.generations,
        count_text(static_cast<double>(p.evaluations) / std::max(p.seconds, 1e-9)), p.best.value,
        p.best.steps, p.best.nodes,
        search.best().delayed ? "" : short_formula(simplified(search.best()), search.scope(), 60));
}

}  // namespace

Trainee cgp_trainee(const rddl_simulator& simulator, const CgpOptions& options,
                    const Ranks& ranks) {
    require_ranges(cgp_option_table(), options);
    const auto search = std::make_shared<CgpSearch>(simulator, options, ranks);
    // Generations per update: enough that checking the results costs nothing, and few enough that
    // the time is checked soon where episodes are long or actions large.
    const std::int64_t total = options.generations;
    const auto units = static_cast<std::int64_t>(search->scope().units.size());
    const std::int64_t values = search->steps_of_generation() * (1 + units / 16);
    const std::int64_t few = std::max<std::int64_t>(1, 400'000 / values);
    const std::int64_t some =
        std::clamp<std::int64_t>(total / 200, 1, std::min<std::int64_t>(50, few));
    const auto left = [=] {
        return total - search->progress().generations;
    };
    Trainee trainee;
    trainee.solver = "cgp";
    trainee.advice =
        "more --gens, another --seed, 'rddl train ppo', or a planner (--policy plan:cem or "
        "plan:uct)";
    trainee.settings = settings_of(cgp_option_table(), options);
    trainee.ends_early = static_cast<bool>(options.stops);
    trainee.update = [=] {
        search->run(std::min(some, left()));
    };
    trainee.done = [=] {
        return left() <= 0;
    };
    trainee.steps = [=] {
        return search->progress().generations;
    };
    trainee.part_done = [=] {
        return static_cast<double>(search->progress().generations) / static_cast<double>(total);
    };
    trainee.row = [=] {
        return cgp_row(search->progress());
    };
    trainee.status = [=] {
        return cgp_status(*search);
    };
    trainee.save = [=] {
        return search->save();
    };
    trainee.load = [=](std::string_view bytes) {
        search->load(bytes);
    };
    trainee.policy_text = [=, &simulator] {
        return program_text(simulator, search->scope(), search->best());
    };
    trainee.best_known = [=] {
        return search->progress().best.value;
    };
    trainee.summary = [&simulator](std::string_view text) {
        const auto found = read_program(simulator, text);
        return program_formula(found->scope, found->genome);
    };
    trainee.policy = [=, &simulator] {
        const auto found =
            std::make_shared<FoundProgram>(FoundProgram{search->scope(), search->best()});
        return program_policy(simulator, found, "cgp");
    };
    return trainee;
}

}  // namespace rddlc::solvers
