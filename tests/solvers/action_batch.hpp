// Actions of a batch, which are repaired.
#pragma once

#include "solvers/batches/batch.hpp"
#include "solvers/spaces/action_repair.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace rddlc::solvers {

struct ActionBatch {
    static constexpr std::size_t environments = 32;

    explicit ActionBatch(const rddl_simulator& its_simulator)
        : simulator(its_simulator),
          space(action_space(simulator)),
          records(simulator),
          batch(create_batch(simulator, options())),
          columns(static_cast<std::size_t>(space.column_count)),
          values(environments * columns),
          bytes(environments * records.record_size()),
          buffers(simulator, space, environments) {}

    float* row(std::size_t e) { return values.data() + e * columns; }
    std::byte* record(std::size_t e) { return bytes.data() + e * records.record_size(); }
    void write() {
        for (std::size_t e = 0; e < environments; ++e) records.write(row(e), record(e));
    }
    // The first precondition that each action violates, or -1.
    std::vector<std::int32_t> violated() {
        std::vector<std::int32_t> all(environments);
        simulator.violated_preconditions(batch.get(), bytes.data(), all.data());
        return all;
    }
    std::int64_t mend() {
        return repair_actions(simulator, space, records, batch.get(), values.data(), bytes.data(),
                              buffers);
    }

    const rddl_simulator& simulator;
    ActionSpace space;
    ActionRecords records;
    BatchHandle batch;
    std::size_t columns;
    std::vector<float> values;  // rows of columns
    std::vector<std::byte> bytes;
    RepairBuffers buffers;

  private:
    static rddl_batch_options options() {
        rddl_batch_options options{};
        options.environment_count = environments;
        return options;
    }
};

inline const std::vector<std::int32_t> all_legal(ActionBatch::environments, -1);

}  // namespace rddlc::solvers
