#include "driver/cpp_compiler.hpp"

#include "driver/process.hpp"

#include <cstdlib>
#include <map>
#include <mutex>
#include <sstream>

namespace rddlc {
namespace {

using Words = std::vector<std::string>;

// Lanes are vectors already. GCC would put numbers of one environment together as well, which
// costs more than it gains where they then wait for each other, as in a polynomial. It would
// keep the coefficients of polynomials that are evaluated twice in registers (gcse), and
// numbers elsewhere. Nor may it make one copy of a loop over a constant table: GCC 12 is wrong
// there (rddl/tables.hpp). The body of a loop over several objects stands in two calls
// (rddl/objects.hpp), which GCC would take for a reason to inline neither.
const std::vector<Words> wanted = {{"-fno-tree-slp-vectorize"},
                                   {"-fno-gcse"},
                                   {"-fno-tree-loop-distribute-patterns"},
                                   {"--param", "max-inline-insns-single=400"}};

void append(Words& words, const Words& more) {
    words.insert(words.end(), more.begin(), more.end());
}

// Compiles nothing with them.
bool takes(Words command, const Words& flags) {
    append(command, flags);
    append(command, {"-Werror", "-fsyntax-only", "-x", "c++", "/dev/null"});
    const auto result = run_process(command);
    return result && result->status == 0;
}

Words ask(const Words& compiler) {
    Words all;
    for (const Words& flags : wanted) append(all, flags);
    if (takes(compiler, all) || !takes(compiler, {})) return all;
    Words taken;
    for (const Words& flags : wanted)
        if (takes(compiler, flags)) append(taken, flags);
    return taken;
}

}  // namespace

std::vector<std::string> cpp_compiler() {
    const char* const text = std::getenv("CXX");
    std::istringstream stream(text ? text : "");
    Words command;
    for (std::string word; stream >> word;) command.push_back(word);
    return command.empty() ? Words{"c++"} : command;
}

std::vector<std::string> optional_flags(const std::vector<std::string>& compiler) {
    static std::mutex mutex;
    static std::map<Words, Words> answers;
    const std::lock_guard lock(mutex);
    const auto known = answers.find(compiler);
    return known != answers.end() ? known->second
                                  : answers.emplace(compiler, ask(compiler)).first->second;
}

}  // namespace rddlc
