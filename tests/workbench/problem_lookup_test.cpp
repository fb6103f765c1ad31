#include "problems/problem_lookup.hpp"

#include "problems/python_info.hpp"
#include "support/failure.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>

namespace rddlc::workbench {
namespace {

namespace fs = std::filesystem;

void write(const fs::path& path, std::string_view text) {
    fs::create_directories(path.parent_path());
    std::ofstream(path) << text;
}

class Lookup : public testing::Test {
  protected:
    // A folder of its own for each test: they may run at the same time.
    Lookup()
        : root_(fs::path(testing::TempDir()) /
                (std::string("rddl-lookup-") +
                 testing::UnitTest::GetInstance()->current_test_info()->name())) {
        fs::remove_all(root_);
        write(root_ / "archive/games/Chess/domain.rddl", "");
        write(root_ / "archive/games/Chess/__init__.py",
              "info = {\r\n    'name': 'Chess',\r\n    'description': 'It\\'s a \"game\".',\r\n"
              "    'context': 'arcade', 'tags': [], 'viz': None\r\n}");
        for (const char* instance : {"10", "2", "1", "b"})
            write(root_ / "archive/games/Chess" / ("instance" + std::string(instance) + ".rddl"),
                  "");
        write(root_ / "archive/Lonely/domain.rddl", "");
        write(root_ / "archive/Lonely/__init__.py", "info = {'name': 'Lonely', 'context': ''}");
        write(root_ / "archive/Lonely/instance0.rddl", "");
        for (const char* file : {"domain.rddl", "instance.rddl", "instance2.rddl"})
            write(root_ / "archive/competitions/IPPC2030/Snow/p3" / file, "");
        setenv("RDDL_REPOSITORY", root_.c_str(), 1);
    }
    ~Lookup() override {
        unsetenv("RDDL_REPOSITORY");
        fs::remove_all(root_);
    }

    static std::string failure(const std::string& first, const std::string& second) {
        try {
            find_files(first, second);
        } catch (const Failure& failure) {
            return std::string(failure.what()) + " | " + failure.hint;
        }
        return "found";
    }

