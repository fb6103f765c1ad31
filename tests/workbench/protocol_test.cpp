// Over 400 lines: servers and clients share the messages of one problem.
// The protocol of IPPC 2011 to 2018: sessions written as rddlsim, its client and PROST speak, and
// live ones over loopback.
#include "../runtime/tiny_simulator.hpp"
#include "protocol/client.hpp"
#include "protocol/server.hpp"
#include "solvers/evaluation/episodes.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/socket.h>

#include <array>
#include <atomic>
#include <thread>

namespace rddlc::workbench {
namespace {

// ------------------------------------------------------------------------- sessions of a server

class Session : public testing::Test {
  protected:
    Session() {
        options_.rounds = 2;
        options_.seconds = 60;
        options_.clock = [this] {
            return time_;
        };
    }
    std::string say(const std::string& message) { return session().answer(parse_element(message)); }
    ServerSession& session() {
        if (!session_) session_.emplace(problem_, options_, 7);
        return *session_;
    }
    void begin(const std::string& extra = "") {
        say("<session-request><problem-name>tiny_1</problem-name><client-name>me</client-name>" +
            extra + "</session-request>");
    }
    std::string refusal_of(const std::string& message) {
        try {
            say(message);
        } catch (const BadMessage& error) {
            return error.what();
        }
        return "";
    }

