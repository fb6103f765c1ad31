#include "measure/peers.hpp"

#include "driver/process.hpp"
#include "driver/work_folder.hpp"
#include "python/python_command.hpp"
#include "support/failure.hpp"
#include "support/json_text.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>
#include <optional>

namespace rddlc::workbench {

namespace fs = std::filesystem;

namespace {

struct Peer {
    std::string_view name;
    std::string_view program;
    std::string_view package;
    bool knows_threads;
};

constexpr Peer peers[] = {{"pyrddlgym", "pyrddlgym_steps.py", "pyRDDLGym", false},
                          {"jax", "jax_steps.py", "pyRDDLGym-jax", true}};

const Peer& peer_named(std::string_view name) {
    return *std::find_if(std::begin(peers), std::end(peers),
                         [&](const Peer& peer) { return peer.name == name; });
}

// The file beside the running program if it is installed, else in the source tree.
fs::path program_file(const Peer& peer) {
    std::error_code ignored;
    const fs::path program = fs::read_symlink("/proc/self/exe", ignored);
    for (const fs::path& folder :
         {program.parent_path() / RDDL_PEERS_FROM_BIN, fs::path(RDDL_SOURCE_PEERS)})
        if (fs::exists(folder / peer.program, ignored)) return folder / peer.program;
    throw Failure(fmt::format("cannot find '{}', which measures {}", peer.program, peer.package),
                  "install rddl with its share folder");
}

// The last line; the lines before it are the libraries' messages.
nlohmann::json last_answer(const std::string& output) {
    const std::size_t end = output.find_last_not_of('\n');
    if (end == std::string::npos) return nullptr;
    const std::size_t line_break = output.rfind('\n', end);
    const std::size_t begin = line_break == std::string::npos ? 0 : line_break + 1;
    return json_if_valid(output.substr(begin, end + 1 - begin));
}

[[noreturn]] void give_up(const Peer& peer, const std::string& python, const nlohmann::json& answer,
                          const std::string& output) {
    const std::string hint = fmt::format(
        "--python names an interpreter that has it: python3 -m venv V && V/bin/pip install {}",
        peer.package);
    if (!answer.is_object() || !answer.contains("error"))
        throw Failure(
            fmt::format("{} cannot be measured with {}:\n{}", peer.package, python, output), hint);
    const auto reason = answer["error"].get<std::string>();
    if (answer.value("missing", false))
        throw Failure(fmt::format("{} has no {} ({})", python, peer.package, reason), hint);
    throw Failure(fmt::format("{} cannot run this problem: {}", peer.package, reason));
}

PeerFigures figures_of(const nlohmann::json& answer) {
    PeerFigures figures{answer["name"],
                        answer["version"],
                        answer["import_seconds"],
                        answer["first_step_seconds"],
                        {}};
    for (const nlohmann::json& m : answer["measurements"])
        figures.measurements.push_back({m["environments"], 0, m["threads"], m["steps"],
                                        m["seconds"], m.value("processor_seconds", 0.0)});
    return figures;
}

// A name that no program takes for an option.
std::string argument_of(const fs::path& file) {
    const std::string name = file.string();
    return name.starts_with('-') ? "./" + name : name;
}

}  // namespace

const std::vector<std::string>& peer_names() {
    static const std::vector<std::string> names = [] {
        std::vector<std::string> all;
        for (const Peer& peer : peers) all.emplace_back(peer.name);
        return all;
    }();
    return names;
}

bool knows_threads(std::string_view name) {
    return peer_named(name).knows_threads;
}

PeerFigures measure_peer(std::string_view name, const ProblemFiles& files,
                         const PeerOptions& options) {
    const Peer& peer = peer_named(name);
    const std::string python = python_command(options.python);
    const TemporaryFolder folder;
    const PythonFiles read = files_for_python(files, folder.path());
    const auto result =
        run_process({python, program_file(peer).string(), argument_of(read.domain),
                     argument_of(read.instance), "--seconds", fmt::format("{}", options.seconds),
                     "--cores", std::to_string(options.cores)});
    if (!result)
        throw Failure(fmt::format("cannot run '{}'", python),
                      "--python names the interpreter to use");
    const nlohmann::json answer = last_answer(result->output);
    if (result->status != 0) give_up(peer, python, answer, result->output);
    return figures_of(answer);
}

}  // namespace rddlc::workbench
