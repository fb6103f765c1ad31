// One population of CGP.
#pragma once

#include "solvers/cgp/evaluator.hpp"
#include "solvers/cgp/memory_estimate.hpp"
#include "solvers/cgp/search.hpp"
#include "support/failure.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <numeric>
#include <span>
#include <unordered_map>
#include <vector>

namespace rddlc::solvers {

// A program that may beat the record plays this many more episodes, which are the same for all such
// programs.
inline constexpr std::int64_t confirmations = 64;

// How many programs play how many episodes of the first round, of the others and to confirm a
// record; the last two where anything is drawn at random.
struct EvaluatorSize {
    std::int64_t programs, episodes;
};
inline std::vector<EvaluatorSize> evaluator_sizes(const CgpOptions& options) {
    const std::int64_t few = std::max(1, options.episodes / 4);
    std::vector<EvaluatorSize> sizes = {{std::int64_t{options.children} + 1, few}};
    if (options.episodes == 1) return sizes;
    // The parent and a quarter of the children play all episodes.
    sizes.push_back({1 + std::max(1, options.children / 4), options.episodes - few});
    sizes.push_back({1, confirmations});
    return sizes;
}

inline bool beats(const Fitness& a, const Fitness& b) {
    if (a.value != b.value) return a.value > b.value;
    return a.steps < b.steps;
}
// The order while no program has a higher return than the first one.
inline bool sees_more(const Fitness& a, const Fitness& b) {
    if (beats(a, b) || beats(b, a)) return beats(a, b);
    return a.reach > b.reach;
}
// The order of records: the smaller of equally good programs is better.
inline bool is_better(const Fitness& a, const Fitness& b) {
    if (beats(a, b) || beats(b, a)) return beats(a, b);
    return a.nodes < b.nodes;
}

inline double measured(std::span<double> returns, Measure measure) {
    std::sort(returns.begin(), returns.end());
    const std::size_t count = returns.size();
    const auto mean = [&](std::size_t first) {
        return std::accumulate(returns.begin(),
                               returns.begin() + static_cast<std::ptrdiff_t>(first), 0.0) /
               static_cast<double>(first);
    };
    switch (measure) {
        case Measure::Median:
            return (returns[(count - 1) / 2] + returns[count / 2]) / 2;
        case Measure::Minimum:
            return returns.front();
        case Measure::WorstFifth:
            return mean(std::max<std::size_t>(count / 5, 1));
        case Measure::Mean:
            break;
    }
    return mean(count);
}

template <class Archive>
void archive_genome(Archive& archive, Genome& genome) {
    archive(genome.inputs);
    archive(genome.constants);
    archive(genome.nodes);
    archive(genome.outputs);
    archive(genome.delayed);
    if constexpr (Archive::is_loading)
        if (!is_sound(genome)) throw Failure("a program in it is damaged");
}

// A program, and how good it is.
struct Found {
    Genome genome;
    Fitness fitness;
};

// One population: a parent, and the known fitness of programs.
class Island {
  public:
    Island(const rddl_simulator& simulator, const ProgramScope& scope, const CgpOptions& options,
           int number)
        : options_(options),
          shape_{scope.input_count(), options.constants, options.nodes,   scope.output_count(),
                 options.levels_back, options.functions, options.skdecide},
          random_(options.seed, static_cast<std::uint64_t>(number)),
          sizes_(evaluator_sizes(options)),
          first_round_(simulator, scope, sizes_[0].programs, sizes_[0].episodes, &options.stops),
          most_remembered_(most_remembered(options)) {
        if (is_noisy()) {
            others_ = std::make_unique<Evaluator>(simulator, scope, sizes_[1].programs,
                                                  sizes_[1].episodes, &options.stops);
            confirmation_ = std::make_unique<Evaluator>(simulator, scope, sizes_[2].programs,
                                                        sizes_[2].episodes, &options.stops);
        }
        father_ = random_genome(shape_, random_);
        record_ = father_;
        if (options.episodes == 1) {
            fitness_ = evaluate_all({father_}).front();
            note(father_, fitness_);
        }
    }

