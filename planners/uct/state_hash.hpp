// States by the bytes of their records: keys, and a table of them.
#pragma once

#include "planners/simulation/record_hash.hpp"
#include "planners/uct/large_pages.hpp"

#include <cstddef>
#include <cstdint>
#include <utility>

namespace rddlc::planners {

// Numbers from 1 on by key. Open addressing with linear probing: a search meets one cache line most
// of the time, which counts in a search tree.
class StateTable {
  public:
    StateTable() : slots_(first_size) {}

    // NULL: the key is not there.
    const std::uint32_t* find(std::uint64_t key) const {
        const Slot& slot = slots_[place_of(key)];
        return slot.number == 0 ? nullptr : &slot.number;
    }
    // Asks for the memory that a search for the key reads first.
    void prefetch(std::uint64_t key) const {
        __builtin_prefetch(slots_.data() + (key & (slots_.size() - 1)));
    }
    // The number of the key, which is `number` if the key is new, and whether it is.
    std::pair<std::uint32_t, bool> add(std::uint64_t key, std::uint32_t number) {
        if (2 * (count_ + 1) > slots_.size()) grow();
        Slot& slot = slots_[place_of(key)];
        if (slot.number != 0) return {slot.number, false};
        slot = {key, number};
        ++count_;
        return {number, true};
    }
    void clear() {
        slots_.assign(first_size, {});
        count_ = 0;
    }
    std::size_t bytes() const { return slots_.size() * sizeof(Slot); }

  private:
    static constexpr std::size_t first_size = 64;
    struct Slot {
        std::uint64_t key = 0;
        std::uint32_t number = 0;  // 0: empty
    };

    // Where the key is, or may be put.
    std::size_t place_of(std::uint64_t key) const {
        std::size_t place = key & (slots_.size() - 1);
        while (slots_[place].number != 0 && slots_[place].key != key)
            place = (place + 1) & (slots_.size() - 1);
        return place;
    }
    void grow() {
        LargeVector<Slot> old(2 * slots_.size());
        old.swap(slots_);
        for (const Slot& slot : old)
            if (slot.number != 0) slots_[place_of(slot.key)] = slot;
    }

    LargeVector<Slot> slots_;
    std::size_t count_ = 0;
};

}  // namespace rddlc::planners
