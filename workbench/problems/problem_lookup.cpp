#include "problems/problem_lookup.hpp"

#include "problems/python_info.hpp"
#include "support/diagnostic.hpp"
#include "support/files.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>

namespace rddlc::workbench {

namespace fs = std::filesystem;

namespace {

constexpr const char* standalone = "standalone";  // the context of problems without one

// "instance12.rddl" -> "12", "instance.rddl" -> "1"; nothing for other files.
std::optional<std::string> instance_of(const fs::path& file) {
    const std::string stem = file.stem().string();
    constexpr std::string_view prefix = "instance";
    if (file.extension() != ".rddl" || !stem.starts_with(prefix)) return std::nullopt;
    return stem == prefix ? "1" : stem.substr(prefix.size());
}

// Numbers by value, before all other texts.
bool instance_before(const std::string& a, const std::string& b) {
    const auto key = [](const std::string& text) {
        long long number = 0;
        const auto end = text.data() + text.size();
        const bool numeric = std::from_chars(text.data(), end, number).ptr == end && !text.empty();
        return std::tuple(!numeric, number, std::string_view(text));
    };
    return key(a) < key(b);
}

// Names folders without an info: archive/[competitions/]CONTEXT/A/B is A_B_context, as the info of
// the others says.
void name_by_folder(RepositoryProblem& problem, const fs::path& relative) {
    std::vector<std::string> parts(relative.begin(), relative.end());
    if (parts.size() > 1 && parts.front() == "competitions") parts.erase(parts.begin());
    if (parts.size() > 1) {
        problem.context = parts.front();
        for (char& c : problem.context) c = static_cast<char>(std::tolower(c));
        parts.erase(parts.begin());
    }
    problem.name = fmt::format("{}", fmt::join(parts, "_"));
}

fs::directory_iterator files_in(const fs::path& folder) {
    std::error_code error;
    fs::directory_iterator files(folder, error);
    if (!error) return files;
    throw Failure(
        fmt::format("cannot read '{}': {}", folder.string(), std::strerror(error.value())));
}

std::vector<std::string> instances_in(const fs::path& folder) {
    std::vector<std::string> all;
    for (const auto& file : files_in(folder))
        if (const auto instance = instance_of(file.path())) all.push_back(*instance);
    std::sort(all.begin(), all.end(), instance_before);
    all.erase(std::unique(all.begin(), all.end()), all.end());
    return all;
}

RepositoryProblem read_problem(const fs::path& archive, const fs::path& folder) {
    RepositoryProblem problem;
    problem.folder = folder;
    const fs::path description = folder / "__init__.py";
    auto info = read_python_info(is_there(description) ? read_file(description) : "");
    problem.name = info["name"];
    problem.context = info["context"];
    problem.description = info["description"];
    if (problem.name.empty()) name_by_folder(problem, folder.lexically_relative(archive));
    if (problem.context.empty()) problem.context = standalone;
    if (problem.context != standalone) problem.name += "_" + problem.context;
    problem.instances = instances_in(folder);
    return problem;
}

// The folder of the package as this Python sees it; empty if it is not installed. Nothing is
// imported.
fs::path ask_python(const std::string& python) {
    const std::string command =
        "'" + python +
        "' -c \"import importlib.util as u; s = u.find_spec('rddlrepository'); "
        "print(s.submodule_search_locations[0] if s else '')\" 2>/dev/null";
    const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(command.c_str(), "r"), pclose);
    std::string answer;
    std::array<char, 4096> buffer;
    while (pipe && std::fgets(buffer.data(), buffer.size(), pipe.get())) answer += buffer.data();
    return answer.substr(0, answer.find('\n'));
}

fs::path installed_repository() {
    const char* const environment = std::getenv("VIRTUAL_ENV");
    if (environment && !std::strchr(environment, '\'')) {
        fs::path found = ask_python(std::string(environment) + "/bin/python3");
        if (!found.empty()) return found;
    }
    return ask_python("python3");
}

// `instance` may be empty if there is only one.
ProblemFiles find_in_folder(const fs::path& folder, const std::string& instance) {
    const RepositoryProblem problem = problem_in(folder);
    const bool is_clear = instance.empty() && problem.instances.size() == 1;
    return find_instance(problem, is_clear ? problem.instances.front() : instance);
}

ProblemFiles find_paths(const std::string& domain, const std::string& instance) {
    if (is_folder(domain) && (!is_path(instance) || instance == domain))
        return find_in_folder(domain, instance);
    if (instance.empty()) return {domain, domain, std::nullopt};
    if (const fs::path of_folder = fs::path(domain) / "domain.rddl"; is_there(of_folder))
        return {domain + " " + instance, of_folder, instance};
    if (is_there(domain) && !is_path(instance))
        throw Failure(
            fmt::format("there is no instance file '{}'", instance),
            fmt::format("'{}' is a file, so name the file of its instance; numbers are of "
                        "the instances of a folder, or of a problem of rddlrepository",
                        domain));
    return {domain + " " + instance, domain, instance};
}

}  // namespace

std::vector<fs::path> ProblemFiles::inputs() const {
    std::vector<fs::path> files{domain};
    if (instance) files.push_back(*instance);
    return files;
}

