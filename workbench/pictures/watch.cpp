#include "pictures/watch.hpp"

#include "support/base64.hpp"
#include "support/program.hpp"
#include "support/utf8.hpp"
#include "terminal/interrupt.hpp"

#include <fmt/format.h>
#include <render/png.hpp>
#include <render/state_text.hpp>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

namespace rddlc::workbench {

namespace render = rddl::render;

namespace {

// How a terminal takes pictures, if it does.
enum class Images { None, Kitty, Iterm };

Images images_of_terminal() {
    const auto variable = [](const char* name) {
        const char* const value = std::getenv(name);
        return std::string_view(value ? value : "");
    };
    if (variable("TERM") == "xterm-kitty" || variable("TERM_PROGRAM") == "ghostty")
        return Images::Kitty;
    if (variable("TERM_PROGRAM") == "iTerm.app" || variable("TERM_PROGRAM") == "WezTerm")
        return Images::Iterm;
    return Images::None;
}

struct Size {
    std::size_t rows = 24, columns = 80;
};

Size terminal_size() {
    winsize size{};
    if (ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_row < 4 || size.ws_col < 20)
        return {};
    return {size.ws_row, size.ws_col};
}

// The kitty graphics protocol: a PNG in chunks of 4,096 characters, in place of the last one.
std::string kitty_image(const std::string& png) {
    constexpr std::size_t chunk = 4096;
    const std::string text = base64(png);
    std::string out = "\x1b_Ga=d\x1b\\";
    for (std::size_t at = 0; at < text.size(); at += chunk) {
        const bool more = at + chunk < text.size();
        out += fmt::format("\x1b_G{}m={};{}\x1b\\", at == 0 ? "a=T,f=100," : "", more ? 1 : 0,
                           text.substr(at, chunk));
    }
    return out + "\n";
}

// The inline images of iTerm2.
std::string iterm_image(const std::string& png) {
    return fmt::format("\x1b]1337;File=inline=1;size={}:{}\a\n", png.size(), base64(png));
}

// The characters that fit in the columns, without control sequences.
std::string cut_off(std::string_view line, std::size_t columns) {
    const std::string text = printable_line(line);
    std::size_t width = 0, bytes = 0;
    while (bytes < text.size()) {
        const Character character = first_character(std::string_view(text).substr(bytes));
        if (width + character.width > columns) break;
        width += character.width;
        bytes += character.bytes.size();
    }
    return text.substr(0, bytes);
}

std::string heading(const render::Snapshot& snapshot) {
    const render::Step& now = snapshot.now();
    std::string text = fmt::format("{}  episode {}  step {}", snapshot.problem().instance,
                                   snapshot.episode(), now.number);
    if (snapshot.horizon() > 0) text += fmt::format(" / {}", snapshot.horizon());
    text += fmt::format("  return {}", render::number_text(now.total));
    if (snapshot.acts()) text += fmt::format("  reward {}", render::number_text(now.reward));
    if (!now.end.empty()) text += "  ended: " + now.end;
    return text;
}

// Lines of at most so many columns, and no more than there is room for.
std::vector<std::string> lines_of(const render::Snapshot& snapshot, const Size& size,
                                  bool in_color) {
    std::vector<std::string> lines{cut_off(heading(snapshot), size.columns)};
    if (snapshot.acts())
        lines.push_back(cut_off("action: " + render::action_text(snapshot), size.columns));
    const std::vector<render::TextLine> values = render::state_lines(snapshot);
    std::size_t widest = 0;
    for (const render::TextLine& line : values) widest = std::max(widest, display_width(line.name));
    widest = std::min(widest, size.columns / 2);
    const std::size_t room = size.rows - lines.size() - 1;
    const std::size_t shown = values.size() > room ? room - 1 : values.size();
    for (std::size_t i = 0; i < shown; ++i) {
        const std::string name = cut_off(values[i].name, widest);
        const std::string pad(widest - display_width(name) + 1, ' ');
        std::string text =
            cut_off((values[i].changed ? "* " : "  ") + name + pad + values[i].value, size.columns);
        lines.push_back(values[i].changed && in_color ? "\x1b[1m" + text + "\x1b[0m" : text);
    }
    if (shown < values.size())
        lines.push_back(fmt::format("  ... and {} more", values.size() - shown));
    return lines;
}

// Over what was shown before: home, each line to its end, and what is below wiped.
void show_in_place(const std::vector<std::string>& lines) {
    std::string text = "\x1b[H";
    for (const std::string& line : lines) text += line + "\x1b[K\n";
    fmt::print("{}\x1b[J", text);
}

using Clock = std::chrono::steady_clock;

// False after Ctrl-C, which is not waited out.
bool wait_until(Clock::time_point time) {
    constexpr Clock::duration at_most = std::chrono::milliseconds(50);
    for (auto now = Clock::now(); now < time && !is_interrupted(); now = Clock::now())
        std::this_thread::sleep_for(std::min(at_most, time - now));
    return !is_interrupted();
}

struct Watch {
    Clock::duration pause{};
    Clock::time_point next{};  // when the next state may be shown
    bool is_terminal = false;
    Images images = Images::None;
    bool has_begun = false;

    void show(const Drawn& drawn) {
        const render::Snapshot snapshot = drawn.renderer.snapshot();
        if (!is_terminal) {
            constexpr Size unlimited{1'000'000, 1'000'000};
            for (const std::string& line : lines_of(snapshot, unlimited, false))
                fmt::print("{}\n", line);
            fmt::print("\n");
            std::fflush(stdout);
            return;
        }
        if (!wait_until(next)) return;
        if (!std::exchange(has_begun, true)) fmt::print("\x1b[2J");
        if (images == Images::None) {
            show_in_place(lines_of(snapshot, terminal_size(), tells_in_color()));
        } else {
            const std::string png = render::png_bytes(drawn.renderer.picture());
            fmt::print("\x1b[H{}\x1b[K\n{}", cut_off(heading(snapshot), terminal_size().columns),
                       images == Images::Kitty ? kitty_image(png) : iterm_image(png));
        }
        std::fflush(stdout);
        next = Clock::now() + pause;
    }
};

}  // namespace

Output watch_output(const PictureOptions& options) {
    const auto watch = std::make_shared<Watch>();
    watch->is_terminal = is_terminal(STDOUT_FILENO);
    if (options.visualizer != "text") watch->images = images_of_terminal();
    Output output;
    output.begin = [=](const Show& show) {
        constexpr Clock::duration between_episodes = std::chrono::seconds(1);
        if (watch->has_begun) watch->next += between_episodes;
        watch->pause = std::chrono::duration_cast<Clock::duration>(
            std::chrono::duration<double>(1 / show.pace.frames_per_second));
    };
    output.add = [=](const Drawn& drawn) {
        if (drawn.in_movie) watch->show(drawn);
        return drawn.in_movie;
    };
    output.finish = [=] {
        if (watch->is_terminal) fmt::print("\n");
    };
    return output;
}

}  // namespace rddlc::workbench
