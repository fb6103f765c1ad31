#include "passes/aggregations/tabulate_products.hpp"

#include "ir/analysis.hpp"
#include "ir/rewrite.hpp"
#include "passes/aggregations/row_words.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <utility>
#include <vector>

namespace rddlc::passes {
namespace {

// Fewer factors are multiplied in the time that their bits take.
constexpr std::size_t least_factors = 8;
// Registers hold tables of so many bools (rddl/lanes/simd_moves.hpp).
constexpr std::int64_t bools_of_table = 5;

// A factor that element `element` of a row of bools decides.
struct ChosenFactor {
    ir::BufferId buffer;
    std::vector<ir::NodeId> row;  // the leading indices
    std::int64_t element;
    double if_true, if_false;
};

class ProductsOfBools {
  public:
    ProductsOfBools(ir::Program program, Report& report)
        : program_(std::move(program)), report_(report), builder_(program_) {}

    ir::Program run() && {
        std::map<ir::NodeId, ir::NodeId> done;
        const auto find = [this](ir::NodeId id) {
            return looked_up(id);
        };
        ir::change_roots(
            program_, [&](ir::NodeId& root) { root = ir::replace_in(builder_, root, done, find); });
        return ir::collect_garbage(std::move(program_));
    }

  private:
    std::optional<ir::NodeId> looked_up(ir::NodeId id) {
        std::vector<ChosenFactor> factors;
        const bool may_be = program_[id].type == ir::Scalar::Real && is_product(id) &&
                            collect_factors(id, factors) && factors.size() >= least_factors &&
                            are_of_different_bools(factors) && never_round(factors);
        if (!may_be) return std::nullopt;
        ++report_["products of bools looked up"];
        return product(factors);
    }

    // ----------------------------------------------------------------------------- factors

    bool is_product(ir::NodeId id) const {
        const auto* apply = std::get_if<ir::Apply>(&program_[id].form);
        const auto* reduce = std::get_if<ir::Reduce>(&program_[id].form);
        return (apply && apply->op == Operator::Multiply) ||
               (reduce && reduce->op == Reduction::Product && !reduce->bounds);
    }

    // False if there is another factor.
    bool collect_factors(ir::NodeId id, std::vector<ChosenFactor>& factors) {
        if (ir::constant<double>(program_, id) == 1.0) return true;
        const ir::Node node = program_[id];
        if (const auto* apply = std::get_if<ir::Apply>(&node.form); apply && is_product(id))
            return collect_factors(apply->operands.front(), factors) &&
                   collect_factors(apply->operands.back(), factors);
        if (const auto* reduce = std::get_if<ir::Reduce>(&node.form); reduce && is_product(id))
            return collect_factors(*reduce, factors);
        const auto factor = factor_of(id);
        if (factor) factors.push_back(*factor);
        return factor.has_value();
    }

    bool collect_factors(const ir::Reduce& reduce, std::vector<ChosenFactor>& factors) {
        const std::int64_t size = program_[reduce.variable].size;
        if (size > bits_of_an_int) return false;
        for (std::int64_t i = 0; i < size; ++i) {
            std::map<ir::NodeId, ir::NodeId> known =
                ir::combination(builder_, {&reduce.variable, 1}, i);
            if (!collect_factors(ir::replace_in(builder_, reduce.body, known), factors))
                return false;
        }
        return true;
    }

    // select(row[3], 0.5, 1.0), real(row[3]) or real(!row[3])
    std::optional<ChosenFactor> factor_of(ir::NodeId id) {
        if (const auto* select = std::get_if<ir::Select>(&program_[id].form)) {
            const auto a = ir::constant<double>(program_, select->then_value),
                       b = ir::constant<double>(program_, select->else_value);
            return a && b ? factor_of(select->condition, *a, *b) : std::nullopt;
        }
        const auto holds = ir::converted_bool(program_, id);
        return holds ? factor_of(*holds, 1, 0) : std::nullopt;
    }

    std::optional<ChosenFactor> factor_of(ir::NodeId condition, double if_true, double if_false) {
        const ir::Node& node = program_[condition];
        const auto* apply = std::get_if<ir::Apply>(&node.form);
        if (apply && apply->op == Operator::Not)
            return factor_of(apply->operands.front(), if_false, if_true);
        const auto* load = std::get_if<ir::Load>(&node.form);
        const auto row = load ? uniform_row_of(builder_, *load) : std::nullopt;
        if (!row || program_[load->buffer].shape.back() > bits_of_an_int) return std::nullopt;
        const auto element = ir::constant<std::int64_t>(program_, load->indices.back());
        if (!element) return std::nullopt;
        return ChosenFactor{load->buffer, *row, *element, if_true, if_false};
    }

    // In one row.
    static bool are_of_different_bools(const std::vector<ChosenFactor>& factors) {
        const ChosenFactor& first = factors.front();
        std::uint64_t known = 0;
        return std::ranges::all_of(factors, [&](const ChosenFactor& each) {
            const std::uint64_t bit = std::uint64_t{1} << each.element;
            const bool is_new = (std::exchange(known, known | bit) & bit) == 0;
            return is_new && each.buffer == first.buffer && each.row == first.row;
        });
    }

