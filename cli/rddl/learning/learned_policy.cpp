#include "learning/learned_policy.hpp"

#include "solvers/cgp/policy_file.hpp"
#include "solvers/ppo/policy_file.hpp"
#include "support/failure.hpp"
#include "support/files.hpp"

#include <fmt/format.h>

namespace rddlc::cli {

std::filesystem::path policy_file(const std::filesystem::path& path) {
    if (!is_folder(path)) return path;
    const std::filesystem::path formula = path / "policy.cgp";
    return is_there(formula) ? formula : path / "policy.json";
}

bool is_learned_policy(const std::filesystem::path& path) {
    const std::filesystem::path file = policy_file(path);
    return (file.extension() == ".json" || file.extension() == ".cgp") && is_there(file);
}

solvers::Policy learned_policy(const rddl_simulator& simulator, const std::filesystem::path& path,
                               bool random, std::uint64_t seed) {
    const std::filesystem::path file = policy_file(path);
    const std::string text = read_file(file);
    try {
        if (text.starts_with("rddl-cgp"))
            return solvers::program_policy(simulator, solvers::read_program(simulator, text),
                                           path.string());
        return solvers::ppo_policy(simulator, solvers::read_ppo_policy(simulator, text), random,
                                   seed, path.string());
    } catch (const Failure& failure) {
        throw Failure(fmt::format("cannot act by '{}': {}", file.string(), failure.what()));
    }
}

solvers::Policy policy_named(const rddl_simulator& simulator, const std::string& name, bool random,
                             std::uint64_t seed) {
    if (name == "random") return solvers::random_policy(simulator, seed);
    if (name == "noop") return solvers::noop_policy(simulator);
    if (name == "rddl") {
        if (!simulator.policy)
            throw Failure("there is no policy block in the files of the problem",
                          "name the file that has it: --policy-block=FILE.rddl");
        return solvers::block_policy(simulator);
    }
    if (!is_there(name))
        throw Failure(
            fmt::format("'{}' is neither random, noop, rddl, a policy file nor the folder of a run",
                        name),
            {}, usage_error);
    return learned_policy(simulator, name, random, seed);
}

}  // namespace rddlc::cli
