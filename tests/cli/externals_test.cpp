// --extern: external functions for both engines, from a header or a shared object.
#include "program.hpp"

namespace rddlc::cli {
namespace {

constexpr const char* pond = R"(domain pond {
    types { pipe : object; };
    pvariables {
        WIDTH(pipe) : { non-fluent, real, default = 0.5 };
        open(pipe) : { action-fluent, bool, default = false };
        water : { state-fluent, real, default = 5.0 };
    };
    cpfs { water' = water + $in-flow[](open(_), WIDTH(_)); };
    reward = water;
    action-preconditions { $in-flow[](open(_), WIDTH(_)) <= 100; };
}
non-fluents two { domain = pond; objects { pipe : { a, b }; }; non-fluents { WIDTH(b) = 2.0; }; }
instance pond_1 { domain = pond; non-fluents = two; horizon = 5; discount = 1.0; }
)";

// `constants.hpp` defines `rate`.
constexpr const char* functions = R"(#include "constants.hpp"
#include <algorithm>
#include <cstddef>
#include <span>
namespace rddl_extern {
inline double in_flow(std::span<const bool> open, std::span<const double> width) {
    double flow = 0.25;
    for (std::size_t i = 0; i < open.size(); ++i) flow += open[i] ? rate * width[i] : 0.0;
    return flow;
}
}
)";

constexpr const char* library = R"(#include "functions.hpp"
#include <rddl/external.hpp>
RDDL_EXTERN(in_flow, double(std::span<const bool>, std::span<const double>))
)";

class Externals : public Program {
  protected:
    Externals() {
        write_file(folder_ / "pond.rddl", pond);
        write_file(folder_ / "functions.hpp", functions);
        set_rate("3.0");
    }
    void set_rate(const std::string& rate) const {
        write_file(folder_ / "constants.hpp", "inline constexpr double rate = " + rate + ";");
    }
    // The water after one step with both pipes open.
    double water(const std::string& options) const {
        write_file(folder_ / "in.jsonl", R"({"action": {"open___a": true, "open___b": true}})");
        const Outcome outcome = run("replay pond.rddl --input in.jsonl " + options);
        EXPECT_EQ(outcome.status, 0) << outcome.err;
        return outcome.status == 0
                   ? nlohmann::json::parse(outcome.out)["state"]["water"].get<double>()
                   : -1;
    }
    // The simulators and external functions; the code of batches is there for all of them.
    std::ptrdiff_t kept() const {
        return std::ranges::count_if(
            std::filesystem::directory_iterator(cache() / "rddlc"),
            [](const auto& file) { return file.path().extension() == ".so"; });
    }
    void make_library(const std::string& text) const {
        write_file(folder_ / "library.cpp", text);
        const std::string command =
            fmt::format("cd '{}' && c++ -std=c++20 -shared -fPIC -I '{}' library.cpp -o library.so",
                        folder_.string(), RDDL_RUNTIME);
        ASSERT_EQ(std::system(command.c_str()), 0);
    }
};

TEST_F(Externals, AreTheSameForBothEngines) {
    EXPECT_EQ(water("--extern functions.hpp --engine compiled"), 12.75);
    EXPECT_EQ(water("--extern functions.hpp --engine interpreter"), 12.75);
    const auto trace = [&](const std::string& engine) {
        const Outcome outcome =
            run("run pond.rddl --extern functions.hpp --episodes 3 --trace - "
                "--quiet --threads 1 --engine " +
                engine);
        EXPECT_EQ(outcome.status, 0) << outcome.err;
        return outcome.out.substr(outcome.out.find('\n'));
    };
    EXPECT_EQ(trace("compiled"), trace("interpreter"));
    EXPECT_EQ(run("bench pond.rddl --extern functions.hpp --seconds 0.01 --threads 1").status, 0);
}

TEST_F(Externals, AreCompiledAgainWhenTheHeaderOrWhatItIncludesChanges) {
    use_own_cache();
    for (const std::string engine : {"compiled", "interpreter"}) {
        std::filesystem::remove_all(cache());
        const std::string options = "--extern functions.hpp --engine " + engine;
        EXPECT_EQ(water(options), 12.75);
        EXPECT_EQ(water(options), 12.75);
        EXPECT_EQ(kept(), 1);
        set_rate("1.0");
        EXPECT_EQ(water(options), 7.75);
        EXPECT_EQ(kept(), 2);
        set_rate("3.0");
        EXPECT_EQ(water(options), 12.75);
        EXPECT_EQ(kept(), 2);
    }
}

TEST_F(Externals, MayComeFromASharedObject) {
    make_library(library);
    EXPECT_EQ(water("--extern library.so --engine interpreter"), 12.75);
    EXPECT_EQ(water("--extern library.so"), 12.75);
    const Outcome outcome = run("run pond.rddl --engine compiled --extern library.so");
    EXPECT_EQ(outcome.status, 2);
    EXPECT_NE(outcome.err.find("takes external functions from a C++ header"), std::string::npos);
}

TEST_F(Externals, AreLookedForAndAskedBeforeTheFirstStep) {
    make_library("");
    const Outcome missing = run("run pond.rddl --extern library.so --engine interpreter");
    EXPECT_EQ(missing.status, 1);
    EXPECT_NE(missing.err.find("has no function 'rddl_extern_in_flow' for '$in-flow'"),
              std::string::npos)
        << missing.err;
    make_library(R"(#include <rddl/external.hpp>
        namespace rddl_extern { double in_flow(double x) { return x; } }
        RDDL_EXTERN(in_flow, double(double)))");
    const Outcome other = run("run pond.rddl --extern library.so --engine interpreter");
    EXPECT_EQ(other.status, 1);
    EXPECT_NE(other.err.find("'rddl_extern_in_flow' of the shared object cannot be called as "
                             "double(std::span<const bool, 2>, std::span<const double, 2>)"),
              std::string::npos)
        << other.err;
}

TEST_F(Externals, AreCalledWhereViolatedPreconditionsAreExplained) {
    set_rate("100.0");
    for (const std::string engine : {"compiled", "interpreter"}) {
        write_file(folder_ / "in.jsonl", R"({"action": {"open___b": true}})");
        const Outcome outcome =
            run("replay pond.rddl --extern functions.hpp --preconditions=warn "
                "--input in.jsonl --engine " +
                engine);
        EXPECT_EQ(outcome.status, 0) << outcome.err;
        EXPECT_NE(outcome.err.find("precondition violated"), std::string::npos) << outcome.err;
    }
}

TEST_F(Externals, AreCheckedOnRequest) {
    EXPECT_EQ(run("check pond.rddl").status, 0);
    EXPECT_EQ(run("check pond.rddl --extern functions.hpp").status, 0);
    write_file(folder_ / "functions.hpp", "namespace rddl_extern { int in_flow(); }");
    const Outcome outcome = run("check pond.rddl --extern functions.hpp");
    EXPECT_EQ(outcome.status, 1);
    EXPECT_NE(outcome.err.find("must be callable as double rddl_extern::in_flow("),
              std::string::npos)
        << outcome.err;
}

}  // namespace
}  // namespace rddlc::cli
