// Fields of protocol buffers, as bytes: TensorBoard's events and ONNX models are made of them.
// https://protobuf.dev/programming-guides/encoding
#pragma once

#include <bit>
#include <cstdint>
#include <string>
#include <string_view>

namespace rddlc::solvers {

inline void append_little_endian(std::string& out, std::uint64_t number, int bytes) {
    for (int i = 0; i < bytes; ++i) out += static_cast<char>(number >> 8 * i & 0xFF);
}
inline void append_varint(std::string& out, std::uint64_t number) {
    for (; number >= 0x80; number >>= 7) out += static_cast<char>((number & 0x7F) | 0x80);
    out += static_cast<char>(number);
}

inline void append_number(std::string& out, unsigned field, std::uint64_t number) {
    append_varint(out, field << 3);
    append_varint(out, number);
}
inline void append_double(std::string& out, unsigned field, double value) {
    append_varint(out, field << 3 | 1);
    append_little_endian(out, std::bit_cast<std::uint64_t>(value), 8);
}
inline void append_bytes(std::string& out, unsigned field, std::string_view bytes) {
    append_varint(out, field << 3 | 2);
    append_varint(out, bytes.size());
    out += bytes;
}
inline void append_float(std::string& out, unsigned field, float value) {
    append_varint(out, field << 3 | 5);
    append_little_endian(out, std::bit_cast<std::uint32_t>(value), 4);
}

}  // namespace rddlc::solvers
