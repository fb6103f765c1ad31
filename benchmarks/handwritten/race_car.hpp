// RaceCar_ippc2023 5: 24 walls along the axes. A table of places tells how far each is from all
// walls, so that only moves near one are tested; by the formulas of the text, eight walls in a
// register, since what is rounded decides.
#pragma once

#include "bools.hpp"
#include "tables.hpp"

namespace handwritten {

struct RaceCar {
    static constexpr int width = 16;
    static constexpr std::uint64_t horizon = 150;
    static constexpr bool stochastic = false;
    static constexpr std::size_t walls = std::size(race_car::x1);

    template <class L>
    struct State {
        typename L::Real x, y, velocity_x, velocity_y;
        typename L::Bool is_there;
    };
    template <class L>
    struct Actions {
        typename L::Real x, y;
    };

    static void start(State<rddl::Scalar>& s) {
        s = {race_car::start_x, race_car::start_y, 0, 0, false};
    }
    template <class L>
    static void start(State<L>& s, typename L::Bool where) {
        s = {select(where, double{race_car::start_x}, s.x),
             select(where, double{race_car::start_y}, s.y), select(where, 0.0, s.velocity_x),
             select(where, 0.0, s.velocity_y), s.is_there && !where};
    }
    static void load(Actions<rddl::Scalar>& actions, const std::byte* record) {
        std::memcpy(&actions, record, sizeof actions);
    }
    template <class L>
    static void load(Actions<L>& actions, const std::byte* records) {
        const auto* const values = reinterpret_cast<const double*>(records);
        const typename L::Int rows = row_starts<L>(2);
        actions = {gather(values, rows), gather(values + 1, rows)};
    }

    // ---------------------------------------------------------------------------- the walls

    static constexpr int size = 64;  // squares along a side of the map
    static constexpr double extent = 2;
    struct Walls {
        double left[walls], right[walls], low[walls], high[walls], width[walls], height[walls];
        // By square: moves that are shorter in both directions meet no wall.
        double room[size * size];
    };
    static inline const Walls track = [] {
        Walls all;
        for (std::size_t k = 0; k < walls; ++k) {
            all.left[k] = std::min(race_car::x1[k], race_car::x2[k]);
            all.right[k] = std::max(race_car::x1[k], race_car::x2[k]);
            all.low[k] = std::min(race_car::y1[k], race_car::y2[k]);
            all.high[k] = std::max(race_car::y1[k], race_car::y2[k]);
            all.width[k] = race_car::x2[k] - race_car::x1[k];
            all.height[k] = race_car::y2[k] - race_car::y1[k];
        }
        const double side = extent / size, rounding = 1e-6;
        for (int square = 0; square < size * size; ++square) {
            const double x = square / size * side, y = square % size * side;
            double room = extent;
            for (std::size_t k = 0; k < walls; ++k) {
                const double beside = std::max(all.left[k] - (x + side), x - all.right[k]);
                const double above = std::max(all.low[k] - (y + side), y - all.high[k]);
                room = std::min(room, std::max(beside, above));
            }
            all.room[square] = room - rounding;
        }
        return all;
    }();

    static double room_at(double x, double y) {
        const bool on_map = x >= 0 && x < extent && y >= 0 && y < extent;
        if (!on_map) return -1;
        return track.room[static_cast<int>(x * (size / extent)) * size +
                          static_cast<int>(y * (size / extent))];
    }
    template <int n>
    static rddl::Lanes<double, n> room_at(const rddl::Lanes<double, n>& x,
                                          const rddl::Lanes<double, n>& y) {
        const auto on_map = x >= 0.0 && x < extent && y >= 0.0 && y < extent;
        const rddl::Lanes<double, n> scale{size / extent}, zero{0.0};
        const auto square =
            rddl::floor(select(on_map, x * scale, zero)) * rddl::Lanes<std::int64_t, n>{size} +
            rddl::floor(select(on_map, y * scale, zero));
        return select(on_map, gather(track.room, square), rddl::Lanes<double, n>{-1.0});
    }