    // ---------------------------------------------------------------------------- rounding

    bool never_round(const std::vector<ChosenFactor>& factors) const {
        const bool are_floats = program_.real == RealType::Float;
        const int bits =
            are_floats ? std::numeric_limits<float>::digits : std::numeric_limits<double>::digits;
        const int most_doublings = are_floats ? 100 : 1000;
        double odd_parts = 1;
        double doublings = 0;  // or halvings
        for (const ChosenFactor& factor : factors) {
            if (is_zero(factor.if_true) && is_zero(factor.if_false)) return false;
            double odd_part = 1;
            int exponent = 0;
            for (const double value : {factor.if_true, factor.if_false}) {
                if (is_zero(value)) continue;
                if (!(value > 0) || !std::isfinite(value)) return false;
                odd_part = std::max(odd_part, odd_part_of(value));
                exponent = std::max(exponent, std::abs(std::ilogb(value)) + 1);
            }
            odd_parts *= odd_part;
            doublings += exponent;
        }
        return odd_parts <= std::ldexp(1, bits) && doublings <= most_doublings;
    }

    // A positive value without its factors of 2.
    static double odd_part_of(double value) {
        int exponent = 0;
        const double scaled = std::ldexp(std::frexp(value, &exponent), 53);
        const auto whole = static_cast<std::uint64_t>(scaled);
        return static_cast<double>(whole >> std::countr_zero(whole));
    }

    // Not -0.0, which would change signs.
    static bool is_zero(double value) { return std::bit_cast<std::uint64_t>(value) == 0; }

    // ----------------------------------------------------------------------------- product

    // The product by tables, where no factor is 0.
    ir::NodeId product(const std::vector<ChosenFactor>& factors) {
        std::uint64_t tested = 0, wanted = 0;
        for (const ChosenFactor& factor : factors) {
            const std::uint64_t bit = std::uint64_t{1} << factor.element;
            if (is_zero(factor.if_true) || is_zero(factor.if_false)) tested |= bit;
            if (is_zero(factor.if_false)) wanted |= bit;
        }
        const ir::NodeId all = product_by_tables(factors);
        if (tested == 0) return all;
        const auto word = [&](std::uint64_t bits) {
            return builder_.constant(static_cast<std::int64_t>(bits));
        };
        const ir::NodeId some = builder_.apply(Operator::BitAnd, {bits(factors), word(tested)});
        const ir::NodeId is_nonzero = builder_.apply(Operator::Equal, {some, word(wanted)});
        return builder_.select(is_nonzero, all, builder_.constant(0.0));
    }

    ir::NodeId product_by_tables(const std::vector<ChosenFactor>& factors) {
        std::optional<ir::NodeId> all;
        const std::int64_t size = program_[factors.front().buffer].shape.back();
        for (std::int64_t first = 0; first < size; first += bools_of_table) {
            const std::vector<ir::Value> products = products_from(factors, first);
            const bool is_one = std::ranges::all_of(
                products, [](const ir::Value& value) { return value == ir::Value(1.0); });
            if (is_one) continue;
            const ir::Buffer& row = program_[factors.front().buffer];
            const ir::BufferId table = builder_.tables().list(row.name + "-products",
                                                              ir::Scalar::Real, products, row.span);
            const auto last = static_cast<std::int64_t>(products.size()) - 1;
            const ir::NodeId place = builder_.apply(
                Operator::BitAnd, {bits_from(bits(factors), first), builder_.constant(last)});
            const ir::NodeId some = builder_.load(table, {place});
            all = all ? builder_.apply(Operator::Multiply, {*all, some}) : some;
        }
        return all.value_or(builder_.constant(1.0));
    }

    // The products of the factors other than 0 of the elements [first, first + bools_of_table).
    std::vector<ir::Value> products_from(const std::vector<ChosenFactor>& factors,
                                         std::int64_t first) const {
        std::vector<ir::Value> products;
        for (std::int64_t bits = 0; bits < std::int64_t{1} << bools_of_table; ++bits) {
            double product = 1;
            for (const ChosenFactor& factor : factors) {
                const std::int64_t bit = factor.element - first;
                if (bit < 0 || bit >= bools_of_table) continue;
                const double value = (bits >> bit & 1) != 0 ? factor.if_true : factor.if_false;
                if (!is_zero(value)) product *= value;
            }
            products.emplace_back(product);
        }
        return products;
    }

    ir::NodeId bits(const std::vector<ChosenFactor>& factors) {
        return builder_.bits(factors.front().buffer, 0, factors.front().row);
    }
    ir::NodeId bits_from(ir::NodeId bits, std::int64_t first) {
        if (first == 0) return bits;
        return builder_.apply(Operator::ShiftRight, {bits, builder_.constant(first)});
    }

    ir::Program program_;
    Report& report_;
    ir::Builder builder_;
};

}  // namespace

ir::Program tabulate_products(ir::Program program, Report& report) {
    return ProductsOfBools(std::move(program), report).run();
}

}  // namespace rddlc::passes
