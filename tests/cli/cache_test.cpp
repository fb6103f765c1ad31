// The cache between runs: things are compiled once, compiled again if damaged, and not shared with
// other users.
#include "program.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <vector>

namespace rddlc::cli {
namespace {

std::vector<std::filesystem::path> shared_objects(const std::filesystem::path& cache) {
    std::vector<std::filesystem::path> found;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(cache))
        if (entry.path().extension() == ".so") found.push_back(entry.path());
    return found;
}
// Folders of what is compiled once for all problems.
std::vector<std::filesystem::path> prepared_folders(const std::filesystem::path& cache) {
    std::vector<std::filesystem::path> found;
    for (const auto& entry : std::filesystem::directory_iterator(cache / "rddlc"))
        if (entry.path().extension() == ".runtime") found.push_back(entry.path());
    return found;
}
std::ptrdiff_t file_count(const std::filesystem::path& folder) {
    const std::filesystem::directory_iterator files(folder);
    return std::distance(begin(files), end(files));
}
std::ptrdiff_t occurrences(std::string_view part, const std::string& text) {
    std::ptrdiff_t count = 0;
    for (auto at = text.find(part); at != text.npos; at = text.find(part, at + 1)) ++count;
    return count;
}

class Cache : public Program {
  protected:
    Cache() { use_own_cache(); }
};

TEST_F(Cache, CompilesOnceAndRepairsTheCache) {
    const std::string run_it = "run domain.rddl instance.rddl --engine compiled --quiet";
    ASSERT_EQ(run(run_it).status, 0);
    const auto kept = shared_objects(cache());
    ASSERT_EQ(kept.size(), 1u);
    EXPECT_EQ(prepared_folders(cache()).size(), 1u);
    EXPECT_EQ(file_count(cache() / "rddlc"), 2) << "nothing else is left behind";
    const auto written = std::filesystem::last_write_time(kept[0]);

    // Kept: works without a compiler of this name being run on the text again.
    ASSERT_EQ(run(run_it).status, 0);
    EXPECT_EQ(std::filesystem::last_write_time(kept[0]), written);

    // Cut off, as by a full disk.
    std::filesystem::resize_file(kept[0], std::filesystem::file_size(kept[0]) / 2);
    EXPECT_EQ(run(run_it).status, 0);
    write_file(kept[0], "");
    EXPECT_EQ(run(run_it).status, 0);
    EXPECT_GT(std::filesystem::file_size(kept[0]), 1000u);

    // Another text is another entry.
    EXPECT_EQ(run("run domain.rddl instance.rddl --engine compiled --quiet --no-cache").status, 0);
    EXPECT_EQ(shared_objects(cache()).size(), 1u);
    std::string domain = tanks_domain;
    domain.replace(domain.find("2.0 else"), 3, "3.0");
    write_file(folder_ / "domain.rddl", domain);
    EXPECT_EQ(run(run_it).status, 0);
    EXPECT_EQ(shared_objects(cache()).size(), 2u);
}

TEST_F(Cache, PreparesForAllProblemsOnce) {
    write_file(folder_ / "log.sh", "echo \"$@\" >>log; exec c++ \"$@\"");
    const std::string run_it = "run domain.rddl instance.rddl --engine compiled --quiet --no-cache";
    const std::string compiler = "CXX='sh log.sh'";
    ASSERT_EQ(run(run_it, compiler).status, 0);
    ASSERT_EQ(run(run_it, compiler).status, 0);
    const std::string log = read_file(folder_ / "log");
    EXPECT_EQ(occurrences("batches.cpp", log), 1) << log;
    EXPECT_EQ(occurrences("c++-header", log), 1) << log;
    EXPECT_EQ(occurrences("-include", log), 2) << log;
}

TEST_F(Cache, KeepsWhatIsPreparedForTheLatestToolchains) {
    for (const char* name : {"a", "b", "c", "d"})
        write_file(cache() / "rddlc" / (std::string(name) + ".runtime") / "batches.o", "");
    std::filesystem::permissions(cache() / "rddlc", std::filesystem::perms::owner_all);
    ASSERT_EQ(run("run domain.rddl instance.rddl --engine compiled --quiet").status, 0);
    EXPECT_EQ(prepared_folders(cache()).size(), 4u);
    EXPECT_FALSE(std::filesystem::exists(cache() / "rddlc" / "a.runtime"));
}

TEST_F(Cache, CompilesWithoutAPrecompiledHeader) {
    const std::string run_it = "run domain.rddl instance.rddl --engine compiled --quiet --no-cache";
    // A compiler that cannot precompile headers is not asked again.
    write_file(folder_ / "log.sh",
               "echo \"$@\" >>log; case \"$*\" in *c++-header*) exit 1; esac; exec c++ \"$@\"");
    EXPECT_EQ(run(run_it, "CXX='sh log.sh'").status, 0);
    EXPECT_EQ(run(run_it, "CXX='sh log.sh'").status, 0);
    EXPECT_EQ(occurrences("c++-header", read_file(folder_ / "log")), 1);
}

TEST_F(Cache, RepairsWhatIsLinked) {
    const std::string run_it = "run domain.rddl instance.rddl --engine compiled --quiet --no-cache";
    ASSERT_EQ(run(run_it).status, 0);
    const auto object = prepared_folders(cache()).at(0) / "batches.o";
    const std::string intact = read_file(object);
    write_file(object, "");
    const Outcome outcome = run(run_it);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(read_file(object).size(), intact.size());
}

TEST_F(Cache, RemovesWhatKilledCompilationsLeave) {
    const auto left = cache() / "rddlc" / "building-1", used = cache() / "rddlc" / "building-2";
    write_file(left / "runtime" / "simulator.hpp.gch", "large");
    write_file(used / "simulator.cpp", "of a process that is alive");
    std::filesystem::permissions(cache() / "rddlc", std::filesystem::perms::owner_all);
    const int lock = open(used.c_str(), O_RDONLY | O_DIRECTORY);
    ASSERT_EQ(flock(lock, LOCK_EX), 0);
    EXPECT_EQ(run("run domain.rddl instance.rddl --engine compiled --quiet").status, 0);
    EXPECT_FALSE(std::filesystem::exists(left));
    EXPECT_TRUE(std::filesystem::exists(used / "simulator.cpp"));
    close(lock);
}

TEST_F(Cache, LoadsNothingThatOthersMayHaveWritten) {
    namespace fs = std::filesystem;
    const std::string run_it = "run domain.rddl instance.rddl --engine compiled --quiet";
    const fs::path folder = cache() / "rddlc";
    ASSERT_EQ(run(run_it).status, 0);
    EXPECT_EQ(fs::status(folder).permissions(), fs::perms::owner_all);
    for (const fs::perms others : {fs::perms::group_write, fs::perms::others_write}) {
        fs::permissions(folder, fs::perms::owner_all | others);
        const Outcome outcome = run(run_it);
        EXPECT_EQ(outcome.status, 1);
        EXPECT_NE(outcome.err.find("others may write to the folder"), std::string::npos)
            << outcome.err;
        EXPECT_NE(outcome.err.find("chmod go-w"), std::string::npos) << outcome.err;
        EXPECT_EQ(run("run domain.rddl instance.rddl --engine interpreter --quiet").status, 0);
    }
    fs::permissions(folder, fs::perms::owner_all);

    // An object from a time when other users could write there is compiled again.
    const fs::path object = shared_objects(cache()).at(0);
    fs::permissions(object, fs::perms::others_write, fs::perm_options::add);
    EXPECT_EQ(run(run_it).status, 0);
    EXPECT_EQ(fs::status(object).permissions() & fs::perms::others_write, fs::perms::none);

    if (geteuid() != 0) GTEST_SKIP() << "only root can give a folder away";
    ASSERT_EQ(chown(folder.c_str(), 65534, 65534), 0);
    const Outcome outcome = run(run_it);
    EXPECT_EQ(outcome.status, 1);
    EXPECT_NE(outcome.err.find("belongs to another user"), std::string::npos) << outcome.err;
}

TEST_F(Cache, FillsTheCacheInSeveralProcessesAtOnce) {
    const std::string both = fmt::format(
        "({0}) & first=$!; ({0}) & second=$!; wait $first && wait $second",
        command("run domain.rddl instance.rddl --engine compiled --quiet") + " >/dev/null");
    EXPECT_EQ(std::system(both.c_str()), 0);
    EXPECT_EQ(prepared_folders(cache()).size(), 1u);
    EXPECT_EQ(shared_objects(cache()).size(), 1u);
    EXPECT_EQ(file_count(cache() / "rddlc"), 2) << "nothing else is left behind";
}

TEST_F(Program, TellsOfWrongEnvironmentVariables) {
    const auto told = [&](const std::string& environment) {
        const Outcome outcome =
            run("run domain.rddl instance.rddl --engine compiled --quiet", environment);
        EXPECT_EQ(outcome.status, environment.ends_with("= ") ? 0 : 1) << environment;
        return outcome.err;
    };
    EXPECT_EQ(
        told("RDDL_INSTRUCTION_SET=foo "),
        "rddl: error: RDDL_INSTRUCTION_SET is 'foo', which is not one of sse2, avx2 and avx512\n");
    EXPECT_EQ(told("RDDLC_INCLUDE=/nonexistent "),
              "rddl: error: RDDLC_INCLUDE is '/nonexistent', which holds no rddl/simulator.hpp\n");
    EXPECT_EQ(told("RDDL_INSTRUCTION_SET= "), "");
}

TEST_F(Program, TellsOfACompilerThatMakesNothing) {
    use_own_cache();
    const Outcome outcome =
        run("run domain.rddl instance.rddl --engine compiled --quiet", "CXX=/bin/true ");
    EXPECT_EQ(outcome.status, 1);
    EXPECT_TRUE(
        outcome.err.starts_with("error: the C++ compiler '/bin/true' ends with status 0, "
                                "but made no output [E0910]\n"))
        << outcome.err;
}

}  // namespace
}  // namespace rddlc::cli
