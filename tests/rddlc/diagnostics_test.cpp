#include "run_rddlc.hpp"

#include <nlohmann/json.hpp>

namespace rddlc::testing {
namespace {

class DiagnosticsOptions : public RddlcTest {
  protected:
    DiagnosticsOptions() {
        std::string text = read("domain.rddl");
        const std::string unused = "spare : { interm-fluent, real };\n";
        text.insert(text.find("on(lamp)"), unused);
        text.insert(text.find("on'(?l)"), "spare = 1.0; ");
        write("warning.rddl", text);
    }

    std::vector<std::string> with(std::vector<std::string> options) const {
        options.insert(options.begin(), {"warning.rddl", "instance.rddl", "--check"});
        return options;
    }
};

TEST_F(DiagnosticsOptions, CountsAtTheEnd) {
    const Result result = rddlc(with({}));
    EXPECT_EQ(result.status, 0) << result.output;
    EXPECT_TRUE(result.output.ends_with("\n1 warning\n")) << result.output;
    write("warning.rddl", "domain d { pvariables { x : { state-fluent, real, default = 0 } } }");
    EXPECT_NE(rddlc(with({})).output.find("error"), std::string::npos);
}

TEST_F(DiagnosticsOptions, SilenceWarningsOrMakeThemErrors) {
    const std::string plain = rddlc(with({})).output;
    const std::size_t bracket = plain.find("[W");
    ASSERT_NE(bracket, std::string::npos) << plain;
    const std::string code = plain.substr(bracket + 1, 5);

    EXPECT_EQ(rddlc(with({"-w"})).output, "");
    EXPECT_EQ(rddlc(with({"-Wno-" + code})).output, "");
    EXPECT_EQ(rddlc(with({"-Werror"})).status, 1);
    EXPECT_EQ(rddlc(with({"-Werror=" + code})).status, 1);
    EXPECT_TRUE(rddlc(with({"-Werror"}))
                    .output.ends_with("\n1 error\n'rddlc --explain " + code + "' explains it\n"));
    EXPECT_EQ(rddlc(with({"-Werror", "-Wno-" + code})).status, 0);
}

TEST_F(DiagnosticsOptions, SpeakJsonToPrograms) {
    const Result result = rddlc(with({"--diagnostics-format=json"}));
    const auto json = nlohmann::json::parse(result.output, nullptr, false);
    ASSERT_TRUE(json.is_array()) << result.output;
    EXPECT_EQ(json.size(), 1u);
    EXPECT_EQ(
        rddlc({"domain.rddl", "instance.rddl", "--check", "--diagnostics-format=json"}).output,
        "[]\n");
}

TEST_F(DiagnosticsOptions, UseColoursOnRequestOnly) {
    EXPECT_EQ(rddlc(with({})).output.find('\x1b'), std::string::npos);
    EXPECT_NE(rddlc(with({"--color=always"})).output.find('\x1b'), std::string::npos);
    EXPECT_EQ(rddlc(with({"--color=never"})).output.find('\x1b'), std::string::npos);
}

}  // namespace
}  // namespace rddlc::testing
