#include "passes/lanes/join_cheap_cases.hpp"

#include "ir/analysis.hpp"
#include "ir/builder.hpp"
#include "ir/nest.hpp"
#include "ir/rewrite.hpp"

#include <map>
#include <optional>
#include <utility>
#include <vector>

namespace rddlc::passes {
namespace {

class Joining {
  public:
    Joining(ir::Program program, Report& report)
        : program_(std::move(program)), report_(report), builder_(program_) {}

    ir::Program run() && {
        ir::for_each_loop(program_, [&](ir::Loop& loop, Span) { change(loop); });
        return ir::collect_garbage(std::move(program_));
    }

  private:
    void change(ir::Loop& loop) {
        if (!loop.several_at_once || loop.as_words) return;  // words take all branches anyway
        std::map<ir::NodeId, ir::NodeId> known;
        ir::change_roots(ir::innermost_body(loop), [&](ir::NodeId& root) {
            root = ir::replace_in(builder_, root, known,
                                  [&](ir::NodeId id) { return with_joined_cases(id); });
        });
    }

    std::optional<ir::NodeId> with_joined_cases(ir::NodeId id) {
        std::vector<ir::Select> cases;
        ir::NodeId rest = id;
        while (const auto cheap = cheap_case(rest)) {
            cases.push_back(*cheap);
            rest = cheap->else_value;
        }
        if (cases.size() < 2 || ir::is_cheap(builder_.properties(rest))) return std::nullopt;
        ir::NodeId condition = cases.back().condition, value = cases.back().then_value;
        cases.pop_back();
        for (auto each = cases.rbegin(); each != cases.rend(); ++each) {
            value = builder_.select(each->condition, each->then_value, value);
            condition = builder_.apply(Operator::Or, {each->condition, condition});
        }
        ++report_["cheap cases that become one branch"];
        return builder_.select(condition, value, rest);
    }
    std::optional<ir::Select> cheap_case(ir::NodeId id) {
        const auto* select = std::get_if<ir::Select>(&program_[id].form);
        const bool is_one = select && select->evaluated == ir::Evaluated::Branch &&
                            ir::is_cheap(builder_.properties(select->condition)) &&
                            ir::is_cheap(builder_.properties(select->then_value));
        return is_one ? std::optional(*select) : std::nullopt;
    }

    ir::Program program_;
    Report& report_;
    ir::Builder builder_;
};

}  // namespace

ir::Program join_cheap_cases(ir::Program program, Report& report) {
    return Joining(std::move(program), report).run();
}

}  // namespace rddlc::passes
