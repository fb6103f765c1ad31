// The behaviour of rddl fmt as users see it.
#include "program.hpp"

#include <sys/stat.h>

#include <cstring>

namespace rddlc::cli {
namespace {

namespace fs = std::filesystem;

constexpr const char* untidy = "domain d { types { a:object; }; } // end\n";
constexpr const char* tidy = "domain d {\n    types {\n        a : object;\n    };\n}  // end\n";

class Fmt : public Program {
  protected:
    Fmt() {
        write_file(folder_ / "untidy.rddl", untidy);
        write_file(folder_ / "tidy.rddl", tidy);
        write_file(folder_ / "wrong.rddl", "domain d {\n");
    }
    std::string text_of(const char* name) const { return read_file(folder_ / name); }
    ino_t file_number(const char* name) const {
        struct stat status {};
        EXPECT_EQ(::stat((folder_ / name).c_str(), &status), 0);
        return status.st_ino;
    }
};

TEST_F(Fmt, ReplacesFilesThatChange) {
    const ino_t before = file_number("tidy.rddl");
    const Outcome outcome = run("fmt untidy.rddl tidy.rddl");
    EXPECT_EQ(outcome.status, 0);
    EXPECT_EQ(outcome.out + outcome.err, "");
    EXPECT_EQ(text_of("untidy.rddl"), tidy);
    EXPECT_EQ(file_number("tidy.rddl"), before) << "a file that is laid out well was replaced";
}

TEST_F(Fmt, KeepsPermissionsAndLinks) {
    fs::permissions(folder_ / "untidy.rddl", fs::perms::owner_read | fs::perms::owner_write);
    fs::create_symlink("untidy.rddl", folder_ / "link.rddl");
    EXPECT_EQ(run("fmt link.rddl").status, 0);
    EXPECT_TRUE(fs::is_symlink(folder_ / "link.rddl"));
    EXPECT_EQ(text_of("untidy.rddl"), tidy);
    EXPECT_EQ(fs::status(folder_ / "untidy.rddl").permissions(),
              fs::perms::owner_read | fs::perms::owner_write);
}

TEST_F(Fmt, ChecksWithoutChange) {
    const Outcome outcome = run("fmt --check untidy.rddl tidy.rddl");
    EXPECT_EQ(outcome.status, 1);
    EXPECT_EQ(outcome.out, "untidy.rddl\n");
    EXPECT_EQ(text_of("untidy.rddl"), untidy);
    EXPECT_EQ(run("fmt --check tidy.rddl").status, 0);
}

TEST_F(Fmt, ShowsDifferencesThatPatchReads) {
    const Outcome outcome = run("fmt --diff untidy.rddl tidy.rddl");
    EXPECT_EQ(outcome.status, 0);
    EXPECT_TRUE(outcome.out.starts_with("--- untidy.rddl\n+++ untidy.rddl\n@@ -1 +1,5 @@\n-domain"))
        << outcome.out;
    EXPECT_EQ(text_of("untidy.rddl"), untidy);
    EXPECT_EQ(run("fmt --diff --check untidy.rddl").status, 1);
}

TEST_F(Fmt, ShowsAMissingLineBreakAsADifference) {
    write_file(folder_ / "open.rddl", std::string_view(tidy).substr(0, std::strlen(tidy) - 1));
    const Outcome outcome = run("fmt --diff open.rddl");
    EXPECT_TRUE(outcome.out.ends_with("-}  // end\n\\ No newline at end of file\n+}  // end\n"))
        << outcome.out;
    EXPECT_TRUE(run("fmt --diff - <open.rddl").out.starts_with("--- -\n+++ -\n@@ "));
}

TEST_F(Fmt, SaysWhatShowsDifferences) {
    const Outcome outcome = run("fmt --diff untidy.rddl", "PATH=/nowhere");
    EXPECT_EQ(outcome.status, 1);
    EXPECT_EQ(outcome.err,
              "rddl: error: cannot run 'diff': No such file or directory\n"
              "  install it (the package diffutils)\n");
}

TEST_F(Fmt, WritesElsewhere) {
    EXPECT_EQ(run("fmt --stdout untidy.rddl").out, tidy);
    EXPECT_EQ(run("fmt - <untidy.rddl").out, tidy);
    EXPECT_EQ(run("fmt untidy.rddl -o other.rddl").status, 0);
    EXPECT_EQ(text_of("other.rddl"), tidy);
    EXPECT_EQ(text_of("untidy.rddl"), untidy);
}

TEST_F(Fmt, ReportsWhatIsNotRddlAndGoesOn) {
    const Outcome outcome = run("fmt wrong.rddl missing.rddl untidy.rddl");
    EXPECT_EQ(outcome.status, 1);
    EXPECT_NE(outcome.err.find("wrong.rddl:2:1: error"), std::string::npos) << outcome.err;
    EXPECT_NE(outcome.err.find("cannot read 'missing.rddl'"), std::string::npos) << outcome.err;
    EXPECT_EQ(text_of("untidy.rddl"), tidy);
    EXPECT_EQ(text_of("wrong.rddl"), "domain d {\n");
}

TEST_F(Fmt, RefusesOptionsThatContradict) {
    EXPECT_EQ(run("fmt --check --stdout tidy.rddl").status, 2);
    EXPECT_EQ(run("fmt untidy.rddl tidy.rddl -o other.rddl").status, 2);
    EXPECT_EQ(run("fmt").status, 2);
}

// docs/commands.md promises it: a file is replaced as a whole, not written through.
TEST_F(Program, FollowsSymbolicLinksAndLeavesHardOnes) {
    const std::string text = "domain   d { pvariables { }; cpfs { }; reward = 0; }\n";
    write_file(folder_ / "file.rddl", text);
    std::filesystem::create_hard_link(folder_ / "file.rddl", folder_ / "hard.rddl");
    std::filesystem::create_symlink("file.rddl", folder_ / "symbolic.rddl");
    EXPECT_EQ(run("fmt symbolic.rddl").status, 0);
    EXPECT_TRUE(std::filesystem::is_symlink(folder_ / "symbolic.rddl"));
    EXPECT_NE(read_file(folder_ / "file.rddl"), text);
    EXPECT_EQ(read_file(folder_ / "hard.rddl"), text);
}

}  // namespace
}  // namespace rddlc::cli
