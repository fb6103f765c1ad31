#include "support/template_slots.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

namespace rddlc {
namespace {

TEST(TemplateSlots, FillsSlotsInsideALine) {
    EXPECT_EQ(fill_slots("struct ${name} { ${name}(); };", {{"name", "State"}}),
              "struct State { State(); };");
}

TEST(TemplateSlots, IndentsEveryLineOfASlotThatIsAloneOnItsLine) {
    EXPECT_EQ(fill_slots("{\n    ${body}\n}\n", {{"body", "a;\n\n  b;"}}),
              "{\n    a;\n\n      b;\n}\n");
}

TEST(TemplateSlots, RemovesTheLineOfAnEmptyValue) {
    EXPECT_EQ(fill_slots("a\n  ${body}\nb\n", {{"body", ""}}), "a\nb\n");
}

TEST(TemplateSlots, DoesNotFillValuesAgain) {
    EXPECT_EQ(fill_slots("x ${a} y\n", {{"a", "${b}"}}), "x ${b} y\n");
}

TEST(TemplateSlots, LeavesOtherTextAlone) {
    EXPECT_EQ(fill_slots("$ {a} $a {}", {}), "$ {a} $a {}");
    EXPECT_EQ(fill_slots("", {}), "");
}

TEST(TemplateSlots, RefusesMissingUnknownAndMalformedSlots) {
    EXPECT_THROW(fill_slots("${a}", {}), std::logic_error);
    EXPECT_THROW(fill_slots("", {{"a", "1"}}), std::logic_error);
    EXPECT_THROW(fill_slots("x ${a", {{"a", "1"}}), std::logic_error);
    EXPECT_THROW(fill_slots("${}", {}), std::logic_error);
}

}  // namespace
}  // namespace rddlc
