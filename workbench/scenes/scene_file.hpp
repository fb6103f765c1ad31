// A scene file: which shapes to draw for which fluents and objects (docs/scenes.md). Here it is
// read; its expressions are text still.
#pragma once

#include "support/source.hpp"

#include <render/shapes.hpp>

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace rddlc::workbench {

// "?b" of type "basin".
struct SceneVariable {
    std::string name;  // without "?"
    std::string type;
    Span span;
};

// The type that an expression must have. Texts show bools, numbers and objects.
enum class SceneRange { Bool, Real, Shown };

// RDDL in the file, over the variables of its shape.
struct SceneExpression {
    Span span, member;  // `member` is the name of the member of the shape that it is of
    SceneRange range;
    std::vector<SceneVariable> variables;
};

// The index in Scene::expressions.
using ExpressionIndex = std::size_t;

using SceneNumber = std::variant<double, ExpressionIndex>;

// So many take the compiler a second or two.
inline constexpr std::size_t most_scene_expressions = 1000;

struct SceneColor;
struct SceneColorChoice {
    ExpressionIndex condition;
    std::shared_ptr<const SceneColor> then_color, else_color;
};
// A scale from light to dark between two values.
struct SceneColorScale {
    SceneNumber value, low, high;
};
struct SceneColor {
    std::variant<rddl::render::Color, SceneColorChoice, SceneColorScale> value;
};

// Pieces of a text: "level of ", ?b, ": ", a value.
struct SceneVariableName {
    std::size_t variable;  // of the shape
};
using SceneText = std::vector<std::variant<std::string, SceneVariableName, ExpressionIndex>>;

struct SceneShape {
    rddl::render::Shape::Kind kind;
    std::vector<SceneVariable> variables;  // one shape for each tuple of their objects
    std::vector<SceneNumber> numbers;      // x, y of each point
    SceneNumber radius = 0.0, size = 12.0, thickness = 2.0;
    bool outline = false;
    rddl::render::Align align = rddl::render::Align::Center;
    SceneColor color;
    std::optional<ExpressionIndex> visible;
    SceneText text;
};

struct Scene {
    std::vector<SceneExpression> expressions;
    SceneNumber left = 0.0, bottom = 0.0, right = 1.0, top = 1.0;  // of the world that is shown
    std::vector<SceneShape> shapes;
};

// Throws a Failure that names the line if the text is not JSON or not a scene. `file` is that of
// the spans.
Scene read_scene(const Source& source, FileId file);

}  // namespace rddlc::workbench
