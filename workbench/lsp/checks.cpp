#include "lsp/checks.hpp"

#include "check/codes.hpp"
#include "driver/driver.hpp"
#include "parse/codes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace rddlc::lsp {

namespace {

// ---------------------------------------------------------------- which files are one problem

FilePtr file_with(const std::vector<FilePtr>& files, Meaning kind, std::string_view name) {
    const auto found = std::ranges::find_if(files, [&](const FilePtr& each) {
        return each->outline.find_block(kind, name) != nullptr;
    });
    return found == files.end() ? nullptr : *found;
}

// The domain, the block of non-fluents that an instance names, and the instance.
std::vector<FilePtr> inputs_with(const Family& family, const FilePtr& instance) {
    std::vector<FilePtr> inputs;
    const auto add = [&](const FilePtr& file) {
        if (file && std::ranges::find(inputs, file) == inputs.end()) inputs.push_back(file);
    };
    add(family.domain);
    for (const Block& block : instance->outline.blocks)
        if (!block.non_fluents.empty() &&
            !instance->outline.find_block(Meaning::NonFluents, block.non_fluents))
            add(file_with(family.others, Meaning::NonFluents, block.non_fluents));
    add(instance);
    return inputs;
}

bool names_non_fluents_of(const File& instance, const File& file) {
    return std::ranges::any_of(instance.outline.blocks, [&](const Block& block) {
        return !block.non_fluents.empty() &&
               file.outline.find_block(Meaning::NonFluents, block.non_fluents);
    });
}

// The instances to check with a file that holds none itself: all open ones, else the first.
std::vector<FilePtr> instances_for(const Family& family, const File& file) {
    std::vector<FilePtr> instances;
    const bool is_domain = family.domain && family.domain->uri == file.uri;
    const bool has_non_fluents = file.outline.has(Meaning::NonFluents) && !is_domain;
    for (const FilePtr& each : family.others) {
        if (!each->outline.has(Meaning::Instance)) continue;
        if (has_non_fluents && !names_non_fluents_of(*each, file)) continue;
        if (each->version || instances.empty()) instances.push_back(each);
    }
    const bool has_open = !instances.empty() && instances.back()->version;
    if (has_open) std::erase_if(instances, [](const FilePtr& each) { return !each->version; });
    return instances;
}

std::vector<CheckRequest::Problem> problems_of(const FilePtr& file, const Family& family) {
    const Outline& outline = file->outline;
    const bool is_policy = outline.has(Meaning::Policy) && !outline.has(Meaning::Domain) &&
                           !outline.has(Meaning::Instance);
    const bool has_choice = !family.domain && family.domains_around.size() == 1;
    if (outline.has(Meaning::Instance) || outline.blocks.empty())
        return {{inputs_with(family, file), nullptr, file,
                 has_choice ? family.domains_around.front() : nullptr}};
    std::vector<CheckRequest::Problem> problems;
    for (const FilePtr& instance : instances_for(family, *file))
        problems.push_back({inputs_with(family, instance), is_policy ? file : nullptr, file});
    if (!problems.empty()) return problems;
    return {{{family.domain ? family.domain : file},
             is_policy ? file : nullptr,
             file,
             has_choice ? family.domains_around.front() : nullptr}};
}

// ------------------------------------------------------------------------ one run of checks

constexpr std::string_view places_of_domains = "the open files and the folder of this one";

constexpr int error_severity = 1, warning_severity = 2, information_severity = 3;

class Checker {
  public:
    explicit Checker(Standard standard) : standard_(standard) {}

    void check(const CheckRequest::Problem& problem) {
        const bool knows_domain = std::ranges::any_of(
            problem.inputs, [](const FilePtr& file) { return file->outline.has(Meaning::Domain); });
        files_.clear();
        for (const FilePtr& file : problem.inputs) add(file);
        if (problem.policy) add(problem.policy);
        CompileOptions options;
        for (const FilePtr& file : problem.inputs) options.inputs.push_back(file->path);
        for (const FilePtr& file : files_) options.texts[file->path] = file->text.string();
        if (problem.policy && knows_domain) options.policy = problem.policy->path;
        options.standard = standard_;
        options.stop_after = knows_domain ? Stage::Ground : Stage::Parse;
        options.domain_may_stand_alone = true;
        const Compilation compilation = compile(options);
        for (const Diagnostic& diagnostic : compilation.diagnostics.all())
            take(diagnostic, compilation.diagnostics.is_error(diagnostic), *problem.asked);
        if (is_unfinished(compilation)) check_as_if_finished(options, *problem.asked);
        if (!knows_domain) tell_of_missing_domain(*problem.asked, problem.other_domain);
    }

