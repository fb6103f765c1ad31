#include "passes/lanes/weigh_in_rows.hpp"

#include "passes/aggregations/draw_over_objects.hpp"
#include "passes/aggregations/tabulate_counts.hpp"
#include "passes/lanes/evaluate_together.hpp"
#include "passes/sharing/share_subexpressions.hpp"
#include "texts.hpp"

#include <string>

namespace rddlc {
namespace {

// People of whom each goes to an area.
ir::Program with_visits(const std::string& draw, const std::string& people = "p1, p2",
                        const std::string& areas = "@a1, @a2, @a3, @a4, @a5, @a6, @a7, @a8") {
    return *ground_text(
                "domain d {\n"
                "types { person : object; area : {" +
                areas +
                "}; day : {@1, @2}; };\n"
                "pvariables {\n"
                "GAIN(person, area) : { non-fluent, real, default = 2.5 };\n"
                "LESS(person, area) : { non-fluent, real, default = 0.5 };\n"
                "seen(area, day) : { state-fluent, bool, default = false };\n"
                "open(area) : { state-fluent, bool, default = false };\n"
                "to(person) : { interm-fluent, area };\n"
                "};\n"
                "cpfs {\n"
                "to(?p) = " +
                draw +
                ";\n"
                "seen'(?a, ?n) = seen(?a, ?n); open'(?a) = exists_{?p : person} [to(?p) == "
                "?a];\n"
                "};\n"
                "reward = 0;\n"
                "}\n"
                "non-fluents n { domain = d; objects { person : {" +
                people +
                "}; };\n"
                "non-fluents { GAIN(p1, @a2) = 4.0; }; }\n"
                "instance i { domain = d; non-fluents = n; max-nondef-actions = pos-inf; "
                "horizon = 10; discount = 1.0; }\n")
                .program;
}
std::string shares_of(const std::string& weight_of_a, const std::string& weight_of_b) {
    return "Discrete_{?a : area} ((" + weight_of_a + ") / (sum_{?b : area} [" + weight_of_b + "]))";
}

std::string in_rows(ir::Program program, passes::Report& report) {
    program = passes::draw_over_objects(std::move(program), report);
    program = passes::tabulate_counts(std::move(program), report);
    report.clear();
    program = valid(passes::weigh_in_rows(std::move(program), report));
    const std::string text = step_text(program);
    const std::size_t begin = text.find("for p in person");
    return begin == text.npos
               ? ""
               : text.substr(begin, text.find("for a in area\n    next.open") - begin);
}

TEST(WeighInRows, FillsARowForEachDraw) {
    passes::Report report;
    EXPECT_EQ(in_rows(with_visits(shares_of("if (open(?a)) then GAIN(?p, ?a) else 0.25",
                                            "if (open(?b)) then GAIN(?p, ?b) else 0.25")),
                      report),
              "for p in person\n"
              "    for a in area, several at once\n"
              "        scratch.to-weights[p, a] = select(state.open[a], GAIN[p, a], 0.25)\n"
              "for p in person\n"
              "    scratch.to[p] = sample discrete@0[p][a in area](scratch.to-weights[p, a] / "
              "sum[b in area](scratch.to-weights[p, b]))\n");
    EXPECT_EQ(report["draws from rows of weights"], 1);
}

// A count of two bools is two masks.
TEST(WeighInRows, SelectsWhatACountChooses) {
    const auto weight = [](const std::string& area) {
        const std::string count = "(sum_{?n : day} [seen(" + area + ", ?n)])";
        return "((" + count + " == 0) * GAIN(?p, " + area + ") + (" + count + " == 1) * LESS(?p, " +
               area + "))";
    };
    std::string draw = "Discrete(area";
    for (const std::string area : {"@a1", "@a2", "@a3", "@a4", "@a5", "@a6", "@a7", "@a8"})
        draw += ", " + area + " : " + weight(area) + " / (sum_{?a : area} [" + weight("?a") + "])";
    passes::Report report;
    EXPECT_EQ(in_rows(with_visits(draw + ")"), report),
              "for p in person\n"
              "    for choice in area, several at once\n"
              "        scratch.to-weights[p, choice] = select(element(state.seen, "
              "to-places[choice]) && element(state.seen, to-places-2[choice]), 0.0, "
              "select(element(state.seen, to-places[choice]) || element(state.seen, "
              "to-places-2[choice]), 0.5, GAIN[p, choice]))\n"
              "for p in person\n"
              "    scratch.to[p] = sample discrete@0[p][choice in area](scratch.to-weights[p, "
              "choice] / sum[a in area](scratch.to-weights[p, a]))\n");
}

TEST(WeighInRows, LeavesOtherDraws) {
    const std::string draw = shares_of("if (open(?a)) then GAIN(?p, ?a) else 0.25",
                                       "if (open(?b)) then GAIN(?p, ?b) else 0.25");
    const auto changes = [](const ir::Program& program) {
        passes::Report report;
        in_rows(program, report);
        return report["draws from rows of weights"];
    };
    EXPECT_EQ(changes(with_visits(draw)), 1);
    EXPECT_EQ(changes(with_visits(draw, "p1, p2, p3, p4, p5, p6, p7, p8")), 0) << "a lane each";
    EXPECT_EQ(changes(with_visits(draw, "p1", "@a1, @a2, @a3, @a4, @a5, @a6, @a7")), 0)
        << "no full register";
    EXPECT_EQ(changes(with_visits(shares_of("if (open(?a)) then GAIN(?p, ?a) else 0.25",
                                            "if (open(?b)) then GAIN(?p, ?b) else 0.5"))),
              0)
        << "another total";
    EXPECT_EQ(changes(with_visits(shares_of("if (open(?a)) then GAIN(?p, ?a) else -0.25",
                                            "if (open(?b)) then GAIN(?p, ?b) else -0.25"))),
              0)
        << "negative";
}

// The draw adds the weights of the row itself.
TEST(WeighInRows, RowsAreFilledInLanesAndTheirTotalsHaveNoName) {
    passes::Report report;
    ir::Program program =
        passes::weigh_in_rows(with_visits(shares_of("if (open(?a)) then GAIN(?p, ?a) else 0.25",
                                                    "if (open(?b)) then GAIN(?p, ?b) else 0.25")),
                              report);
    program = valid(passes::evaluate_together(
        passes::share_subexpressions(std::move(program), report), report));
    const std::string text = step_text(program);
    EXPECT_NE(text.find("for a in area, several at once"), text.npos) << text;
    EXPECT_EQ(text.find("let"), text.npos) << text;
}

}  // namespace
}  // namespace rddlc
