// Every probe is accepted, or rejected with exactly the codes that its line names.
#include "probes.hpp"

#include "checking.hpp"

#include <gtest/gtest.h>

namespace rddlc::testing {
namespace {

class ProbeTest : public ::testing::TestWithParam<Probe> {};

TEST_P(ProbeTest, HasTheExpectedCodes) {
    DiagnosticOptions options;
    options.disabled_warnings.insert({'W', 202});  // a probe uses but a few of the fluents
    const Checked checked = check_text(problem_with(GetParam().text), options);
    const std::string found = checked.codes().empty() ? "ok" : checked.codes();
    EXPECT_EQ(found, GetParam().expected) << GetParam().text << "\n" << checked.rendered();
    EXPECT_EQ(checked.model.has_value(), !checked.diagnostics.has_errors());
}

std::string name_of_line(const ::testing::TestParamInfo<Probe>& probe) {
    return "line" + std::to_string(probe.param.line);
}

INSTANTIATE_TEST_SUITE_P(Expressions, ProbeTest,
                         ::testing::ValuesIn(read_probes("expressions.txt")), name_of_line);
INSTANTIATE_TEST_SUITE_P(Edits, ProbeTest, ::testing::ValuesIn(read_probes("edits.txt")),
                         name_of_line);

}  // namespace
}  // namespace rddlc::testing
