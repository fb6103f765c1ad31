// A case: a folder with RDDL files and what is expected of them.
#pragma once

#include "emit/emit.hpp"
#include "support/diagnostic.hpp"
#include "support/standard.hpp"

#include <filesystem>
#include <set>
#include <string>
#include <vector>

namespace rddlc::testing {

// "// error E0203: part of the message" at the end of a line of RDDL.
struct Mark {
    std::string file;
    int line;
    std::string kind;     // "error", "warning"
    std::string code;     // "E0203"
    std::string message;  // a part of it
};

struct Case {
    std::filesystem::path folder;
    std::vector<std::string> files;              // *.rddl, by name: domain.rddl, then instance.rddl
    std::vector<std::filesystem::path> headers;  // *.hpp: the external functions
    std::vector<Mark> marks;
    Standard standard = Standard::PyRddlGym;
    RealType real = RealType::Double;
    std::string instance;
    std::set<Code> disabled_warnings;

    bool expects(const std::string& file) const { return std::filesystem::exists(folder / file); }
};

Case read_case(const std::filesystem::path& folder);

// All folders in `folder` that hold RDDL files, by name.
std::vector<std::filesystem::path> find_cases(const std::filesystem::path& folder);

}  // namespace rddlc::testing
