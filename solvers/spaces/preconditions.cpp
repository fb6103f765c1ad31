#include "solvers/spaces/preconditions.hpp"

#include "solvers/batches/batch.hpp"
#include "solvers/policies/random_policy.hpp"
#include "solvers/spaces/groundings.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <random>
#include <utility>

namespace rddlc::solvers {

namespace {

constexpr std::int64_t environments = 16;

// Some environments with a random action each, which may be changed before it is tried.
class Trial {
  public:
    Trial(const rddl_simulator& simulator, const ActionSpace& space, const ActionRecords& records)
        : simulator_(simulator),
          records_(records),
          batch_(create_batch(simulator, options())),
          policy_(*simulator.problem, 0),
          columns_(static_cast<std::size_t>(space.column_count)),
          values_(environments * columns_),
          actions_(environments * records.record_size()),
          violated_(environments) {}

    // Steps that are worth their time: fewer of a large problem.
    std::int64_t steps() const {
        constexpr std::int64_t most_numbers = 1 << 22;
        const std::int64_t values =
            static_cast<std::int64_t>(columns_) + simulator_.problem->state_size / 8;
        return std::clamp<std::int64_t>(most_numbers / (environments * values), 2, 40);
    }

    void draw(std::int64_t step) {
        for (std::int64_t e = 0; e < environments; ++e) {
            policy_.act(e, step, action(e));
            records_.read(action(e), values(e));
        }
    }

    float* values(std::int64_t e) {
        return values_.data() + static_cast<std::size_t>(e) * columns_;
    }

    void reset_numbers(const ActionSpace& space) {
        for (std::int64_t e = 0; e < environments; ++e)
            for (const RealHead& head : space.reals)
                values(e)[head.column] = space.defaults[static_cast<std::size_t>(head.column)];
    }

    std::int64_t count_legal() {
        write_actions();
        require_done(simulator_, simulator_.violated_preconditions(batch_.get(), actions_.data(),
                                                                   violated_.data()));
        return std::count_if(violated_.begin(), violated_.end(), [](int v) { return v < 0; });
    }

    void step() {
        write_actions();
        rddl_transition unread{};
        require_done(simulator_, simulator_.step(batch_.get(), actions_.data(), &unread));
    }

  private:
    static rddl_batch_options options() {
        rddl_batch_options options{};
        options.environment_count = environments;
        options.thread_count = 1;
        options.autoreset = RDDL_AUTORESET_SAME_STEP;
        return options;
    }
    void write_actions() {
        for (std::int64_t e = 0; e < environments; ++e) records_.write(values(e), action(e));
    }
    std::byte* action(std::int64_t e) {
        return actions_.data() + static_cast<std::size_t>(e) * records_.record_size();
    }

