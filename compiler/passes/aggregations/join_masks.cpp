#include "passes/aggregations/join_masks.hpp"

#include "ir/analysis.hpp"
#include "ir/call.hpp"
#include "ir/nest.hpp"
#include "ir/reduction_nest.hpp"
#include "ir/rewrite.hpp"
#include "passes/aggregations/row_words.hpp"
#include "passes/analyses/constant_values.hpp"
#include "passes/analyses/few_true.hpp"

#include <algorithm>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace rddlc::passes {
namespace {

// Initially, at most one of so many is true.
constexpr std::int64_t least_per_true = 8;
// More rows are a loop.
constexpr std::int64_t most_unrolled = 4;
// The compiler evaluates the relation so often.
constexpr std::int64_t most_evaluations = 1 << 18;

using Variables = std::vector<ir::VariableId>;

bool contains(const auto& some, const auto& value) {
    return std::ranges::find(some, value) != some.end();
}

// An int that the step computes, which chooses a relation: an index into constant tables.
struct Choice {
    ir::NodeId value;
    std::int64_t count;  // it is in [0, count)
};

class Joining {
  public:
    Joining(ir::Program program, Report& report)
        : program_(std::move(program)), report_(report), builder_(program_) {}

    ir::Program run() && {
        for (ir::Definition& definition : program_.step) change(definition);
        return ir::collect_garbage(std::move(program_));
    }

  private:
    // A bool of a row that is stored for all objects of loops: whether a true element of another
    // row is related to it.
    struct Image {
        Variables rows = {}, elements = {};  // of the loops: those that choose a row, and others
        ir::Load source = {};    // its first indices choose a row, the others are `sources`
        Variables sources = {};  // of the aggregation
        std::vector<ir::NodeId> conditions = {};  // that hold or not for all of the row
        std::vector<ir::NodeId> relation = {};    // factors of sources, elements and choices
        std::vector<Choice> choices = {};
    };

    void change(ir::Definition& definition) {
        filled_ = ir::written_buffers(definition.body);
        auto* const outermost = ir::only_statement<ir::Loop>(definition.body);
        if (!outermost) return;
        const Variables variables = ir::nest_of(*outermost).variables;
        const auto* store = ir::only_statement<ir::Store>(ir::innermost_body(*outermost));
        if (!store || !is_stored_in_order(*store, variables)) return;
        const ir::Store whole = *store;
        const std::optional<Image> image = image_of(whole, variables);
        if (!image) return;
        const bool in_one = fits_one_int(*image);
        const std::optional<ir::BufferId> masks = masks_of(*image, in_one, definition.span);
        if (!masks) return;
        if (in_one)
            definition.body = {{ir::Spread{whole.target, {}, bits_of_rows(*image, *masks)}}};
        else
            definition.body = ir::looped({{spread(whole.target, *image, *masks)}}, image->rows);
        ++report_["rows of bools that are looked up"];
    }

    bool is_stored_in_order(const ir::Store& store, const Variables& variables) const {
        return program_[store.target].scalar == ir::Scalar::Bool &&
               ir::are_variables_of(program_, store.indices, {variables, nullptr});
    }

    // ------------------------------------------------------------------------------ finding

    std::optional<Image> image_of(const ir::Store& store, const Variables& variables) {
        const auto nest = ir::reduction_nest(program_, store.value);
        if (!nest || nest->op != Reduction::Exists || !is_plain(store.value)) return std::nullopt;
        std::vector<ir::NodeId> factors = ir::parts_of(program_, nest->body, Operator::And);
        const auto source =
            std::ranges::find_if(factors, [&](ir::NodeId each) { return is_source(each, *nest); });
        if (source == factors.end()) return std::nullopt;
        Image image{.source = std::get<ir::Load>(program_[*source].form),
                    .sources = nest->variables};
        factors.erase(source);

        // The row depends on these: the elements are the innermost loops without it.
        std::set<ir::VariableId> of_rows = free_variables_of(row_indices(image));
        for (const ir::NodeId factor : factors) find_choices(factor, variables, image.choices);
        for (const Choice& choice : image.choices)
            of_rows.merge(free_variables_of(std::span(&choice.value, 1)));
        auto first = variables.end();
        while (first != variables.begin() && !of_rows.contains(*std::prev(first))) --first;
        image.rows.assign(variables.begin(), first);
        image.elements.assign(first, variables.end());
        for (const ir::NodeId factor : factors)
            (is_same_for_row(factor, image) ? image.conditions : image.relation).push_back(factor);
        if (!are_related(image) || image.choices.empty()) return std::nullopt;
        return image;
    }

