// Vectors whose values begin at a cache line: loads of whole lines then read one line each, not
// two.
#pragma once

#include <cstddef>
#include <new>
#include <vector>

namespace rddlc::planners {

template <class Value>
struct LineAllocator {
    using value_type = Value;
    static constexpr std::align_val_t line{64};

    LineAllocator() = default;
    template <class Other>
    LineAllocator(const LineAllocator<Other>&) {}

    Value* allocate(std::size_t count) {
        return static_cast<Value*>(::operator new(count * sizeof(Value), line));
    }
    void deallocate(Value* values, std::size_t) { ::operator delete(values, line); }
    friend bool operator==(const LineAllocator&, const LineAllocator&) { return true; }
};

template <class Value>
using Aligned = std::vector<Value, LineAllocator<Value>>;

}  // namespace rddlc::planners
