// The compiler as one function: the table of contents of everything below compiler/.
#pragma once

#include "ast/ast.hpp"
#include "emit/emit.hpp"
#include "ir/details.hpp"
#include "ir/ir.hpp"
#include "model/model.hpp"
#include "passes/passes.hpp"
#include "support/diagnostic.hpp"
#include "support/files.hpp"
#include "support/memory.hpp"
#include "support/source.hpp"
#include "support/standard.hpp"

#include <chrono>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace rddlc {

// The stages in the order in which they run.
enum class Stage { Read, Parse, Check, Ground, Verify, Optimise, Emit, Write };
std::string_view name_of(Stage stage);  // "read", ...
std::optional<Stage> stage_named(std::string_view name);

// The forms that a problem takes on its way, and their names: ast, model, ir, ir-opt, cpp.
enum class Form { Ast, Model, Ir, OptimisedIr, Cpp };
std::string_view name_of(Form form);
std::optional<Form> form_named(std::string_view name);
Stage stage_of(Form form);  // the stage that makes it

struct CompileOptions {
    std::vector<std::filesystem::path> inputs;    // domain and instance, or one file with both
    std::optional<std::filesystem::path> policy;  // of which the policy block alone is taken
    std::string instance;                         // its name; empty: the last one
    // Texts of inputs by their paths, to be taken instead of the files, such as those in an editor.
    std::map<std::filesystem::path, std::string> texts;
    // .cpp, .hpp or .so; absent: nothing is written.
    std::optional<std::filesystem::path> output;
    // A .so for any processor of the architecture, not only for those like this one.
    bool portable = false;
    // Where prepare_runtime (driver/shared_object.hpp) has put its files for a .so that is not
    // portable, if there are any. Asked when one is made; may be empty.
    std::function<std::optional<std::filesystem::path>()> prepared_runtime;
    // C++ headers that define the external functions.
    std::vector<std::filesystem::path> extern_headers;
    // A file that holds a domain and no instance is checked, as far as that can be done, and no
    // more.
    bool domain_may_stand_alone = false;
    std::set<Form> print;
    Stage stop_after = Stage::Write;
    std::string entry;  // the function that the output exports; empty: named after the problem
    bool line_directives = false;
    // Environments in a pack; absent: chosen for the problem (ir/lane_count.hpp).
    std::optional<int> lane_count;
    RealType real = RealType::Double;
    bool details = false;  // what a step computes on its way can be asked for
    std::int64_t memory_limit = default_memory_limit;  // bytes of one environment
    // A C header that declares the function which the output exports.
    std::optional<std::filesystem::path> declaration_file;
    // A make rule that names the inputs of the output.
    std::optional<std::filesystem::path> dependency_file;
    DiagnosticOptions diagnostics;
    Standard standard = Standard::PyRddlGym;
    PassOptions passes;
    // Adds to what was written in the files before it is checked, such as the expressions of a
    // scene.
    std::function<void(ast::Program&, Sources&, Diagnostics&)> extend;
};

struct StageTime {
    Stage stage;
    std::chrono::duration<double> time;
};

// The results of a compilation; those of stages after an error or after `stop_after` are absent.
struct Compilation {
    explicit Compilation(const DiagnosticOptions& options) : diagnostics(options) {}

    Sources sources;
    UsedFiles used;  // inputs, and outputs that are written
    Diagnostics diagnostics;
    bool is_domain_alone = false;  // without an instance, which was not needed
    std::optional<model::Model> model;
    std::optional<ir::Program> program;  // optimised, if it came so far
    std::optional<ir::Details> details;  // if they are wanted
    std::string text;                    // the emitted C++
    std::string declaration;             // of what it exports
    std::string printed;                 // the forms asked for, in the order of the stages
    std::vector<StageTime> times;
    std::vector<PassRun> passes;
};

// Never throws for what users can do; std::logic_error is a mistake of the compiler itself.
Compilation compile(const CompileOptions& options);

// Goes on from one that stopped after the stage Optimise to the text, with the same options. Only
// its sources, program and details are used.
Compilation emit_compilation(Compilation optimised, const CompileOptions& options);

// The names of all optimisations, in their order.
std::vector<std::string> pass_names();

// Why this is not the name of a pass, for users: "there is no pass 'x'; did you mean 'y'?".
std::optional<std::string> complaint_about_pass(std::string_view name);

// The lines below diagnostics: their number, how `program` explains the first error, and what was
// not checked for lack of an instance. Empty if there is nothing to report.
std::string closing_lines(const Compilation& compilation, std::string_view program);

// "no instance was given: ..."
extern const std::string_view no_instance_given;

}  // namespace rddlc
