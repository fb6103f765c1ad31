#include "scenes/scene_program.hpp"

#include "parse/parse.hpp"
#include "problems/front_end.hpp"
#include "support/diagnostic.hpp"
#include "support/failure.hpp"
#include "support/files.hpp"
#include "support/suggestion.hpp"

#include <fmt/format.h>
#include <render/snapshot.hpp>

#include <algorithm>
#include <cstring>
#include <optional>
#include <set>
#include <unordered_map>
#include <utility>

namespace rddlc::workbench {

namespace {

// Messages use this name. No RDDL can, since it has blanks.
std::string name_of_expression(ExpressionIndex index) {
    return fmt::format("expression {} of the scene", index + 1);
}

template <class Section>
Section* section_of(ast::Domain& domain) {
    Section* last = nullptr;  // of several the last one counts
    for (ast::DomainSection& section : domain.sections)
        if (auto* const found = std::get_if<Section>(&section.node)) last = found;
    return last;
}

ast::Domain* domain_of(ast::Program& program) {
    for (ast::Block& block : program.blocks)
        if (auto* const domain = std::get_if<ast::Domain>(&block)) return domain;
    return nullptr;
}

// Expressions as CPFs of fluents of their own.
class SceneCompiler {
  public:
    SceneCompiler(ast::Program& program, const Source& source, Diagnostics& diagnostics,
                  Standard standard)
        : program_(program), source_(source), diagnostics_(diagnostics), standard_(standard) {}

    void add(const Scene& scene) {
        ast::Domain* const domain = domain_of(program_);
        if (!domain) return;  // the checker reports that
        auto* const fluents = section_of<ast::PVariables>(*domain);
        auto* const cpfs = section_of<ast::Cpfs>(*domain);
        if (!fluents || !cpfs) return;
        for (const SceneShape& shape : scene.shapes) {
            require_types(shape, *domain);
            require_few(shape);
        }
        std::set<std::string> types;
        for (std::size_t i = 0; i < scene.expressions.size(); ++i) {
            const SceneExpression& expression = scene.expressions[i];
            std::optional<ast::Expr> body =
                parse_expression(source_, expression.span, diagnostics_, standard_);
            if (!body) continue;
            fluents->declarations.push_back(
                declaration(i, expression, range_of(expression, *body, *fluents)));
            cpfs->definitions.push_back(definition(i, expression, *std::move(body)));
            for (const SceneVariable& variable : expression.variables) types.insert(variable.type);
        }
        for (const std::string& type : types) add_index(*fluents, type);
    }

  private:
    // A text may show a fluent whose values are objects; all else that it shows is a number.
    static std::string range_of(const SceneExpression& expression, const ast::Expr& body,
                                const ast::PVariables& fluents) {
        if (expression.range == SceneRange::Bool) return "bool";
        const auto* const named = std::get_if<ast::Reference>(&body.node);
        if (expression.range == SceneRange::Shown && named)
            for (const ast::PVariable& fluent : fluents.declarations)
                if (fluent.name.text == named->name.text && fluent.range.text != "int")
                    return fluent.range.text;
        return "real";
    }

    static ast::PVariable declaration(std::size_t index, const SceneExpression& expression,
                                      const std::string& range) {
        ast::PVariable fluent;
        fluent.name = {name_of_expression(index), expression.span};
        for (const SceneVariable& variable : expression.variables)
            fluent.parameters.push_back({variable.type, variable.span});
        fluent.kind = {"interm-fluent", expression.span};
        fluent.range = {range, expression.span};
        fluent.span = expression.member;
        return fluent;
    }

    static ast::Cpf definition(std::size_t index, const SceneExpression& expression,
                               ast::Expr body) {
        std::vector<ast::Name> parameters;
        for (const SceneVariable& variable : expression.variables)
            parameters.push_back({variable.name, variable.span});
        return {{name_of_expression(index), expression.span},
                false,
                std::move(parameters),
                std::move(body),
                expression.span};
    }

