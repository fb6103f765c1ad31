#include "probes.hpp"

#include "support/files.hpp"

#include <regex>
#include <sstream>
#include <stdexcept>

namespace rddlc::testing {
namespace {

std::string read_probe(const std::string& file) {
    return read_file(std::string(PROBES_FOLDER) + "/" + file);
}

std::vector<std::string> lines_of(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    return lines;
}

std::string trimmed(const std::string& text) {
    const std::size_t first = text.find_first_not_of(' ');
    const std::size_t last = text.find_last_not_of(' ');
    return first == std::string::npos ? "" : text.substr(first, last - first + 1);
}

// Codes in front of what pyRDDLGym does.
std::string leading_codes(const std::string& comment) {
    static const std::regex code("[EW][0-9]{4}|ok");
    std::string codes;
    std::istringstream words(comment);
    for (std::string word; words >> word && std::regex_match(word, code);)
        codes += (codes.empty() ? "" : " ") + word;
    return codes;
}

std::string name_of(const std::string& definition) {
    return definition.substr(0, definition.find_first_of("'( ="));
}

bool defines(const std::string& line, const std::string& name) {
    const std::string text = trimmed(line);
    return text.starts_with(name) && text.size() > name.size() &&
           std::string("'( =").find(text[name.size()]) != std::string::npos;
}

}  // namespace

std::vector<Probe> read_probes(const std::string& file) {
    std::vector<Probe> probes;
    int number = 0;
    for (const std::string& line : lines_of(read_probe(file))) {
        ++number;
        const std::size_t comment = line.rfind("// ");
        if (line.starts_with("#") || comment == std::string::npos) continue;
        probes.push_back(
            {trimmed(line.substr(0, comment)), leading_codes(line.substr(comment + 3)), number});
    }
    return probes;
}

namespace {

// "\\n" stands for a line break.
std::string with_line_breaks(std::string text) {
    for (std::size_t at = text.find("\\n"); at != std::string::npos; at = text.find("\\n"))
        text.replace(at, 2, "\n");
    return text;
}

std::string problem_with_change(const std::string& old_text, const std::string& new_text) {
    std::string text = read_probe("problem.rddl");
    const std::size_t at = text.find(old_text);
    if (at == std::string::npos) throw std::runtime_error("problem.rddl has no " + old_text);
    return text.replace(at, old_text.size(), new_text);
}

std::string problem_with_definition(const std::string& definition) {
    const std::string name = name_of(definition);
    const bool section = definition.ends_with("};") && definition[name.size() + 1] == '{';
    std::string text;
    bool in_cpfs = false;
    for (const std::string& line : lines_of(read_probe("problem.rddl"))) {
        const bool replaced = in_cpfs && defines(line, name);
        const bool reward = line == "    reward = 0;";
        if (!replaced && !(reward && name == "reward")) text += line + "\n";
        if (reward && (section || name == "reward")) text += definition + "\n";
        if (line == "    cpfs {") {
            in_cpfs = true;
            if (!section && name != "reward") text += definition + "\n";
        }
        if (line == "    };") in_cpfs = false;
    }
    return text;
}

}  // namespace

std::string problem_with(const std::string& probe) {
    const std::size_t arrow = probe.find(" ==>");
    if (arrow == std::string::npos) return problem_with_definition(probe);
    return problem_with_change(with_line_breaks(probe.substr(0, arrow)),
                               with_line_breaks(trimmed(probe.substr(arrow + 4))));
}

}  // namespace rddlc::testing
