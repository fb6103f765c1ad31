// Over 400 lines: one class, the course of a training from its folder to its last file.
#include "solvers/training/training.hpp"

#include "solvers/evaluation/summary.hpp"
#include "solvers/files/archive.hpp"
#include "solvers/files/fingerprint.hpp"
#include "solvers/training/baselines.hpp"
#include "solvers/training/checkpoint_file.hpp"
#include "solvers/training/run_folder.hpp"
#include "solvers/training/run_log.hpp"
#include "support/files.hpp"
#include "support/json_text.hpp"
#include "support/program.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>

namespace rddlc::solvers {

namespace {

using Clock = std::chrono::steady_clock;

double seconds_between(Clock::time_point begin, Clock::time_point end) {
    return std::chrono::duration<double>(end - begin).count();
}

constexpr double seconds_between_checkpoints = 10;

// "3.2 s", "4 min 10 s", "2 h 5 min".
std::string time_text(double seconds) {
    if (seconds < 60) return fmt::format("{:.1f} s", seconds);
    const auto whole = static_cast<long long>(seconds);
    return whole < 3600 ? fmt::format("{} min {} s", whole / 60, whole % 60)
                        : fmt::format("{} h {} min", whole / 3600, whole / 60 % 60);
}

class Training {
  public:
    Training(const rddl_simulator& simulator, const Trainee& trainee,
             const TrainingOptions& options)
        : simulator_(simulator), trainee_(trainee), options_(options) {}

    TrainingResult run() {
        open_folder();
        begin_ = last_shown_ = last_saved_ = Clock::now();
        if (options_.ranks.is_first())
            baselines_ = baselines(simulator_, evaluation_options(), options_.stops);
        if (!options_.resumes && trainee_.prepare) prepare_or_leave_nothing();
        if (owes_evaluation_) finish_update();
        bool stops = result_.reached;
        while (!stops && !trainee_.done() && update()) {
            finish_update();
            show(false);
            agree();
            stops = result_.interrupted || ends_by_time_ || result_.reached;
            if (!stops && saves_) save(state());
        }
        // A resumed run must not know of an evaluation that a complete run does not make.
        const std::string before = state();
        if (!evaluated_ || evaluated_at_ != trainee_.steps()) evaluate();
        show(true);
        save(before);
        result_.seconds = elapsed();
        result_.has_best = has_best_;
        result_.best_return = best_return_;
        result_.best_length = best_length_;
        result_.best_policy = best_policy_;
        if (has_best_ && !result_.interrupted)
            result_.no_better =
                complaint_about({.mean = best_return_, .half_width = best_half_width_}, baselines_,
                                trainee_.advice);
        if (!has_best_ && !result_.interrupted && !result_.not_finite.empty())
            throw Failure(fmt::format("no evaluation has a finite return: {}", result_.not_finite),
                          "'rddl run --trace' shows what leads there");
        return result_;
    }

  private:
    // The policy learned before the first update counts as its first policy.
    void prepare_or_leave_nothing() {
        try {
            prepare();
        } catch (...) {
            std::error_code ignored;  // a folder that is not empty stays
            if (made_folder_) std::filesystem::remove(options_.folder, ignored);
            throw;
        }
    }

    void prepare() {
        const std::string said = trainee_.prepare();
        if (options_.stops && options_.stops())
            throw Failure("interrupted before the first update");
        evaluate();
        if (!options_.quiet && options_.ranks.is_first())
            tell("{}; the policy that imitates it {:.6g}\n", said, last_return_);
    }

    std::filesystem::path file(const char* name) const { return options_.folder / name; }

    // Each rank reads the files of the problem by itself.
    void require_one_problem() const {
        const Ranks& ranks = options_.ranks;
        if (ranks.count == 1) return;
        const Fingerprint own = fingerprint(simulator_);
        SavingArchive archive;
        Fingerprint(own).archive(archive);
        for (const std::string& bytes : ranks.gather(archive.bytes())) {
            if (bytes == archive.bytes()) continue;
            LoadingArchive others(bytes);
            Fingerprint its;
            its.archive(others);
            throw Failure("the ranks have read different problems: of one of them, " +
                          difference(its, own));
        }
    }

