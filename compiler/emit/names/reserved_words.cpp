#include "emit/names/identifiers.hpp"

#include <algorithm>
#include <array>

namespace rddlc::cpp {
namespace {

// clang-format off
// Of C++20 and its technical specifications, C++26 and GNU C++; what begins a directive of modules.
constexpr std::array<std::string_view, 101> keywords = {
    "alignas", "alignof", "and", "and_eq", "asm", "atomic_cancel", "atomic_commit",
    "atomic_noexcept", "auto", "bitand", "bitor", "bool", "break", "case", "catch", "char",
    "char16_t", "char32_t", "char8_t", "class", "co_await", "co_return", "co_yield", "compl",
    "concept", "const", "const_cast", "consteval", "constexpr", "constinit", "continue",
    "contract_assert", "decltype", "default", "delete", "do", "double", "dynamic_cast", "else",
    "enum", "explicit", "export", "extern", "false", "float", "for", "friend", "goto", "if",
    "import", "inline", "int", "long", "module", "mutable", "namespace", "new", "noexcept", "not",
    "not_eq", "nullptr", "operator", "or", "or_eq", "private", "protected", "public", "reflexpr",
    "register", "reinterpret_cast", "requires", "return", "short", "signed", "sizeof", "static",
    "static_assert", "static_cast", "struct", "switch", "synchronized", "template", "this",
    "thread_local", "throw", "true", "try", "typedef", "typeid", "typename", "typeof", "union",
    "unsigned", "using", "virtual", "void", "volatile", "wchar_t", "while", "xor", "xor_eq",
};

// The names that `-dM -E` defines in small letters for the standard headers that the runtime includes, with
// g++ 12 and clang++ 14 on Linux, strict and GNU mode; sorted. tests/emit checks that none is
// missing. On other systems more headers bring more of them: some of those are here as well.
constexpr std::array<std::string_view, 62> macros = {
    "alloca", "assert", "be16toh", "be32toh", "be64toh", "complex", "errno", "far", "fpclassify",
    "howmany", "htobe16", "htobe32", "htobe64", "htole16", "htole32", "htole64", "i386", "isfinite",
    "isinf", "isnan", "isnormal", "issubnormal", "le16toh", "le32toh", "le64toh", "linux", "major",
    "makedev", "math_errhandling", "minor", "near", "noreturn", "offsetof", "powerof2",
    "pthread_cleanup_pop", "pthread_cleanup_pop_restore_np", "pthread_cleanup_push",
    "pthread_cleanup_push_defer_np", "roundup", "sa_handler", "sa_sigaction", "sched_priority",
    "sigmask", "signbit", "st_atime", "st_ctime", "st_mtime", "stderr", "stdin", "stdout",
    "strdupa", "strndupa", "timeradd", "timerclear", "timercmp", "timerisset", "timersub", "unix",
    "va_arg", "va_copy", "va_end", "va_start",
};
// clang-format on

static_assert(std::ranges::is_sorted(keywords) && std::ranges::is_sorted(macros));

bool is_capital(char c) {
    return c >= 'A' && c <= 'Z';
}
bool is_small(char c) {
    return c >= 'a' && c <= 'z';
}

// "EOF", "M_PI", "SYS_open", "I": macros of headers that we do not know look like this.
bool looks_like_macro(std::string_view name) {
    return is_capital(name.front()) && (name.size() == 1 || !is_small(name[1]));
}

}  // namespace

bool is_keyword(std::string_view name) {
    return std::ranges::binary_search(keywords, name);
}

bool is_reserved(std::string_view name) {
    if (name.empty() || name.ends_with('_')) return false;
    return is_keyword(name) || std::ranges::binary_search(macros, name) || looks_like_macro(name) ||
           name == "std" || name.starts_with("rddl");
}

}  // namespace rddlc::cpp
