#include "scenes/scene_file.hpp"

#include "support/diagnostic.hpp"
#include "support/failure.hpp"
#include "support/json_text.hpp"
#include "support/suggestion.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cctype>
#include <unordered_map>

namespace rddlc::workbench {

namespace {

using Json = nlohmann::ordered_json;
namespace render = rddl::render;

// The bytes between the quotation marks of each text in the file, in their order.
std::vector<Span> texts_of(const std::string& text, FileId file) {
    std::vector<Span> spans;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] != '"') continue;
        const std::size_t begin = i + 1;
        for (++i; i < text.size() && text[i] != '"'; ++i)
            if (text[i] == '\\') ++i;
        spans.push_back({file, static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(i)});
    }
    return spans;
}

class SceneReader {
  public:
    SceneReader(const Source& source, FileId file)
        : source_(source), texts_(texts_of(source.text(), file)), file_(file) {}

    Scene read() {
        const Json scene = parse();
        locate(scene);
        if (!scene.is_object()) fail(whole(), "a scene is a JSON object");
        allow(scene, whole(), {"world", "shapes", "about"});
        if (scene.contains("world")) read_world(scene["world"]);
        if (!scene.contains("shapes") || !scene["shapes"].is_array())
            fail(whole(), "a scene has an array 'shapes'");
        for (const Json& shape : scene["shapes"]) scene_.shapes.push_back(read_shape(shape));
        return std::move(scene_);
    }

  private:
    Json parse() {
        try {
            return parse_ordered_json(source_.text());
        } catch (const RefusedJson& refused) {
            if (!refused.byte) fail(whole(), refused.what());
            const auto at = static_cast<std::uint32_t>(*refused.byte);
            fail({file_, at, at}, "this is not JSON",
                 "JSON has names and texts in double quotes, no comments, and no comma before a "
                 "bracket that closes");
        }
    }

    // Locates each value that is a text, and each object by its first member.
    void locate(const Json& value) {
        if (value.is_string()) place_[&value] = texts_[next_++];
        if (value.is_array())
            for (const Json& element : value) locate(element);
        if (!value.is_object()) return;
        for (const auto& [name, member] : value.items()) {
            const Span key = texts_[next_++];
            place_.try_emplace(&value, key);
            key_[&member] = key;
            locate(member);
        }
    }

    Span whole() const { return {file_, 0, 0}; }
    Span place_of(const Json& value) const {
        if (const auto found = place_.find(&value); found != place_.end()) return found->second;
        if (const auto found = key_.find(&value); found != key_.end()) return found->second;
        return whole();
    }

    [[noreturn]] void fail(Span span, const std::string& message, std::string hint = {}) const {
        const Position position = source_.position(span.begin);
        throw Failure(
            fmt::format("{}:{}:{}: {}", source_.path(), position.line, position.column, message),
            std::move(hint));
    }

    void allow(const Json& object, Span span, const std::vector<std::string>& names) const {
        for (const auto& [name, member] : object.items()) {
            if (std::ranges::find(names, name) != names.end()) continue;
            const auto near = did_you_mean(name, names);
            const auto key = key_.find(&member);
            fail(key == key_.end() ? span : key->second, fmt::format("unknown member '{}'", name),
                 hint_of_name(near));
        }
    }

    const Json& member(const Json& object, const char* name, const char* of) const {
        if (!object.contains(name))
            fail(place_of(object), fmt::format("'{}' of the {} is missing", name, of));
        return object[name];
    }

    // `value` holds the expression.
    ExpressionIndex add_expression(const Json& value, Span span, SceneRange range) {
        if (source_.text().substr(span.begin, span.end - span.begin).find('\\') !=
            std::string::npos)
            fail(span, "an expression has no backslash, and stands on one line");
        if (scene_.expressions.size() == most_scene_expressions)
            fail(span,
                 fmt::format("a scene has no more than {} expressions", most_scene_expressions));
        const auto key = key_.find(&value);
        scene_.expressions.push_back(
            {span, key == key_.end() ? span : key->second, range, variables_});
        return scene_.expressions.size() - 1;
    }