    std::int64_t kept() const { return sizes_[1].programs; }
    bool is_noisy() const { return options_.episodes > 1; }

    void generation() {
        const std::size_t first = is_noisy() ? 1 : 0;  // with noise the parent plays again
        candidates_.resize(first + static_cast<std::size_t>(options_.children));
        const Activity activity = activity_of(father_);
        for (std::size_t c = 0; c < candidates_.size(); ++c) {
            candidates_[c] = father_;
            if (c >= first) mutate(candidates_[c], shape_, options_.mutation, activity, random_);
        }
        choose(candidates_);
        generations_ += 1;
        if (options_.tune_every > 0 && generations_ % options_.tune_every == 0) tune();
        if (options_.restart_after > 0 && stagnation_ >= options_.restart_after) restart();
    }

    void welcome(const Found& found) {
        const bool comes_in = is_exploring() ? beats(found.fitness, fitness_)
                                             : is_noisy() || !beats(fitness_, found.fitness);
        if (comes_in) {
            father_ = found.genome;
            fitness_ = found.fitness;
        }
    }

    const Genome& record() const { return record_; }
    const Fitness& record_fitness() const { return record_fitness_; }
    std::int64_t evaluations() const { return evaluations_; }
    std::int64_t episodes() const { return episodes_; }
    std::int64_t restarts() const { return restarts_; }
    double mean_of_children() const { return mean_of_children_; }
    bool replaced() const { return replaced_; }

    template <class Archive>
    void archive(Archive& archive) {
        archive(random_);
        for (Genome* const genome : {&father_, &record_}) {
            archive_genome(archive, *genome);
            if (!has_shape(*genome, shape_))
                throw Failure("a program in it does not belong to this problem and these options");
        }
        archive(fitness_);
        archive(record_fitness_);
        archive(has_record_);
        archive(generations_);
        archive(stagnation_);
        archive(evaluations_);
        archive(episodes_);
        archive(restarts_);
        archive(confirmed_);
        archive(start_value_);
        archive(deviation_);
    }

  private:
    // Known programs are not run again.
    std::vector<Fitness> evaluate_all(const std::vector<Genome>& genomes) {
        std::vector<Fitness> all(genomes.size());
        std::vector<Program> programs;
        std::vector<std::size_t> places;
        std::vector<std::uint64_t> hashes(genomes.size());
        for (std::size_t g = 0; g < genomes.size(); ++g) {
            Program program(genomes[g]);
            hashes[g] = program.hash();
            all[g].nodes = program.nodes();
            const auto known = known_.find(hashes[g]);
            if (known != known_.end()) {
                all[g].value = known->second.value;
                all[g].steps = known->second.steps;
                all[g].reach = known->second.reach;
            } else {
                programs.push_back(std::move(program));
                places.push_back(g);
            }
        }
        evaluations_ += static_cast<std::int64_t>(genomes.size());
        if (programs.empty()) return all;
        std::vector<const Program*> pointers;
        for (const Program& program : programs) pointers.push_back(&program);
        std::vector<double> returns(static_cast<std::size_t>(first_round_.room())),
            lengths(returns.size()), reach(returns.size());
        const std::uint64_t seed = options_.seed;
        first_round_.evaluate(pointers, {&seed, 1}, returns.data(), lengths.data(),
                              is_exploring() ? reach.data() : nullptr);
        if (is_stopped(&options_.stops)) return all;  // nothing of it is to be remembered
        episodes_ += static_cast<std::int64_t>(programs.size());
        if (known_.size() >= most_remembered_) known_.clear();
        for (std::size_t p = 0; p < programs.size(); ++p) {
            Fitness& fitness = all[places[p]];
            fitness.value = returns[p];
            fitness.steps = lengths[p];
            fitness.reach = reach[p];
            known_[hashes[places[p]]] = fitness;
        }
        return all;
    }