    // How many objects there are, and the number of each from 0 on: count-TYPE and index-TYPE(?x),
    // for places in a row.
    void add_index(ast::PVariables& fluents, const std::string& type) {
        const std::string name = "index-" + type;
        const std::vector<ast::Symbol> objects = objects_of(type);
        if (objects.empty()) return;
        const Span span{};
        const ast::Constant zero{ast::Integer{0}, span};
        const ast::Constant count{ast::Integer{static_cast<std::int64_t>(objects.size())}, span};
        if (!is_declared(fluents, "count-" + type))
            fluents.declarations.push_back({{"count-" + type, span},
                                            false,
                                            {},
                                            {"non-fluent", span},
                                            {"int", span},
                                            count,
                                            std::nullopt,
                                            span});
        if (is_declared(fluents, name)) return;
        fluents.declarations.push_back({{name, span},
                                        false,
                                        {{type, span}},
                                        {"non-fluent", span},
                                        {"int", span},
                                        zero,
                                        std::nullopt,
                                        span});
        ast::NonFluentValues values;
        for (std::size_t i = 1; i < objects.size(); ++i) {
            const ast::Constant number{ast::Integer{static_cast<std::int64_t>(i)}, span};
            values.assignments.push_back({{name, span}, false, {objects[i]}, {span}, number, span});
        }
        append(std::move(values));
    }

    // A name that the domain has itself is the domain's.
    static bool is_declared(const ast::PVariables& fluents, const std::string& name) {
        return std::ranges::any_of(fluents.declarations, [&](const ast::PVariable& fluent) {
            return fluent.name.text == name;
        });
    }

    // Once for a shape, however many expressions it has.
    void require_types(const SceneShape& shape, const ast::Domain& domain) const {
        std::vector<std::string> names;
        for (const ast::DomainSection& section : domain.sections)
            if (const auto* const types = std::get_if<ast::Types>(&section.node))
                for (const ast::TypeDeclaration& declared : types->declarations)
                    names.push_back(declared.name.text);
        for (const SceneVariable& variable : shape.variables) {
            if (std::ranges::find(names, variable.type) != names.end()) continue;
            const auto near = did_you_mean(variable.type, names);
            fail(variable.span, fmt::format("there is no type of objects '{}'", variable.type),
                 hint_of_name(near));
        }
    }

    [[noreturn]] void fail(Span span, const std::string& message, std::string hint) const {
        const Position position = source_.position(span.begin);
        throw Failure(
            fmt::format("{}:{}:{}: {}", source_.path(), position.line, position.column, message),
            std::move(hint));
    }

    // Each is computed and drawn for each picture.
    void require_few(const SceneShape& shape) {
        constexpr std::size_t most = 100'000;
        std::size_t tuples = 1;
        for (const SceneVariable& variable : shape.variables) {
            tuples *= std::max<std::size_t>(objects_of(variable.type).size(), 1);
            if (tuple_count_ + tuples > most)
                fail(shape.variables.front().span,
                     fmt::format("the scene has more than {} shapes, one for each tuple of objects",
                                 most),
                     "a shape over fewer variables is drawn fewer times");
        }
        tuple_count_ += tuples;
    }

    std::vector<ast::Symbol> objects_of(const std::string& type) const {
        std::vector<ast::Symbol> objects;
        for (const ast::Block& block : program_.blocks) {
            if (const auto* const domain = std::get_if<ast::Domain>(&block))
                add_members(*domain, type, objects);
            if (const auto* const values = std::get_if<ast::NonFluents>(&block))
                add_objects(values->sections, type, objects);
        }
        if (!objects.empty()) return objects;
        // The sections of the instance count if there are no others.
        for (const ast::Block& block : program_.blocks)
            if (const auto* const instance = std::get_if<ast::Instance>(&block))
                add_objects(instance->sections, type, objects);
        return objects;
    }
    static void add_members(const ast::Domain& domain, const std::string& type,
                            std::vector<ast::Symbol>& objects) {
        for (const ast::DomainSection& section : domain.sections)
            if (const auto* const types = std::get_if<ast::Types>(&section.node))
                for (const ast::TypeDeclaration& declared : types->declarations)
                    if (declared.name.text == type && declared.members)
                        for (const ast::Name& member : *declared.members)
                            objects.push_back({member.text, true});
    }
    static void add_objects(const std::vector<ast::InstanceSection>& sections,
                            const std::string& type, std::vector<ast::Symbol>& objects) {
        for (const ast::InstanceSection& section : sections)
            if (const auto* const lists = std::get_if<ast::Objects>(&section.node))
                for (const ast::ObjectList& list : lists->lists)
                    if (list.type.text == type)
                        for (const ast::Name& object : list.objects)
                            objects.push_back({object.text, false});
    }

