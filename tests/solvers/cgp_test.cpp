// CGP: programs, their formulas in all forms, and searches that depend on nothing but their
// options.
//
// Over 400 lines: a test for each thing that can be seen.
#include "simulators.hpp"
#include "solvers/batches/batch.hpp"
#include "solvers/cgp/evaluator.hpp"
#include "solvers/cgp/formula.hpp"
#include "solvers/cgp/policy_file.hpp"
#include "solvers/cgp/search.hpp"
#include "solvers/evaluation/summary.hpp"
#include "solvers/files/archive.hpp"
#include "solvers/training/run_log.hpp"
#include "support/failure.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <random>
#include <sstream>
#include <string>
#include <thread>

namespace rddlc::solvers {
namespace {

GenomeShape shape_of(int inputs, int outputs, int nodes = 30) {
    return {inputs,  3, nodes,
            outputs, 0, functions_named({"arith", "trig", "logic", "round", "unit"})};
}

TEST(Genome, HasAShape) {
    const GenomeShape shape = shape_of(2, 1, 4);
    Random random(1, 2);
    const Genome whole = random_genome(shape, random);
    EXPECT_TRUE(has_shape(whole, shape));
    const auto damaged = [&](auto change) {
        Genome genome = whole;
        change(genome);
        return !has_shape(genome, shape);
    };
    EXPECT_TRUE(damaged([](Genome& g) { g.inputs = 3; }));
    EXPECT_TRUE(damaged([](Genome& g) { g.delayed = true; }));
    EXPECT_TRUE(damaged([](Genome& g) { g.constants.pop_back(); }));
    EXPECT_TRUE(damaged([](Genome& g) { g.nodes.clear(); }));
    EXPECT_TRUE(damaged([](Genome& g) { g.outputs.push_back(0); }));
    EXPECT_TRUE(damaged([](Genome& g) { g.outputs[0] = 9; })) << "2 inputs, 3 constants, 4 nodes";
    EXPECT_TRUE(damaged([](Genome& g) { g.outputs[0] = -1; }));
    EXPECT_TRUE(damaged([](Genome& g) { g.nodes[2].arguments[1] = 7; })) << "reads itself";
    EXPECT_TRUE(damaged([](Genome& g) { g.nodes[0].function = static_cast<Function>(200); }));
}

TEST(Archive, RefusesWhatIsNoBoolAndOtherSizes) {
    SavingArchive saved;
    saved(std::uint8_t{2});
    bool value = false;
    LoadingArchive no_bool(saved.bytes());
    EXPECT_THROW(no_bool(value), Failure);
    SavingArchive longer;
    longer(std::vector<float>(5));
    std::vector<float> four(4);
    LoadingArchive other(longer.bytes());
    EXPECT_THROW(other.fixed(four), Failure);
}

TEST(RunLog, RefusesWhatIsNoLog) {
    const auto refused = [](const std::string& columns, const std::vector<double>& numbers) {
        SavingArchive saved;
        saved(columns);
        saved(numbers);
        LoadingArchive archive(saved.bytes());
        RunLog log;
        try {
            log.archive(archive);
        } catch (const Failure&) {
            return true;
        }
        return false;
    };
    EXPECT_FALSE(refused("loss\n", {1.5, 2000, 0.5, -3}));
    EXPECT_TRUE(refused("loss\n", {1.5, 2000, 0.5})) << "a row without its loss";
    EXPECT_TRUE(refused("loss", {1.5, 2000, 0.5})) << "a column whose name has no end";
    for (const double steps : {8e264, -1.0, 0.5, std::nan("")})
        EXPECT_TRUE(refused("loss\n", {1.5, steps, 0.5, -3})) << steps;
}

std::vector<double> run(const Program& program, const std::vector<double>& inputs,
                        std::size_t outputs) {
    std::vector<double> values(static_cast<std::size_t>(program.slots()) + 1), results(outputs);
    program.run(1, inputs.data(), 1, values.data(), results.data());
    return results;
}

std::vector<std::vector<double>> random_inputs(int count, int size) {
    std::mt19937 random(7);
    std::normal_distribution<double> normal(0, 2);
    std::vector<std::vector<double>> all;
    for (int i = 0; i < count; ++i) {
        std::vector<double> inputs;
        for (int k = 0; k < size; ++k) inputs.push_back(random() % 8 ? normal(random) : 0);
        all.push_back(inputs);
    }
    return all;
}

TEST(Cgp, FunctionsAreTotal) {
    const double numbers[] = {0, -0.0, 1, -1, 0.5, -2.5, 1e-12, 1e6, -1e6, 700};
    for (int f = 0; f < function_count; ++f)
        for (const double a : numbers)
            for (const double b : numbers)
                for (const double c : numbers) {
                    const double x = apply(static_cast<Function>(f), a, b, c);
                    EXPECT_LE(std::abs(x), largest_result)
                        << info_of(static_cast<Function>(f)).name;
                }
}

TEST(Cgp, LanesComputeWhatOneDoes) {
    Random random(3, 0);
    const auto inputs = random_inputs(16, 4);
    for (int round = 0; round < 200; ++round) {
        const Program program(random_genome(shape_of(4, 2), random));
        std::vector<double> rows(4 * 16),
            values(static_cast<std::size_t>(program.slots() * 16) + 1), results(2 * 16);
        for (std::size_t lane = 0; lane < 16; ++lane)
            for (std::size_t i = 0; i < 4; ++i) rows[i * 16 + lane] = inputs[lane][i];
        program.run(16, rows.data(), 16, values.data(), results.data());
        for (std::size_t lane = 0; lane < 16; ++lane) {
            const auto alone = run(program, inputs[lane], 2);
            EXPECT_EQ(results[lane], alone[0]);
            EXPECT_EQ(results[16 + lane], alone[1]);
        }
    }
}

TEST(Cgp, SimplifiedFormulasHaveTheSameValues) {
    Random random(4, 0);
    int smaller = 0;
    for (int round = 0; round < 1000; ++round) {
        const Genome genome = random_genome(shape_of(3, 2), random);
        const Program program(genome);
        const Formula formula = simplified(genome);
        smaller += formula.size() < activity_of(genome).nodes;
        for (const auto& inputs : random_inputs(20, 3)) {
            const auto expected = run(program, inputs, 2), found = formula.evaluate(inputs);
            for (std::size_t o = 0; o < 2; ++o)
                EXPECT_NEAR(found[o], expected[o], 1e-9 * std::max(1.0, std::abs(expected[o])));
        }
    }
    EXPECT_GT(smaller, 300);
}

// Half of a choice is not the same as a choice of halves.
TEST(Cgp, FormulasHaveBracketsWhereAChoiceIsAnArgument) {
    using Term = Formula::Term;
    const ProgramScope scope =
        program_scope(*rddl_simulator_mountain_car_mountain_car_1(), Lifting::Auto, false, 0);
    Formula formula;
    formula.terms.push_back(Term{Term::Kind::Constant, 0, 2.0, Function::Zero, {-1, -1, -1}});
    formula.terms.push_back(Term{Term::Kind::Constant, 0, 3.0, Function::Zero, {-1, -1, -1}});
    formula.terms.push_back(Term{Term::Kind::Function, 0, 0, Function::If, {0, 1, 0}});
    formula.terms.push_back(Term{Term::Kind::Function, 0, 0, Function::Half, {2, -1, -1}});
    formula.outputs = {3};
    EXPECT_NE(formula_text(formula, scope).find("= (if 2 > 0 then 3 else 2) / 2"),
              std::string::npos);
}

// Reads formulas as people do: the value, and a text that shows how it was understood.
class FormulaReader {
  public:
    struct Part {
        double value;
        std::string tree;
    };
    FormulaReader(std::string text, std::map<std::string, double> names)
        : text_(std::move(text)), names_(std::move(names)) {}

