#include "ir/layout.hpp"

#include "programs.hpp"

#include <gtest/gtest.h>

#include <cstddef>

namespace rddlc::ir {
namespace {

TEST(Layout, FollowsTheRulesOfC) {
    const Workbench w;
    const RecordLayout layout = record_layout(w.program, Storage::State);
    ASSERT_EQ(layout.fields.size(), 3u);
    EXPECT_EQ(layout.fields[0].offset, offsetof(WorkbenchState, running));
    EXPECT_EQ(layout.fields[1].offset, offsetof(WorkbenchState, level));
    EXPECT_EQ(layout.fields[2].offset, offsetof(WorkbenchState, count));
    EXPECT_EQ(layout.size, sizeof(WorkbenchState));
}

TEST(Layout, EndsWithPadding) {
    Workbench w;
    w.add("last", Storage::State, Scalar::Bool, false, {true});
    EXPECT_EQ(record_layout(w.program, Storage::State).size, sizeof(WorkbenchState) + 8);
}

TEST(Layout, OfBoolsAloneNeedsNoAlignment) {
    const Workbench w;
    EXPECT_EQ(record_layout(w.program, Storage::Action).size, 3u);
    EXPECT_EQ(record_layout(w.program, Storage::Observation).size, 0u);
}

TEST(Layout, OfTheNextStateIsThatOfTheState) {
    const Workbench w;
    const RecordLayout state = record_layout(w.program, Storage::State);
    const RecordLayout next = record_layout(w.program, Storage::Next);
    ASSERT_EQ(state.fields.size(), next.fields.size());
    for (std::size_t i = 0; i < state.fields.size(); ++i) {
        EXPECT_EQ(state.fields[i].offset, next.fields[i].offset);
    }
    EXPECT_EQ(state.size, next.size);
}

}  // namespace
}  // namespace rddlc::ir
