// A domain without an instance: what is reported, and what is not, for lack of objects and values.
#include "checking.hpp"

#include <gtest/gtest.h>

namespace rddlc::testing {
namespace {

// "E0203 W0202", in the order of positions.
std::string codes_alone(std::string text, Standard standard = Standard::PyRddlGym) {
    Checked checked;
    const std::vector<FileId> files{checked.sources.add("domain.rddl", std::move(text))};
    const ast::Program program = parse(checked.sources, files, checked.diagnostics, standard);
    if (!checked.diagnostics.has_errors()) {
        EXPECT_TRUE(is_domain_alone(program));
        check_domain(program, checked.sources, checked.diagnostics, standard);
    }
    checked.diagnostics.sort_by_position();
    return checked.codes();
}

std::string domain(const std::string& pvariables, const std::string& cpfs,
                   const std::string& after = "") {
    return "domain d { types { o : object; p : object; c : { @red, @blue }; };\n pvariables { " +
           pvariables + " x : { state-fluent, real, default = 0.0 }; };\n cpfs { " + cpfs +
           " };\n reward = x; }\n" + after;
}

TEST(DomainAlone, KnowsWhatHasAnInstance) {
    Sources sources;
    Diagnostics diagnostics;
    const auto parsed = [&](std::string text) {
        const std::vector<FileId> files{sources.add("x.rddl", std::move(text))};
        return parse(sources, files, diagnostics);
    };
    EXPECT_TRUE(is_domain_alone(parsed(domain("", "x' = x;"))));
    EXPECT_FALSE(is_domain_alone(parsed("non-fluents n { domain = d; }")));
    EXPECT_FALSE(is_domain_alone(
        parsed(domain("", "x' = x;") + "instance i { domain = d; horizon = 3; discount = 1.0; }")));
}

TEST(DomainAlone, NeedsNeitherObjectsNorValues) {
    EXPECT_EQ(codes_alone(domain("W(o) : { non-fluent, real }; y(o, p) : { state-fluent, bool };"
                                 "owner : { non-fluent, o };",
                                 "y'(?o, ?p) = Bernoulli(W(?o)) ^ (owner == ?o);"
                                 "x' = (max_{?o : o} W(?o)) + (exists_{?p : p, ?o : o} y(?o, ?p))"
                                 " + det_{?o : o, ?p : p} [W(?o)];")),
              "");
}

TEST(DomainAlone, ReportsWhatTheDomainSays) {
    EXPECT_EQ(codes_alone(domain("", "x' = y;")), "E0201");
    EXPECT_EQ(codes_alone(domain("W(o) : { non-fluent, real };", "x' = W;")), "E0203");
    EXPECT_EQ(codes_alone(domain("W(o) : { non-fluent, real };", "x' = sum_{?p : p} W(?p);")),
              "E0306");
    EXPECT_EQ(
        codes_alone(domain("y(o) : { state-fluent, int };", "y'(?o) = max_{?p : p} 0.5; x' = x;")),
        "E0307")
        << "an aggregation over unknown objects has a type";
    EXPECT_EQ(codes_alone(domain("y : { interm-fluent, c };", "y = @green; x' = x;")), "E0219");
    EXPECT_EQ(codes_alone(domain("y : { interm-fluent, real };", "x' = x;")), "E0401");
    EXPECT_EQ(codes_alone(domain("", "x' = x")), "E0102");
    EXPECT_EQ(codes_alone(domain("y : { interm-fluent, real }; z : { interm-fluent, real };",
                                 "y = z; z = y; x' = y;")),
              "E0407");
    EXPECT_EQ(
        codes_alone("domain d { pvariables { x : { state-fluent, real, default = 0.0 }; }; }"),
        "E0205 E0205");
}

TEST(DomainAlone, WarnsOfUnusedFluents) {
    const std::string text = domain("W : { non-fluent, real, default = 1.0 };", "x' = x;");
    EXPECT_EQ(codes_alone(text), "W0202");
    EXPECT_EQ(codes_alone(text, Standard::Rddlc), "") << "a random initial value may use it";
}

TEST(DomainAlone, UsesNonFluentsThatAreGiven) {
    const std::string text = domain("W(o) : { non-fluent, real };", "x' = sum_{?o : o} W(?o);");
    EXPECT_EQ(codes_alone(text + "non-fluents n { domain = d; objects { o : { a }; p : { b }; };"
                                 " non-fluents { W(a) = 1.0; }; }"),
              "");
    EXPECT_EQ(
        codes_alone(text + "non-fluents n { domain = d; objects { o : { a }; p : { b }; }; }"),
        "E0505");
    EXPECT_EQ(codes_alone(text + "non-fluents n { domain = d; objects { o : { a }; p : { b }; };"
                                 " non-fluents { W(b) = 1.0; }; }"),
              "E0502");
}

TEST(DomainAlone, ChecksThePolicyToo) {
    const std::string text = domain("push(o) : { action-fluent, bool, default = false };",
                                    "x' = sum_{?o : o} push(?o);");
    EXPECT_EQ(
        codes_alone(text + "policy q { pvariables { best : { param-fluent, o, default = first }; };"
                           " cpfs { push(?o) = (?o == best); }; }"),
        "");
    EXPECT_EQ(codes_alone(text + "policy q { cpfs { push(?o) = 1.5; }; }"), "E0307");
}

}  // namespace
}  // namespace rddlc::testing