    const rddl_simulator& simulator_;
    const ActionRecords& records_;
    BatchHandle batch_;
    RandomPolicy policy_;
    std::size_t columns_;
    std::vector<float> values_;
    std::vector<std::byte> actions_;
    std::vector<std::int32_t> violated_;
};

// The property that the changes of a group share.
struct Common {
    std::int32_t type = -1;     // an object of this type; -1: nothing
    bool last = false;          // it is the last parameter of the type, not the first one
    bool within_fluent = true;  // and the fluent
};

std::vector<std::vector<int>> group_by(const rddl_problem& problem,
                                       const std::vector<rddl_column>& columns,
                                       const Common& common) {
    std::map<std::pair<std::int32_t, std::int64_t>, std::vector<int>> groups;
    for (std::size_t c = 0; c < columns.size(); ++c) {
        const rddl_column& column = columns[c];
        if (column.scalar != RDDL_BOOL) continue;
        const rddl_fluent& fluent = *rddl_fluent_at(&problem, column.fluent);
        std::int64_t object = -1;
        if (common.type >= 0) {
            const std::int32_t* const begin = fluent.parameter_types;
            const std::int32_t* const end = begin + fluent.rank;
            const std::int32_t* found = std::find(begin, end, common.type);
            if (found == end) continue;
            if (common.last)
                while (std::find(found + 1, end, common.type) != end)
                    found = std::find(found + 1, end, common.type);
            object = object_at(problem, fluent, column.grounding,
                               static_cast<std::int32_t>(found - begin));
        }
        groups[{common.within_fluent ? column.fluent : -1, object}].push_back(static_cast<int>(c));
    }
    std::vector<std::vector<int>> result;
    for (auto& [key, group] : groups)
        if (group.size() > 1) result.push_back(std::move(group));
    return result;
}

std::vector<std::vector<std::vector<int>>> guesses(const rddl_problem& problem,
                                                   const std::vector<rddl_column>& columns) {
    std::vector<std::vector<std::vector<int>>> all;
    for (std::int32_t type = -1; type < problem.type_count; ++type)
        for (const bool last : {false, true})
            for (const bool within_fluent : {true, false}) {
                auto groups = group_by(problem, columns, {type, last, within_fluent});
                if (!groups.empty() && std::find(all.begin(), all.end(), groups) == all.end())
                    all.push_back(std::move(groups));
            }
    return all;
}

// How many values change at most where one of each group does.
std::int64_t changes_of(const std::vector<std::vector<int>>& groups, std::int64_t columns) {
    for (const std::vector<int>& group : groups)
        columns -= static_cast<std::int64_t>(group.size()) - 1;
    return columns;
}

void change(float& value) {
    value = 1 - value;
}

std::optional<Groups> confirmed(Trial trial, const ActionSpace& space,
                                const std::vector<std::vector<int>>& groups, const Stops& stops) {
    std::mt19937 random;
    const auto below = [&](std::size_t count) {
        return static_cast<std::size_t>(random()) % count;
    };
    struct Tried {  // of an environment: a group, the bool that changes and one more
        std::size_t group, changed, other;
    };
    std::vector<std::size_t> changed(groups.size());
    std::vector<Tried> tried(environments);
    const auto change_all = [&](std::size_t Tried::*which) {
        for (std::int64_t e = 0; e < environments; ++e) {
            const Tried& at = tried[static_cast<std::size_t>(e)];
            change(trial.values(e)[groups[at.group][at.*which]]);
        }
    };

    std::optional<bool> may_be_none;
    for (std::int64_t step = 0; step < trial.steps(); ++step) {
        if (is_stopped(&stops)) return std::nullopt;
        trial.draw(step);
        for (std::int64_t e = 0; e < environments; ++e) {
            float* const values = trial.values(e);
            for (std::size_t g = 0; g < groups.size(); ++g) {
                for (const int column : groups[g])
                    values[column] = space.defaults[static_cast<std::size_t>(column)];
                changed[g] = below(groups[g].size());
                change(values[groups[g][changed[g]]]);
            }
            const std::size_t g = below(groups.size()), size = groups[g].size();
            tried[static_cast<std::size_t>(e)] = {g, changed[g],
                                                  (changed[g] + 1 + below(size - 1)) % size};
        }
        if (trial.count_legal() < environments) {
            if (space.reals.empty()) return std::nullopt;
            trial.reset_numbers(space);  // learners repair those
            if (trial.count_legal() < environments) return std::nullopt;
        }

        change_all(&Tried::other);  // two of a group
        if (trial.count_legal() > 0) return std::nullopt;
        change_all(&Tried::other);

        change_all(&Tried::changed);  // no bool of a group
        const std::int64_t legal = trial.count_legal();
        if (legal != may_be_none.value_or(legal > 0) * environments) return std::nullopt;
        may_be_none = legal > 0;
        change_all(&Tried::changed);

        trial.step();
    }
    return Groups{groups, *may_be_none};
}

}  // namespace

bool preconditions_bite(const rddl_simulator& simulator, const ActionSpace& space,
                        const ActionRecords& records, const Stops& stops) {
    if (simulator.problem->precondition_count == 0) return false;
    Trial trial(simulator, space, records);
    for (std::int64_t step = 0; step < trial.steps() && !is_stopped(&stops); ++step) {
        trial.draw(step);
        for (std::int64_t e = 0; e < environments; ++e) {
            double number = -2 + 4 * static_cast<double>((e * 7 + step * 3) % 16) / 15;
            for (const RealHead& head : space.reals) {
                trial.values(e)[head.column] = static_cast<float>(real_value(head, number));
                number = -number + 0.1;
            }
        }
        if (trial.count_legal() < environments) return true;
        trial.step();
    }
    return false;
}

std::optional<Groups> find_groups(const rddl_simulator& simulator,
                                  const std::vector<rddl_column>& columns, const ActionSpace& space,
                                  const ActionRecords& records, const Stops& stops) {
    const std::int64_t limit = simulator.problem->max_nondef_actions;
    for (const auto& groups : guesses(*simulator.problem, columns)) {
        if (limit >= 0 && changes_of(groups, space.column_count) > limit) continue;
        if (auto found = confirmed(Trial(simulator, space, records), space, groups, stops))
            return found;
    }
    return std::nullopt;
}

}  // namespace rddlc::solvers
