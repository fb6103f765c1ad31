// The records of callers, from and to packs.
#pragma once

#include "interface.hpp"

#include <array>
#include <cstring>
#include <type_traits>

namespace least_steps {

// Visits the fluents of the records of a pack, in the order of their declaration.
class Records {
  public:
    static Records read(const std::byte* first, std::size_t size) {
        return {const_cast<std::byte*>(first), size, false};
    }
    static Records write(std::byte* first, std::size_t size) { return {first, size, true}; }

    template <class... Values>
    void reals(Values&... values) {
        (visit<double>(values), ...);
    }
    // Ints may stand in lanes of any type.
    template <class... Values>
    void ints(Values&... values) {
        (visit<std::int64_t>(values), ...);
    }
    template <class... Values>
    void bools(Values&... values) {
        (visit<std::uint8_t>(values), ...);
    }

  private:
    Records(std::byte* first, std::size_t size, bool writes)
        : first_(first), size_(size), writes_(writes) {}

    template <class Stored, class Value, std::size_t count>
    void visit(std::array<Value, count>& values) {
        for (Value& value : values) visit<Stored>(value);
    }
    template <class Stored, class Value>
    void visit(Value& value) {
        at_ = (at_ + sizeof(Stored) - 1) / sizeof(Stored) * sizeof(Stored);
        for (int lane = 0; lane < width; ++lane) {
            std::byte* const place = first_ + static_cast<std::size_t>(lane) * size_ + at_;
            if (writes_)
                write_one(static_cast<Stored>(value[lane]), place);
            else
                value.set(lane, static_cast<std::remove_cvref_t<decltype(value[lane])>>(
                                    read_one<Stored>(place)));
        }
        at_ += sizeof(Stored);
    }
    template <class Stored>
    static Stored read_one(const std::byte* place) {
        Stored stored;
        std::memcpy(&stored, place, sizeof stored);
        return stored;
    }
    template <class Stored>
    static void write_one(Stored stored, std::byte* place) {
        std::memcpy(place, &stored, sizeof stored);
    }

    std::byte* first_;
    std::size_t size_;
    bool writes_;
    std::size_t at_ = 0;
};

}  // namespace least_steps
