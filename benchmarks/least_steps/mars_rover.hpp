// MarsRover_ippc2023 3: six rovers and seven minerals.
#pragma once

#include "arithmetic.hpp"

namespace least_steps {

struct MarsRover {
    static constexpr std::size_t rovers = 6, minerals = 7;
    template <class L>
    using Reals = std::array<typename L::Real, rovers>;

    template <class L>
    struct State {
        Reals<L> x_speed, x, y_speed, y;
        std::array<typename L::Bool, minerals> harvested;

        void each(auto& records) {
            records.reals(x_speed, x, y_speed, y);
            records.bools(harvested);
        }
    };
    template <class L>
    struct Action {
        Reals<L> x_power, y_power;
        std::array<typename L::Bool, rovers> harvest;

        void each(auto& records) {
            records.reals(x_power, y_power);
            records.bools(harvest);
        }
    };

    template <class L>
    static RDDL_INLINE typename L::Real step(const State<L>& s, const Action<L>& action,
                                             const auto&, State<L>& next) {
        using Real = typename L::Real;
        Real control = 0, found = 0, harvests = 0;
        for (std::size_t r = 0; r < rovers; ++r) {
            const Real x = action.x_power[r], y = action.y_power[r];
            const Real power = rddl::sqrt(x * x + y * y);
            const auto is_great = power >= Real{0.1};
            const Real u_x = rddl::select(is_great, 0.1 * x / power, x);
            const Real u_y = rddl::select(is_great, 0.1 * y / power, y);
            next.x[r] = s.x[r] + 0.1 * s.x_speed[r];
            next.y[r] = s.y[r] + 0.1 * s.y_speed[r];
            next.x_speed[r] = s.x_speed[r] + 0.1 * u_x;
            next.y_speed[r] = s.y_speed[r] + 0.1 * u_y;
            control = control + (u_x * u_x + u_y * u_y);
            harvests = harvests + rddl::select(action.harvest[r], Real{1}, Real{0});
        }
        for (std::size_t m = 0; m < minerals; ++m) {
            const auto is_new = !s.harvested[m] && is_reached<L>(s, action, m);
            next.harvested[m] = s.harvested[m] || is_new;
            found = found + rddl::select(is_new, Real{value[m]}, Real{0});
        }
        return -control + found - harvests;
    }

    // Whether some rover harvests within the radius of the mineral.
    template <class L>
    static RDDL_INLINE typename L::Bool is_reached(const State<L>& s, const Action<L>& action,
                                                   std::size_t m) {
        using Real = typename L::Real;
        constexpr bool are_floats = std::is_same_v<typename L::Element, float>;
        const Real square{are_floats ? radius_squares_of_floats[m] : radius_squares[m]};
        typename L::Bool reached(false);
        for (std::size_t r = 0; r < rovers; ++r) {
            const Real x = s.x[r] - mineral_x[m], y = s.y[r] - mineral_y[m];
            reached = reached || (x * x + y * y < square && action.harvest[r]);
        }
        return reached;
    }

    static constexpr double mineral_x[] = {
        -2.877408261177024,  7.169667247794884,  1.1304908222792278, 0.349005890646934,
        -0.7157361981685249, 3.9106300567499233, -3.881986596566289};
    static constexpr double mineral_y[] = {
        -8.889954041131269, -5.6026339715800555, -1.9185667585385744, -2.2319741367427115,
        -0.426371418551188, -5.507614183842671,  -3.665545294443233};
    // A root is less than the radius where its square is less than these.
    static constexpr double radius_squares[] = {
        3.5622344639884704, 1.4426524809751125, 1.0172401537439737, 2.9460907466200896,
        7.586902799601011,  3.8590520249560663, 2.6085773275407544};
    static constexpr float radius_squares_of_floats[] = {
        3.5622342f, 1.4426522f, 1.0172399f, 2.9460907f, 7.586903f, 3.859052f, 2.6085773f};
    static constexpr double value[] = {8.701907471630431,  17.94192376337854,  14.407062346673566,
                                       12.896468197325623, 12.903718901551768, 4.551323836410228,
                                       0.9399034223799907};
};

}  // namespace least_steps
