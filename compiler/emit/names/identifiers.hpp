// Spelling RDDL names in C++: the one place that knows which words C++ has taken.
//
// The user's names and ours cannot meet, whatever they are, since they look different or stand in
// regions of their own. What comes from the user is
//
//     x_count, x_, initial_x      what belongs to the problem: objects of a type, tables
//     set_x                       a function that fills x
//     state.x, action.x, ...      a member of a record, which has no other members
//     x                           in a function: a variable, numbered away from its parameters
//     x_objects, x_values, of_x   what is told about the problem
//
// and nothing of ours begins or ends like that (docs/emitted-code.md). Macros are not bound to
// regions: none ends in '_', most begin with capitals alone, the others are listed.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <vector>

namespace rddlc::cpp {

// Not to be used for what the user names: keywords of C++20 and GNU C++; what is or may be a macro
// (a capital that no small letter follows, and those in small letters that the headers of the
// runtime bring along); what begins like our global names ("std", "rddl").
bool is_reserved(std::string_view name);
bool is_keyword(std::string_view name);

// An RDDL name as a C++ identifier: '-' becomes '_', a run of '_' becomes one (C++ reserves "__"),
// one at the end is left out. Different names may get the same identifier.
std::string plain_identifier(std::string_view name);

// The same with a '_' at its end if it is reserved.
std::string identifier(std::string_view name);

// The name of the user's C++ function for an external function, with a '_' if it is a keyword.
std::string external_identifier(std::string_view name);

// The characters that distinguish an identifier of the user's from one of ours.
struct Mark {
    std::string_view before, after;
};

// Identifiers of one region of the text, all different from each other and from those of the
// region around it.
class Scope {
  public:
    // `names` are taken from the start.
    explicit Scope(const Scope* outer = nullptr, const std::vector<std::string>& names = {});

    // The identifier nearest to `wish` that is free: "x", else "x_2", "x_3", ...
    std::string claim(std::string_view wish, Mark mark = {});

    // Names claimed after a mark are free again once released.
    std::size_t mark() const { return claimed_.size(); }
    void release(std::size_t mark);

  private:
    struct Claim {
        std::string name, unnumbered;
    };

    bool is_taken(const std::string& name) const;

    const Scope* outer_;
    std::unordered_set<std::string> taken_;
    std::vector<Claim> claimed_;
    std::unordered_map<std::string, int> last_number_;
};

}  // namespace rddlc::cpp
