#include "passes/lanes/read_places.hpp"

#include "texts.hpp"

#include <string>

namespace rddlc {
namespace {

// Nine pairs of objects of a ring; the CPF of `on` is given.
Problem of_ring(const std::string& cpf_of_on) {
    return {.pvariables =
                "NEXT(obj) : { non-fluent, obj };\n"
                "OPEN(obj) : { non-fluent, bool, default = false };\n"
                "P(obj) : { non-fluent, real, default = 0.5 };\n"
                "on(obj, obj) : { state-fluent, bool, default = false };\n"
                "v(obj) : { state-fluent, real, default = 0.0 };\n"
                "a(obj) : { action-fluent, bool, default = false };",
            .cpfs = "on'(?x, ?y) = " + cpf_of_on + ";\nv'(?x) = v(?x);",
            .non_fluents = "NEXT(b1) = b2; NEXT(b2) = b3; NEXT(b3) = b1; OPEN(b2); P(b3) = 0.25;"};
}

ir::Program with_places(const std::string& cpf_of_on) {
    passes::Report report;
    return valid(passes::read_places(grounded(of_ring(cpf_of_on)), report));
}
bool is_changed(const std::string& cpf_of_on) {
    passes::Report report;
    passes::read_places(grounded(of_ring(cpf_of_on)), report);
    return !report.empty();
}

const ir::Buffer& table_named(const ir::Program& program, const std::string& name) {
    for (const ir::Buffer& buffer : program.buffers)
        if (buffer.name == name) return buffer;
    throw std::runtime_error("no table " + name);
}

TEST(ReadPlaces, TakesTheElementsThatConstantsChoose) {
    const ir::Program program = with_places("a(NEXT(?y)) & OPEN(?x)");
    EXPECT_EQ(step_text(program),
              "for x in obj, several at once\n"
              "    for y in obj\n"
              "        next.on[x, y] = element(action.a, on-places[x, y]) && on-table[x, y]\n"
              "for x in obj\n"
              "    next.v[x] = state.v[x]\n");
    const ir::Buffer& places = table_named(program, "on-places");
    EXPECT_TRUE(places.holds_places);
    EXPECT_EQ(places.values.dense(),
              (std::vector<ir::Value>{std::int64_t{1}, std::int64_t{2}, std::int64_t{0},
                                      std::int64_t{1}, std::int64_t{2}, std::int64_t{0},
                                      std::int64_t{1}, std::int64_t{2}, std::int64_t{0}}));
}

TEST(ReadPlaces, TakesElementsOfOtherPairsAndConstantsOfDraws) {
    EXPECT_EQ(step_text(with_places("if (on(?y, NEXT(?x))) then Bernoulli(P(?y)) else on(?x, ?y)")),
              "for x in obj, several at once\n"
              "    for y in obj\n"
              "        next.on[x, y] = select(element(state.on, on-places[x, y]), "
              "sample bernoulli@0[x * 3 + y](on-table[x, y]), state.on[x, y])\n"
              "for x in obj\n"
              "    next.v[x] = state.v[x]\n");
}

// The last three dimensions of `given` are the objects of the loop, so its elements are rows.
TEST(ReadPlaces, TakesTheTermsOfAnExistsOverFewObjects) {
    const Problem problem{
        .pvariables =
            "in(obj, obj, obj) : { state-fluent, bool, default = false };\n"
            "given(obj, obj, obj, obj) : { action-fluent, bool, default = false };",
        .cpfs = "in'(?x, ?y, ?z) = exists_{?w : obj} [in(?y, ?w, ?w) & given(?w, ?x, ?y, ?z)];"};
    passes::Report report;
    EXPECT_EQ(step_text(valid(passes::read_places(grounded(problem), report))),
              "for x in obj, several at once\n"
              "    for y in obj\n"
              "        for z in obj\n"
              "            next.in[x, y, z] = element(state.in, in-places[x, y, z]) && "
              "action.given[0, x, y, z] || element(state.in, in-places-2[x, y, z]) && "
              "action.given[1, x, y, z] || element(state.in, in-places-3[x, y, z]) && "
              "action.given[2, x, y, z]\n");
}

// Three of the outer one, nine of the inner one.
TEST(ReadPlaces, TakesAllTermsOrNone) {
    const Problem problem{
        .pvariables =
            "in(obj, obj, obj) : { state-fluent, bool, default = false };\n"
            "a(obj) : { action-fluent, bool, default = false };",
        .cpfs = "in'(?x, ?y, ?z) = exists_{?w : obj, ?u : obj} [a(?w) & ~a(?u)];"};
    passes::Report report;
    passes::read_places(grounded(problem), report);
    EXPECT_TRUE(report.empty());
}

TEST(ReadPlaces, LeavesWhatTheStepDecidesAndWhatIsThereAlready) {
    for (const char* cpf :
         {"on(?x, ?y) | a(?x) & v(?y) > 2.0", "on(?x, ?y)",
          "exists_{?z : obj} [on(?z, ?y) & v(?z) > 0.0]", "Poisson(2.0) > 3 | a(NEXT(?y))"})
        EXPECT_FALSE(is_changed(cpf)) << cpf;
}

}  // namespace
}  // namespace rddlc