    struct Move {
        double x, y, to_x, to_y, dx, dy;
    };
    [[gnu::noinline]] static bool meets_wall(const Move& m) {
        using Real = rddl::Lanes<double, lanes_in_one>;
        const Real zero{0.0}, x{m.x}, y{m.y}, to_x{m.to_x}, to_y{m.to_y}, dx{m.dx}, dy{m.dy};
        const Real from_left{std::min(m.x, m.to_x)}, from_right{std::max(m.x, m.to_x)},
            from_low{std::min(m.y, m.to_y)}, from_high{std::max(m.y, m.to_y)};
        const auto sides_differ = [&](const Real& a, const Real& b) {
            return ((a > zero) != (b > zero)) || ((a < zero) != (b < zero));
        };
        for (std::size_t k = 0; k < walls; k += lanes_in_one) {
            const auto of = [&](const double* table) {
                return Real::load(table + k);
            };
            const Real x1 = of(race_car::x1), y1 = of(race_car::y1), x2 = of(race_car::x2),
                       y2 = of(race_car::y2), wall_x = of(track.width), wall_y = of(track.height);
            const Real o1 = dy * (x1 - to_x) - dx * (y1 - to_y),
                       o2 = dy * (x2 - to_x) - dx * (y2 - to_y),
                       o3 = wall_y * (x - x2) - wall_x * (y - y2),
                       o4 = wall_y * (to_x - x2) - wall_x * (to_y - y2);
            auto meets = sides_differ(o1, o2) && sides_differ(o3, o4);
            const auto in_move = [&](const Real& a, const Real& b) {
                return a <= from_right && a >= from_left && b <= from_high && b >= from_low;
            };
            const auto in_wall = [&](const Real& a, const Real& b) {
                return a <= of(track.right) && a >= of(track.left) && b <= of(track.high) &&
                       b >= of(track.low);
            };
            const auto none1 = o1 == zero, none2 = o2 == zero, none3 = o3 == zero,
                       none4 = o4 == zero;
            if (any(none1 || none2 || none3 || none4))
                meets = meets || (none1 && in_move(x1, y1)) || (none2 && in_move(x2, y2)) ||
                        (none3 && in_wall(x, y)) || (none4 && in_wall(to_x, to_y));
            if (any(meets)) return true;
        }
        return false;
    }

    static bool violates(const State<rddl::Scalar>& s, double dx, double dy) {
        if (std::max(std::fabs(dx), std::fabs(dy)) < room_at(s.x, s.y)) return false;
        return meets_wall({s.x, s.y, s.x + dx, s.y + dy, dx, dy});
    }
    template <int n>
    static rddl::Mask<n> violates(const State<rddl::Pack<n>>& s, const rddl::Lanes<double, n>& dx,
                                  const rddl::Lanes<double, n>& dy) {
        const auto room = room_at(s.x, s.y);
        const auto is_near = !(rddl::absolute(dx) < room && rddl::absolute(dy) < room);
        rddl::Mask<n> meets(false);
        if (any(is_near)) [[unlikely]]
            rddl::for_each_lane(is_near, [&](int lane) {
                const double x = s.x[lane], y = s.y[lane];
                meets.set(lane, meets_wall({x, y, x + dx[lane], y + dy[lane], dx[lane], dy[lane]}));
            });
        return meets;
    }

    // ----------------------------------------------------------------------------- the step

    template <class L, class Draws>
    static typename L::Real step(State<L>& s, const Actions<L>& force, const Draws&) {
        using Real = typename L::Real;
        constexpr double dt = 0.1;
        const Real dx = s.velocity_x * dt + force.x * (dt * dt) / 2.0,
                   dy = s.velocity_y * dt + force.y * (dt * dt) / 2.0;
        const auto meets = violates(s, dx, dy);
        s.x = s.x + dx;
        s.y = s.y + dy;
        s.velocity_x = s.velocity_x + force.x * dt;
        s.velocity_y = s.velocity_y + force.y * dt;
        s.is_there = typename L::Bool(false);
        if (any(meets)) [[unlikely]]
            restart(s, meets);
        const Real x = s.x - race_car::goal_x, y = s.y - race_car::goal_y;
        s.is_there = rddl::sqrt(x * x + y * y) <= race_car::radius;
        return -0.01 * rddl::sqrt(force.x * force.x + force.y * force.y) +
               select(s.is_there, Real{1.0}, Real{0.0});
    }
    static void restart(State<rddl::Scalar>& s, bool) { start(s); }
    template <class L>
    static void restart(State<L>& s, typename L::Bool where) {
        start(s, where);
    }

    template <class L>
    static auto terminated(const State<L>& s) {
        return s.is_there;
    }
    static constexpr bool broken(const auto&) { return false; }

    template <class L>
    static void store(const State<L>& s, std::int64_t lane, std::byte* record) {
        const double values[] = {lane_of(s.x, lane), lane_of(s.y, lane),
                                 lane_of(s.velocity_x, lane), lane_of(s.velocity_y, lane)};
        std::memcpy(record, values, sizeof values);
    }
};

}  // namespace handwritten
