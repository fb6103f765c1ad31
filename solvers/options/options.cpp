#include "solvers/options/options.hpp"

#include "support/diagnostic.hpp"

namespace rddlc::solvers {

std::vector<std::string> words_of_list(const std::string& text) {
    std::vector<std::string> words;
    for (std::size_t begin = 0; begin <= text.size();) {
        const std::size_t end = std::min(text.find(',', begin), text.size());
        words.push_back(text.substr(begin, end - begin));
        begin = end + 1;
    }
    return words;
}

std::string unknown_option(const std::string& name, const std::vector<std::string>& known) {
    const auto near = did_you_mean(name, known);
    return fmt::format("there is no option '{}'{}", name,
                       near ? fmt::format("; did you mean '{}'?", *near) : "");
}

}  // namespace rddlc::solvers
