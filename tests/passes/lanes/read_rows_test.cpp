#include "passes/lanes/read_rows.hpp"

#include "passes/lanes/turn_tables.hpp"
#include "texts.hpp"

#include <stdexcept>
#include <string>
#include <utility>

namespace rddlc {
namespace {

ir::Program grounded_with_twelve(const Problem& problem) {
    const std::string few = "obj : {b1, b2, b3}";
    std::string text = problem.text(), twelve = "obj : {b1";
    for (int i = 2; i <= 12; ++i) twelve += ", b" + std::to_string(i);
    Grounded result = ground_text(text.replace(text.find(few), few.size(), twelve + "}"));
    if (!result.program) throw std::runtime_error(result.messages);
    return std::move(*result.program);
}
// Each of the twelve objects has two others.
std::string rings() {
    std::string text;
    for (int i = 1; i <= 12; ++i) {
        const std::string object = "NEXT(b" + std::to_string(i);
        text += object + ", a1) = b" + std::to_string(i % 12 + 1) + "; ";
        text += object + ", a2) = b" + std::to_string((i + 4) % 12 + 1) + "; ";
    }
    return text;
}
// The CPF of `on` aggregates over the pair a1, a2; constants choose places.
Problem of_rows(const std::string& cpf_of_on, const std::string& more_cpfs = "") {
    return {.pvariables =
                "NEXT(obj, pair) : { non-fluent, obj };\n"
                "OPEN(obj, pair) : { non-fluent, bool, default = false };\n"
                "full(obj) : { state-fluent, bool, default = false };\n"
                "part(pair, obj) : { state-fluent, bool, default = false };\n"
                "v(obj) : { state-fluent, real, default = 0.0 };\n"
                "count(pair) : { state-fluent, int, default = 0 };\n"
                "meets(obj, pair) : { interm-fluent, bool };\n"
                "on(obj) : { state-fluent, bool, default = false };",
            .cpfs =
                "full'(?x) = full(?x);\npart'(?p, ?x) = part(?p, ?x);\nv'(?x) = v(?x);\n"
                "count'(?p) = count(?p);\non'(?x) = " +
                cpf_of_on + ";" + more_cpfs,
            .non_fluents = "OPEN(b2, a1); OPEN(b3, a2);" + rings()};
}
ir::Program with_rows(const std::string& cpf_of_on, passes::Report& report) {
    const Problem problem = of_rows(cpf_of_on, "\nmeets(?x, ?p) = OPEN(?x, ?p);");
    return valid(passes::read_rows(grounded_with_twelve(problem), report));
}
// The loop that fills `on`.
std::string loop_of_on(const ir::Program& program) {
    const std::string text = step_text(program);
    const std::size_t store = text.find("next.on["), begin = text.rfind("for x", store);
    return text.substr(begin, text.find('\n', store) - begin);
}

TEST(ReadRows, ReadsTermsByRowsOfPlaces) {
    passes::Report report;
    const ir::Program program =
        with_rows("exists_{?p : pair} [OPEN(?x, ?p) & full(NEXT(?x, ?p)) & part(?p, ?x)]", report);
    EXPECT_EQ(loop_of_on(program),
              "for x in obj, as words\n"
              "    next.on[x] = exists[p in pair](on-row[p, x] && "
              "element(state.full, on-places[p, x]) && state.part[p, x])");
    EXPECT_EQ(report["loops that read bools in rows"], 1);
}
TEST(ReadRows, ChoosesTheRowByOtherIndices) {
    passes::Report report;
    const ir::Program program =
        with_rows("[forall_{?p : pair} [~part(?p, NEXT(?x, ?p))]] | full(?x)", report);
    EXPECT_EQ(loop_of_on(program),
              "for x in obj, as words\n"
              "    next.on[x] = forall[p in pair](!element(state.part[p], on-places[p, x])) || "
              "state.full[x]");
}
TEST(ReadRows, LeavesOtherLoops) {
    for (const std::string cpf : {"exists_{?p : pair} [v(?x) > 1.0 & full(NEXT(?x, ?p))]",
                                  "exists_{?p : pair} [count(?p) == 1 & v(NEXT(?x, ?p)) > 1.0]",
                                  "exists_{?p : pair} [Bernoulli(0.5) & full(NEXT(?x, ?p))]",
                                  "(sum_{?p : pair} [full(NEXT(?x, ?p))]) > 1", "full(?x)"}) {
        passes::Report report;
        with_rows(cpf, report);
        EXPECT_EQ(report["loops that read bools in rows"], 0) << cpf;
    }
}

// `meets` is read by columns: the object of the loop is its first parameter.
ir::Program turned(const std::string& cpf_of_on, const std::string& cpf_of_meets,
                   passes::Report& report) {
    const Problem problem = of_rows(cpf_of_on, "\nmeets(?x, ?p) = " + cpf_of_meets + ";");
    return valid(passes::turn_tables(grounded_with_twelve(problem), report));
}
TEST(TurnTables, StoresColumnsAsRows) {
    passes::Report report;
    const std::string text = step_text(turned("exists_{?p : pair} [meets(?x, ?p) & ~part(?p, ?x)]",
                                              "full(?x) | count(?p) == 1", report));
    EXPECT_EQ(report["tables stored by columns"], 1);
    EXPECT_NE(text.find("for p in pair\n"
                        "    for x in obj, several at once\n"
                        "        scratch.meets-turned[p, x] = state.full[x] || "
                        "state.count[p] == 1\n"),
              std::string::npos)
        << text;
    EXPECT_NE(text.find("exists[p in pair](scratch.meets-turned[p, x] && !state.part[p, x])"),
              std::string::npos)
        << text;
}
TEST(TurnTables, LeavesTablesThatAreReadInOtherWays) {
    for (const auto& [on, meets] :
         {std::pair{"exists_{?p : pair} [meets(NEXT(?x, ?p), ?p)]", "full(?x) | count(?p) == 1"},
          std::pair{"exists_{?p : pair} [meets(?x, ?p)]", "full(NEXT(?x, ?p))"},
          std::pair{"exists_{?p : pair} [meets(?x, ?p)]", "Bernoulli(0.5)"}}) {
        passes::Report report;
        turned(on, meets, report);
        EXPECT_EQ(report["tables stored by columns"], 0) << on;
    }
}

}  // namespace
}  // namespace rddlc