    double time_ = 1000;
    SessionOptions options_;
    ServedProblem problem_{*tiny::simulator(), "domain and instance"};
    std::optional<ServerSession> session_;
};

std::string message(const std::string& element) {
    return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n" + element + '\0';
}

constexpr const char* first_fluents =
    "<observed-fluent><fluent-name>wear</fluent-name><fluent-arg>lathe</fluent-arg>"
    "<fluent-value>0.0</fluent-value></observed-fluent>";

// As PROST begins: it wants neither headers nor zero bytes, and sends a header of its own.
TEST_F(Session, OfProst) {
    const std::string instance = tiny::simulator()->problem->instance;
    EXPECT_EQ(
        say("<?xml version=\"1.0\" encoding=\"UTF-8\"?><session-request><problem-name>" + instance +
            "</problem-name><client-name>prost</client-name><input-language>rddl"
            "</input-language><no-header/></session-request>"),
        "<session-init><task>ZG9tYWluIGFuZCBpbnN0YW5jZQ==</task><session-id>7</session-id>"
        "<num-rounds>2</num-rounds><time-allowed>60000.0</time-allowed></session-init>");
    const std::string turn =
        say("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<round-request> <execute-policy>yes"
            "</execute-policy> </round-request>");
    EXPECT_TRUE(turn.starts_with(
        "<round-init><round-num>1</round-num><round-left>1</round-left><time-left>60000"
        "</time-left></round-init><turn><turn-num>1</turn-num><time-left>60000</time-left>"
        "<immediate-reward>0.0</immediate-reward>"))
        << turn;
    EXPECT_NE(turn.find(first_fluents), std::string::npos) << turn;
    EXPECT_NE(turn.find("<fluent-name>mode</fluent-name><fluent-value>@slow</fluent-value>"),
              std::string::npos)
        << turn;
    EXPECT_EQ(turn.find('\0'), std::string::npos);
    time_ += 1.5;
    const std::string next =
        say("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<actions><action><action-name>repair"
            "</action-name><action-arg>lathe</action-arg><action-value>true</action-value></action>"
            "</actions>");
    EXPECT_TRUE(
        next.starts_with("<turn><turn-num>2</turn-num><time-left>58500</time-left>"
                         "<immediate-reward>"))
        << next;
    EXPECT_NE(next.find("<fluent-name>repairs</fluent-name><fluent-value>1</fluent-value>"),
              std::string::npos)
        << next;
}

// As the client of rddlsim: with headers and zero bytes, without a language.
TEST_F(Session, OfTheClientOfRddlsim) {
    const std::string instance = tiny::simulator()->problem->instance;
    const std::string init = say("<session-request><problem-name>" + instance +
                                 "</problem-name><client-name>j</client-name></session-request>");
    EXPECT_TRUE(init.starts_with("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<session-init>"));
    EXPECT_EQ(init.back(), '\0');
    EXPECT_EQ(say("<resource-request/>"),
              message("<resource-notification><time-left>60000</time-left><memory-left>enough"
                      "</memory-left></resource-notification>"));
    std::string last;
    for (int round = 0; round < 2; ++round) {
        say("<round-request/>");
        EXPECT_NE(say("<resource-request/>").find("resource-notification"), std::string::npos);
        do last = say("<actions/>");
        while (last.find("<turn>") != std::string::npos);
        EXPECT_NE(last.find(fmt::format("<round-num>{}</round-num>", round)), std::string::npos)
            << "rounds that have ended count from 0";
    }
    const std::size_t end = last.find("<session-end>");
    ASSERT_NE(end, std::string::npos) << last;
    EXPECT_EQ(session().returns().size(), 2u);
    EXPECT_EQ(parse_element(std::string_view(last).substr(end, last.size() - end - 1))
                  .text_of("total-reward"),
              java_real(session().returns()[0] + session().returns()[1]));
    EXPECT_TRUE(session().is_over());
    EXPECT_EQ(say("<round-request/>"), "") << "was sent before the end was read";
}

TEST_F(Session, RoundsAreEpisodesOfTheSeed) {
    const rddl_simulator& simulator = *tiny::simulator();
    begin();
    for (int round = 0; round < 2; ++round) {
        say("<round-request/>");
        while (say("<actions/>").find("<turn>") != std::string::npos) {
        }
    }
    solvers::EpisodeOptions options;
    options.episodes = 2;
    options.threads = 1;
    const solvers::Rollouts rollouts =
        solvers::run_episodes(simulator, solvers::noop_policy(simulator), options, {});
    EXPECT_EQ(session().returns()[0], rollouts.episodes[0].discounted_return);
    EXPECT_EQ(session().returns()[1], rollouts.episodes[1].discounted_return);
}

TEST_F(Session, RoundsThatOnlyTryCountForNothing) {
    begin();
    const std::string start =
        say("<round-request><execute-policy>no</execute-policy></round-request>");
    EXPECT_NE(start.find("<round-left>2</round-left>"), std::string::npos) << start;
    while (say("<actions/>").find("<turn>") != std::string::npos) {
    }
    EXPECT_EQ(session().returns().size(), 0u);
    EXPECT_NE(say("<round-request/>").find("<round-num>1</round-num>"), std::string::npos);
}

TEST_F(Session, AnIllegalActionEndsTheRound) {
    begin();
    say("<round-request/>");
    std::string two;
    for (const char* machine : {"lathe", "mill"})
        two += fmt::format(
            "<action><action-name>repair</action-name><action-arg>{}</action-arg>"
            "<action-value>true</action-value></action>",
            machine);
    const std::string end = say("<actions>" + two + "</actions>");
    EXPECT_NE(end.find("<turns-used>0</turns-used>"), std::string::npos) << end;
    EXPECT_EQ(session().take_note(), "2 action values differ from their default; at most 1 may");
}

TEST_F(Session, WhatCannotBeIsRefusedInWords) {
    EXPECT_EQ(refusal_of("<actions/>"), "<session-request> was expected here, not <actions>");
    EXPECT_EQ(refusal_of("<session-request/>"), "<session-request> has no <problem-name>");
    EXPECT_NE(refusal_of("<session-request><problem-name>x</problem-name></session-request>")
                  .find("there is no problem 'x' here"),
              std::string::npos);
    EXPECT_NE(refusal_of("<session-request><problem-name/><client-name/><input-language>pddl"
                         "</input-language></session-request>")
                  .find("'pddl'"),
              std::string::npos);
    session_.reset();
    EXPECT_EQ(refusal_of("<session-request><problem-name/><client-name/></session-request>"), "");
    EXPECT_EQ(refusal_of("<actions/>"), "<round-request> was expected here, not <actions>");
    say("<round-request/>");
    const auto action = [this](const std::string& inside) {
        return refusal_of("<actions><action>" + inside + "</action></actions>");
    };
    EXPECT_EQ(action("<action-name>fly</action-name>"), "the problem has no action 'fly'");
    EXPECT_EQ(action("<action-name>repair</action-name><action-arg>m9</action-arg>"),
              "the problem has no action 'repair m9'");
    EXPECT_EQ(action("<action-name>repair</action-name><action-arg>lathe</action-arg>"),
              "<action> has no <action-value>");
    EXPECT_EQ(action("<action-name>repair</action-name><action-arg>$lathe</action-arg>"
                     "<action-value>1</action-value>"),
              "the value of repair___lathe is '1', which is not true or false");
    EXPECT_EQ(action("<action-name>set-mode</action-name><action-value>@wild</action-value>"),
              "the value of set-mode is '@wild', which is not an object of type speed");
    EXPECT_EQ(action("<action-name>hazard</action-name><action-value>NaN</action-value>"),
              "the value of hazard is 'NaN', which is not finite");
    EXPECT_EQ(refusal_of("<actions><x/></actions>"), "<action> was expected here, not <x>");
}

TEST_F(Session, EndsWhenItsTimeIsUp) {
    begin();
    EXPECT_EQ(session().end_if_late(), "");
    say("<round-request/>");
    time_ += 61;
    const std::string end = say("<actions/>");
    EXPECT_NE(end.find("<turns-used>1</turns-used>"), std::string::npos) << end;
    EXPECT_NE(end.find("<session-end>"), std::string::npos) << end;
    EXPECT_TRUE(session().is_over());
    EXPECT_EQ(session().returns().size(), 1u);

    session_.reset();
    begin();
    time_ += 61;
    EXPECT_NE(session().end_if_late().find("<session-end>"), std::string::npos);
    EXPECT_EQ(session().take_note(), "the time of the session is up");
}

// --------------------------------------------------------------------------------- over loopback

class Live : public testing::Test {
  protected:
    Live() {
        options_.host = "127.0.0.1";
        options_.port = 0;
        options_.session.rounds = 3;
        options_.patience = 0.3;
        options_.tell = [this](const std::string& sentence) {
            told_ += sentence + '\n';
        };
        options_.ended = [this](const ServerSession& session) {
            returns_ = session.returns();
        };
        server_.emplace(problem_, options_);
        thread_ = std::thread([this] { server_->run([this] { return stops_.load(); }); });
    }
    ~Live() override { stop(); }
    void stop() {
        stops_ = true;
        if (thread_.joinable()) thread_.join();
    }
    Descriptor connect() const { return connect_to("127.0.0.1", server_->port()); }
    // All that the server says until it closes the connection.
    static std::string rest_of(const Descriptor& socket) {
        std::string bytes;
        while (receive_some(socket, bytes) >= 0) {
        }
        return bytes;
    }
    Played play() const {
        const rddl_simulator& simulator = *tiny::simulator();
        ServerConnection connection(connect(), 20, {});
        const SessionInit session = connection.begin_session("", "test");
        EXPECT_EQ(session.task, "the text");
        Played played;
        play_session(connection, session, simulator, solvers::random_policy(simulator, 0), {},
                     played);
        return played;
    }

