#include "fitting/fit.hpp"

#include "autodiff/evaluation.hpp"
#include "autodiff/number_layout.hpp"
#include "fitting/influence.hpp"
#include "fitting/open_parameters.hpp"
#include "fitting/transitions.hpp"
#include "formats/line_stream.hpp"
#include "formats/trace.hpp"
#include "problems/front_end.hpp"
#include "support/failure.hpp"
#include "support/files.hpp"

#include <rddl/random/random.hpp>

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

namespace rddlc::workbench {

namespace {

using Vector = Eigen::VectorXd;
using Matrix = Eigen::MatrixXd;

// A recorded step; numbers of the state without the parameters.
struct RecordedStep {
    std::vector<double> state, action, next;
    std::optional<double> reward;
};

// Thrown in the middle of work once FitOptions::stops says so.
struct Stopped {};

void give_up_if_stopped(const std::function<bool()>& stops) {
    if (stops && stops()) throw Stopped();
}

// Names of the numbers of a record, as autodiff::NumberLayout has them.
struct NumberName {
    std::string fluent;
    std::int64_t element;
    ir::Scalar scalar;
    bool operator<(const NumberName& other) const {
        return std::pair(fluent, element) < std::pair(other.fluent, other.element);
    }
};

std::vector<NumberName> names_of(const ir::Program& program, ir::Storage storage) {
    std::vector<NumberName> names;
    for (const ir::Buffer& buffer : program.buffers)
        if (buffer.storage == storage)
            for (std::int64_t i = 0; i < buffer.count(); ++i)
                names.push_back({buffer.name, i, buffer.scalar});
    return names;
}

ir::Program program_of(const ProblemFiles& files, const LoadOptions& load,
                       const std::vector<std::string>& parameters) {
    CompileOptions options = front_end_options(files, Stage::Verify, load);
    if (!parameters.empty())
        options.extend = [&](ast::Program& tree, Sources&, Diagnostics&) {
            open_parameters(tree, parameters);
        };
    Compilation compilation = compile(options);
    give_up_on_errors(compilation);
    return *std::move(compilation.program);
}

class Data {
  public:
    Data(const rddl_simulator& simulator, const ir::Program& program)
        : simulator_(simulator),
          states_(program, ir::Storage::State),
          actions_(program, ir::Storage::Action) {}

    void read(const std::filesystem::path& trace) {
        UsedFiles used;
        LineReader lines(trace.string(), used, longest_line(TraceFormat(*simulator_.problem)));
        TransitionReader reader(simulator_, trace.string());
        while (const std::optional<std::string> line = lines.next())
            if (const std::optional<Transition> step = reader.read(*line)) add(*step);
        faulted += reader.faulted();
    }

    std::vector<RecordedStep> steps;
    std::int64_t faulted = 0;  // steps that were left out

  private:
    void add(const Transition& step) {
        const auto numbers = [](const autodiff::NumberLayout& layout,
                                const std::vector<std::byte>& record) {
            std::vector<double> all;
            for (std::size_t i = 0; i < layout.count(); ++i)
                all.push_back(layout.read(record.data(), i));
            return all;
        };
        steps.push_back({numbers(states_, step.state), numbers(actions_, step.action),
                         numbers(states_, step.next), step.reward});
    }

    const rddl_simulator& simulator_;
    autodiff::NumberLayout states_, actions_;
};

// The residuals of all steps, and their derivatives by the parameters.
class Residuals {
  public:
    Residuals(const ir::Program& original, const ir::Program& open, bool is_stochastic,
              const FitOptions& options, std::vector<RecordedStep> steps)
        : step_(autodiff::unroll(open)),
          evaluation_(step_, {}),
          draws_(is_stochastic ? options.draws : 1),
          seed_(options.seed),
          stops_(options.stops),
          steps_(std::move(steps)) {
        std::map<NumberName, std::size_t> places;
        const auto before = names_of(original, ir::Storage::State);
        for (std::size_t i = 0; i < before.size(); ++i) places.emplace(before[i], i);
        const auto now = names_of(open, ir::Storage::State);
        for (std::size_t i = 0; i < now.size(); ++i) {
            const auto found = places.find(now[i]);
            if (found == places.end())
                parameters_.push_back(i);
            else
                numbers_.push_back({i, found->second});
            if (found != places.end() && now[i].scalar == ir::Scalar::Real)
                observed_.push_back({i, found->second});
        }
        find_scales();
    }