    // Nothing if it is not a formula.
    std::optional<Part> read() {
        at_ = 0;
        good_ = true;
        const Part all = choice();
        return good_ && at_ == text_.size() ? std::optional(all) : std::nullopt;
    }

  private:
    bool take(const std::string& word) {
        if (!text_.substr(at_).starts_with(word)) return false;
        at_ += word.size();
        return true;
    }
    void need(const std::string& word) { good_ = good_ && take(word); }

    static Part call(Function function, const Part& a, const Part& b = {}, const Part& c = {}) {
        return {apply(function, a.value, b.value, c.value),
                fmt::format("{}[{};{};{}]", info_of(function).name, a.tree, b.tree, c.tree)};
    }
    // Operators that bind alike, from left to right; those of and, or may be understood in any
    // order.
    using Operators = std::vector<std::pair<std::string, Function>>;
    Part row(const Operators& operators, Part (FormulaReader::*next)()) {
        Part all = (this->*next)();
        const auto is_next = [this](const auto& each) {
            return take(each.first);
        };
        for (;;) {
            const auto found = std::ranges::find_if(operators, is_next);
            if (found == operators.end()) return all;
            all = call(found->second, all, (this->*next)());
        }
    }

    Part choice() {
        if (!take("if ")) return either();
        const Part condition = sum();
        need(" > 0 then ");
        const Part yes = either();
        need(" else ");
        return call(Function::If, condition, yes, choice());
    }
    Part either() { return row({{" or ", Function::Or}}, &FormulaReader::both); }
    Part both() { return row({{" and ", Function::And}}, &FormulaReader::negation); }
    Part negation() { return take("not ") ? call(Function::Not, atom()) : comparison(); }
    Part comparison() {
        const Part a = sum();
        return text_.substr(at_).starts_with(" > 0 then ") || !take(" > ")
                   ? a
                   : call(Function::Greater, a, sum());
    }
    Part sum() {
        return row({{" + ", Function::Add}, {" - ", Function::Subtract}}, &FormulaReader::product);
    }
    Part product() {
        return row({{" * ", Function::Multiply}, {" / ", Function::Divide}},
                   &FormulaReader::signed_power);
    }
    Part signed_power() { return take("-") ? call(Function::Negate, power()) : power(); }
    Part power() {
        const Part base = atom();
        return take("^2") ? call(Function::Square, base) : base;
    }
    Part atom() {
        if (take("(")) {
            const Part part = choice();
            need(")");
            return part;
        }
        std::size_t end = at_;
        while (end < text_.size() && (std::isalnum(static_cast<unsigned char>(text_[end])) ||
                                      text_[end] == '.' || text_[end] == '_'))
            ++end;
        const std::string word = text_.substr(at_, end - at_);
        good_ = good_ && !word.empty();
        at_ = end;
        if (take("(")) return called(word);
        if (const auto known = names_.find(word); known != names_.end())
            return {known->second, word};
        good_ = good_ && !word.empty() && std::isdigit(static_cast<unsigned char>(word[0]));
        return {good_ ? std::stod(word) : 0, word};
    }
    Part called(const std::string& word) {
        const auto function = function_named(word);
        good_ = good_ && function;
        if (!good_) return {};
        if (take(")")) return call(*function, {});
        const Part a = choice();
        const Part b = take(", ") ? choice() : Part{};
        need(")");
        return call(*function, a, b);
    }

