#include "ast/equal.hpp"
#include "ast/print.hpp"
#include "parsed.hpp"

#include <gtest/gtest.h>

namespace rddlc {
namespace {

// Parses the printed text again and compares.
void expect_round_trip(const Parsed& parsed, Standard standard = Standard::PyRddlGym) {
    ASSERT_FALSE(parsed.diagnostics.has_errors()) << parsed.report();
    const std::string text = ast::print(parsed.program);
    const Parsed again = parse_text(text, standard);
    ASSERT_FALSE(again.diagnostics.has_errors()) << again.report();
    EXPECT_TRUE(ast::equal(parsed.program, again.program)) << text;
    EXPECT_EQ(ast::print(again.program), text);
}

TEST(RoundTrip, KeepsEverything) {
    expect_round_trip(parse_files({sample_domain, sample_instance}));
    expect_round_trip(parse_text(sample_instance + sample_domain));
}

TEST(RoundTrip, KeepsExtensions) {
    const std::string text =
        "domain d { reward = atan2[y, 1e-3] + 2.5E+10 * x; }"
        "instance i { init-state { q; p(a) = Normal(M(a) - 1, 1e0); r = 3;"
        " s = Discrete(t, @a : 0.5, b : 0.5); o = UnnormDiscrete_{?x : t} W(?x) + 1; };"
        " horizon = pos-inf; discount = 1; }";
    expect_round_trip(parse_text(text, Standard::Rddlc), Standard::Rddlc);
}

TEST(RoundTrip, KeepsExpressionsThatNeedSeveralLines) {
    const std::string name(50, 'n');
    for (const std::string& expression : {
             name + " + " + name + " * " + name + " - " + name,
             "if (" + name + ") then " + name + " else if (a) then [" + name + " | " + name +
                 "] else sum_{?x : t} " + name,
             "switch (" + name + ") { case @a : " + name + ", default : " + name + " }",
             "Discrete(t, @a : " + name + ", b : " + name + " + (" + name + "))",
             "Discrete_{?x : t} " + name + " + sum_{?y : t, ?z : t} " + name + "(?y, ?z)",
             "a - -b - (" + name + " - " + name + ")",
         })
        expect_round_trip(parse_reward(expression));
}

TEST(RoundTrip, PrintsReadableText) {
    const Parsed parsed = parse_text(
        "domain d{types{t:object;};pvariables{p(t):{state-fluent,bool,default=false};};"
        "cpfs{p'(?x)=if(p(?x))then true else Bernoulli(0.5);};reward=sum_{?x:t}p(?x);}"
        "instance i{domain=d;objects{t:{a,b};};init-state{p(a);~p(b);};horizon=3;discount=1.0;}");
    EXPECT_EQ(ast::print(parsed.program), R"(domain d {
    types {
        t : object;
    };
    pvariables {
        p(t) : { state-fluent, bool, default = false };
    };
    cpfs {
        p'(?x) = if (p(?x)) then true else Bernoulli(0.5);
    };
    reward = sum_{?x : t} p(?x);
}
instance i {
    domain = d;
    objects {
        t : {a, b};
    };
    init-state {
        p(a);
        ~p(b);
    };
    horizon = 3;
    discount = 1.0;
}
)");
}

TEST(RoundTrip, PutsLongExpressionsOnSeveralLines) {
    const Parsed parsed = parse_text(
        "domain d { cpfs { x' = if (first_condition ^ second_condition) then first_value + 1 "
        "else if (third_condition) then sum_{?x : t} second_value(?x) * rather_long_name(?x) + "
        "another_rather_long_name(?x) * yet_another_name(?x) else 0; }; }");
    EXPECT_EQ(ast::print(parsed.program), R"(domain d {
    cpfs {
        x' =
            if (first_condition ^ second_condition)
            then first_value + 1
            else if (third_condition)
            then sum_{?x : t}
                    second_value(?x) * rather_long_name(?x)
                    + another_rather_long_name(?x) * yet_another_name(?x)
            else 0;
    };
}
)");
}

TEST(Equal, SeesEveryDifference) {
    const char* const texts[] = {
        "a",
        "a'",
        "a(?x)",
        "@a",
        "?a",
        "1",
        "1.0",
        "1.00",
        "true",
        "false",
        "(a)",
        "[a]",
        "a ^ b",
        "a & b",
        "a | b",
        "-a",
        "~a",
        "f[a]",
        "f[a, b]",
        "g[a]",
        "sum_{?x : t} a",
        "sum_{?x : u} a",
        "sum_{?y : t} a",
        "prod_{?x : t} a",
        "if (a) then b else c",
        "if (a) then c else b",
        "Normal(0, 1)",
        "Normal(1, 0)",
        "Gamma(0, 1)",
        "Discrete(t, @a : 1)",
        "Discrete(t, a : 1)",
        "UnnormDiscrete(t, a : 1)",
        "Discrete_{?x : t} 1",
        "$f[_]",
        "$f[?x]",
        "$f[@x]",
        "$f[_](a)",
        "switch (a) { case @a : 1 }",
        "switch (a) { default : 1 }",
        "det_{?x : t, ?y : t} a",
        "inverse[row = ?x, col = ?y][a]",
        "pinverse[row = ?x, col = ?y][a]",
    };
    std::vector<Parsed> all;
    for (const char* text : texts) all.push_back(parse_reward(text));
    for (std::size_t i = 0; i < all.size(); ++i)
        for (std::size_t j = 0; j < all.size(); ++j)
            EXPECT_EQ(ast::equal(all[i].program, all[j].program), i == j)
                << texts[i] << " and " << texts[j];
}

}  // namespace
}  // namespace rddlc
