// Properties of whole emitted files. What they look like is shown by tests/cases and generated/.
#include "emitted.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

namespace rddlc {
namespace {

// A problem over `count` objects whose non-fluent W has a different value for each.
std::string problem(int count) {
    std::string objects, values;
    for (int i = 0; i < count; ++i) {
        objects += (i > 0 ? ", o" : "o") + std::to_string(i);
        values += "W(o" + std::to_string(i) + ") = " + std::to_string(i) + ".5; ";
    }
    return "domain d { types { o : object; }; pvariables {\n"
           "W(o) : { non-fluent, real, default = 0.0 };\n"
           "on(o) : { state-fluent, bool, default = false };\n"
           "a(o) : { action-fluent, bool, default = false };\n"
           "}; cpfs {\n"
           "on'(?o) = on(?o) ^ Bernoulli(0.5) | a(?o);\n"
           "}; reward = sum_{?o : o} [W(?o) * on(?o)]; }\n"
           "non-fluents n { domain = d; objects { o : {" +
           objects + "}; }; non-fluents { " + values +
           "}; }\n"
           "instance i { domain = d; non-fluents = n; horizon = 5; discount = 1.0; }\n";
}

std::size_t widest_line(const std::string& text) {
    std::istringstream stream(text);
    std::size_t width = 0;
    for (std::string line; std::getline(stream, line);) width = std::max(width, line.size());
    return width;
}

// From "struct Simulator" to its end.
std::string functions(const std::string& text) {
    const std::size_t begin = text.find("struct Simulator");
    return text.substr(begin, text.find("\n};\n", begin) - begin);
}

std::size_t count(const std::string& text, const std::string& part) {
    std::size_t result = 0;
    for (std::size_t at = 0; (at = text.find(part, at)) != std::string::npos; ++at) ++result;
    return result;
}

TEST(EmittedText, IsTheSameEveryTime) {
    EXPECT_EQ(emitted(problem(5)), emitted(problem(5)));
}

TEST(EmittedText, HasFunctionsThatDoNotGrowWithTheObjects) {
    const std::string few = functions(emitted(problem(200)));
    const std::string many = functions(emitted(problem(20'000)));
    EXPECT_EQ(few, many) << "counts and tables stand before the functions";
}

TEST(EmittedText, WrapsLargeTables) {
    const std::string text = emitted(problem(100'000));
    EXPECT_LE(widest_line(text), 100u);
    EXPECT_NE(text.find("99999.5\n};"), std::string::npos);
}

TEST(EmittedText, LaysOutTheStepForModerateValues) {
    std::string sparse = problem(20);
    sparse.replace(sparse.find("a(o) : { action-fluent, bool, default = false }"), 47,
                   "L(o, o) : { non-fluent, bool, default = false }; a(o) : { action-fluent, real, "
                   "default = 0.0 }; heat(o) : { state-fluent, real, default = 0.0 }");
    sparse.replace(sparse.find("on'(?o) = on(?o) ^ Bernoulli(0.5) | a(?o);"), 42,
                   "on'(?o) = on(?o); "
                   "heat'(?o) = heat(?o) / 2 + (sum_{?p : o} [L(?p, ?o) * (a(?p) + heat(?p))]);");
    sparse.replace(sparse.find("W(o0) ="), 7, "L(o1, o2) = true; L(o2, o4) = true; W(o0) =");
    const std::string text = emitted(sparse);
    EXPECT_NE(text.find("        return rddl::is_moderate<L>(action.a) && "
                        "rddl::is_moderate<L>(state.heat);\n"),
              std::string::npos)
        << text;
    EXPECT_LE(widest_line(text), 100u);
    const std::string floats = emitted(sparse, {}, {}, RealType::Float);
    EXPECT_LE(widest_line(floats), 100u);
    EXPECT_EQ(count(floats, "std::array<float, o_count> W_ = {"), 1u)
        << "the simulator's own table serves";
}

// One environment has the rooms in registers, where each has the terms of all.
TEST(EmittedText, LeavesSparseRowsToPacksWhereObjectsShareRegisters) {
    const std::string rooms =
        "domain d { types { o : object; }; pvariables {\n"
        "L(o, o) : { non-fluent, real, default = 0.0 };\n"
        "heat(o) : { state-fluent, real, default = 0.0 };\n"
        "a(o) : { action-fluent, real, default = 0.0 };\n"
        "}; cpfs {\n"
        "heat'(?o) = heat(?o) + a(?o) + Normal(0.0, 1.0)\n"
        "          + (sum_{?p : o} [L(?o, ?p) * (heat(?p) - heat(?o)) / 1.5]);\n"
        "}; reward = sum_{?o : o} [heat(?o)]; }\n"
        "non-fluents n { domain = d; objects { o : {o0, o1, o2, o3, o4, o5}; }; non-fluents {\n"
        "L(o0, o1) = 0.5; L(o0, o3) = 0.5; L(o1, o0) = 0.5; L(o1, o2) = 0.5; L(o1, o4) = 0.5;\n"
        "L(o2, o1) = 0.5; L(o2, o5) = 0.5; L(o3, o0) = 0.5; L(o3, o4) = 0.5; L(o4, o1) = 0.5;\n"
        "L(o4, o3) = 0.5; L(o4, o5) = 0.5; L(o5, o2) = 0.5; L(o5, o4) = 0.5; }; }\n"
        "instance i { domain = d; non-fluents = n; horizon = 5; discount = 1.0; }\n";
    const std::string text = emitted(rooms);
    EXPECT_EQ(count(text, "using Engine = rddl::Compiled<Simulator, about::problem>;"), 1u) << text;
    EXPECT_EQ(count(text, "using Packed = rddl::Packed<FastSimulator, about::problem, 16>;"), 1u);
    EXPECT_EQ(count(emitted(rooms, {.lane_count = 1}), "FastSimulator"), 0u);
}

// clang and g++ compute constants with so many steps and no more.
TEST(EmittedText, LeavesLargeRecordsToTheStartOfThePrograms) {
    const auto with_actions = [](int count) {
        std::string text = problem(count);
        text.replace(text.find("a(o) : { action-fluent, bool, default = false }"), 47,
                     "a(o) : { action-fluent, real, default = 1.5 }");
        text.replace(text.find("on(?o) ^ Bernoulli(0.5) | a(?o)"), 31, "on(?o) ^ (a(?o) > 1.0)");
        return text.replace(text.find("reward ="), 8,
                            "action-preconditions { forall_{?o : o} [a(?o) <= 2.0]; }; reward =");
    };
    const std::string few = emitted(with_actions(1'000));
    EXPECT_EQ(count(few, "made_at_start"), 0u);
    EXPECT_EQ(count(few, "inline constexpr Action<rddl::Scalar> default_action = [] {"), 1u);
    const std::string many = emitted(with_actions(100'001));
    EXPECT_EQ(count(many, "a_upper = rddl::made_at_start(rddl::repeated<100001>, 2.0);"), 1u);
    EXPECT_EQ(count(many, "default_action = rddl::made_at_start([] {"), 1u);
}

// The probabilities are 0.5, 1.5, ... divided by 10.
TEST(EmittedText, ChecksOnlyProbabilitiesThatMayBeNone) {
    const auto with_chances = [](int count) {
        std::string text = problem(count);
        return emitted(text.replace(text.find("Bernoulli(0.5)"), 14, "Bernoulli(W(?o) / 10)"));
    };
    EXPECT_EQ(count(with_chances(10), "::valid_bernoulli("), 1u) << "0.95 is the greatest";
    EXPECT_EQ(count(with_chances(11), "::bernoulli("), 1u) << "1.05 is the greatest";
    std::string rounded = problem(10);
    rounded.replace(rounded.find("Bernoulli(0.5)"), 14, "Bernoulli(W(?o) / 9.4999999999999982)");
    EXPECT_EQ(count(emitted(rounded), "::valid_bernoulli("), 1u) << "1 + 2e-16 is the greatest";
}

TEST(EmittedText, SaysWhichDrawsAreThoseOfTwoObjects) {
    const auto with_chances = [](int count) {
        std::string text = problem(count);
        return emitted(text.replace(text.find("Bernoulli(0.5)"), 14, "Bernoulli(W(?o) / 10)"));
    };
    EXPECT_EQ(count(with_chances(2), "::valid_bernoulli(context, rddl::PlaceAmong<o_count>{"), 1u);
    EXPECT_EQ(count(with_chances(3), "PlaceAmong"), 0u);
}

TEST(EmittedText, SaysWhereTablesChooseTheObjectsThatDraw) {
    const auto with_condition = [](const std::string& condition) {
        std::string text = problem(5);
        text.replace(text.find("a(o) :"), 0, "v(o) : { state-fluent, real, default = 0.5 };\n");
        text.replace(text.find("}; reward"), 0,
                     "v'(?o) = if (" + condition + ") then Normal(0.0, 1.0) else v(?o);\n");
        return emitted(text);
    };
    EXPECT_EQ(count(with_condition("W(?o) > 2.0"), "rddl::PlaceAmongSome<o_count>{"), 1u)
        << with_condition("W(?o) > 2.0");
    EXPECT_EQ(count(with_condition("on(?o)"), "rddl::PlaceAmong<o_count>{"), 1u);
}

// Loops over up to eight objects draw together with what is drawn once; branches do not.
TEST(EmittedText, MakesTheNumbersOfCertainDrawsTogether) {
    const auto with_objects = [](int count, const std::string& chance_of_c) {
        std::string text = problem(count);
        text.replace(text.find("a(o) :"), 0,
                     "v(o) : { state-fluent, real, default = 0.5 };\n"
                     "c : { state-fluent, bool, default = false };\n");
        text.replace(text.find("on(?o) ^ Bernoulli(0.5) | a(?o)"), 31,
                     "Bernoulli(min[max[v(?o), 0.1], 0.9])");
        text.replace(text.find("}; reward"), 0, "v'(?o) = v(?o) / 2;\nc' = " + chance_of_c + ";\n");
        return emitted(text);
    };
    const std::string drawn = with_objects(5, "Bernoulli(0.25)");
    EXPECT_EQ(count(drawn,
                    "step_draws = {\n"
                    "    rddl::counters_of_loop(1),\n"
                    "    rddl::counters_of_draws({{0, 0}}),\n"
                    "};"),
              1u)
        << drawn;
    EXPECT_EQ(count(drawn, "const rddl::StepNumbers<L, step_draws> numbers(context);"), 1u);
    EXPECT_EQ(count(drawn, "rddl::place_in_row<0>(numbers, 1, o)"), 1u);
    EXPECT_EQ(count(drawn, "rddl::place_in_lane<1, 0>(numbers, 0, 0)"), 1u);
    EXPECT_EQ(count(with_objects(5, "if (c) then Bernoulli(0.25) else false"), "StepNumbers"), 0u);
    EXPECT_EQ(count(with_objects(5, "~c"), "StepNumbers"), 0u)
        << "one row is made where it is used";
    EXPECT_EQ(count(with_objects(9, "Bernoulli(0.25)"), "StepNumbers"), 0u);
}

// Conditions on the state may leave all objects out, and floats are made where they are used.
TEST(EmittedText, MakesTheNormalsOfSeveralLoopsTogether) {
    const auto with_noise = [](int count, const std::string& second,
                               RealType real = RealType::Double) {
        std::string text = problem(count);
        text.replace(text.find("a(o) :"), 0,
                     "v(o) : { state-fluent, real, default = 0.5 };\n"
                     "w(o) : { state-fluent, real, default = 0.5 };\n");
        text.replace(text.find("}; reward"), 0,
                     "v'(?o) = v(?o) + Normal(0.0, 1.0);\nw'(?o) = " + second + ";\n");
        return emitted(text, {}, {}, real);
    };
    const std::string drawn = with_noise(5, "Normal(w(?o), 2.0)");
    EXPECT_EQ(count(drawn,
                    "step_normals = {\n"
                    "    rddl::LoopOfNormals{1, o_count},\n"
                    "    rddl::LoopOfNormals{2, o_count},\n"
                    "};"),
              1u)
        << drawn;
    EXPECT_EQ(count(drawn, "const rddl::StepNormals<L, step_normals> normals(context);"), 1u);
    EXPECT_EQ(count(drawn, "rddl::place_of_normals<1>(normals,"), 1u);
    const std::string chosen = "if (W(?o) > 2.0) then Normal(w(?o), 2.0) else 0.5";
    EXPECT_EQ(count(with_noise(5, chosen), "rddl::place_of_normals<1>(normals,"), 1u);
    EXPECT_EQ(count(with_noise(5, "if (on(?o)) then Normal(w(?o), 2.0) else 0.5"), "StepNormals"),
              0u);
    EXPECT_EQ(count(with_noise(5, "w(?o) / 2.0"), "StepNormals"), 0u) << "one loop alone";
    EXPECT_EQ(count(with_noise(300, "Normal(w(?o), 2.0)"), "StepNormals"), 0u)
        << "they leave the nearest cache";
    EXPECT_EQ(count(with_noise(5, "Normal(w(?o), 2.0)", RealType::Float), "StepNormals"), 0u);
}

// A loop that visits its objects one by one is worth a row alone. Both branches make the draw.
TEST(EmittedText, MakesTheNumbersOfAPlainLoopTogether) {
    const auto with_objects = [](int count) {
        std::string text = problem(count);
        text.replace(text.find("a(o) :"), 0,
                     "v(o) : { state-fluent, int, default = 0 };\n"
                     "t : { state-fluent, int, default = 0 };\n");
        text.replace(text.find("on(?o) ^ Bernoulli(0.5) | a(?o);"), 32,
                     "a(?o); t' = t + 1;\n"
                     "v'(?o) = min[floor[8.0 * sin[t + W(?o)] + Bernoulli(0.5)], 5];\n");
        return emitted(text);
    };
    EXPECT_EQ(count(with_objects(4), "rddl::place_in_row<0>(numbers, 0, o)"), 2u);
    for (const int few : {2, 5})
        EXPECT_EQ(count(with_objects(few), "StepNumbers"), 0u) << "packs know a better way";
}

// Two of 17 at most. The others keep their bools, and draw nothing.
TEST(EmittedText, ComputesTheObjectsThatAnActionChooses) {
    std::string text = problem(17);
    const std::string cpf = "on(?o) ^ Bernoulli(0.5) | a(?o)";
    text.replace(text.find(cpf), cpf.size(),
                 "if (a(?o)) then Bernoulli(if (on(?o)) then W(?o) / 20 else 0.5) else on(?o)");
    EXPECT_EQ(count(emitted(text), "rddl::for_chosen_objects<"), 0u);
    text.replace(text.find("horizon"), 0, "max-nondef-actions = 2; ");
    EXPECT_EQ(
        count(emitted(text),
              "        rddl::for_chosen_objects<o_count>(\n"
              "            context, action.a, state.on, next.on, [&](auto& several, auto o) {\n"),
        1u);
}

// Half of them at most. Their draws wait for the action, and the loop reads them.
TEST(EmittedText, DrawsForTheObjectsThatAnActionChooses) {
    std::string text = problem(17);
    text.replace(text.find("a(o) :"), 0, "stock(o) : { state-fluent, int, default = 0 };\n");
    const std::string cpf = "on(?o) ^ Bernoulli(0.5) | a(?o);";
    text.replace(text.find(cpf), cpf.size(),
                 "a(?o); stock'(?o) = if (a(?o) ^ Bernoulli(0.5)) then 2 else if (on(?o)) then 3\n"
                 "else if (Bernoulli(0.25)) then 1 else stock(?o);");
    EXPECT_EQ(count(emitted(text), "rddl::for_chosen_objects<"), 0u);
    text.replace(text.find("horizon"), 0, "max-nondef-actions = 8; ");
    EXPECT_EQ(count(emitted(text),
                    "        rddl::for_chosen_objects<o_count>(\n"
                    "            context, action.a, scratch.a_draws, [&](auto& several, auto o) "
                    "{\n"),
              1u);
}

TEST(EmittedText, RoundsRealsWithoutInts) {
    std::string text = problem(2);
    const std::string reward = "sum_{?o : o} [W(?o) * on(?o)]";
    text.replace(text.find(reward), reward.size(), "floor[(sum_{?o : o} [W(?o) * on(?o)])] * 0.5");
    EXPECT_EQ(count(emitted(text), "rddl::floor_as_real("), 1u);
    EXPECT_EQ(count(emitted(text, {}, {}, RealType::Float), "rddl::floor_as_real("), 1u);
}

TEST(EmittedText, IncludesNothingButTheRuntimeAndTheStandardLibrary) {
    std::istringstream stream(emitted(problem(3)));
    for (std::string line; std::getline(stream, line);) {
        if (!line.starts_with("#include")) continue;
        const bool standard =
            line.find('/') == std::string::npos && line.find(".h") == std::string::npos;
        EXPECT_TRUE(line == "#include <rddl/simulator.hpp>" || standard) << line;
    }
}

TEST(EmittedText, ExportsOneFunctionFromASource) {
    const std::string text = emitted(problem(3));
    EXPECT_EQ(count(text, "extern \"C\" RDDL_EXPORT const rddl_simulator* RDDL_ENTRY(void)"), 1u);
    EXPECT_EQ(count(text, "#define RDDL_ENTRY rddl_simulator_d_i"), 1u);
    EXPECT_EQ(count(text, "#pragma once"), 0u);
}

TEST(EmittedText, ExportsNothingFromAHeader) {
    const std::string text = emitted(problem(3), {.header = true});
    EXPECT_EQ(count(text, "extern \"C\""), 0u);
    EXPECT_EQ(count(text, "#pragma once"), 1u);
    EXPECT_EQ(count(text, "namespace {"), 0u) << "a header has no unnamed namespace";
}

TEST(EmittedText, HasLineDirectivesOnRequest) {
    EXPECT_EQ(count(emitted(problem(3)), "#line"), 0u);
    const std::string text =
        emitted(problem(3), {.line_directives = true, .output_name = "sim.cpp"});
    EXPECT_GT(count(text, "#line 6 \"problem.rddl\"\n            next.on[o]"), 0u) << text;
    // After each function, the text is itself again.
    std::istringstream stream(text);
    int number = 1;
    for (std::string line; std::getline(stream, line); ++number) {
        if (!line.ends_with("\"sim.cpp\"")) continue;
        EXPECT_EQ(line, "#line " + std::to_string(number + 1) + " \"sim.cpp\"");
    }
}

TEST(EmittedText, CannotBeBrokenByNamesOfFiles) {
    Sources sources;
    Diagnostics diagnostics;
    const FileId file = sources.add("a\n#error \"\\", problem(2));
    const ast::Program tree = parse(sources, std::array{file}, diagnostics);
    const auto model = check(tree, sources, diagnostics);
    const std::string text = emit(optimise(ground(*model, diagnostics).value()), sources, {});
    EXPECT_EQ(count(text, "\n#error"), 0u);
    EXPECT_EQ(count(text, "\\\n"), 0u) << "no line goes on in the next";
}

// Sums of hundreds of terms, and brackets in brackets: neither recursion nor time gets out of hand.
TEST(EmittedText, ManagesLongAndDeepExpressions) {
    std::string sum = "on(o0)", nested = "on(o0)";
    for (int i = 1; i < 450; ++i) sum += " + on(o0) * " + std::to_string(i);
    for (int i = 1; i < 100; ++i) {
        nested = "(if (" + nested + ") then Bernoulli(0.5) else on(o0))";
    }
    std::string text = problem(2);
    text.replace(text.find("sum_"), 4, sum + " + sum_");
    text.replace(text.find("on(?o) ^ B"), 6, nested);
    // Objects cannot be named in a domain: index by a fluent instead.
    for (std::size_t at; (at = text.find("on(o0)")) != std::string::npos;) {
        text.replace(at, 6, "up");
    }
    text.replace(text.find("a(o) :"), 0, "up : { state-fluent, bool, default = true };\n");
    text.replace(text.find("on'(?o)"), 0, "up' = ~up;\n");
    const std::string result = emitted(text);
    EXPECT_LT(result.size(), 1'000'000u);
}

// Packs compute an argmin in each lane, even if only constants decide it: it cannot be an index in
// brackets.
TEST(EmittedText, IndexesByLanesWhatAnAggregationChooses) {
    std::string text = problem(9);
    text.replace(text.find("sum_"), 4, "W(argmin_{?c : o} [W(?c)]) + sum_");
    PassOptions passes;
    for (const PassDescription& pass : all_passes()) passes.without.emplace(pass.name);
    const std::string result = emitted(text, {}, passes);
    EXPECT_EQ(count(result, "rddl::at(W_, best)"), 1u) << functions(result);
    EXPECT_EQ(count(result, "W_[best]"), 0u);
}

}  // namespace
}  // namespace rddlc
