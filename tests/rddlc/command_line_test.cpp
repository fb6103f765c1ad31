#include "run_rddlc.hpp"

namespace rddlc::testing {
namespace {

using CommandLine = RddlcTest;

TEST_F(CommandLine, ShowsVersionAndHelp) {
    EXPECT_EQ(rddlc({"--version"}).output.substr(0, 6), "rddlc ");
    const Result help = rddlc({"--help"});
    EXPECT_EQ(help.status, 0);
    for (const char* option :
         {"--print", "--stop-after", "--check", "--explain", "-MD", "-Werror",
          "--diagnostics-format", "--color", "--std", "--stats", "--without", "-o"}) {
        EXPECT_NE(help.output.find(option), std::string::npos) << option;
    }
    EXPECT_EQ(help.output.find("--MD"), std::string::npos) << "spelled as compilers do";
}

TEST_F(CommandLine, TakesOptionsBeforeFiles) {
    EXPECT_EQ(rddlc({"-Werror", "--print=ir", "-w", "domain.rddl", "instance.rddl"}).status, 0);
    EXPECT_EQ(rddlc({"-MF", "deps.d", "-o", "sim.cpp", "domain.rddl", "instance.rddl"}).status, 0);
    EXPECT_EQ(files().size(), 4u);
}

TEST_F(CommandLine, RefusesWhatItDoesNotKnow) {
    const std::vector<std::vector<std::string>> wrong = {
        {},
        {"--nonsense"},
        {"domain.rddl", "instance.rddl", "policy.rddl", "fourth.rddl"},
        {"domain.rddl", "instance.rddl", "--print=nothing"},
        {"domain.rddl", "instance.rddl", "--stop-after=never"},
        {"domain.rddl", "instance.rddl", "--diagnostics-format=xml"},
        {"domain.rddl", "instance.rddl", "--color=blue"},
        {"domain.rddl", "instance.rddl", "--std=c++20"},
        {"domain.rddl", "instance.rddl", "-Wno-W9999"},
        {"domain.rddl", "instance.rddl", "-Wno-E0101"},
        {"domain.rddl", "instance.rddl", "-Wall"},
        {"domain.rddl", "instance.rddl", "-MD"},
        {"domain.rddl", "instance.rddl", "--without=everything"},
        {"--passes", "extra"},
        {"--explain", "E9999"},
        {"--explain", "nonsense"},
        {"--explain"},
        {"domain.rddl", "instance.rddl", "--memory-limit=-1"},
        {"domain.rddl", "instance.rddl", "-w=maybe"},
    };
    for (const auto& arguments : wrong) {
        const Result result = rddlc(arguments);
        EXPECT_EQ(result.status, 2) << result.output;
        EXPECT_EQ(result.output.substr(0, 13), "rddlc: error:") << result.output;
        EXPECT_NE(result.output.find("--help"), std::string::npos);
    }
}

TEST_F(CommandLine, NamesTheEntry) {
    const std::vector<std::string> problem = {"domain.rddl", "instance.rddl"};
    const auto with = [&](std::vector<std::string> more) {
        more.insert(more.begin(), problem.begin(), problem.end());
        return rddlc(more);
    };
    EXPECT_EQ(with({"--entry=narrow", "--output=sim.cpp", "--declare", "sim.h"}).status, 0);
    EXPECT_NE(read("sim.cpp").find("#define RDDL_ENTRY narrow\n"), std::string::npos);
    EXPECT_NE(read("sim.h").find("const rddl_simulator* narrow(void);"), std::string::npos);
    EXPECT_NE(read("sim.h").find("#ifndef NARROW_H\n"), std::string::npos);
    for (const char* name : {"3x", "a-b", "a__b", "int", "main", ""}) {
        const Result result = with({"--entry=" + std::string(name)});
        EXPECT_EQ(result.status, 2) << name << result.output;
    }
    EXPECT_EQ(with({"--entry=narrow", "-o", "sim.hpp"}).status, 2);
    EXPECT_EQ(with({"--entry=narrow", "-o", "sim.so"}).status, 2);
}

TEST_F(CommandLine, MakesOnlySharedObjectsPortable) {
    for (const std::vector<std::string>& output :
         {std::vector<std::string>{}, {"-o", "sim.cpp"}, {"-o", "sim.hpp"}}) {
        std::vector<std::string> arguments = {"domain.rddl", "instance.rddl", "--portable"};
        arguments.insert(arguments.end(), output.begin(), output.end());
        EXPECT_EQ(rddlc(arguments).status, 2);
    }
}

TEST_F(CommandLine, SuggestsAnOption) {
    EXPECT_NE(rddlc({"domain.rddl", "--ouput", "x.cpp"}).output.find("did you mean '--output'?"),
              std::string::npos);
}

TEST_F(CommandLine, ListsTheDiagnostics) {
    const Result list = rddlc({"--explain", "list"});
    EXPECT_EQ(list.status, 0);
    EXPECT_EQ(list.output.substr(0, 7), "E0101: ");
    EXPECT_NE(list.output.find("\nW0601: fault for certain\n"), std::string::npos);
    EXPECT_NE(
        rddlc({"--explain"}).output.find("--explain is given no value; expected --explain CODE"),
        std::string::npos);
}

TEST_F(CommandLine, PrintsEveryForm) {
    const auto printed = [&](const std::string& form) {
        const Result result = rddlc({"domain.rddl", "instance.rddl", "--print=" + form});
        EXPECT_EQ(result.status, 0) << result.output;
        return result.output;
    };
    EXPECT_NE(printed("ast").find("domain lamp {"), std::string::npos);
    EXPECT_NE(printed("model").find("press"), std::string::npos);
    EXPECT_EQ(printed("ir").substr(0, 8), "program ");
    EXPECT_EQ(printed("ir-opt").substr(0, 8), "program ");
    EXPECT_NE(printed("cpp").find("struct Simulator"), std::string::npos);
    EXPECT_EQ(printed("ast,ir"), printed("ast") + printed("ir")) << "in the order of the stages";
}

TEST_F(CommandLine, WritesTheTextToStandardOutputWithoutAnOutput) {
    const Result plain = rddlc({"domain.rddl", "instance.rddl"});
    EXPECT_EQ(plain.status, 0);
    EXPECT_EQ(plain.output, rddlc({"domain.rddl", "instance.rddl", "--print=cpp"}).output);
}

TEST_F(CommandLine, ReadsBothBlocksFromOneFile) {
    write("problem.rddl", read("domain.rddl") + read("instance.rddl"));
    EXPECT_EQ(rddlc({"problem.rddl", "--check"}).status, 0);
}

TEST_F(CommandLine, ChecksADomainAlone) {
    const Result alone = rddlc({"domain.rddl", "--check"});
    EXPECT_EQ(alone.status, 0) << alone.output;
    EXPECT_TRUE(
        alone.output.ends_with("no instance was given: objects, values and what depends on "
                               "them were not checked\n"))
        << alone.output;
    EXPECT_EQ(rddlc({"domain.rddl", "--check", "--diagnostics-format=json"}).output, "[]\n");
    for (const char* needs_instance : {"--print=model", "--stop-after=ground", "--print=cpp"})
        EXPECT_EQ(rddlc({"domain.rddl", needs_instance}).status, 1) << needs_instance;
}

TEST_F(CommandLine, TakesThePolicyFromAThirdFile) {
    write("policy.rddl", "policy always { cpfs { press(?l) = true; }; }");
    const std::vector<std::string> words = {"domain.rddl", "instance.rddl", "policy.rddl"};
    const Result with_policy = rddlc(words);
    EXPECT_EQ(with_policy.status, 0) << with_policy.output;
    EXPECT_NE(with_policy.output.find("\nstruct Policy {"), std::string::npos);
    EXPECT_EQ(rddlc({words[0], words[1]}).output.find("Policy"), std::string::npos);
    EXPECT_NE(rddlc({"--help"}).output.find("DOMAIN [INSTANCE] [POLICY]"), std::string::npos);
}

TEST_F(CommandLine, StopsWhereItIsTold) {
    write("domain.rddl",
          "domain lamp { pvariables { x : { state-fluent, real, default = 0 }; };\n"
          "cpfs { x' = unknown; }; reward = 0.0; }");
    EXPECT_EQ(rddlc({"domain.rddl", "instance.rddl", "--stop-after=parse"}).status, 0);
    EXPECT_EQ(rddlc({"domain.rddl", "instance.rddl", "--stop-after=check"}).status, 1);
    EXPECT_EQ(rddlc({"domain.rddl", "instance.rddl", "--check"}).status, 1);
}

TEST_F(CommandLine, TellsWhereTheTimeGoes) {
    const Result result = rddlc({"domain.rddl", "instance.rddl", "-v", "-o", "sim.cpp"});
    for (const char* stage :
         {"read", "parse", "check", "ground", "verify", "optimise", "emit", "write"}) {
        EXPECT_NE(result.output.find(stage), std::string::npos) << stage;
    }
}

TEST_F(CommandLine, ComputesInFloatsWhereTheyCanBePacked) {
    const Result refused =
        rddlc({"domain.rddl", "instance.rddl", "--real=float", "--lanes=8", "-o", "sim.cpp"});
    EXPECT_EQ(refused.status, 1);
    EXPECT_NE(refused.output.find("--real=float is not possible with --lanes=8: a register may "
                                  "hold 16 floats [E0904]"),
              std::string::npos)
        << refused.output;
    const Result floats = rddlc({"domain.rddl", "instance.rddl", "--real=float", "--print=cpp"});
    EXPECT_EQ(floats.status, 0);
    EXPECT_NE(floats.output.find("<Simulator, about::problem, 16, float>"), std::string::npos);
    EXPECT_EQ(rddlc({"domain.rddl", "instance.rddl", "--lanes=1", "--real=double"}).status, 0);
}

}  // namespace
}  // namespace rddlc::testing