    // Compares programs where episodes are random; the parent is the first. All play some episodes.
    // The best of them and the parent play the others. All begin with the same random numbers.
    std::vector<Fitness> race(const std::vector<Genome>& genomes) {
        std::vector<Program> programs;
        std::vector<Fitness> all;
        for (const Genome& genome : genomes) {
            programs.emplace_back(genome);
            all.push_back({0, 0, 0, programs.back().nodes()});
        }
        std::vector<std::uint64_t> seeds;
        for (int e = 0; e < options_.episodes; ++e) seeds.push_back(random_.bits());
        const std::size_t few = static_cast<std::size_t>(first_round_.episodes());
        std::vector<std::vector<double>> returns(genomes.size());
        std::vector<double> steps(genomes.size()), reaches(genomes.size());
        const auto play = [&](Evaluator& evaluator, const std::vector<std::size_t>& who,
                              std::span<const std::uint64_t> its_seeds) {
            std::vector<const Program*> pointers;
            for (const std::size_t w : who) pointers.push_back(&programs[w]);
            const auto episodes = static_cast<std::size_t>(evaluator.episodes());
            std::vector<double> some(static_cast<std::size_t>(evaluator.room()) * episodes),
                lengths(some.size()), reach(some.size());
            evaluator.evaluate(pointers, its_seeds, some.data(), lengths.data(),
                               is_exploring() ? reach.data() : nullptr);
            episodes_ += static_cast<std::int64_t>(who.size() * episodes);
            for (std::size_t k = 0; k < who.size(); ++k)
                for (std::size_t e = 0; e < episodes; ++e) {
                    returns[who[k]].push_back(some[k * episodes + e]);
                    steps[who[k]] += lengths[k * episodes + e];
                    reaches[who[k]] += reach[k * episodes + e];
                }
        };
        std::vector<std::size_t> order(genomes.size());
        std::iota(order.begin(), order.end(), std::size_t{0});
        play(first_round_, order, std::span(seeds).first(few));
        const auto rate = [&](std::size_t g) {
            std::vector<double> sorted = returns[g];
            all[g].value = measured(sorted, options_.measure);
            all[g].steps = steps[g] / static_cast<double>(returns[g].size());
            all[g].reach = reaches[g] / static_cast<double>(returns[g].size());
        };
        for (std::size_t g = 0; g < genomes.size(); ++g) rate(g);
        std::stable_sort(order.begin() + 1, order.end(),
                         [&](std::size_t a, std::size_t b) { return sees_more(all[a], all[b]); });
        order.resize(std::min(order.size(), static_cast<std::size_t>(kept())));
        play(*others_, order, std::span(seeds).subspan(few));
        for (std::size_t g = 0; g < genomes.size(); ++g)
            if (std::find(order.begin(), order.end(), g) == order.end())
                all[g].value = -std::numeric_limits<double>::infinity();
        for (const std::size_t g : order) rate(g);
        evaluations_ += static_cast<std::int64_t>(genomes.size());
        return all;
    }

    void choose(const std::vector<Genome>& candidates) {
        const std::vector<Fitness> all = is_noisy() ? race(candidates) : evaluate_all(candidates);
        const std::size_t first = is_noisy() ? 1 : 0;
        if (is_noisy()) fitness_ = all.front();
        if (!(start_value_ < std::numeric_limits<double>::infinity()))
            start_value_ = fitness_.value;
        const bool explores = is_exploring();
        const auto is_ahead = [&](const Fitness& a, const Fitness& b) {
            return explores ? sees_more(a, b) : is_better(a, b);
        };
        std::size_t best = first;
        double sum = 0, count = 0;
        for (std::size_t c = first; c < all.size(); ++c) {
            if (is_ahead(all[c], all[best])) best = c;
            if (std::isfinite(all[c].value)) {
                sum += all[c].value;
                count += 1;
            }
        }
        mean_of_children_ = count > 0 ? sum / count : 0;
        // Programs grow and shrink freely as long as no program beats the first one.
        replaced_ = explores             ? !sees_more(fitness_, all[best])
                    : options_.parsimony ? !is_better(fitness_, all[best])
                                         : !beats(fitness_, all[best]);
        const bool improves =
            explores ? sees_more(all[best], fitness_) : beats(all[best], fitness_);
        if (replaced_) {
            father_ = candidates[best];
            fitness_ = all[best];
        }
        stagnation_ = improves ? 0 : stagnation_ + 1;
        if (is_noisy())
            confirm();
        else
            for (std::size_t c = 0; c < all.size(); ++c) note(candidates[c], all[c]);
    }

