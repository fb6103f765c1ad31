// The outcomes of actions: each action has a small hash table of its own, since a trial that takes
// it looks for one outcome, and so meets a single cache line.
#pragma once

#include "planners/uct/large_pages.hpp"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

namespace rddlc::planners {

using NodeId = std::uint32_t;
inline constexpr NodeId no_node = std::numeric_limits<NodeId>::max();

// A node that an action led to.
struct Outcome {
    double value = 0;       // the node's, when it was last backed up to the edge
    NodeId node = no_node;  // no_node: this place is empty
    std::int32_t done = 0;  // trials that came here and were backed up
};

// The table of one action: a block of no places, or of 2^(level - 1).
struct OutcomeTable {
    std::uint32_t first = 0;
    std::uint32_t count : 27 = 0, level : 5 = 0;

    std::uint32_t capacity() const { return (std::uint32_t{1} << level) >> 1; }
    // Places of a table change where an outcome is added to it: whether this one still is its.
    bool has(std::uint32_t place) const { return place - first < capacity(); }
};

// The blocks of all tables. Open addressing with linear probing.
class OutcomeTables {
  public:
    void clear() { places_.clear(); }
    void reserve_as(const OutcomeTables& other) { places_.reserve(other.places_.size()); }
    std::size_t bytes() const { return places_.size() * sizeof(Outcome); }

    Outcome& operator[](std::uint32_t place) { return places_[place]; }
    const Outcome& operator[](std::uint32_t place) const { return places_[place]; }
    // All places of the table, also empty ones.
    std::span<const Outcome> places(const OutcomeTable& table) const {
        return {places_.data() + table.first, table.capacity()};
    }
    // Asks for the memory that add() reads first.
    void prefetch(const OutcomeTable& table, NodeId node) const {
        __builtin_prefetch(places_.data() + table.first + offset_of(table, node));
    }
    // The place of the outcome of that node, which is added to the table if it is new.
    std::uint32_t add(OutcomeTable& table, NodeId node) {
        std::uint32_t place = place_of(table, node);
        if (place != nowhere && places_[place].node == node) return place;
        if (place == nowhere || is_full(table)) {
            grow(table);
            place = place_of(table, node);
        }
        places_[place].node = node;
        ++table.count;
        return place;
    }

  private:
    static constexpr std::uint32_t nowhere = std::numeric_limits<std::uint32_t>::max();
    // Small tables may have no empty place: all of it lies in a cache line or two.
    static bool is_full(const OutcomeTable& table) {
        constexpr std::uint32_t small = 4;
        return table.capacity() > small && 4u * (table.count + 1u) > 3u * table.capacity();
    }
    // The upper bits of 32 of a product (Knuth's multiplicative hashing).
    static std::uint32_t offset_of(const OutcomeTable& table, NodeId node) {
        const std::uint64_t product = node * std::uint32_t{0x9E3779B1};
        return static_cast<std::uint32_t>(product >> (33 - table.level));
    }
    // Where the node is, or may be put.
    std::uint32_t place_of(const OutcomeTable& table, NodeId node) const {
        const std::uint32_t capacity = table.capacity();
        std::uint32_t offset = offset_of(table, node);
        for (std::uint32_t tried = 0; tried < capacity; ++tried) {
            const NodeId here = places_[table.first + offset].node;
            if (here == node || here == no_node) return table.first + offset;
            offset = (offset + 1) & (capacity - 1);
        }
        return nowhere;
    }
    // The table moves to a new block at the end, with as much room again.
    void grow(OutcomeTable& table) {
        const OutcomeTable old = table;
        table.first = static_cast<std::uint32_t>(places_.size());
        table.level = (old.level + 1u) & 31u;
        places_.resize(places_.size() + table.capacity());
        for (std::uint32_t k = 0; k < old.capacity(); ++k) {
            const Outcome outcome = places_[old.first + k];
            if (outcome.node != no_node) places_[place_of(table, outcome.node)] = outcome;
        }
    }

    LargeVector<Outcome> places_;
};

}  // namespace rddlc::planners
