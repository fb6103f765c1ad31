#include "emit/names/names.hpp"

#include "ir/shifted_row.hpp"

#include <map>
#include <set>
#include <stdexcept>
#include <string_view>
#include <utility>

namespace rddlc::cpp {
namespace {

using ir::Storage;

// The names of a program.
constexpr Mark count_mark{"", "_count"};
constexpr Mark table_mark{"", "_"};
constexpr Mark initial_mark{"initial_", ""};
constexpr Mark function_mark{"set_", ""};
constexpr Mark sliding_buffer_mark{"", "_buffer"};

// Each record has a region of its own, except that Next is State again, and NextMemory Memory.
struct RecordScopes {
    explicit RecordScopes(const Scope& file)
        : state(&file), action(&file), scratch(&file), observation(&file), memory(&file) {}

    Scope& of(Storage storage) {
        switch (storage) {
            case Storage::Action:
                return action;
            case Storage::Scratch:
                return scratch;
            case Storage::Observation:
                return observation;
            case Storage::Memory:
                return memory;
            case Storage::Constant:
            case Storage::State:
            case Storage::Next:
            case Storage::NextMemory:
                break;
        }
        return state;
    }

    Scope state, action, scratch, observation, memory;
};

bool is_next(const ir::Buffer& buffer) {
    return buffer.storage == Storage::Next || buffer.storage == Storage::NextMemory;
}

void name_members(const ir::Program& program, Names& all) {
    RecordScopes records(all.file);
    std::vector<std::string>& names = all.buffers;
    std::map<std::pair<Storage, std::string_view>, std::size_t> currents;
    for (std::size_t index = 0; index < program.buffers.size(); ++index) {
        const ir::Buffer& buffer = program.buffers[index];
        if (buffer.storage == Storage::Constant || is_next(buffer)) continue;
        names[index] = records.of(buffer.storage).claim(buffer.name);
        currents.emplace(std::pair(buffer.storage, std::string_view(buffer.name)), index);
    }
    // A next value is the member of State or Memory that it will become.
    for (std::size_t index = 0; index < program.buffers.size(); ++index) {
        const ir::Buffer& buffer = program.buffers[index];
        if (!is_next(buffer)) continue;
        const bool is_state = buffer.storage == Storage::Next;
        const Storage current = is_state ? Storage::State : Storage::Memory;
        names[index] = names[currents.at({current, buffer.name})];
    }
    all.sliding_buffers.resize(program.buffers.size());
    const std::set<std::string> shifted = ir::sliding_tables(program);
    for (std::size_t index = 0; index < program.buffers.size(); ++index)
        if (program.buffers[index].storage == Storage::State &&
            shifted.contains(program.buffers[index].name))
            all.sliding_buffers[index] =
                records.state.claim(program.buffers[index].name, sliding_buffer_mark);
    for (std::size_t index = 0; index < program.buffers.size(); ++index)
        if (program.buffers[index].storage == Storage::Next)
            all.sliding_buffers[index] =
                all.sliding_buffers[currents.at({Storage::State, program.buffers[index].name})];
}

}  // namespace

RecordWords words_of(Storage storage) {
    switch (storage) {
        case Storage::State:
            return {"State", "state"};
        case Storage::Action:
            return {"Action", "action"};
        case Storage::Scratch:
            return {"Scratch", "scratch"};
        case Storage::Next:
            return {"State", "next"};
        case Storage::Observation:
            return {"Observation", "observation"};
        case Storage::Memory:
            return {"PolicyMemory", "memory"};
        case Storage::NextMemory:
            return {"PolicyMemory", "next_memory"};
        case Storage::Constant:
            break;
    }
    throw std::logic_error("a constant lies in no record");
}

std::string lane_type(ir::Scalar scalar) {
    if (scalar == ir::Scalar::Bool) return "Bool";
    return scalar == ir::Scalar::Int ? "Int" : "Real";
}

std::string table_type(ir::Scalar scalar, RealType real) {
    if (scalar == ir::Scalar::Bool) return "bool";
    return scalar == ir::Scalar::Int ? "std::int64_t" : std::string(name_of(real));
}

std::vector<std::string> function_words() {
    std::vector<std::string> words = {"context", "numbers", "normals", "k", "Bool", "Int", "Real"};
    for (const Storage storage : {Storage::State, Storage::Action, Storage::Scratch, Storage::Next,
                                  Storage::Observation, Storage::Memory, Storage::NextMemory})
        words.push_back(words_of(storage).parameter);
    return words;
}

Names names_of(const ir::Program& program) {
    Names names;
    const std::string problem = program.domain_name + "_" + program.instance_name;
    names.space = identifier(problem);
    names.entry = "rddl_simulator_" + plain_identifier(problem);

    for (const ir::ObjectType& type : program.types) {
        names.counts.push_back(names.file.claim(type.name, count_mark));
    }
    names.buffers.resize(program.buffers.size());
    for (std::size_t index = 0; index < program.buffers.size(); ++index) {
        const ir::Buffer& buffer = program.buffers[index];
        if (buffer.storage == Storage::Constant)
            names.buffers[index] = names.file.claim(buffer.name, table_mark);
    }
    name_members(program, names);

    // One value, or the same everywhere, needs no table.
    names.initial.resize(program.buffers.size());
    for (std::size_t index = 0; index < program.buffers.size(); ++index) {
        const ir::Buffer& buffer = program.buffers[index];
        const bool starts = buffer.storage == Storage::State || buffer.storage == Storage::Action;
        if (!starts || buffer.values.empty() || buffer.values.is_uniform()) continue;
        names.initial[index] = names.file.claim(buffer.name, initial_mark);
    }

    Scope simulator(&names.file);
    for (const ir::Definition& definition : program.step) {
        names.functions.push_back(simulator.claim(program[definition.target].name, function_mark));
    }
    if (program.policy) {
        Scope policy(&names.file);
        for (const ir::Definition& definition : program.policy->act) {
            names.policy_functions.push_back(
                policy.claim(program[definition.target].name, function_mark));
        }
    }
    return names;
}

}  // namespace rddlc::cpp
