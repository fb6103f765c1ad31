// The problem that a page edits: texts that need not be those of any file.
#pragma once

#include "engines/load_simulator.hpp"
#include "problems/problem_lookup.hpp"

#include <filesystem>
#include <optional>
#include <string>

namespace rddlc::studio {

// The problem that a studio was started with.
struct OpenedProblem {
    std::string name;  // for people
    workbench::ProblemFiles files;
    std::string domain, instance;  // texts; `instance` is empty if the domain's file holds both
    // Whether "save" writes the files. Problems of rddlrepository, and the first problem of users
    // who name none, are copies.
    bool can_save = false;
};

OpenedProblem open_problem(const workbench::ProblemFiles& files);
// A small problem to begin with.
OpenedProblem first_problem();

// The texts of one tab.
struct Texts {
    std::string domain, instance;
};

// The use of a simulator, which decides on its engine.
enum class Purpose {
    Stepping,  // the interpreter, which starts at once
    Episodes,  // the engine that the user has chosen
};

// The texts are compiled under the names of the files, without their folders. `policy_block`, if it
// is not empty, is a file with the policy block. Throws a Failure with all errors as its message.
workbench::LoadedProblem load_texts(const OpenedProblem& opened, const Texts& texts,
                                    const workbench::LoadOptions& options, Purpose purpose,
                                    const std::filesystem::path& policy_block = {});

// Writes the texts into the files. Throws a Failure if the problem is a copy, or if a file is not
// what it was when it was read or written last (`known`) and `force` is false. Changes `known` to
// what was written, also where one file was written and the other one could not be.
void save_texts(const OpenedProblem& opened, const Texts& texts, Texts& known, bool force);

// "domain.rddl" and "instance.rddl": the names of the texts on the page.
std::string domain_name(const OpenedProblem& opened);
std::string instance_name(const OpenedProblem& opened);

}  // namespace rddlc::studio