    void open_folder() {
        require_one_problem();
        if (options_.ranks.is_first()) {
            // Now, so that nothing is learned that cannot be written.
            if (!options_.resumes)
                made_folder_ = std::filesystem::create_directories(options_.folder);
            held_.hold(options_.folder);
            if (!options_.resumes && std::filesystem::exists(file("checkpoint")))
                throw Failure(
                    fmt::format("the folder '{}' holds a run already", options_.folder.string()),
                    "continue it with --resume, or name another one with --out");
            if (is_folder(options_.folder)) require_writable(file("checkpoint"), {});
        }
        if (options_.resumes) load();
    }

    double elapsed() const { return seconds_before_ + seconds_between(begin_, Clock::now()); }

    // Shares what clocks and signals report on one rank with all ranks.
    void agree() {
        const bool interrupted = options_.stops && options_.stops();
        const bool out_of_time = options_.seconds > 0 && elapsed() >= options_.seconds;
        const bool due = seconds_between(last_saved_, Clock::now()) > seconds_between_checkpoints;
        double flags[] = {interrupted ? 1.0 : 0.0, out_of_time ? 1.0 : 0.0, due ? 1.0 : 0.0};
        options_.ranks.add_up(flags);
        result_.interrupted = flags[0] > 0;
        ends_by_time_ = flags[1] > 0;
        saves_ = flags[2] > 0;
    }

    // Returns false if it was interrupted: then all is as it was before, so that a resumed run is
    // the same to the byte.
    bool update() {
        if (!trainee_.ends_early) {
            work();
            return true;
        }
        const std::string before = trainee_.save();
        work();
        result_.interrupted = options_.stops && options_.stops();
        if (result_.interrupted) trainee_.load(before);
        return !result_.interrupted;
    }

    void work() {
        if (options_.seconds > 0 && trainee_.update_until)
            trainee_.update_until([this] { return elapsed() >= options_.seconds; });
        else
            trainee_.update();
    }

    // Ranks evaluate together, and their clocks differ.
    double part_done() const {
        if (!trainee_.is_evaluated_by_time || options_.seconds <= 0 || options_.ranks.count > 1)
            return trainee_.part_done();
        return std::min(1.0, std::max(trainee_.part_done(), elapsed() / options_.seconds));
    }

    std::int64_t evaluations_due() const {
        return static_cast<std::int64_t>(part_done() * static_cast<double>(options_.evaluations));
    }

    // The work after an update. A run that was interrupted meanwhile does it when it is resumed.
    void finish_update() {
        const bool due = part_done() >= static_cast<double>(evaluations_ + 1) /
                                            static_cast<double>(options_.evaluations);
        const bool promises = options_.stop_return && trainee_.best_known &&
                              trainee_.best_known() >= *options_.stop_return;
        owes_evaluation_ = (due || promises) && !evaluate();
        if (!owes_evaluation_) log();
    }

    // On seeds that are the same for all evaluations.
    EpisodeOptions evaluation_options() const {
        EpisodeOptions episodes;
        episodes.episodes = simulator_.problem->stochastic ? options_.evaluation_episodes : 1;
        episodes.seed = options_.seed + 0x65766131;
        episodes.horizon = horizon_of_learners(*simulator_.problem);
        return episodes;
    }

    // The likeliest actions. False, and nothing is known of them, where an interrupt came and they
    // take long.
    bool evaluate() {
        const EpisodeOptions episodes = evaluation_options();
        const Clock::time_point begin = Clock::now();
        Watch watch;
        watch.stops = [&] {
            return options_.stops && options_.stops() && seconds_between(begin, Clock::now()) > 1;
        };
        const Rollouts rollouts = run_episodes(simulator_, trainee_.policy(), episodes, watch);
        const auto is_finished = [](const Episode& episode) {
            return episode.finished;
        };
        if (options_.ranks.any(!std::ranges::all_of(rollouts.episodes, is_finished))) return false;
        const Summary summary = summary_of(rollouts);
        evaluated_ = true;
        evaluated_at_ = trainee_.steps();
        evaluations_ = evaluations_due();
        last_return_ = summary.undiscounted_return.mean;
        last_length_ = summary.length.mean;
        result_.episodes = summary.episodes;
        result_.faulted = summary.faulted;
        if (rollouts.first_fault) result_.first_fault = rollouts.first_fault->message;
        // Among episodes with the same return, those that reach their end sooner are better.
        const bool is_finite = std::isfinite(last_return_);
        result_.not_finite = is_finite ? "" : what_is_not_finite(rollouts);
        const bool better =
            !has_best_ || last_return_ > best_return_ ||
            (last_return_ == best_return_ && summary.terminated > 0 && last_length_ < best_length_);
        if (is_finite && better) {
            has_best_ = true;
            best_return_ = last_return_;
            best_half_width_ = summary.undiscounted_return.half_width;
            best_length_ = last_length_;
            best_policy_ = trainee_.policy_text();
        }
        if (options_.stop_return && is_finite && last_return_ >= *options_.stop_return)
            result_.reached = true;
        return true;
    }

