#include "solvers/files/checkpoint.hpp"

#include "solvers/files/fingerprint.hpp"
#include "support/failure.hpp"

#include <fmt/format.h>

namespace rddlc::solvers {

void begin_checkpoint(SavingArchive& archive, const CheckpointKind& kind,
                      const rddl_simulator& simulator) {
    archive(kind.magic);
    archive(kind.version);
    archive(fingerprint(simulator));
}

void begin_checkpoint(LoadingArchive& archive, const CheckpointKind& kind,
                      const rddl_simulator& simulator) {
    std::string magic;
    std::uint64_t version = 0, problem = 0;
    archive(magic);
    if (magic != kind.magic) throw Failure(fmt::format("it is no checkpoint of {}", kind.solver));
    archive(version);
    if (version != kind.version)
        throw Failure(fmt::format("it is of version {}, and this program reads version {}", version,
                                  kind.version));
    archive(problem);
    if (problem != fingerprint(simulator)) throw Failure("it is of another problem");
}

}  // namespace rddlc::solvers
