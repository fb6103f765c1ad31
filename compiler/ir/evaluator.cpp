// Over 400 lines: a function for each kind of node and statement.
#include "ir/evaluator.hpp"

#include "ir/analysis.hpp"
#include "ir/call.hpp"
#include "ir/fold.hpp"
#include "ir/layout.hpp"
#include "ir/table_kernels.hpp"
#include "support/failure.hpp"
#include "support/match.hpp"

#include <rddl/random/distributions.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <iterator>
#include <numeric>
#include <string_view>
#include <type_traits>
#include <utility>

namespace rddlc::ir {
namespace {

[[noreturn]] void refuse_to_list(std::string_view distribution) {
    throw Failure(fmt::format("the outcomes of {} are not listed one by one", distribution),
                  "only those of Bernoulli, Discrete, Binomial, Multinomial and their like are");
}

void choose_counts(const TableArguments& multinomial, rddl::Place place, Outcomes& outcomes) {
    const auto size = static_cast<std::size_t>(multinomial.size);
    outcomes.choose_multinomial(place, multinomial.int_scalar,
                                {reinterpret_cast<const double*>(multinomial.inputs[0]), size},
                                {reinterpret_cast<std::int64_t*>(multinomial.output), size});
}

// Constant tables for which these bytes leave no room are looked up where they are.
constexpr std::size_t most_packed = std::size_t{1} << 25;

// Writing out all elements of such a table would take much longer than looking up those that are
// read.
bool is_sparse(const Table& table) {
    return table.size() > 64 * (std::ssize(table.exceptions()) + 1024);
}

// Locals of different computations never live together: each computation numbers its own from 0.
void number_lets(const Block& block, std::size_t& next, std::vector<std::size_t>& slots) {
    for (const Statement& statement : block) {
        match(
            statement.form, [&](const Let& let) { slots[let.local.index] = next++; },
            [&](const Loop& loop) { number_lets(loop.body, next, slots); }, [](const auto&) {});
    }
}

template <class T>
T read(const std::byte* from) {
    if constexpr (std::is_same_v<T, bool>) {
        return *from != std::byte{0};
    } else {
        T value;
        std::memcpy(&value, from, sizeof value);
        return value;
    }
}

template <class T>
void write(std::byte* to, T value) {
    static_assert(sizeof(T) == 1 || sizeof(T) == 8);
    std::memcpy(to, &value, sizeof value);
}

}  // namespace

void write_values(const Buffer& buffer, std::byte* to) {
    const auto element = static_cast<std::int64_t>(size_of(buffer.scalar));
    const auto write_at = [&](std::int64_t index, const Value& value) {
        match(value, [&](auto v) { write(to + index * element, v); });
    };
    for (std::int64_t i = 0; i < buffer.values.size(); ++i) write_at(i, buffer.values.common());
    for (const auto& [index, value] : buffer.values.exceptions()) write_at(index, value);
}

// ---------------------------------------------------------------------------- preparation

Evaluator::Evaluator(const Program& program, ExternalFunctions functions)
    : program_(&program), functions_(std::move(functions)) {
    origins_.resize(program.buffers.size());
    for (std::size_t record = 0; record < Records{}.begin.size(); ++record) {
        if (record == static_cast<std::size_t>(Storage::Constant)) continue;
        const RecordLayout layout = record_layout(program, static_cast<Storage>(record));
        for (const Field& field : layout.fields) {
            origins_[field.buffer.index] = {record, field.offset};
        }
    }
    find_passed_tables();
    know_added_tables();
    number_slots();
}

// Tables that are passed as a whole must lie in memory.
void Evaluator::find_passed_tables() {
    for (const Block* block : blocks_of(*program_)) {
        for_each_statement<Call>(*block, [&](const Call& call) {
            for (const TableView& input : call.inputs) passed_.insert(input.buffer);
        });
    }
}

void Evaluator::know_added_tables() {
    origins_.resize(program_->buffers.size());
    for (; packed_ < origins_.size(); ++packed_) {
        const BufferId id{static_cast<std::uint32_t>(packed_)};
        if ((*program_)[id].storage == Storage::Constant) pack(id);
    }
}

void Evaluator::pack(BufferId id) {
    const Buffer& buffer = (*program_)[id];
    Origin& origin = origins_[id.index];
    origin = {static_cast<std::size_t>(Storage::Constant), constants_.size()};
    constexpr std::size_t alignment = 8;
    const std::size_t bytes =
        size_of(buffer.scalar) * static_cast<std::size_t>(buffer.count()) + alignment - 1;
    const bool has_room = bytes <= most_packed - std::min(most_packed, constants_.size());
    origin.is_looked_up = (!has_room || is_sparse(buffer.values)) && !passed_.contains(id);
    if (origin.is_looked_up) return;
    constants_.resize(constants_.size() + bytes / alignment * alignment);
    write_values(buffer, constants_.data() + origin.offset);
}

void Evaluator::number_slots() {
    const std::size_t first_local = program_->variables.size();
    local_slots_.assign(program_->local_count, no_slot);
    slot_count_ = first_local;
    for (const Block* block : blocks_of(*program_)) {
        std::size_t next = first_local;
        number_lets(*block, next, local_slots_);
        slot_count_ = std::max(slot_count_, next);
    }
    for (std::size_t& slot : local_slots_) {
        if (slot == no_slot) slot = slot_count_++;
    }
    weight_slots_.resize(program_->nodes.size());
    for (std::size_t index = 0; index < program_->nodes.size(); ++index) {
        if (const auto* discrete = std::get_if<Discrete>(&program_->nodes[index].form)) {
            weight_slots_[index] = slot_count_;
            slot_count_ += discrete->weights.size();
        }
    }
}

void Evaluator::set(LocalId local, const Value& value, Frame& frame) const {
    Frame::Slot& slot = frame.slots_[local_slots_[local.index]];
    match(value, [&](auto v) { Frame::of<decltype(v)>(slot) = v; });
}

Evaluator::Frame::Frame(const Evaluator& evaluator, Records records, Context& context,
                        Outcomes* outcomes)
    : records_(records), context_(context), outcomes_(outcomes), slots_(room_) {
    records_.set(Storage::Constant, evaluator.constants_.data());
    if (evaluator.slot_count_ > std::size(room_)) {
        more_room_.resize(evaluator.slot_count_);
        slots_ = more_room_.data();
    }
}

template <class T>
T& Evaluator::Frame::of(Slot& slot) {
    if constexpr (std::is_same_v<T, bool>) {
        return slot.boolean;
    } else if constexpr (std::is_same_v<T, double>) {
        return slot.real;
    } else {
        return slot.integer;
    }
}

// ----------------------------------------------------------------------------- statements

void Evaluator::run(const Block& block, Frame& frame) const {
    for (const Statement& statement : block) {
        match(
            statement.form, [&](const Let& form) { let(form, frame); },
            [&](const Store& form) { store(form, frame); },
            [&](const Loop& loop) {
                const std::int64_t size = (*program_)[loop.variable].size;
                for (std::int64_t i = 0; i < size; ++i) {
                    frame.set(loop.variable, i);
                    run(loop.body, frame);
                }
            },
            [&](const Spread& form) { spread(form, frame); },
            [&](const Visit& form) { visit(form, frame); },
            [&](const Call& form) { call(form, frame); });
    }
}

void Evaluator::spread(const Spread& form, Frame& frame) const {
    const auto bits = static_cast<std::uint64_t>(value<std::int64_t>(form.bits, frame));
    std::byte* const row = element(form.target, form.indices, frame);
    const std::int64_t count = (*program_)[form.target].row_size(form.indices.size());
    for (std::int64_t i = 0; i < count; ++i) write(row + i, (bits >> i & 1) != 0);
}

void Evaluator::visit(const Visit& form, Frame& frame) const {
    for (std::int64_t i = 0; i < (*program_)[form.visited].size; ++i) {
        frame.set(form.visited, i);
        if (!value<bool>(form.condition, frame)) continue;
        if (!form.entries) {
            mark(form.marks, frame);
            continue;
        }
        const auto bound = [&](std::int64_t row) {
            return std::get<std::int64_t>((*program_)[form.entries->rows].values[row]);
        };
        for (std::int64_t entry = bound(i); entry < bound(i + 1); ++entry) {
            frame.set(form.entries->variable, entry);
            mark(form.marks, frame);
        }
    }
}

void Evaluator::mark(const std::vector<Mark>& marks, Frame& frame) const {
    for (const Mark& each : marks)
        if (value<bool>(each.condition, frame))
            write(element(each.target, each.indices, frame), each.value);
}

void Evaluator::let(const Let& form, Frame& frame) const {
    Frame::Slot& slot = frame.slots_[local_slots_[form.local.index]];
    switch ((*program_)[form.value].type) {
        case Scalar::Bool:
            slot.boolean = value<bool>(form.value, frame);
            break;
        case Scalar::Int:
            slot.integer = value<std::int64_t>(form.value, frame);
            break;
        case Scalar::Real:
            slot.real = value<double>(form.value, frame);
            break;
    }
}

void Evaluator::store(const Store& form, Frame& frame) const {
    std::byte* target = element(form.target, form.indices, frame);
    switch ((*program_)[form.value].type) {
        case Scalar::Bool:
            write(target, value<bool>(form.value, frame));
            break;
        case Scalar::Int:
            write(target, value<std::int64_t>(form.value, frame));
            break;
        case Scalar::Real:
            write(target, value<double>(form.value, frame));
            break;
    }
}

void Evaluator::call(const Call& form, Frame& frame) const {
    match(form.callee, [&](auto callee) { call(callee, form, frame); });
}

template <class Callee>
void Evaluator::call(Callee callee, const Call& form, Frame& frame) const {
    TableArguments arguments{.size = extent_of(*program_, form).size,
                             .inputs = {},
                             .real_scalar = 0,
                             .int_scalar = 0,
                             .output = element(form.output.buffer, form.output.indices, frame)};
    for (std::size_t i = 0; i < form.inputs.size(); ++i) {
        arguments.inputs[i] = element(form.inputs[i].buffer, form.inputs[i].indices, frame);
    }
    for (NodeId scalar : form.scalars) {
        if ((*program_)[scalar].type == Scalar::Real) {
            arguments.real_scalar = value<double>(scalar, frame);
        } else {
            arguments.int_scalar = value<std::int64_t>(scalar, frame);
        }
    }
    const rddl::Place here = place(form.place, frame);
    call_on_tables(callee, arguments, here, frame.context_);
    if constexpr (std::is_same_v<Callee, VectorDistribution>) {
        if (!frame.outcomes_ || frame.context_.fault) return;
        if (callee != VectorDistribution::Multinomial) refuse_to_list(name_of(*program_, callee));
        choose_counts(arguments, here, *frame.outcomes_);
    }
}

void Evaluator::call(ExternalId callee, const Call& form, Frame& frame) const {
    const auto array = [&](const TableView& view) {
        return array_of(*program_, view, element(view.buffer, view.indices, frame));
    };
    std::array<rddl_array, 8> room;
    std::vector<rddl_array> more_room(form.inputs.size() > room.size() ? form.inputs.size() : 0);
    rddl_array* arguments = more_room.empty() ? room.data() : more_room.data();
    std::ranges::transform(form.inputs, arguments, array);
    const rddl_array result = array(form.output);
    functions_[callee.index](arguments, static_cast<std::int32_t>(form.inputs.size()), &result);
}

void Evaluator::call(Together, const Call& form, Frame& frame) const {
    std::byte* target = element(form.output.buffer, form.output.indices, frame);
    for (const NodeId scalar : form.scalars) {
        write(target, value<double>(scalar, frame));
        target += size_of(Scalar::Real);
    }
}

std::int64_t Evaluator::row_major(BufferId id, const std::vector<NodeId>& indices,
                                  Frame& frame) const {
    const Buffer& buffer = (*program_)[id];
    std::int64_t index = 0;
    for (std::size_t axis = 0; axis < indices.size(); ++axis) {
        index = index * buffer.shape[axis] + value<std::int64_t>(indices[axis], frame);
    }
    for (std::size_t axis = indices.size(); axis < buffer.shape.size(); ++axis) {
        index *= buffer.shape[axis];
    }
    return index;
}

template <class T>
T Evaluator::load(const Load& form, Frame& frame) const {
    if (!origins_[form.buffer.index].is_looked_up) {
        return read<T>(element(form.buffer, form.indices, frame));
    }
    return std::get<T>(
        (*program_)[form.buffer].values[row_major(form.buffer, form.indices, frame)]);
}

std::byte* Evaluator::element(BufferId id, const std::vector<NodeId>& indices, Frame& frame) const {
    const Origin origin = origins_[id.index];
    const auto index = static_cast<std::size_t>(row_major(id, indices, frame));
    const std::size_t offset = index * size_of((*program_)[id].scalar);
    return frame.records_.begin[origin.record] + origin.offset + offset;
}

rddl::Place Evaluator::place(const std::optional<Place>& place, Frame& frame) const {
    if (!place) return {};
    return {place->site.index, value<std::int64_t>(place->index, frame),
            program_->series_of(place->site).index};
}

// ---------------------------------------------------------------------------- expressions

template <class T>
T Evaluator::value(NodeId id, Frame& frame) const {
    constexpr bool is_int = std::is_same_v<T, std::int64_t>;
    return match((*program_)[id].form,  //
                 [&](const Constant& form) -> T { return std::get<T>(form.value); },
                 [&](const Index& form) -> T {
                     if constexpr (is_int) return frame.slots_[form.variable.index].integer;
                     own_mistake("a form of the IR has no value of this type");
                 },
                 [&](const Load& form) -> T { return load<T>(form, frame); },
                 [&](const Search& form) -> T {
                     if constexpr (is_int) return search(form, frame);
                     own_mistake("a form of the IR has no value of this type");
                 },
                 [&](const Bits& form) -> T {
                     if constexpr (is_int) return bits(form, frame);
                     own_mistake("a form of the IR has no value of this type");
                 },
                 [&](const Union& form) -> T {
                     if constexpr (is_int) return united(form, frame);
                     own_mistake("a form of the IR has no value of this type");
                 },
                 [&](const Element& form) -> T {
                     if constexpr (std::is_same_v<T, bool>) return element_at(form, frame);
                     own_mistake("a form of the IR has no value of this type");
                 },
                 [&](const Local& form) -> T {
                     return Frame::of<T>(frame.slots_[local_slots_[form.local.index]]);
                 },
                 [&](const Convert& form) -> T { return convert_operand<T>(form, frame); },
                 [&](const Apply& form) -> T { return apply<T>(form, frame); },
                 [&](const Select& form) -> T {
                     return value<bool>(form.condition, frame) ? value<T>(form.then_value, frame)
                                                               : value<T>(form.else_value, frame);
                 },
                 [&](const Reduce& form) -> T { return reduce<T>(form, frame); },
                 [&](const Sample& form) -> T { return draw<T>(form, frame); },
                 [&](const Discrete& form) -> T {
                     if constexpr (is_int) return draw(form, id, frame);
                     own_mistake("a form of the IR has no value of this type");
                 },
                 [&](const DiscreteOver& form) -> T {
                     if constexpr (is_int) return draw(form, frame);
                     own_mistake("a form of the IR has no value of this type");
                 },
                 [&](const Interval& form) -> T {
                     if constexpr (is_int) return draw(form, frame);
                     own_mistake("a form of the IR has no value of this type");
                 },
                 [&](const Fault& form) -> T {
                     return rddl::fault<T>(frame.context_, place(form.place, frame));
                 });
}

std::int64_t Evaluator::search(const Search& form, Frame& frame) const {
    const Buffer& table = (*program_)[form.table];
    if (table.scalar == Scalar::Real)
        return count_at_most(table.values, value<double>(form.value, frame));
    return count_at_most(table.values, value<std::int64_t>(form.value, frame));
}

std::int64_t Evaluator::bits(const Bits& form, Frame& frame) const {
    const std::byte* const bools = element(form.buffer, form.indices, frame) + form.first;
    const std::int64_t count = (*program_)[form.buffer].row_size(form.indices.size()) - form.first;
    std::uint64_t bits = 0;
    for (std::int64_t i = 0; i < std::min<std::int64_t>(count, 64); ++i)
        bits |= std::uint64_t{bools[i] != std::byte{0}} << i;
    return static_cast<std::int64_t>(bits);
}

std::int64_t Evaluator::united(const Union& form, Frame& frame) const {
    const Buffer& table = (*program_)[form.masks];
    const std::int64_t first = row_major(form.masks, form.row, frame);
    auto bits = static_cast<std::uint64_t>(value<std::int64_t>(form.bits, frame));
    std::int64_t all = 0;
    for (; bits != 0; bits &= bits - 1)
        all |= std::get<std::int64_t>(table.values[first + std::countr_zero(bits)]);
    return all;
}

bool Evaluator::element_at(const Element& form, Frame& frame) const {
    const std::byte* const bools = element(form.buffer, form.indices, frame);
    return bools[value<std::int64_t>(form.place, frame)] != std::byte{0};
}

template <class T>
T Evaluator::convert_operand(const Convert& form, Frame& frame) const {
    if constexpr (!std::is_same_v<T, bool>) {
        if ((*program_)[form.operand].type == Scalar::Bool) {
            return static_cast<T>(value<bool>(form.operand, frame));
        }
    }
    if constexpr (std::is_same_v<T, double>) {
        return rddl::to_real(value<std::int64_t>(form.operand, frame));
    }
    own_mistake("a form of the IR has no value of this type");
}

template <>
bool Evaluator::apply<bool>(const Apply& form, Frame& frame) const {
    const NodeId a = form.operands.front();
    const NodeId b = form.operands.back();
    switch ((*program_)[a].type) {
        case Scalar::Bool:
            return apply_to_bools(form, frame);
        case Scalar::Int:
            return compare(form.op, value<std::int64_t>(a, frame), value<std::int64_t>(b, frame));
        case Scalar::Real:
            return compare(form.op, value<double>(a, frame), value<double>(b, frame));
    }
    own_mistake("a form of the IR has no value of this type");
}

// The right operands of And and Or cannot fault (verify.hpp), so a short circuit changes nothing.
bool Evaluator::apply_to_bools(const Apply& form, Frame& frame) const {
    const bool a = value<bool>(form.operands.front(), frame);
    if (form.op == Operator::Not) return !a;
    if (form.op == Operator::And && !a) return false;
    if (form.op == Operator::Or && a) return true;
    return kernels_of(form.op).of_bools(a, value<bool>(form.operands.back(), frame));
}

template <>
std::int64_t Evaluator::apply<std::int64_t>(const Apply& form, Frame& frame) const {
    const NodeId a = form.operands.front();
    const NodeId b = form.operands.back();
    if ((*program_)[a].type == Scalar::Real)
        return kernels_of(form.op).to_int(value<double>(a, frame));
    const std::int64_t left = value<std::int64_t>(a, frame);
    const std::int64_t right = a == b ? left : value<std::int64_t>(b, frame);
    return kernels_of(form.op).of_ints({left, right, place(form.place, frame), frame.context_});
}

template <>
double Evaluator::apply<double>(const Apply& form, Frame& frame) const {
    const NodeId a = form.operands.front();
    const NodeId b = form.operands.back();
    const double left = value<double>(a, frame);
    const double right = a == b ? left : value<double>(b, frame);
    const double result =
        kernels_of(form.op).of_reals({left, right, place(form.place, frame), frame.context_});
    return rounding_ ? rounding_->of_function(form.op, result) : result;
}

rddl::IndexRange Evaluator::range(const Reduce& form, Frame& frame) const {
    if (!form.bounds) return (*program_)[form.variable].size;
    return {value<std::int64_t>(form.bounds->begin, frame),
            value<std::int64_t>(form.bounds->end, frame)};
}

double Evaluator::reduce_otherwise(const Reduce& form, Frame& frame) const {
    const rddl::IndexRange over = range(form, frame);
    const bool is_sum = form.op == Reduction::Sum;
    double total = is_sum ? 0 : 1;
    for (rddl::Index i = over.begin; i < over.end; ++i) {
        frame.set(form.variable, i);
        const double term = value<double>(form.body, frame);
        total = is_sum ? rounding_->sum(total, term) : rounding_->product(total, term);
    }
    return total;
}

template <class T>
T Evaluator::reduce(const Reduce& form, Frame& frame) const {
    if constexpr (std::is_same_v<T, double>) {
        if (rounding_ && (form.op == Reduction::Sum || form.op == Reduction::Product))
            return reduce_otherwise(form, frame);
    }
    const rddl::IndexRange over = range(form, frame);
    const std::int64_t size = over.end;
    const auto body = [&]<class Body>(Body) {
        return [&](rddl::Index i) {
            frame.set(form.variable, i);
            return value<Body>(form.body, frame);
        };
    };
    if constexpr (std::is_same_v<T, bool>) {
        if (form.op == Reduction::ForAll) return rddl::for_all<bool>(over, body(bool{}));
        return rddl::exists<bool>(over, body(bool{}));
    } else {
        switch (form.op) {
            case Reduction::Sum:
                return rddl::sum<T>(over, body(T{}));
            case Reduction::Product:
                return rddl::product<T>(over, body(T{}));
            case Reduction::Minimum:
                return rddl::minimum_over<T>(size, body(T{}));
            case Reduction::Maximum:
                return rddl::maximum_over<T>(size, body(T{}));
            case Reduction::ForAll:
            case Reduction::Exists:
            case Reduction::Average:
            case Reduction::ArgMin:
            case Reduction::ArgMax:
                break;
        }
    }
    if constexpr (std::is_same_v<T, std::int64_t>) {
        const bool least = form.op == Reduction::ArgMin;
        if ((*program_)[form.body].type == Scalar::Real) {
            return least ? rddl::arg_min<T>(size, body(double{}))
                         : rddl::arg_max<T>(size, body(double{}));
        }
        return least ? rddl::arg_min<T>(size, body(T{})) : rddl::arg_max<T>(size, body(T{}));
    }
    own_mistake("a form of the IR has no value of this type");
}

// ---------------------------------------------------------------------------------- draws

// A draw with outcomes is also made, to record faults of its parameters.
template <class T>
T Evaluator::draw(const Sample& form, Frame& frame) const {
    const rddl::Place here = place(form.place, frame);
    Outcomes* const outcomes = frame.outcomes_;
    if constexpr (std::is_same_v<T, bool>) {
        const double p = value<double>(form.parameters.front(), frame);
        const bool drawn = rddl::sample::bernoulli(frame.context_, here, p);
        if (!outcomes || frame.context_.fault) return drawn;
        const double chance = rddl::clamp_probability(p);
        return outcomes->choose(here, {1 - chance, chance}) == 1;
    } else {
        if constexpr (std::is_same_v<T, std::int64_t>) {
            if (form.distribution == Distribution::Binomial) {
                const std::int64_t n = value<std::int64_t>(form.parameters.front(), frame);
                const double p = value<double>(form.parameters.back(), frame);
                const std::int64_t drawn = rddl::sample::binomial(frame.context_, here, n, p);
                if (!outcomes || frame.context_.fault) return drawn;
                return outcomes->choose(here, binomial_probabilities(n, p));
            }
        }
        const double a = value<double>(form.parameters.front(), frame);
        const double b = form.parameters.size() == 2 ? value<double>(form.parameters[1], frame) : a;
        if (outcomes && !is_certain(form.distribution, a, b))
            refuse_to_list(name_of(form.distribution));
        if constexpr (std::is_same_v<T, double>) {
            return draw_real(form.distribution, {a, b, here, frame.context_});
        } else {
            return draw_int(form.distribution, {a, b, here, frame.context_});
        }
    }
}

std::int64_t Evaluator::draw(const Discrete& form, NodeId id, Frame& frame) const {
    Frame::Slot* weights = frame.slots_ + weight_slots_[id.index];
    for (std::size_t i = 0; i < form.weights.size(); ++i) {
        weights[i].real = value<double>(form.weights[i], frame);
    }
    const auto weight = [&](rddl::Index i) {
        return weights[i].real;
    };
    const auto size = static_cast<rddl::Index>(form.weights.size());
    const rddl::Place here = place(form.place, frame);
    if (frame.outcomes_) return choose(here, form.normalise, size, weight, frame);
    return form.normalise
               ? rddl::sample::unnormalised_discrete_over(frame.context_, here, size, weight)
               : rddl::sample::discrete_over(frame.context_, here, size, weight);
}

std::int64_t Evaluator::draw(const DiscreteOver& form, Frame& frame) const {
    const auto weight = [&](rddl::Index i) {
        frame.set(form.variable, i);
        return value<double>(form.weight, frame);
    };
    const std::int64_t size = (*program_)[form.variable].size;
    const rddl::Place here = place(form.place, frame);
    if (frame.outcomes_) return choose(here, form.normalise, size, weight, frame);
    return form.normalise
               ? rddl::sample::unnormalised_discrete_over(frame.context_, here, size, weight)
               : rddl::sample::discrete_over(frame.context_, here, size, weight);
}

std::int64_t Evaluator::draw(const Interval& form, Frame& frame) const {
    const Buffer& table = (*program_)[form.table];
    std::int64_t first = 0;
    for (std::size_t d = 0; d < form.row.size(); ++d)
        first = first * table.shape[d] + value<std::int64_t>(form.row[d], frame);
    const std::int64_t size = table.shape.back();
    first *= size;
    const auto threshold = [&](std::int64_t i) {
        return std::get<double>(table.values[first + i]);
    };
    const rddl::Place here = place(form.place, frame);
    if (frame.outcomes_) {
        std::vector<double> lengths;
        for (std::int64_t i = 0; i < size; ++i)
            lengths.push_back(threshold(i) - (i > 0 ? threshold(i - 1) : 0.0));
        lengths.push_back(std::max(1.0 - threshold(size - 1), 0.0));
        return frame.outcomes_->choose(here, std::move(lengths));
    }
    const double number = rddl::uniform_at(frame.context_, here);
    std::int64_t interval = 0;
    while (interval < size && threshold(interval) <= number) ++interval;
    return interval;
}

template <class Weight>
std::int64_t Evaluator::choose(rddl::Place place, bool normalise, rddl::Index size, Weight&& weight,
                               Frame& frame) const {
    // Records what is wrong with the weights.
    static_cast<void>(
        normalise ? rddl::sample::unnormalised_discrete_over(frame.context_, place, size, weight)
                  : rddl::sample::discrete_over(frame.context_, place, size, weight));
    if (frame.context_.fault) return 0;
    std::vector<double> weights;
    for (rddl::Index i = 0; i < size; ++i) weights.push_back(std::max(weight(i), 0.0));
    const double total = std::accumulate(weights.begin(), weights.end(), 0.0);
    for (double& each : weights) each /= total;
    return frame.outcomes_->choose(place, std::move(weights));
}

std::optional<Value> Evaluator::value_unless_fault(NodeId id, Frame& frame) const {
    Value result;
    switch ((*program_)[id].type) {
        case Scalar::Bool:
            result = value<bool>(id, frame);
            break;
        case Scalar::Int:
            result = value<std::int64_t>(id, frame);
            break;
        case Scalar::Real:
            result = value<double>(id, frame);
            break;
    }
    if (frame.context_.fault) return std::nullopt;
    return result;
}

template bool Evaluator::value<bool>(NodeId, Frame&) const;
template std::int64_t Evaluator::value<std::int64_t>(NodeId, Frame&) const;
template double Evaluator::value<double>(NodeId, Frame&) const;

}  // namespace rddlc::ir