    void log() {
        Row row = trainee_.row();
        row.emplace_back("eval/mean_reward", evaluated_ ? last_return_ : std::nan(""));
        row.emplace_back("eval/mean_ep_length", evaluated_ ? last_length_ : std::nan(""));
        const double now =
            std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch())
                .count();
        log_.add(trainee_.steps(), elapsed(), now, row);
        if (options_.see_row) options_.see_row(trainee_.steps(), elapsed(), row);
    }

    // Shows one line on a terminal, several times a second; elsewhere a line every five seconds.
    void show(bool last) {
        if (options_.quiet || !options_.ranks.is_first()) return;
        const auto now = Clock::now();
        const bool terminal = tells_to_screen();
        if (!last && seconds_between(last_shown_, now) < (terminal ? 0.2 : 5.0)) return;
        last_shown_ = now;
        const double part = part_done(), seconds = elapsed();
        const std::string begin = fmt::format("{} {} {:3.0f} %  ", trainee_.solver,
                                              simulator_.problem->instance, 100 * part);
        std::string end;
        if (const std::string text = baselines_.text(); !text.empty()) end += "  " + text;
        if (has_best_) end += fmt::format("  best {:.6g}", best_return_);
        if (last)
            end += fmt::format("  in {}", time_text(seconds));
        else if (part > 0)
            end += fmt::format("  {} left", time_text(seconds * (1 - part) / part));
        std::string status = trainee_.status();
        // A line that the terminal breaks is not wiped by the next one.
        if (const std::size_t columns = terminal && !last ? screen_columns() : 0; columns > 0) {
            const std::size_t others = begin.size() + end.size() + 1;
            status.resize(std::min(status.size(), columns > others ? columns - others : 0));
        }
        if (terminal) tell_with_codes("\r\x1b[K");
        tell("{}{}{}{}", begin, status, end, terminal && !last ? "" : "\n");
    }

    void write(const char* name, std::string_view text) {
        UsedFiles used;
        write_file(file(name), text, used);
    }

    // The part of a checkpoint about the training itself.
    std::string state() {
        SavingArchive archive;
        archive_all(archive);
        return archive.bytes();
    }

    std::string description() const {
        const rddl_problem& problem = *simulator_.problem;
        nlohmann::ordered_json run;
        run["solver"] = trainee_.solver;
        run["domain"] = problem.domain;
        run["instance"] = problem.instance;
        run["seed"] = options_.seed;
        return json_document(run);
    }

    // The checkpoint is the last, so that it never knows more than the other files.
    void save(const std::string& state) {
        last_saved_ = Clock::now();
        const std::string learner = trainee_.save();  // of all ranks
        if (!options_.ranks.is_first()) return;
        std::filesystem::create_directories(options_.folder);
        const std::string extension = policy_extension(trainee_.solver);
        write(("policy" + extension).c_str(),
              best_policy_.empty() ? trainee_.policy_text() : best_policy_);
        write(("last" + extension).c_str(), trainee_.policy_text());
        write("run.json", description());
        write("progress.csv", log_.csv());
        write("events.out.tfevents.rddl", log_.events());
        SavingArchive archive;
        archive.append(state);
        archive(learner);
        write("checkpoint", sealed(archive.bytes()));
        remove_policies_of_others();
    }

    // An earlier run of another solver has left them. They stay until this one has files itself.
    void remove_policies_of_others() const {
        for (const char* const solver : {"cgp", "ppo"}) {
            const std::string extension = policy_extension(solver);
            if (extension == policy_extension(trainee_.solver)) continue;
            for (const char* const name : {"policy", "last"}) {
                std::error_code ignored;
                std::filesystem::remove(file((name + extension).c_str()), ignored);
            }
        }
    }

