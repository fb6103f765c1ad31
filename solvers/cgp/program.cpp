#include "solvers/cgp/program.hpp"

#include "solvers/cgp/compute.hpp"

#include <algorithm>
#include <bit>

namespace rddlc::solvers {

namespace {

// Calls have places of their own behind all constants while a program is built.
constexpr int first_call = 1 << 24;

int arity_of(Function function) {
    return info_of(function).arity;
}

}  // namespace

Program::Program(const Genome& genome) : delayed_(genome.delayed) {
    const Activity activity = activity_of(genome);
    nodes_ = activity.nodes;
    const auto first_node = static_cast<std::size_t>(genome.first_node());
    std::vector<int> places(activity.used.size());
    for (std::size_t a = 0; a < first_node; ++a) {
        const int address = static_cast<int>(a), constant = address - genome.inputs;
        if (constant < 0)
            places[a] = -1 - address;
        else if (activity.used[a])
            places[a] = place_of_constant(genome.constants[static_cast<std::size_t>(constant)]);
    }
    if (delayed_) {  // nodes may read others behind them; those that are not computed are 0
        int calls = 0;
        for (std::size_t a = first_node; a < places.size(); ++a)
            places[a] = activity.used[a] ? first_call + calls++ : place_of_constant(0);
    }
    for (std::size_t n = 0; n < genome.nodes.size(); ++n) {
        if (!activity.used[first_node + n]) continue;
        const Node& node = genome.nodes[n];
        Instruction call{node.function, {}};
        for (std::size_t k = 0; static_cast<int>(k) < arity_of(node.function); ++k)
            call.arguments[k] = places[static_cast<std::size_t>(node.arguments[k])];
        if (delayed_)
            instructions_.push_back(call);
        else
            places[first_node + n] = place_of_call(call);
    }
    for (const int output : genome.outputs)
        outputs_.push_back(places[static_cast<std::size_t>(output)]);
    keep_what_outputs_need();
}

int Program::place_of_constant(double value) {
    const auto known = std::find_if(constants_.begin(), constants_.end(), [&](double each) {
        return std::bit_cast<std::uint64_t>(each) == std::bit_cast<std::uint64_t>(value);
    });
    if (known == constants_.end()) {
        constants_.push_back(value);
        return static_cast<int>(constants_.size()) - 1;
    }
    return static_cast<int>(known - constants_.begin());
}

int Program::place_of_call(const Instruction& call) {
    const int arity = arity_of(call.function);
    std::array<double, 3> values{};
    bool folds = true;
    for (std::size_t k = 0; static_cast<int>(k) < arity; ++k) {
        const int place = call.arguments[k];
        folds &= place >= 0 && place < first_call;
        if (folds) values[k] = constants_[static_cast<std::size_t>(place)];
    }
    if (folds) return place_of_constant(apply(call.function, values[0], values[1], values[2]));
    const auto known = std::find(instructions_.begin(), instructions_.end(), call);
    const auto number = static_cast<int>(known - instructions_.begin());
    if (known == instructions_.end()) instructions_.push_back(call);
    return first_call + number;
}

// Also gives every value its final slot.
void Program::keep_what_outputs_need() {
    std::vector<int> calls(instructions_.size(), -1), constants(constants_.size(), -1);
    std::vector<int> open = outputs_;
    while (!open.empty()) {
        const int place = open.back();
        open.pop_back();
        if (place < 0) {
            used_inputs_.push_back(-1 - place);
        } else if (place < first_call) {
            constants[static_cast<std::size_t>(place)] = 0;
        } else if (int& call = calls[static_cast<std::size_t>(place - first_call)]; call < 0) {
            call = 0;
            const Instruction& needed = instructions_[static_cast<std::size_t>(place - first_call)];
            open.insert(open.end(), needed.arguments.begin(),
                        needed.arguments.begin() + arity_of(needed.function));
        }
    }
    std::sort(used_inputs_.begin(), used_inputs_.end());
    used_inputs_.erase(std::unique(used_inputs_.begin(), used_inputs_.end()), used_inputs_.end());
    std::size_t kept = 0;
    for (std::size_t c = 0; c < constants.size(); ++c)
        if (constants[c] == 0) {
            constants_[kept] = constants_[c];
            constants[c] = slots_++;
            ++kept;
        }
    constants_.resize(kept);
    for (int& call : calls)
        if (call == 0) call = slots_++;
    const auto slot_of = [&](int& place) {
        if (place >= first_call)
            place = calls[static_cast<std::size_t>(place - first_call)];
        else if (place >= 0)
            place = constants[static_cast<std::size_t>(place)];
    };
    kept = 0;
    for (std::size_t i = 0; i < instructions_.size(); ++i) {
        if (calls[i] < 0) continue;
        Instruction call = instructions_[i];
        std::for_each(call.arguments.begin(), call.arguments.begin() + arity_of(call.function),
                      slot_of);
        instructions_[kept++] = call;
    }
    instructions_.resize(kept);
    std::for_each(outputs_.begin(), outputs_.end(), slot_of);
}

std::uint64_t Program::hash() const {
    std::uint64_t hash = 0xCBF29CE484222325;
    const auto add = [&](std::uint64_t number) {
        hash = (hash ^ number) * 0x9E3779B97F4A7C15;
        hash ^= hash >> 29;
    };
    add(constants_.size());
    for (const double constant : constants_) add(std::bit_cast<std::uint64_t>(constant));
    for (const Instruction& call : instructions_) {
        add(static_cast<std::uint64_t>(call.function));
        for (const int argument : call.arguments) add(static_cast<std::uint64_t>(argument));
    }
    for (const int output : outputs_) add(static_cast<std::uint64_t>(output));
    return hash;
}

void Program::run(int lanes, const double* inputs, std::ptrdiff_t input_row, double* values,
                  double* outputs) const {
    if (lanes == 1) return run_one(inputs, input_row, values, outputs);
    const double* const read = remembered(lanes, values);
    const auto at = [&](int place, const double* nodes) {
        return place < 0 ? inputs + (-1 - place) * input_row : nodes + place * lanes;
    };
    for (std::size_t c = 0; c < constants_.size(); ++c)
        std::fill_n(values + static_cast<std::ptrdiff_t>(c) * lanes, lanes, constants_[c]);
    double* result = values + static_cast<std::ptrdiff_t>(constants_.size()) * lanes;
    for (const Instruction& call : instructions_) {
        apply(call.function, lanes, at(call.arguments[0], read), at(call.arguments[1], read),
              at(call.arguments[2], read), result);
        result += lanes;
    }
    for (std::size_t o = 0; o < outputs_.size(); ++o)
        std::copy_n(at(outputs_[o], values), lanes,
                    outputs + static_cast<std::ptrdiff_t>(o) * lanes);
}

// The same without loops over one lane, which would cost more than what they do.
void Program::run_one(const double* inputs, std::ptrdiff_t input_row, double* values,
                      double* outputs) const {
    const double* const read = remembered(1, values);
    const auto at = [&](int place, const double* nodes) {
        return place < 0 ? inputs[(-1 - place) * input_row] : nodes[place];
    };
    std::copy(constants_.begin(), constants_.end(), values);
    double* result = values + constants_.size();
    for (const Instruction& call : instructions_) {
        const double a = at(call.arguments[0], read), b = at(call.arguments[1], read),
                     c = at(call.arguments[2], read);
        with(call.function, [&](auto compute) { *result++ = compute(a, b, c); });
    }
    for (const int output : outputs_) *outputs++ = at(output, values);
}

// The values that nodes read: in a delayed program a copy of the values of the step before.
const double* Program::remembered(int lanes, double* values) const {
    if (!delayed_) return values;
    const std::ptrdiff_t count = std::ptrdiff_t{slots_} * lanes;
    std::copy_n(values, count, values + count);
    return values + count;
}

}  // namespace rddlc::solvers
