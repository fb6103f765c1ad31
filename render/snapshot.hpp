// The input of a visualizer: an episode up to a state, by the names of fluents, as numbers.
#pragma once

#include "render/picture.hpp"

#include <rddl/simulator.h>

#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace rddl::render {

// The values of a fluent, row-major over its parameters' objects: bools are 0 and 1, objects their
// index.
struct Values {
    const rddl_problem* problem = nullptr;
    const rddl_fluent* fluent = nullptr;
    std::vector<double> numbers;

    int count(int parameter) const;  // of objects
    // The name of an object of a parameter's type.
    const char* object(int parameter, int index) const;
    // The type of a value that is an object; otherwise NULL.
    const rddl_type* range() const;

    // One index for each parameter.
    template <class... Index>
    double operator()(Index... index) const {
        std::size_t place = 0;
        int parameter = 0;
        ((place = place * static_cast<std::size_t>(count(parameter++)) +
                  static_cast<std::size_t>(index)),
         ...);
        return numbers[place];
    }
    template <class... Index>
    bool is(Index... index) const {
        return (*this)(index...) != 0;
    }
};

// A problem, and what its instance fixes.
class World {
  public:
    // `simulator` must outlive it.
    explicit World(const rddl_simulator& simulator);

    const rddl_simulator& simulator() const { return simulator_; }
    const rddl_problem& problem() const { return *simulator_.problem; }
    // The first fluent of "pos|position" that exists: domains name the same thing differently, and
    // all look-ups by name accept such lists. NULL: no such fluent.
    const rddl_fluent* find(std::string_view names) const;
    // The values of a non-fluent, read once.
    const Values& constant(const rddl_fluent& fluent) const;
    // "rlevel(t1)"
    std::string name_of(const rddl_fluent& fluent, std::int64_t grounding) const;

  private:
    const rddl_simulator& simulator_;
    std::unordered_map<std::string_view, const rddl_fluent*> fluent_named_;
    mutable std::unordered_map<const rddl_fluent*, Values> constants_;
};

// A state of an episode, the action that was taken in it, and what came of that.
struct Step {
    std::int64_t number = 0;        // steps made before
    std::vector<std::byte> state;   // a record
    std::vector<std::byte> action;  // a record; empty: the episode ended here
    double reward = 0;              // of the action
    double total = 0;               // rewards of the steps before
    std::string end;                // why the episode ended here: "terminated", "horizon", ...
};

// A longer episode remembers only its last states.
inline constexpr std::size_t most_steps_remembered = 1000;

class Snapshot {
  public:
    // The last step is now. `horizon` is 0 if it is unknown. World and steps must outlive it.
    Snapshot(const World& world, const std::deque<Step>& steps, std::int64_t episode,
             std::int64_t horizon)
        : world_(world), steps_(steps), episode_(episode), horizon_(horizon) {}

    const World& world() const { return world_; }
    const rddl_problem& problem() const { return world_.problem(); }
    const std::deque<Step>& steps() const { return steps_; }
    const Step& now() const { return steps_.back(); }
    std::int64_t episode() const { return episode_; }
    std::int64_t horizon() const { return horizon_; }
    bool acts() const { return !now().action.empty(); }

    bool has(std::string_view name) const { return world_.find(name) != nullptr; }
    // The values of a non-fluent, a state-fluent or an action-fluent; throws Error if no fluent has
    // the name. An action that is not taken, at an episode's end, has its default.
    const Values& operator[](std::string_view name) const;
    const Values& values(const rddl_fluent& fluent) const;
    // The only value of a fluent without parameters.
    double number(std::string_view name) const { return (*this)[name].numbers.at(0); }
    double number_or(std::string_view name, double otherwise) const {
        return has(name) ? number(name) : otherwise;
    }
    // The values of a state- or action-fluent in one of steps().
    Values values_in(const Step& step, const rddl_fluent& fluent) const;
    double number_in(const Step& step, std::string_view name, std::size_t grounding = 0) const;

    // The default of an action-fluent.
    double default_of(std::string_view name, std::size_t grounding = 0) const;

  private:
    const World& world_;
    const std::deque<Step>& steps_;
    std::int64_t episode_, horizon_;
    mutable std::unordered_map<const rddl_fluent*, std::unique_ptr<Values>> read_;
};

// The value as text: "true", "12", "0.25", the name of an object.
std::string value_text(const Values& values, std::size_t grounding);
// A number with so many digits at most, in whatever locale the program is: applications set one.
std::string rounded_text(double value, int digits);
// A number with about four digits.
std::string number_text(double value);

}  // namespace rddl::render
