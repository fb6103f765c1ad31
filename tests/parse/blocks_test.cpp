// Domains and instances: which forms are read, and as what.
#include "parsed.hpp"

#include <gtest/gtest.h>

namespace rddlc {
namespace {

template <class Section>
const Section& section_of(const ast::Domain& domain, std::size_t index = 0) {
    std::size_t seen = 0;
    for (const ast::DomainSection& section : domain.sections)
        if (const auto* found = std::get_if<Section>(&section.node))
            if (seen++ == index) return *found;
    throw std::out_of_range("no such section");
}

TEST(Domain, IsRead) {
    const Parsed parsed = parse_text(sample_domain);
    ASSERT_FALSE(parsed.diagnostics.has_errors()) << parsed.report();
    const auto& domain = std::get<ast::Domain>(parsed.program.blocks.at(0));
    EXPECT_EQ(domain.name.text, "sample_mdp");
    EXPECT_EQ(section_of<ast::Requirements>(domain).names.at(0).text, "reward-deterministic");

    const auto& types = section_of<ast::Types>(domain).declarations;
    ASSERT_EQ(types.size(), 3u);
    EXPECT_FALSE(types[0].members);
    EXPECT_EQ(types[1].members->at(1).text, "2-high");
    EXPECT_TRUE(types[2].members->empty());

    const auto& pvariables = section_of<ast::PVariables>(domain).declarations;
    ASSERT_EQ(pvariables.size(), 11u);
    EXPECT_EQ(pvariables[0].parameters.at(1).text, "place");
    EXPECT_EQ(pvariables[0].kind.text, "non-fluent");
    EXPECT_EQ(std::get<ast::Real>(pvariables[1].default_value->value).value, -0.5);
    EXPECT_EQ(std::get<ast::Integer>(pvariables[2].default_value->value).value, -3);
    EXPECT_TRUE(std::holds_alternative<ast::PosInf>(pvariables[3].default_value->value));
    EXPECT_EQ(std::get<ast::Symbol>(pvariables[5].default_value->value).name, "low");
    EXPECT_EQ(pvariables[6].range.text, "place");
    EXPECT_FALSE(pvariables[6].default_value);
    EXPECT_TRUE(pvariables[7].level);

    EXPECT_EQ(section_of<ast::Cpfs>(domain).definitions.size(), 13u);
    EXPECT_EQ(section_of<ast::Constraints>(domain, 3).conditions.size(), 2u);
    EXPECT_EQ(section_of<ast::Constraints>(domain, 2).kind,
              ast::ConstraintKind::StateActionConstraints);
}

TEST(Domain, AcceptsTheOldKeywordAndAnyOrder) {
    const Parsed parsed =
        parse_text("domain d { reward = 1; cdfs { x' = 1; }; requirements { a, b }; types { }; };");
    ASSERT_FALSE(parsed.diagnostics.has_errors()) << parsed.report();
    const auto& domain = std::get<ast::Domain>(parsed.program.blocks.at(0));
    EXPECT_EQ(section_of<ast::Cpfs>(domain).keyword.text, "cdfs");
    EXPECT_EQ(section_of<ast::Requirements>(domain).names.size(), 2u);
}

TEST(Instance, IsRead) {
    const Parsed parsed = parse_text(sample_instance);
    ASSERT_FALSE(parsed.diagnostics.has_errors()) << parsed.report();
    ASSERT_EQ(parsed.program.blocks.size(), 3u);
    const auto& non_fluents = std::get<ast::NonFluents>(parsed.program.blocks[0]);
    const auto& values = std::get<ast::NonFluentValues>(non_fluents.sections.at(2).node);
    ASSERT_EQ(values.assignments.size(), 4u);
    EXPECT_FALSE(values.assignments[0].value);
    EXPECT_TRUE(values.assignments[1].negated);
    EXPECT_EQ(values.assignments[1].arguments.at(0).name, "c_3");
    EXPECT_TRUE(values.assignments[3].arguments.at(0).at_sign);
    EXPECT_EQ(parsed.sources.text(values.assignments[3].argument_spans.at(0)), "@low");

    const auto& instance = std::get<ast::Instance>(parsed.program.blocks[1]);
    ASSERT_EQ(instance.sections.size(), 10u);
    EXPECT_FALSE(std::get<ast::MaxNondefActions>(instance.sections[4].node).value);
    EXPECT_EQ(std::get<ast::MaxNondefActions>(instance.sections[5].node).value, 2);
    const auto horizon = [&](std::size_t i) -> const auto& {
        return std::get<ast::Horizon>(instance.sections[i].node).value;
    };
    EXPECT_EQ(std::get<ast::Integer>(horizon(6)).value, 40);
    EXPECT_TRUE(std::holds_alternative<ast::PosInf>(horizon(7)));
    EXPECT_TRUE(std::holds_alternative<ast::Expr>(horizon(8)));
    const auto& discount = std::get<ast::Discount>(instance.sections[9].node);
    EXPECT_EQ(std::get<ast::Real>(discount.value).value, 0.95);
}

TEST(Instance, AcceptsTheFormOf2018) {
    const Parsed parsed = parse_text(
        "instance i { domain = d; objects { t : { a }; }; non-fluents { P(a); }; "
        "init-state { q = 1; }; max-nondef-actions = 1; horizon = 3; discount = 1; }");
    ASSERT_FALSE(parsed.diagnostics.has_errors()) << parsed.report();
    const auto& instance = std::get<ast::Instance>(parsed.program.blocks.at(0));
    EXPECT_TRUE(std::holds_alternative<ast::NonFluentValues>(instance.sections.at(2).node));
}

TEST(Extensions, AreReadWhereAskedFor) {
    const Parsed parsed = parse_text(
        "instance i { init-state { q(a) = Uniform(-1e-3, .5E+1); }; horizon = pos-inf; "
        "discount = 1; }",
        Standard::Rddlc);
    ASSERT_FALSE(parsed.diagnostics.has_errors()) << parsed.report();
    const auto& instance = std::get<ast::Instance>(parsed.program.blocks.at(0));
    const auto& values = std::get<ast::InitState>(instance.sections.at(0).node).assignments;
    const auto& draw = *std::get<ast::ExprBox>(*values.at(0).value);
    const auto& uniform = std::get<ast::Distribution>(draw.node);
    EXPECT_EQ(uniform.name.text, "Uniform");
    EXPECT_EQ(std::get<ast::Real>(uniform.arguments.at(1).node).value, 5.0);
    const auto& discount = std::get<ast::Discount>(instance.sections.at(2).node);
    EXPECT_EQ(std::get<ast::Integer>(discount.value).value, 1);
}

TEST(Files, MayHoldTheBlocksInAnyOrder) {
    EXPECT_EQ(parse_files({sample_instance, sample_domain}).program.blocks.size(), 4u);
    EXPECT_EQ(parse_text(sample_instance + sample_domain).program.blocks.size(), 4u);
    EXPECT_EQ(parse_text("\xEF\xBB\xBF" + sample_domain).codes(), "");
}

TEST(Files, KeepTheirErrorsApart) {
    const Parsed parsed = parse_files({"domain d { reward = ; }", "instance i { horizon = x; }"});
    ASSERT_EQ(parsed.diagnostics.error_count(), 2u) << parsed.report();
    EXPECT_EQ(parsed.diagnostics.all()[0].span->file, 0u);
    EXPECT_EQ(parsed.diagnostics.all()[1].span->file, 1u);
}

}  // namespace
}  // namespace rddlc
