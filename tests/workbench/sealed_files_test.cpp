#include "cache/sealed_files.hpp"

#include "support/files.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <string>
#include <vector>

namespace rddlc::workbench {
namespace {

namespace fs = std::filesystem;

void put(const fs::path& file, const std::string& content) {
    std::ofstream(file, std::ios::binary) << content;
}

// Every way in which a file may be damaged.
std::vector<std::string> damaged(const std::string& intact) {
    std::string changed = intact, longer = intact;
    changed[intact.size() / 2] = static_cast<char>(changed[intact.size() / 2] ^ 1);
    longer += '\0';
    return {"", intact.substr(0, intact.size() / 2), changed, longer};
}

class SealedFiles : public testing::Test {
  protected:
    SealedFiles() { fs::create_directories(folder_); }
    ~SealedFiles() override { fs::remove_all(folder_); }

    fs::path folder_ = fs::path(testing::TempDir()) / fmt::format("rddl-sealed-{}", getpid());
};

TEST_F(SealedFiles, TellADamagedObject) {
    const fs::path object = folder_ / "x.so";
    EXPECT_FALSE(is_sealed(object));
    put(object, std::string(1000, 'x'));
    EXPECT_FALSE(is_sealed(object));
    seal(object);
    EXPECT_TRUE(is_sealed(object));
    for (const std::string& content : damaged(read_file(object))) {
        put(object, content);
        EXPECT_FALSE(is_sealed(object)) << content.size();
    }
}

TEST_F(SealedFiles, TellADamagedFolder) {
    const fs::path first = folder_ / "batches.o", second = folder_ / "simulator.hpp";
    EXPECT_FALSE(is_sealed_folder(folder_ / "none"));
    put(first, std::string(1003, 'x'));
    put(second, "#include <rddl/simulator.hpp>\n");
    EXPECT_FALSE(is_sealed_folder(folder_));
    seal_folder(folder_);
    EXPECT_TRUE(is_sealed_folder(folder_));
    for (const fs::path& file : {first, second, folder_ / "sealed"}) {
        const std::string intact = read_file(file);
        for (const std::string& content : damaged(intact)) {
            put(file, content);
            EXPECT_FALSE(is_sealed_folder(folder_)) << file << content.size();
        }
        fs::remove(file);
        EXPECT_FALSE(is_sealed_folder(folder_));
        put(file, intact);
        EXPECT_TRUE(is_sealed_folder(folder_));
    }
    put(folder_ / "more.o", "");
    EXPECT_FALSE(is_sealed_folder(folder_));
}

TEST_F(SealedFiles, MayNotBeWrittenByOthers) {
    const fs::path object = folder_ / "x.so";
    put(object, "object");
    seal(object);
    fs::permissions(object, fs::perms::others_write, fs::perm_options::add);
    EXPECT_FALSE(is_sealed(object));
    fs::remove(object);
    put(folder_ / "other", "object");
    seal(folder_ / "other");
    fs::create_symlink("other", object);
    EXPECT_FALSE(is_sealed(object));
}

}  // namespace
}  // namespace rddlc::workbench
