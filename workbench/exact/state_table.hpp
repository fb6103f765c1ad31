// Records of states, each once, by their numbers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <limits>
#include <string_view>
#include <utility>
#include <vector>

namespace rddlc::workbench {

using StateNumber = std::uint32_t;

class StateTable {
  public:
    static constexpr StateNumber absent = std::numeric_limits<StateNumber>::max();

    explicit StateTable(std::size_t record_size) : size_(record_size), slots_(64, absent) {}
    // Takes records one after the other; they must differ.
    StateTable(std::size_t record_size, std::vector<std::byte> records)
        : size_(record_size), records_(std::move(records)) {
        count_ = size_ == 0 ? 0 : static_cast<StateNumber>(records_.size() / size_);
        grow();
    }

    StateNumber count() const { return count_; }
    const std::byte* record(StateNumber state) const { return records_.data() + state * size_; }
    const std::vector<std::byte>& records() const { return records_; }
    // Bytes that it takes.
    std::size_t memory() const {
        return records_.capacity() + slots_.capacity() * sizeof slots_[0];
    }

    StateNumber find(const std::byte* record) const { return slots_[slot_of(record)]; }
    // The number of the record, which is a new one if it was not there.
    StateNumber add(const std::byte* record) {
        const std::size_t slot = slot_of(record);
        if (slots_[slot] != absent) return slots_[slot];
        slots_[slot] = count_++;
        records_.insert(records_.end(), record, record + size_);
        if (2 * static_cast<std::size_t>(count_) > slots_.size()) grow();
        return count_ - 1;
    }

  private:
    // The slot that has the record, or where it belongs.
    std::size_t slot_of(const std::byte* record) const {
        const std::string_view bytes(reinterpret_cast<const char*>(record), size_);
        std::size_t slot = std::hash<std::string_view>()(bytes) & (slots_.size() - 1);
        while (slots_[slot] != absent &&
               std::memcmp(this->record(slots_[slot]), record, size_) != 0)
            slot = (slot + 1) & (slots_.size() - 1);
        return slot;
    }
    void grow() {
        std::size_t size = 64;
        while (size < 4 * static_cast<std::size_t>(count_)) size *= 2;
        slots_.assign(size, absent);
        for (StateNumber state = 0; state < count_; ++state) slots_[slot_of(record(state))] = state;
    }

    std::size_t size_;
    StateNumber count_ = 0;
    std::vector<std::byte> records_;
    std::vector<StateNumber> slots_;  // a power of two, at most half of them taken
};

}  // namespace rddlc::workbench
