#include "passes/passes.hpp"

#include "ir/verify.hpp"
#include "passes/fold_constant_expressions.hpp"
#include "passes/fold_uniform_tables.hpp"
#include "passes/remove_unused_buffers.hpp"
#include "passes/share_subexpressions.hpp"

#include <utility>

namespace rddlc {
namespace {

struct Pass {
    const char* name;
    ir::Program (*run)(ir::Program);
};

constexpr Pass all_passes[] = {
    {"fold_uniform_tables", passes::fold_uniform_tables},
    {"fold_constant_expressions", passes::fold_constant_expressions},
    {"remove_unused_buffers", passes::remove_unused_buffers},
    {"share_subexpressions", passes::share_subexpressions},
};

}  // namespace

ir::Program optimise(ir::Program program) {
    for (const Pass& pass : all_passes) {
        program = pass.run(std::move(program));
#ifndef NDEBUG
        ir::expect_valid(program, pass.name);
#endif
    }
    return program;
}

}  // namespace rddlc
