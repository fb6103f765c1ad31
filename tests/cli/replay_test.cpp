// `rddl replay` as a program that others drive.
#include "program.hpp"

#include <unistd.h>

#include <array>
#include <cstdio>
#include <sstream>

namespace rddlc::cli {
namespace {

using nlohmann::json;

class ReplayProgram : public Program {
  protected:
    std::vector<json> replay(const std::string& lines, const std::string& options = "") const {
        write_file(folder_ / "in.jsonl", lines);
        const Outcome outcome =
            run("replay domain.rddl instance.rddl --input in.jsonl --output out.jsonl " + options);
        EXPECT_EQ(outcome.status, 0) << outcome.err;
        std::vector<json> answers;
        std::istringstream text(read_file(folder_ / "out.jsonl"));
        for (std::string line; std::getline(text, line);) answers.push_back(json::parse(line));
        return answers;
    }
};

constexpr const char* some_lines =
    R"({"action": {"pump___t1": true}}
{"state": {"water___t1": 7, "water___t2": 1.5, "water___t3": 6.25, "last": "high"}}

{"action": {"power": "@high", "extra": 0.5}}
{"action": {"pump___t4": true}}
{"action": {"pump___t1": true, "pump___t2": true, "pump___t3": true}}
no json
{"repeat": 3}
{"action": {}})";

TEST_F(ReplayProgram, AnswersEveryLine) {
    const std::vector<json> answers = replay(some_lines, "--engine interpreter");
    ASSERT_EQ(answers.size(), 8u) << "the blank line has no answer";
    EXPECT_EQ(answers[0]["state"]["pumped"], 1);
    EXPECT_LT(answers[1]["state"]["water___t1"], 7.0);
    EXPECT_EQ(answers[1]["state"]["last"], "low");
    EXPECT_EQ(answers[2]["state"]["last"], "high");
    EXPECT_EQ(answers[3]["error"],
              "no action-fluent is called 'pump___t4'; did you mean 'pump___t1'?");
    EXPECT_EQ(answers[4]["error"], "3 action values differ from their default; at most 2 may");
    EXPECT_TRUE(answers[5].contains("error"));
    EXPECT_EQ(answers[3]["line"], 5) << "blank lines count";
    EXPECT_EQ(answers[5]["line"], 7);
    EXPECT_EQ(answers[6]["samples"].size(), 3u);
    EXPECT_TRUE(answers[7].contains("state"));
}

TEST_F(ReplayProgram, EnginesAgreeToTheLastByte) {
    replay(some_lines, "--engine interpreter --seed 9");
    const std::string by_interpreter = read_file(folder_ / "out.jsonl");
    replay(some_lines, "--engine compiled --seed 9");
    EXPECT_EQ(read_file(folder_ / "out.jsonl"), by_interpreter);
    replay(some_lines, "--engine interpreter --seed 10");
    EXPECT_NE(read_file(folder_ / "out.jsonl"), by_interpreter);
}

TEST_F(ReplayProgram, RepeatsTraces) {
    ASSERT_EQ(run("run domain.rddl instance.rddl --engine interpreter --episodes 5 --seed 77 "
                  "--horizon 9 --trace trace.jsonl --quiet")
                  .status,
              0);
    std::istringstream trace(read_file(folder_ / "trace.jsonl"));
    std::string line;
    std::getline(trace, line);
    const json header = json::parse(line);
    EXPECT_EQ(header["rddl_trace"], 1);
    EXPECT_EQ(header["seed"], 77);
    EXPECT_EQ(header["horizon"], 9);
    EXPECT_EQ(header["policy"], "random");
    EXPECT_EQ(header["files"][1]["path"], "instance.rddl");

    const std::vector<json> answers = replay(read_file(folder_ / "trace.jsonl"));
    std::size_t number = 0;
    std::vector<int> episodes;
    for (; std::getline(trace, line); ++number) {
        const json step = json::parse(line);
        ASSERT_LT(number, answers.size());
        EXPECT_EQ(answers[number]["state"], step["next_state"]);
        EXPECT_EQ(answers[number]["reward"], step["reward"]);
        EXPECT_EQ(answers[number]["terminated"], step["terminated"]);
        EXPECT_EQ(answers[number]["truncated"], step["truncated"]);
        if (step["step"] == 0) episodes.push_back(step["episode"]);
    }
    EXPECT_EQ(number, answers.size());
    EXPECT_EQ(episodes, (std::vector<int>{0, 1, 2, 3, 4}));
}

TEST_F(ReplayProgram, RefusesTracesOfOtherProblems) {
    const std::string replayed = "replay domain.rddl instance.rddl --engine interpreter --input ";
    ASSERT_EQ(run("run domain.rddl instance.rddl --engine interpreter --trace trace.jsonl --quiet")
                  .status,
              0);
    EXPECT_EQ(run(replayed + "trace.jsonl").err, "");

    std::string other = tanks_instance;
    other.replace(other.find("tanks_1"), 7, "tanks_2");
    write_file(folder_ / "other.rddl", other);
    const Outcome foreign =
        run("replay domain.rddl other.rddl --engine interpreter --input trace.jsonl");
    EXPECT_EQ(foreign.status, 1);
    EXPECT_EQ(foreign.out, "");
    EXPECT_EQ(foreign.err,
              "rddl: error: line 1 of the input: the trace is of instance 'tanks_1' "
              "of domain 'tanks', not of 'tanks_2' of 'tanks'\n");
    EXPECT_EQ(run("verify domain.rddl other.rddl --engine interpreter --no-pyrddlgym --states "
                  "trace.jsonl")
                  .status,
              1);

    write_file(folder_ / "version.jsonl", "\n{\"rddl_trace\": 2}\n{}\n");
    const Outcome version = run(replayed + "version.jsonl");
    EXPECT_EQ(version.status, 1);
    EXPECT_EQ(version.err,
              "rddl: error: line 2 of the input: 'rddl_trace' is 2; this program reads "
              "version 1\n");
}

TEST_F(ReplayProgram, WarnsOfFilesThatHaveChanged) {
    ASSERT_EQ(run("run domain.rddl instance.rddl --engine interpreter --trace trace.jsonl --quiet")
                  .status,
              0);
    write_file(folder_ / "domain.rddl", std::string(tanks_domain) + "// another comment\n");
    const Outcome changed =
        run("replay domain.rddl instance.rddl --engine interpreter --input trace.jsonl");
    EXPECT_EQ(changed.status, 0);
    EXPECT_EQ(changed.err,
              "rddl: warning: 'domain.rddl' is not the file that the trace was made "
              "with: its steps may come out differently\n");
}

// Two pipes around the program.
class Conversation {
  public:
    explicit Conversation(const std::string& command) {
        int to[2], from[2];
        if (pipe(to) != 0 || pipe(from) != 0) return;
        process_ = fork();
        if (process_ == 0) {
            dup2(to[0], STDIN_FILENO);
            dup2(from[1], STDOUT_FILENO);
            for (const int end : {to[0], to[1], from[0], from[1]}) close(end);
            execl("/bin/sh", "sh", "-c", command.c_str(), nullptr);
            _exit(127);
        }
        close(to[0]);
        close(from[1]);
        to_ = fdopen(to[1], "w");
        from_ = fdopen(from[0], "r");
    }
    std::string ask(const std::string& line) {
        std::fprintf(to_, "%s\n", line.c_str());
        std::fflush(to_);
        std::array<char, 4096> buffer;
        return std::fgets(buffer.data(), buffer.size(), from_) ? buffer.data() : "";
    }
    int end() {
        std::fclose(to_);
        int status = -1;
        waitpid(process_, &status, 0);
        std::fclose(from_);
        return WEXITSTATUS(status);
    }

