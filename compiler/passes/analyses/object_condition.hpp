// A condition of the objects of a loop, on numbers that are the same for all of them: as terms
// whose constants are known for each object.
#pragma once

#include "ir/ir.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace rddlc::passes {

struct ObjectCondition {
    enum class Form : std::uint8_t { Constant, Number, Apply, Select };
    struct Term {
        Form form;
        Operator op = {};                        // Apply
        std::vector<std::size_t> operands = {};  // Apply, Select
        std::vector<double> constants = {};  // Constant: of each object, or one; bools are 0 or 1
        std::size_t number = 0;              // Number
        int degree = 0;  // how many factors that are not constant a product has at most
        bool is_bool = false;
    };

    std::vector<Term> terms;            // operands first; the last one is the condition
    std::vector<ir::BufferId> numbers;  // buffers of one real

    // The least and the greatest of the constants of objects that are compared with a number, or
    // whose difference from it is computed. Nothing if there are none.
    std::optional<std::pair<double, double>> constants_near(std::size_t number) const;
};

// The statements are those before the store of a loop's body, which name values. Nothing if the
// condition has operators or values that are not known here.
std::optional<ObjectCondition> object_condition(const ir::Program& program,
                                                std::span<const ir::Statement> lets,
                                                ir::NodeId condition, ir::VariableId object);

}  // namespace rddlc::passes