    std::string text_;
    std::map<std::string, double> names_;
    std::size_t at_ = 0;
    bool good_ = true;
};

// The formula is another one without one pair of brackets, those of a function's arguments left
// out.
void expect_no_bracket_too_many(const std::string& text,
                                const std::map<std::string, double>& names) {
    const std::string tree = FormulaReader(text, names).read()->tree;
    std::vector<std::size_t> open;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] == '(') open.push_back(i);
        if (text[i] != ')') continue;
        const std::size_t begin = open.back();
        open.pop_back();
        if (begin > 0 && std::isalnum(static_cast<unsigned char>(text[begin - 1]))) continue;
        std::string without = text;
        without.erase(i, 1).erase(begin, 1);
        const auto read = FormulaReader(without, names).read();
        EXPECT_FALSE(read && read->tree == tree) << text << "\n" << without;
    }
}

TEST(Cgp, PeopleReadInFormulasWhatTheyCompute) {
    ProgramScope scope;
    for (const auto& [shift, scale] : {std::pair{0.0, 1.0}, {0.5, 1.0}, {-2.0, 0.25}, {0.0, 4.0}}) {
        ProgramInput& input = scope.inputs.emplace_back();
        input.name = fmt::format("x{}", scope.inputs.size());
        input.shift = shift;
        input.scale = scale;
    }
    scope.outputs = {"a", "b"};
    const GenomeShape shape{4, 3, 25, 2, 0, default_functions()};
    Random random(11, 0);
    int brackets = 0;
    for (int g = 0; g < 3000; ++g) {
        Genome genome = random_genome(shape, random);
        for (double& constant : genome.constants)  // of few digits
            constant = std::round(constant * 8) / 8;
        const Formula formula = simplified(genome);
        std::map<std::string, double> names;
        std::vector<double> inputs;
        for (const ProgramInput& input : scope.inputs) {
            const double value = std::round(random.normal() * 16) / 16;
            names[input.name] = value;
            inputs.push_back((value - input.shift) * input.scale);
        }
        const std::vector<double> values = formula.evaluate(inputs);
        std::istringstream lines(formula_text(formula, scope));
        std::size_t output = 0;
        for (std::string line; std::getline(lines, line);) {
            const std::size_t equals = line.find(" = ");
            const std::string text = line.substr(equals + 3, line.find("   [") - equals - 3);
            const auto read = FormulaReader(text, names).read();
            ASSERT_TRUE(read) << line;
            expect_no_bracket_too_many(text, names);
            brackets += static_cast<int>(std::ranges::count(text, '('));
            const std::string name = line.substr(0, equals);
            if (name.starts_with("v"))
                names[name] = read->value;
            else
                EXPECT_NEAR(read->value, values[output++],
                            1e-4 * std::max(1.0, std::abs(read->value)))
                    << line;
        }
        EXPECT_EQ(output, 2u);
    }
    EXPECT_GT(brackets, 1000);
}

