// Every folder beside this file is a case; cases are not registered. See README.md.
#include "case.hpp"
#include "driver/driver.hpp"
#include "driver/process.hpp"
#include "driver/shared_object.hpp"
#include "engines/external_library.hpp"
#include "engines/interpreted_simulator.hpp"
#include "golden.hpp"
#include "trace.hpp"

#include <dlfcn.h>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

namespace rddlc::testing {
namespace {

namespace fs = std::filesystem;

std::string describe(const Diagnostic& diagnostic, const Compilation& compilation) {
    const std::string place =
        diagnostic.span ? compilation.sources.location(*diagnostic.span) : "(no place)";
    const char* kind = compilation.diagnostics.is_error(diagnostic) ? "error" : "warning";
    return fmt::format("{}: {} {}: {}", place, kind, to_string(diagnostic.code),
                       diagnostic.message);
}

// A part of the message, or of what is said with it: " ... " stands for whatever is between.
bool is_part(const std::string& part, const Diagnostic& diagnostic) {
    constexpr std::string_view gap = " ... ";
    std::string text = diagnostic.message;
    for (const Note& note : diagnostic.notes) text += "; " + note.message;
    text += "; " + diagnostic.hint;
    std::size_t at = 0;
    for (std::size_t begin = 0, end = 0; end != part.npos; begin = end + gap.size()) {
        end = part.find(gap, begin);
        const std::string piece = part.substr(begin, end - begin);
        at = text.find(piece, at);
        if (at == text.npos) return false;
        at += piece.size();
    }
    return true;
}

// A diagnostic without a place in the text may be marked anywhere.
bool fits(const Mark& mark, const Diagnostic& diagnostic, const Compilation& compilation) {
    const char* kind = compilation.diagnostics.is_error(diagnostic) ? "error" : "warning";
    if (mark.kind != kind || mark.code != to_string(diagnostic.code)) return false;
    if (!is_part(mark.message, diagnostic)) return false;
    if (!diagnostic.span) return true;
    return compilation.sources[diagnostic.span->file].path() == mark.file &&
           compilation.sources.position(*diagnostic.span).line == mark.line;
}

void expect_marked_diagnostics(const Case& expected, const Compilation& compilation) {
    std::vector<Mark> missing = expected.marks;
    for (const Diagnostic& diagnostic : compilation.diagnostics.all()) {
        const auto mark = std::ranges::find_if(
            missing, [&](const Mark& each) { return fits(each, diagnostic, compilation); });
        if (mark == missing.end()) {
            ADD_FAILURE() << "not marked: " << describe(diagnostic, compilation);
        } else {
            missing.erase(mark);
        }
    }
    for (const Mark& mark : missing) {
        ADD_FAILURE() << fmt::format("{}:{}: did not occur: {} {}: {}", mark.file, mark.line,
                                     mark.kind, mark.code, mark.message);
    }
}

CompileOptions options_of(const Case& expected) {
    CompileOptions options;
    options.inputs.assign(expected.files.begin(), expected.files.end());
    options.extern_headers = expected.headers;
    options.standard = expected.standard;
    options.instance = expected.instance;
    options.real = expected.real;
    options.diagnostics.disabled_warnings = expected.disabled_warnings;
    return options;
}

// The form of one file with an expectation.
void expect_form(const Case& expected, const std::string& file, Form form) {
    if (!expected.expects(file)) return;
    CompileOptions options = options_of(expected);
    options.print = {form};
    options.stop_after = stage_of(form);
    expect_golden(expected.folder / file, compile(options).printed, "cases");
}

// A part of the emitted text, between two comments of its skeleton.
void expect_part(const Case& expected, const std::string& file, const std::string& text,
                 const std::string& begin, const std::string& end) {
    if (!expected.expects(file)) return;
    const std::size_t from = text.find(begin);
    const std::size_t to = text.find(end);
    const bool found = from != std::string::npos && to != std::string::npos;
    expect_golden(expected.folder / file, found ? text.substr(from, to - from) : "", "cases");
}

#ifdef RDDL_BATCHES

// The C++ compiler's command, with more options before the source.
std::vector<std::string> command_of(const fs::path& source, const fs::path& output,
                                    const std::vector<std::string>& more) {
    auto command = shared_object_command(source, output, Processors::Any);
    command.insert(command.end() - 1, {"-O0", "-Wall", "-Wextra", "-Wshadow", "-Werror"});
    if (*INLINE_LESS) command.insert(command.end() - 1, INLINE_LESS);
    command.insert(command.end() - 1, more.begin(), more.end());
    return command;
}

// The runtime's headers, compiled once for all cases: reading them is a third of the time of each.
// Few cases are faster without.
class PrecompiledRuntime {
  public:
    PrecompiledRuntime() {
        constexpr int few_cases = 5;
        if (::testing::UnitTest::GetInstance()->test_to_run_count() <= few_cases) return;
        fs::create_directory(folder_);
        std::ofstream(header()) << "#include <rddl/simulator.hpp>\n";
        const auto result = run_process(
            command_of(header(), header() + ".gch", {"-DRDDL_LINKS_BATCHES", "-x", "c++-header"}));
        if (result && result->status == 0) options_ = {"-include", header()};
    }
    PrecompiledRuntime(const PrecompiledRuntime&) = delete;
    PrecompiledRuntime& operator=(const PrecompiledRuntime&) = delete;
    ~PrecompiledRuntime() { fs::remove_all(folder_); }

    // The options with which the compiler reads them. Empty if they are not compiled.
    const std::vector<std::string>& options() const { return options_; }

  private:
    std::string header() const { return folder_ / "runtime.hpp"; }

