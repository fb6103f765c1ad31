#include "rollouts/finite_values.hpp"

#include "problems/front_end.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstring>
#include <utility>

namespace rddlc::cli {
namespace {

std::set<std::string> infinite_fluents(const ProblemFiles& files, const LoadOptions& options) {
    const Compilation compilation =
        compile_or_give_up(front_end_options(files, Stage::Optimise, options));
    std::set<std::string> names;
    for (const ir::Buffer& buffer : compilation.program->buffers)
        if (!buffer.finite) names.insert(buffer.name);
    return names;
}

}  // namespace

FiniteValues::FiniteValues(ProblemFiles files, LoadOptions options)
    : files_(std::move(files)), options_(std::move(options)) {}

std::optional<std::string> FiniteValues::complaint(const RecordLayout& layout,
                                                   const std::byte* record) {
    for (const RecordEntry& entry : layout.entries()) {
        if (entry.fluent->scalar != RDDL_REAL) continue;
        double value = 0;
        std::memcpy(&value, record + entry.offset, sizeof value);
        if (std::isfinite(value) || may_be_infinite(entry.fluent->name)) continue;
        std::string text;
        write_value(text, entry, record);
        return fmt::format(
            "'{}' is {}, but optimised programs count on it to be finite: values that depend on it "
            "may be wrong",
            entry.name, text);
    }
    return {};
}

bool FiniteValues::may_be_infinite(const std::string& fluent) {
    if (!infinite_) infinite_ = infinite_fluents(files_, options_);
    return infinite_->contains(fluent);
}

}  // namespace rddlc::cli
