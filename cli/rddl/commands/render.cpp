// rddl render: pictures of the steps of a trace.
#include "commands/commands.hpp"
#include "commands/options.hpp"
#include "formats/line_stream.hpp"
#include "formats/traced_problem.hpp"
#include "pictures/picture_options.hpp"
#include "pictures/picture_writer.hpp"
#include "support/files.hpp"
#include "support/program.hpp"
#include "terminal/interrupt.hpp"

#include <fmt/format.h>

#include <memory>
#include <optional>

namespace rddlc::cli {

namespace {

struct RenderOptions {
    std::string trace;
    ProblemArguments problem;
    LoadOptions load;
    std::string beside;  // a second trace
    PictureOptions pictures;
    bool quiet = false;
};

// A page shows two episodes side by side; nothing else does.
void require_pages_alone(const RenderOptions& options) {
    const PictureOptions& pictures = options.pictures;
    if (pictures.html.empty() || !pictures.gif.empty() || !pictures.video.empty() ||
        !pictures.png.empty() || !pictures.svg.empty())
        throw Failure("--beside is for --html alone", {}, usage_error);
}

ExitStatus render_trace(const RenderOptions& options) {
    if (options.pictures.visualizer == "list") {
        print("{}", visualizer_list());
        return success;
    }
    require_pictures();
    if (!options.pictures.any())
        throw Failure("there is nothing to write",
                      "say --gif, --png, --svg, --video, --html or --watch", usage_error);
    require_one_on_standard_output(options.pictures);
    require_different_files(options.pictures);
    if (!options.beside.empty()) require_pages_alone(options);
    if (is_folder(options.trace))
        throw Failure(
            fmt::format("'{}' is a folder, not a trace", options.trace),
            "'rddl run --gif FILE' runs a problem and draws it; 'rddl run --trace FILE' writes a "
            "trace");
    UsedFiles used;
    // The first line says which problem it is, which would say how long lines can be.
    LineReader input(options.trace, used, largest_text);
    std::optional<std::string> line = input.next();
    if (!line) throw Failure(fmt::format("'{}' is empty", options.trace));
    const ProblemFiles files =
        options.problem.first.empty()
            ? options.problem.with_options(files_of_header(*line, options.trace))
            : options.problem.files();
    LoadedProblem problem = load_problem(files, options.load);
    problem.used.add(options.trace);
    std::optional<LineReader> second;
    if (!options.beside.empty()) second.emplace(options.beside, problem.used, largest_text);
    PictureWriter pictures(problem, options.pictures, options.trace);
    for (; line; line = input.next()) pictures.add_line(*line);
    if (second) {
        pictures.begin_second(options.beside);
        while ((line = second->next())) pictures.add_line(*line);
    }
    give_up_if_interrupted("drawing");
    const std::string what = pictures.finish();
    if (!options.quiet && !options.pictures.any_on_standard_output()) print("{}\n", what);
    return success;
}

}  // namespace

Command render_command() {
    const auto options = std::make_shared<RenderOptions>();
    Command command;
    command.name = "render";
    command.summary = "Draw the steps of a trace";
    command.details =
        "A trace is what 'rddl run --trace' writes, or any file in that form (docs/traces.md). "
        "Its\n"
        "header names its problem; without one, or where the files have moved, name "
        "the\n"
        "problem. docs/pictures.md shows what the pictures look like.\n\n"
        "Examples:\n"
        "  rddl render trace.jsonl --gif movie.gif\n"
        "  rddl render trace.jsonl domain.rddl instance.rddl --png frames/ --size 900x600\n"
        "  rddl render trace.jsonl --svg state.svg --step 12 --visualizer chart\n"
        "  rddl render trace.jsonl --html replay.html --beside other.jsonl\n"
        "  rddl run MountainCar_ippc2023 1 --gif movie.gif";
    add_argument(command, "TRACE", "Lines of JSON; - is standard input", options->trace)
        .is_required = true;
    add_problem_arguments(command, options->problem, false);
    add_text_option(command, "--beside", "TRACE",
                    "With --html: a second trace of the problem, shown in step with the first",
                    options->beside);
    add_picture_options(command, options->pictures);
    add_extern_option(command, options->load,
                      "C++ header or shared object of the external functions of the problem");
    add_flag(command, "--quiet", "Print nothing", options->quiet);
    command.run = [options] {
        // Nothing is stepped: the interpreter is there at once.
        options->load.engine = Engine::Interpreter;
        options->load.quiet = true;
        options->pictures.quiet = options->quiet;
        return render_trace(*options);
    };
    return command;
}

}  // namespace rddlc::cli
