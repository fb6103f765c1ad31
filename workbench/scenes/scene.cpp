#include "scenes/scene.hpp"

#include "scenes/scene_program.hpp"
#include "support/failure.hpp"
#include "support/match.hpp"
#include "terminal/interrupt.hpp"

#include <fmt/format.h>
#include <render/shapes.hpp>

#include <memory>
#include <vector>

namespace rddlc::workbench {

namespace render = rddl::render;

namespace {

// A bool expression within one over more variables has the same groundings: those of its shape.
render::Color color_of(const SceneProgram& program, const SceneColor& color,
                       std::size_t grounding) {
    return match(
        color.value, [](const render::Color& plain) { return plain; },
        [&](const SceneColorChoice& choice) {
            const bool holds = program.value(choice.condition, grounding) != 0;
            return color_of(program, holds ? *choice.then_color : *choice.else_color, grounding);
        },
        [&](const SceneColorScale& scale) {
            const double low = program.value(scale.low, grounding);
            const double high = program.value(scale.high, grounding);
            const double value = program.value(scale.value, grounding);
            return render::sequential_color(high > low ? (value - low) / (high - low) : 0.5);
        });
}

std::string object_name(const SceneProgram& program, const SceneShape& shape, std::size_t variable,
                        std::size_t grounding) {
    for (std::size_t v = shape.variables.size(); v-- > variable + 1;)
        grounding /= program.objects_of(shape.variables[v].type).size();
    const auto& objects = program.objects_of(shape.variables[variable].type);
    return objects[grounding % objects.size()];
}

std::string text_of(const SceneProgram& program, const SceneShape& shape, std::size_t grounding) {
    std::string text;
    for (const auto& piece : shape.text)
        text += match(
            piece, [](const std::string& plain) { return plain; },
            [&](const SceneVariableName& name) {
                return object_name(program, shape, name.variable, grounding);
            },
            [&](ExpressionIndex shown) { return program.shown(shown, grounding); });
    return text;
}

render::Shape shape_of(const SceneProgram& program, const SceneShape& shape,
                       std::size_t grounding) {
    render::Shape result;
    result.kind = shape.kind;
    for (std::size_t i = 0; i + 1 < shape.numbers.size(); i += 2)
        result.points.push_back({program.value(shape.numbers[i], grounding),
                                 program.value(shape.numbers[i + 1], grounding)});
    // A cell is the square of its column and row, with a little room between neighbours.
    if (shape.kind == render::Shape::Kind::Rectangle && result.points.size() == 1) {
        const render::Point at = result.points[0];
        result.points = {{at.x + 0.03, at.y + 0.03}, {at.x + 0.97, at.y + 0.97}};
    }
    result.radius = program.value(shape.radius, grounding);
    result.size = program.value(shape.size, grounding);
    result.thickness = program.value(shape.thickness, grounding);
    result.outline = shape.outline;
    result.align = shape.align;
    result.color = color_of(program, shape.color, grounding);
    result.text = text_of(program, shape, grounding);
    return result;
}

void draw(SceneProgram& program, render::Canvas& canvas, const render::Box& area,
          const render::Snapshot& snapshot) {
    const render::Step& now = snapshot.now();
    const auto* const action =
        snapshot.acts() ? now.action.data()
                        : static_cast<const std::byte*>(snapshot.problem().default_action);
    program.evaluate(now.state.data(), action);
    const Scene& scene = program.scene();
    std::vector<render::Shape> shapes;
    for (const SceneShape& shape : scene.shapes) {
        give_up_if_interrupted("drawing");
        std::size_t groundings = 1;
        for (const SceneVariable& variable : shape.variables)
            groundings *= program.objects_of(variable.type).size();
        for (std::size_t g = 0; g < groundings; ++g)
            if (!shape.visible || program.value(*shape.visible, g) != 0)
                shapes.push_back(shape_of(program, shape, g));
    }
    const double left = program.value(scene.left, 0), right = program.value(scene.right, 0);
    const double bottom = program.value(scene.bottom, 0), top = program.value(scene.top, 0);
    if (left >= right || bottom >= top)
        throw Failure(fmt::format("there is nothing to see of the scene's world: left {}, right "
                                  "{}, bottom {}, top {}",
                                  left, right, bottom, top),
                      "'world' has its left before its right, and its bottom below its top");
    render::draw_shapes(canvas, area, {left, bottom, right - left, top - bottom}, shapes);
}

}  // namespace

render::Visualizer scene_visualizer(const ProblemFiles& files,
                                    const std::filesystem::path& scene_file) {
    const auto program = std::make_shared<SceneProgram>(files, scene_file);
    return {"scene",
            "a scene file",
            {},
            {},
            [program](render::Canvas& canvas, const render::Box& area,
                      const render::Snapshot& snapshot) {
                draw(*program, canvas, area, snapshot);
            }};
}

}  // namespace rddlc::workbench
