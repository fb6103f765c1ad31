// Traffic_CTM_MDP_ippc2011 10: the streets and rules of traffic.hpp, with other cars and rates.
#pragma once

#include "traffic.hpp"

namespace handwritten {

struct TrafficCtmTables {
    static constexpr const auto& occupied = traffic_ctm::occupied;
    static constexpr const auto& exits = traffic_ctm::exits;
    static constexpr const auto& north_south = traffic_ctm::north_south;
    static constexpr const auto& east_west = traffic_ctm::east_west;
    static constexpr const auto& rates = traffic_ctm::rates;
};
struct TrafficCtm : CrossingStreets<TrafficCtmTables> {};

}  // namespace handwritten
