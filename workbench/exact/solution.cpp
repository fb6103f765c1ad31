#include "exact/solution.hpp"

#include "engines/external_library.hpp"
#include "engines/interpreted_simulator.hpp"
#include "exact/step_outcomes.hpp"
#include "planners/simulation/finite_actions.hpp"
#include "problems/front_end.hpp"
#include "solvers/batches/batch.hpp"
#include "solvers/files/archive.hpp"
#include "solvers/spaces/actions.hpp"
#include "support/failure.hpp"
#include "terminal/interrupt.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

namespace rddlc::workbench {

namespace {

constexpr std::string_view mark = "rddlc optimum 1\n";

std::string name_of(const rddl_problem& problem) {
    return fmt::format("{} ({})", problem.instance, problem.domain);
}

std::string possible_text(double states) {
    return std::isinf(states) ? "its states have no bound"
                              : fmt::format("its fluents have {:.3g} states", states);
}

std::vector<std::byte> action_records(const rddl_simulator& simulator, std::size_t most) {
    const rddl_problem& problem = *simulator.problem;
    const solvers::ActionSpace space = solvers::action_space(simulator, is_interrupted);
    give_up_if_interrupted("solving");
    if (!space.reals.empty())
        throw Failure(
            fmt::format("{} is not discrete: '{}' is any number", name_of(problem),
                        space.names[static_cast<std::size_t>(space.reals.front().column)]),
            "take a planner, such as --policy plan:cem");
    const auto actions = planners::FiniteActions::of(simulator, space, most);
    if (!actions)
        throw Failure(fmt::format("{} has more than {} joint actions", name_of(problem), most),
                      "allow more by --max-actions");
    return {actions->record(0),
            actions->record(0) + actions->count() * static_cast<std::size_t>(problem.action_size)};
}

void require_sight(const rddl_problem& problem, bool cheat) {
    if (problem.partially_observed && !cheat)
        throw Failure(fmt::format("{} hides its state: its policies see observations alone",
                                  name_of(problem)),
                      "--cheat finds the optimum of a policy that sees the state, which no other "
                      "one exceeds");
}

}  // namespace

Solution solve(const ProblemFiles& files, const LoadOptions& load, const SolveOptions& options,
               SolvedSize& size) {
    LoadOptions interpreted = load;
    interpreted.engine = Engine::Interpreter;
    Compilation compilation = compile_problem(files, interpreted);
    give_up_on_errors(compilation);
    const ExternalLibrary library = external_library(*compilation.program, files, interpreted);
    const ir::Interpreter interpreter(*compilation.program, library.functions);
    const LoadedProblem problem = load_compilation(std::move(compilation), files, interpreted);
    const rddl_simulator& simulator = *problem.simulator;
    require_sight(*simulator.problem, options.cheat);
    std::vector<std::byte> actions =
        action_records(simulator, static_cast<std::size_t>(options.actions));
    ModelLimits limits = options.limits;
    limits.horizon = options.limits.horizon == 0  ? simulator.problem->horizon
                     : options.limits.horizon < 0 ? 0
                                                  : options.limits.horizon;
    size.possible_states = count_of_states(*simulator.problem);
    try {
        const MarkovModel model = markov_model(interpreter, std::move(actions), limits);
        size.states = model.states.count();
        size.actions = static_cast<std::int64_t>(model.actions.size()) /
                       std::max<std::int64_t>(1, simulator.problem->action_size);
        size.transitions = static_cast<std::int64_t>(model.to.size());
        return {solvers::fingerprint(simulator),
                optimum_of(model, limits.horizon, simulator.problem->discount, limits.threads),
                model.states.records(), model.actions};
    } catch (const Failure& failure) {
        if (is_interrupted()) throw;
        throw Failure(fmt::format("cannot solve {}: {} ({})", name_of(*simulator.problem),
                                  failure.what(), possible_text(size.possible_states)),
                      failure.hint, failure.status);
    }
}

namespace {

template <class Archive>
void archive_solution(Archive& archive, Solution& solution) {
    solution.problem.archive(archive);
    archive(solution.optimum.horizon);
    archive(solution.optimum.value);
    archive(solution.optimum.error);
    archive(solution.optimum.sweeps);
    archive(solution.optimum.first);
    archive(solution.optimum.entries);
    archive(solution.states);
    archive(solution.actions);
}

// Whether numbers are numbers of what is there.
bool is_sound(const Solution& solution, const rddl_problem& problem) {
    const auto state_size = static_cast<std::size_t>(problem.state_size);
    const auto action_size = static_cast<std::size_t>(problem.action_size);
    const Optimum& optimum = solution.optimum;
    if (state_size == 0 || action_size == 0 || optimum.first.empty() || optimum.first[0] != 0 ||
        solution.states.size() != (optimum.first.size() - 1) * state_size ||
        solution.actions.size() % action_size != 0 || optimum.horizon < 0 ||
        optimum.first.size() >= StateTable::absent)
        return false;
    const std::size_t actions = solution.actions.size() / action_size;
    return std::is_sorted(optimum.first.begin(), optimum.first.end()) &&
           optimum.first.back() == optimum.entries.size() &&
           std::all_of(optimum.entries.begin(), optimum.entries.end(),
                       [&](const PolicyEntry& entry) { return entry.action < actions; });
}

}  // namespace

std::string solution_text(const Solution& solution) {
    solvers::SavingArchive archive;
    Solution copy = solution;
    archive_solution(archive, copy);
    solvers::SavingArchive whole;
    whole.append(mark);
    whole(solvers::checksum(archive.bytes()));
    whole.append(archive.bytes());
    return whole.bytes();
}

Solution read_solution(const rddl_simulator& simulator, std::string_view text) {
    if (!text.starts_with(mark)) throw Failure("it is not a solution of rddl solve");
    text.remove_prefix(mark.size());
    std::uint64_t sum = 0;
    solvers::LoadingArchive(text.substr(0, sizeof sum))(sum);
    text.remove_prefix(std::min(text.size(), sizeof sum));
    if (solvers::checksum(text) != sum) throw Failure("it is damaged");
    Solution solution;
    solvers::LoadingArchive archive(text);
    archive_solution(archive, solution);
    if (const std::string why =
            solvers::difference(solution.problem, solvers::fingerprint(simulator));
        !why.empty())
        throw Failure(why);
    if (!archive.at_end() || !is_sound(solution, *simulator.problem))
        throw Failure("it is damaged");
    return solution;
}

namespace {

class SolutionActor {
  public:
    SolutionActor(const rddl_simulator& simulator, std::shared_ptr<const Solution> solution,
                  std::shared_ptr<const StateTable> states, std::int64_t environments)
        : simulator_(simulator),
          solution_(std::move(solution)),
          states_(std::move(states)),
          records_(static_cast<std::size_t>(environments * simulator.problem->state_size)) {}

