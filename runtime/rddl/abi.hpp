// The C interface (simulator.h) over batches: arguments are checked here, faults are put
// into words, and no exception passes.
#pragma once

#include <rddl/action_choices.hpp>
#include <rddl/any_engine.hpp>
#include <rddl/batch.hpp>
#include <rddl/fault_text.hpp>
#include <rddl/simulator.h>
#include <rddl/simulator_table.hpp>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <optional>
#include <span>
#include <thread>
#include <type_traits>
#include <utility>
#include <variant>

namespace rddl {

// A caller in C may give any number as an enumerator, which C++ may not even look at.
template <class Enumeration>
int number_of(const Enumeration& given) {
    int number = 0;
    static_assert(sizeof number == sizeof given);
    std::memcpy(&number, &given, sizeof number);
    return number;
}

// The options with their defaults resolved; nothing if they are out of range.
inline std::optional<BatchOptions> checked_options(const rddl_problem& problem,
                                                   const rddl_batch_options& given) {
    const bool valid = given.environment_count > 0 && given.thread_count >= 0 &&
                       number_of(given.autoreset) >= RDDL_AUTORESET_DISABLED &&
                       number_of(given.autoreset) <= RDDL_AUTORESET_SAME_STEP &&
                       given.horizon >= -1;
    if (!valid) return std::nullopt;
    const std::int64_t threads =
        given.thread_count > 0 ? given.thread_count : std::thread::hardware_concurrency();
    const std::int64_t useful_threads = threads < 1 ? 1
                                        : threads < given.environment_count
                                            ? threads
                                            : given.environment_count;
    return BatchOptions{.environment_count = given.environment_count,
                        .first_environment = given.first_environment,
                        .seed = given.seed,
                        .thread_count = static_cast<int>(useful_threads),
                        .autoreset = given.autoreset,
                        .horizon = given.horizon < 0 ? problem.horizon : given.horizon,
                        .partially_observed = problem.partially_observed != 0};
}

// The functions of the table, for simulators whose engine for larger batches has the lane type L.
template <class L>
class Functions {
  public:
    static rddl_simulator table(const SimulatorParts<L>& parts);

  private:
    using Parts = SimulatorParts<L>;
    static constexpr bool has_packs = L::width > 1;
    using One = ScalarOf<typename L::Element>;
    using OneByOne = Batch<AnyEngine<One>>;
    using AnyBatch = std::conditional_t<has_packs, std::variant<OneByOne, Batch<AnyEngine<L>>>,
                                        std::variant<OneByOne>>;

    // What an rddl_batch is.
    struct Handle {
        template <class Kind, class OneEngine>
        Handle(const Parts& of_maker, std::in_place_type_t<Kind> kind, const OneEngine& engine,
               const BatchOptions& options)
            : maker(&of_maker), batch(kind, engine, *of_maker.problem, options) {}
        Handle(const Handle& other) : maker(other.maker), batch(other.batch) {}
        Handle& operator=(const Handle&) = delete;

        const Parts* maker;
        AnyBatch batch;
        const BatchView<One>* only_one = [this] {
            const auto* const one_by_one = std::get_if<OneByOne>(&batch);
            return one_by_one ? one_by_one->only_one() : nullptr;
        }();

        const rddl_problem& problem() const { return *maker->problem; }
        template <class Use>
        decltype(auto) use(Use&& use) {
            return std::visit(use, batch);
        }
        template <class Use>
        decltype(auto) use(Use&& use) const {
            return std::visit(use, batch);
        }
        std::int64_t environment_count() const {
            return use([](const auto& some) { return some.environment_count(); });
        }
        bool has(std::int64_t begin, std::int64_t count) const {
            const std::int64_t all = environment_count();
            return begin >= 0 && count >= 0 && begin <= all && count <= all - begin;
        }
    };
    static Handle& handle(rddl_batch* batch) { return *reinterpret_cast<Handle*>(batch); }
    static const Handle& handle(const rddl_batch* batch) {
        return *reinterpret_cast<const Handle*>(batch);
    }

