#include "solvers/files/checkpoint.hpp"

#include "support/failure.hpp"

#include <fmt/format.h>

namespace rddlc::solvers {

void begin_checkpoint(SavingArchive& archive, const CheckpointKind& kind,
                      const Fingerprint& problem) {
    archive(kind.magic);
    archive(kind.version);
    Fingerprint(problem).archive(archive);
}

void begin_checkpoint(LoadingArchive& archive, const CheckpointKind& kind,
                      const Fingerprint& problem) {
    std::string magic;
    std::uint64_t version = 0;
    Fingerprint its;
    archive(magic);
    if (magic != kind.magic)
        throw Failure(fmt::format("it is not a checkpoint of {}", kind.solver));
    archive(version);
    if (version != kind.version)
        throw Failure(fmt::format("it is of version {}, and this program reads version {}", version,
                                  kind.version));
    its.archive(archive);
    if (const std::string what = difference(its, problem); !what.empty())
        throw Failure(what,
                      "continue with the files that the run began with, or begin a new run "
                      "with another --out");
}

}  // namespace rddlc::solvers
