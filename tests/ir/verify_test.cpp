#include "ir/verify.hpp"

#include "programs.hpp"

#include <gtest/gtest.h>

namespace rddlc::ir {
namespace {

class VerifyTest : public testing::Test {
  protected:
    VerifyTest() { add_step(w); }

    // The only complaint, or all in one text.
    std::string complaint() {
        std::string text;
        for (const std::string& sentence : verify(w.program)) {
            text += (text.empty() ? "" : "; ") + sentence;
        }
        return text;
    }
    // Puts a node into the pool behind the builder's back: it must not be used afterwards.
    NodeId add(Node node) {
        w.program.nodes.push_back(std::move(node));
        return {static_cast<std::uint32_t>(w.program.nodes.size() - 1)};
    }
    Store& store_of_level() { return std::get<Store>(w.program.step[2].body.front().form); }

    Workbench w;
};

TEST_F(VerifyTest, AcceptsAWellFormedProgram) {
    EXPECT_EQ(complaint(), "");
}

TEST_F(VerifyTest, FindsOperandsBehindTheirUsers) {
    const auto next = static_cast<std::uint32_t>(w.program.nodes.size() + 1);
    add({Scalar::Real, Apply{Operator::Exp, {NodeId{next}}, {}}});
    add({Scalar::Real, Constant{1.0}});
    EXPECT_NE(complaint().find("which is not before it"), std::string::npos);
}

TEST_F(VerifyTest, FindsUnknownIds) {
    add({Scalar::Real, Load{BufferId{99}, {}}});
    EXPECT_EQ(complaint(), "there is no buffer 99");
}

TEST_F(VerifyTest, FindsTypesThatDoNotFit) {
    store_of_level().value =
        add({Scalar::Real, Apply{Operator::Add, {w.real(1), w.integer(1)}, {}}});
    EXPECT_EQ(complaint(), "types do not fit in '1.0 + 1'");
}

TEST_F(VerifyTest, FindsBoundsThatDifferBetweenLanes) {
    const Bounds bounds{w.integer(0), w.load(w.count)};
    store_of_level().value = w.builder().reduce(Reduction::Sum, w.d, w.load(w.level), bounds);
    EXPECT_EQ(complaint(), "types do not fit in 'sum[d in 0 .. state.count](state.level)'");
}

TEST_F(VerifyTest, FindsSearchesInTablesThatAreNotSorted) {
    const BufferId ends = w.add("ENDS", Storage::Constant, Scalar::Real, true, {1.0, 4.0, 2.0});
    const NodeId place = w.builder().search(ends, w.load(w.level));
    store_of_level().value = w.builder().convert(place, Scalar::Real);
    EXPECT_EQ(complaint(), "types do not fit in 'search(ENDS, state.level)'");
}

TEST_F(VerifyTest, FindsBitsOfWhatIsNoTableOfBools) {
    const NodeId bits = w.builder().bits(w.level, 0);
    store_of_level().value = w.builder().convert(bits, Scalar::Real);
    EXPECT_EQ(complaint(), "types do not fit in 'bits(state.level, 0)'");
}

TEST_F(VerifyTest, FindsExtremesThatMayBeEmpty) {
    const Bounds bounds{w.integer(0), w.integer(2)};
    store_of_level().value = w.builder().reduce(Reduction::Minimum, w.d, w.load(w.level), bounds);
    EXPECT_EQ(complaint(), "types do not fit in 'min[d in 0 .. 2](state.level)'");
}

TEST_F(VerifyTest, FindsValuesStoredToAnotherType) {
    store_of_level().value = w.integer(3);
    EXPECT_EQ(complaint(), "the type stored to 'level' is wrong");
}

TEST_F(VerifyTest, StoresToStatesAtResetOnly) {
    w.program.reset = {w.assign(w.level, w.real(3))};
    EXPECT_EQ(complaint(), "");
    w.program.reset = {w.assign(w.level, w.load(w.level))};
    EXPECT_TRUE(complaint().starts_with("'level' must not be read here")) << complaint();
    w.program.reset = {w.assign(w.next_level, w.real(3))};
    EXPECT_EQ(complaint(), "'level' is read only");
    w.program.reset.clear();
    store_of_level().target = w.level;
    EXPECT_EQ(complaint(), "'level' is read only; nothing computes 'level'");
}

TEST_F(VerifyTest, FindsMissingPlaces) {
    const NodeId count = w.load(w.count);
    auto& store = std::get<Store>(w.program.step[3].body.front().form);
    store.value = add({Scalar::Int, Apply{Operator::Power, {count, count}, {}}});
    EXPECT_EQ(complaint(), "types do not fit in 'power(state.count, state.count)'");
}

TEST_F(VerifyTest, FindsUnknownIdsInStatements) {
    store_of_level().target = BufferId{99};
    EXPECT_EQ(complaint(), "there is no buffer 99");
    store_of_level().target = w.next_level;
    std::get<Loop>(w.program.step[0].body.front().form).variable = VariableId{77};
    EXPECT_EQ(complaint(), "there is no variable 77");
}

TEST_F(VerifyTest, FindsUnboundVariables) {
    store_of_level().value = w.builder().convert(w.at(w.running, w.c), Scalar::Real);
    EXPECT_EQ(complaint(), "a variable of 'real(state.running[c])' is not bound");
}

TEST_F(VerifyTest, FindsVariablesBoundTwice) {
    auto& loop = std::get<Loop>(w.program.step[1].body.front().form);
    auto& store = std::get<Store>(loop.body.front().form);
    store.value = w.builder().reduce(Reduction::ForAll, w.c, w.at(w.running, w.c));
    EXPECT_EQ(complaint(), "'c' is bound inside itself");
}

TEST_F(VerifyTest, FindsSitesUsedTwice) {
    const NodeId draw = w.bernoulli(w.real(0.25));
    auto& loop = std::get<Loop>(w.program.step[0].body.front().form);
    std::get<Store>(loop.body.front().form).value = draw;
    EXPECT_EQ(complaint(), "site 0 is used 2 times");
}

TEST_F(VerifyTest, FindsFallibleRightOperands) {
    const NodeId count = w.load(w.count);
    const NodeId fallible = w.apply(Operator::Less, w.int_power(count, count), w.integer(3));
    w.program.terminations.front().value =
        add({Scalar::Bool, Apply{Operator::And, {w.boolean(true), fallible}, {}}});
    EXPECT_EQ(complaint(),
              "types do not fit in 'true && power@1[0](state.count, state.count) < 3'");
}

TEST_F(VerifyTest, FindsReadsBeforeTheComputation) {
    std::swap(w.program.step[0], w.program.step[1]);
    EXPECT_EQ(complaint(), "");
    w.program.step.push_back(w.program.step[1]);
    w.program.step.erase(w.program.step.begin() + 1);
    EXPECT_EQ(complaint(), "");
    auto& loop = std::get<Loop>(w.program.step[0].body.front().form);
    std::get<Store>(loop.body.front().form).value = w.at(w.seen, w.c);
    EXPECT_EQ(complaint(), "'seen' is read before it is computed");
}

TEST_F(VerifyTest, FindsWhatNobodyOrSomebodyTwiceComputes) {
    w.program.step.push_back(w.program.step.back());
    EXPECT_EQ(complaint(), "'count' is computed twice");
    w.program.step.pop_back();
    w.program.step.pop_back();
    EXPECT_EQ(complaint(), "nothing computes 'count'");
}

TEST_F(VerifyTest, FindsActionsInInvariants) {
    w.program.invariants.front().value =
        w.builder().reduce(Reduction::ForAll, w.c, w.at(w.reboot, w.c));
    EXPECT_EQ(complaint(), "'reboot' must not be read here");
}

TEST_F(VerifyTest, FindsLocalsUsedOutsideOfTheirBlock) {
    w.program.local_count = 1;
    const NodeId local = w.builder().local(LocalId{0}, Scalar::Real);
    Block& block = w.program.step[2].body;
    store_of_level().value = local;
    EXPECT_EQ(complaint(), "local 0 is not defined here");
    block.insert(block.begin(), {Let{LocalId{0}, w.real(1)}});
    EXPECT_EQ(complaint(), "");
}

TEST_F(VerifyTest, FindsTablesOfTheWrongSize) {
    w.program.buffers[w.connected.index].values = {true, false};
    EXPECT_EQ(complaint(), "'CONNECTED' has 2 values instead of 3");
}

class VerifyCallTest : public VerifyTest {
  protected:
    // Fills a matrix, then computes its determinant.
    VerifyCallTest() {
        const NodeId row = w.builder().index(w.c);
        const NodeId column = w.builder().index(w.d);
        matrix_ = add_table("matrix", 2);
        const BufferId result = add_table("determinant", 0);
        Loop columns{w.d, {}};
        columns.body.push_back({Store{matrix_, {row, column}, w.real(1)}});
        Loop rows{w.c, {}};
        rows.body.push_back({std::move(columns)});
        w.program.reward.body.push_back({std::move(rows)});
        w.program.reward.body.push_back(
            {Call{MatrixOperator::Determinant, {{matrix_, {}}}, {}, {result, {}}, {}}});
        w.program.reward.value = w.load(result);
    }