    std::size_t parameter_count() const { return parameters_.size(); }
    std::size_t parameter_number(std::size_t p) const { return parameters_[p]; }
    // One for each observed number of each step, and one for each reward.
    std::size_t count() const { return steps_.size() * observed_.size() + rewards(); }

    // How what is compared depends on a parameter.
    Influence influence(std::size_t p) const {
        std::vector<autodiff::Slot> next;
        for (const Place& place : observed_) next.push_back(step_.next[place.here]);
        return influence_of(step_, step_.state_slot(parameters_[p]), next, rewards() > 0);
    }

    // False where a step faults.
    bool compute(const Vector& parameters, Vector& residuals, Matrix* derivatives) {
        residuals.resize(static_cast<Eigen::Index>(count()));
        if (derivatives) derivatives->resize(residuals.size(), parameters.size());
        Eigen::Index row = 0;
        for (std::size_t s = 0; s < steps_.size(); ++s) {
            if (!compute_step(s, parameters, row, residuals, derivatives)) return false;
            row += static_cast<Eigen::Index>(outputs_of(steps_[s]));
        }
        return residuals.allFinite();
    }

  private:
    struct Place {
        std::size_t here, there;  // a number of the open and of the original state
    };

    // The observed numbers, then the reward if the step has one.
    std::size_t outputs_of(const RecordedStep& step) const {
        return observed_.size() + (step.reward ? 1 : 0);
    }
    double observed(const RecordedStep& step, std::size_t o) const {
        return o < observed_.size() ? step.next[observed_[o].there] : *step.reward;
    }
    std::size_t rewards() const {
        return static_cast<std::size_t>(std::ranges::count_if(
            steps_, [](const RecordedStep& step) { return step.reward.has_value(); }));
    }

    // Deviations of what is observed; what never changes has 1.
    void find_scales() {
        for (std::size_t o = 0; o <= observed_.size(); ++o) {
            double sum = 0, squares = 0, n = 0;
            for (const RecordedStep& step : steps_) {
                if (o >= outputs_of(step)) continue;
                sum += observed(step, o);
                ++n;
            }
            for (const RecordedStep& step : steps_)
                if (o < outputs_of(step)) squares += std::pow(observed(step, o) - sum / n, 2);
            const double deviation = n > 0 ? std::sqrt(squares / n) : 0;
            scales_.push_back(deviation > 1e-12 ? deviation : 1);
        }
    }

    bool compute_step(std::size_t s, const Vector& parameters, Eigen::Index row, Vector& residuals,
                      Matrix* derivatives) {
        const RecordedStep& step = steps_[s];
        for (const Place& place : numbers_)
            evaluation_.state(place.here).fill(step.state[place.there]);
        for (std::size_t p = 0; p < parameters_.size(); ++p)
            evaluation_.state(parameters_[p]).fill(parameters[static_cast<Eigen::Index>(p)]);
        for (std::size_t i = 0; i < step.action.size(); ++i)
            evaluation_.action(i).fill(step.action[i]);
        const auto outputs = static_cast<Eigen::Index>(outputs_of(step));
        residuals.segment(row, outputs).setZero();
        if (derivatives) derivatives->middleRows(row, outputs).setZero();
        // All lanes have the same draws, since each takes the derivatives of another result.
        for (int draw = 0; draw < draws_; ++draw) {
            give_up_if_stopped(stops_);
            const std::vector<rddl::StreamKey> keys(
                autodiff::lanes, rddl::stream_key(seed_, s, static_cast<std::uint64_t>(draw)));
            evaluation_.forward(keys, 0);
            if (evaluation_.has_failed(0)) return false;
            for (Eigen::Index o = 0; o < outputs; ++o)
                residuals[row + o] += result(static_cast<std::size_t>(o)) / draws_;
            if (derivatives) add_derivatives(row, outputs_of(step), *derivatives);
        }
        for (Eigen::Index o = 0; o < outputs; ++o)
            residuals[row + o] =
                (residuals[row + o] - observed(step, static_cast<std::size_t>(o))) /
                scales_[static_cast<std::size_t>(o)];
        return true;
    }