    template <class OneEngine>
    static bool sizes_agree(const rddl_problem& problem, const OneEngine& engine) {
        const auto agree = [&](rddl_role role, std::int64_t row_size, std::size_t block_size) {
            const Columns columns = columns_of<typename OneEngine::Lane>(problem, role, row_size);
            return columns.block_size == static_cast<std::int64_t>(block_size);
        };
        return agree(RDDL_STATE, problem.state_size, engine.state_size()) &&
               agree(RDDL_ACTION, problem.action_size, engine.action_size()) &&
               agree(problem.partially_observed != 0 ? RDDL_OBSERVATION : RDDL_STATE,
                     problem.observation_size, engine.observation_size());
    }

    // Packs wait for their slowest lane and have more to start and to end, so one environment is
    // stepped alone.
    static bool wants_packs(const rddl_batch_options& options) {
        return options.lane_count == 0 ? options.environment_count > 1 : options.lane_count > 1;
    }

    static Site site_of(const Parts& parts, const FaultRecord& fault) {
        if (fault.kind == FaultKind::ActionLimit) return {parts.policy->source, "the policy", {}};
        return parts.sites[fault.place.site];
    }

    static rddl_batch* create(const rddl_simulator* simulator, const rddl_batch_options* options) {
        if (simulator == nullptr || options == nullptr) return nullptr;
        const auto& maker = *static_cast<const Parts*>(simulator->self);
        const auto checked = checked_options(*maker.problem, *options);
        const bool lanes_exist =
            options->lane_count == 0 || options->lane_count == 1 || options->lane_count == L::width;
        if (!checked || !lanes_exist) return nullptr;
        try {
            if constexpr (has_packs)
                if (wants_packs(*options)) return make(maker, maker.packed_engine, *checked);
            return make(maker, maker.engine, *checked);
        } catch (...) {
            return nullptr;
        }
    }
    template <class OneEngine>
    static rddl_batch* make(const Parts& maker, const OneEngine& engine,
                            const BatchOptions& options) {
        if (!sizes_agree(*maker.problem, engine)) return nullptr;
        const auto kind = std::in_place_type<Batch<OneEngine>>;
        return reinterpret_cast<rddl_batch*>(new Handle(maker, kind, engine, options));
    }

    static rddl_batch* copy(const rddl_batch* batch) {
        if (batch == nullptr) return nullptr;
        try {
            return reinterpret_cast<rddl_batch*>(new Handle(handle(batch)));
        } catch (...) {
            return nullptr;
        }
    }

    static void destroy(rddl_batch* batch) {
        if (batch != nullptr) delete &handle(batch);
    }

    static rddl_error reset(rddl_batch* batch, const std::uint8_t* mask, void* observations) {
        if (batch == nullptr) return RDDL_BAD_ARGUMENT;
        handle(batch).use([&](auto& environments) {
            environments.reset(mask, static_cast<std::byte*>(observations));
        });
        return RDDL_OK;
    }

    static rddl_error step(rddl_batch* batch, const void* actions, const rddl_transition* out) {
        if (batch == nullptr || out == nullptr) return RDDL_BAD_ARGUMENT;
        const auto* const records = static_cast<const std::byte*>(actions);
        const Handle& all = handle(batch);
        if (all.only_one && all.only_one->blocks.are_blocks(records))
            return all.maker->engine.advance_one(*all.only_one, 0, {records, nullptr}, *out);
        return step_any(handle(batch), records, *out);
    }
    // Apart, so that a step of one environment saves no registers for it.
    [[gnu::noinline]] static rddl_error step_any(Handle& any, const std::byte* records,
                                                 const rddl_transition& out) {
        return any.use([&](auto& environments) {
            if (!environments.accepts_actions(records)) return RDDL_BAD_ARGUMENT;
            environments.step(records, out);
            return RDDL_OK;
        });
    }

