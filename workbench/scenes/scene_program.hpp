// The expressions of a scene, as interm-fluents of the problem: so the compiler's own parser and
// checker read them, and its interpreter computes them.
#pragma once

#include "engines/interpreted_details.hpp"
#include "model/model.hpp"
#include "problems/problem_lookup.hpp"
#include "scenes/scene_file.hpp"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace rddlc::workbench {

class SceneProgram {
  public:
    // Prints the diagnostics and throws Diagnosed if the scene or the problem has errors.
    SceneProgram(const ProblemFiles& files, const std::filesystem::path& scene_file);

    const Scene& scene() const { return scene_; }
    // The objects of a variable's type, in the order of the problem.
    const std::vector<std::string>& objects_of(const std::string& type) const;

    // Records of the problem; then values can be asked for.
    void evaluate(const std::byte* state, const std::byte* action);
    // `grounding` counts the tuples of the objects of the shape's variables, the last one fastest.
    double value(ExpressionIndex expression, std::size_t grounding) const;
    double value(const SceneNumber& number, std::size_t grounding) const;
    // The value as a text shows it: "true", "3.5", the name of an object.
    std::string shown(ExpressionIndex expression, std::size_t grounding) const;

  private:
    // The place of an expression's values in the record, and their type.
    struct Result {
        std::size_t offset;
        model::ValueType range;
        bool is_truth;  // a bool, be it kept as a number
    };
    void find_results(const model::Model& model);

    Scene scene_;
    std::vector<std::pair<std::string, std::vector<std::string>>> objects_;  // by type
    std::unique_ptr<InterpretedDetails> details_;
    std::vector<Result> results_;  // of expressions
    std::vector<std::byte> scratch_, record_;
};

}  // namespace rddlc::workbench
