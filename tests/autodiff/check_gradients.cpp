// Gradients of problems against differences, and their values against the interpreter's:
//
//     check_gradients [FOLDER [STEPS [all]]]
//
// takes the first instance of each folder with a domain.rddl, or all of them. Without a folder it
// is that of rddlrepository, of whose instances it is known how many are refused. An instance with
// derivatives has to be among them.
#include "../parse/rddl_repository.hpp"
#include "driver/driver.hpp"
#include "passes/aggregations/shorten_aggregations.hpp"
#include "step_check.hpp"
#include "support/failure.hpp"

#include <fmt/format.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <set>
#include <utility>

namespace fs = std::filesystem;

namespace {

using namespace rddlc;

// Problems of rddlrepository that are refused, by the first instance of each.
constexpr int refused_of_repository = 1;

std::vector<fs::path> instances_of(const fs::path& folder, bool takes_all) {
    std::set<fs::path> folders;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder))
        if (entry.path().filename() == "domain.rddl") folders.insert(entry.path().parent_path());
    std::vector<fs::path> found;
    for (const fs::path& each : folders) {
        std::set<fs::path> instances;
        for (const fs::directory_entry& entry : fs::directory_iterator(each))
            if (entry.path().filename().string().starts_with("instance") &&
                entry.path().extension() == ".rddl")
                instances.insert(entry.path());
        for (const fs::path& instance : instances) {
            found.push_back(instance);
            if (!takes_all) break;
        }
    }
    return found;
}

// The sums over all instances.
struct Findings {
    int checked = 0, refused = 0, wrong = 0;
    std::int64_t derivatives = 0;
};

void check(const fs::path& instance, std::int64_t steps, Findings& findings) {
    const std::string name = (instance.parent_path().filename() / instance.stem()).string();
    CompileOptions options;
    options.inputs = {instance.parent_path() / "domain.rddl", instance};
    options.stop_after = Stage::Verify;
    const Compilation compilation = compile(options);
    if (!compilation.program) {
        fmt::print("{:<40} does not compile\n", name);
        ++findings.wrong;
        return;
    }
    const auto begin = std::chrono::steady_clock::now();
    try {
        // As planners and learners take their derivatives.
        const ir::Program program = shorten_aggregations(*compilation.program);
        autodiff::StepChecker checker(program);
        const autodiff::StepCheck result = checker.run(steps);
        const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
        const bool is_right = result.different_values + result.wrong_derivatives == 0;
        fmt::print(
            "{:<40} {:>8} instructions {:>7} values {:>5} derivatives {:>5} not smooth "
            "{:>6.2f} s {}\n",
            name, result.instructions, result.values, result.derivatives, result.not_smooth,
            seconds.count(), is_right ? "" : "WRONG: " + result.first_complaint);
        ++findings.checked;
        findings.wrong += is_right ? 0 : 1;
        findings.derivatives += result.derivatives;
    } catch (const Failure& failure) {
        fmt::print("{:<40} refused: {}\n", name, failure.what());
        ++findings.refused;
    }
}

}  // namespace

int main(int argc, char** argv) {
    const fs::path folder = argc > 1 ? fs::path(argv[1]) : rddl_repository();
    if (folder.empty() || !fs::exists(folder)) {
        fmt::print("no rddlrepository here\n");
        return 77;
    }
    const std::int64_t steps = argc > 2 ? std::atoll(argv[2]) : 10;
    const bool takes_all = argc > 3;
    Findings found;
    for (const fs::path& instance : instances_of(folder, takes_all)) check(instance, steps, found);
    fmt::print("{} checked, {} refused, {} wrong, {} derivatives\n", found.checked, found.refused,
               found.wrong, found.derivatives);
    const bool is_known = argc == 1;
    const bool refuses_others = is_known && found.refused != refused_of_repository;
    if (refuses_others) fmt::print("{} refusals were expected\n", refused_of_repository);
    const bool is_empty = found.checked == 0 || found.derivatives == 0;
    if (is_empty) fmt::print("no derivative was checked\n");
    return found.wrong > 0 || refuses_others || is_empty ? 1 : 0;
}
