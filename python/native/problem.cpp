#include "native/problem.hpp"

#include "driver/cpp_compiler.hpp"
#include "driver/version.hpp"
#include "native/describe.hpp"
#include "native/paths.hpp"
#include "problems/problem_lookup.hpp"
#include "support/failure.hpp"
#include "support/render.hpp"
#include "support/utf8.hpp"

#include <fmt/format.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <utility>
#include <vector>

namespace nb = nanobind;

namespace rddlc::python {

namespace {

using workbench::LoadedProblem;

workbench::ProblemFiles files_of(const std::string& domain, const std::string& instance,
                                 const std::string& repository) {
    if (repository.empty() || workbench::is_path(domain))
        return workbench::find_files(domain, instance);
    const workbench::Repository scanned = workbench::scan_repository(repository);
    return workbench::find_instance(workbench::find_problem(scanned, domain), instance);
}

std::string text_of(const Compilation& compilation) {
    std::string text = rddlc::render(compilation.diagnostics, compilation.sources, {}) +
                       closing_lines(compilation, "rddlc");
    while (text.ends_with('\n')) text.pop_back();
    return text;
}

LoadedProblem load(const nb::object& domain, const nb::object& instance,
                   const nb::object& repository, const std::string& instance_name,
                   const std::string& engine, const nb::object& externs, bool extended,
                   bool details, const nb::object& on_compiling) {
    const std::string names[] = {path_of(domain), path_of(instance), path_of(repository)};
    const std::vector<std::string> headers = paths_of(externs);
    try {
        const nb::gil_scoped_release released;
        workbench::ProblemFiles files = files_of(names[0], names[1], names[2]);
        files.instance_name = instance_name;
        if (extended) files.standard = Standard::Rddlc;
        workbench::LoadOptions options;
        options.engine = workbench::engine_named(engine).value();
        options.on_compiling = [&](const std::string& name) {
            const nb::gil_scoped_acquire acquired;
            on_compiling(name);
        };
        options.externs = {headers.begin(), headers.end()};
        options.details = details;
        options.remembers = true;
        if (auto known = workbench::load_known(files, options)) return *std::move(known);
        Compilation compilation = workbench::compile_problem(files, options);
        if (compilation.diagnostics.has_errors()) throw CompileError(text_of(compilation));
        return workbench::load_compilation(std::move(compilation), files, options);
    } catch (...) {
        // Ctrl-C also ends the C++ compiler: whatever error that causes, Ctrl-C was the reason.
        if (PyErr_CheckSignals() != 0) throw nb::python_error();
        throw;
    }
}

nb::list problems_in(const nb::object& repository) {
    nb::list all;
    for (const workbench::RepositoryProblem& problem :
         workbench::scan_repository(path_of(repository)).problems)
        all.append(nb::make_tuple(problem.name, nb::cast(problem.instances), problem.description));
    return all;
}

nb::list files_as_text(const LoadedProblem& problem) {
    nb::list all;
    for (const auto& file : problem.files.inputs()) all.append(file.string());
    return all;
}

bool is_settled(const LoadedProblem& problem) {
    if (!problem.background) return true;
    problem.background->revive();
    return problem.background->is_settled();
}

bool is_compiled(const LoadedProblem& problem) {
    return problem.background ? problem.background->ready() != nullptr : problem.is_compiled;
}

void stop_building(const LoadedProblem& problem) {
    const nb::gil_scoped_release released;
    if (problem.background) problem.background->stop();
}

struct PythonErrors {
    nb::object error, compile_error, argument_error;
};

// Texts that are not ours, such as paths, must not reach a terminal as they are.
void raise(const nb::object& type, const std::string& text) {
    PyErr_SetString(type.ptr(), printable(text).c_str());
}

void raise(const PythonErrors& errors, const Failure& failure) {
    const bool is_argument = failure.status == usage_error;
    raise(is_argument ? errors.argument_error : errors.error,
          failure.hint.empty() ? failure.what()
                               : fmt::format("{}: {}", failure.what(), failure.hint));
}

// The one place where errors of ours become Python's.
void translate(const std::exception_ptr& thrown, void* payload) {
    const auto& errors = *static_cast<const PythonErrors*>(payload);
    try {
        std::rethrow_exception(thrown);
    } catch (const Refused& refused) {
        raise(errors.argument_error, refused.what());
    } catch (const CompileError& error) {
        raise(errors.compile_error, error.what());
    } catch (const Failure& failure) {
        raise(errors, failure);
    } catch (const Diagnosed&) {
        raise(errors.error,
              "the C++ compiler refuses the external functions; what it says stands on standard "
              "error");
    }
}

nb::object new_error(nb::module_& module, const char* name, const nb::object& bases) {
    const auto full = fmt::format("{}.{}", nb::cast<std::string>(module.attr("__name__")), name);
    nb::object type = nb::steal(PyErr_NewException(full.c_str(), bases.ptr(), nullptr));
    if (!type) throw nb::python_error();
    module.attr(name) = type;
    return type;
}

// The types live as long as the process, since errors may be translated until its end.
void add_errors(nb::module_& module) {
    auto* const errors = new PythonErrors;
    errors->error = new_error(module, "Error", nb::borrow(PyExc_Exception));
    errors->compile_error = new_error(module, "CompileError", errors->error);
    errors->argument_error = new_error(
        module, "ArgumentError",
        nb::make_tuple(errors->error, nb::handle(PyExc_ValueError), nb::handle(PyExc_TypeError)));
    errors->argument_error.attr("__doc__") =
        "An argument that cannot be, or a name that does not exist; nothing has been changed by "
        "it. "
        "It is one of Python's own errors, too, for programs that catch these.";
    nb::register_exception_translator(translate, errors);
}

}  // namespace

void check(const rddl_simulator& simulator, rddl_error error) {
    if (error == RDDL_OK) return;
    if (error == RDDL_OUT_OF_MEMORY) throw std::bad_alloc();
    if (error == RDDL_UNSUPPORTED) throw Failure(simulator.last_error(&simulator));
    throw Refused(simulator.last_error(&simulator));
}

void add_problem(nb::module_& module) {
    add_errors(module);
    module.attr("version") = version;
    nb::class_<LoadedProblem>(module, "Simulator", "A problem that can be stepped.")
        .def_prop_ro("files", files_as_text,
                     "Paths of the domain and, apart from it, the instance.")
        .def_prop_ro("name", [](const LoadedProblem& problem) { return problem.files.name; })
        .def_prop_ro("lane_count",
                     [](const LoadedProblem& problem) { return problem.simulator->lane_count; })
        .def_prop_ro(
            "interm_size",
            [](const LoadedProblem& problem) { return problem.simulator->problem->interm_size; })
        .def_prop_ro("instruction_set",
                     [](const LoadedProblem& problem) {
                         return std::string(problem.simulator->instruction_set);
                     })
        .def_prop_ro("is_settled", is_settled,
                     "Whether the engine stays as it is: nothing is built in the background.")
        .def_prop_ro("is_compiled", is_compiled, "Whether new environments are compiled ones.")
        .def("stop_building", stop_building, "Ends what is built in the background.")
        .def("describe", [](const LoadedProblem& problem) { return describe(*problem.simulator); })
        .def("constants", [](const LoadedProblem& problem, std::int32_t fluent) {
            return constants(*problem.simulator, fluent);
        });
    module.def("load", load, nb::arg("domain"), nb::arg("instance"), nb::arg("repository"),
               nb::arg("instance_name"), nb::arg("engine"), nb::arg("externs"), nb::arg("extended"),
               nb::arg("details"), nb::arg("on_compiling"));
    module.def("problems_in", problems_in, nb::arg("repository"),
               "(name, instances, description) of each problem below a folder.");
    module.def("path_text", path_of, nb::arg("path"), "The path as a str; refuses what is none.");
    module.def(
        "is_path", [](const nb::object& text) { return workbench::is_path(path_of(text)); },
        nb::arg("text"), "Whether the text means a file or a folder.");
    module.def("cpp_compiler", cpp_compiler, "The words of the C++ compiler's command.");
}

}  // namespace rddlc::python
