// Every file of rddlrepository, formatted.
#include "../parse/rddl_repository.hpp"
#include "formatted.hpp"

#include <filesystem>
#include <fstream>
#include <iterator>

namespace rddlc {
namespace {

namespace fs = std::filesystem;

TEST(FormatRepository, KeepsMeaningAndComments) {
    const fs::path folder = rddl_repository();
    if (folder.empty() || !fs::exists(folder))
        GTEST_SKIP() << "needs rddlrepository: pip install rddlrepository, or set RDDL_REPOSITORY";
    std::size_t files = 0;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder)) {
        if (entry.path().extension() != ".rddl") continue;
        ++files;
        SCOPED_TRACE(entry.path().string());
        std::ifstream stream(entry.path(), std::ios::binary);
        expect_sound({std::istreambuf_iterator<char>(stream), {}});
    }
    EXPECT_GT(files, 0u) << folder;
}

}  // namespace
}  // namespace rddlc
