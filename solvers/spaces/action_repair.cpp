#include "solvers/spaces/action_repair.hpp"

#include "solvers/batches/batch.hpp"

#include <algorithm>
#include <utility>
#include <vector>

namespace rddlc::solvers {

namespace {

using Search = RepairSearch;

// How often a real is halved before it takes its default.
constexpr int most_halves = 3;
// How many values are repaired one by one; after that all others take their default. Large actions
// get fewer, since each check of theirs takes its time.
int most_repaired(int columns) {
    return std::clamp(16'000 / columns, 1, 16);
}

// The repair of one environment's action.
class Repair {
  public:
    Repair(const RepairBuffers& buffers, int columns, const float* base)
        : is_real_(buffers.is_real),
          columns_(columns),
          most_repaired_(most_repaired(columns)),
          base_(base) {}

    void start(Search& search, float* wanted) const {
        search.end = columns_;
        narrow(search, wanted);
    }

    void take(Search& search, bool is_legal, float* wanted) const {
        switch (search.question) {
            case Search::Question::All:
                if (is_legal) {
                    search.active = false;
                    return;
                }
                search.end = columns_;
                return narrow(search, wanted);
            case Search::Question::Middle:
                (is_legal ? search.legal : search.end) = search.asked(columns_);
                return narrow(search, wanted);
            case Search::Question::Value:
                return is_legal ? go_on(search) : mend(search, wanted);
        }
    }

  private:
    void narrow(Search& search, float* wanted) const {
        if (search.end - search.legal == 1) return mend(search, wanted);
        search.question = Search::Question::Middle;
    }

    // The value behind the legal ones is at fault.
    void mend(Search& search, float* wanted) const {
        const auto column = static_cast<std::size_t>(search.legal);
        const float base = base_[column];
        if (is_real_[column] && search.halves < most_halves && search.repaired < most_repaired_) {
            wanted[column] = base + (wanted[column] - base) * 0.5f;
            search.halves += 1;
            search.question = Search::Question::Value;
            return;
        }
        wanted[column] = base;
        if (search.repaired >= most_repaired_)
            std::copy(base_ + search.legal, base_ + columns_, wanted + search.legal);
        go_on(search);
    }

    void go_on(Search& search) const {
        search.legal += 1;
        search.halves = 0;
        search.repaired += 1;
        search.question = Search::Question::All;
    }

    const std::vector<std::uint8_t>& is_real_;
    int columns_, most_repaired_;
    const float* base_;
};

// The rows and records of a batch, and which of its actions are legal.
struct Actions {
    const rddl_simulator& simulator;
    const ActionSpace& space;
    const ActionRecords& converter;
    rddl_batch* batch;
    float* values;
    std::byte* records;
    RepairBuffers& buffers;

    std::int64_t count() const { return static_cast<std::int64_t>(buffers.searches.size()); }
    float* values_of(std::int64_t i) const { return values + i * space.column_count; }
    float* wanted_of(std::int64_t i) const {
        return buffers.wanted.data() + i * space.column_count;
    }
    float* base_of(std::int64_t i) const { return buffers.bases.data() + i * space.column_count; }
    std::byte* record_of(std::int64_t i) const {
        return records + static_cast<std::size_t>(i) * converter.record_size();
    }
    Search& search_of(std::int64_t i) const {
        return buffers.searches[static_cast<std::size_t>(i)];
    }
    bool is_legal(std::int64_t i) const {
        return buffers.violated[static_cast<std::size_t>(i)] < 0;
    }

    void ask() const {
        require_done(simulator,
                     simulator.violated_preconditions(batch, records, buffers.violated.data()));
    }
    // The first values as they are wanted, the others as in the base.
    void set_first(std::int64_t i, int values_wanted) const {
        float* const row = values_of(i);
        std::copy_n(wanted_of(i), values_wanted, row);
        std::copy(base_of(i) + values_wanted, base_of(i) + space.column_count, row + values_wanted);
        converter.write(row, record_of(i));
    }
};

bool needs_base(const Search& search) {
    return search.active && !search.has_base;
}

// make(base, wanted) writes rows that may be legal.
void try_bases(const Actions& all, const auto& make) {
    for (std::int64_t i = 0; i < all.count(); ++i) {
        if (!needs_base(all.search_of(i))) continue;
        make(all.base_of(i), all.wanted_of(i));
        all.set_first(i, 0);
    }
    all.ask();
    for (std::int64_t i = 0; i < all.count(); ++i)
        if (needs_base(all.search_of(i))) all.search_of(i).has_base = all.is_legal(i);
}

// Searches for all environments side by side, since the simulator is asked about all of them.
void try_random_bases(const Actions& all) {
    RepairBuffers& buffers = all.buffers;
    for (RandomPolicy::Search& search : buffers.random_searches) search.restart();
    for (std::int64_t i = 0; i < all.count(); ++i)
        if (needs_base(all.search_of(i))) buffers.random->act(0, 0, all.record_of(i));
    for (bool searching = true; searching && !is_stopped(buffers.stops);) {
        all.ask();
        searching = false;
        for (std::int64_t i = 0; i < all.count(); ++i) {
            if (!needs_base(all.search_of(i))) continue;
            if (all.is_legal(i)) {
                all.converter.read(all.record_of(i), all.base_of(i));
                all.search_of(i).has_base = true;
            } else {
                searching |= buffers.random->try_another(
                    0, 0, buffers.random_searches[static_cast<std::size_t>(i)], all.record_of(i));
            }
        }
    }
}

// Begins a search wherever an action is illegal and a legal one is found, its base.
void begin_searches(const Actions& all) {
    std::vector<Search>& searches = all.buffers.searches;
    std::fill(searches.begin(), searches.end(), Search{});
    for (std::int64_t i = 0; i < all.count(); ++i) all.search_of(i).active = !all.is_legal(i);

    const std::vector<float>& defaults = all.space.defaults;
    try_bases(all, [&](float* base, const float*) { std::ranges::copy(defaults, base); });
    if (!all.space.reals.empty() && std::ranges::any_of(searches, needs_base))
        try_bases(all, [&](float* base, const float* wanted) {
            std::copy_n(wanted, all.space.column_count, base);
            for (const RealHead& head : all.space.reals)
                base[head.column] = defaults[static_cast<std::size_t>(head.column)];
        });
    if (std::ranges::any_of(searches, needs_base)) try_random_bases(all);

    for (std::int64_t i = 0; i < all.count(); ++i) {
        if (!needs_base(all.search_of(i))) continue;
        all.search_of(i).active = false;
        all.set_first(i, all.space.column_count);
    }
}

}  // namespace

RepairBuffers::RepairBuffers(const rddl_simulator& simulator, const ActionSpace& space,
                             std::int64_t environments)
    : random(std::in_place, *simulator.problem, 0) {
    const auto count = static_cast<std::size_t>(environments);
    violated.resize(count);
    wanted.resize(count * static_cast<std::size_t>(space.column_count));
    bases.resize(wanted.size());
    searches.resize(count);
    random_searches.resize(count);
    is_real.resize(space.names.size());
    for (const RealHead& head : space.reals)
        is_real[static_cast<std::size_t>(head.column)] = !head.rounds;
}

std::int64_t repair_actions(const rddl_simulator& simulator, const ActionSpace& space,
                            const ActionRecords& converter, rddl_batch* batch, float* actions,
                            std::byte* records, RepairBuffers& buffers) {
    const Actions all{simulator, space, converter, batch, actions, records, buffers};
    all.ask();
    const std::int64_t illegal =
        std::ranges::count_if(buffers.violated, [](auto v) { return v >= 0; });
    if (illegal == 0) return 0;

    const int columns = space.column_count;
    std::copy_n(actions, all.count() * columns, buffers.wanted.begin());
    begin_searches(all);
    const auto repair_of = [&](std::int64_t i) {
        return Repair(buffers, columns, all.base_of(i));
    };
    for (std::int64_t i = 0; i < all.count(); ++i)
        if (all.search_of(i).active) repair_of(i).start(all.search_of(i), all.wanted_of(i));
    while (std::ranges::any_of(buffers.searches, &Search::active) && !is_stopped(buffers.stops)) {
        for (std::int64_t i = 0; i < all.count(); ++i)
            if (all.search_of(i).active) all.set_first(i, all.search_of(i).asked(columns));
        all.ask();
        for (std::int64_t i = 0; i < all.count(); ++i)
            if (all.search_of(i).active)
                repair_of(i).take(all.search_of(i), all.is_legal(i), all.wanted_of(i));
    }
    return illegal;
}

}  // namespace rddlc::solvers