    fs::path root_;
};

TEST_F(Lookup, NamesAreThoseOfTheRepository) {
    const auto repository = find_repository();
    ASSERT_TRUE(repository);
    ASSERT_EQ(repository->problems.size(), 3u);
    const RepositoryProblem& chess = repository->problems[0];
    EXPECT_EQ(chess.name, "Chess_arcade");
    EXPECT_EQ(chess.context, "arcade");
    EXPECT_EQ(chess.description, "It's a \"game\".");
    EXPECT_EQ(chess.instances, (std::vector<std::string>{"1", "2", "10", "b"}));
    EXPECT_EQ(repository->problems[1].name, "Lonely");
    EXPECT_EQ(repository->problems[1].context, "standalone");
    EXPECT_EQ(repository->problems[2].name, "Snow_p3_ippc2030") << "without __init__.py";
    EXPECT_EQ(repository->problems[2].context, "ippc2030");
}

TEST_F(Lookup, FindsInstancesByName) {
    const ProblemFiles files = find_files("Chess_arcade", "10");
    EXPECT_EQ(files.domain, root_ / "archive/games/Chess/domain.rddl");
    EXPECT_EQ(files.instance, root_ / "archive/games/Chess/instance10.rddl");
    EXPECT_EQ(files.name, "Chess_arcade 10");
}

TEST_F(Lookup, AnInstanceWithoutNumberIsTheFirst) {
    const fs::path folder = root_ / "archive/competitions/IPPC2030/Snow/p3";
    EXPECT_EQ(find_files("Snow_p3_ippc2030", "1").instance, folder / "instance.rddl");
    EXPECT_EQ(find_files("Snow_p3_ippc2030", "2").instance, folder / "instance2.rddl");
}

TEST_F(Lookup, TheArchiveItselfWillDo) {
    setenv("RDDL_REPOSITORY", (root_ / "archive").c_str(), 1);
    EXPECT_EQ(find_files("Lonely", "0").domain, root_ / "archive/Lonely/domain.rddl");
}

TEST_F(Lookup, TellsWhatIsWrong) {
    EXPECT_NE(failure("Ches_arcade", "1").find("did you mean 'Chess_arcade'?"), std::string::npos);
    EXPECT_EQ(failure("Chess_arcade", "3"),
              "Chess_arcade has no instance '3' | it has 1, 2, 10, b");
    EXPECT_EQ(failure("Chess_arcade", ""), "which instance of Chess_arcade? | it has 1, 2, 10, b");
    EXPECT_NE(failure("Backgammon", "1").find("'rddl list' shows their names"), std::string::npos);
    setenv("RDDL_REPOSITORY", "/no/such/folder", 1);
    EXPECT_NE(failure("Chess_arcade", "1").find("is not a folder"), std::string::npos);
}

TEST_F(Lookup, PathsNeedNoRepository) {
    setenv("RDDL_REPOSITORY", "/no/such/folder", 1);
    const ProblemFiles files = find_files("a/domain.rddl", "b.rddl");
    EXPECT_EQ(files.domain, "a/domain.rddl");
    EXPECT_EQ(files.instance, "b.rddl");
    EXPECT_FALSE(find_files("both.rddl", "").instance);
}

TEST(PythonInfo, ReadsStringsOnly) {
    const auto info = read_python_info(
        "import os\ninfo = {\"a\": 'one' \"two\",\n 'b': None, 'c': 'x,y', 'd' : [1, 2]}");
    EXPECT_EQ(info.at("a"), "onetwo");
    EXPECT_EQ(info.count("b"), 0u);
    EXPECT_EQ(info.at("c"), "x,y");
}

TEST(PythonInfo, SurvivesAnything) {
    EXPECT_TRUE(read_python_info("").empty());
    EXPECT_TRUE(read_python_info("{").empty());
    EXPECT_TRUE(read_python_info("{'a'").empty());
    EXPECT_TRUE(read_python_info("{'a':").empty());
    EXPECT_EQ(read_python_info("{'a': 'unfinished").at("a"), "unfinished");
    EXPECT_EQ(read_python_info("{'a': 'b\\").at("a"), "b\\");
}

TEST_F(Lookup, FoldersHoldADomainAndItsInstances) {
    const fs::path snow = root_ / "archive/competitions/IPPC2030/Snow/p3";
    EXPECT_EQ(find_files(snow.string(), "2").instance, snow / "instance2.rddl");
    EXPECT_EQ(find_files(snow.string() + "/", "1").instance, snow / "instance.rddl");
    EXPECT_EQ(find_files(snow.string(), (snow / "instance2.rddl").string()).instance,
              snow / "instance2.rddl");
    EXPECT_EQ(failure(snow.string(), ""), "which instance of " + snow.string() + "? | it has 1, 2");
    const fs::path lonely = root_ / "archive/Lonely";
    EXPECT_EQ(find_files(lonely.string(), "").domain, lonely / "domain.rddl");
    EXPECT_EQ(find_files(lonely.string(), "").instance, lonely / "instance0.rddl");
    EXPECT_EQ(failure((root_ / "archive").string(), "1"),
              "there is no domain.rddl in '" + (root_ / "archive").string() +
                  "' | name the files: DOMAIN INSTANCE");
    const fs::path bare = root_ / "bare";
    fs::create_directory(bare);
    fs::copy_file(lonely / "domain.rddl", bare / "domain.rddl");
    for (const char* instance : {"", "1"})
        EXPECT_EQ(failure(bare.string(), instance), "there is no instance in '" + bare.string() +
                                                        "' | name the files: DOMAIN INSTANCE");
}

TEST_F(Lookup, NamesMayBeToldByTheirBeginning) {
    EXPECT_NE(failure("Chess", "1").find("| did you mean 'Chess_arcade'?"), std::string::npos);
    EXPECT_NE(failure("snow", "1").find("| did you mean 'Snow_p3_ippc2030'?"), std::string::npos);
}

}  // namespace
}  // namespace rddlc::workbench