    double result(std::size_t o) const {
        return o < observed_.size() ? evaluation_.next(observed_[o].here)[0]
                                    : evaluation_.reward()[0];
    }

    // Differentiates eight results at a time, one in each lane.
    void add_derivatives(Eigen::Index row, std::size_t outputs, Matrix& derivatives) {
        for (std::size_t first = 0; first < outputs; first += autodiff::lanes) {
            evaluation_.clear_adjoints();
            const std::size_t end = std::min(first + autodiff::lanes, outputs);
            for (std::size_t o = first; o < end; ++o) {
                autodiff::Lane adjoint{};
                adjoint[o - first] = 1 / scales_[o] / draws_;
                if (o < observed_.size())
                    evaluation_.add_next_adjoint(observed_[o].here, adjoint);
                else
                    evaluation_.add_reward_adjoint(adjoint);
            }
            evaluation_.backward();
            for (std::size_t o = first; o < end; ++o)
                for (std::size_t p = 0; p < parameters_.size(); ++p)
                    derivatives(row + static_cast<Eigen::Index>(o), static_cast<Eigen::Index>(p)) +=
                        evaluation_.state_adjoint(parameters_[p])[o - first];
        }
    }

    autodiff::StraightLine step_;
    autodiff::Evaluation evaluation_;
    int draws_;
    std::uint64_t seed_;  // of the draws
    std::function<bool()> stops_;
    std::vector<RecordedStep> steps_;
    std::vector<std::size_t> parameters_;    // numbers of the open state
    std::vector<Place> numbers_, observed_;  // the others; the reals among them
    std::vector<double> scales_;             // of the observed ones, and of the reward
};

void require_influence(const Residuals& all, const Matrix& derivatives,
                       const std::vector<FittedParameter>& parameters) {
    for (Eigen::Index p = 0; p < derivatives.cols(); ++p)
        if (!(derivatives.col(p).norm() > 0)) {
            const auto place = static_cast<std::size_t>(p);
            refuse_without_influence(parameters[place].name, all.influence(place));
        }
}

// The inverse of the normal equations at the solution, times the variance of residuals. Columns are
// scaled to norm 1, so that units of parameters do not matter: with D P = Q R, the variances are
// the squared norms of the rows of P R^-1. Each parameter has influence.
void set_errors(const Matrix& derivatives, const Vector& residuals, Fit& fit) {
    const Vector norms = derivatives.colwise().norm();
    const Matrix scaled = derivatives * norms.cwiseInverse().asDiagonal();
    Eigen::ColPivHouseholderQR<Matrix> solver(scaled);
    solver.setThreshold(1e-10);  // rounding of many rows is well below
    const Eigen::Index count = scaled.cols();
    if (solver.rank() < count)
        throw Failure("the recorded steps do not tell the parameters apart",
                      "fit fewer of them, or record other steps");
    const Matrix inverse = solver.colsPermutation() * solver.matrixR()
                                                          .topLeftCorner(count, count)
                                                          .triangularView<Eigen::Upper>()
                                                          .solve(Matrix::Identity(count, count));
    const double freedom = std::max<double>(1, static_cast<double>(residuals.size() - count));
    for (std::size_t p = 0; p < fit.parameters.size(); ++p) {
        const auto place = static_cast<Eigen::Index>(p);
        fit.parameters[p].error =
            inverse.row(place).norm() / norms[place] * residuals.norm() / std::sqrt(freedom);
    }
}

double root_mean_square(const Vector& residuals) {
    return std::sqrt(residuals.squaredNorm() / static_cast<double>(residuals.size()));
}

// Levenberg and Marquardt: steps of Gauss and Newton, shortened until they are an improvement.
void minimise(Residuals& all, Vector& parameters, int iterations, Fit& fit) {
    Vector residuals, tried_residuals;
    Matrix derivatives;
    if (!all.compute(parameters, residuals, &derivatives))
        throw Failure("a recorded step faults with the parameters as they are");
    fit.error_before = root_mean_square(residuals);
    require_influence(all, derivatives, fit.parameters);
    double damping = 1e-3;
    for (; fit.iterations < iterations; ++fit.iterations) {
        const Matrix normal = derivatives.transpose() * derivatives;
        const Vector gradient = derivatives.transpose() * residuals;
        Matrix damped = normal;
        damped.diagonal() += damping * normal.diagonal();
        const Vector step = damped.ldlt().solve(-gradient);
        const Vector tried = parameters + step;
        const bool is_better = step.allFinite() && all.compute(tried, tried_residuals, nullptr) &&
                               tried_residuals.squaredNorm() < residuals.squaredNorm();
        if (!is_better) {
            damping *= 4;
            fit.has_converged = damping > 1e12;
            if (fit.has_converged) break;
            continue;
        }
        const double gain = 1 - tried_residuals.squaredNorm() / residuals.squaredNorm();
        parameters = tried;
        all.compute(parameters, residuals, &derivatives);
        damping = std::max(damping / 8, 1e-15);
        fit.has_converged = gain < 1e-12;
        if (fit.has_converged) break;
    }
    fit.error_after = root_mean_square(residuals);
    require_influence(all, derivatives, fit.parameters);
    set_errors(derivatives, residuals, fit);
}

}  // namespace

Fit fit(const ProblemFiles& files, const LoadOptions& load, const rddl_simulator& simulator,
        const FitOptions& options) {
    const ir::Program original = program_of(files, load, {});
    const ir::Program open = program_of(files, load, options.parameters);
    Data data(simulator, original);
    for (const std::filesystem::path& trace : options.traces) data.read(trace);
    if (options.stops && options.stops()) {
        // A reader of lines ends at an interrupt, so that the data are not complete.
        Fit nothing;
        nothing.interrupted = true;
        return nothing;
    }
    if (data.steps.empty())
        throw Failure("the traces hold no step", "'rddl run --trace FILE' records some");
    Fit result;
    result.steps = static_cast<std::int64_t>(data.steps.size());
    result.faulted = data.faulted;
    Residuals residuals(original, open, simulator.problem->stochastic, options,
                        std::move(data.steps));
    if (residuals.count() == 0)
        throw Failure("the traces hold nothing to compare: no real in next states, and no reward");
    const auto names = names_of(open, ir::Storage::State);
    Vector parameters(static_cast<Eigen::Index>(residuals.parameter_count()));
    for (std::size_t p = 0; p < residuals.parameter_count(); ++p) {
        const NumberName& name = names[residuals.parameter_number(p)];
        const auto buffer = std::ranges::find_if(open.buffers, [&](const ir::Buffer& each) {
            return each.storage == ir::Storage::State && each.name == name.fluent;
        });
        const double start = std::get<double>(buffer->values[name.element]);
        parameters[static_cast<Eigen::Index>(p)] = start;
        std::string text = name.fluent;
        std::int64_t rest = name.element, size = buffer->count();
        for (std::size_t axis = 0; axis < buffer->types.size(); ++axis) {
            size /= buffer->shape[axis];
            text += axis == 0 ? "___" : "__";
            text += open.types[buffer->types[axis]].objects[static_cast<std::size_t>(rest / size)];
            rest %= size;
        }
        result.parameters.push_back({text, start, start, 0});
    }
    try {
        minimise(residuals, parameters, options.iterations, result);
    } catch (const Stopped&) {
        result.interrupted = true;
    }
    for (std::size_t p = 0; p < result.parameters.size(); ++p)
        result.parameters[p].value = parameters[static_cast<Eigen::Index>(p)];
    return result;
}

}  // namespace rddlc::workbench