  private:
    pid_t process_ = -1;
    FILE* to_ = nullptr;
    FILE* from_ = nullptr;
};

TEST_F(ReplayProgram, AnswersAtOnceInAPipe) {
    Conversation conversation(command("replay domain.rddl instance.rddl --engine interpreter"));
    for (int i = 1; i <= 3; ++i) {
        const json answer = json::parse(conversation.ask(R"({"action": {"pump___t1": true}})"));
        EXPECT_EQ(answer["state"]["pumped"], i);
    }
    EXPECT_EQ(conversation.end(), 0);
}

TEST_F(ReplayProgram, TellsWhenAFileCannotBeUsed) {
    const Outcome unread =
        run("replay domain.rddl instance.rddl --engine interpreter --input nothing.jsonl");
    EXPECT_EQ(unread.status, 1);
    EXPECT_EQ(unread.err, "rddl: error: cannot read 'nothing.jsonl': No such file or directory\n");
    const Outcome unwritten =
        run("replay domain.rddl instance.rddl --engine interpreter --input instance.rddl "
            "--output /dev/full");
    EXPECT_EQ(unwritten.status, 1);
    EXPECT_NE(unwritten.err.find("cannot write '/dev/full'"), std::string::npos) << unwritten.err;
}

}  // namespace
}  // namespace rddlc::cli
