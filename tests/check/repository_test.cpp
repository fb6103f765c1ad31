// Every instance of rddlrepository: accepted, and fast.
#include "../parse/rddl_repository.hpp"
#include "checking.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>

namespace rddlc::testing {
namespace {

namespace fs = std::filesystem;

void expect_accepted(const fs::path& domain, const fs::path& instance) {
    Sources sources;
    Diagnostics diagnostics;
    const std::vector<FileId> files{sources.load(domain).value(), sources.load(instance).value()};
    const ast::Program program = parse(sources, files, diagnostics);
    ASSERT_FALSE(diagnostics.has_errors()) << render(diagnostics, sources, {});
    const auto begin = std::chrono::steady_clock::now();
    const std::optional<model::Model> model = check(program, sources, diagnostics);
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
    EXPECT_TRUE(model) << render(diagnostics, sources, {});
    EXPECT_LT(seconds.count(), 5.0) << instance;
}

TEST(Repository, IsAccepted) {
    const fs::path folder = rddl_repository();
    if (folder.empty() || !fs::exists(folder)) GTEST_SKIP() << "no rddlrepository here";
    std::size_t instances = 0;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder)) {
        const fs::path domain = entry.path().parent_path() / "domain.rddl";
        const bool instance = entry.path().filename().string().starts_with("instance") &&
                              entry.path().extension() == ".rddl";
        if (!instance || !fs::exists(domain)) continue;
        ++instances;
        expect_accepted(domain, entry.path());
    }
    EXPECT_GT(instances, 0u) << folder;
}

}  // namespace
}  // namespace rddlc::testing