    SceneNumber read_number(const Json& value) {
        if (value.is_number()) return value.get<double>();
        if (value.is_string()) return add_expression(value, place_of(value), SceneRange::Real);
        fail(place_of(value), "expected a number, or a text with an RDDL expression");
    }
    // A length or a size.
    SceneNumber read_length(const Json& value) {
        if (value.is_number() && value.get<double>() < 0)
            fail(place_of(value), "this may not be negative");
        return read_number(value);
    }
    SceneNumber length_or(const Json& shape, const char* name, double otherwise) {
        return shape.contains(name) ? read_length(shape[name]) : SceneNumber(otherwise);
    }
    bool read_outline(const Json& shape) const {
        if (!shape.contains("outline")) return false;
        const Json& value = shape["outline"];
        if (!value.is_boolean()) fail(place_of(value), "'outline' is true or false");
        return value.get<bool>();
    }
    render::Align read_align(const Json& shape) const {
        if (!shape.contains("align")) return render::Align::Center;
        const Json& value = shape["align"];
        if (value == "left") return render::Align::Left;
        if (value == "center") return render::Align::Center;
        if (value == "right") return render::Align::Right;
        fail(place_of(value), "'align' is left, center or right");
    }
    SceneNumber number_or(const Json& shape, const char* name, double otherwise) {
        return shape.contains(name) ? read_number(shape[name]) : SceneNumber(otherwise);
    }
    ExpressionIndex read_condition(const Json& value) {
        if (!value.is_string())
            fail(place_of(value), "a condition is a text with an RDDL expression");
        return add_expression(value, place_of(value), SceneRange::Bool);
    }

    void read_world(const Json& world) {
        if (!world.is_object()) fail(place_of(world), "'world' is an object");
        allow(world, place_of(world), {"left", "bottom", "right", "top"});
        scene_.left = number_or(world, "left", 0);
        scene_.bottom = number_or(world, "bottom", 0);
        scene_.right = number_or(world, "right", 1);
        scene_.top = number_or(world, "top", 1);
    }

    static bool is_of_name(char c) {
        return std::isalnum(static_cast<unsigned char>(c)) || c == '-' || c == '_';
    }
    // {"?b": "basin"}
    void read_variables(const Json& list) {
        if (!list.is_object())
            fail(place_of(list), "'for' is an object such as {\"?x\": \"type\"}");
        for (const auto& [name, type] : list.items()) {
            const Span key = key_.at(&type);
            if (name.size() < 2 || name[0] != '?' ||
                !std::ranges::all_of(name.substr(1), is_of_name))
                fail(key, "a variable is '?' and a name of letters, digits, '-' and '_'");
            if (!type.is_string()) fail(key, "the type of a variable is a text");
            variables_.push_back({name.substr(1), type.get<std::string>(), place_of(type)});
        }
    }

    SceneColor read_color(const Json& value) {
        if (value.is_string()) {
            render::Color color;
            const auto& text = value.get_ref<const std::string&>();
            if (render::read_color(text, color)) return {color};
            const auto near = did_you_mean(text, render::color_names());
            fail(place_of(value), fmt::format("'{}' is not a color", text),
                 near ? hint_of_name(near)
                      : fmt::format("colors are {}, or #rrggbb",
                                    fmt::join(render::color_names(), ", ")));
        }
        if (!value.is_object()) fail(place_of(value), "a color is a text or an object");
        if (value.contains("if")) {
            allow(value, place_of(value), {"if", "then", "else"});
            const ExpressionIndex condition = read_condition(value["if"]);
            const auto then_color =
                std::make_shared<SceneColor>(read_color(member(value, "then", "color")));
            const auto else_color =
                std::make_shared<SceneColor>(read_color(member(value, "else", "color")));
            return {SceneColorChoice{condition, then_color, else_color}};
        }
        allow(value, place_of(value), {"scale", "low", "high"});
        const SceneNumber scale = read_number(member(value, "scale", "color"));
        return {SceneColorScale{scale, number_or(value, "low", 0), number_or(value, "high", 1)}};
    }

    // The text that JSON writes as "\u6c34".
    std::string without_escapes(const std::string& raw, Span span) const {
        const Json decoded = Json::parse('"' + raw + '"', nullptr, false);
        const auto text = decoded.is_string() ? decoded.get<std::string>() : std::string();
        const auto is_control = [](char c) {
            return static_cast<unsigned char>(c) < ' ';
        };
        if (!decoded.is_string() || std::ranges::any_of(text, is_control))
            fail(span, "a text stands on one line");
        return text;
    }

    // Expressions also have braces: {sum_{?b: basin} [water(?b)]}.
    static std::size_t closing_brace(const std::string& text, std::size_t open) {
        int depth = 0;
        for (std::size_t at = open; at < text.size(); ++at) {
            if (text[at] == '{') ++depth;
            if (text[at] == '}' && --depth == 0) return at;
        }
        return std::string::npos;
    }