    // The sections of the last non-fluents block, or of the instance without such a block.
    std::vector<ast::InstanceSection>* sections_of_non_fluents() {
        std::vector<ast::InstanceSection>* sections = nullptr;
        for (ast::Block& block : program_.blocks)
            if (auto* const instance = std::get_if<ast::Instance>(&block))
                sections = &instance->sections;
        for (ast::Block& block : program_.blocks)
            if (auto* const found = std::get_if<ast::NonFluents>(&block))
                sections = &found->sections;
        return sections;
    }
    void append(ast::NonFluentValues values) {
        std::vector<ast::InstanceSection>* const sections = sections_of_non_fluents();
        if (!sections) return;
        for (ast::InstanceSection& section : *sections)
            if (auto* const found = std::get_if<ast::NonFluentValues>(&section.node)) {
                std::ranges::move(values.assignments, std::back_inserter(found->assignments));
                return;
            }
        sections->push_back({std::move(values), Span{}});
    }

    ast::Program& program_;
    const Source& source_;
    Diagnostics& diagnostics_;
    Standard standard_;
    std::size_t tuple_count_ = 0;  // of objects, of all shapes
};

template <class T>
T read(const std::byte* values, std::size_t index) {
    T value;
    std::memcpy(&value, values + index * sizeof value, sizeof value);
    return value;
}

}  // namespace

SceneProgram::SceneProgram(const ProblemFiles& files, const std::filesystem::path& scene_file) {
    CompileOptions options = compile_options(files, Stage::Verify);
    options.details = true;
    constexpr std::size_t largest_scene = std::size_t{1} << 24;  // bytes
    const std::string text = read_file(scene_file, largest_scene);
    options.extend = [&](ast::Program& program, Sources& sources, Diagnostics& diagnostics) {
        const FileId file = sources.add(scene_file.string(), text);
        scene_ = read_scene(sources[file], file);
        SceneCompiler(program, sources[file], diagnostics, options.standard).add(scene_);
    };
    Compilation compilation = compile_or_give_up(options);
    if (!compilation.details->program.externals.empty())
        throw Failure("scenes of problems with external functions cannot be drawn");
    for (const auto& type : compilation.model->types)
        objects_.emplace_back(type.name, type.objects);
    details_ = std::make_unique<InterpretedDetails>(*std::move(compilation.details),
                                                    ir::ExternalFunctions{});
    find_results(*compilation.model);
    scratch_.resize(details_->get()->scratch_size);
    record_.resize(details_->get()->record_size);
}

void SceneProgram::find_results(const model::Model& model) {
    std::unordered_map<std::string, model::FluentId> fluents;
    for (model::FluentId id = 0; id < model.fluents.size(); ++id)
        fluents.emplace(model.fluents[id].name, id);
    std::unordered_map<model::FluentId, const model::Expr*> bodies;
    for (const model::Cpf& cpf : model.cpfs) bodies.emplace(cpf.fluent, &cpf.body);
    for (std::size_t e = 0; e < scene_.expressions.size(); ++e) {
        const model::FluentId id = fluents.at(name_of_expression(e));
        const auto* const cast = std::get_if<model::Convert>(&bodies.at(id)->node);
        const model::ValueType range = model.fluents[id].range;
        results_.push_back({static_cast<std::size_t>(details_->offset_of(id)), range,
                            (cast ? cast->operand->type : range) == model::bool_type});
    }
}

const std::vector<std::string>& SceneProgram::objects_of(const std::string& type) const {
    return std::ranges::find(objects_, type, [](const auto& each) { return each.first; })->second;
}

void SceneProgram::evaluate(const std::byte* state, const std::byte* action) {
    // The draws of the real step are unknown, so values that depend on them are others.
    rddl::Context<rddl::Scalar> context{};
    const rddl::Details& details = *details_->get();
    details.compute(details.self, state, action, scratch_.data(), record_.data(), context);
}

double SceneProgram::value(ExpressionIndex expression, std::size_t grounding) const {
    const Result& result = results_[expression];
    const std::byte* const begin = record_.data() + result.offset;
    if (result.range == model::bool_type)
        return static_cast<double>(begin[grounding] != std::byte{0});
    if (result.range == model::real_type) return read<double>(begin, grounding);
    return static_cast<double>(read<std::int64_t>(begin, grounding));
}

double SceneProgram::value(const SceneNumber& number, std::size_t grounding) const {
    if (const auto* const constant = std::get_if<double>(&number)) return *constant;
    return value(std::get<ExpressionIndex>(number), grounding);
}

std::string SceneProgram::shown(ExpressionIndex expression, std::size_t grounding) const {
    const Result& result = results_[expression];
    const double number = value(expression, grounding);
    if (result.is_truth) return number != 0 ? "true" : "false";
    if (result.range.kind == model::ValueType::Kind::Object)
        return objects_[result.range.type].second[static_cast<std::size_t>(number)];
    return rddl::render::number_text(number);
}

}  // namespace rddlc::workbench