    void load() {
        const std::filesystem::path path = file("checkpoint");
        const Ranks& ranks = options_.ranks;
        if (ranks.is_first() && !is_there(path)) read_file(path);  // says so
        try {
            const std::string bytes =
                ranks.gather(ranks.is_first() ? read_sealed(path, options_.memory_limit) : "")
                    .front();
            LoadingArchive archive(bytes);
            archive_all(archive);
            std::string learner;
            archive(learner);
            trainee_.load(learner);
            // A run that goes on for longer is evaluated in the part that is new.
            evaluations_ = std::min(evaluations_, evaluations_due());
        } catch (const Failure& failure) {
            throw Failure(fmt::format("cannot resume from '{}': {}", path.string(), failure.what()),
                          failure.hint);
        }
    }

    // All that has to be as it was.
    Settings settings() const {
        Settings all = {{"--seed", std::to_string(options_.seed)},
                        {"--evaluations", std::to_string(options_.evaluations)},
                        {"--evaluation-episodes", std::to_string(options_.evaluation_episodes)}};
        for (const Settings* const some : {&options_.settings, &trainee_.settings})
            all.insert(all.end(), some->begin(), some->end());
        return all;
    }

    void archive_settings(SavingArchive& archive) const {
        archive(trainee_.solver);
        std::string text;
        for (const auto& [name, value] : settings()) text += name + "=" + value + "\n";
        archive(text);
    }
    void archive_settings(LoadingArchive& archive) const {
        std::string solver, text, others;
        archive(solver);
        if (solver != trainee_.solver)
            throw Failure(fmt::format("it is of a run of {}, and this is one of {}", solver,
                                      trainee_.solver));
        archive(text);
        for (const auto& [name, value] : settings()) {
            const std::size_t at = ("\n" + text).find("\n" + name + "=");
            if (at == std::string::npos) continue;
            const std::size_t begin = at + name.size() + 1;
            const std::string was = text.substr(begin, text.find('\n', begin) - begin);
            if (was != value)
                others += fmt::format("{}{} was {} and is {}", others.empty() ? "" : ", ", name,
                                      was, value);
        }
        if (!others.empty())
            throw Failure("it is of a run with other options: " + others,
                          "continue with the options of that run, or begin one with another --out");
    }

    template <class Archive>
    void archive_all(Archive& archive) {
        archive_settings(archive);
        double seconds = elapsed();
        archive(seconds);
        if constexpr (Archive::is_loading) seconds_before_ = seconds;
        archive(evaluated_);
        archive(evaluated_at_);
        archive(evaluations_);
        archive(last_return_);
        archive(last_length_);
        archive(has_best_);
        archive(best_return_);
        archive(best_half_width_);
        archive(best_length_);
        archive(best_policy_);
        archive(owes_evaluation_);
        log_.archive(archive);
    }

    const rddl_simulator& simulator_;
    const Trainee& trainee_;
    const TrainingOptions& options_;
    TrainingResult result_;
    RunFolder held_;
    bool made_folder_ = false, ends_by_time_ = false, saves_ = false;
    RunLog log_;
    Clock::time_point begin_ = Clock::now(), last_shown_, last_saved_;
    double seconds_before_ = 0;  // of the runs that this one resumes
    bool evaluated_ = false, has_best_ = false, owes_evaluation_ = false;
    std::int64_t evaluated_at_ = 0, evaluations_ = 0;
    double last_return_ = 0, last_length_ = 0, best_return_ = 0, best_length_ = 0;
    double best_half_width_ = 0;
    Baselines baselines_;
    std::string best_policy_;
};

}  // namespace

std::string policy_extension(std::string_view solver) {
    return solver == "cgp" ? ".cgp" : ".json";
}

std::string count_text(double count) {
    if (count >= 1e9) return fmt::format("{:.3g} G", count / 1e9);
    if (count >= 1e6) return fmt::format("{:.3g} M", count / 1e6);
    if (count >= 1e3) return fmt::format("{:.3g} k", count / 1e3);
    return fmt::format("{:.3g}", count);
}

TrainingResult train(const rddl_simulator& simulator, const Trainee& trainee,
                     const TrainingOptions& options) {
    return Training(simulator, trainee, options).run();
}

}  // namespace rddlc::solvers
