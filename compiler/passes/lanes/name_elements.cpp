#include "passes/lanes/name_elements.hpp"

#include "ir/analysis.hpp"
#include "ir/builder.hpp"
#include "ir/call.hpp"
#include "ir/nest.hpp"
#include "ir/rewrite.hpp"
#include "passes/analyses/bool_words.hpp"

#include <functional>
#include <map>
#include <utility>

namespace rddlc::passes {
namespace {

// How often the text of a block has each node, users before their operands.
std::map<ir::NodeId, double, std::greater<>> occurrences(const ir::Program& program,
                                                         const ir::Block& block) {
    std::map<ir::NodeId, double, std::greater<>> times;
    for (const ir::NodeId root : ir::roots_of(block)) ++times[root];
    for (const auto& [id, count] : times)
        for (const ir::NodeId operand : ir::operands_of(program[id])) times[operand] += count;
    return times;
}

// Names the elements that stand several times in the body of a loop.
void name_in(ir::Program& program, ir::Builder& builder, ir::Loop& loop, Report& report) {
    const ir::Nest nest = ir::nest_of(loop);
    if (!loop.as_words || loop.affected || !are_many(program, nest)) return;
    ir::Block& body = ir::innermost_body(loop);
    const auto stored = ir::written_buffers(body);
    ir::Block lets;
    std::map<ir::NodeId, ir::NodeId> named;
    for (const auto& [id, count] : occurrences(program, body)) {
        const auto* element = std::get_if<ir::Element>(&program[id].form);
        if (!element || count < 2 || stored.contains(element->buffer)) continue;
        const ir::LocalId local{program.local_count++};
        lets.push_back({ir::Let{local, id}});
        named[id] = builder.local(local, ir::Scalar::Bool);
        ++report["elements named"];
    }
    if (lets.empty()) return;
    ir::change_roots(body, [&](ir::NodeId& root) { root = ir::replace_in(builder, root, named); });
    body.insert(body.begin(), lets.begin(), lets.end());
}

}  // namespace

ir::Program name_elements(ir::Program program, Report& report) {
    ir::Builder builder(program);
    ir::for_each_loop(program,
                      [&](ir::Loop& loop, Span) { name_in(program, builder, loop, report); });
    return ir::collect_garbage(std::move(program));
}

}  // namespace rddlc::passes
