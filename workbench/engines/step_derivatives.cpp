#include "engines/step_derivatives.hpp"

#include "autodiff/evaluation.hpp"
#include "autodiff/number_layout.hpp"
#include "passes/aggregations/shorten_aggregations.hpp"
#include "problems/front_end.hpp"

#include <rddl/random/random.hpp>

#include <algorithm>
#include <mutex>
#include <optional>
#include <utility>

namespace rddlc::workbench {

namespace {

// A step of the problem, for all threads.
struct DifferentiableProblem {
    explicit DifferentiableProblem(const ir::Program& program)
        : step(autodiff::unroll(program)), states(program, ir::Storage::State) {}

    autodiff::StraightLine step;
    autodiff::NumberLayout states;
};

autodiff::Relaxation relaxation_of(const solvers::Relaxation& given) {
    using Mode = solvers::Relaxation::Mode;
    autodiff::Relaxation relaxation{.sharpness = given.sharpness, .temperature = given.temperature};
    if (given.mode == Mode::StraightThrough) relaxation.mode = autodiff::Mode::StraightThrough;
    if (given.mode == Mode::Soft) relaxation.mode = autodiff::Mode::Soft;
    return relaxation;
}

static_assert(solvers::derivative_lanes == autodiff::lanes);

class UnrolledDerivatives : public solvers::StepDerivatives {
  public:
    UnrolledDerivatives(std::shared_ptr<const DifferentiableProblem> problem,
                        const solvers::Relaxation& relaxation)
        : problem_(std::move(problem)), evaluation_(problem_->step, relaxation_of(relaxation)) {}

    std::size_t state_count() const override { return problem_->step.state_count; }
    std::size_t action_count() const override { return problem_->step.action_count; }
    std::int64_t bytes() const override { return evaluation_.bytes(); }
    bool can_be_relaxed() const override { return autodiff::can_be_relaxed(problem_->step); }
    void read_state(const std::byte* record, std::span<double> numbers) const override {
        for (std::size_t i = 0; i < numbers.size(); ++i)
            numbers[i] = problem_->states.read(record, i);
    }

    void set_seeds(std::span<const std::uint64_t, solvers::derivative_lanes> seeds) override {
        for (std::size_t lane = 0; lane < seeds.size(); ++lane)
            keys_[lane] = rddl::stream_key(seeds[lane], 0, 0);
    }

    void step(std::int64_t steps_made, std::span<const solvers::LaneNumbers> state,
              std::span<const solvers::LaneNumbers> action) override {
        for (std::size_t i = 0; i < state.size(); ++i) evaluation_.state(i) = state[i];
        for (std::size_t i = 0; i < action.size(); ++i) evaluation_.action(i) = action[i];
        evaluation_.forward(keys_, static_cast<std::uint32_t>(steps_made));
    }
    void read_next(std::span<solvers::LaneNumbers> next) const override {
        for (std::size_t i = 0; i < next.size(); ++i) next[i] = evaluation_.next(i);
    }
    solvers::LaneNumbers reward() const override { return evaluation_.reward(); }
    bool is_over(std::size_t lane) const override { return evaluation_.is_over(lane); }
    bool has_failed(std::size_t lane) const override { return evaluation_.has_failed(lane); }

    void pull_back(std::span<const solvers::LaneNumbers> next_adjoint,
                   const solvers::LaneNumbers& reward_adjoint,
                   std::span<solvers::LaneNumbers> state_adjoint,
                   std::span<solvers::LaneNumbers> action_adjoint) override {
        evaluation_.clear_adjoints();
        for (std::size_t i = 0; i < next_adjoint.size(); ++i)
            evaluation_.add_next_adjoint(i, next_adjoint[i]);
        evaluation_.add_reward_adjoint(reward_adjoint);
        evaluation_.backward();
        for (std::size_t i = 0; i < state_adjoint.size(); ++i)
            state_adjoint[i] = evaluation_.state_adjoint(i);
        for (std::size_t i = 0; i < action_adjoint.size(); ++i)
            action_adjoint[i] = evaluation_.action_adjoint(i);
    }

  private:
    std::shared_ptr<const DifferentiableProblem> problem_;
    autodiff::Evaluation evaluation_;
    std::array<rddl::StreamKey, autodiff::lanes> keys_{};
};

// The problem, once the first thread has asked for it.
class LazyProblem {
  public:
    explicit LazyProblem(CompileOptions options) : options_(std::move(options)) {}

    std::shared_ptr<const DifferentiableProblem> get() {
        const std::scoped_lock lock(mutex_);
        if (!problem_) {
            Compilation compilation = compile(options_);
            give_up_on_errors(compilation);
            problem_ = std::make_shared<const DifferentiableProblem>(
                shorten_aggregations(std::move(*compilation.program)));
        }
        return problem_;
    }

  private:
    CompileOptions options_;
    std::mutex mutex_;
    std::shared_ptr<const DifferentiableProblem> problem_;
};

}  // namespace

solvers::DerivativesSource derivatives_of(const ProblemFiles& files, const LoadOptions& options,
                                          std::map<std::filesystem::path, std::string> texts) {
    CompileOptions compiling = front_end_options(files, Stage::Verify, options);
    compiling.texts = std::move(texts);
    const auto problem = std::make_shared<LazyProblem>(std::move(compiling));
    return [problem](const solvers::Relaxation& relaxation) {
        return std::make_unique<UnrolledDerivatives>(problem->get(), relaxation);
    };
}

}  // namespace rddlc::workbench
