// Traffic_CTM_MDP_ippc2011 10: the streets and rules of traffic.hpp, with other cars and rates.
#pragma once

#include "traffic.hpp"

namespace handwritten {

struct TrafficCtmTables {
    static constexpr const auto &occupied = traffic_ctm::occupied, &exits = traffic_ctm::exits,
                                &north_south = traffic_ctm::north_south,
                                &east_west = traffic_ctm::east_west, &rates = traffic_ctm::rates;
};
struct TrafficCtm : CrossingStreets<TrafficCtmTables> {};

}  // namespace handwritten
