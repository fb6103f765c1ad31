#include "passes/arithmetic/straighten_rows.hpp"

#include <rddl/values/line.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace rddlc::passes {
namespace {

// In units in the last place of the greatest element.
constexpr double greatest_change = 16;

// In the reals of the simulator.
template <class Real>
bool straighten(std::span<ir::Value> row) {
    const auto element = [&](std::size_t count) {
        return static_cast<Real>(std::get<double>(row[count]));
    };
    const Real first = element(0), last = element(row.size() - 1);
    // What the second element of the line rises by, once that is rounded.
    const rddl::Line<Real> line{first, first + (element(1) - first) - first, last};
    const Real greatest = std::max(std::abs(first), std::abs(last));
    const Real change =
        static_cast<Real>(greatest_change) * std::numeric_limits<Real>::epsilon() * greatest;
    if (!std::isfinite(change)) return false;
    for (std::size_t count = 0; count < row.size(); ++count) {
        const Real value = line.at(count);
        if (!(std::abs(value - element(count)) <= change)) return false;
        row[count] = double{value};
    }
    return true;
}

template <class Real>
std::optional<std::vector<ir::Value>> straight(std::vector<ir::Value> values, std::size_t cases) {
    for (auto row = values.begin(); row != values.end(); row += static_cast<std::ptrdiff_t>(cases))
        if (!straighten<Real>(std::span(row, cases))) return std::nullopt;
    return values;
}

bool is_candidate(const ir::Buffer& buffer) {
    return buffer.storage == ir::Storage::Constant && buffer.scalar == ir::Scalar::Real &&
           !buffer.fluent && buffer.shape.size() == 2 && buffer.shape.back() > 1;
}

}  // namespace

ir::Program straighten_rows(ir::Program program, Report& report) {
    for (ir::Buffer& buffer : program.buffers) {
        if (!is_candidate(buffer)) continue;
        const auto straight_in =
            program.real == RealType::Float ? straight<float> : straight<double>;
        auto lines =
            straight_in(buffer.values.dense(), static_cast<std::size_t>(buffer.shape.back()));
        if (!lines || *lines == buffer.values.dense()) continue;
        buffer.values = std::move(*lines);
        ++report["tables of lines"];
    }
    return program;
}

}  // namespace rddlc::passes