    static rddl_error step_values(rddl_batch* batch, rddl_number number, const void* actions,
                                  void* observations, const rddl_transition* out) {
        if (batch == nullptr || out == nullptr) return RDDL_BAD_ARGUMENT;
        return with_number(number_of(number), [&]<class Number>(Number) {
            const auto* const rows = static_cast<const Number*>(actions);
            return handle(batch).use([&](auto& environments) {
                const Columns& columns = environments.action_columns();
                const std::int64_t count = environments.environment_count();
                if (columns.value_count > 0 &&
                    (rows == nullptr || !values_are_valid(columns, rows, count)))
                    return RDDL_BAD_ARGUMENT;
                environments.step_values(rows, static_cast<Number*>(observations), *out);
                return RDDL_OK;
            });
        });
    }
    static rddl_error get_observation_values(const rddl_batch* batch, rddl_number number,
                                             void* observations) {
        if (batch == nullptr || observations == nullptr) return RDDL_BAD_ARGUMENT;
        return with_number(number_of(number), [&]<class Number>(Number) {
            handle(batch).use([&](const auto& environments) {
                environments.get_observation_values(static_cast<Number*>(observations));
            });
            return RDDL_OK;
        });
    }
    template <class Use>
    static rddl_error with_number(int number, Use&& use) {
        if (number == RDDL_FLOAT) return use(float{});
        if (number == RDDL_DOUBLE) return use(double{});
        return RDDL_BAD_ARGUMENT;
    }

    static std::int64_t action_value_count(const rddl_simulator* simulator) {
        return simulator == nullptr ? 0 : value_count(*simulator->problem, RDDL_ACTION);
    }
    static std::int64_t observation_value_count(const rddl_simulator* simulator) {
        if (simulator == nullptr) return 0;
        const bool partially_observed = simulator->problem->partially_observed != 0;
        return value_count(*simulator->problem, partially_observed ? RDDL_OBSERVATION : RDDL_STATE);
    }
    static std::int64_t value_count(const rddl_problem& problem, rddl_role role) {
        return columns_of<Scalar>(problem, role, 0).value_count;
    }

    static rddl_error violated_preconditions(rddl_batch* batch, const void* actions,
                                             std::int32_t* first_violated) {
        if (batch == nullptr || first_violated == nullptr) return RDDL_BAD_ARGUMENT;
        return handle(batch).use([&](auto& environments) {
            const auto* const records = static_cast<const std::byte*>(actions);
            if (!environments.accepts_actions(records)) return RDDL_BAD_ARGUMENT;
            environments.violated_preconditions(records, first_violated);
            return RDDL_OK;
        });
    }

    static std::int64_t action_choice_count(const rddl_simulator* simulator) {
        return simulator == nullptr ? 0 : choice_count(*simulator->problem);
    }

    static rddl_error action_choice(const rddl_simulator* simulator, std::int64_t choice,
                                    void* action) {
        if (simulator == nullptr || choice < 0 || choice >= choice_count(*simulator->problem))
            return RDDL_BAD_ARGUMENT;
        const rddl_problem& problem = *simulator->problem;
        if (problem.action_size == 0) return RDDL_OK;
        if (action == nullptr) return RDDL_BAD_ARGUMENT;
        std::memcpy(action, problem.default_action, static_cast<std::size_t>(problem.action_size));
        write_choice(problem, choice, action);
        return RDDL_OK;
    }

    static rddl_error action_mask(rddl_batch* batch, std::uint8_t* masks) {
        if (batch == nullptr || masks == nullptr) return RDDL_BAD_ARGUMENT;
        handle(batch).use([&](auto& environments) { environments.action_mask(masks); });
        return RDDL_OK;
    }

    static rddl_error policy_act(rddl_batch* batch, void* actions) {
        if (batch == nullptr) return RDDL_BAD_ARGUMENT;
        const rddl_problem& problem = handle(batch).problem();
        if (actions == nullptr && problem.action_size > 0) return RDDL_BAD_ARGUMENT;
        std::get<OneByOne>(handle(batch).batch).act(static_cast<std::byte*>(actions));
        return RDDL_OK;
    }

    // Calls body(batch, k, environment) for each of the environments.
    template <class AnyHandle, class Body>
    static rddl_error for_each(AnyHandle* batch, std::int64_t begin, std::int64_t count,
                               Body&& body) {
        if (batch == nullptr || !handle(batch).has(begin, count)) return RDDL_BAD_ARGUMENT;
        handle(batch).use([&](auto& environments) {
            for (std::int64_t k = 0; k < count; ++k) body(environments, k, begin + k);
        });
        return RDDL_OK;
    }

