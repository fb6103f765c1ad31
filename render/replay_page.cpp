#include "render/replay_page.hpp"

#include "render/panels.hpp"
#include "render/png.hpp"
#include "render/state_text.hpp"
#include "support/base64.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

namespace rddl::render {

namespace {

// The text is also safe within <script>.
std::string json_text(std::string_view text) {
    std::string out = "\"";
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        if (byte < 0x20 || c == '<' || c == '>' || c == '&') {
            out += fmt::format("\\u{:04x}", byte);
            continue;
        }
        if (c == '"' || c == '\\') out += '\\';
        out += c;
    }
    return out + '"';
}

std::string json_number(double value) {
    if (std::isnan(value)) return "\"nan\"";
    if (std::isinf(value)) return value < 0 ? "\"-inf\"" : "\"inf\"";
    char text[40];
    return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

std::string json_value(const Values& values, std::size_t grounding) {
    if (values.fluent->scalar == RDDL_BOOL)
        return values.numbers[grounding] != 0 ? "true" : "false";
    if (values.range()) return json_text(value_text(values, grounding));
    return json_number(values.numbers[grounding]);
}

std::string html_text(std::string_view text) {
    std::string out;
    for (const char c : text) {
        if (c == '<')
            out += "&lt;";
        else if (c == '>')
            out += "&gt;";
        else if (c == '&')
            out += "&amp;";
        else
            out += c;
    }
    return out;
}

void replace(std::string& text, std::string_view slot, std::string_view value) {
    for (std::size_t at = text.find(slot); at != std::string::npos;
         at = text.find(slot, at + value.size()))
        text.replace(at, slot.size(), value);
}

std::string names(const World& world) {
    std::string out;
    for (const rddl_fluent* const fluent : state_fluents(world.problem()))
        for (std::int64_t g = 0; g < fluent->count; ++g)
            out += (out.empty() ? "" : ",") + json_text(world.name_of(*fluent, g));
    return out;
}

std::string values_of(const Snapshot& snapshot) {
    std::string out;
    for (const rddl_fluent* const fluent : state_fluents(snapshot.problem())) {
        const Values& values = snapshot.values(*fluent);
        for (std::size_t g = 0; g < values.numbers.size(); ++g)
            out += (out.empty() ? "" : ",") + json_value(values, g);
    }
    return out;
}

}  // namespace

ReplayPage::ReplayPage(const World& world, int width, int height, double frames_per_second)
    : world_(world), width_(width), height_(height), frames_per_second_(frames_per_second) {}

void ReplayPage::begin_run(std::string_view name) {
    if (!first_run_) runs_ += "]},\n";
    runs_ += "{\"name\":" + json_text(name) + ",\"frames\":[\n";
    first_run_ = false;
    first_frame_ = true;
}

void ReplayPage::add(const Snapshot& snapshot, const Picture& picture) {
    const Step& now = snapshot.now();
    if (!first_frame_) runs_ += ",\n";
    first_frame_ = false;
    runs_ += "{\"step\":" + std::to_string(now.number) + ",\"reward\":" + json_number(now.reward) +
             ",\"total\":" + json_number(now.total) +
             ",\"acts\":" + (snapshot.acts() ? "true" : "false") +
             ",\"action\":" + json_text(action_text(snapshot)) + ",\"end\":" + json_text(now.end) +
             ",\"values\":[" + values_of(snapshot) + "],\"picture\":\"" +
             rddlc::base64(small_png_bytes(picture)) + "\"}";
}

std::string ReplayPage::html() const {
    const rddl_problem& problem = world_.problem();
    const std::string data = "{\"about\":" + json_text("domain " + std::string(problem.domain)) +
                             ",\"width\":" + std::to_string(width_) +
                             ",\"height\":" + std::to_string(height_) +
                             ",\"framesPerSecond\":" + json_number(frames_per_second_) +
                             ",\"names\":[" + names(world_) + "],\n\"runs\":[" + runs_ + "]}]}";
    std::string page(page_html);
    replace(page, "@STYLE@", page_css);
    replace(page, "@SCRIPT@", page_js);
    replace(page, "@TITLE@", html_text(problem.instance));
    replace(page, "@DATA@", data);
    return page;
}

}  // namespace rddl::render