    fs::path folder_ = fs::temp_directory_path() / fmt::format("rddlc-cases-{}", ::getpid());
    std::vector<std::string> options_;
};

// The options for the emitted text of a case. It links the code of batches of doubles; the one of
// floats compiles its own. The headers of external functions come before those of the runtime.
std::vector<std::string> options_for(const Case& expected) {
    static const PrecompiledRuntime runtime;
    std::vector<std::string> options{"-I" + expected.folder.string()};
    if (expected.real == RealType::Float) return options;
    options.insert(options.end(), {"-DRDDL_LINKS_BATCHES", RDDL_BATCHES});
    if (expected.headers.empty())
        options.insert(options.end(), runtime.options().begin(), runtime.options().end());
    return options;
}

// Compiled without any warning, and loaded.
class LoadedSimulator {
  public:
    LoadedSimulator(const std::string& name, const std::vector<std::string>& options) {
        const fs::path object = fs::absolute(name + ".so");
        const auto result = run_process(command_of(name + ".cpp", object, options));
        if (!result || result->status != 0) {
            ADD_FAILURE() << "the emitted text does not compile:\n"
                          << (result ? result->output : "no C++ compiler");
            return;
        }
        library_ = ::dlopen(object.c_str(), RTLD_NOW | RTLD_LOCAL);
        if (!library_) {
            ADD_FAILURE() << ::dlerror();
            return;
        }
        const auto entry = reinterpret_cast<rddl_simulator_entry_function>(
            ::dlsym(library_, "rddl_simulator_entry"));
        if (entry) simulator_ = entry();
        if (!simulator_) ADD_FAILURE() << "rddl_simulator_entry is missing";
    }
    LoadedSimulator(const LoadedSimulator&) = delete;
    LoadedSimulator& operator=(const LoadedSimulator&) = delete;
    ~LoadedSimulator() {
        if (library_) ::dlclose(library_);
    }

    const rddl_simulator* get() const { return simulator_; }

  private:
    void* library_ = nullptr;
    const rddl_simulator* simulator_ = nullptr;
};

// The compiled simulator makes the same trace, and the same steps in a batch, unless it computes
// with floats.
void expect_compiled_trace(const Case& expected, const Compilation& compilation,
                           const rddl_simulator& interpreted, const std::string& trace) {
    // A name of its own each: the loader knows what it has loaded by name.
    const std::string case_name = expected.folder.filename().string();
    const std::string name =
        fs::temp_directory_path() / fmt::format("rddlc-{}-{}", case_name, ::getpid());
    const auto written = std::unique_ptr<FILE, int (*)(FILE*)>(
        std::fopen((name + ".cpp").c_str(), "w"), &std::fclose);
    ASSERT_TRUE(written);
    fmt::print(written.get(), "{}", compilation.text);
    std::fflush(written.get());
    const LoadedSimulator compiled(name, options_for(expected));
    if (compiled.get() && expected.real == RealType::Double) {
        EXPECT_EQ(unified_diff(trace, trace_of(*compiled.get())), "") << "compiled differs";
        EXPECT_EQ(difference_in_batches(interpreted, *compiled.get()), "");
    }
    fs::remove(name + ".cpp");
    fs::remove(name + ".so");
}

#endif

// The interpreter's trace is the expected one, and that of the compiled simulator.
void expect_trace(const Case& expected, const Compilation& compilation) {
    workbench::LoadOptions load;
    load.externs = expected.headers;
    const auto interpreted = workbench::interpreted_simulator(
        *compilation.program, compilation.sources,
        workbench::external_library(*compilation.program, {}, load));
    const std::string trace = trace_of(*interpreted);
    if (expected.expects("trace.exp")) expect_golden(expected.folder / "trace.exp", trace, "cases");
#ifdef RDDL_BATCHES
    expect_compiled_trace(expected, compilation, *interpreted, trace);
#endif
}

// The text from the step for moderate values on, if there is one: it makes most steps.
std::string usual_step(const std::string& text) {
    const std::size_t begin = text.find("namespace moderate {");
    return begin == text.npos ? text : text.substr(begin);
}

class Cases : public ::testing::TestWithParam<fs::path> {};

TEST_P(Cases, AreAsExpected) {
    // Paths in texts and messages are relative to the case.
    fs::current_path(GetParam());
    const Case expected = read_case(GetParam());
    const Compilation compilation = compile(options_of(expected));
    expect_marked_diagnostics(expected, compilation);

    expect_form(expected, "model.exp", Form::Model);
    expect_form(expected, "ir.exp", Form::Ir);
    expect_form(expected, "ir-opt.exp", Form::OptimisedIr);
    expect_form(expected, "sim.cpp.exp", Form::Cpp);
    expect_part(expected, "tables.exp", compilation.text, "namespace ",
                "template <class L>\nstruct State");
    expect_part(expected, "reset.exp", compilation.text, "    // The initial state",
                "    // All CPFs");
    expect_part(expected, "step.exp", usual_step(compilation.text), "    // All CPFs",
                "    // The reward of");
    expect_part(expected, "policy.exp", compilation.text, "// The policy block", "static_assert");
    const bool runs = std::ranges::any_of(
        std::array{"sim.cpp.exp", "tables.exp", "reset.exp", "step.exp", "policy.exp", "trace.exp"},
        [&](const char* file) { return expected.expects(file); });
    if (runs && compilation.program) expect_trace(expected, compilation);
}

std::string name_of_case(const ::testing::TestParamInfo<fs::path>& info) {
    std::string name = info.param.filename().string();
    std::ranges::replace_if(
        name, [](unsigned char c) { return !std::isalnum(c); }, '_');
    return name;
}

INSTANTIATE_TEST_SUITE_P(, Cases, ::testing::ValuesIn(find_cases(RDDLC_CASES_FOLDER)),
                         name_of_case);

}  // namespace
}  // namespace rddlc::testing
