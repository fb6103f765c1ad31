// Statements as formatted C++ lines.
//
// A statement that does not fit into one line is not broken just anywhere: it takes one of the few
// forms below, or else its longest part becomes a named value, until it fits. So the text reads
// well, and clang-format has nothing to change.
//
//     next.x[r] =                           const Real total = rddl::sum<Real>(n, [&](...) {
//         rddl::maximum(0.0, ...);              return ...;
//                                           });
//     next.x[r] = state.x[r] + action.in[r] -
//                 action.out[r];
//     next.x[r] = rddl::branch(
//         context, c, [&] { return ...; },
//         [&] { return ...; });
#pragma once

#include "emit/expressions.hpp"
#include "ir/ir.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace rddlc::cpp {

class FunctionBody {
  public:
    // `level` is the indentation of the statements.
    FunctionBody(const Unit& unit, int level) : expressions_(unit), level_(level) {}

    void block(const ir::Block& block);
    void return_value(ir::NodeId value);

    const std::vector<std::string>& lines() const { return lines_; }
    const Uses& uses() { return expressions_.uses(); }

  private:
    void statement(const ir::Let& let);
    void statement(const ir::Store& store);
    void statement(const ir::Loop& loop);
    void over_several_objects(const ir::Loop& loop);
    void statement(const ir::Call& call);

    // `lead` and the value; a lead is "return " or ends with "= ".
    void value(const std::string& lead, ir::NodeId id);

    // Names parts of `id` until one of the forms has room for it after the lead.
    void prepare(const std::string& lead, ir::NodeId id);
    void prepare_branch(const ir::Select& select);
    void prepare_discrete(const ir::Discrete& discrete);
    void name_parts_in_order(ir::NodeId id);
    bool name_longest_part(ir::NodeId id);
    void name_value(ir::NodeId id);
    std::string declare(ir::NodeId id);
    void prepare_declaration(ir::NodeId id);
    std::string type_in_declaration(ir::NodeId id);

    // Writes what has been prepared, in the form that fits.
    void write(const std::string& lead, ir::NodeId id);
    void write_call(const std::string& text);
    void write_lambda_call(const std::string& lead, ir::NodeId id);
    void write_branch(const std::string& lead, const ir::Select& select);
    bool are_harmless(const std::vector<ir::NodeId>& lambdas) const;
    void add_lambda(std::string& current, ir::NodeId body, const std::string& tail);
    void write_discrete(const std::string& lead, const ir::Discrete& discrete);
    void write_lambda_body(ir::NodeId body);

    bool fits_as_chain(const std::string& lead, ir::NodeId id);
    bool fits(std::size_t length, int levels_deeper = 0) const;
    std::size_t length_within(ir::NodeId id, std::size_t most);
    std::optional<std::string> short_result(ir::NodeId body);

    // Must be a statement of its own: it contains a branch that is not named yet.
    bool is_block(ir::NodeId id) const;
    const ir::Select* lazy_select(ir::NodeId id) const;
    std::vector<ir::NodeId> chain_parts(ir::NodeId id) const;
    std::vector<ir::NodeId> eager_parts(ir::NodeId id) const;
    std::vector<ir::NodeId> nameable_parts(ir::NodeId id) const;
    void collect_lambda_calls(ir::NodeId id, std::vector<ir::NodeId>& calls) const;

    void line(const std::string& text);
    const ir::Program& program() const { return expressions_.unit().program; }

    Expressions expressions_;
    int level_;
    std::vector<std::string> lines_;
};

}  // namespace rddlc::cpp