    BufferId add_table(std::string name, std::size_t axes) {
        Buffer buffer{std::move(name), Storage::Scratch, Scalar::Real, {}, {}, {}, {}, {}};
        buffer.shape.assign(axes, 3);
        buffer.types.assign(axes, 0);
        w.program.buffers.push_back(std::move(buffer));
        return {static_cast<std::uint32_t>(w.program.buffers.size() - 1)};
    }
    Call& call() { return std::get<Call>(w.program.reward.body.back().form); }

    BufferId matrix_;
};

TEST_F(VerifyCallTest, AcceptsAWellFormedCall) {
    EXPECT_EQ(complaint(), "");
}

TEST_F(VerifyCallTest, FindsTablesThatDoNotFit) {
    call().inputs.clear();
    EXPECT_NE(complaint().find("the tables of 'det' do not fit"), std::string::npos);
}

TEST_F(VerifyCallTest, FindsScalarsAndPlacesThatDoNotFit) {
    call().scalars = {w.integer(3)};
    EXPECT_NE(complaint().find("the scalars of 'det' do not fit"), std::string::npos);
    call().scalars.clear();
    call().place = Place{{2}, w.integer(0)};
    EXPECT_NE(complaint().find("'det' has a place, or needs one"), std::string::npos);
}

TEST_F(VerifyCallTest, FindsTablesReadBeforeTheyAreFilled) {
    w.program.reward.body.erase(w.program.reward.body.begin());
    EXPECT_EQ(complaint(), "'matrix' is read before it is computed");
}

TEST_F(VerifyCallTest, FindsTablesReadAfterTheyWereOverwritten) {
    w.program.reward.value = w.builder().load(matrix_, {w.integer(0), w.integer(1)});
    EXPECT_EQ(complaint(), "'matrix' is read before it is computed");
}

TEST_F(VerifyCallTest, AcceptsAnyTablesOfAnExternalFunction) {
    w.program.externals = {{"f", {}}};
    call() = {ExternalId{0}, {{matrix_, {w.integer(1)}}, {matrix_, {}}}, {}, call().output, {}};
    EXPECT_EQ(complaint(), "");
    call().callee = ExternalId{1};
    EXPECT_NE(complaint().find("there is no external function 1"), std::string::npos);
}

TEST_F(VerifyCallTest, FindsViewsOfAnExternalFunctionThatDoNotFit) {
    w.program.externals = {{"f", {}}};
    const NodeId zero = w.integer(0);
    call() = {ExternalId{0}, {{matrix_, {zero, zero, zero}}}, {}, call().output, {}};
    EXPECT_NE(complaint().find("the indices of the tables of '$f' do not fit"), std::string::npos);
    call() = {ExternalId{0}, {{matrix_, {w.real(0)}}}, {}, call().output, {}};
    EXPECT_NE(complaint().find("the indices of the tables of '$f' do not fit"), std::string::npos);
    call() = {ExternalId{0}, {}, {zero}, call().output, {}};
    EXPECT_NE(complaint().find("the scalars of '$f' do not fit"), std::string::npos);
    call() = {ExternalId{0}, {{matrix_, {}}}, {}, {matrix_, {}}, {}};
    EXPECT_NE(complaint().find("'$f' fills a table that it reads"), std::string::npos);
}

TEST_F(VerifyCallTest, FindsUnknownIds) {
    call().output.buffer = BufferId{99};
    EXPECT_NE(complaint().find("there is no buffer 99"), std::string::npos);
}

}  // namespace
}  // namespace rddlc::ir
