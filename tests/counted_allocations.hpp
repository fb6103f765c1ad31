// Counts what a program allocates: it replaces operator new, so one file of a program includes it.
#pragma once

#include <malloc.h>

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <new>

namespace {
std::atomic<std::int64_t> allocations = 0;
std::atomic<std::int64_t> live_bytes = 0;  // that are allocated now

void* counted(std::size_t size, std::size_t alignment) {
    ++allocations;
    const std::size_t rounded = (size + alignment - 1) / alignment * alignment;
    void* const memory = std::aligned_alloc(alignment, rounded == 0 ? alignment : rounded);
    if (!memory) throw std::bad_alloc();
    live_bytes += static_cast<std::int64_t>(malloc_usable_size(memory));
    return memory;
}

void discard(void* memory) {
    live_bytes -= static_cast<std::int64_t>(malloc_usable_size(memory));
    std::free(memory);
}
}  // namespace

void* operator new(std::size_t size) {
    return counted(size, alignof(std::max_align_t));
}
void* operator new(std::size_t size, std::align_val_t alignment) {
    return counted(size, static_cast<std::size_t>(alignment));
}
void operator delete(void* memory) noexcept {
    discard(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
    discard(memory);
}
void operator delete(void* memory, std::align_val_t) noexcept {
    discard(memory);
}
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept {
    discard(memory);
}
