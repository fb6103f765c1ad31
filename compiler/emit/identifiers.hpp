// Spelling RDDL names in C++: the one place that knows which words C++ has taken.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <vector>

namespace rddlc::cpp {

// Keywords of C++20, macros of the C and C++ standard libraries and of POSIX, and the names that
// emitted code uses for something else wherever it stands ("std", "rddl", "rddl_type", "L").
bool is_reserved(std::string_view name);

// An RDDL name as a C++ identifier: '-' becomes '_', a run of '_' becomes one (C++ reserves "__"),
// a reserved word gets a '_' at its end. Different names may get the same identifier.
std::string identifier(std::string_view name);

// Identifiers of one region of the text, all different from each other and from those of the
// region around it.
class Scope {
  public:
    // `names` are taken from the start.
    explicit Scope(const Scope* outer = nullptr, const std::vector<std::string>& names = {});

    // The identifier nearest to `wish` that is free: "x", else "x_2", "x_3", ...
    std::string claim(std::string_view wish);

    // Names claimed after a mark are free again once released.
    std::size_t mark() const { return claimed_.size(); }
    void release(std::size_t mark);

  private:
    bool is_taken(const std::string& name) const;

    const Scope* outer_;
    std::unordered_set<std::string> taken_;
    std::vector<std::string> claimed_;
    std::unordered_map<std::string, int> last_number_;
};

}  // namespace rddlc::cpp
