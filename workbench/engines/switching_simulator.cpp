#include "engines/switching_simulator.hpp"

#include <rddl/interface/abi.hpp>
#include <rddl/interface/error_text.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <new>
#include <type_traits>
#include <utility>
#include <vector>

namespace rddlc::workbench {

namespace {

struct Switching {
    std::shared_ptr<const rddl_simulator> interpreted;
    std::shared_ptr<BackgroundBuild> compiled;
    rddl_simulator table;
};

// The content of an rddl_batch.
struct SwitchingBatch {
    const Switching* owner;
    rddl_batch_options options;
    const rddl_simulator* engine;  // of the batch
    rddl_batch* batch;
    bool may_move = true;
    int calls_until_look = 0;  // after a fork
};

const Switching& switching(const rddl_simulator* simulator) {
    return *static_cast<const Switching*>(simulator->self);
}
SwitchingBatch& switching(rddl_batch* batch) {
    return *reinterpret_cast<SwitchingBatch*>(batch);
}
const SwitchingBatch& switching(const rddl_batch* batch) {
    return *reinterpret_cast<const SwitchingBatch*>(batch);
}

// The interpreter's last error is also that of the switching simulator: those of compiled ones are
// copied there.
template <class Result>
Result with_error_of(const SwitchingBatch& batch, Result result) {
    if constexpr (std::is_same_v<Result, rddl_error>)
        if (result != RDDL_OK && batch.engine != batch.owner->interpreted.get())
            return rddl::fail(result, batch.engine->last_error(batch.engine));
    return result;
}

bool copy_all(const SwitchingBatch& from, const rddl_simulator& engine, rddl_batch* to) {
    const std::int64_t size = engine.snapshot_size(&engine), all = from.options.environment_count;
    const std::int64_t at_once = std::clamp<std::int64_t>((1 << 20) / size, 1, all);
    std::vector<std::byte> snapshots(static_cast<std::size_t>(at_once * size));
    for (std::int64_t begin = 0; begin < all; begin += at_once) {
        const std::int64_t count = std::min(at_once, all - begin);
        if (from.engine->get_snapshots(from.batch, begin, count, snapshots.data()) != RDDL_OK ||
            engine.set_snapshots(to, begin, count, snapshots.data()) != RDDL_OK)
            return false;
    }
    return true;
}

// An equal batch of the engine; null if that is impossible.
rddl_batch* moved(const SwitchingBatch& from, const rddl_simulator& engine) {
    rddl_batch* const to = engine.create(&engine, &from.options);
    if (to == nullptr) return nullptr;
    try {
        if (copy_all(from, engine, to)) return to;
    } catch (const std::bad_alloc&) {
    }
    engine.destroy(to);
    return nullptr;
}

void move_to(SwitchingBatch& batch, const rddl_simulator& engine) {
    rddl_batch* const copy = moved(batch, engine);
    if (copy == nullptr) {
        batch.may_move = false;
        return;
    }
    batch.engine->destroy(batch.batch);
    batch.batch = copy;
    batch.engine = &engine;
}

// The engine changes here, if it can.
void look_for_compiled(SwitchingBatch& batch) {
    constexpr int between_looks = 256;
    if (batch.engine != batch.owner->interpreted.get() || !batch.may_move) return;
    if (const rddl_simulator* const compiled = batch.owner->compiled->ready())
        return move_to(batch, *compiled);
    if (--batch.calls_until_look > 0) return;
    batch.calls_until_look = between_looks;
    batch.owner->compiled->revive();
}

// The function of the table that calls the function `member` of the engine's table.
template <auto member>
struct Forward;

template <class Result, class... Arguments,
          Result (*rddl_simulator::*member)(const rddl_simulator*, Arguments...)>
struct Forward<member> {
    static Result call(const rddl_simulator* simulator, Arguments... arguments) {
        if (simulator == nullptr) {
            rddl::bad_argument("the simulator is missing");
            return Result();
        }
        const rddl_simulator* const inner = switching(simulator).interpreted.get();
        return (inner->*member)(inner, arguments...);
    }
};
template <class... Arguments, rddl_error (*rddl_simulator::*member)(rddl_batch*, Arguments...)>
struct Forward<member> {
    static rddl_error call(rddl_batch* batch, Arguments... arguments) {
        if (batch == nullptr) return rddl::bad_argument("the batch is missing");
        SwitchingBatch& inner = switching(batch);
        look_for_compiled(inner);
        return with_error_of(inner, (inner.engine->*member)(inner.batch, arguments...));
    }
};
template <class... Arguments,
          rddl_error (*rddl_simulator::*member)(const rddl_batch*, Arguments...)>
struct Forward<member> {
    static rddl_error call(const rddl_batch* batch, Arguments... arguments) {
        if (batch == nullptr) return rddl::bad_argument("the batch is missing");
        const SwitchingBatch& inner = switching(batch);
        return with_error_of(inner, (inner.engine->*member)(inner.batch, arguments...));
    }
};

rddl_batch* batch_of(const Switching& owner, const rddl_batch_options& options,
                     const rddl_simulator* engine, rddl_batch* batch) {
    if (batch == nullptr) return nullptr;
    auto* const all = new (std::nothrow) SwitchingBatch{&owner, options, engine, batch};
    if (all != nullptr) return reinterpret_cast<rddl_batch*>(all);
    engine->destroy(batch);
    rddl::out_of_memory();
    return nullptr;
}

rddl_batch* create(const rddl_simulator* simulator, const rddl_batch_options* options) {
    if (simulator == nullptr) {
        rddl::bad_argument("the simulator is missing");
        return nullptr;
    }
    const Switching& owner = switching(simulator);
    const rddl_simulator* const compiled = owner.compiled->ready();
    const rddl_simulator* const engine = compiled ? compiled : owner.interpreted.get();
    rddl_batch* const batch = engine->create(engine, options);
    if (batch == nullptr) {
        if (compiled) rddl::bad_argument(compiled->last_error(compiled));
        return nullptr;
    }
    rddl_batch_options kept = rddl::read_struct(options).value_or(rddl_batch_options{});
    kept.struct_size = sizeof kept;
    kept.environment_count = std::max<std::int64_t>(kept.environment_count, 1);
    return batch_of(owner, kept, engine, batch);
}

void destroy(rddl_batch* batch) {
    if (batch == nullptr) return;
    const SwitchingBatch* const all = &switching(batch);
    all->engine->destroy(all->batch);
    delete all;
}

rddl_batch* copy(const rddl_batch* batch) {
    if (batch == nullptr) {
        rddl::bad_argument("the batch is missing");
        return nullptr;
    }
    const SwitchingBatch& from = switching(batch);
    rddl_batch* const made = from.engine->copy(from.batch);
    if (made == nullptr) rddl::out_of_memory();
    return batch_of(*from.owner, from.options, from.engine, made);
}

rddl_error copy_between_engines(SwitchingBatch& to, std::int64_t begin, std::int64_t count,
                                const SwitchingBatch& from, const std::int64_t* sources) {
    const std::int64_t size = to.engine->snapshot_size(to.engine);
    if (count < 0 || count > to.options.environment_count)
        return rddl::bad_argument("there are no ", count, " environments");
    try {
        std::vector<std::byte> snapshots(static_cast<std::size_t>(count * size));
        for (std::int64_t k = 0; k < count; ++k) {
            const rddl_error error = from.engine->get_snapshots(
                from.batch, sources ? sources[k] : k, 1, snapshots.data() + k * size);
            if (error != RDDL_OK) return with_error_of(from, error);
        }
        return with_error_of(to,
                             to.engine->set_snapshots(to.batch, begin, count, snapshots.data()));
    } catch (const std::bad_alloc&) {
        return rddl::out_of_memory();
    }
}

rddl_error copy_environments(rddl_batch* to, std::int64_t begin, std::int64_t count,
                             const rddl_batch* from, const std::int64_t* sources) {
    if (to == nullptr || from == nullptr) return rddl::bad_argument("a batch is missing");
    SwitchingBatch& target = switching(to);
    const SwitchingBatch& source = switching(from);
    if (target.owner != source.owner)
        return rddl::bad_argument("the batches are of different simulators");
    look_for_compiled(target);
    if (target.engine != source.engine)
        return copy_between_engines(target, begin, count, source, sources);
    return with_error_of(target, target.engine->copy_environments(target.batch, begin, count,
                                                                  source.batch, sources));
}

rddl_simulator table_of(const Switching& owner) {
    const rddl_simulator& inner = *owner.interpreted;
    rddl_simulator table{};
    table.abi_version = RDDL_ABI_VERSION;
    table.struct_size = sizeof table;
    table.problem = inner.problem;
    table.self = &owner;
    table.create = create;
    table.destroy = destroy;
    table.last_error = Forward<&rddl_simulator::last_error>::call;
    table.reset = Forward<&rddl_simulator::reset>::call;
    table.step = Forward<&rddl_simulator::step>::call;
    table.get_state = Forward<&rddl_simulator::get_state>::call;
    table.get_observation = Forward<&rddl_simulator::get_observation>::call;
    table.set_state = Forward<&rddl_simulator::set_state>::call;
    table.get_progress = Forward<&rddl_simulator::get_progress>::call;
    table.get_causes = Forward<&rddl_simulator::get_causes>::call;
    table.get_fault = Forward<&rddl_simulator::get_fault>::call;
    table.copy = copy;
    table.copy_environments = copy_environments;
    table.set_seeds = Forward<&rddl_simulator::set_seeds>::call;
    table.set_seed = Forward<&rddl_simulator::set_seed>::call;
    table.violated_preconditions = Forward<&rddl_simulator::violated_preconditions>::call;
    table.explain_violation = Forward<&rddl_simulator::explain_violation>::call;
    table.action_choice_count = Forward<&rddl_simulator::action_choice_count>::call;
    table.action_choice = Forward<&rddl_simulator::action_choice>::call;
    table.action_mask = Forward<&rddl_simulator::action_mask>::call;
    table.policy = inner.policy;
    table.policy_act = inner.policy_act ? Forward<&rddl_simulator::policy_act>::call : nullptr;
    table.lane_count = inner.lane_count;
    table.instruction_set = inner.instruction_set;
    table.action_value_count = Forward<&rddl_simulator::action_value_count>::call;
    table.observation_value_count = Forward<&rddl_simulator::observation_value_count>::call;
    table.action_column = Forward<&rddl_simulator::action_column>::call;
    table.observation_column = Forward<&rddl_simulator::observation_column>::call;
    table.step_values = Forward<&rddl_simulator::step_values>::call;
    table.get_observation_values = Forward<&rddl_simulator::get_observation_values>::call;
    table.get_interm = Forward<&rddl_simulator::get_interm>::call;
    table.get_constants = Forward<&rddl_simulator::get_constants>::call;
    table.initial_state = Forward<&rddl_simulator::initial_state>::call;
    table.grounding_name = Forward<&rddl_simulator::grounding_name>::call;
    table.snapshot_size = Forward<&rddl_simulator::snapshot_size>::call;
    table.get_snapshots = Forward<&rddl_simulator::get_snapshots>::call;
    table.set_snapshots = Forward<&rddl_simulator::set_snapshots>::call;
    table.draw_medians = Forward<&rddl_simulator::draw_medians>::call;
    return table;
}

}  // namespace

std::shared_ptr<const rddl_simulator> switching_simulator(
    std::shared_ptr<const rddl_simulator> interpreted, std::shared_ptr<BackgroundBuild> compiled) {
    const auto owner = std::make_shared<Switching>(
        Switching{std::move(interpreted), std::move(compiled), rddl_simulator{}});
    owner->table = table_of(*owner);
    return {owner, &owner->table};
}

}  // namespace rddlc::workbench
