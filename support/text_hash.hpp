// FNV-1a, the hash of G. Fowler, L. Noll and K. Vo: the same on all machines. Against bad luck, not
// bad will.
#pragma once

#include <cstdint>
#include <string_view>

namespace rddlc {

class TextHash {
  public:
    void add(std::string_view bytes) {
        for (const char byte : bytes) add_byte(static_cast<unsigned char>(byte));
        value_ *= prime;  // "ab" and "c" differ from "a" and "bc"
    }
    void add(std::uint64_t number) {
        for (int i = 0; i < 8; ++i) add_byte(static_cast<unsigned char>(number >> 8 * i & 0xFF));
    }
    std::uint64_t value() const { return value_; }

  private:
    static constexpr std::uint64_t prime = 0x100000001B3;
    void add_byte(unsigned char byte) {
        value_ ^= byte;
        value_ *= prime;
    }
    std::uint64_t value_ = 0xCBF29CE484222325;
};

}  // namespace rddlc