// The levels of all first states are the same: only steps show how far they spread.
TEST(Cgp, ScalesInputsByTheStatesOfRandomSteps) {
    const ProgramScope scope =
        program_scope(*rddl_simulator_reservoir_reservoir_1(), Lifting::Auto, false, 0);
    int scaled = 0;
    for (const ProgramInput& input : scope.inputs) scaled += !input.is_known && input.scale != 1;
    EXPECT_GT(scaled, 0);
}

// The C++ of rddl export is compiled.
TEST(Cgp, CompiledFormulasHaveTheSameValues) {
    const ProgramScope scope =
        program_scope(*rddl_simulator_mountain_car_mountain_car_1(), Lifting::Auto, false, 0);
    Random random(5, 0);
    const auto folder = std::filesystem::temp_directory_path() / "rddl_cgp_test";
    std::filesystem::create_directories(folder);
    std::vector<Genome> genomes;
    std::ofstream main(folder / "main.cpp");
    for (int g = 0; g < 10; ++g) {
        genomes.push_back(
            random_genome(shape_of(scope.input_count(), scope.output_count()), random));
        // GCC takes files of the same text for the same file.
        std::string text = formula_cpp(simplified(genomes.back()), scope);
        text.erase(text.find("#pragma once"), 12);
        std::ofstream(folder / ("policy" + std::to_string(g) + ".hpp")) << text;
        main << "namespace p" << g << " {\n#include \"policy" << g << ".hpp\"\n}\n";
    }
    const auto inputs = random_inputs(20, scope.input_count());
    main << "#include <cstdio>\nint main() {\n    double x[2], y[1];\n";
    for (int g = 0; g < 10; ++g)
        for (const auto& x : inputs) {
            main.precision(17);
            main << "    x[0] = " << x[0] << "; x[1] = " << x[1] << "; p" << g
                 << "::policy::act(x, y); std::printf(\"%.17g\\n\", y[0]);\n";
        }
    main << "}\n";
    main.close();
    // <cmath> comes first, so that it is not within a namespace.
    const std::string command =
        std::string(TEST_CXX) + " -std=c++17 -include cmath -O0 -ffp-contract=off -o " +
        (folder / "program").string() + " " + (folder / "main.cpp").string() + " && " +
        (folder / "program").string() + " > " + (folder / "out").string();
    ASSERT_EQ(std::system(command.c_str()), 0);
    std::ifstream out(folder / "out");
    for (const Genome& genome : genomes)
        for (const auto& x : inputs) {
            std::vector<double> scaled;
            for (std::size_t i = 0; i < x.size(); ++i)
                scaled.push_back((x[i] - scope.inputs[i].shift) * scope.inputs[i].scale);
            const double expected = run(Program(genome), scaled, 1)[0];
            double found = 0;
            ASSERT_TRUE(out >> found);
            EXPECT_NEAR(found, expected, 1e-9 * std::max(1.0, std::abs(expected)));
        }
}

TEST(Cgp, MutationsOfOneGeneChangeThePhenotype) {
    Random random(6, 0);
    const GenomeShape shape = shape_of(3, 2, 100);
    Genome genome = random_genome(shape, random);
    int same = 0;
    for (int round = 0; round < 500; ++round) {
        const std::uint64_t before = Program(genome).hash();
        mutate(genome, shape, Mutation::Single, activity_of(genome), random);
        same += Program(genome).hash() == before;
    }
    EXPECT_LT(same, 25);  // an argument may change for one that computes the same
}

