#include "formats/records_json.hpp"

#include "../runtime/tiny_simulator.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <cstring>
#include <limits>

namespace rddlc::workbench {
namespace {

using nlohmann::json;

using State = tiny::State<rddl::Scalar>;
using Action = tiny::Action<rddl::Scalar>;

const std::byte* bytes_of(const auto& record) {
    return reinterpret_cast<const std::byte*>(&record);
}
std::byte* bytes_of(auto& record) {
    return reinterpret_cast<std::byte*>(&record);
}

State some_state() {
    State state{};
    state.wear = {0.5, 1.0, -3e-9};
    state.running = {true, false, true};
    state.mode = 1;
    state.repairs = -7;
    return state;
}

TEST(RecordsJson, WritesInDeclarationOrderUnderGroundedNames) {
    const RecordLayout layout(tiny::problem, RDDL_STATE);
    EXPECT_EQ(layout.size(), sizeof(State));
    std::string text;
    const State state = some_state();
    layout.write(text, bytes_of(state));
    EXPECT_EQ(text, R"({"wear___lathe":0.5,"wear___mill":1.0,"wear___press":-3e-09,)"
                    R"("running___lathe":true,"running___mill":false,"running___press":true,)"
                    R"("mode":"fast","repairs":-7})");
}

TEST(RecordsJson, ObservesTheStateWhenNothingElseIsObserved) {
    const RecordLayout layout(tiny::problem, RDDL_OBSERVATION);
    EXPECT_EQ(layout.size(), sizeof(State));
    EXPECT_EQ(layout.entries().size(), 8u);
}

TEST(RecordsJson, ReadsBackWhatItWrites) {
    const RecordLayout layout(tiny::problem, RDDL_STATE);
    State state = some_state();
    state.wear = {0.1 + 0.2, std::numeric_limits<double>::infinity(), 1e300};
    state.repairs = std::numeric_limits<std::int64_t>::min();
    std::string text;
    layout.write(text, bytes_of(state));
    State read{};
    EXPECT_EQ(layout.read(json::parse(text), bytes_of(read)), std::nullopt);
    EXPECT_EQ(std::memcmp(&state, &read, sizeof state), 0);
}

TEST(RecordsJson, ReadsAPartAndKeepsTheRest) {
    const RecordLayout layout(tiny::problem, RDDL_STATE);
    State state = some_state();
    const auto values = json::parse(R"({"wear___mill": 2, "mode": "@slow", "repairs": true})");
    EXPECT_EQ(layout.read(values, bytes_of(state)), std::nullopt);
    EXPECT_EQ(state.wear[1], 2.0);
    EXPECT_EQ(state.mode, 0);
    EXPECT_EQ(state.repairs, 1);
    EXPECT_EQ(state.wear[0], 0.5);
}

TEST(RecordsJson, ReadsNumbersThatJsonHasNoWordsFor) {
    const RecordLayout layout(tiny::problem, RDDL_STATE);
    State state{};
    const auto values =
        json::parse(R"({"wear___lathe": "nan", "wear___mill": "inf", "wear___press": "-inf"})");
    EXPECT_EQ(layout.read(values, bytes_of(state)), std::nullopt);
    EXPECT_TRUE(std::isnan(state.wear[0]));
    EXPECT_EQ(state.wear[1], std::numeric_limits<double>::infinity());
    EXPECT_EQ(state.wear[2], -std::numeric_limits<double>::infinity());
}

struct Wrong {
    const char* values;
    const char* message;
};
class RefusedValues : public testing::TestWithParam<Wrong> {};

TEST_P(RefusedValues, AreExplained) {
    const RecordLayout layout(tiny::problem, RDDL_STATE);
    State state{};
    EXPECT_EQ(layout.read(json::parse(GetParam().values), bytes_of(state)), GetParam().message);
}

INSTANTIATE_TEST_SUITE_P(
    RecordsJson, RefusedValues,
    testing::Values(Wrong{"[1]", "'state' is not a JSON object"},
                    Wrong{R"({"wear__mill": 1})",
                          "no state-fluent is called 'wear__mill'; did you mean 'wear___mill'?"},
                    Wrong{R"({"entirely-else": 1})", "no state-fluent is called 'entirely-else'"},
                    Wrong{R"({"wear": 1})",
                          "'wear' has parameters: name one of its values, such as 'wear___lathe'"},
                    Wrong{R"({"running___mill": 1})",
                          "'running___mill' takes true or false, not 1"},
                    Wrong{R"({"repairs": 2.0})", "'repairs' takes an int, not 2.0"},
                    Wrong{R"({"repairs": 9223372036854775808})",
                          "'repairs' takes an int, not 9223372036854775808"},
                    Wrong{R"({"repairs": null})", "'repairs' takes an int, not null"},
                    Wrong{R"({"wear___mill": "NaN"})", "'wear___mill' takes a number, not \"NaN\""},
                    Wrong{R"({"repairs": [[1]]})", "'repairs' takes an int, not an array"},
                    Wrong{R"({"mode": 1})", "'mode' takes an object of type 'speed', not 1"},
                    Wrong{R"({"mode": "fasr"})",
                          "'mode' takes an object of type 'speed', not \"fasr\"; did "
                          "you mean 'fast'?"}));

TEST(RecordsJson, WritesChangesOnly) {
    const RecordLayout layout(tiny::problem, RDDL_ACTION);
    Action action{};
    std::string text;
    layout.write_changes(text, bytes_of(action), bytes_of(tiny::default_action));
    EXPECT_EQ(text, "{}");
    EXPECT_EQ(layout.count_changes(bytes_of(action), bytes_of(tiny::default_action)), 0);

    action.repair[2] = true;
    action.hazard = -0.0;  // another text, but no other value
    text.clear();
    layout.write_changes(text, bytes_of(action), bytes_of(tiny::default_action));
    EXPECT_EQ(text, R"({"repair___press":true,"hazard":-0.0})");
    EXPECT_EQ(layout.count_changes(bytes_of(action), bytes_of(tiny::default_action)), 1);
}

std::string real_text(double value) {
    std::string text;
    write_real(text, value);
    return text;
}

TEST(RecordsJson, RealsLookLikeRealsAndRoundTrip) {
    EXPECT_EQ(real_text(0.0), "0.0");
    EXPECT_EQ(real_text(-1.0), "-1.0");
    EXPECT_EQ(real_text(1e22), "1e+22");
    EXPECT_EQ(real_text(0.1), "0.1");
    EXPECT_EQ(real_text(std::numeric_limits<double>::quiet_NaN()), "\"nan\"");
    EXPECT_EQ(json::parse(real_text(5e-324)).get<double>(), 5e-324);
}

TEST(RecordsJson, EscapesStrings) {
    std::string text;
    write_string(text, "a \"b\" \\ \n \x01 é");
    EXPECT_EQ(json::parse(text).get<std::string>(), "a \"b\" \\ \n \x01 é");
}

TEST(RecordsJson, StringsAreAlwaysUtf8) {
    std::string text;
    write_string(text, "fi\xffle");
    EXPECT_EQ(json::parse(text).get<std::string>(), "fi\xEF\xBF\xBDle");
}

TEST(RecordsJson, GroundedNamesListObjectsInParameterOrder) {
    const char* const rows[] = {"r1", "r2"};
    const char* const columns[] = {"c1", "c2", "c3"};
    const rddl_type types[] = {{"row", rows, 2, 0}, {"column", columns, 3, 0}};
    const std::int32_t parameters[] = {0, 1};
    rddl_problem problem{};
    problem.types = types;
    problem.type_count = 2;
    rddl_fluent fluent{};
    fluent.name = "at";
    fluent.rank = 2;
    fluent.parameter_types = parameters;
    fluent.count = 6;
    EXPECT_EQ(grounded_name(problem, fluent, 0), "at___r1__c1");
    EXPECT_EQ(grounded_name(problem, fluent, 5), "at___r2__c3");
    EXPECT_EQ(grounded_name(problem, fluent, 3), "at___r2__c1");
}

}  // namespace
}  // namespace rddlc::workbench