    ServedProblem problem_{*tiny::simulator(), "the text"};
    ServerOptions options_;
    std::optional<ProtocolServer> server_;
    std::atomic<bool> stops_ = false;
    std::string told_;
    std::vector<double> returns_;
    std::thread thread_;
};

TEST_F(Live, PlayAgainstServeIsWhatEvaluateDoes) {
    const rddl_simulator& simulator = *tiny::simulator();
    const Played played = play();
    stop();
    solvers::EpisodeOptions options;
    options.episodes = 3;
    options.threads = 1;
    const solvers::Rollouts rollouts =
        solvers::run_episodes(simulator, solvers::random_policy(simulator, 0), options, {});
    ASSERT_EQ(played.returns.size(), 3u);
    for (std::size_t k = 0; k < 3; ++k)
        EXPECT_EQ(played.returns[k], rollouts.episodes[k].discounted_return) << k;
    EXPECT_GE(played.turns, rollouts.steps) << "a turn that faults is no step";
    EXPECT_EQ(returns_, played.returns);
}

TEST_F(Live, OneThatStallsOrSendsGarbageDoesNotStopOthers) {
    const Descriptor silent = connect(), garbage = connect(), slow = connect(), blank = connect();
    send_some(garbage, "GET / HTTP/1.1\r\n\r\n");
    send_some(slow, "<session-req");
    EXPECT_EQ(play().returns.size(), 3u);
    std::string told_of_blanks;
    for (long received = 0; received >= 0 && told_of_blanks.empty();) {
        send_some(blank, " ");
        if (wait_to_read(blank, 20)) received = receive_some(blank, told_of_blanks);
    }
    EXPECT_NE(rest_of(garbage).find("<error>the message is not XML of the protocol: text stands "
                                    "outside of elements</error>"),
              std::string::npos);
    EXPECT_NE(rest_of(silent).find("<error>there was no &lt;session-request&gt; for more than 0.3 "
                                   "seconds</error>"),
              std::string::npos);
    EXPECT_NE(rest_of(slow).find("<error>"), std::string::npos);
    EXPECT_NE(told_of_blanks.find("there was no"), std::string::npos) << "they begin nothing";
    stop();
    EXPECT_NE(told_.find("text stands outside of elements"), std::string::npos) << told_;
}

TEST_F(Live, AnswersOfManyMessagesAtOnceComeAsTheyAreRead) {
    constexpr int rounds = 800;  // more bytes than a server holds for one client
    std::string all = "<session-request><problem-name/><client-name/></session-request>";
    for (int round = 0; round < rounds; ++round)
        all +=
            "<round-request><execute-policy>no</execute-policy></round-request>"
            "<actions><action><action-name>repair</action-name><action-arg>lathe</action-arg>"
            "<action-value>true</action-value></action><action><action-name>repair</action-name>"
            "<action-arg>mill</action-arg><action-value>true</action-value></action></actions>";
    const Descriptor socket = connect();
    std::thread writer([&] {
        for (std::string_view rest = all; !rest.empty();)
            rest.remove_prefix(static_cast<std::size_t>(std::max(0L, send_some(socket, rest))));
    });
    std::string answers;
    const std::string end = "</round-end>";
    std::size_t at = 0;
    for (int found = 0; found < rounds && receive_some(socket, answers) >= 0;)
        for (std::size_t next; (next = answers.find(end, at)) != std::string::npos; ++found)
            at = next + end.size();
    writer.join();
    EXPECT_GT(answers.size(), std::size_t{1} << 20);
}

TEST_F(Live, LongMessagesAreCutOff) {
    const Descriptor socket = connect();
    std::string all = "<session-request>" + std::string(1 << 21, 'x');
    std::size_t sent = 0;
    while (sent < all.size()) {
        const long more = send_some(socket, std::string_view(all).substr(sent));
        if (more < 0) break;
        sent += static_cast<std::size_t>(more);
    }
    rest_of(socket);
    stop();
    EXPECT_NE(told_.find("the message is longer than"), std::string::npos) << told_;
}

TEST_F(Live, AnotherProblemIsRefused) {
    ServerConnection connection(connect(), 20, {});
    try {
        connection.begin_session("no such", "test");
        FAIL();
    } catch (const Failure& failure) {
        EXPECT_NE(std::string(failure.what()).find("there is no problem 'no such' here"),
                  std::string::npos)
            << failure.what();
    }
}

// ------------------------------------------------------------------------ a server like rddlsim

// Plays against the bytes of a server, however they are cut.
void play_against(const std::string& bytes, Played& played) {
    std::array<int, 2> ends{};
    EXPECT_EQ(socketpair(AF_UNIX, SOCK_STREAM, 0, ends.data()), 0);
    const Descriptor server(ends[1]);
    ServerConnection connection(Descriptor{ends[0]}, 5, {});
    send_some(server, bytes);
    shutdown(server.get(), SHUT_WR);
    const rddl_simulator& simulator = *tiny::simulator();
    const SessionInit session = connection.begin_session("tiny", "test");
    play_session(connection, session, simulator, solvers::noop_policy(simulator), {}, played);
}

std::string complaint_of_play(const std::string& bytes) {
    Played played;
    try {
        play_against(bytes, played);
    } catch (const Failure& failure) {
        return failure.what();
    }
    return "";
}

std::string turn_of_rddlsim(int number, const std::string& leave_out = "") {
    std::string out = fmt::format(
        "<turn><turn-num>{}</turn-num><time-left>59196.0</time-left><immediate-reward>-1.0E-5"
        "</immediate-reward>",
        number);
    const auto add = [&](const std::string& name, const std::string& argument,
                         const std::string& value) {
        if (name == leave_out) return;
        out += "<observed-fluent><fluent-name>" + name + "</fluent-name>" +
               (argument.empty() ? "" : "<fluent-arg>" + argument + "</fluent-arg>") +
               "<fluent-value>" + value + "</fluent-value></observed-fluent>";
    };
    for (const char* machine : {"lathe", "mill", "press"}) {
        add("wear", machine, "1.0E-5");
        add("running", machine, "true");
    }
    add("mode", "", "@fast");
    add("repairs", "", "12");
    return message(out + "</turn>");
}

const std::string init_of_rddlsim = message(
    "<session-init><task>ZG9tYWlu</task><session-id>1</session-id><num-rounds>1</num-rounds>"
    "<time-allowed>60000.0</time-allowed></session-init>");
const std::string round_of_rddlsim = message(
    "<round-init><round-num>1</round-num><round-left>0</round-left><time-left>60000.0</time-left>"
    "</round-init>");

TEST(Rddlsim, IsPlayed) {
    Played played;
    play_against(
        init_of_rddlsim + round_of_rddlsim + turn_of_rddlsim(1) + turn_of_rddlsim(2) +
            message("<round-end><instance-name>tiny</instance-name><client-name>test</client-name>"
                    "<round-num>0</round-num><round-reward>-2.5E-5</round-reward><turns-used>2"
                    "</turns-used><time-left>58000</time-left><immediate-reward>0.0"
                    "</immediate-reward></round-end>") +
            message("<session-end><instance-name>tiny</instance-name><total-reward>-2.5E-5"
                    "</total-reward><rounds-used>1</rounds-used><client-name>test</client-name>"
                    "<session-id>1</session-id><time-left>57990</time-left></session-end>"),
        played);
    EXPECT_EQ(played.returns, std::vector<double>{-2.5e-5});
    EXPECT_EQ(played.total, -2.5e-5);
    EXPECT_EQ(played.turns, 2);
}

TEST(Rddlsim, RoundsThatAreOverCountWhereASessionEndsEarly) {
    const std::string end =
        message("<round-end><round-num>0</round-num><round-reward>-2.5</round-reward></round-end>");
    Played played;
    EXPECT_THROW(
        play_against(init_of_rddlsim + round_of_rddlsim + turn_of_rddlsim(1) + end, played),
        Failure);
    EXPECT_EQ(played.returns, std::vector<double>{-2.5});
    EXPECT_EQ(played.total, -2.5);
}

TEST(Rddlsim, WhatItDoesNotSayIsMissed) {
    EXPECT_EQ(complaint_of_play(init_of_rddlsim + round_of_rddlsim + turn_of_rddlsim(1, "mode")),
              "the server does not say what mode is");
    EXPECT_EQ(complaint_of_play(init_of_rddlsim + round_of_rddlsim),
              "the server has closed the connection before the session was over");
    for (const int number : {0, 2'000'000'000})
        EXPECT_TRUE(complaint_of_play(init_of_rddlsim + round_of_rddlsim + turn_of_rddlsim(number))
                        .starts_with("<turn-num> of <turn> is "))
            << number;
    EXPECT_EQ(complaint_of_play(message("<error>no</error>")), "the server refuses: no");
    EXPECT_EQ(complaint_of_play(message("<turn/>")),
              "the server answers <turn>, not <session-init>");
    EXPECT_EQ(complaint_of_play(message("<session-init><num-rounds>many</num-rounds>"
                                        "</session-init>")),
              "<num-rounds> of <session-init> is 'many', which is not a number");
}

}  // namespace
}  // namespace rddlc::workbench