    void act(solvers::Decision& decision) {
        const rddl_problem& problem = *simulator_.problem;
        const auto state_size = static_cast<std::size_t>(problem.state_size);
        const auto action_size = static_cast<std::size_t>(problem.action_size);
        solvers::require_done(
            simulator_, simulator_.get_state(decision.batch, 0,
                                             static_cast<std::int64_t>(decision.running.size()),
                                             records_.data()));
        for (std::size_t i = 0; i < decision.running.size(); ++i) {
            const std::byte* action = static_cast<const std::byte*>(problem.default_action);
            if (decision.running[i])
                action = action_in(records_.data() + i * state_size,
                                   steps_left(decision, decision.steps[i]));
            std::copy_n(action, action_size, decision.actions + i * action_size);
        }
    }

  private:
    // Infinitely many are the greatest number.
    std::int64_t steps_left(const solvers::Decision& decision, std::int64_t step) const {
        const std::int64_t horizon =
            solvers::steps_of_horizon(*simulator_.problem, decision.horizon);
        return horizon > 0 ? std::max<std::int64_t>(1, horizon - step)
                           : std::numeric_limits<std::int64_t>::max();
    }

    const std::byte* action_in(const std::byte* state, std::int64_t left) const {
        const Optimum& optimum = solution_->optimum;
        const StateNumber number = states_->find(state);
        if (number == StateTable::absent)
            throw Failure(
                "the solution does not have the state of an episode: it starts elsewhere");
        if (optimum.horizon > 0 && left > optimum.horizon)
            throw Failure(fmt::format("the solution is of at most {} steps", optimum.horizon),
                          "solve the problem with this --horizon");
        const auto begin =
            optimum.entries.begin() + static_cast<std::ptrdiff_t>(optimum.first[number]);
        const auto end =
            optimum.entries.begin() + static_cast<std::ptrdiff_t>(optimum.first[number + 1]);
        const auto next = std::upper_bound(
            begin, end, left,
            [](std::int64_t steps, const PolicyEntry& entry) { return steps < entry.left; });
        // With fewer steps to go than any entry is about, the episode did not begin at the start.
        if (next == begin) return static_cast<const std::byte*>(simulator_.problem->default_action);
        return solution_->actions.data() +
               (next - 1)->action * static_cast<std::size_t>(simulator_.problem->action_size);
    }

    const rddl_simulator& simulator_;
    std::shared_ptr<const Solution> solution_;
    std::shared_ptr<const StateTable> states_;
    std::vector<std::byte> records_;  // bytes between fluents stay 0
};

}  // namespace

solvers::Policy solution_policy(const rddl_simulator& simulator, Solution solution,
                                const std::string& name) {
    const auto states =
        std::make_shared<const StateTable>(static_cast<std::size_t>(simulator.problem->state_size),
                                           std::exchange(solution.states, {}));
    const auto shared = std::make_shared<const Solution>(std::move(solution));
    const auto start = [&simulator, shared, states](std::int64_t environments) -> solvers::Actor {
        const auto actor = std::make_shared<SolutionActor>(simulator, shared, states, environments);
        return [actor](solvers::Decision& decision) {
            actor->act(decision);
        };
    };
    return {name, solvers::spaces_of(simulator), start};
}

}  // namespace rddlc::workbench
