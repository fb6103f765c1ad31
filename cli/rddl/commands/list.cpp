// rddl list: the problems of rddlrepository.
#include "commands/commands.hpp"
#include "formats/table.hpp"
#include "problems/survey.hpp"
#include "support/json_text.hpp"
#include "support/program.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cctype>
#include <memory>

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

std::string kind_text(const SurveyedProblem& listed) {
    if (!listed.characteristics) return "has errors";
    const Characteristics& c = *listed.characteristics;
    return std::string(c.stochastic() ? "stochastic" : "deterministic") +
           (c.partially_observed ? " POMDP" : " MDP");
}

std::string actions_text(const SurveyedProblem& listed) {
    return listed.characteristics ? listed.characteristics->action.text() : "";
}

std::size_t instance_count(const std::vector<SurveyedProblem>& all) {
    std::size_t count = 0;
    for (const SurveyedProblem& listed : all) count += listed.problem.instances.size();
    return count;
}

void print_table(const std::vector<SurveyedProblem>& all, const Repository& repository) {
    constexpr std::size_t description_width = 32;
    TextTable table({{"problem"}, {"instances"}, {"kind"}, {"actions"}, {"description"}});
    for (const SurveyedProblem& listed : all)
        table.add_row({listed.problem.name, instances_text(listed.problem.instances),
                       kind_text(listed), actions_text(listed),
                       shortened(listed.problem.description, description_width)});
    if (!table.empty()) print("{}\n", table.text());
    const auto counted = [](auto count, std::string_view what) {
        return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
    };
    print("{}, {} in {}\n", counted(all.size(), "problem"),
          counted(instance_count(all), "instance"), repository.folder.string());
}

void print_descriptions(const std::vector<SurveyedProblem>& all) {
    for (const auto& [problem, characteristics] : all) {
        print("{}\n", problem.name);
        for (const std::string& line : wrapped(problem.description, 94)) print("    {}\n", line);
        if (characteristics && !characteristics->features.empty())
            for (const std::string& line :
                 wrapped(fmt::format("uses {}", fmt::join(characteristics->features, ", ")), 94))
                print("    {}\n", line);
        print("    context {}; instances {}; {}\n\n", problem.context,
              instances_text(problem.instances), problem.folder.string());
    }
}

nlohmann::ordered_json problem_json(const SurveyedProblem& listed) {
    const RepositoryProblem& problem = listed.problem;
    nlohmann::ordered_json out{{"name", problem.name},
                               {"context", problem.context},
                               {"description", problem.description},
                               {"folder", problem.folder.string()},
                               {"instances", problem.instances}};
    if (!listed.characteristics) return out;
    const Characteristics& c = *listed.characteristics;
    out["stochastic"] = c.stochastic();
    out["partially_observed"] = c.partially_observed;
    out["state"] = c.state.text();
    out["actions"] = c.action.text();
    out["concurrent"] = c.concurrent();
    out["features"] = c.features;
    return out;
}

void print_json(const std::vector<SurveyedProblem>& all) {
    nlohmann::ordered_json out = nlohmann::ordered_json::array();
    for (const SurveyedProblem& listed : all) out.push_back(problem_json(listed));
    print("{}", json_document(out));
}

ExitStatus list(const ListOptions& options) {
    const Repository repository = require_repository();
    std::vector<RepositoryProblem> chosen;
    const std::string filter = lower_case(options.filter);
    std::copy_if(repository.problems.begin(), repository.problems.end(), std::back_inserter(chosen),
                 [&](const RepositoryProblem& problem) { return matches(problem, filter); });
    const std::vector<SurveyedProblem> listed = survey(chosen);
    if (options.json)
        print_json(listed);
    else if (options.verbose)
        print_descriptions(listed);
    else
        print_table(listed, repository);
    if (chosen.empty() && !options.filter.empty())
        throw Failure(
            fmt::format("no problem's name or description contains '{}'", options.filter));
    return success;
}

}  // namespace

Command list_command() {
    const auto options = std::make_shared<ListOptions>();
    Command command;
    command.name = "list";
    command.summary = "List the problems of rddlrepository";
    command.details =
        "Examples:\n"
        "  rddl list                list all problems\n"
        "  rddl list ippc2023       those whose name, context or description contains a text\n"
        "  rddl list hvac --verbose with whole descriptions and folders";
    add_argument(command, "FILTER", "Only problems that contain this text", options->filter);
    add_flag(command, "-v,--verbose", "Whole descriptions, contexts and folders", options->verbose);
    add_flag(command, "--json", "Print JSON", options->json);
    command.run = [options] {
        return list(*options);
    };
    return command;
}

}  // namespace rddlc::cli