    Checks result() && { return std::move(checks_); }

  private:
    void add(const FilePtr& file) {
        files_.push_back(file);
        checks_[file->uri].version = file->version;
    }

    // Whether a file ends too soon, and nothing else is wrong: somebody writes it from the top
    // down.
    bool is_unfinished(const Compilation& compilation) const {
        const auto lacks_end = [&](const Diagnostic& diagnostic) {
            return diagnostic.code == unbalanced_bracket && diagnostic.span &&
                   end_of(*files_[diagnostic.span->file]) <= diagnostic.span->begin;
        };
        return compilation.diagnostics.has_errors() &&
               std::ranges::all_of(compilation.diagnostics.all(), lacks_end);
    }

    // Behind the last word or mark that is not a comment.
    static std::size_t end_of(const File& file) {
        std::size_t end = 0;
        for (const format::Token& token : file.outline.tokens)
            if (!token.text.empty())
                end = static_cast<std::size_t>(token.text.data() - file.text.string().data()) +
                      token.text.size();
        return end;
    }

    // The mistakes in what is there already, as if its brackets were closed. What is not there yet
    // may still come.
    void check_as_if_finished(CompileOptions options, const File& asked) {
        for (const FilePtr& file : files_) options.texts[file->path] += missing_end(*file);
        const Compilation compilation = compile(options);
        for (const Diagnostic& diagnostic : compilation.diagnostics.all()) {
            const bool is_there =
                diagnostic.span &&
                diagnostic.span->end <= files_[diagnostic.span->file]->text.string().size();
            if (is_there && !may_still_come(diagnostic.code))
                take(diagnostic, compilation.diagnostics.is_error(diagnostic), asked);
        }
    }

    // The brackets that close sections and the block.
    static std::string missing_end(const File& file) {
        std::size_t open = 0;
        for (const format::Token& token : file.outline.tokens) {
            if (token.text == "{") ++open;
            if (token.text == "}" && open > 0) --open;
        }
        if (open == 0) return "";
        std::string text = "\n";
        while (--open > 0) text += "};";
        return text + "}";
    }

    static bool may_still_come(Code code) {
        using namespace checking;
        constexpr Code codes[] = {missing_block,     missing_section,   type_without_objects,
                                  missing_cpf,       missing_values,    unused_fluent,
                                  idle_action_limit, unbalanced_bracket};
        return std::ranges::find(codes, code) != std::end(codes);
    }

    Json range(Span span) const { return files_[span.file]->text.range({span.begin, span.end}); }

    // A diagnostic without a place is shown at the name of the first block.
    static Json range_of_whole(const File& file) {
        const auto& blocks = file.outline.blocks;
        return file.text.range(blocks.empty() ? Place{} : blocks.front().name.place);
    }

    void take(const Diagnostic& diagnostic, bool is_error, const File& asked) {
        const File& file = diagnostic.span ? *files_[diagnostic.span->file] : asked;
        Json json;
        json["range"] = diagnostic.span ? range(*diagnostic.span) : range_of_whole(file);
        json["severity"] = is_error ? error_severity : warning_severity;
        json["code"] = to_string(diagnostic.code);
        json["source"] = "rddl";
        json["message"] =
            diagnostic.message + (diagnostic.hint.empty() ? "" : "\nhint: " + diagnostic.hint);
        for (const Note& note : diagnostic.notes) {
            if (!note.span) continue;
            const Json location = {{"uri", files_[note.span->file]->uri},
                                   {"range", range(*note.span)}};
            json["relatedInformation"].push_back(
                {{"location", location}, {"message", note.message}});
        }
        publish(file, std::move(json), &diagnostic);
    }

    void publish(const File& file, Json json, const Diagnostic* diagnostic) {
        FileChecks& checks = checks_[file.uri];
        // Two instances of a domain have its mistakes in common.
        const bool is_known =
            std::ranges::find(checks.diagnostics, json) != checks.diagnostics.end();
        if (is_known) return;
        checks.diagnostics.push_back(std::move(json));
        if (!diagnostic || diagnostic->fix.empty()) return;
        QuickFix fix{title_of(*diagnostic), Json::object(), checks.diagnostics.size() - 1};
        for (const Replacement& each : diagnostic->fix)
            fix.changes[files_[each.span.file]->uri].push_back(
                {{"range", range(each.span)}, {"newText", each.text}});
        checks.fixes.push_back(std::move(fix));
    }