CgpOptions small_search() {
    CgpOptions options;
    options.children = 6;
    options.episodes = 4;
    options.nodes = 30;
    options.islands = 2;
    options.migrate_every = 3;
    options.tune_every = 4;
    options.seed = 8;
    return options;
}

// Somebody has changed some bytes, and the checksum of the file with them: what is taken is a
// program.
TEST(Cgp, ChangedCheckpointsAreRefusedOrRun) {
    const rddl_simulator& car = *rddl_simulator_mountain_car_mountain_car_1();
    CgpSearch search(car, small_search());
    search.run(5);
    const std::string bytes = search.save();
    int refused = 0, ran = 0;
    for (std::size_t at = 0; at < bytes.size(); at += 1 + bytes.size() / 150) {
        for (const char byte : {'\x7f', '\xff'}) {
            std::string changed = bytes;
            changed[at] = byte;
            CgpSearch other(car, small_search());
            try {
                other.load(changed);
                other.run(1);
                ++ran;
            } catch (const Failure&) {
                ++refused;
            }
        }
    }
    EXPECT_GT(refused, 20);
    EXPECT_GT(ran, 0);
}

TEST(Cgp, ThreadsDoNotMatter) {
    for (const rddl_simulator* simulator : simulators()) {
        SCOPED_TRACE(simulator->problem->domain);
        CgpOptions options = small_search();
        CgpSearch alone(*simulator, options);
        options.threads = 2;
        CgpSearch together(*simulator, options);
        alone.run(8);
        together.run(8);
        EXPECT_EQ(alone.progress().evaluations, together.progress().evaluations);
        EXPECT_EQ(program_text(*simulator, alone.scope(), alone.best()),
                  program_text(*simulator, together.scope(), together.best()));
    }
}

TEST(Cgp, GoesOnAsIfItHadNotStopped) {
    for (const rddl_simulator* simulator : simulators()) {
        SCOPED_TRACE(simulator->problem->domain);
        CgpSearch whole(*simulator, small_search()), first(*simulator, small_search()),
            second(*simulator, small_search());
        whole.run(10);
        first.run(5);
        second.load(first.save());
        second.run(5);
        EXPECT_EQ(program_text(*simulator, whole.scope(), whole.best()),
                  program_text(*simulator, second.scope(), second.best()));
    }
}

// Its sentence, from whatever thread it is.
TEST(Cgp, TellsWhichCallTheSimulatorRefuses) {
    static const std::thread::id caller = std::this_thread::get_id();
    rddl_simulator simulator = *rddl_simulator_mountain_car_mountain_car_1();
    CgpOptions options = small_search();
    options.threads = 2;
    CgpSearch search(simulator, options);
    simulator.reset = [](rddl_batch* batch, const std::uint8_t* mask, void* observations) {
        const auto reset = rddl_simulator_mountain_car_mountain_car_1()->reset;
        if (std::this_thread::get_id() == caller) {
            std::this_thread::sleep_for(std::chrono::milliseconds(1));  // others also work
            return reset(batch, mask, observations);
        }
        return rddl_error{RDDL_BAD_ARGUMENT};
    };
    simulator.last_error = [](const rddl_simulator*) {
        return "the simulator's sentence";
    };
    try {
        search.run(50);
        FAIL() << "nothing was thrown";
    } catch (const Failure& failure) {
        EXPECT_STREQ(failure.what(), "the simulator's sentence");
    }
}