    // No program has a higher return than the first one.
    bool is_exploring() const { return !(fitness_.value > start_value_); }

    void note(const Genome& genome, const Fitness& fitness) {
        if (has_record_ && !is_better(fitness, record_fitness_)) return;
        has_record_ = true;
        record_ = genome;
        record_fitness_ = fitness;
    }

    // Plays the confirmation episodes for a new parent.
    void confirm() {
        if (generations_ % 5 != 0 && has_record_) return;
        const Program program(father_);
        if (has_record_ && program.hash() == confirmed_) return;
        confirmed_ = program.hash();
        const Program* const pointer = &program;
        std::vector<std::uint64_t> seeds;
        Random numbers(options_.seed, std::uint64_t{1} << 40);
        for (std::int64_t e = 0; e < confirmations; ++e) seeds.push_back(numbers.bits());
        std::vector<double> returns(confirmations), lengths(confirmations);
        confirmation_->evaluate({&pointer, 1}, seeds, returns.data(), lengths.data());
        episodes_ += confirmations;
        const double steps = std::accumulate(lengths.begin(), lengths.end(), 0.0) /
                             static_cast<double>(confirmations);
        note(father_, {measured(returns, options_.measure), steps, 0, program.nodes()});
    }

    // Evolution strategy on the constants that count: children around the parent, with a step size
    // that adapts itself.
    void tune() {
        constexpr int rounds = 10;
        const Activity activity = activity_of(father_);
        std::vector<std::size_t> used;
        for (std::size_t c = 0; c < father_.constants.size(); ++c)
            if (activity.used[static_cast<std::size_t>(father_.inputs) + c]) used.push_back(c);
        if (used.empty()) return;
        for (int round = 0; round < rounds && !is_stopped(&options_.stops); ++round) {
            std::vector<Genome> candidates{father_};
            for (int c = 0; c < options_.children; c += 2) {
                Genome plus = father_, minus = father_;  // mirrored
                for (const std::size_t k : used) {
                    const double step = deviation_ * std::max(std::abs(father_.constants[k]), 0.1) *
                                        random_.normal();
                    plus.constants[k] += step;
                    minus.constants[k] -= step;
                }
                candidates.push_back(plus);
                if (c + 1 < options_.children) candidates.push_back(minus);
            }
            if (!is_noisy()) candidates.erase(candidates.begin());
            choose(candidates);
            deviation_ = std::clamp(deviation_ * (stagnation_ == 0 ? 1.5 : 0.85), 1e-4, 1.0);
        }
        deviation_ = std::max(deviation_, 0.01);
    }

    void restart() {
        father_ = random_genome(shape_, random_);
        stagnation_ = 0;
        restarts_ += 1;
        start_value_ = std::numeric_limits<double>::infinity();
        known_.clear();  // the reach of some of them was not measured
        if (!is_noisy()) fitness_ = evaluate_all({father_}).front();
    }

    const CgpOptions& options_;
    GenomeShape shape_;
    Random random_;
    std::vector<EvaluatorSize> sizes_;
    Evaluator first_round_;
    std::unique_ptr<Evaluator> others_, confirmation_;
    Genome father_, record_;
    std::vector<Genome> candidates_;  // of a generation; kept for their memory alone
    Fitness fitness_, record_fitness_;
    bool has_record_ = false, replaced_ = false;
    std::int64_t generations_ = 0, stagnation_ = 0, evaluations_ = 0, episodes_ = 0, restarts_ = 0;
    std::uint64_t confirmed_ = 0;
    double start_value_ = std::numeric_limits<double>::infinity(), mean_of_children_ = 0,
           deviation_ = 0.3;
    std::size_t most_remembered_;
    std::unordered_map<std::uint64_t, Fitness> known_;
};

}  // namespace rddlc::solvers
