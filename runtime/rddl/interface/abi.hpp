// The C interface (simulator.h) over batches: arguments are checked here, faults and errors are put
// into words, and no exception passes.
//
// Over 400 lines: each function of simulator.h stands here once, and little else does.
#pragma once

#include <rddl/batch/action_choices.hpp>
#include <rddl/batch/any_engine.hpp>
#include <rddl/batch/batch.hpp>
#include <rddl/batch/snapshot.hpp>
#include <rddl/interface/describe.hpp>
#include <rddl/interface/error_text.hpp>
#include <rddl/interface/fault_text.hpp>
#include <rddl/interface/refusals.hpp>
#include <rddl/interface/simulator_table.hpp>
#include <rddl/simulator.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <thread>
#include <type_traits>
#include <utility>
#include <variant>

namespace rddl {

// A caller in C may pass any number as an enumerator; even reading it as one is undefined in C++.
template <class Enumeration>
int number_of(const Enumeration& given) {
    int number = 0;
    static_assert(sizeof number == sizeof given);
    std::memcpy(&number, &given, sizeof number);
    return number;
}

// A struct from a caller whose header may be older or newer (simulator.h, Sizes); nothing if it
// asks for what is not known here.
template <class Struct>
std::optional<Struct> read_struct(const Struct* given) {
    Struct known{};
    if (given == nullptr) return known;
    const std::size_t size = given->struct_size == 0 ? sizeof known : given->struct_size;
    std::memcpy(&known, given, std::min(size, sizeof known));
    const auto* const bytes = reinterpret_cast<const std::byte*>(given);
    for (std::size_t k = sizeof known; k < size; ++k)
        if (bytes[k] != std::byte{0}) return std::nullopt;
    return known;
}
template <class Struct>
void write_struct(Struct* to, Struct value) {
    value.struct_size = to->struct_size;
    const std::size_t size = to->struct_size == 0 ? sizeof value : to->struct_size;
    std::memcpy(static_cast<void*>(to), &value, std::min(size, sizeof value));
}

inline bool have_objects(const rddl_problem& problem, rddl_role role) {
    const rddl_fluent* const end = problem.fluents + problem.fluent_count;
    return std::any_of(problem.fluents, end, [role](const rddl_fluent& fluent) {
        return fluent.role == role && fluent.range_type >= 0;
    });
}

// The error in the options; RDDL_OK if they are valid.
inline rddl_error check_options(const rddl_batch_options& given, std::int64_t lane_count) {
    if (given.environment_count < 0)
        return bad_argument("environment_count is negative: ", given.environment_count);
    if (given.first_environment < 0)
        return bad_argument("first_environment is negative: ", given.first_environment);
    if (given.thread_count < 0)
        return bad_argument("thread_count is negative: ", std::int64_t{given.thread_count});
    if (number_of(given.autoreset) < RDDL_AUTORESET_DISABLED ||
        number_of(given.autoreset) > RDDL_AUTORESET_SAME_STEP)
        return bad_argument("autoreset is not one of the three: ",
                            std::int64_t{number_of(given.autoreset)});
    if (given.horizon < RDDL_NO_HORIZON)
        return bad_argument("horizon is negative, and not RDDL_NO_HORIZON: ", given.horizon);
    if (given.lane_count != 0 && given.lane_count != 1 && given.lane_count != lane_count)
        return bad_argument("lane_count is ", std::int64_t{given.lane_count},
                            ", but the simulator has ", lane_count, " lanes, or 1");
    return RDDL_OK;
}

// The options with their defaults resolved.
inline BatchOptions resolved(const rddl_problem& problem, const rddl_batch_options& given) {
    const std::int64_t count = std::max<std::int64_t>(given.environment_count, 1);
    const std::int64_t threads =
        given.thread_count > 0 ? given.thread_count : std::thread::hardware_concurrency();
    return {.environment_count = count,
            .first_environment = given.first_environment,
            .seed = given.seed,
            .thread_count = static_cast<int>(std::clamp<std::int64_t>(threads, 1, count)),
            .autoreset = given.autoreset,
            .horizon = given.horizon == RDDL_NO_HORIZON ? 0
                       : given.horizon == 0             ? problem.horizon
                                                        : given.horizon,
            .partially_observed = problem.partially_observed != 0,
            .keeps_steps = given.keeps_steps != 0};
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

    // The content of an rddl_batch.
    struct Handle {
        template <class Kind, class OneEngine>
        Handle(const Parts& of_maker, std::in_place_type_t<Kind> kind, const OneEngine& engine,
               const BatchOptions& options)
            : maker(&of_maker),
              batch(std::make_unique<AnyBatch>(kind, engine, *of_maker.problem, options)) {}
        Handle(const Handle& other)
            : maker(other.maker), batch(std::make_unique<AnyBatch>(*other.batch)) {}
        Handle& operator=(const Handle&) = delete;

        const Parts* maker;
        std::unique_ptr<AnyBatch> batch;
        const BatchView<One>* only_one = [this] {
            const auto* const one_by_one = std::get_if<OneByOne>(batch.get());
            return one_by_one ? one_by_one->only_one() : nullptr;
        }();

        // Room for environments that are copied into the batch.
        std::optional<Environment> copied;

        const rddl_problem& problem() const { return *maker->problem; }
        template <class Use>
        decltype(auto) use(Use&& use) {
            return std::visit(use, *batch);
        }
        template <class Use>
        decltype(auto) use(Use&& use) const {
            return std::visit(use, *batch);
        }
        std::int64_t environment_count() const {
            return use([](const auto& some) { return some.environment_count(); });
        }
        // From now on the environments are stepped one by one if packs cannot hold these states,
        // which an episode does not reach. Throws std::bad_alloc.
        void make_room_for(const std::byte* states, std::int64_t count) {
            if constexpr (has_byte_ints<L>)
                if (!use([&](const auto& all) { return all.can_hold_states(states, count); }))
                    step_one_by_one();
        }
        void step_one_by_one() {
            auto next = use([&](const auto& packed) {
                auto all = std::make_unique<AnyBatch>(std::in_place_type<OneByOne>, maker->engine,
                                                      problem(), packed.options());
                Environment environment(problem(), memory_size(maker->engine));
                for (std::int64_t i = 0; i < packed.environment_count(); ++i) {
                    packed.get_environment(i, environment);
                    std::get<OneByOne>(*all).set_environment(i, environment);
                }
                return all;
            });
            batch = std::move(next);
            only_one = std::get<OneByOne>(*batch).only_one();
        }
        // RDDL_OK if there are environments [begin, begin + count).
        rddl_error check(std::int64_t begin, std::int64_t count) const {
            const std::int64_t all = environment_count();
            if (begin >= 0 && count >= 0 && begin <= all && count <= all - begin) return RDDL_OK;
            return bad_argument("there are no ", count, " environments from ", begin, " on among ",
                                all);
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
        const std::size_t state_size = engine.state_size() - sliding_buffers_size(engine);
        const std::size_t observation_size =
            problem.partially_observed != 0 ? engine.observation_size() : state_size;
        return agree(RDDL_STATE, problem.state_size, state_size) &&
               agree(RDDL_ACTION, problem.action_size, engine.action_size()) &&
               agree(problem.partially_observed != 0 ? RDDL_OBSERVATION : RDDL_STATE,
                     problem.observation_size, observation_size);
    }

    // Packs wait for their slowest lane and have more to start and to end, and lanes without an
    // environment are computed too. So a few environments are stepped one after the other.
    static bool wants_packs(std::int32_t lane_count, std::int64_t environment_count) {
        return lane_count == 0 ? environment_count >= std::max(2, L::width / 4) : lane_count > 1;
    }

    static Site site_of(const Parts& parts, const FaultRecord& fault) {
        if (fault.kind == FaultKind::ActionLimit) return {parts.policy->source, "the policy", {}};
        return parts.sites[fault.place.site];
    }

    static rddl_batch* create(const rddl_simulator* simulator, const rddl_batch_options* options) {
        if (simulator == nullptr) return failed_batch(missing("the simulator"));
        const auto given = read_struct(options);
        if (!given)
            return failed_batch(fail(RDDL_UNSUPPORTED, "an option is newer than the simulator"));
        if (check_options(*given, L::width) != RDDL_OK) return nullptr;
        const auto& maker = *static_cast<const Parts*>(simulator->self);
        const BatchOptions checked = resolved(*maker.problem, *given);
        return made([&]() -> Handle* {
            if constexpr (has_packs)
                if (wants_packs(given->lane_count, checked.environment_count))
                    return make(maker, maker.packed_engine, checked);
            return make(maker, maker.engine, checked);
        });
    }
    template <class OneEngine>
    static Handle* make(const Parts& maker, const OneEngine& engine, const BatchOptions& options) {
        if (!sizes_agree(*maker.problem, engine)) {
            bad_argument("the simulator's records are not as it describes them");
            return nullptr;
        }
        return new Handle(maker, std::in_place_type<Batch<OneEngine>>, engine, options);
    }

    static rddl_batch* copy(const rddl_batch* batch) {
        if (batch == nullptr) return failed_batch(missing("the batch"));
        return made([&] { return new Handle(handle(batch)); });
    }

    // Calls a function whose result is a batch.
    template <class Make>
    static rddl_batch* made(Make&& make) {
        try {
            return reinterpret_cast<rddl_batch*>(make());
        } catch (...) {
            return failed_batch(out_of_memory());
        }
    }
    static rddl_batch* failed_batch(rddl_error) { return nullptr; }
    // Whether an array of records is needed and not there.
    static bool lacks(const void* records, std::int64_t count, std::int64_t size) {
        return records == nullptr && count > 0 && size > 0;
    }
    static rddl_error missing(std::string_view what) { return bad_argument(what, " is missing"); }

    static void destroy(rddl_batch* batch) {
        if (batch != nullptr) delete &handle(batch);
    }

    static rddl_error reset(rddl_batch* batch, const std::uint8_t* mask, void* observations) {
        if (batch == nullptr) return missing("the batch");
        handle(batch).use([&](auto& environments) {
            environments.reset(mask, static_cast<std::byte*>(observations));
        });
        return RDDL_OK;
    }

    // A function of its own for problems whose actions have objects: the others test none.
    template <bool actions_have_objects>
    static rddl_error step(rddl_batch* batch, const void* actions, const rddl_transition* out) {
        if (batch == nullptr || out == nullptr) return missing("the batch or the transition");
        const auto* const records = static_cast<const std::byte*>(actions);
        const Handle& all = handle(batch);
        if (all.only_one && out->struct_size <= sizeof *out &&
            all.only_one->blocks.are_blocks(records) &&
            (!actions_have_objects ||
             record_is_valid(*all.only_one->blocks.action_columns, records)))
            return all.maker->engine.advance_one(*all.only_one, 0, {records, nullptr}, *out);
        return step_any(handle(batch), records, *out);
    }
    // Apart, so that a step of one environment saves no registers for it.
    [[gnu::noinline]] static rddl_error step_any(Handle& any, const std::byte* records,
                                                 const rddl_transition& out) {
        if (!is_known(out)) return newer_transition();
        return any.use([&](auto& environments) {
            if (!environments.takes_actions(records)) return refused_actions(any, records);
            environments.step(records, out);
            return RDDL_OK;
        });
    }

    // A caller's header may be newer.
    static bool is_known(const rddl_transition& out) {
        return out.struct_size <= sizeof out || read_struct(&out).has_value();
    }
    static rddl_error newer_transition() {
        return fail(RDDL_UNSUPPORTED, "a member of the transition is newer than the simulator");
    }
    static rddl_error refused_actions(const Handle& any, const void* records) {
        return refuse_records(any.problem(), RDDL_ACTION, static_cast<const std::byte*>(records), 0,
                              any.environment_count());
    }

    static rddl_error step_values(rddl_batch* batch, rddl_number number, const void* actions,
                                  void* observations, const rddl_transition* out) {
        if (batch == nullptr || out == nullptr) return missing("the batch or the transition");
        if (!is_known(*out)) return newer_transition();
        return with_number(number_of(number), [&]<class Number>(Number) {
            const auto* const rows = static_cast<const Number*>(actions);
            return handle(batch).use([&](auto& environments) {
                const Columns& columns = environments.action_columns();
                const std::int64_t count = environments.environment_count();
                if (columns.value_count > 0 && rows == nullptr)
                    return refused_actions(handle(batch), nullptr);
                if (columns.value_count > 0 && !values_are_valid(columns, rows, count))
                    return refuse_values(handle(batch).problem(), rows, count);
                environments.step_values(rows, static_cast<Number*>(observations), *out);
                return RDDL_OK;
            });
        });
    }
    static rddl_error get_observation_values(const rddl_batch* batch, rddl_number number,
                                             void* observations) {
        if (batch == nullptr || observations == nullptr)
            return missing("the batch or the room for observations");
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
        return bad_argument("numbers are RDDL_FLOAT or RDDL_DOUBLE, not ", std::int64_t{number});
    }

    static std::int64_t action_value_count(const rddl_simulator* simulator) {
        return simulator == nullptr ? 0 : value_count(*simulator->problem, RDDL_ACTION);
    }
    static std::int64_t observation_value_count(const rddl_simulator* simulator) {
        if (simulator == nullptr) return 0;
        return value_count(*simulator->problem, observed_role(*simulator->problem));
    }
    static rddl_role observed_role(const rddl_problem& problem) {
        return problem.partially_observed != 0 ? RDDL_OBSERVATION : RDDL_STATE;
    }
    static std::int64_t value_count(const rddl_problem& problem, rddl_role role) {
        return columns_of<Scalar>(problem, role, 0).value_count;
    }

    static rddl_error action_column(const rddl_simulator* simulator, std::int64_t column,
                                    rddl_column* out) {
        if (simulator == nullptr) return missing("the simulator");
        return write_column(*simulator->problem, RDDL_ACTION, column, out);
    }
    static rddl_error observation_column(const rddl_simulator* simulator, std::int64_t column,
                                         rddl_column* out) {
        if (simulator == nullptr) return missing("the simulator");
        const rddl_problem& problem = *simulator->problem;
        return write_column(problem, observed_role(problem), column, out);
    }
    static rddl_error write_column(const rddl_problem& problem, rddl_role role, std::int64_t column,
                                   rddl_column* out) {
        if (out == nullptr) return missing("the room for the column");
        const auto found = column_at(problem, role, column);
        if (!found) return bad_argument("there is no column ", column);
        write_struct(out, *found);
        return RDDL_OK;
    }

    static rddl_error violated_preconditions(rddl_batch* batch, const void* actions,
                                             std::int32_t* first_violated) {
        if (batch == nullptr || first_violated == nullptr)
            return missing("the batch or the room for preconditions");
        return handle(batch).use([&](auto& environments) {
            const auto* const records = static_cast<const std::byte*>(actions);
            if (!environments.accepts_actions(records))
                return refused_actions(handle(batch), records);
            environments.violated_preconditions(records, first_violated);
            return RDDL_OK;
        });
    }

    static std::int64_t action_choice_count(const rddl_simulator* simulator) {
        return simulator == nullptr ? 0 : choice_count(*simulator->problem);
    }

    static rddl_error action_choice(const rddl_simulator* simulator, std::int64_t choice,
                                    void* action, rddl_choice* out) {
        if (simulator == nullptr) return missing("the simulator");
        const rddl_problem& problem = *simulator->problem;
        const std::int64_t count = choice_count(problem);
        if (choice < 0 || choice >= count)
            return bad_argument("there is no choice ", choice, " among ", count);
        rddl_choice told{.struct_size = 0, .fluent = -1, .grounding = 0, .value = 0};
        Change change{};
        if (choice > 0) {
            change = change_of(problem, choice);
            told.fluent = static_cast<std::int32_t>(change.fluent - problem.fluents);
            told.grounding = change.grounding;
            told.value = change.value;
        }
        if (out != nullptr) write_struct(out, told);
        if (action == nullptr || problem.action_size == 0) return RDDL_OK;
        std::memcpy(action, problem.default_action, static_cast<std::size_t>(problem.action_size));
        if (choice > 0) change.exchange(action, change.value);
        return RDDL_OK;
    }

    static rddl_error action_mask(rddl_batch* batch, const void* actions, std::uint8_t* masks) {
        if (batch == nullptr || masks == nullptr) return missing("the batch or the room for masks");
        return handle(batch).use([&](auto& environments) {
            const auto* const records = static_cast<const std::byte*>(actions);
            if (records != nullptr && !environments.accepts_actions(records))
                return refused_actions(handle(batch), records);
            environments.action_mask(records, masks);
            return RDDL_OK;
        });
    }

    static rddl_error policy_act(rddl_batch* batch, void* actions) {
        if (batch == nullptr) return missing("the batch");
        const rddl_problem& problem = handle(batch).problem();
        if (actions == nullptr && problem.action_size > 0) return missing("the room for actions");
        std::get<OneByOne>(*handle(batch).batch).act(static_cast<std::byte*>(actions));
        return RDDL_OK;
    }

    // Calls body(batch, k, environment) for each of the environments.
    template <class AnyHandle, class Body>
    static rddl_error for_each(AnyHandle* batch, std::int64_t begin, std::int64_t count,
                               Body&& body) {
        if (batch == nullptr) return missing("the batch");
        if (const rddl_error error = handle(batch).check(begin, count)) return error;
        handle(batch).use([&](auto& environments) {
            for (std::int64_t k = 0; k < count; ++k) body(environments, k, begin + k);
        });
        return RDDL_OK;
    }

    static rddl_error get_state(const rddl_batch* batch, std::int64_t begin, std::int64_t count,
                                void* states) {
        if (batch == nullptr) return missing("the batch");
        if (lacks(states, count, handle(batch).problem().state_size))
            return missing("the room for states");
        if (const rddl_error error = handle(batch).check(begin, count)) return error;
        handle(batch).use([&](const auto& environments) {
            environments.get_states(begin, count, static_cast<std::byte*>(states));
        });
        return RDDL_OK;
    }

    static rddl_error get_observation(const rddl_batch* batch, std::int64_t begin,
                                      std::int64_t count, void* records) {
        if (batch == nullptr) return missing("the batch");
        if (lacks(records, count, handle(batch).problem().observation_size))
            return missing("the room for observations");
        return for_each(batch, begin, count, [&](const auto& all, std::int64_t k, std::int64_t i) {
            const std::int64_t size = handle(batch).problem().observation_size;
            all.get_observation(i, static_cast<std::byte*>(records) + k * size);
        });
    }

    static rddl_error set_state(rddl_batch* batch, std::int64_t begin, std::int64_t count,
                                const void* states, const std::int64_t* steps) {
        if (batch == nullptr) return missing("the batch");
        if (lacks(states, count, handle(batch).problem().state_size))
            return refuse_records(handle(batch).problem(), RDDL_STATE, nullptr, begin, count);
        if (const rddl_error error = handle(batch).check(begin, count)) return error;
        for (std::int64_t k = 0; steps != nullptr && k < count; ++k)
            if (steps[k] < 0) return bad_argument("a count of steps is negative: ", steps[k]);
        const auto* const records = static_cast<const std::byte*>(states);
        const bool are_accepted = handle(batch).use(
            [&](const auto& environments) { return environments.accepts_states(records, count); });
        if (!are_accepted)
            return refuse_records(handle(batch).problem(), RDDL_STATE, records, begin, count);
        try {
            handle(batch).make_room_for(records, count);
        } catch (...) {
            return out_of_memory();
        }
        handle(batch).use(
            [&](auto& environments) { environments.set_states(begin, count, records, steps); });
        return RDDL_OK;
    }

    static rddl_error copy_environments(rddl_batch* to, std::int64_t begin, std::int64_t count,
                                        const rddl_batch* from, const std::int64_t* sources) {
        if (to == nullptr || from == nullptr) return missing("a batch");
        if (handle(to).maker != handle(from).maker)
            return bad_argument("the batches are of different simulators");
        if (const rddl_error error = handle(to).check(begin, count)) return error;
        // Planners ask for many copies of one environment.
        const auto end_of_run = [&](std::int64_t k) {
            const std::int64_t source = source_of(sources, k);
            while (k < count && source_of(sources, k) == source) ++k;
            return k;
        };
        const std::int64_t first_end = count > 0 ? end_of_run(0) : 0;
        for (std::int64_t k = 0; k < count; k = k == 0 ? first_end : end_of_run(k))
            if (const rddl_error error = handle(from).check(source_of(sources, k), 1)) return error;
        try {
            const Parts& maker = *handle(to).maker;
            auto& copied = handle(to).copied;
            if (!copied) copied.emplace(*maker.problem, memory_size(maker.engine));
            for (std::int64_t first = 0, k = 0; first < count; first = k) {
                k = first == 0 ? first_end : end_of_run(first);
                handle(from).use([&](const auto& environments) {
                    environments.get_environment(source_of(sources, first), *copied);
                });
                handle(to).make_room_for(copied->state[0], 1);
                handle(to).use([&](auto& environments) {
                    environments.set_environments(begin + first, k - first, *copied);
                });
            }
            return RDDL_OK;
        } catch (...) {
            return out_of_memory();
        }
    }
    // ------------------------------------------------------------------------- snapshots

    static std::int64_t size_of_snapshot(const rddl_simulator* simulator) {
        if (simulator == nullptr) return 0;
        return snapshot_bytes(*static_cast<const Parts*>(simulator->self));
    }
    static std::int64_t snapshot_bytes(const Parts& maker) {
        return static_cast<std::int64_t>(
            rddl::snapshot_size(*maker.problem, memory_size(maker.engine)));
    }
    static rddl_error get_snapshots(const rddl_batch* batch, std::int64_t begin, std::int64_t count,
                                    void* snapshots) {
        if (batch == nullptr || lacks(snapshots, count, 1))
            return missing("the batch or the room for snapshots");
        try {
            const Parts& maker = *handle(batch).maker;
            const std::size_t memory = memory_size(maker.engine);
            Environment environment(*maker.problem, memory);
            return for_each(
                batch, begin, count, [&](const auto& all, std::int64_t k, std::int64_t i) {
                    all.get_environment(i, environment);
                    write_snapshot(*maker.problem, memory, environment,
                                   static_cast<std::byte*>(snapshots) + k * snapshot_bytes(maker));
                });
        } catch (...) {
            return out_of_memory();
        }
    }
    static rddl_error set_snapshots(rddl_batch* batch, std::int64_t begin, std::int64_t count,
                                    const void* snapshots) {
        if (batch == nullptr || lacks(snapshots, count, 1))
            return missing("the batch or the snapshots");
        if (const rddl_error error = handle(batch).check(begin, count)) return error;
        const Parts& maker = *handle(batch).maker;
        const std::size_t memory = memory_size(maker.engine);
        const auto snapshot = [&](std::int64_t k) {
            return static_cast<const std::byte*>(snapshots) + k * snapshot_bytes(maker);
        };
        for (std::int64_t k = 0; k < count; ++k)
            if (!is_snapshot_of(*maker.problem, memory, snapshot(k)))
                return bad_argument("snapshot ", k, " is not one of this problem and version");
        try {
            Environment environment(*maker.problem, memory);
            for (std::int64_t k = 0; k < count; ++k) {
                read_snapshot(*maker.problem, memory, snapshot(k), environment);
                handle(batch).make_room_for(environment.state[0], 1);
                handle(batch).use([&](auto& all) { all.set_environment(begin + k, environment); });
            }
            return RDDL_OK;
        } catch (...) {
            return out_of_memory();
        }
    }
    static std::int64_t source_of(const std::int64_t* sources, std::int64_t k) {
        return sources != nullptr ? sources[k] : k;
    }

    template <class StreamOf>
    static rddl_error set_streams(rddl_batch* batch, std::int64_t begin, std::int64_t count,
                                  StreamOf&& stream_of) {
        if (batch == nullptr) return missing("the batch");
        if (const rddl_error error = handle(batch).check(begin, count)) return error;
        handle(batch).use(
            [&](auto& environments) { environments.set_streams(begin, count, stream_of); });
        return RDDL_OK;
    }
    static rddl_error set_seeds(rddl_batch* batch, std::int64_t begin, std::int64_t count,
                                const std::uint64_t* seeds) {
        if (seeds == nullptr) return missing("the array of seeds");
        return set_streams(batch, begin, count, [&](std::int64_t i) -> Stream {
            return {.seed = seeds[i - begin], .identity = 0};
        });
    }
    static rddl_error draw_medians(rddl_batch* batch, std::int64_t begin, std::int64_t count) {
        return set_streams(batch, begin, count, [](std::int64_t) { return Stream::of_medians(); });
    }
    static rddl_error set_seed(rddl_batch* batch, std::uint64_t seed) {
        if (batch == nullptr) return missing("the batch");
        handle(batch).use([&](auto& environments) { environments.set_seed(seed); });
        return RDDL_OK;
    }

    static rddl_error get_progress(const rddl_batch* batch, std::int64_t begin, std::int64_t count,
                                   std::int64_t* steps, std::int64_t* episodes) {
        return for_each(batch, begin, count, [&](const auto& all, std::int64_t k, std::int64_t i) {
            if (steps != nullptr) steps[k] = all.steps(i);
            if (episodes != nullptr) episodes[k] = std::max<std::int64_t>(all.episode_number(i), 0);
        });
    }

    static rddl_error get_causes(const rddl_batch* batch, std::int64_t begin, std::int64_t count,
                                 std::uint8_t* causes) {
        if (causes == nullptr) return missing("the room for causes");
        return for_each(batch, begin, count, [&](const auto& all, std::int64_t k, std::int64_t i) {
            causes[k] = all.causes(i);
        });
    }

    static rddl_error get_fault(const rddl_batch* batch, std::int64_t environment,
                                rddl_fault* fault) {
        if (fault == nullptr) return missing("the room for a fault");
        return for_each(batch, environment, 1, [&](const auto& all, std::int64_t, std::int64_t i) {
            const FaultRecord* const record = all.fault(i);
            rddl_fault told{};
            if (record != nullptr) {
                const Site site = site_of(*handle(batch).maker, *record);
                told.faulty = 1;
                told.step = all.steps_before_fault(i);
                told.source = site.source;
                describe_fault(*record, site, told.message);
            }
            write_struct(fault, told);
        });
    }

    // ------------------------------------------------------- what a step computes on its way

    static rddl_error get_interm(const rddl_batch* batch, std::int64_t begin, std::int64_t count,
                                 void* records) {
        if (batch == nullptr) return missing("the batch");
        if (lacks(records, count, handle(batch).problem().interm_size))
            return missing("the room for records");
        if (const rddl_error error = handle(batch).check(begin, count)) return error;
        const Details* const details = handle(batch).maker->details;
        if (details == nullptr)
            return fail(RDDL_UNSUPPORTED, "the simulator was made without rddlc --details");
        return handle(batch).use([&](const auto& environments) {
            if (!environments.keeps_steps())
                return fail(RDDL_UNSUPPORTED, "the batch was created without keeps_steps");
            for (std::int64_t i = begin; i < begin + count; ++i)
                if (!environments.last_step(i))
                    return bad_argument("environment ", i, " has made no step");
            return write_interm(*details, environments, begin, count,
                                static_cast<std::byte*>(records));
        });
    }
    template <class Environments>
    static rddl_error write_interm(const Details& details, const Environments& environments,
                                   std::int64_t begin, std::int64_t count, std::byte* to) {
        try {
            Records scratch(1, details.scratch_size), record(1, details.record_size);
            for (std::int64_t k = 0; k < count; ++k) {
                LastStep step = *environments.last_step(begin + k);
                details.compute(details.self, step.state, step.action, scratch[0], record[0],
                                step.context);
                if (details.interm_size > 0)
                    std::memcpy(to + k * static_cast<std::int64_t>(details.interm_size), record[0],
                                details.interm_size);
            }
            return RDDL_OK;
        } catch (...) {
            return out_of_memory();
        }
    }

    static rddl_error explain_violation(rddl_batch* batch, std::int64_t environment,
                                        const void* action, rddl_violation* out) {
        if (batch == nullptr || out == nullptr)
            return missing("the batch or the room for the violation");
        if (const rddl_error error = handle(batch).check(environment, 1)) return error;
        const Parts& maker = *handle(batch).maker;
        const auto* const given = static_cast<const std::byte*>(action);
        return handle(batch).use([&](auto& environments) {
            const bool is_missing = given == nullptr && maker.problem->action_size > 0;
            if (is_missing || !records_are_valid(environments.action_columns(), given, 1))
                return refuse_records(*maker.problem, RDDL_ACTION, given, environment, 1);
            try {
                Records state(1, static_cast<std::size_t>(maker.problem->state_size));
                Records plain(1, static_cast<std::size_t>(maker.problem->action_size));
                environments.get_state(environment, state[0]);
                const Columns columns =
                    columns_of<Scalar>(*maker.problem, RDDL_ACTION, maker.problem->action_size);
                read_records(Scalar{}, columns, given, 1, plain[0]);
                const auto violated = static_cast<std::int32_t>(
                    environments.violated_precondition(environment, plain[0]));
                auto context = environments.context_of_next_step(environment);
                write_struct(out, violation_of(maker, violated, state[0], plain[0], context));
                return RDDL_OK;
            } catch (...) {
                return out_of_memory();
            }
        });
    }
    // "domain.rddl:52:9: precondition violated: release(?r) <= rlevel(?r) (at ?r = t2)"
    static rddl_violation violation_of(const Parts& maker, std::int32_t violated,
                                       const std::byte* state, const std::byte* action,
                                       Context<Scalar>& context) {
        rddl_violation told{};
        told.precondition = violated;
        if (violated < 0) return told;
        const rddl_condition& condition = maker.problem->preconditions[violated];
        told.source = condition.source;
        FixedText text(told.message);
        describe_violation(text, condition);
        if (maker.details == nullptr) return told;
        const Details& details = *maker.details;
        Records scratch(1, details.scratch_size), record(1, details.record_size);
        details.compute(details.self, state, action, scratch[0], record[0], context);
        if (!context.fault)
            describe_culprits(text, details.preconditions[static_cast<std::size_t>(violated)],
                              record[0]);
        return told;
    }

    // --------------------------------------------------------------- what the instance fixes

    static rddl_error get_constants(const rddl_simulator* simulator, std::int32_t fluent,
                                    std::int64_t begin, std::int64_t count, void* values) {
        if (simulator == nullptr || lacks(values, count, 1))
            return missing("the simulator or the room for values");
        const rddl_problem& problem = *simulator->problem;
        if (fluent < 0 || fluent >= problem.fluent_count)
            return bad_argument("there is no fluent ", std::int64_t{fluent});
        const rddl_fluent& described = problem.fluents[fluent];
        if (begin < 0 || count < 0 || begin > described.count || count > described.count - begin)
            return bad_argument("'", described.name, "' has no ", count, " values from ", begin,
                                " on, but ", described.count);
        const Parts& maker = *static_cast<const Parts*>(simulator->self);
        auto* const to = static_cast<std::byte*>(values);
        for (const Constants& constants : maker.constants)
            if (constants.fluent == fluent) {
                write_constants(constants, begin, count, to);
                return RDDL_OK;
            }
        return copy_defaults(maker, described, begin, count, to);
    }
    // Copies from the record in which states begin, or from that of the default action.
    static rddl_error copy_defaults(const Parts& maker, const rddl_fluent& fluent,
                                    std::int64_t begin, std::int64_t count, std::byte* to) {
        const std::int64_t size = fluent.scalar == RDDL_BOOL ? 1 : 8;
        const auto copy = [&](const std::byte* record) {
            if (count > 0)
                std::memcpy(to, record + fluent.offset + begin * size,
                            static_cast<std::size_t>(count * size));
            return RDDL_OK;
        };
        if (fluent.role == RDDL_ACTION)
            return copy(static_cast<const std::byte*>(maker.problem->default_action));
        if (fluent.role != RDDL_STATE)
            return bad_argument("'", fluent.name, "' is not fixed by the instance");
        try {
            Records state(1, static_cast<std::size_t>(maker.problem->state_size));
            write_initial_state(maker, state[0]);
            return copy(state[0]);
        } catch (...) {
            return out_of_memory();
        }
    }
    static rddl_error initial_state(const rddl_simulator* simulator, void* state) {
        if (simulator == nullptr || lacks(state, 1, simulator->problem->state_size))
            return missing("the simulator or the room for the state");
        try {
            write_initial_state(*static_cast<const Parts*>(simulator->self),
                                static_cast<std::byte*>(state));
            return RDDL_OK;
        } catch (...) {
            return out_of_memory();
        }
    }
    static void write_initial_state(const Parts& maker, std::byte* record) {
        const rddl_problem& problem = *maker.problem;
        const Columns columns = columns_of<One>(problem, RDDL_STATE, problem.state_size);
        Records block(1, maker.engine.state_size());
        maker.engine.initial_state(block[0]);
        write_record(One{}, columns, block[0], 0, record);
    }

    static std::int64_t grounding_name(const rddl_simulator* simulator, std::int32_t fluent,
                                       std::int64_t grounding, char* text, std::size_t size) {
        if (simulator == nullptr || fluent < 0 || fluent >= simulator->problem->fluent_count ||
            (text == nullptr && size > 0) || grounding < 0 ||
            grounding >= simulator->problem->fluents[fluent].count) {
            bad_argument("there is no such grounding");
            return -1;
        }
        FixedText name(std::span(text, size));
        write_grounding_name(name, *simulator->problem, simulator->problem->fluents[fluent],
                             grounding);
        return static_cast<std::int64_t>(name.wanted());
    }

    static const char* last_error(const rddl_simulator*) { return last_error_buffer().data(); }
};

template <class L>
rddl_simulator Functions<L>::table(const Parts& parts) {
    return {.abi_version = RDDL_ABI_VERSION,
            .struct_size = sizeof(rddl_simulator),
            .problem = parts.problem,
            .self = &parts,
            .create = create,
            .destroy = destroy,
            .last_error = last_error,
            .reset = reset,
            .step = have_objects(*parts.problem, RDDL_ACTION) ? step<true> : step<false>,
            .get_state = get_state,
            .get_observation = get_observation,
            .set_state = set_state,
            .get_progress = get_progress,
            .get_causes = get_causes,
            .get_fault = get_fault,
            .copy = copy,
            .copy_environments = copy_environments,
            .set_seeds = set_seeds,
            .set_seed = set_seed,
            .violated_preconditions = violated_preconditions,
            .explain_violation = explain_violation,
            .action_choice_count = action_choice_count,
            .action_choice = action_choice,
            .action_mask = action_mask,
            .policy = parts.policy,
            .policy_act = parts.policy ? policy_act : nullptr,
            .lane_count = L::width,
            .instruction_set = parts.instruction_set,
            .action_value_count = action_value_count,
            .observation_value_count = observation_value_count,
            .action_column = action_column,
            .observation_column = observation_column,
            .step_values = step_values,
            .get_observation_values = get_observation_values,
            .get_interm = get_interm,
            .get_constants = get_constants,
            .initial_state = initial_state,
            .grounding_name = grounding_name,
            .snapshot_size = size_of_snapshot,
            .get_snapshots = get_snapshots,
            .set_snapshots = set_snapshots,
            .draw_medians = draw_medians};
}

template <class L>
rddl_simulator table_of(const SimulatorParts<L>& parts) {
    return Functions<L>::table(parts);
}

}  // namespace rddl
