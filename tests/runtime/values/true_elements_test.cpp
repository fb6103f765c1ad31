// Sums over the true elements of a row, in one environment and in packs. Also built for other
// instruction sets (CMakeLists.txt).
#include <rddl/simulator.hpp>
#include <rddl/values/true_elements.hpp>

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace rddl {
namespace {

constexpr int width = 16;

template <std::size_t n>
using Rows = std::array<std::array<bool, n>, width>;  // of so many environments

template <std::size_t n>
Rows<n> rows_with(std::size_t kind) {
    Rows<n> rows;
    for (std::size_t lane = 0; lane < width; ++lane)
        for (std::size_t i = 0; i < n; ++i)
            rows[lane][i] = kind == 0   ? false
                            : kind == 1 ? true
                                        : (i * (lane + 3) + i / 7) % (kind + lane) == 0;
    return rows;
}

// Cancels, so that the order shows.
double term_of(Index i) {
    return i % 2 == 0 ? 1e16 + static_cast<double>(i) : -1e16 + 0.5 * static_cast<double>(i);
}

template <std::size_t n>
void expect_sums() {
    const auto size = static_cast<Index>(n);
    for (std::size_t kind = 0; kind < 12; ++kind) {
        const Rows<n> rows = rows_with<n>(kind);
        std::array<Mask<width>, n> masks;
        for (std::size_t i = 0; i < n; ++i)
            for (std::size_t lane = 0; lane < width; ++lane)
                masks[i].set(static_cast<int>(lane), rows[lane][i]);
        Context<Pack<width>> context{};
        context.active = Mask<width>(true);
        const auto counts = count_true(masks);
        const auto sums = sum_over_true<Pack<width>::Real>(masks, term_of);
        const auto jumping = sum_over_true<Pack<width>::Real>(context, masks, term_of);
        const auto ints = sum_over_true<Pack<width>::Int>(masks, [](Index i) { return 3 * i; });
        for (std::size_t lane = 0; lane < width; ++lane) {
            const auto& row = rows[lane];
            const auto counted = [&](Index i) {
                return row[static_cast<std::size_t>(i)];
            };
            const auto total =
                sum<double>(size, [&](Index i) { return counted(i) ? term_of(i) : 0.0; });
            const auto number =
                sum<std::int64_t>(size, [&](Index i) { return counted(i) ? 3 * i : 0; });
            const auto count = sum<std::int64_t>(size, [&](Index i) { return to_int(counted(i)); });
            const int at = static_cast<int>(lane);
            EXPECT_EQ(count_true(row), count) << n << " " << kind;
            EXPECT_EQ(counts[at], count) << n << " " << kind;
            EXPECT_EQ(sum_over_true<double>(row, term_of), total) << n << " " << kind;
            EXPECT_EQ(sums[at], total) << n << " " << kind;
            EXPECT_EQ(jumping[at], total) << n << " " << kind;
            EXPECT_EQ(sum_over_true<std::int64_t>(row, [](Index i) { return 3 * i; }), number);
            EXPECT_EQ(ints[at], number) << n << " " << kind;
        }
    }
}

TEST(TrueElements, AreCountedAndAdded) {
    expect_sums<1>();
    expect_sums<16>();
    expect_sums<63>();
    expect_sums<64>();
    expect_sums<65>();
    expect_sums<130>();
}

// Each row of a table has a sum of its own, also one that crosses a word.
TEST(TrueElements, AreAddedRowByRow) {
    constexpr std::size_t m = 11, n = 9;
    const auto term = [](Index x, Index y) {
        return term_of(static_cast<Index>(n) * x + y);
    };
    Context<Pack<width>> context{};
    context.active = Mask<width>(true);
    for (std::size_t kind = 0; kind < 12; ++kind) {
        const Rows<m* n> places = rows_with<m * n>(kind);
        std::array<std::array<Mask<width>, n>, m> masks;
        std::array<std::array<std::array<bool, n>, m>, width> tables;
        for (std::size_t i = 0; i < m * n; ++i)
            for (std::size_t lane = 0; lane < width; ++lane) {
                tables[lane][i / n][i % n] = places[lane][i];
                masks[i / n][i % n].set(static_cast<int>(lane), places[lane][i]);
            }
        const auto sums = sum_over_true<Pack<width>::Real>(masks, term);
        const auto jumping = sum_over_true<Pack<width>::Real>(context, masks, term);
        for (std::size_t lane = 0; lane < width; ++lane) {
            const auto total = sum<double>(static_cast<Index>(m), [&](Index x) {
                return sum<double>(static_cast<Index>(n), [&](Index y) {
                    const auto place =
                        n * static_cast<std::size_t>(x) + static_cast<std::size_t>(y);
                    return places[lane][place] ? term(x, y) : 0.0;
                });
            });
            EXPECT_EQ(sum_over_true<double>(tables[lane], term), total) << kind;
            EXPECT_EQ(sums[static_cast<int>(lane)], total) << kind;
            EXPECT_EQ(jumping[static_cast<int>(lane)], total) << kind;
        }
    }
}

// Terms of a table: with one true bool in each lane at most, in one lane none, and with two.
template <std::size_t m, std::size_t n>
void expect_terms_of_table(int kind) {
    std::array<std::array<double, n>, m> terms;
    std::array<std::array<Mask<width>, n>, m> masks;
    std::array<std::array<std::array<bool, n>, m>, width> tables{};
    for (std::size_t i = 0; i < m * n; ++i)
        terms[i / n][i % n] = i % 5 == 2 ? -0.0 : term_of(static_cast<Index>(i));
    for (std::size_t lane = 0; lane < width; ++lane)
        for (int k = lane == 4 ? 2 : 0; k < (kind == 2 && lane == 9 ? 2 : 1); ++k) {
            const std::size_t place =
                kind == 0 ? m * n - 1 : (7 * lane + 11 * static_cast<std::size_t>(k)) % (m * n);
            tables[lane][place / n][place % n] = true;
        }
    for (std::size_t i = 0; i < m * n; ++i)
        for (std::size_t lane = 0; lane < width; ++lane)
            masks[i / n][i % n].set(static_cast<int>(lane), tables[lane][i / n][i % n]);
    const auto sums = sum_where_true<Pack<width>::Real>(masks, terms);
    const auto of_row = sum_where_true<Pack<width>::Real>(masks[0], terms[0]);
    for (std::size_t lane = 0; lane < width; ++lane) {
        const auto& table = tables[lane];
        const auto total = sum_over_true<double>(table, [&](Index x, Index y) {
            return terms[static_cast<std::size_t>(x)][static_cast<std::size_t>(y)];
        });
        const auto total_of_row = sum_over_true<double>(
            table[0], [&](Index y) { return terms[0][static_cast<std::size_t>(y)]; });
        const int at = static_cast<int>(lane);
        EXPECT_EQ(std::bit_cast<std::uint64_t>(sum_where_true<double>(table, terms)),
                  std::bit_cast<std::uint64_t>(total));
        EXPECT_EQ(std::bit_cast<std::uint64_t>(sums[at]), std::bit_cast<std::uint64_t>(total))
            << m << " by " << n << ", " << kind << ", " << at;
        EXPECT_EQ(std::bit_cast<std::uint64_t>(of_row[at]),
                  std::bit_cast<std::uint64_t>(total_of_row))
            << n << ", " << kind << ", " << at;
    }
}

TEST(TrueElements, LookTermsUp) {
    for (const int kind : {0, 1, 2}) {
        expect_terms_of_table<1, 1>(kind);
        expect_terms_of_table<6, 6>(kind);
        expect_terms_of_table<8, 8>(kind);
        expect_terms_of_table<5, 13>(kind);
    }
}

TEST(TrueElements, GiveNoNegativeZero) {
    const std::array<bool, 3> row{true, false, true};
    EXPECT_FALSE(std::signbit(sum_over_true<double>(row, [](Index) { return -0.0; })));
}

// Only the terms of true elements are computed.
TEST(TrueElements, AreVisitedAlone) {
    std::array<bool, 70> row{};
    row[3] = row[69] = true;
    Index visited = 0;
    Context<Scalar> context{};
    sum_over_true<double>(context, row, [&](Index i) {
        visited = 100 * visited + i;
        return 1.0;
    });
    EXPECT_EQ(visited, 369);
}

// Each x has entries for the elements that are x + 0, ..., x + x mod 3 places on.
TEST(VisitTrue, MarksTheEntriesOfTheRowsOfTrueElements) {
    constexpr std::size_t n = 70;
    std::array<std::int64_t, n + 1> rows{};
    for (std::size_t x = 0; x < n; ++x) rows[x + 1] = rows[x] + static_cast<std::int64_t>(x % 3);
    const auto reached = [&](Index x, Index entry) {
        return (static_cast<std::size_t>(x + 5 * (entry - rows[static_cast<std::size_t>(x)]))) % n;
    };
    for (unsigned pattern = 0; pattern < 20; ++pattern) {
        constexpr int lanes = 16;
        std::array<Mask<lanes>, n> masks{}, of_masks;
        std::array<std::array<bool, n>, lanes> expected{};
        for (int lane = 0; lane < lanes; ++lane) {
            std::array<bool, n> row{}, of_row;
            for (std::size_t x = 0; x < n; ++x) {
                row[x] = (x * 7 + pattern * 13 + static_cast<unsigned>(lane)) % (pattern + 1) == 0;
                masks[x].set(lane, row[x]);
                if (!row[x]) continue;
                for (Index entry = rows[x]; entry < rows[x + 1]; ++entry)
                    expected[static_cast<std::size_t>(lane)]
                            [reached(static_cast<Index>(x), entry)] = true;
            }
            of_row.fill(false);
            visit_true(true_elements(row), rows, [&](Index x, Index entry, bool is_true) {
                mark<true>(of_row[reached(x, entry)], is_true);
            });
            EXPECT_EQ(of_row, expected[static_cast<std::size_t>(lane)]);
        }
        of_masks.fill(Mask<lanes>{false});
        visit_true(true_elements(masks), rows,
                   [&](Index x, Index entry, const Mask<lanes>& is_true) {
                       mark<true>(of_masks[reached(x, entry)], is_true);
                   });
        for (int lane = 0; lane < lanes; ++lane)
            for (std::size_t x = 0; x < n; ++x)
                EXPECT_EQ(of_masks[x][lane], expected[static_cast<std::size_t>(lane)][x]);
    }
}

// One true element is visited without a look for others.
// Things move along a ring; one that another follows stays true, so all leave before any arrives.
TEST(VisitTrue, TakesTurnsWhereOneIsTrue) {
    constexpr std::size_t n = 70;
    std::array<std::int64_t, n + 1> rows{};
    for (std::size_t x = 0; x < n; ++x) rows[x + 1] = rows[x] + 1;
    const auto move = [&]<class Bool>(const std::array<Bool, n>& from) {
        std::array<Bool, n> to = from;
        visit_true_in_turn(
            true_elements(from), rows,
            [&](Index x, Index, const Bool& is_there) {
                mark<false>(to[static_cast<std::size_t>(x)], is_there);
            },
            [&](Index, Index entry, const Bool& is_there) {
                mark<true>(to[static_cast<std::size_t>(entry + 1) % n], is_there);
            });
        return to;
    };
    for (const std::vector<std::size_t>& places :
         std::vector<std::vector<std::size_t>>{{}, {3}, {69}, {3, 4}, {68, 69, 0}}) {
        std::array<bool, n> row{}, moved{};
        std::array<Mask<16>, n> masks;
        masks.fill(Mask<16>{false});
        for (const std::size_t place : places) {
            row[place] = moved[(place + 1) % n] = true;
            masks[place] = Mask<16>{true};
        }
        EXPECT_EQ(move(row), moved);
        const auto moved_masks = move(masks);
        for (std::size_t x = 0; x < n; ++x) EXPECT_EQ(moved_masks[x][5], moved[x]);
    }
}

TEST(VisitTrue, TakesTrueElementsInOrder) {
    const auto visited = [](const std::vector<std::size_t>& places) {
        std::array<bool, 130> row{};
        for (const std::size_t place : places) row[place] = true;
        std::vector<std::size_t> visits;
        visit_true(true_elements(row), [&](Index x, bool is_true) {
            EXPECT_TRUE(is_true);
            visits.push_back(static_cast<std::size_t>(x));
        });
        return visits;
    };
    for (const std::vector<std::size_t>& places :
         {std::vector<std::size_t>{}, {0}, {63}, {64}, {129}, {3, 5}, {63, 64}, {70, 71, 129}})
        EXPECT_EQ(visited(places), places);
}

TEST(VisitTrue, TakesTheMarkedElementsAway) {
    constexpr std::size_t n = 70;
    std::array<bool, n> row{}, left;
    row[0] = row[63] = row[64] = true;
    left.fill(true);
    visit_true(true_elements(row), [&](Index x, bool is_true) {
        mark<false>(left[static_cast<std::size_t>(x)], is_true && x != 63);
    });
    for (std::size_t x = 0; x < n; ++x) EXPECT_EQ(left[x], x != 0 && x != 64) << x;
    std::array<Mask<16>, n> masks{}, of_masks;
    of_masks.fill(Mask<16>{true});
    masks[64].set(3, true);
    visit_true(true_elements(masks), [&](Index x, const Mask<16>& is_true) {
        mark<false>(of_masks[static_cast<std::size_t>(x)], is_true);
    });
    for (std::size_t x = 0; x < n; ++x) EXPECT_EQ(of_masks[x].bits, x == 64 ? 0xFFF7 : 0xFFFF) << x;
}

TEST(IsTrue, TakesAnyByteButZero) {
    std::array<unsigned char, 3> bytes = {0, 1, 0x82};
    const bool* const bools = reinterpret_cast<const bool*>(bytes.data());
    EXPECT_FALSE(is_true(bools[0]));
    EXPECT_TRUE(is_true(bools[1]));
    EXPECT_TRUE(is_true(bools[2]));
}

}  // namespace
}  // namespace rddl