// The test steps by itself, with the first output of the program: full throttle to the right, or no
// throttle.
TEST(Cgp, MeasuresHowWidelyObservationsVary) {
    const rddl_simulator& simulator = *rddl_simulator_mountain_car_mountain_car_1();
    const ProgramScope scope = program_scope(simulator, Lifting::Auto, false, 0);
    std::vector<Program> programs;
    for (const Function function : {Function::One, Function::Zero})
        programs.emplace_back(
            Genome{scope.input_count(), {}, {Node{function, {}}}, {scope.input_count()}});
    const Program* const pointers[] = {&programs[0], &programs[1]};
    Evaluator evaluator(simulator, scope, 2, 1);
    const std::uint64_t seed = 0;
    double returns[2], lengths[2], reach[2];
    evaluator.evaluate(pointers, {&seed, 1}, returns, lengths, reach);
    for (const int p : {0, 1}) {
        rddl_batch_options options{};
        options.environment_count = 1;
        const BatchHandle batch = create_batch(simulator, options);
        require_done(simulator, simulator.reset(batch.get(), nullptr, nullptr));
        double first[2], least[2], most[2], values[2];
        require_done(simulator, simulator.get_observation_values(batch.get(), RDDL_DOUBLE, values));
        std::copy_n(values, 2, first);
        std::copy_n(values, 2, least);
        std::copy_n(values, 2, most);
        const double action = p == 0 ? 1 : 0;
        rddl_transition out{};
        for (int step = 0; step < static_cast<int>(lengths[p]); ++step) {
            require_done(simulator,
                         simulator.step_values(batch.get(), RDDL_DOUBLE, &action, values, &out));
            for (const int c : {0, 1}) {
                least[c] = std::min(least[c], values[c]);
                most[c] = std::max(most[c], values[c]);
            }
        }
        // Its values have no bounds.
        double expected = 0;
        for (const int c : {0, 1})
            expected += std::log1p((most[c] - least[c]) / (1 + std::abs(first[c])));
        EXPECT_NEAR(reach[p], expected, 1e-5) << p;
    }
    EXPECT_GT(reach[0], reach[1]);
}

// Programs that see more stay while all have the same return.
TEST(Cgp, LooksAroundWhereNothingIsEarned) {
    rddl_simulator simulator = *rddl_simulator_mountain_car_mountain_car_1();
    simulator.step_values = [](rddl_batch* batch, rddl_number number, const void* actions,
                               void* observations, const rddl_transition* out) {
        const rddl_error error = rddl_simulator_mountain_car_mountain_car_1()->step_values(
            batch, number, actions, observations, out);
        for (int i = 0; i < 32; ++i) out->rewards[i] = 0;
        return error;
    };
    CgpOptions options;
    options.restart_after = 0;
    CgpSearch search(simulator, options);
    search.run(60);
    EXPECT_EQ(search.progress().best.value, 0);
    // The end of the episode ends a search for more: fewer steps are better than all that is seen.
    EXPECT_LT(search.progress().best.steps, 200);
}

TEST(Cgp, FindsFormulasThatDriveUphill) {
    const rddl_simulator& simulator = *rddl_simulator_mountain_car_mountain_car_1();
    for (std::uint64_t seed = 0; seed < 5; ++seed) {
        CgpOptions options;
        options.seed = seed;
        CgpSearch search(simulator, options);
        search.run(60);
        const auto found =
            std::make_shared<FoundProgram>(FoundProgram{search.scope(), search.best()});
        const Summary summary =
            summary_of(run_episodes(simulator, program_policy(simulator, found, "cgp"), {}, {}));
        EXPECT_EQ(summary.undiscounted_return.mean, search.progress().best.value);
        EXPECT_EQ(summary.length.mean, search.progress().best.steps);
        EXPECT_GT(summary.undiscounted_return.mean, 80) << seed;
    }
}

// One program for all objects acts in every instance of its domain.
TEST(Cgp, LiftedProgramsAreReadForOtherInstances) {
    const rddl_simulator& network = *rddl_simulator_network_network_1();
    CgpSearch search(network, small_search());
    EXPECT_TRUE(search.scope().lifted);
    const std::string text = program_text(network, search.scope(), search.best());
    EXPECT_EQ(program_text(network, read_program(network, text)->scope,
                           read_program(network, text)->genome),
              text);
    std::string other = text;
    other.replace(other.find("network_1"), 9, "network_2");
    EXPECT_NO_THROW(read_program(network, other));
    EXPECT_THROW(read_program(*rddl_simulator_reservoir_reservoir_1(), text), Failure);
}

TEST(Cgp, RefusesWhatIsNoProgram) {
    const rddl_simulator& car = *rddl_simulator_mountain_car_mountain_car_1();
    CgpSearch search(car, small_search());
    const std::string text = program_text(car, search.scope(), search.best());
    for (const std::size_t size : {std::size_t{0}, text.size() / 3, text.size() - 5})
        EXPECT_THROW(read_program(car, text.substr(0, size)), Failure) << size;
    std::string newer = text;
    newer.replace(0, 10, "rddl-cgp 7");
    EXPECT_THROW(read_program(car, newer), Failure);
    std::string forward = text;  // a node that reads a later one
    const std::size_t node = forward.find("node ") + 5;
    forward.replace(node, forward.find('\n', node) - node, "add 33 34 35");
    EXPECT_THROW(read_program(car, forward), Failure);
}

}  // namespace
}  // namespace rddlc::solvers
