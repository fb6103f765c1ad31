// Statements of the IR as those of C++.
//
// An expression that does not fit into a line, nor is a chain of operands that do, gets names for
// its longest parts until it does, so that the text reads well. Parts that C++ might evaluate too
// early, or in another order, get names in any case.
#pragma once

#include "emit/lower/expressions.hpp"
#include "ir/ir.hpp"

#include <cstddef>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace rddlc::cpp {

class FunctionBody {
  public:
    // `level` is the indentation of the statements.
    FunctionBody(const Unit& unit, std::size_t level) : expressions_(unit), level_(level) {}

    void block(const ir::Block& block);
    // Returns where definitions, of which all have the same choices, keep tables of the state.
    void keep_unchosen(std::span<const ir::Definition> definitions);
    // Moves the elements of all rows of a table, before the loops around a loop that shifts.
    void shift(const ir::Loop& loop);
    void return_value(ir::NodeId value);

    tree::Block& statements() { return statements_; }
    const Uses& uses() { return expressions_.uses(); }

  private:
    tree::Expressions tables(const std::vector<ir::BufferId>& buffers);
    void statement(const ir::Let& let);
    void statement(const ir::Store& store);
    void statement(const ir::Loop& loop);
    void add_to_row(const ir::Loop& loop);
    void statement(const ir::Spread& spread);
    void statement(const ir::Visit& visit);
    void visits(const std::vector<const ir::Visit*>& all);
    tree::Expression marks_of(const ir::Visit& visit);
    void mark(const ir::Mark& mark, const std::string& is_there);
    // A loop that quantifies may start where no object has been seen: nothing is read then.
    void over_several_objects(const ir::Loop& loop, bool is_from_start = false);
    // The loop, if the only true bool of a table does not say what it fills its table with.
    tree::Expression or_move(const ir::Loop& loop, const std::string& context_of_loop,
                             tree::Expression loop_of_affected);
    tree::Expressions numbers_near(const ir::Clearances& clearances);
    tree::Expression near_object(const ir::Clearances& clearances, const std::string& count,
                                 tree::Expression lambda);
    void statement(const ir::Call& call);

    // The use of a value: the width of the text before it, if both stand in one line.
    struct Use {
        std::size_t width;
        bool returns = false;
    };

    // Names parts of `id` until it reads well.
    void prepare(Use use, ir::NodeId id);
    bool reads_well(Use use, ir::NodeId id);
    void prepare_branch(const ir::Select& select);
    void prepare_weights(const ir::Node& draw);
    void name_parts_in_order(ir::NodeId id);
    bool name_longest_part(ir::NodeId id);
    void name_value(ir::NodeId id);
    std::string declare(ir::NodeId id);
    void prepare_declaration(ir::NodeId id);
    std::string type_in_declaration(ir::NodeId id);

    // A value that has been prepared.
    tree::Expression value(Use use, ir::NodeId id);
    tree::Expression branch(const ir::Select& select);
    tree::Expression discrete(const ir::Node& draw);
    // The statements that `add` adds, deeper by so many levels.
    template <class Add>
    tree::Block inner(std::size_t levels, Add&& add);
    // A value, after some of its parts have names.
    tree::Block returning(ir::NodeId id, std::size_t levels,
                          const std::vector<ir::NodeId>& named = {});

    std::size_t room(Use use) const;
    bool fits(Use use, ir::NodeId id);

    // Must be a statement of its own: it contains a branch that is not named yet.
    bool is_block(ir::NodeId id) const;
    const ir::Select* lazy_select(ir::NodeId id) const;
    std::vector<ir::NodeId> chain_parts(ir::NodeId id) const;
    std::vector<ir::NodeId> eager_parts(ir::NodeId id) const;
    std::vector<ir::NodeId> nameable_parts(ir::NodeId id) const;
    void collect_lambda_calls(ir::NodeId id, std::vector<ir::NodeId>& calls) const;

    const ir::Program& program() const { return expressions_.unit().program; }

    Expressions expressions_;
    std::size_t level_;
    tree::Block statements_;
    std::map<ir::BufferId, std::string> true_elements_;  // the names of visited ones, by table
};

}  // namespace rddlc::cpp
