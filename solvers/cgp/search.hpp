// CGP: programs change a little, and those that act as well or better stay.
//
// (1 + lambda) with neutral drift: a child that is as good as its parent takes its place. Episodes
// of a generation begin with the same random numbers for parent and children, new ones in each
// generation; of several episodes, all candidates play a few and the best of them the others. If
// all programs have the same return, it does not show which of them is nearer to something better.
// Then those stay that see more of the problem: a simple form of novelty search (J. Lehman, K.
// Stanley, "Abandoning objectives", 2011). Islands do this side by side, and at times the best
// program of an island moves to the next one, in a ring.
#pragma once

#include "solvers/cgp/genome.hpp"
#include "solvers/cgp/scope.hpp"
#include "solvers/ranks/ranks.hpp"
#include "support/memory.hpp"

#include <rddl/simulator.h>

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace rddlc::solvers {

enum class Measure { Mean, Median, Minimum, WorstFifth };  // of the returns of episodes

struct CgpOptions {
    std::int64_t generations = 1000;
    int children = 0;  // lambda; 0: 32, or 8 where anything is drawn at random
    int nodes = 100;
    int constants = 4;
    int levels_back = 0;
    Mutation mutation = Mutation::Single;
    std::vector<Function> functions = default_functions();
    int episodes = 0;  // of each candidate; 0: 1, or 16 where anything is drawn at random
    Measure measure = Measure::Mean;
    std::int64_t restart_after = 300;  // generations without a better program; 0: never
    std::int64_t tune_every = 50;     // generations between searches for better constants; 0: never
    std::int64_t migrate_every = 50;  // generations
    int islands = 0;                  // 0: one for each rank
    int threads = 1;
    std::int64_t memory_limit =
        default_memory_limit;  // bytes of all that it takes (memory_estimate.hpp)
    Lifting lifting = Lifting::Auto;
    bool parsimony = true;  // of programs that are as good, a smaller one is better
    bool time = false;      // programs read how much of the episode is over
    // Programs and mutations are those of scikit-decide (skdecide.hpp), and so is lambda unless it
    // is given. Its evaluation is not: one lucky episode does not make a record here.
    bool skdecide = false;
    std::uint64_t seed = 0;
    // All threads call it often: whether run() shall end early. Its results are then not those of a
    // complete run. May be empty.
    std::function<bool()> stops;
};

// The fitness of a program. A higher value is better, then fewer steps, then fewer nodes. As long
// as no program has a higher return than the first one, a longer reach comes before fewer nodes.
struct Fitness {
    double value = 0;
    double steps = 0;  // of an episode
    double reach = 0;  // how widely what is observed varies (evaluator.hpp), where it was asked for
    int nodes = 0;
};

struct CgpProgress {
    std::int64_t generations = 0, evaluations = 0, episodes = 0, restarts = 0;
    Fitness best;
    double mean_of_children = 0;  // of the last generation
    bool replaced = false;        // the parent, in the last generation of the first island
    double seconds = 0;
};

class CgpSearch {
  public:
    // The simulator must outlive this. Ranks share the islands; the results do not depend on the
    // number of ranks. Throws a Failure if there are fewer islands than ranks.
    CgpSearch(const rddl_simulator& simulator, const CgpOptions& options, const Ranks& ranks = {});
    ~CgpSearch();

    void run(std::int64_t generations);

    const ProgramScope& scope() const;
    const Genome& best() const;
    const CgpProgress& progress() const;
    // An upper bound over all islands.
    std::int64_t steps_of_generation() const;

    std::string save() const;
    void load(std::string_view bytes);

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace rddlc::solvers
