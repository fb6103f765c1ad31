#include "native/env_pool.hpp"

#include "native/buffers.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cstring>
#include <new>

namespace nb = nanobind;

namespace rddlc::python {

namespace {

rddl_batch_options options_of(const EnvPoolSettings& settings, const rddl_problem& problem) {
    rddl_batch_options options{};
    options.struct_size = sizeof options;
    options.thread_count = settings.threads;
    options.environment_count = settings.environments;
    options.autoreset = settings.autoreset;
    options.horizon = settings.horizon;
    options.keeps_steps = settings.environments == 1 && problem.interm_size > 0;
    return options;
}

solvers::BatchHandle copy_of(const rddl_simulator& simulator, const rddl_batch* batch) {
    solvers::BatchHandle copy(simulator.copy(batch), simulator.destroy);
    if (!copy) throw std::bad_alloc();
    return copy;
}

}  // namespace

EnvPool::EnvPool(workbench::Simulator simulator, const EnvPoolSettings& settings)
    : simulator_(std::move(simulator)),
      settings_(settings),
      batch_(nullptr, simulator_->destroy),
      process_(::getpid()),
      action_columns_(simulator_->action_value_count(simulator_.get())),
      observation_columns_(simulator_->observation_value_count(simulator_.get())),
      records_of_values_(*simulator_),
      calls_(settings.environments > 1) {
    if (settings.environments < 1)
        throw Refused(fmt::format("num_envs is {}: one or more", settings.environments));
    solvers::require_memory(*simulator_, settings.environments, default_memory_limit);
    batch_ = solvers::create_batch(*simulator_, options_of(settings, *simulator_->problem));
    const rddl_problem& problem = *simulator_->problem;
    const auto count = static_cast<std::size_t>(settings.environments);
    const std::size_t size = number_size();
    const auto records = [&](std::int64_t bytes) {
        return std::vector<std::byte>(count * static_cast<std::size_t>(bytes));
    };
    const auto matrix = [&](std::int64_t columns) {
        return std::vector<std::byte>(count * static_cast<std::size_t>(columns) * size);
    };
    arrays_ = {records(problem.action_size),      records(problem.observation_size),
               records(problem.observation_size), records(problem.state_size),
               matrix(action_columns_),           matrix(observation_columns_),
               matrix(observation_columns_),      std::vector<double>(count),
               std::vector<std::uint8_t>(count),  std::vector<std::uint8_t>(count),
               std::vector<std::uint8_t>(count)};
}

EnvPool::EnvPool(const EnvPool& other)
    : simulator_(other.simulator_),
      settings_(other.settings_),
      batch_(copy_of(*other.simulator_, other.batch_.get())),
      process_(::getpid()),
      action_columns_(other.action_columns_),
      observation_columns_(other.observation_columns_),
      arrays_(other.arrays_),
      records_of_values_(other.records_of_values_),
      calls_(other.calls_) {}

// A forked process lacks the threads of its parent: a copy has threads of its own. The old batch is
// not destroyed there, since that waits for its threads.
rddl_batch* EnvPool::live() {
    finish();
    if (settings_.threads == 1 || process_ == ::getpid()) return batch_.get();
    solvers::BatchHandle copy = copy_of(*simulator_, batch_.get());
    static_cast<void>(batch_.release());
    batch_ = std::move(copy);
    process_ = ::getpid();
    return batch_.get();
}

rddl_transition EnvPool::transition(const Outputs& outputs) {
    const auto given = [](auto* own, auto* other) {
        return other ? other : own;
    };
    rddl_transition out{};
    out.struct_size = sizeof out;
    if (settings_.shows_records) out.observations = arrays_.observations.data();
    if (settings_.autoreset == RDDL_AUTORESET_SAME_STEP) {
        out.final_observations = arrays_.final_observations.data();
        out.final_states = arrays_.final_states.data();
    }
    out.rewards = given(arrays_.rewards.data(), outputs.rewards);
    out.terminated = given(arrays_.terminated.data(), outputs.terminated);
    out.truncated = given(arrays_.truncated.data(), outputs.truncated);
    out.causes = arrays_.causes.data();
    return out;
}

void EnvPool::reset(const std::uint8_t* mask) {
    rddl_batch* const batch = live();
    const std::vector<std::uint8_t> where(mask, mask ? mask + settings_.environments : mask);
    calls_.run([=, this] {
        check(*simulator_, simulator_->reset(batch, where.empty() ? nullptr : where.data(),
                                             arrays_.observations.data()));
        read_values(arrays_.observation_values.data());
    });
}

void EnvPool::read_values(void* values) {
    if (settings_.shows_values)
        check(*simulator_, simulator_->get_observation_values(batch_.get(), number(), values));
}

// Eight at a time: few steps end anything.
bool EnvPool::has_ended() const {
    const std::uint8_t* const causes = arrays_.causes.data();
    const std::size_t count = arrays_.causes.size();
    std::uint64_t all = 0;
    std::size_t i = 0;
    for (; i + 8 <= count; i += 8) {
        std::uint64_t some;
        std::memcpy(&some, causes + i, sizeof some);
        all |= some;
    }
    for (; i < count; ++i) all |= causes[i];
    return all != 0;
}

bool EnvPool::step(const Outputs& outputs) {
    rddl_batch* const batch = live();
    const rddl_transition out = transition(outputs);
    void* const values = outputs.values ? outputs.values : arrays_.observation_values.data();
    calls_.run(
        [=, this] {
            check(*simulator_, simulator_->step(batch, arrays_.actions.data(), &out));
            read_values(values);
        },
        outputs.kept);
    return has_ended();
}

bool EnvPool::step_values(const Outputs& outputs, const void* actions, nb::handle kept) {
    rddl_batch* const batch = live();
    rddl_transition out = transition(outputs);
    if (settings_.autoreset == RDDL_AUTORESET_SAME_STEP)
        out.final_observation_values = arrays_.final_values.data();
    void* const own = settings_.shows_values ? arrays_.observation_values.data() : nullptr;
    void* const values = outputs.values ? outputs.values : own;
    calls_.run(
        [=, this] {
            check(*simulator_, simulator_->step_values(batch, number(), actions, values, &out));
        },
        kept.is_valid() ? kept : outputs.kept);
    return has_ended();
}

Outputs EnvPool::outputs_in(nb::handle arrays) const {
    if (arrays.is_none()) return {};
    if (!nb::isinstance<nb::tuple>(arrays) || nb::len(arrays) != 4)
        throw Refused("a step writes into four arrays");
    const auto count = static_cast<std::size_t>(settings_.environments);
    Outputs outputs;
    outputs.kept = arrays;
    if (!arrays[0].is_none())
        outputs.values = memory_of<std::byte>(
            arrays[0], count * static_cast<std::size_t>(observation_columns_), number_size());
    outputs.rewards = memory_of<double>(arrays[1], count);
    outputs.terminated = memory_of<std::uint8_t>(arrays[2], count);
    outputs.truncated = memory_of<std::uint8_t>(arrays[3], count);
    return outputs;
}

void EnvPool::set_seed(std::uint64_t seed) {
    check(*simulator_, simulator_->set_seed(live(), seed));
}

void EnvPool::set_seeds(std::int64_t begin, std::span<const std::uint64_t> seeds) {
    check(*simulator_, simulator_->set_seeds(live(), begin, static_cast<std::int64_t>(seeds.size()),
                                             seeds.data()));
}

void EnvPool::read_state(std::int64_t environment, std::byte* record) {
    check(*simulator_, simulator_->get_state(live(), environment, 1, record));
}

void EnvPool::read_states(std::byte* records, std::int64_t* steps, std::int64_t* episodes,
                          std::uint8_t* causes) {
    rddl_batch* const batch = live();
    const std::int64_t count = settings_.environments;
    check(*simulator_, simulator_->get_state(batch, 0, count, records));
    check(*simulator_, simulator_->get_progress(batch, 0, count, steps, episodes));
    check(*simulator_, simulator_->get_causes(batch, 0, count, causes));
}

void EnvPool::write_states(std::span<const std::int64_t> places, const std::byte* records,
                           std::span<const std::int64_t> steps) {
    rddl_batch* const batch = live();
    const std::int64_t size = simulator_->problem->state_size;
    for (std::size_t k = 0; k < places.size(); ++k)
        check(*simulator_,
              simulator_->set_state(batch, places[k], 1,
                                    records + static_cast<std::int64_t>(k) * size, &steps[k]));
    read_observations();
}

void EnvPool::become(EnvPool& other) {
    if (other.simulator_ != simulator_ || other.settings_.environments != settings_.environments)
        throw Refused("a batch becomes one of the same simulator and size");
    check(*simulator_,
          simulator_->copy_environments(live(), 0, settings_.environments, other.live(), nullptr));
    read_observations();
}

void EnvPool::read_observations() {
    if (settings_.shows_records)
        check(*simulator_, simulator_->get_observation(batch_.get(), 0, settings_.environments,
                                                       arrays_.observations.data()));
    read_values(arrays_.observation_values.data());
}

void EnvPool::read_interm(std::int64_t environment, std::byte* record) {
    check(*simulator_, simulator_->get_interm(live(), environment, 1, record));
}

std::pair<std::int64_t, std::int64_t> EnvPool::progress(std::int64_t environment) {
    std::int64_t steps = 0, episodes = 0;
    check(*simulator_, simulator_->get_progress(live(), environment, 1, &steps, &episodes));
    return {steps, episodes};
}

std::uint8_t EnvPool::causes(std::int64_t environment) {
    std::uint8_t causes = RDDL_RUNNING;
    check(*simulator_, simulator_->get_causes(live(), environment, 1, &causes));
    return causes;
}

std::string EnvPool::fault(std::int64_t environment) {
    rddl_fault fault{};
    fault.struct_size = sizeof fault;
    check(*simulator_, simulator_->get_fault(live(), environment, &fault));
    return fault.faulty ? fault.message : "";
}

std::vector<std::int32_t> EnvPool::violated_preconditions(std::span<const std::byte> actions) {
    if (actions.size() != arrays_.actions.size())
        throw Refused(fmt::format("actions of {} environments have {} bytes, not {}",
                                  settings_.environments, arrays_.actions.size(), actions.size()));
    std::vector<std::int32_t> violated(static_cast<std::size_t>(settings_.environments));
    check(*simulator_, simulator_->violated_preconditions(live(), actions.data(), violated.data()));
    return violated;
}

std::vector<std::int32_t> EnvPool::violated_preconditions(std::span<const float> values) {
    const auto count = static_cast<std::size_t>(settings_.environments);
    const auto columns = static_cast<std::size_t>(action_columns_);
    if (values.size() != count * columns)
        throw Refused(fmt::format("actions of {} environments have {} values, not {}", count,
                                  count * columns, values.size()));
    const std::size_t size = records_of_values_.record_size();
    std::vector<std::byte> records(count * size);
    for (std::size_t i = 0; i < count; ++i)
        records_of_values_.write(values.data() + i * columns, records.data() + i * size);
    return violated_preconditions(std::span<const std::byte>(records));
}

std::string EnvPool::explain_violation(std::int64_t environment) {
    rddl_violation violation{};
    violation.struct_size = sizeof violation;
    const std::byte* const action =
        arrays_.actions.data() + environment * simulator_->problem->action_size;
    check(*simulator_, simulator_->explain_violation(live(), environment, action, &violation));
    return violation.precondition < 0 ? "" : violation.message;
}

void EnvPool::action_masks(std::uint8_t* masks) {
    check(*simulator_, simulator_->action_mask(live(), nullptr, masks));
}

void EnvPool::act() {
    if (!simulator_->policy_act) throw Failure("the problem has no policy block");
    check(*simulator_, simulator_->policy_act(live(), arrays_.actions.data()));
}

}  // namespace rddlc::python
