// Every file of rddlrepository, formatted.
#include "formatted.hpp"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>

namespace rddlc {
namespace {

namespace fs = std::filesystem;

// What a command writes, without the line break.
std::string output_of(const char* command) {
    std::string text;
    if (FILE* pipe = popen(command, "r")) {
        for (int c = fgetc(pipe); c != EOF && c != '\n'; c = fgetc(pipe))
            text += static_cast<char>(c);
        pclose(pipe);
    }
    return text;
}

fs::path repository() {
    if (const char* folder = std::getenv("RDDL_REPOSITORY")) return folder;
    return output_of(
        "python3 -c 'import rddlrepository; print(rddlrepository.__path__[0])' 2>/dev/null");
}

TEST(FormatRepository, KeepsMeaningAndComments) {
    const fs::path folder = repository();
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
