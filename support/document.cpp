#include "support/document.hpp"

#include "support/match.hpp"

#include <algorithm>
#include <utility>
#include <variant>

namespace rddlc::document {

// The namespace has a name, since Document is known to other files.
namespace document_nodes {

struct Text {
    std::string text;
};
struct Words {
    std::vector<std::string> words;
};
struct Line {
    std::string flat;
};
struct IfBroken {
    std::string text;
};
struct Concat {
    std::vector<Doc> parts;
};
struct Nest {
    Doc body;
};
struct Align {
    Doc body;
};
struct Group {
    Doc body;
    bool broken;
};
struct Flat {
    Doc body;
};
struct Alternatives {
    std::vector<Doc> choices;
};
struct TrailingComment {
    std::vector<std::string> lines;
};
struct OwnLineComment {
    std::string text;
};

}  // namespace document_nodes

using namespace document_nodes;

struct Document {
    std::variant<Text, Words, Line, IfBroken, Concat, Nest, Align, Group, Flat, Alternatives,
                 TrailingComment, OwnLineComment>
        node;
    std::size_t flat_width;
};

namespace {

template <class Node>
Doc make(Node node, std::size_t width) {
    return std::make_shared<const Document>(Document{std::move(node), width});
}

// Beyond this column, alignment leaves too little of the page.
constexpr std::size_t last_alignment = 60;

bool is_blank(std::string_view text) {
    return text.find_first_not_of(' ') == text.npos;
}

enum class Mode { Flat, Broken };
struct Command {
    std::size_t indent;
    Mode mode;
    const Document* doc;
};

class Renderer {
  public:
    Renderer(std::string head, std::vector<TextLine>& lines)
        : lines_(lines), current_(std::move(head)) {}

    void render(const Doc& doc, std::size_t indent) {
        stack_.push_back({indent, Mode::Broken, doc.get()});
        while (!stack_.empty()) {
            const Command command = stack_.back();
            stack_.pop_back();
            match(command.doc->node, [&](const auto& node) { print(command, node); });
        }
        end_line();
    }

  private:
    void print(const Command& command, const Text& node) { add(command, node.text); }
    void print(const Command& command, const Words& node) {
        for (std::size_t i = 0; i < node.words.size(); ++i) {
            const bool fits = current_.size() + 2 + node.words[i].size() < page_width;
            if (i > 0 && command.mode == Mode::Broken && !fits)
                new_line(command.indent);
            else if (i > 0)
                add(command, " ");
            add(command, node.words[i]);
            if (i + 1 < node.words.size()) add(command, ",");
        }
    }
    void print(const Command& command, const Line& node) {
        if (command.mode == Mode::Flat && !must_break_)
            add(command, node.flat);
        else
            new_line(command.indent);
    }
    void print(const Command& command, const IfBroken& node) {
        if (command.mode == Mode::Broken && !must_break_) add(command, node.text);
    }
    void print(const Command& command, const Concat& node) {
        for (auto part = node.parts.rbegin(); part != node.parts.rend(); ++part)
            push(command.indent, command.mode, *part);
    }
    void print(const Command& command, const Nest& node) {
        push(command.indent + indentation, command.mode, node.body);
    }
    void print(const Command& command, const Align& node) {
        const std::size_t nested = command.indent + indentation;
        const std::size_t column = must_break_ ? nested : current_.size();
        const bool drifted = column > std::max(last_alignment, nested);
        push(drifted ? nested : column, command.mode, node.body);
    }
    void print(const Command& command, const Group& node) {
        const Command in_one_line{command.indent, Mode::Flat, node.body.get()};
        const bool is_flat = command.mode == Mode::Flat || (!node.broken && fits(in_one_line));
        push(command.indent, is_flat ? Mode::Flat : Mode::Broken, node.body);
    }
    void print(const Command& command, const Flat& node) {
        push(command.indent, Mode::Flat, node.body);
    }
    void print(const Command& command, const Alternatives& node) {
        if (command.mode == Mode::Flat)
            return push(command.indent, command.mode, node.choices.front());
        const auto last = std::prev(node.choices.end());
        const auto chosen = std::find_if(node.choices.begin(), last, [&](const Doc& choice) {
            return fits({command.indent, Mode::Broken, choice.get()});
        });
        push(command.indent, command.mode, *chosen);
    }
    void print(const Command&, const TrailingComment& node) {
        comment_.insert(comment_.end(), node.lines.begin(), node.lines.end());
        must_break_ = true;
    }
    void print(const Command& command, const OwnLineComment& node) {
        if (must_break_ || !is_blank(current_)) new_line(command.indent);
        current_ += node.text;
        must_break_ = true;
    }

    void push(std::size_t indent, Mode mode, const Doc& doc) {
        stack_.push_back({indent, mode, doc.get()});
    }

    void add(const Command& command, std::string_view text) {
        if (text.empty() || (must_break_ && is_blank(text))) return;
        if (must_break_) new_line(command.indent);
        if (!is_blank(text) || !is_blank(current_)) current_ += text;
    }

    void new_line(std::size_t indent) {
        end_line();
        current_.assign(indent, ' ');
    }

    void end_line() {
        current_.erase(current_.find_last_not_of(' ') + 1);
        if (comment_.empty()) comment_.emplace_back();
        for (std::string& comment : comment_)
            lines_.push_back({std::exchange(current_, {}), std::move(comment)});
        comment_.clear();
        must_break_ = false;
    }

