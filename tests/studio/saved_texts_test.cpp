// Texts of the page that are written into files.
#include "studio/edited_problem.hpp"
#include "support/failure.hpp"
#include "support/files.hpp"
#include "test_folder.hpp"
#include "texts.hpp"

#include <gtest/gtest.h>

#include <filesystem>

namespace rddlc::studio {
namespace {

TEST(SavedTextsTest, FilesAreWrittenOnlyWhereNothingIsLost) {
    const TestFolder folder;
    workbench::ProblemFiles files;
    files.domain = folder.write("domain.rddl", tanks_domain);
    files.instance = folder.write("instance.rddl", tanks_instance);
    const OpenedProblem opened = open_problem(files);
    const Texts read{opened.domain, opened.instance};
    Texts known = read;
    save_texts(opened, {"new", tanks_instance}, known, false);
    EXPECT_EQ(read_file(files.domain), "new");
    EXPECT_EQ(known.domain, "new");
    known = read;
    EXPECT_THROW(save_texts(opened, {"newer", tanks_instance}, known, false), Failure);
    EXPECT_EQ(read_file(files.domain), "new");
    save_texts(opened, {"newer", tanks_instance}, known, true);
    EXPECT_EQ(read_file(files.domain), "newer");
    Texts none;
    EXPECT_THROW(save_texts(tanks(), {"", ""}, none, true), Failure);  // a copy
    // A file that is gone is not written without a word.
    std::filesystem::remove(*files.instance);
    EXPECT_THROW(save_texts(opened, {"newest", "i"}, known, false), Failure);
    EXPECT_EQ(read_file(files.domain), "newer");
    // Where the second file cannot be written, the first one is known as it was written.
    std::filesystem::create_directories(*files.instance / "in_the_way");
    EXPECT_THROW(save_texts(opened, {"newest", "i"}, known, true), Failure);
    EXPECT_EQ(read_file(files.domain), "newest");
    EXPECT_EQ(known.domain, "newest");
    EXPECT_EQ(known.instance, tanks_instance);
}

}  // namespace
}  // namespace rddlc::studio
