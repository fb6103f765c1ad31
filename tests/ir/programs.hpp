// Small programs made by hand.
#pragma once

#include "ir/builder.hpp"
#include "ir/ir.hpp"

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace rddlc::ir {

// The state of the workbench as a C struct.
struct WorkbenchState {
    bool running[3];
    double level;
    std::int64_t count;
};

// A program with one type of three objects, a variable over them, and a buffer of each kind.
struct Workbench {
    Workbench() {
        program.domain_name = "d";
        program.instance_name = "i";
        program.types = {{"computer", false, {"c1", "c2", "c3"}}};
        program.variables = {{"c", 0, 3}, {"d", 0, 3}, {"only", 0, 1}, {"none", 0, 0}};
        program.sites = {{{}, {c}, "Bernoulli"}, {{}, {}, "pow"}, {{}, {c}, "Normal"}};
        add("REBOOT-PROB", Storage::Constant, Scalar::Real, false, {0.5});
        add("CONNECTED", Storage::Constant, Scalar::Bool, true, {true, false, true});
        add("running", Storage::State, Scalar::Bool, true, {true, true, false});
        add("level", Storage::State, Scalar::Real, false, {2.0});
        add("count", Storage::State, Scalar::Int, false, {std::int64_t{7}});
        add("reboot", Storage::Action, Scalar::Bool, true, {false, false, false});
        add("seen", Storage::Scratch, Scalar::Bool, true, {});
        add("running", Storage::Next, Scalar::Bool, true, {});
        add("level", Storage::Next, Scalar::Real, false, {});
        add("count", Storage::Next, Scalar::Int, false, {});
        program.reward.value = builder().constant(0.0);
    }

    Builder& builder() {
        if (!builder_) builder_.emplace(program);
        return *builder_;
    }

    BufferId add(std::string name, Storage storage, Scalar scalar, bool per_computer,
                 std::vector<Value> values) {
        Buffer buffer{std::move(name), storage, scalar, {}, {}, {}, std::move(values), {}};
        if (per_computer) {
            buffer.shape = {3};
            buffer.types = {0};
        }
        program.buffers.push_back(std::move(buffer));
        return {static_cast<std::uint32_t>(program.buffers.size() - 1)};
    }

    NodeId real(double value) { return builder().constant(value); }
    NodeId integer(std::int64_t value) { return builder().constant(value); }
    NodeId boolean(bool value) { return builder().constant(value); }
    NodeId at(BufferId buffer, VariableId variable) {
        return builder().load(buffer, {builder().index(variable)});
    }
    NodeId load(BufferId buffer) { return builder().load(buffer, {}); }
    NodeId apply(Operator op, NodeId a) { return builder().apply(op, {a}); }
    NodeId apply(Operator op, NodeId a, NodeId b) { return builder().apply(op, {a, b}); }
    // int ^ int: may fault unless the exponent is known.
    NodeId int_power(NodeId a, NodeId b) {
        return builder().apply(Operator::Power, {a, b}, Place{SiteId{1}, integer(0)});
    }
    NodeId bernoulli(NodeId p) {
        const Place place{SiteId{0}, builder().index(c)};
        return builder().sample(Scalar::Bool, Distribution::Bernoulli, place, {p});
    }

    // for v in computer { target[v] = value }
    Definition fill(BufferId target, VariableId variable, NodeId value) {
        Store store{target, {builder().index(variable)}, value};
        return {target, {{Loop{variable, {{store}}}}}, {}};
    }
    Definition assign(BufferId target, NodeId value) {
        return {target, {{Store{target, {}, value}}}, {}};
    }

    static constexpr VariableId c{0}, d{1}, only{2}, none{3};
    static constexpr BufferId reboot_prob{0}, connected{1}, running{2}, level{3}, count{4},
        reboot{5}, seen{6}, next_running{7}, next_level{8}, next_count{9};

    Program program;

  private:
    std::optional<Builder> builder_;
};

// A complete step: every next-state buffer is filled.
inline void add_step(Workbench& w) {
    const NodeId up = w.at(Workbench::running, Workbench::c);
    const NodeId reboots = w.at(Workbench::reboot, Workbench::c);
    const NodeId draw = w.bernoulli(w.load(Workbench::reboot_prob));
    w.program.step = {
        w.fill(Workbench::seen, Workbench::c,
               w.apply(Operator::And, up, w.at(Workbench::connected, Workbench::c))),
        w.fill(Workbench::next_running, Workbench::c,
               w.builder().select(reboots, w.boolean(true), w.apply(Operator::And, up, draw))),
        w.assign(Workbench::next_level,
                 w.apply(Operator::Multiply, w.load(Workbench::level), w.real(1.5))),
        w.assign(Workbench::next_count,
                 w.apply(Operator::Add, w.load(Workbench::count), w.integer(1))),
    };
    const NodeId seen = w.at(Workbench::seen, Workbench::c);
    w.program.reward.value =
        w.builder().reduce(Reduction::Sum, Workbench::c, w.builder().convert(seen, Scalar::Real));
    const NodeId small = w.apply(Operator::LessEqual, w.load(Workbench::count), w.integer(8));
    w.program.invariants = {{{}, small, {}}};
    w.program.terminations = {
        {{}, w.apply(Operator::Greater, w.load(Workbench::level), w.real(4.0)), {}}};
    w.program.preconditions = {
        {{},
         w.builder().reduce(Reduction::Exists, Workbench::c, w.at(Workbench::reboot, Workbench::c)),
         {}}};
}

}  // namespace rddlc::ir