    // Whether the text up to the next line break fits on the page, that of what follows included.
    bool fits(const Command& candidate) const {
        Measure measure{page_width, must_break_ ? candidate.indent : current_.size()};
        std::vector<Command> todo{candidate};
        std::size_t rest = stack_.size();
        while (!measure.done) {
            if (todo.empty() && rest == 0) return true;
            if (todo.empty()) todo.push_back(stack_[--rest]);
            const Command command = todo.back();
            todo.pop_back();
            match(command.doc->node,
                  [&](const auto& node) { measure.look_at(command.mode, node, todo); });
        }
        return measure.result;
    }

    struct Measure {
        std::size_t width;
        std::size_t column;
        bool after_comment = false;
        bool done = false;
        bool result = false;

        void decide(bool answer) {
            done = true;
            result = answer;
        }
        void advance(std::string_view text) {
            column += text.size();
            if (!text.empty() && (after_comment || column > width)) decide(false);
        }
        void look_at(Mode, const Text& node, std::vector<Command>&) { advance(node.text); }
        void look_at(Mode mode, const Words& node, std::vector<Command>&) {
            for (const std::string& word : node.words) {
                advance(word);
                if (done || &word == &node.words.back()) return;
                if (mode == Mode::Broken) return decide(true);
                advance(", ");
            }
        }
        void look_at(Mode mode, const Line& node, std::vector<Command>&) {
            if (mode == Mode::Broken) return decide(true);
            if (after_comment) return decide(false);
            advance(node.flat);
        }
        void look_at(Mode mode, const IfBroken& node, std::vector<Command>&) {
            if (mode == Mode::Broken && !after_comment) advance(node.text);
        }
        void look_at(Mode mode, const Concat& node, std::vector<Command>& todo) {
            for (auto part = node.parts.rbegin(); part != node.parts.rend(); ++part)
                todo.push_back({0, mode, part->get()});
        }
        void look_at(Mode mode, const Nest& node, std::vector<Command>& todo) {
            todo.push_back({0, mode, node.body.get()});
        }
        void look_at(Mode mode, const Align& node, std::vector<Command>& todo) {
            todo.push_back({0, mode, node.body.get()});
        }
        void look_at(Mode mode, const Group& node, std::vector<Command>& todo) {
            if (mode == Mode::Flat && node.broken) return decide(false);
            todo.push_back({0, mode, node.body.get()});
        }
        void look_at(Mode, const Flat& node, std::vector<Command>& todo) {
            todo.push_back({0, Mode::Flat, node.body.get()});
        }
        // If lines may be broken, the second choice has the shortest first line.
        void look_at(Mode mode, const Alternatives& node, std::vector<Command>& todo) {
            todo.push_back({0, mode, node.choices[mode == Mode::Flat ? 0 : 1].get()});
        }
        void look_at(Mode, const TrailingComment&, std::vector<Command>&) { after_comment = true; }
        void look_at(Mode mode, const OwnLineComment&, std::vector<Command>&) {
            decide(mode == Mode::Broken);
        }
    };

    std::vector<TextLine>& lines_;
    std::vector<Command> stack_;
    std::string current_;
    std::vector<std::string> comment_;  // behind the current line
    bool must_break_ = false;           // a comment has ended the current line
};

}  // namespace

Doc text(std::string text) {
    const std::size_t width = text.size();
    return make(Text{std::move(text)}, width);
}

Doc words(std::vector<std::string> words) {
    std::size_t width = 2 * (words.size() - 1);
    for (const std::string& word : words) width += word.size();
    return make(Words{std::move(words)}, width);
}

Doc line(std::string flat) {
    const std::size_t width = flat.size();
    return make(Line{std::move(flat)}, width);
}

Doc if_broken(std::string text) {
    return make(IfBroken{std::move(text)}, 0);
}

Doc concat(std::vector<Doc> parts) {
    std::size_t width = 0;
    for (const Doc& part : parts)
        width = width == unbounded || part->flat_width == unbounded ? unbounded
                                                                    : width + part->flat_width;
    return make(Concat{std::move(parts)}, width);
}

Doc nest(Doc body) {
    const std::size_t width = body->flat_width;
    return make(Nest{std::move(body)}, width);
}

Doc align(Doc body) {
    const std::size_t width = body->flat_width;
    return make(Align{std::move(body)}, width);
}

Doc group(Doc body, bool broken) {
    const std::size_t width = broken ? unbounded : body->flat_width;
    return make(Group{std::move(body), broken}, width);
}

Doc flat(Doc body) {
    const std::size_t width = body->flat_width;
    return make(Flat{std::move(body)}, width);
}

Doc alternatives(std::vector<Doc> choices) {
    const std::size_t width = choices.front()->flat_width;
    return make(Alternatives{std::move(choices)}, width);
}

Doc trailing_comment(std::vector<std::string> lines) {
    return make(TrailingComment{std::move(lines)}, unbounded);
}

Doc own_line_comment(std::string text) {
    return make(OwnLineComment{std::move(text)}, unbounded);
}

std::size_t flat_width(const Doc& doc) {
    return doc->flat_width;
}

void render(const Doc& doc, std::string head, std::size_t indent, std::vector<TextLine>& lines) {
    Renderer(std::move(head), lines).render(doc, indent);
}

}  // namespace rddlc::document