    // "level of {?b}: {water(?b)}"
    SceneText read_text(const Json& value) {
        if (!value.is_string()) fail(place_of(value), "'text' is a text in quotation marks");
        const Span span = place_of(value);
        const std::string raw = source_.text().substr(span.begin, span.end - span.begin);
        SceneText text;
        std::size_t at = 0;
        while (at < raw.size()) {
            const std::size_t open = std::min(raw.find('{', at), raw.size());
            if (open > at) text.push_back(without_escapes(raw.substr(at, open - at), span));
            if (open == raw.size()) break;
            const std::size_t close = closing_brace(raw, open);
            if (close == std::string::npos) fail(span, "a '{' is not closed");
            text.push_back(read_piece(value, raw.substr(open + 1, close - open - 1),
                                      {file_, span.begin + static_cast<std::uint32_t>(open) + 1,
                                       span.begin + static_cast<std::uint32_t>(close)}));
            at = close + 1;
        }
        return text;
    }

    SceneText::value_type read_piece(const Json& value, const std::string& piece, Span span) {
        for (std::size_t v = 0; v < variables_.size(); ++v)
            if (piece == "?" + variables_[v].name) return SceneVariableName{v};
        return add_expression(value, span, SceneRange::Shown);
    }

    void add_points(const Json& shape, SceneShape& result,
                    const std::vector<std::pair<const char*, const char*>>& names,
                    const char* kind) {
        for (const auto& [x, y] : names) {
            result.numbers.push_back(read_number(member(shape, x, kind)));
            result.numbers.push_back(read_number(member(shape, y, kind)));
        }
    }

    void read_polygon(const Json& shape, SceneShape& result) {
        const Json& points = member(shape, "points", "polygon");
        if (!points.is_array() || points.size() < 3)
            fail(place_of(points), "'points' are three or more pairs [x, y]");
        for (const Json& point : points) {
            if (!point.is_array() || point.size() != 2)
                fail(place_of(points), "a point is a pair [x, y]");
            for (const Json& number : point) result.numbers.push_back(read_number(number));
        }
    }

    SceneShape read_shape(const Json& shape) {
        if (!shape.is_object()) fail(place_of(shape), "a shape is an object");
        variables_.clear();
        if (shape.contains("for")) read_variables(shape["for"]);
        SceneShape result;
        const Json& kind_value = member(shape, "shape", "shape");
        const std::string kind = kind_value.is_string() ? kind_value.get<std::string>() : "";
        std::vector<std::string> names{"shape", "for", "color", "visible"};
        const auto also = [&](std::initializer_list<const char*> more) {
            names.insert(names.end(), more.begin(), more.end());
        };
        using Kind = render::Shape::Kind;
        if (kind == "circle") {
            also({"x", "y", "radius", "outline", "thickness"});
            result.kind = Kind::Circle;
            add_points(shape, result, {{"x", "y"}}, "circle");
            result.radius = read_length(member(shape, "radius", "circle"));
        } else if (kind == "line") {
            also({"x1", "y1", "x2", "y2", "thickness"});
            result.kind = Kind::Line;
            add_points(shape, result, {{"x1", "y1"}, {"x2", "y2"}}, "line");
        } else if (kind == "rectangle") {
            also({"left", "bottom", "right", "top", "outline", "thickness"});
            result.kind = Kind::Rectangle;
            add_points(shape, result, {{"left", "bottom"}, {"right", "top"}}, "rectangle");
        } else if (kind == "cell") {
            also({"column", "row", "outline", "thickness"});
            result.kind = Kind::Rectangle;
            add_points(shape, result, {{"column", "row"}}, "cell");
        } else if (kind == "polygon") {
            also({"points", "outline", "thickness"});
            result.kind = Kind::Polygon;
            read_polygon(shape, result);
        } else if (kind == "text") {
            also({"x", "y", "text", "size", "align"});
            result.kind = Kind::Text;
            add_points(shape, result, {{"x", "y"}}, "text");
            result.text = read_text(member(shape, "text", "text"));
            result.align = read_align(shape);
        } else {
            const auto near =
                did_you_mean(kind, {"circle", "line", "rectangle", "cell", "polygon", "text"});
            fail(place_of(kind_value), fmt::format("there is no shape '{}'", kind),
                 near ? hint_of_name(near)
                      : "shapes are circle, line, rectangle, cell, polygon and text");
        }
        allow(shape, place_of(shape), names);
        result.size = length_or(shape, "size", 12);
        result.thickness = length_or(shape, "thickness", 2);
        result.outline = read_outline(shape);
        result.color =
            shape.contains("color") ? read_color(shape["color"]) : SceneColor{render::colors::ink};
        if (shape.contains("visible")) result.visible = read_condition(shape["visible"]);
        result.variables = variables_;
        return result;
    }

    const Source& source_;
    std::vector<Span> texts_;
    FileId file_;
    std::size_t next_ = 0;
    std::unordered_map<const Json*, Span> place_, key_;
    std::vector<SceneVariable> variables_;  // of the shape that is read
    Scene scene_;
};

}  // namespace

Scene read_scene(const Source& source, FileId file) {
    return SceneReader(source, file).read();
}

}  // namespace rddlc::workbench
