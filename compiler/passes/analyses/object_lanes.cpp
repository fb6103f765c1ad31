#include "passes/analyses/object_lanes.hpp"

#include "support/match.hpp"

#include <algorithm>
#include <cstdint>
#include <span>
#include <utility>

namespace rddlc::passes {
namespace {

constexpr std::int64_t fewest_iterations = 8;
// Bools take one mask of all lanes, and its bits the place of jumps that processors cannot foresee.
constexpr std::int64_t fewest_bools = 4;

// A register has so many rows, and so many elements of each.
constexpr std::int64_t registers_rows = 8;

}  // namespace

ObjectLanes::ObjectLanes(const ir::Program& program, PropertiesOf properties_of, ir::Nest nest,
                         std::function<bool(ir::NodeId)> is_element)
    : program_(program),
      properties_of_(std::move(properties_of)),
      nest_(std::move(nest)),
      is_element_(std::move(is_element)) {}

ObjectLanes::ObjectLanes(const ir::Builder& builder, ir::Nest nest,
                         std::function<bool(ir::NodeId)> is_element)
    : ObjectLanes(
          builder.program(),
          [&builder](ir::NodeId id) -> const ir::Properties& { return builder.properties(id); },
          std::move(nest), std::move(is_element)) {}

bool ObjectLanes::are_enough(ir::Scalar scalar) const {
    return ir::combinations(program_, nest_.variables) >=
           (scalar == ir::Scalar::Bool ? fewest_bools : fewest_iterations);
}

bool ObjectLanes::can_evaluate(ir::NodeId id) const {
    if (is_element_ && is_element_(id)) return true;
    return match(
        program_[id].form, [](const ir::Constant&) { return true; },
        [](const ir::Local&) { return true; },
        [](const ir::Bits& bits) { return bits.indices.empty(); },
        [&](const ir::Load& load) { return can_index(load.buffer, load.indices); },
        [&](const ir::Element& element) { return is_at_own_place(element); },
        [&](const ir::Convert& convert) { return can_evaluate(convert.operand); },
        [&](const ir::Apply& apply) { return !apply.place && can_evaluate_all(apply.operands); },
        [&](const ir::Select& select) {
            return can_evaluate_all({select.condition, select.then_value, select.else_value});
        },
        [&](const ir::Sample& sample) {
            return is_by_inversion(sample.distribution) &&
                   ir::is_place_in(program_, nest_, sample.place.index) &&
                   can_evaluate_all(sample.parameters);
        },
        [&](const ir::DiscreteOver& discrete) {
            return ir::is_place_in(program_, nest_, discrete.place.index) &&
                   can_be_weight(discrete.weight);
        },
        [&](const ir::Interval& interval) {
            return ir::is_place_in(program_, nest_, interval.place.index) &&
                   can_index(interval.table, interval.row);
        },
        [&](const ir::Reduce& reduce) { return can_aggregate(reduce); },
        [](const auto&) { return false; });
}

// Weights along the rows of a table were not measured in lanes.
bool ObjectLanes::can_be_weight(ir::NodeId id) const {
    ObjectLanes without_rows = *this;
    without_rows.reads_rows_ = false;
    return without_rows.can_evaluate(id) && can_be_term(id);
}

// A sum of the reals of each object's own row, in a table of the step: registers transpose rows.
bool ObjectLanes::adds_own_row(const ir::Reduce& reduce) const {
    if (reduce.op != Reduction::Sum || reduce.bounds || nest_.variables.size() != 1) return false;
    const auto* load = std::get_if<ir::Load>(&program_[reduce.body].form);
    if (!load || load->indices.size() != 2) return false;
    const ir::Buffer& table = program_[load->buffer];
    return table.scalar == ir::Scalar::Real &&
           is_one_of(table.storage, {ir::Storage::State, ir::Storage::Scratch}) &&
           table.shape[0] % registers_rows == 0 && table.shape[1] % registers_rows == 0 &&
           program_[reduce.variable].size == table.shape[1] &&
           ir::begins_with(program_, load->indices, nest_) &&
           ir::is_index_of(program_, load->indices[1], reduce.variable);
}

bool ObjectLanes::can_aggregate(const ir::Reduce& reduce) const {
    if (adds_own_row(reduce)) return true;
    return !reduce.bounds && reduce.op != Reduction::ArgMin && reduce.op != Reduction::ArgMax &&
           can_evaluate(reduce.body) && can_be_term(reduce.body);
}

// Looking up bools and ints that lie apart takes an object after the other. C++ compilers do better
// along the rows of one object.
bool ObjectLanes::can_be_term(ir::NodeId id) const {
    if (const auto* load = std::get_if<ir::Load>(&program_[id].form))
        return program_[load->buffer].scalar == ir::Scalar::Real ||
               load->indices.size() == nest_.variables.size() ||
               ir::ends_with(program_, load->indices, nest_) ||
               std::ranges::all_of(load->indices, [&](ir::NodeId each) { return is_same(each); });
    return std::ranges::all_of(ir::operands_of(program_[id]),
                               [&](ir::NodeId operand) { return can_be_term(operand); });
}

bool ObjectLanes::is_same(ir::NodeId id) const {
    return ir::is_same_for_all(properties_of_(id), nest_);
}

bool ObjectLanes::can_evaluate_all(const std::vector<ir::NodeId>& ids) const {
    return std::ranges::all_of(ids, [&](ir::NodeId id) { return can_evaluate(id); });
}

// An element of these objects, or one that is the same for all of them, or that they choose from a
// table of constants. Of constants their rows may also be read along, as those of a matrix are.
bool ObjectLanes::can_index(ir::BufferId buffer, const std::vector<ir::NodeId>& indices) const {
    if (ir::begins_with(program_, indices, nest_)) {
        const bool has_rows = reads_rows_ && program_[buffer].storage == ir::Storage::Constant;
        const auto rest = std::span(indices).subspan(nest_.variables.size());
        return std::ranges::all_of(rest, [&](ir::NodeId index) {
            return (has_rows && is_same(index)) || can_evaluate(index);
        });
    }
    const auto are_same = [&](std::span<const ir::NodeId> some) {
        return std::ranges::all_of(some, [&](ir::NodeId index) { return is_same(index); });
    };
    if (ir::ends_with(program_, indices, nest_))
        return are_same(std::span(indices).first(indices.size() - nest_.variables.size()));
    if (are_same(indices)) return true;
    if (program_[buffer].storage == ir::Storage::Constant) return can_evaluate_all(indices);
    return can_gather(buffer, indices);
}

// Reals of the state at places that tables of constants choose: the step before stored them.
bool ObjectLanes::can_gather(ir::BufferId buffer, const std::vector<ir::NodeId>& indices) const {
    return program_[buffer].storage == ir::Storage::State &&
           program_[buffer].scalar == ir::Scalar::Real &&
           std::ranges::all_of(indices, [&](ir::NodeId index) {
               const bool is_from_table = std::holds_alternative<ir::Load>(program_[index].form) &&
                                          properties_of_(index).uniform;
               return is_same(index) || (is_from_table && can_evaluate(index));
           });
}

// Each object has its place in a table, or in a row of one that is the same for all.
bool ObjectLanes::is_at_own_place(const ir::Element& element) const {
    const auto is_same_index = [&](ir::NodeId id) {
        return is_same(id);
    };
    const auto* places = std::get_if<ir::Load>(&program_[element.place].form);
    return places && program_[places->buffer].holds_places &&
           ir::ends_with(program_, places->indices, nest_) &&
           std::all_of(places->indices.begin(), places->indices.end() - std::ssize(nest_.variables),
                       is_same_index) &&
           std::ranges::all_of(element.indices, is_same_index);
}

// Axes of a single object before those of the nest change no place.
bool ObjectLanes::can_store(const ir::Store& store) const {
    if (!can_store_in_row(store)) return false;
    const auto& shape = program_[store.target].shape;
    const auto own = shape.end() - static_cast<std::ptrdiff_t>(nest_.variables.size());
    return std::all_of(shape.begin(), own, [](std::int64_t size) { return size == 1; });
}

bool ObjectLanes::can_store_in_row(const ir::Store& store) const {
    if (!ir::ends_with(program_, store.indices, nest_)) return false;
    const auto row = std::span(store.indices).first(store.indices.size() - nest_.variables.size());
    return std::ranges::all_of(row, [&](ir::NodeId index) { return is_same(index); }) &&
           can_evaluate(store.value);
}

}  // namespace rddlc::passes