    // "Write 'x' in place of 'y'", or the hint where it takes several changes.
    std::string title_of(const Diagnostic& diagnostic) const {
        if (diagnostic.fix.size() > 1 && !diagnostic.hint.empty()) return diagnostic.hint;
        const Replacement& fix = diagnostic.fix.front();
        const std::string_view before =
            files_[fix.span.file]->text.of({fix.span.begin, fix.span.end});
        const std::string text = on_one_line(fix.text);
        if (before.empty()) return fmt::format("Insert '{}'", text);
        if (fix.text.empty()) return fmt::format("Remove '{}'", on_one_line(before));
        return fmt::format("Replace '{}' by '{}'", on_one_line(before), text);
    }

    // Short, without blanks at the ends.
    static std::string on_one_line(std::string_view text) {
        constexpr std::size_t longest = 60;
        std::string line;
        for (const char c : text) {
            const bool is_blank = c == ' ' || c == '\n' || c == '\t' || c == '\r';
            if (!is_blank) line += c;
            if (is_blank && !line.empty() && line.back() != ' ') line += ' ';
        }
        if (line.ends_with(' ')) line.pop_back();
        return line.size() <= longest ? line : line.substr(0, longest) + "...";
    }

    // A policy need not name its domain, but only a name leads to the domain.
    void tell_of_unnamed_domain(const File& file, const FilePtr& other) {
        if (file.outline.blocks.empty()) return;
        const std::string_view text = file.text.string();
        Json json;
        const std::size_t end = std::min(text.find('\n'), text.size());
        json["range"] = file.text.range({0, static_cast<std::uint32_t>(end)});
        json["severity"] = information_severity;
        json["source"] = "rddl";
        json["message"] = fmt::format(
            "this file names no domain, so the syntax alone is checked\nhint: write 'domain = {};' "
            "in the block: it is looked for in {}",
            other ? domain_of(*other) : "NAME", places_of_domains);
        publish(file, std::move(json), nullptr);
    }

    void tell_of_missing_domain(const File& file, const FilePtr& other) {
        const auto& blocks = file.outline.blocks;
        const auto named =
            std::ranges::find_if(blocks, [](const Block& block) { return !block.domain.empty(); });
        if (named == blocks.end()) return tell_of_unnamed_domain(file, other);
        const auto& occurrences = file.outline.occurrences;
        const auto place = std::ranges::find_if(
            occurrences, [](const Occurrence& each) { return each.meaning == Meaning::Domain; });
        Json json;
        json["range"] = file.text.range(place->name.place);
        json["severity"] = information_severity;
        json["source"] = "rddl";
        json["message"] = fmt::format(
            "no file here declares the domain '{}', so the syntax alone is checked ({})",
            named->domain, places_of_domains);
        if (!other) return publish(file, std::move(json), nullptr);
        const std::string_view name = domain_of(*other);
        json["message"] =
            fmt::format("{}\nhint: did you mean '{}'?", json["message"].get<std::string>(), name);
        FileChecks& checks = checks_[file.uri];
        const std::size_t count = checks.diagnostics.size();
        publish(file, std::move(json), nullptr);
        if (checks.diagnostics.size() == count) return;
        QuickFix fix{fmt::format("Replace '{}' by '{}'", named->domain, name), Json::object(),
                     count};
        for (const Occurrence& each : occurrences)
            if (each.meaning == Meaning::Domain && each.name.text == named->domain)
                fix.changes[file.uri].push_back(
                    {{"range", file.text.range(each.name.place)}, {"newText", name}});
        checks.fixes.push_back(std::move(fix));
    }

    static std::string_view domain_of(const File& file) {
        const auto& blocks = file.outline.blocks;
        return std::ranges::find(blocks, Meaning::Domain, &Block::kind)->name.text;
    }

    Standard standard_;
    std::vector<FilePtr> files_;  // of the problem, in the order of the compiler's numbers
    Checks checks_;
};

}  // namespace

CheckRequest check_request(const Workspace& workspace, Standard standard) {
    CheckRequest request;
    request.standard = standard;
    std::set<std::vector<std::string>> known;
    for (const FilePtr& file : workspace.open_files())
        for (CheckRequest::Problem& problem : problems_of(file, workspace.family_of(file))) {
            std::vector<std::string> uris;
            for (const FilePtr& input : problem.inputs) uris.push_back(input->uri);
            uris.push_back(problem.policy ? problem.policy->uri : "");
            if (known.insert(std::move(uris)).second)
                request.problems.push_back(std::move(problem));
        }
    return request;
}

Checks run_checks(const CheckRequest& request) {
    Checker checker(request.standard);
    for (const CheckRequest::Problem& problem : request.problems) checker.check(problem);
    return std::move(checker).result();
}

}  // namespace rddlc::lsp
