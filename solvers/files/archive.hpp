// Values as bytes and back, for checkpoints: of the same program on the same kind of machine.
#pragma once

#include "support/failure.hpp"

#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace rddlc::solvers {

// Both archives are called alike, with each value in turn.
class SavingArchive {
  public:
    static constexpr bool is_loading = false;
    template <class T>
    requires std::is_trivially_copyable_v<T>
    void operator()(const T& value) {
        bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
    }
    template <class T>
    void operator()(const std::vector<T>& values) {
        (*this)(static_cast<std::uint64_t>(values.size()));
        bytes_.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
    }
    void operator()(const std::string& text) {
        (*this)(static_cast<std::uint64_t>(text.size()));
        bytes_.append(text);
    }
    // A vector of fixed size: the size is not saved, since the reader knows it.
    template <class T>
    void fixed(const std::vector<T>& values) {
        (*this)(values);
    }
    // Appends the bytes of another archive.
    void append(std::string_view bytes) { bytes_.append(bytes); }
    const std::string& bytes() const { return bytes_; }

  private:
    std::string bytes_;
};

// Throws a Failure where the bytes end before the values do. Nothing gets more room than there are
// bytes.
class LoadingArchive {
  public:
    static constexpr bool is_loading = true;
    explicit LoadingArchive(std::string_view bytes) : bytes_(bytes) {}

    template <class T>
    requires std::is_trivially_copyable_v<T>
    void operator()(T& value) { take(&value, sizeof value); }
    // A byte that is neither 0 nor 1 would be no bool.
    void operator()(bool& value) {
        std::uint8_t byte = 0;
        take(&byte, sizeof byte);
        if (byte > 1) throw Failure("it is damaged: a bool in it is neither true nor false");
        value = byte != 0;
    }
    template <class T>
    void operator()(std::vector<T>& values) {
        values.resize(size_of_next(sizeof(T)));
        take(values.data(), values.size() * sizeof(T));
    }
    void operator()(std::string& text) {
        text.resize(size_of_next(1));
        take(text.data(), text.size());
    }
    template <class T>
    void fixed(std::vector<T>& values) {
        if (size_of_next(sizeof(T)) != values.size())
            throw Failure("it does not fit what is learned: it is damaged, or of another version");
        take(values.data(), values.size() * sizeof(T));
    }
    bool at_end() const { return bytes_.empty(); }

  private:
    std::size_t size_of_next(std::size_t element) {
        std::uint64_t size = 0;
        (*this)(size);
        if (size > bytes_.size() / element) fail();
        return static_cast<std::size_t>(size);
    }
    void take(void* to, std::size_t size) {
        if (size > bytes_.size()) fail();
        if (size > 0) std::memcpy(to, bytes_.data(), size);
        bytes_.remove_prefix(size);
    }
    [[noreturn]] static void fail() { throw Failure("it is not complete"); }

    std::string_view bytes_;
};

}  // namespace rddlc::solvers
