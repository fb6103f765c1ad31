#include "driver/cpp_compiler.hpp"

#include "driver/process.hpp"

#include <cstdlib>
#include <map>
#include <mutex>
#include <sstream>
#include <utility>

namespace rddlc {
namespace {

using Words = std::vector<std::string>;

Words words_of(const char* text) {
    std::istringstream stream(text);
    Words words;
    for (std::string word; stream >> word;) words.push_back(word);
    return words;
}

// Compiles nothing with them. A compiler that is interrupted has refused nothing.
bool takes(Words command, const Words& flags, const std::stop_token& stop) {
    command.insert(command.end(), flags.begin(), flags.end());
    command.insert(command.end(), {"-Werror", "-fsyntax-only", "-x", "c++", "/dev/null"});
    const auto result = run_process(command, {}, {}, stop);
    return result && (result->status == 0 || result->was_killed());
}

Words ask(const Words& compiler, const std::stop_token& stop) {
    const Words wanted = words_of(RDDLC_SIMULATOR_FLAGS);
    if (takes(compiler, wanted, stop) || !takes(compiler, {}, stop)) return wanted;
    Words taken;
    for (const std::string& flag : wanted)
        if (takes(compiler, {flag}, stop)) taken.push_back(flag);
    return taken;
}

}  // namespace

std::vector<std::string> cpp_compiler() {
    const char* const text = std::getenv("CXX");
    const Words command = words_of(text ? text : "");
    return command.empty() ? Words{"c++"} : command;
}

// The lock is not held while the compiler is asked: a process that is forked then would never get
// it.
std::vector<std::string> simulator_flags(const std::vector<std::string>& compiler,
                                         const std::stop_token& stop) {
    static std::mutex mutex;
    static std::map<Words, Words> answers;
    {
        const std::lock_guard lock(mutex);
        if (const auto known = answers.find(compiler); known != answers.end()) return known->second;
    }
    Words answer = ask(compiler, stop);
    if (stop.stop_requested()) return words_of(RDDLC_SIMULATOR_FLAGS);
    const std::lock_guard lock(mutex);
    return answers.emplace(compiler, std::move(answer)).first->second;
}

}  // namespace rddlc