    // Neither a draw nor a fault, nor what the definition itself computes, is part of it.
    bool is_plain(ir::NodeId id) const {
        return ir::is_droppable(builder_.properties(id)) &&
               ir::is_known_before(program_, id, filled_);
    }
    // An element of the state whose last indices are all variables of the aggregation.
    bool is_source(ir::NodeId id, const ir::ReductionNest& nest) const {
        const auto* load = std::get_if<ir::Load>(&program_[id].form);
        if (!load || !begins_with_few_true(program_[load->buffer], least_per_true) ||
            load->indices.size() < nest.variables.size() ||
            !ir::ends_with(program_, load->indices, {nest.variables, nullptr}))
            return false;
        const std::size_t leading = load->indices.size() - nest.variables.size();
        return program_[load->buffer].row_size(leading) <= bits_of_an_int &&
               std::all_of(load->indices.begin(),
                           load->indices.begin() + static_cast<std::ptrdiff_t>(leading),
                           [&](ir::NodeId index) {
                               return builder_.properties(index).uniform &&
                                      !depends_on(index, nest.variables);
                           });
    }
    static std::span<const ir::NodeId> row_indices(const Image& image) {
        return std::span(image.source.indices)
            .first(image.source.indices.size() - image.sources.size());
    }

    std::set<ir::VariableId> free_variables_of(std::span<const ir::NodeId> ids) const {
        std::set<ir::VariableId> variables;
        for (const ir::NodeId id : ids)
            variables.insert(builder_.properties(id).free_variables.begin(),
                             builder_.properties(id).free_variables.end());
        return variables;
    }
    bool depends_on(ir::NodeId id, const Variables& variables) const {
        return ir::depends_on_any(builder_.properties(id), variables);
    }

    // Indices into constant tables that the step computes, whatever the sources are: `loops` alone
    // bind what they depend on.
    void find_choices(ir::NodeId id, const Variables& loops, std::vector<Choice>& choices) const {
        const auto* load = std::get_if<ir::Load>(&program_[id].form);
        if (load && program_[load->buffer].storage == ir::Storage::Constant) {
            for (std::size_t axis = 0; axis < load->indices.size(); ++axis) {
                const ir::NodeId index = load->indices[axis];
                if (const ir::Properties& properties = builder_.properties(index);
                    !properties.uniform && ir::depends_on_none_but(properties, loops) &&
                    !contains_value(choices, index))
                    choices.push_back({index, program_[load->buffer].shape[axis]});
            }
        }
        for (const ir::NodeId operand : ir::operands_of(program_[id]))
            find_choices(operand, loops, choices);
    }
    static bool contains_value(const std::vector<Choice>& choices, ir::NodeId value) {
        return std::ranges::find(choices, value, &Choice::value) != choices.end();
    }

    bool is_same_for_row(ir::NodeId factor, const Image& image) const {
        return !depends_on(factor, image.sources) && !depends_on(factor, image.elements);
    }

    // The constants, and the choices, say which sources are related to which elements.
    bool are_related(const Image& image) const {
        const std::int64_t elements = ir::combinations(program_, image.elements);
        return elements > 1 && elements <= bits_of_an_int &&
               std::ranges::all_of(image.relation,
                                   [&](ir::NodeId factor) { return is_decided(factor, image); });
    }
    bool is_decided(ir::NodeId id, const Image& image) const {
        if (contains_value(image.choices, id)) return true;
        const ir::Node& node = program_[id];
        const auto buffer = ir::buffer_read_by(node);
        if (buffer && program_[*buffer].storage != ir::Storage::Constant) return false;
        const auto* index = std::get_if<ir::Index>(&node.form);
        if (index && contains(image.rows, index->variable)) return false;
        return std::ranges::all_of(ir::operands_of(node),
                                   [&](ir::NodeId operand) { return is_decided(operand, image); });
    }

    // ------------------------------------------------------------------------------- making

    // All rows of both tables: then the bits are moved between ints and tables once.
    bool fits_one_int(const Image& image) const {
        const std::int64_t rows = ir::combinations(program_, image.rows);
        const std::int64_t sources = ir::combinations(program_, image.sources);
        const std::int64_t elements = ir::combinations(program_, image.elements);
        return rows > 1 && rows <= most_unrolled &&
               rows * std::max(sources, elements) <= bits_of_an_int &&
               row_indices(image).size() == image.rows.size() &&
               ir::begins_with(program_, image.source.indices, {image.rows, nullptr});
    }

    // Not by their product, which may be too great for an int.
    bool can_be_evaluated(const Variables& variables) const {
        std::int64_t left = most_evaluations;
        for (const ir::VariableId variable : variables)
            left /= std::max<std::int64_t>(1, program_[variable].size);
        return left > 0;
    }

