#include "case.hpp"

#include <algorithm>
#include <fstream>
#include <regex>
#include <stdexcept>
#include <string_view>

namespace rddlc::testing {
namespace {

namespace fs = std::filesystem;

// A line may hold several marks.
void add_marks(const std::string& file, int number, const std::string& line,
               std::vector<Mark>& marks) {
    static const std::regex form(
        "// (error|warning) ([EW][0-9]{4}): (.*?)(?=\\s*// (?:error|warning)|$)");
    const auto end = std::sregex_iterator();
    for (auto it = std::sregex_iterator(line.begin(), line.end(), form); it != end; ++it) {
        marks.push_back({file, number, (*it)[1], (*it)[2], (*it)[3]});
    }
}

// Reads options as rddlc does: --std=rddlc, -Wno-W0202.
void read_options(const fs::path& file, Case& result) {
    std::ifstream stream(file);
    for (std::string option; stream >> option;) {
        const auto standard = standard_named(option.substr(std::min(option.size(), 6ul)));
        const auto warning = parse_code(option.substr(std::min(option.size(), 5ul)));
        if (option.starts_with("--std=") && standard)
            result.standard = *standard;
        else if (option == "--real=float")
            result.real = RealType::Float;
        else if (option.starts_with("--instance="))
            result.instance = option.substr(option.find('=') + 1);
        else if (option.starts_with("-Wno-") && warning)
            result.disabled_warnings.insert(*warning);
        else
            throw std::runtime_error(file.string() + ": unknown option " + option);
    }
}

}  // namespace

Case read_case(const fs::path& folder) {
    Case result;
    result.folder = folder;
    read_options(folder / "options", result);
    for (const auto& entry : fs::directory_iterator(folder)) {
        const fs::path name = entry.path().filename();
        if (name.extension() == ".rddl") result.files.push_back(name.string());
        if (name.extension() == ".hpp") result.headers.push_back(name);
    }
    std::ranges::sort(result.files);
    for (const std::string& file : result.files) {
        std::ifstream stream(folder / file);
        std::string line;
        for (int number = 1; std::getline(stream, line); ++number) {
            add_marks(file, number, line, result.marks);
        }
    }
    return result;
}

std::vector<fs::path> find_cases(const fs::path& folder) {
    std::vector<fs::path> cases;
    for (const auto& entry : fs::directory_iterator(folder)) {
        if (entry.is_directory() && !read_case(entry.path()).files.empty()) {
            cases.push_back(entry.path());
        }
    }
    std::ranges::sort(cases);
    return cases;
}

}  // namespace rddlc::testing
