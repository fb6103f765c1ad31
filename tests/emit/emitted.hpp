// The text that is emitted for a problem.
#pragma once

#include "check/check.hpp"
#include "emit/emit.hpp"
#include "ground/ground.hpp"
#include "parse/parse.hpp"
#include "passes/passes.hpp"

#include <array>
#include <stdexcept>
#include <string>
#include <utility>

namespace rddlc {

inline std::string emitted(const std::string& text, const EmitOptions& options = {},
                           const PassOptions& passes = {}, RealType real = RealType::Double) {
    Sources sources;
    Diagnostics diagnostics;
    const FileId file = sources.add("problem.rddl", text);
    const ast::Program tree = parse(sources, std::array{file}, diagnostics);
    const auto model = check(tree, sources, diagnostics);
    if (!model) throw std::logic_error(diagnostics.all().front().message);
    ir::Program program = ground(*model, diagnostics).value();
    program.real = real;
    if (program.moderate) (*program.moderate)->real = real;
    return emit(optimise(std::move(program), passes), sources, options);
}

}  // namespace rddlc
