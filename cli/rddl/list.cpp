// rddl list: the problems of rddlrepository.
#include "commands.hpp"
#include "problem_lookup.hpp"
#include "table.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cctype>

namespace rddlc::cli {

namespace {

struct ListOptions {
    std::string filter;
    bool verbose = false;
    bool json = false;
};

std::string lower_case(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
}

bool matches(const RepositoryProblem& problem, const std::string& lower_filter) {
    const std::string all = problem.name + ' ' + problem.context + ' ' + problem.description;
    return lower_case(all).find(lower_filter) != std::string::npos;
}

// "0-7", "1-3, 5", "a"
std::string instances_text(const std::vector<std::string>& instances) {
    const auto is_successor = [](const std::string& a, const std::string& b) {
        const auto is_digit = [](unsigned char c) {
            return std::isdigit(c) != 0;
        };
        const auto is_number = [&](const std::string& text) {
            return !text.empty() && text.size() < 18 &&
                   std::all_of(text.begin(), text.end(), is_digit);
        };
        return is_number(a) && is_number(b) && std::stoll(b) == std::stoll(a) + 1;
    };
    std::string out;
    for (std::size_t begin = 0, end = 0; begin < instances.size(); begin = end) {
        end = begin + 1;
        while (end < instances.size() && is_successor(instances[end - 1], instances[end])) ++end;
        if (!out.empty()) out += ", ";
        out += instances[begin];
        if (end - begin > 1) out += "-" + instances[end - 1];
    }
    return out;
}

void print_table(const std::vector<RepositoryProblem>& problems, const Repository& repository) {
    constexpr std::size_t description_width = 44;
    Table table({{"problem"}, {"instances"}, {"description"}});
    std::size_t instances = 0;
    for (const RepositoryProblem& problem : problems) {
        table.add_row({problem.name, instances_text(problem.instances),
                       shortened(problem.description, description_width)});
        instances += problem.instances.size();
    }
    if (!table.empty()) fmt::print("{}\n", table.text());
    fmt::print("{} problems, {} instances in {}\n", problems.size(), instances,
               repository.folder.string());
}

void print_descriptions(const std::vector<RepositoryProblem>& problems) {
    for (const RepositoryProblem& problem : problems) {
        fmt::print("{}\n", problem.name);
        for (const std::string& line : wrapped(problem.description, 94))
            fmt::print("    {}\n", line);
        fmt::print("    context {}; instances {}; {}\n\n", problem.context,
                   instances_text(problem.instances), problem.folder.string());
    }
}

void print_json(const std::vector<RepositoryProblem>& problems) {
    nlohmann::ordered_json out = nlohmann::ordered_json::array();
    for (const RepositoryProblem& problem : problems)
        out.push_back({{"name", problem.name},
                       {"context", problem.context},
                       {"description", problem.description},
                       {"folder", problem.folder.string()},
                       {"instances", problem.instances}});
    fmt::print("{}\n", out.dump(2));
}

ExitStatus list(const ListOptions& options) {
    const Repository repository = require_repository();
    std::vector<RepositoryProblem> chosen;
    const std::string filter = lower_case(options.filter);
    std::copy_if(repository.problems.begin(), repository.problems.end(), std::back_inserter(chosen),
                 [&](const RepositoryProblem& problem) { return matches(problem, filter); });
    if (options.json)
        print_json(chosen);
    else if (options.verbose)
        print_descriptions(chosen);
    else
        print_table(chosen, repository);
    if (chosen.empty() && !options.filter.empty())
        throw Failure(
            fmt::format("no problem's name or description contains '{}'", options.filter));
    return success;
}

}  // namespace

Command add_list_command(CLI::App& program) {
    CLI::App* const app = program.add_subcommand("list", "List the problems of rddlrepository");
    app->footer(
        "Examples:\n"
        "  rddl list                list all problems\n"
        "  rddl list ippc2023       those whose name, context or description contains a text\n"
        "  rddl list hvac --verbose with whole descriptions and folders");
    const auto options = std::make_shared<ListOptions>();
    app->add_option("FILTER", options->filter, "Only problems that contain this text");
    app->add_flag("-v,--verbose", options->verbose, "Whole descriptions, contexts and folders");
    app->add_flag("--json", options->json, "Print JSON");
    return {app, [options] {
                return list(*options);
            }};
}

}  // namespace rddlc::cli
