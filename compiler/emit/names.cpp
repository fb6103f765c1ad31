#include "emit/names.hpp"

#include "emit/tables.hpp"

#include <algorithm>

namespace rddlc::cpp {
namespace {

using ir::Storage;

// What emitted functions call their parameters and types: no table may hide them.
const std::vector<std::string> file_words = {
    "State", "Action", "Scratch", "Observation", "Simulator",   "Bool",    "Int",  "Real",
    "state", "action", "scratch", "next",        "observation", "context", "about"};

const std::vector<std::string> policy_file_words = {"Policy", "PolicyMemory", "memory",
                                                    "next_memory"};

// The members of Policy.
const std::vector<std::string> policy_words = {"Memory", "reset", "act"};

// The members of Simulator.
const std::vector<std::string> simulator_words = {
    "reset",     "step",         "reward",          "termination",        "termination_count",
    "invariant", "precondition", "invariant_count", "precondition_count", "partially_observed"};

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
            default:
                return state;
        }
    }

    Scope state, action, scratch, observation, memory;
};

bool is_next(const ir::Buffer& buffer) {
    return buffer.storage == Storage::Next || buffer.storage == Storage::NextMemory;
}

// A next value is the member of State or Memory that it will become.
std::size_t current_of(const ir::Program& program, const ir::Buffer& next) {
    const Storage current = next.storage == Storage::Next ? Storage::State : Storage::Memory;
    const auto found = std::ranges::find_if(program.buffers, [&](const ir::Buffer& buffer) {
        return buffer.storage == current && buffer.name == next.name;
    });
    return static_cast<std::size_t>(found - program.buffers.begin());
}

void name_members(const ir::Program& program, const Scope& file, std::vector<std::string>& names) {
    RecordScopes records(file);
    for (std::size_t index = 0; index < program.buffers.size(); ++index) {
        const ir::Buffer& buffer = program.buffers[index];
        if (buffer.storage == Storage::Constant || is_next(buffer)) continue;
        names[index] = records.of(buffer.storage).claim(buffer.name);
    }
    for (std::size_t index = 0; index < program.buffers.size(); ++index) {
        const ir::Buffer& buffer = program.buffers[index];
        if (is_next(buffer)) names[index] = names[current_of(program, buffer)];
    }
}

}  // namespace

Names names_of(const ir::Program& program) {
    Names names;
    const std::string problem = program.domain_name + "_" + program.instance_name;
    names.space = identifier(problem);
    names.entry = "rddl_simulator_" + names.space;
    std::vector<std::string> words = file_words;
    if (program.policy)
        words.insert(words.end(), policy_file_words.begin(), policy_file_words.end());
    names.file = Scope(nullptr, words);

    for (const ir::ObjectType& type : program.types) {
        names.counts.push_back(names.file.claim(type.name + "_count"));
    }
    names.buffers.resize(program.buffers.size());
    for (std::size_t index = 0; index < program.buffers.size(); ++index) {
        const ir::Buffer& buffer = program.buffers[index];
        if (buffer.storage == Storage::Constant)
            names.buffers[index] = names.file.claim(buffer.name);
    }
    name_members(program, names.file, names.buffers);

    // One value, or the same everywhere, needs no table.
    names.initial.resize(program.buffers.size());
    for (std::size_t index = 0; index < program.buffers.size(); ++index) {
        const ir::Buffer& buffer = program.buffers[index];
        const bool starts = buffer.storage == Storage::State || buffer.storage == Storage::Action;
        if (!starts || buffer.values.empty() || buffer.values.is_uniform()) continue;
        names.initial[index] = names.file.claim("initial_" + buffer.name);
    }

    Scope simulator(&names.file, simulator_words);
    for (const ir::Definition& definition : program.step) {
        names.functions.push_back(simulator.claim(program[definition.target].name));
    }
    if (program.policy) {
        Scope policy(&names.file, policy_words);
        for (const ir::Definition& definition : program.policy->act) {
            names.policy_functions.push_back(policy.claim(program[definition.target].name));
        }
    }
    const auto claim_all = [&](std::size_t count, const std::string& word) {
        std::vector<std::string> claimed;
        for (std::size_t k = 0; k < count; ++k) {
            claimed.push_back(simulator.claim(word + "_" + std::to_string(k)));
        }
        return claimed;
    };
    names.preconditions = claim_all(program.preconditions.size(), "precondition");
    names.invariants = claim_all(program.invariants.size(), "invariant");
    names.terminations = claim_all(program.terminations.size(), "termination");
    return names;
}

}  // namespace rddlc::cpp
