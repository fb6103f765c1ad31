#include "solvers/files/fingerprint.hpp"

#include <bit>

namespace rddlc::solvers {

namespace {

// FNV-1a: G. Fowler, L. Noll, K. Vo.
struct Hash {
    std::uint64_t value = 0xCBF29CE484222325;
    void add(std::string_view bytes) {
        for (const char byte : bytes) {
            value ^= static_cast<unsigned char>(byte);
            value *= 0x100000001B3;
        }
        add_end();
    }
    void add(std::int64_t number) {
        for (int i = 0; i < 8; ++i) {
            value ^= static_cast<std::uint64_t>(number) >> 8 * i & 0xFF;
            value *= 0x100000001B3;
        }
    }
    void add_end() { value *= 0x100000001B3; }
};

}  // namespace

std::uint64_t fingerprint(const rddl_simulator& simulator) {
    const rddl_problem& problem = *simulator.problem;
    Hash hash;
    hash.add(problem.domain);
    hash.add(problem.instance);
    hash.add(problem.horizon);
    hash.add(std::bit_cast<std::int64_t>(problem.discount));
    for (std::int32_t f = 0; f < problem.fluent_count; ++f) {
        const rddl_fluent& fluent = *rddl_fluent_at(&problem, f);
        if (fluent.role == RDDL_INTERM || fluent.role == RDDL_DERIVED) continue;
        hash.add(fluent.name);
        hash.add(fluent.count);
    }
    return hash.value;
}

std::uint64_t checksum(std::string_view bytes) {
    Hash hash;
    hash.add(bytes);
    return hash.value;
}

}  // namespace rddlc::solvers
