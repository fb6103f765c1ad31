// Applications set a locale, where a comma stands before decimals: what is read and written stays.
#include "../comma_locale.hpp"
#include "../runtime/tiny_simulator.hpp"
#include "formats/records_json.hpp"
#include "learning/learned_policy.hpp"
#include "parse/parse.hpp"
#include "solvers/cgp/policy_file.hpp"
#include "solvers/cgp/search.hpp"
#include "solvers/ppo/policy_file.hpp"
#include "solvers/ppo/trainer.hpp"
#include "support/json_text.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <array>
#include <cstdio>
#include <sstream>
#include <string>

namespace rddlc::workbench {
namespace {

using CommaLocale = rddl::CommaLocale;

TEST_F(CommaLocale, IsInEffect) {
    std::ostringstream stream;
    stream << 1234.5;
    EXPECT_EQ(stream.str(), "1.234,5");
    if (!has_c_locale()) GTEST_SKIP() << "there is no locale de_DE, and no localedef that makes it";
    char text[8];
    std::snprintf(text, sizeof text, "%.1f", 0.5);
    EXPECT_STREQ(text, "0,5");
}

TEST_F(CommaLocale, JsonHasPoints) {
    const nlohmann::json json = parse_json(R"({"a": [0.5, 1234567.25, 1e-3]})");
    EXPECT_EQ(json["a"][0].get<double>(), 0.5);
    EXPECT_EQ(json["a"][1].get<double>(), 1234567.25);
    EXPECT_EQ(json["a"][2].get<double>(), 1e-3);
    EXPECT_EQ(json_line(json), R"({"a":[0.5,1234567.25,0.001]})");
    EXPECT_THROW(parse_json("1.5e400"), RefusedJson);
    std::string text;
    write_real(text, 1234.5);
    EXPECT_EQ(text, "1234.5");
}

std::size_t errors_in(const std::string& number) {
    Sources sources;
    Diagnostics diagnostics;
    const std::array files = {
        sources.add("d.rddl", "domain d { cpfs { x = " + number + "; }; reward = 0.0; }")};
    parse(sources, files, diagnostics, Standard::Rddlc);
    return diagnostics.error_count();
}

TEST_F(CommaLocale, NumbersOfRddlThatAreTooLargeAreTold) {
    for (const char* fine :
         {"0.5", "1.5e308", "1.5e-400", "0.0000001e-320", "0.0001e312", "0.0e400"})
        EXPECT_EQ(errors_in(fine), 0u) << fine;
    for (const char* large : {"1.5e400", "1.5e309", "0.001e312", "1.5e99999999999999999999"})
        EXPECT_EQ(errors_in(large), 1u) << large;
    EXPECT_EQ(errors_in("1.5e-99999999999999999999"), 0u);
}

TEST_F(CommaLocale, PoliciesAreTheSame) {
    const rddl_simulator& simulator = *tiny::simulator();
    solvers::PpoOptions ppo;
    ppo.hidden = {3};
    const auto network = [&] {
        return solvers::ppo_policy_text(simulator, solvers::PpoTrainer(simulator, ppo).model());
    };
    const auto program = [&] {
        solvers::CgpOptions cgp;
        cgp.nodes = 10;
        cgp.episodes = 1;
        const solvers::CgpSearch search(simulator, cgp);
        return solvers::program_text(simulator, search.scope(), search.best());
    };
    const std::string network_here = network(), program_here = program();
    EXPECT_NO_THROW(policy_of_text(simulator, network_here, false, 0, ""));
    EXPECT_EQ(
        solvers::ppo_policy_text(simulator, *solvers::read_ppo_policy(simulator, network_here)),
        network_here);
    const auto found = solvers::read_program(simulator, program_here);
    EXPECT_EQ(solvers::program_text(simulator, found->scope, found->genome), program_here);
    end();
    EXPECT_EQ(network(), network_here);
    EXPECT_EQ(program(), program_here);
}

}  // namespace
}  // namespace rddlc::workbench