    static rddl_error get_state(const rddl_batch* batch, std::int64_t begin, std::int64_t count,
                                void* states) {
        if (states == nullptr) return RDDL_BAD_ARGUMENT;
        return for_each(batch, begin, count, [&](const auto& all, std::int64_t k, std::int64_t i) {
            const std::int64_t size = handle(batch).problem().state_size;
            all.get_state(i, static_cast<std::byte*>(states) + k * size);
        });
    }

    static rddl_error get_observation(const rddl_batch* batch, std::int64_t begin,
                                      std::int64_t count, void* records) {
        if (records == nullptr) return RDDL_BAD_ARGUMENT;
        return for_each(batch, begin, count, [&](const auto& all, std::int64_t k, std::int64_t i) {
            const std::int64_t size = handle(batch).problem().observation_size;
            all.get_observation(i, static_cast<std::byte*>(records) + k * size);
        });
    }

    static rddl_error set_state(rddl_batch* batch, std::int64_t begin, std::int64_t count,
                                const void* states) {
        if (batch == nullptr || states == nullptr || !handle(batch).has(begin, count))
            return RDDL_BAD_ARGUMENT;
        return handle(batch).use([&](auto& environments) {
            const auto* record = static_cast<const std::byte*>(states);
            if (!environments.accepts_states(record, count)) return RDDL_BAD_ARGUMENT;
            const std::int64_t size = handle(batch).problem().state_size;
            for (std::int64_t i = begin; i < begin + count; ++i, record += size)
                environments.set_state(i, record);
            return RDDL_OK;
        });
    }

    static rddl_error get_progress(const rddl_batch* batch, std::int64_t begin, std::int64_t count,
                                   std::int64_t* steps, std::int64_t* episodes) {
        return for_each(batch, begin, count, [&](const auto& all, std::int64_t k, std::int64_t i) {
            if (steps != nullptr) steps[k] = all.steps(i);
            if (episodes != nullptr) episodes[k] = all.episode_number(i);
        });
    }

    static rddl_error get_causes(const rddl_batch* batch, std::int64_t begin, std::int64_t count,
                                 std::uint8_t* causes) {
        if (causes == nullptr) return RDDL_BAD_ARGUMENT;
        return for_each(batch, begin, count, [&](const auto& all, std::int64_t k, std::int64_t i) {
            causes[k] = all.causes(i);
        });
    }

    static rddl_error get_fault(const rddl_batch* batch, std::int64_t environment,
                                rddl_fault* fault) {
        if (fault == nullptr) return RDDL_BAD_ARGUMENT;
        return for_each(batch, environment, 1, [&](const auto& all, std::int64_t, std::int64_t i) {
            const FaultRecord* const record = all.fault(i);
            fault->faulty = record != nullptr;
            if (record == nullptr) return;
            const Site site = site_of(*handle(batch).maker, *record);
            fault->step = static_cast<std::int32_t>(all.steps_before_fault(i));
            fault->source = site.source;
            describe_fault(*record, site, fault->message);
        });
    }
};

template <class L>
rddl_simulator Functions<L>::table(const Parts& parts) {
    return {.abi_version = RDDL_ABI_VERSION,
            .struct_size = sizeof(rddl_simulator),
            .problem = parts.problem,
            .self = &parts,
            .create = create,
            .destroy = destroy,
            .reset = reset,
            .step = step,
            .get_state = get_state,
            .set_state = set_state,
            .get_observation = get_observation,
            .get_progress = get_progress,
            .get_causes = get_causes,
            .get_fault = get_fault,
            .violated_preconditions = violated_preconditions,
            .copy = copy,
            .action_choice_count = action_choice_count,
            .action_choice = action_choice,
            .action_mask = action_mask,
            .policy = parts.policy,
            .policy_act = parts.policy ? policy_act : nullptr,
            .lane_count = L::width,
            .instruction_set = parts.instruction_set,
            .action_value_count = action_value_count,
            .observation_value_count = observation_value_count,
            .step_values = step_values,
            .get_observation_values = get_observation_values};
}

template <class L>
rddl_simulator table_of(const SimulatorParts<L>& parts) {
    return Functions<L>::table(parts);
}

}  // namespace rddl