    // A row for each combination of choices, with a mask of elements for each source: for one row
    // of the tables, or for all of them, each with its own bits.
    std::optional<ir::BufferId> masks_of(const Image& image, bool of_all_rows, Span span) {
        Variables variables;
        std::map<ir::NodeId, ir::NodeId> chosen;
        std::vector<std::int64_t> shape;
        for (const Choice& choice : image.choices) {
            variables.push_back(variable(choice.count, variables.size()));
            chosen[choice.value] = builder_.index(variables.back());
            shape.push_back(choice.count);
        }
        variables.insert(variables.end(), image.sources.begin(), image.sources.end());
        shape.push_back(ir::combinations(program_, image.sources));
        variables.insert(variables.end(), image.elements.begin(), image.elements.end());
        if (!can_be_evaluated(variables)) return std::nullopt;

        ir::NodeId related = builder_.constant(true);
        for (const ir::NodeId factor : image.relation)
            related =
                builder_.apply(Operator::And, {related, ir::replace_in(builder_, factor, chosen)});
        const ir::Evaluator evaluator(std::as_const(program_));
        const auto values = constant_values(evaluator, program_, related, variables);
        if (!values) return std::nullopt;
        const std::int64_t size = ir::combinations(program_, image.elements);
        const std::int64_t sources = shape.back();
        const std::int64_t rows = of_all_rows ? ir::combinations(program_, image.rows) : 1;
        std::vector<ir::Value> masks;
        std::vector<std::uint64_t> of_row;
        for (std::int64_t first = 0; first < std::ssize(*values); first += size) {
            std::uint64_t mask = 0;
            for (std::int64_t i = 0; i < size; ++i)
                mask |=
                    std::uint64_t{std::get<bool>((*values)[static_cast<std::size_t>(first + i)])}
                    << i;
            of_row.emplace_back(mask);
            for (std::int64_t row = 0; row < rows && std::ssize(of_row) == sources; ++row)
                for (const std::uint64_t each : of_row)
                    masks.emplace_back(static_cast<std::int64_t>(each << row * size));
            if (std::ssize(of_row) == sources) of_row.clear();
        }
        shape.back() *= rows;
        return builder_.tables().constant({.name = program_[image.source.buffer].name + "-masks",
                                           .storage = ir::Storage::Constant,
                                           .scalar = ir::Scalar::Int,
                                           .shape = std::move(shape),
                                           .values = std::move(masks),
                                           .span = span});
    }

    // The k-th variable over so many choices.
    ir::VariableId variable(std::int64_t count, std::size_t k) {
        const auto [known, is_new] = variables_.try_emplace({count, k});
        if (is_new) {
            known->second = {static_cast<std::uint32_t>(program_.variables.size())};
            program_.variables.push_back({"choice", std::nullopt, count});
        }
        return known->second;
    }

    ir::Spread spread(ir::BufferId target, const Image& image, ir::BufferId masks) {
        const std::span<const ir::NodeId> row = row_indices(image);
        std::vector<ir::NodeId> indices;
        for (const ir::VariableId each : image.rows) indices.push_back(builder_.index(each));
        const ir::NodeId source = builder_.bits(image.source.buffer, 0, {row.begin(), row.end()});
        return {target, std::move(indices), reached(image, masks, source, {})};
    }

    // Ones for the elements that the sources reach. `known` are the objects of the row.
    ir::NodeId reached(const Image& image, ir::BufferId masks, ir::NodeId sources,
                       std::map<ir::NodeId, ir::NodeId> known) {
        std::vector<ir::NodeId> choices;
        for (const Choice& choice : image.choices)
            choices.push_back(ir::replace_in(builder_, choice.value, known));
        ir::NodeId bits = builder_.united(masks, std::move(choices), sources);
        for (const ir::NodeId condition : image.conditions)
            bits = builder_.select(ir::replace_in(builder_, condition, known), bits,
                                   builder_.constant(std::int64_t{0}));
        return bits;
    }

    ir::NodeId bits_of_rows(const Image& image, ir::BufferId masks) {
        const ir::NodeId all = builder_.bits(image.source.buffer, 0);
        const std::int64_t size = ir::combinations(program_, image.sources);
        ir::NodeId joined = builder_.constant(std::int64_t{0});
        for (std::int64_t row = 0; row < ir::combinations(program_, image.rows); ++row) {
            std::map<ir::NodeId, ir::NodeId> known = ir::combination(builder_, image.rows, row);
            const auto ones = static_cast<std::uint64_t>(first_bits(size));
            const ir::NodeId own = builder_.apply(
                Operator::BitAnd,
                {all, builder_.constant(static_cast<std::int64_t>(ones << row * size))});
            joined = builder_.apply(Operator::BitOr,
                                    {joined, reached(image, masks, own, std::move(known))});
        }
        return joined;
    }

    ir::Program program_;
    Report& report_;
    ir::Builder builder_;
    std::set<ir::BufferId> filled_;  // by the current definition
    std::map<std::pair<std::int64_t, std::size_t>, ir::VariableId> variables_;
};

}  // namespace

ir::Program join_masks(ir::Program program, Report& report) {
    return Joining(std::move(program), report).run();
}

}  // namespace rddlc::passes
