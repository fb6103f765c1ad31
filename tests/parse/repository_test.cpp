// Every problem of rddlrepository: parsed without a diagnostic, printed, and parsed again.
#include "ast/equal.hpp"
#include "ast/print.hpp"
#include "parsed.hpp"
#include "rddl_repository.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>

namespace rddlc {
namespace {

namespace fs = std::filesystem;

TEST(Repository, ParsesPrintsAndParsesAgain) {
    const fs::path folder = rddl_repository();
    if (folder.empty() || !fs::exists(folder)) GTEST_SKIP() << "no rddlrepository here";
    std::size_t files = 0;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder)) {
        if (entry.path().extension() != ".rddl") continue;
        ++files;
        Sources sources;
        Diagnostics diagnostics;
        const std::vector<FileId> file = {sources.load(entry.path()).value()};
        const auto begin = std::chrono::steady_clock::now();
        const ast::Program program = parse(sources, file, diagnostics);
        const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
        EXPECT_TRUE(diagnostics.all().empty()) << render(diagnostics, sources, {});
        EXPECT_LT(seconds.count(), 10.0) << entry.path();
        const Parsed again = parse_text(ast::print(program));
        EXPECT_FALSE(again.diagnostics.has_errors()) << entry.path() << again.report();
        EXPECT_TRUE(ast::equal(program, again.program)) << entry.path();
    }
    EXPECT_GT(files, 0u) << folder;
}

}  // namespace
}  // namespace rddlc
