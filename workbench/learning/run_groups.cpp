#include "learning/run_groups.hpp"

#include <algorithm>
#include <filesystem>
#include <map>

namespace rddlc::workbench {

std::vector<RunGroup> run_groups(const std::vector<std::string>& paths, bool each_alone) {
    std::vector<RunGroup> groups;
    for (const std::string& word : paths) {
        const std::vector<std::filesystem::path> folders = run_folders(word);
        const bool is_run = folders.size() == 1 && folders[0] == word;
        for (const std::filesystem::path& folder : folders) {
            std::string name = word;
            const RunDescription run = description_of(folder).value_or(RunDescription{});
            if (!run.what.empty() && is_run && !each_alone) name = without_seed(word, run.seed);
            if (each_alone && !is_run) name = folder.string();
            const auto known =
                std::find_if(groups.begin(), groups.end(), [&](const RunGroup& group) {
                    return group.name == name && group.what == run.what && !each_alone;
                });
            RunGroup& group =
                known == groups.end() ? groups.emplace_back(RunGroup{name, run.what, {}}) : *known;
            group.runs.push_back(read_progress(folder));
        }
    }
    // A single run keeps its name; a name that several groups share gets its details.
    std::map<std::string, int> uses;
    for (const RunGroup& group : groups) uses[group.name] += 1;
    for (RunGroup& group : groups)
        if (group.runs.size() == 1)
            group.name = group.runs[0].folder.string();
        else if (uses[group.name] > 1)
            group.name += ": " + group.what;
    return groups;
}

std::string steps_title(const std::vector<RunGroup>& groups) {
    std::size_t searches = 0, all = 0;
    for (const RunGroup& group : groups)
        for (const RunProgress& run : group.runs) {
            all += 1;
            searches += std::count(run.columns.begin(), run.columns.end(), "search/best") > 0;
        }
    return searches == 0 ? "steps" : searches == all ? "generations" : "";
}

}  // namespace rddlc::workbench
