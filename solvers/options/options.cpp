#include "solvers/options/options.hpp"

#include "support/option_names.hpp"

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

std::string unknown_option(const std::string& name, const std::vector<OptionText>& known,
                           Face face) {
    std::vector<KnownOption> names;
    for (const OptionText& option : known) {
        const bool is_python = face == Face::Python;
        KnownOption each{is_python ? option.keyword : option.name, option.elsewhere};
        each.others.push_back(is_python ? option.name : option.keyword);
        names.push_back(std::move(each));
    }
    return fmt::format("there is no option '{}'{}", name, option_meant_text(name, names));
}

}  // namespace rddlc::solvers
