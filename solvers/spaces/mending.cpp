#include "solvers/spaces/mending.hpp"

#include "solvers/batches/batch.hpp"

#include <algorithm>
#include <vector>

namespace rddlc::solvers {

namespace {

using Search = MendingSearch;

// How often a real is halved before it takes its default.
constexpr int most_halves = 3;
// How many values are mended one by one; after that all others take their default. Fewer of large
// actions, of which each question takes its time.
int most_mended(int columns) {
    return std::clamp(16'000 / columns, 1, 16);
}

class Mending {
  public:
    Mending(const ActionSpace& space, const MendingRoom& room)
        : space_(space),
          is_number_(room.is_number),
          is_real_(room.is_real),
          most_mended_(most_mended(space.column_count)) {}

    // The values from `begin` on fall back.
    void fall_back(const Search& search, int begin, float* row) const {
        for (auto c = static_cast<std::size_t>(begin); c < space_.defaults.size(); ++c)
            if (!search.keeps_categories || is_number_[c]) row[c] = space_.defaults[c];
    }

    void start(Search& search, float* wanted) const {
        search.end = space_.column_count;
        narrow(search, wanted);
    }

    void take(Search& search, bool is_legal, float* wanted) const {
        switch (search.question) {
            case Search::Question::All:
                if (is_legal) {
                    search.active = false;
                    return;
                }
                search.end = space_.column_count;
                return narrow(search, wanted);
            case Search::Question::Middle:
                (is_legal ? search.legal : search.end) = search.asked(space_.column_count);
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
        const float by_default = space_.defaults[column];
        if (is_real_[column] && search.halves < most_halves && search.mended < most_mended_) {
            wanted[column] = by_default + (wanted[column] - by_default) * 0.5f;
            search.halves += 1;
            search.question = Search::Question::Value;
            return;
        }
        wanted[column] = by_default;
        if (search.mended >= most_mended_) fall_back(search, search.legal, wanted);
        go_on(search);
    }

    void go_on(Search& search) const {
        search.legal += 1;
        search.halves = 0;
        search.mended += 1;
        search.question = Search::Question::All;
    }

    const ActionSpace& space_;
    const std::vector<std::uint8_t>&is_number_, &is_real_;
    int most_mended_;
};

}  // namespace

MendingRoom::MendingRoom(const ActionSpace& space, std::int64_t environments) {
    const auto count = static_cast<std::size_t>(environments);
    violated.resize(count);
    wanted.resize(count * static_cast<std::size_t>(space.column_count));
    searches.resize(count);
    is_number.resize(space.names.size());
    is_real.resize(space.names.size());
    for (const RealHead& head : space.reals) {
        is_number[static_cast<std::size_t>(head.column)] = 1;
        is_real[static_cast<std::size_t>(head.column)] = !head.rounds;
    }
}

std::int64_t mend_actions(const rddl_simulator& simulator, const ActionSpace& space,
                          const ActionRecords& converter, rddl_batch* batch, float* actions,
                          std::byte* records, MendingRoom& room) {
    std::vector<Search>& searches = room.searches;
    const auto environments = static_cast<std::int64_t>(searches.size());
    std::int32_t* const violated = room.violated.data();
    float* const wanted = room.wanted.data();
    require_done(simulator, simulator.violated_preconditions(batch, records, violated));
    const std::int64_t illegal =
        std::count_if(violated, violated + environments, [](std::int32_t v) { return v >= 0; });
    if (illegal == 0) return 0;

    const int columns = space.column_count;
    std::copy_n(actions, environments * columns, wanted);
    const Mending mending(space, room);
    // The first `count` values as they are wanted, the others as in what is legal.
    const auto set_first = [&](std::int64_t i, int count) {
        float* const row = actions + i * columns;
        std::copy_n(wanted + i * columns, columns, row);
        mending.fall_back(searches[static_cast<std::size_t>(i)], count, row);
        converter.write(row, records + static_cast<std::size_t>(i) * converter.record_size());
    };
    std::fill(searches.begin(), searches.end(), Search{});
    for (const bool keeps_categories : {false, true}) {
        const bool is_any = std::ranges::any_of(room.violated, [](auto v) { return v >= 0; });
        if (!is_any || (keeps_categories && space.reals.empty())) break;
        for (std::int64_t i = 0; i < environments; ++i) {
            if (violated[i] < 0) continue;
            searches[static_cast<std::size_t>(i)].active = true;
            searches[static_cast<std::size_t>(i)].keeps_categories = keeps_categories;
            set_first(i, 0);
        }
        require_done(simulator, simulator.violated_preconditions(batch, records, violated));
    }
    for (std::int64_t i = 0; i < environments; ++i) {
        Search& search = searches[static_cast<std::size_t>(i)];
        if (!search.active) continue;
        search.active = violated[i] < 0;
        search.active ? mending.start(search, wanted + i * columns) : set_first(i, columns);
    }

    const auto active = [](const Search& search) {
        return search.active;
    };
    while (std::any_of(searches.begin(), searches.end(), active)) {
        for (std::int64_t i = 0; i < environments; ++i) {
            const Search& search = searches[static_cast<std::size_t>(i)];
            if (search.active) set_first(i, search.asked(columns));
        }
        require_done(simulator, simulator.violated_preconditions(batch, records, violated));
        for (std::int64_t i = 0; i < environments; ++i) {
            Search& search = searches[static_cast<std::size_t>(i)];
            if (search.active) mending.take(search, violated[i] < 0, wanted + i * columns);
        }
    }
    return illegal;
}

}  // namespace rddlc::solvers