std::vector<fs::path> ProblemFiles::all() const {
    std::vector<fs::path> files = inputs();
    if (policy) files.push_back(*policy);
    return files;
}

fs::path RepositoryProblem::instance_file(std::string_view instance) const {
    const fs::path file = folder / fmt::format("instance{}.rddl", instance);
    return instance == "1" && !is_there(file) ? folder / "instance.rddl" : file;
}

Repository scan_repository(const fs::path& folder) {
    const fs::path archive = is_folder(folder / "archive") ? folder / "archive" : folder;
    files_in(archive);  // fails where the one below is content with nothing
    Repository repository{archive, {}};
    const auto options = fs::directory_options::skip_permission_denied |
                         fs::directory_options::follow_directory_symlink;
    for (const auto& entry : fs::recursive_directory_iterator(archive, options))
        if (entry.path().filename() == "domain.rddl")
            repository.problems.push_back(read_problem(archive, entry.path().parent_path()));
    std::sort(repository.problems.begin(), repository.problems.end(),
              [](const auto& a, const auto& b) {
                  return strverscmp(a.name.c_str(), b.name.c_str()) < 0;  // p9 before p10
              });
    return repository;
}

std::optional<Repository> find_repository() {
    if (const char* const given = std::getenv("RDDL_REPOSITORY"); given && *given) {
        if (!is_folder(given))
            throw Failure(fmt::format("RDDL_REPOSITORY is '{}', which is not a folder", given));
        return scan_repository(given);
    }
    const fs::path installed = installed_repository();
    if (installed.empty()) return std::nullopt;
    return scan_repository(installed);
}

Repository require_repository() {
    if (auto repository = find_repository()) return *std::move(repository);
    throw Failure(
        "rddlrepository is not installed",
        "install it with 'pip install rddlrepository' or set RDDL_REPOSITORY to its folder");
}

namespace {

bool begins_with(std::string_view name, std::string_view beginning) {
    const auto same = [](unsigned char a, unsigned char b) {
        return std::tolower(a) == std::tolower(b);
    };
    return name.size() >= beginning.size() &&
           std::ranges::equal(name.substr(0, beginning.size()), beginning, same);
}

// Names that begin like this one, else the one that is nearest.
std::string hint_of_names(std::string_view name, const std::vector<std::string>& names) {
    constexpr std::size_t most = 8;
    std::vector<std::string> near;
    for (const std::string& each : names)
        if (!name.empty() && begins_with(each, name)) near.push_back("'" + each + "'");
    const std::size_t more = near.size() - std::min(near.size(), most);
    if (more > 0) near.resize(most);
    if (near.empty())
        if (const auto nearest = did_you_mean(name, names)) near.push_back("'" + *nearest + "'");
    if (near.empty()) return "'rddl list' shows their names; a file's name ends with .rddl";
    return fmt::format("did you mean {}{}?", fmt::join(near, ", "),
                       more == 0 ? "" : fmt::format(" or one of {} more", more));
}

}  // namespace

RepositoryProblem problem_in(const fs::path& folder) {
    RepositoryProblem problem;
    problem.name = folder.string();
    problem.folder = folder;
    problem.instances = instances_in(folder);
    if (!is_there(problem.domain_file()))
        throw Failure(fmt::format("there is no domain.rddl in '{}'", problem.name),
                      "name the files: DOMAIN INSTANCE");
    return problem;
}

const RepositoryProblem& find_problem(const Repository& repository, std::string_view name) {
    std::vector<std::string> names;
    for (const RepositoryProblem& problem : repository.problems) {
        if (problem.name == name) return problem;
        names.push_back(problem.name);
    }
    throw Failure(fmt::format("no problem of {} is called '{}'", repository.folder.string(), name),
                  hint_of_names(name, names));
}

ProblemFiles find_instance(const RepositoryProblem& problem, std::string_view instance) {
    const auto& known = problem.instances;
    if (known.empty())
        throw Failure(fmt::format("there is no instance in '{}'", problem.folder.string()),
                      "name the files: DOMAIN INSTANCE");
    const std::string offer = fmt::format("it has {}", fmt::join(known, ", "));
    if (instance.empty()) throw Failure(fmt::format("which instance of {}?", problem.name), offer);
    if (std::find(known.begin(), known.end(), instance) == known.end())
        throw Failure(fmt::format("{} has no instance '{}'", problem.name, instance), offer);
    return {fmt::format("{} {}", problem.name, instance), problem.domain_file(),
            problem.instance_file(instance)};
}

bool is_path(const std::string& text) {
    if (text.ends_with(".rddl") || text.find('/') != std::string::npos) return true;
    // A symlink loop also exists as a file.
    std::error_code error;
    return fs::status(text, error).type() != fs::file_type::not_found;
}

ProblemFiles find_files(const std::string& first, const std::string& second) {
    if (is_path(first)) return find_paths(first, second);
    const auto repository = find_repository();
    if (!repository)
        throw Failure(
            fmt::format("there is no file '{}', and rddlrepository is not installed", first),
            "install it with 'pip install rddlrepository' or set RDDL_REPOSITORY to its "
            "folder");
    return find_instance(find_problem(*repository, first), second);
}

}  // namespace rddlc::workbench
