#include "run_rddlc.hpp"

#include <sys/stat.h>
#include <unistd.h>

namespace rddlc::testing {
namespace {

namespace fs = std::filesystem;

class Output : public RddlcTest {
  protected:
    Result compile_to(const std::string& output) const {
        return rddlc({"domain.rddl", "instance.rddl", "-o", output});
    }
    static bool mentions(const Result& result, const std::string& part) {
        return result.output.find(part) != std::string::npos;
    }
};

TEST_F(Output, IsWhatItsNameSays) {
    for (const char* name : {"sim.cpp", "sim.cc", "sim.hpp", "sim.h"}) {
        EXPECT_EQ(compile_to(name).status, 0) << name;
        EXPECT_NE(read(name).find("struct Simulator"), std::string::npos) << name;
    }
    EXPECT_NE(read("sim.hpp").find("#pragma once"), std::string::npos);
    EXPECT_EQ(read("sim.cpp").find("#pragma once"), std::string::npos);
    const Result result = compile_to("sim.txt");
    EXPECT_EQ(result.status, 1);
    EXPECT_TRUE(mentions(result, "[E0903]")) << result.output;
}

TEST_F(Output, LeavesNothingElseBehind) {
    EXPECT_EQ(compile_to("sim.cpp").status, 0);
    EXPECT_EQ(files(), (std::vector<std::string>{"domain.rddl", "instance.rddl", "sim.cpp"}));
}

TEST_F(Output, StaysAsItWasAfterAnError) {
    write("sim.cpp", "precious");
    write("domain.rddl", "domain");
    EXPECT_EQ(compile_to("sim.cpp").status, 1);
    EXPECT_EQ(read("sim.cpp"), "precious");
    EXPECT_EQ(files().size(), 3u);
}

TEST_F(Output, CannotGoWhereThereIsNoFolder) {
    const Result result = compile_to("nowhere/sim.cpp");
    EXPECT_EQ(result.status, 1);
    EXPECT_TRUE(mentions(result, "cannot write 'nowhere/sim.cpp'")) << result.output;
    EXPECT_TRUE(mentions(result, "[E0902]")) << result.output;
}

// The C++ compiler, which would take long, is not asked.
TEST_F(Output, CannotGoWhereNoFileCanBeMade) {
    const Result result = rddlc({"domain.rddl", "instance.rddl", "-o", "/proc/sim.so", "-v"});
    EXPECT_EQ(result.status, 1);
    EXPECT_TRUE(mentions(result, "cannot write '/proc/sim.so'")) << result.output;
    EXPECT_TRUE(mentions(result, "hint: no file can be made in that folder")) << result.output;
    EXPECT_TRUE(mentions(result, "read ")) << result.output;
    EXPECT_FALSE(mentions(result, "parse ")) << result.output;
}

// The name of a folder does not also fail to show the kind of output.
TEST_F(Output, CannotBeAFolder) {
    fs::create_directory("sim.cpp");
    fs::create_directory("sims");
    for (const char* folder : {"sim.cpp", "sim.cpp/", "sims", "sims/", ".", "new.cpp/"}) {
        const Result result = compile_to(folder);
        EXPECT_TRUE(mentions(result, "Is a directory [E0902]")) << result.output;
        EXPECT_TRUE(mentions(result, "hint: name a file in that folder")) << result.output;
        EXPECT_TRUE(mentions(result, "\n1 error\n")) << result.output;
    }
    EXPECT_TRUE(
        mentions(compile_to("nowhere/sim"), "No such file or directory [E0902]\n1 error\n"));
}

TEST_F(Output, MayBeADevice) {
    EXPECT_EQ(rddlc({"domain.rddl", "instance.rddl", "-o", "null.cpp"}).status, 0);
    fs::remove("null.cpp");
    fs::create_symlink("/dev/full", "full.cpp");
    const Result result = compile_to("full.cpp");
    EXPECT_EQ(result.status, 1);
    EXPECT_TRUE(mentions(result, "No space left on device [E0902]")) << result.output;
}

TEST_F(Output, NeverOverwritesAnInput) {
    write("both.cpp", read("domain.rddl") + read("instance.rddl"));
    const std::string before = read("both.cpp");
    const Result result = rddlc({"both.cpp", "-o", "./both.cpp"});
    EXPECT_TRUE(mentions(result, "[E0906]")) << result.output;
    EXPECT_EQ(read("both.cpp"), before);
}

TEST_F(Output, ComesWithADependencyFile) {
    EXPECT_EQ(rddlc({"domain.rddl", "instance.rddl", "-o", "sim.cpp", "-MD"}).status, 0);
    EXPECT_EQ(read("sim.cpp.d"), "sim.cpp: \\\n  domain.rddl \\\n  instance.rddl\n");
    fs::copy_file("domain.rddl", "a $b#.rddl");
    EXPECT_EQ(
        rddlc({"a $b#.rddl", "instance.rddl", "-o", "sim.cpp", "-MD", "-MF", "deps.d"}).status, 0);
    EXPECT_EQ(read("deps.d"), "sim.cpp: \\\n  a\\ $$b\\#.rddl \\\n  instance.rddl\n");
}

TEST_F(Output, DependsOnTheHeadersOfExternalFunctions) {
    fs::create_directory("lib");
    write("lib/functions.hpp", "#pragma once\n#include <cmath>\n  #  include \"tools.hpp\"\n");
    write("lib/tools.hpp", "#include \"functions.hpp\"\n#include \"missing.hpp\"\n");
    fs::create_directory("out");
    EXPECT_EQ(rddlc({"domain.rddl", "instance.rddl", "--extern", "lib/functions.hpp", "-o",
                     "out/sim.cpp", "-MD"})
                  .status,
              0);
    EXPECT_EQ(read("out/sim.cpp.d"),
              "out/sim.cpp: \\\n  domain.rddl \\\n  instance.rddl \\\n  lib/functions.hpp \\\n"
              "  lib/tools.hpp\n");
    EXPECT_EQ(read("out/sim.cpp").find("functions.hpp"), std::string::npos) << "nothing calls it";
    const Result result = rddlc({"domain.rddl", "instance.rddl", "--extern", "lib/functions.hpp",
                                 "-o", "lib/functions.hpp"});
    EXPECT_TRUE(mentions(result, "[E0906]")) << result.output;
}

TEST_F(Output, FindsTheHeadersOfExternalFunctionsFromItsOwnFolder) {
    std::string domain = read("domain.rddl");
    domain.replace(domain.find("reward ="), 8, "reward = $worth[]() +");
    write("domain.rddl", domain);
    fs::create_directory("lib");
    write("lib/functions.hpp", "namespace rddl_extern { inline double worth() { return 1; } }");
    fs::create_directory("out");
    for (const std::string name : {"out/sim.cpp", "out/sim.hpp", "out/sim.so"}) {
        const Result result =
            rddlc({"domain.rddl", "instance.rddl", "--extern", "lib/functions.hpp", "-o", name});
        EXPECT_EQ(result.status, 0) << result.output;
    }
    EXPECT_NE(read("out/sim.hpp").find("#include \"../lib/functions.hpp\"\n"), std::string::npos);
}

TEST_F(Output, MayBeASharedObjectWhateverItIsCalled) {
    const std::string name = "; touch hacked; $(touch hacked) '\".so";
    const Result result = compile_to(name);
    EXPECT_EQ(result.status, 0) << result.output;
    EXPECT_TRUE(fs::exists(name));
    EXPECT_EQ(files().size(), 3u) << "no shell reads the name";
}

TEST_F(Output, NeedsACompilerOnlyAsASharedObject) {
    EXPECT_EQ(
        rddlc_with({"CXX=no-such-compiler"}, {"domain.rddl", "instance.rddl", "-o", "sim.cpp"})
            .status,
        0);
    const Result result =
        rddlc_with({"CXX=no-such-compiler"}, {"domain.rddl", "instance.rddl", "-o", "sim.so"});
    EXPECT_EQ(result.status, 1);
    EXPECT_TRUE(mentions(result, "cannot run the C++ compiler 'no-such-compiler'"));
    EXPECT_TRUE(mentions(result, "[E0905]")) << result.output;
    EXPECT_FALSE(fs::exists("sim.so"));
}

TEST_F(Output, ThatTheCompilerRefusesIsAnInternalError) {
    write("compiler.sh",
          "case \"$*\" in *headers.cpp*) exit 0; esac\n"
          "echo 'simulator.cpp:3:4: error: nonsense'; exit 1\n");
    const Result result =
        rddlc_with({"CXX=sh compiler.sh"}, {"domain.rddl", "instance.rddl", "-o", "sim.so"});
    EXPECT_EQ(result.status, 70);
    EXPECT_TRUE(mentions(result, "please report it")) << result.output;
    EXPECT_EQ(files().size(), 3u);
}

// A compiler that writes down what it is asked, and makes files that are not empty.
class RecordedCompiler : public Output {
  protected:
    RecordedCompiler() {
        write("compiler.sh",
              "echo \"$*\" >> asked\n"
              "while test $# -gt 1; do test $1 != -o || echo made > \"$2\"; shift; done\n");
    }
    // The commands that made the shared object.
    std::string asked(const std::string& cache, const std::vector<std::string>& options = {}) {
        std::vector<std::string> arguments = {"domain.rddl", "instance.rddl", "-o", "sim.so"};
        arguments.insert(arguments.end(), options.begin(), options.end());
        fs::remove("asked");
        const Result result =
            rddlc_with({"CXX=sh compiler.sh", "XDG_CACHE_HOME=" + cache}, arguments);
        EXPECT_EQ(result.status, 0) << result.output;
        return read("asked");
    }
    static bool holds(const std::string& text, const std::string& part) {
        return text.find(part) != std::string::npos;
    }
};

TEST_F(RecordedCompiler, CompilesCommonCodeOnce) {
    const std::string cache = fs::absolute("cache");
    EXPECT_TRUE(holds(asked(cache), "/rddl/batches.cpp"));
    const std::string again = asked(cache);
    EXPECT_FALSE(holds(again, "/rddl/batches.cpp")) << again;
    EXPECT_TRUE(holds(again, "-DRDDL_LINKS_BATCHES")) << again;
    EXPECT_TRUE(holds(again, "/batches.o")) << again;
    // It holds packs of another size.
    EXPECT_FALSE(holds(asked(cache, {"--lanes=8"}), "-DRDDL_LINKS_BATCHES"));
}

TEST_F(RecordedCompiler, CompilesEverythingWithoutACache) {
    write("cache", "no folder");
    const std::string commands = asked(fs::absolute("cache"));
    EXPECT_FALSE(holds(commands, "-DRDDL_LINKS_BATCHES")) << commands;
    EXPECT_TRUE(holds(commands, "-shared")) << commands;
}

#ifdef __x86_64__
TEST_F(RecordedCompiler, CompilesForEveryProcessorIfAskedTo) {
    const std::string cache = fs::absolute("cache");
    EXPECT_FALSE(holds(asked(cache), "rddl_simulator_sse2"));
    const std::string commands = asked(cache, {"--portable"});
    for (const char* part : {"rddl_simulator_sse2", "rddl_simulator_avx2", "rddl_simulator_avx512"})
        EXPECT_TRUE(holds(commands, part)) << part;
}
#endif

TEST_F(Output, NeedsInputsThatCanBeRead) {
    const Result missing = rddlc({"domain.rddl", "none.rddl", "-o", "sim.cpp"});
    EXPECT_EQ(missing.status, 1);
    EXPECT_TRUE(mentions(missing, "cannot read 'none.rddl': No such file or directory [E0901]"))
        << missing.output;
    fs::create_directory("folder");
    EXPECT_TRUE(mentions(rddlc({"folder", "instance.rddl"}), "Is a directory [E0901]"));
    fs::copy_file("domain.rddl", "folder/domain.rddl");
    EXPECT_TRUE(
        mentions(rddlc({"folder"}), "hint: name the files in it, such as folder/domain.rddl"));
    EXPECT_TRUE(mentions(rddlc({"folder/domian.rddl", "instance.rddl"}),
                         "hint: did you mean 'folder/domain.rddl'?"));
    if (::geteuid() != 0) {
        fs::permissions("domain.rddl", fs::perms::none);
        EXPECT_TRUE(mentions(compile_to("sim.cpp"), "Permission denied [E0901]"));
    }
}

}  // namespace
}  // namespace rddlc::testing
