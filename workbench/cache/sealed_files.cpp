#include "cache/sealed_files.hpp"

#include "cache/cache_folder.hpp"
#include "support/files.hpp"
#include "support/sha256.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <cstring>
#include <set>
#include <string>
#include <string_view>
#include <system_error>

namespace rddlc::workbench {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t seal_size = 64;
constexpr const char* list_name = "sealed";

// The checksum protects against accidents, not attacks: other users cannot write there. A
// precompiled header has 50 MB, for which SHA-256 would take a quarter of a second.
std::uint64_t checksum(std::string_view bytes) {
    constexpr std::uint64_t odd = 0x9E3779B97F4A7C15;
    std::uint64_t sum = bytes.size();
    const auto add = [&](std::uint64_t word) {
        sum = (sum ^ word) * odd;
        sum ^= sum >> 32;
    };
    while (bytes.size() >= sizeof(std::uint64_t)) {
        std::uint64_t word = 0;
        std::memcpy(&word, bytes.data(), sizeof word);
        add(word);
        bytes.remove_prefix(sizeof word);
    }
    for (const char byte : bytes) add(static_cast<unsigned char>(byte));
    return sum;
}

// A line for each file but the list itself, in any order.
std::set<std::string> lines_of(const fs::path& folder) {
    std::set<std::string> lines;
    for (const auto& entry : fs::directory_iterator(folder)) {
        const std::string name = entry.path().filename().string();
        if (name == list_name) continue;
        if (!is_ours(entry.path())) return {};
        const std::string content = read_file(entry.path());
        lines.insert(fmt::format("{:016x} {} {}\n", checksum(content), content.size(), name));
    }
    return lines;
}

std::string list_of(const fs::path& folder) {
    std::string text;
    for (const std::string& line : lines_of(folder)) text += line;
    return text;
}

}  // namespace

void seal(const fs::path& object) {
    const std::string content = read_file(object);
    UsedFiles used;
    write_file(object, content + sha256(content), used);
}

bool is_sealed(const fs::path& object) {
    if (!is_ours(object)) return false;
    const std::string content = read_file(object);
    if (content.size() < seal_size) return false;
    const std::size_t end = content.size() - seal_size;
    return sha256(std::string_view(content).substr(0, end)) == content.substr(end);
}

void seal_folder(const fs::path& folder) {
    UsedFiles used;
    write_file(folder / list_name, list_of(folder), used);
}

bool is_sealed_folder(const fs::path& folder) {
    const fs::path list = folder / list_name;
    if (!is_ours(list)) return false;
    const std::string text = read_file(list);
    return !text.empty() && text == list_of(folder);
}

}  // namespace rddlc::workbench
