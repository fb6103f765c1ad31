#include "studio/edited_problem.hpp"

#include "engines/step_derivatives.hpp"
#include "studio/page.hpp"
#include "support/failure.hpp"
#include "support/files.hpp"
#include "support/render.hpp"

#include <fmt/format.h>

namespace rddlc::studio {

using namespace workbench;

namespace {

bool have_one_name(const ProblemFiles& files) {
    return files.instance && files.instance->filename() == files.domain.filename();
}

// The files by their names on the page.
ProblemFiles as_named(const OpenedProblem& opened) {
    ProblemFiles files = opened.files;
    files.domain = domain_name(opened);
    if (files.instance) files.instance = instance_name(opened);
    return files;
}

std::string message_of(const Compilation& compilation) {
    RenderOptions options;
    options.error_limit = 5;
    std::string text = rddlc::render(compilation.diagnostics, compilation.sources, options);
    while (text.ends_with('\n')) text.pop_back();
    return text;
}

}  // namespace

std::string domain_name(const OpenedProblem& opened) {
    return have_one_name(opened.files) ? opened.files.domain.string()
                                       : opened.files.domain.filename().string();
}

std::string instance_name(const OpenedProblem& opened) {
    if (!opened.files.instance) return "";
    return have_one_name(opened.files) ? opened.files.instance->string()
                                       : opened.files.instance->filename().string();
}

OpenedProblem open_problem(const ProblemFiles& files) {
    OpenedProblem opened{files.name, files, read_file(files.domain, largest_text), "", true};
    if (files.instance) opened.instance = read_file(*files.instance, largest_text);
    return opened;
}

OpenedProblem first_problem() {
    ProblemFiles files;
    files.name = "a first problem";
    files.domain = "domain.rddl";
    files.instance = "instance.rddl";
    return {files.name, files, std::string(page::first_domain_rddl),
            std::string(page::first_instance_rddl), false};
}

LoadedProblem load_texts(const OpenedProblem& opened, const Texts& texts,
                         const LoadOptions& options, Purpose purpose,
                         const std::filesystem::path& policy_block) {
    ProblemFiles files = as_named(opened);
    if (!policy_block.empty()) files.policy = policy_block;
    LoadOptions loading = options;
    loading.quiet = true;
    if (purpose == Purpose::Stepping) {
        loading.engine = Engine::Interpreter;
        loading.real = RealType::Double;
        loading.details = true;
    }
    const bool is_compiled = engine_of(loading) == Engine::Compiled;
    CompileOptions compiling =
        front_end_options(files, is_compiled ? Stage::Emit : Stage::Optimise, loading);
    compiling.texts[files.domain] = texts.domain;
    if (files.instance) compiling.texts[*files.instance] = texts.instance;
    if (is_compiled) compiling.real = loading.real;
    Compilation compilation = compile(compiling);
    if (compilation.diagnostics.has_errors()) throw Failure(message_of(compilation));
    LoadedProblem problem = load_compilation(std::move(compilation), files, loading);
    problem.derivatives = derivatives_of(files, loading, compiling.texts);
    return problem;
}

void save_texts(const OpenedProblem& opened, const Texts& texts, Texts& known, bool force) {
    if (!opened.can_save)
        throw Failure("this problem is a copy, which has no files", "download the texts");
    const auto require_unchanged = [&](const std::filesystem::path& file, const std::string& text) {
        if (force) return;
        if (!is_there(file))
            throw Failure(fmt::format("another program has removed '{}'", file.string()),
                          "save again to write it anew");
        if (read_file(file, largest_text) != text)
            throw Failure(fmt::format("another program has changed '{}'", file.string()),
                          "save again to write over it");
    };
    require_unchanged(opened.files.domain, known.domain);
    if (opened.files.instance) require_unchanged(*opened.files.instance, known.instance);
    UsedFiles domain_used, instance_used;
    write_file(opened.files.domain, texts.domain, domain_used);
    known.domain = texts.domain;
    if (opened.files.instance) write_file(*opened.files.instance, texts.instance, instance_used);
    known.instance = texts.instance;
}

}  // namespace rddlc::studio
