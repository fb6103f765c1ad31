// Over 400 lines: a rule of the IR after the other, for each kind of node and statement.
#include "ir/verify.hpp"

#include "ir/action_bools.hpp"
#include "ir/analysis.hpp"
#include "ir/call.hpp"
#include "ir/print.hpp"
#include "ir/row_of_bools.hpp"
#include "ir/shifted_row.hpp"
#include "support/failure.hpp"
#include "support/match.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdlib>
#include <map>
#include <set>
#include <string_view>
#include <tuple>

namespace rddlc::ir {
namespace {

using StorageSet = std::set<Storage>;

class Verifier {
  public:
    explicit Verifier(const Program& program) : program_(program) {}

    std::vector<std::string> complaints() && {
        buffers();
        if (pool_is_sound()) {
            properties_ = all_properties(program_);
            nodes();
            reset();
            step();
            conditions();
            policy();
        }
        return std::move(complaints_);
    }

  private:
    template <class... Arguments>
    void require(bool ok, fmt::format_string<Arguments...> format, Arguments&&... arguments) {
        if (ok) return;
        complaints_.push_back(fmt::format(format, std::forward<Arguments>(arguments)...));
    }

    // ------------------------------------------------------------------------ buffers

    void buffers() {
        for (const Buffer& buffer : program_.buffers) {
            require(buffer.types.empty() || buffer.shape.size() == buffer.types.size(),
                    "'{}' has {} axes of {} types", buffer.name, buffer.shape.size(),
                    buffer.types.size());
            values(buffer);
        }
        std::map<Likeness, int> counts;
        for (const Buffer& buffer : program_.buffers) ++counts[likeness(buffer, buffer.storage)];
        const bool makes_states = std::ranges::any_of(
            program_.buffers, [](const Buffer& buffer) { return buffer.storage == Storage::Next; });
        for (const Buffer& buffer : program_.buffers) {
            if (buffer.storage == Storage::State && makes_states)
                require(counts[likeness(buffer, Storage::Next)] == 1, "'{}' has no next state",
                        buffer.name);
            if (buffer.storage == Storage::Memory)
                require(counts[likeness(buffer, Storage::NextMemory)] == 1,
                        "'{}' has no next memory", buffer.name);
        }
        for (const Fluent& fluent : program_.fluents) {
            require(!fluent.buffer || fluent.buffer->index < program_.buffers.size(),
                    "'{}' has no such buffer", fluent.name);
        }
    }

    void values(const Buffer& buffer) {
        const StorageSet with_values = {Storage::Constant, Storage::State, Storage::Action,
                                        Storage::Memory};
        const bool has_values = with_values.contains(buffer.storage);
        const std::int64_t expected = has_values ? buffer.count() : 0;
        require(buffer.values.size() == expected, "'{}' has {} values instead of {}", buffer.name,
                buffer.values.size(), expected);
        const auto typed = [&](const Value& value) {
            return scalar_of(value) == buffer.scalar;
        };
        require(buffer.values.all_of(typed), "'{}' has values of another type", buffer.name);
    }

    // The common properties of a buffer and that of its next value, apart from the storage.
    using Likeness = std::tuple<std::string_view, std::vector<std::int64_t>, Scalar, Storage>;
    static Likeness likeness(const Buffer& buffer, Storage storage) {
        return {buffer.name, buffer.shape, buffer.scalar, storage};
    }

    // -------------------------------------------------------------------------- nodes

    // Ids are within their tables, and operands come first: the rest may follow them.
    bool pool_is_sound() {
        const std::size_t before = complaints_.size();
        for (std::uint32_t index = 0; index < program_.nodes.size(); ++index) {
            for (NodeId operand : operands_of(program_.nodes[index])) {
                require(operand.index < index, "node {} uses node {}, which is not before it",
                        index, operand.index);
            }
            ids_are_known(program_.nodes[index]);
        }
        for (NodeId root : roots_of(program_)) {
            require(root.index < program_.nodes.size(), "there is no node {}", root.index);
        }
        for (const Block* block : blocks_of(program_)) ids_are_known(*block);
        return complaints_.size() == before;
    }

    void ids_are_known(const Node& node) {
        if (const auto buffer = buffer_read_by(node)) id_is_known(*buffer);
        if (const auto* local = std::get_if<Local>(&node.form)) {
            require(local->local.index < program_.local_count, "there is no local {}",
                    local->local.index);
        }
        if (const auto* index = std::get_if<Index>(&node.form)) {
            require(index->variable.index < program_.variables.size(), "there is no variable {}",
                    index->variable.index);
        }
        if (const auto variable = bound_variable(node)) {
            require(variable->index < program_.variables.size(), "there is no variable {}",
                    variable->index);
        }
        if (const auto place = place_of(node)) {
            require(place->site.index < program_.sites.size(), "there is no site {}",
                    place->site.index);
        }
    }

    void ids_are_known(const Block& block) {
        for (const Statement& statement : block) {
            match(
                statement.form, [](const Let&) {},  // its local is checked where it is defined
                [&](const Store& store) {
                    require(store.target.index < program_.buffers.size(), "there is no buffer {}",
                            store.target.index);
                },
                [&](const Spread& spread) { id_is_known(spread.target); },
                [&](const Loop& loop) {
                    require(loop.variable.index < program_.variables.size(),
                            "there is no variable {}", loop.variable.index);
                    ids_are_known(loop.body);
                },
                [&](const Visit& visit) {
                    for (const Mark& mark : visit.marks) id_is_known(mark.target);
                    id_is_known(visit.visited);
                    if (!visit.entries) return;
                    id_is_known(visit.entries->rows);
                    id_is_known(visit.entries->variable);
                },
                [&](const Call& call) { ids_are_known(call); });
        }
    }

    void ids_are_known(const Call& call) {
        for (const TableView& input : call.inputs) id_is_known(input.buffer);
        id_is_known(call.output.buffer);
        require(!call.place || call.place->site.index < program_.sites.size(),
                "there is no site {}", call.place ? call.place->site.index : 0);
        const auto* external = std::get_if<ExternalId>(&call.callee);
        require(!external || external->index < program_.externals.size(),
                "there is no external function {}", external ? external->index : 0);
    }

    void id_is_known(VariableId variable) {
        require(variable.index < program_.variables.size(), "there is no variable {}",
                variable.index);
    }
    void id_is_known(BufferId buffer) {
        require(buffer.index < program_.buffers.size(), "there is no buffer {}", buffer.index);
    }

    void nodes() {
        const std::vector<bool> reachable = reachable_nodes(program_);
        std::vector<int> site_uses = calls_by_site();
        bound_below_.resize(program_.nodes.size());
        for (std::uint32_t index = 0; index < program_.nodes.size(); ++index) {
            if (!reachable[index]) continue;
            const Node& node = program_.nodes[index];
            const bool typed =
                match(node.form, [&](const auto& form) { return fits(form, node.type); });
            require(typed, "types do not fit in '{}'", text_unless(typed, {index}));
            not_bound_inside_itself({index});
            const auto place = place_of(node);
            if (!place) continue;
            const bool is_int = type(place->index) == Scalar::Int;
            require(is_int, "the place of '{}' is not an int", text_unless(is_int, {index}));
            ++site_uses[place->site.index];
        }
        for (std::size_t site = 0; site < site_uses.size(); ++site) {
            require(site_uses[site] <= 1, "site {} is used {} times", site, site_uses[site]);
            numbers_fit(program_.sites[site]);
        }
    }

    // The text for complaints: printing every node would take the square of their number.
    std::string text_unless(bool ok, NodeId id) const { return ok ? "" : print(program_, id); }

    void numbers_fit(const Site& site) {
        if (!site.series) return;
        const bool is_known = site.series->index < program_.sites.size();
        require(is_known && program_[*site.series].scope == site.scope, "{} has the numbers of {}",
                site.what, site.series->index);
    }

    std::vector<int> calls_by_site() const {
        std::vector<int> uses(program_.sites.size());
        for (const Block* block : blocks_of(program_)) {
            for_each_statement<Call>(*block, [&](const Call& call) {
                if (call.place) ++uses[call.place->site.index];
            });
        }
        return uses;
    }

    void not_bound_inside_itself(NodeId binder) {
        std::vector<VariableId>& bound = bound_below_[binder.index];
        for (NodeId operand : operands_of(program_[binder]))
            bound = united(bound, bound_below_[operand.index]);
        const auto variable = bound_variable(program_[binder]);
        if (!variable) return;
        const auto& inside = bound_below_[operands_of(program_[binder]).front().index];
        require(!std::ranges::binary_search(inside, *variable), "'{}' is bound inside itself",
                program_[*variable].name);
        bound = united(bound, {*variable});
    }

    static std::vector<VariableId> united(const std::vector<VariableId>& a,
                                          const std::vector<VariableId>& b) {
        if (b.empty()) return a;
        std::vector<VariableId> both;
        std::ranges::set_union(a, b, std::back_inserter(both));
        return both;
    }

    bool fits(const Constant& form, Scalar type) const { return scalar_of(form.value) == type; }
    bool fits(const Index&, Scalar type) const { return type == Scalar::Int; }
    bool fits(const Load& form, Scalar type) const {
        const Buffer& buffer = program_[form.buffer];
        return type == buffer.scalar && are_indices(buffer, form.indices);
    }
    static bool is_sorted(const Table& table) {
        for (std::int64_t i = 1; i < table.size(); ++i) {
            if (table[i] < table[i - 1]) return false;
        }
        return true;
    }
    bool fits(const Search& form, Scalar result) const {
        const Buffer& table = program_[form.table];
        return result == Scalar::Int && type(form.value) == table.scalar &&
               table.scalar != Scalar::Bool && table.storage == Storage::Constant &&
               table.shape.size() == 1 && is_sorted(table.values);
    }
    bool fits(const Bits& form, Scalar result) const {
        const Buffer& buffer = program_[form.buffer];
        return result == Scalar::Int && buffer.scalar == Scalar::Bool &&
               buffer.storage != Storage::Constant && form.first >= 0 && form.first % 64 == 0 &&
               are_leading(buffer, form.indices) && are_uniform(form.indices) &&
               form.first < buffer.row_size(form.indices.size());
    }
    bool are_leading(const Buffer& buffer, const std::vector<NodeId>& indices) const {
        return indices.size() <= buffer.shape.size() &&
               std::ranges::all_of(indices, [&](NodeId id) { return type(id) == Scalar::Int; });
    }
    bool are_uniform(const std::vector<NodeId>& indices) const {
        return std::ranges::all_of(indices,
                                   [&](NodeId id) { return properties_[id.index].uniform; });
    }
    bool fits(const Union& form, Scalar result) const {
        const Buffer& masks = program_[form.masks];
        return result == Scalar::Int && masks.scalar == Scalar::Int &&
               masks.storage == Storage::Constant && form.row.size() + 1 == masks.shape.size() &&
               are_leading(masks, form.row) && masks.shape.back() <= 64 &&
               type(form.bits) == Scalar::Int;
    }
    bool fits(const Element& form, Scalar result) const {
        const Buffer& buffer = program_[form.buffer];
        return result == Scalar::Bool && buffer.scalar == Scalar::Bool &&
               buffer.storage != Storage::Constant && type(form.place) == Scalar::Int &&
               are_leading(buffer, form.indices);
    }
    bool fits(const Local&, Scalar) const { return true; }  // compared with its Let
    bool fits(const Convert& form, Scalar to) const {
        return type(form.operand) < to && (!form.skips_int || rounds(form.operand));
    }
    bool rounds(NodeId id) const {
        const auto* apply = std::get_if<Apply>(&program_[id].form);
        return apply && typing_of(apply->op) == Typing::Rounding;
    }
    bool fits(const Select& form, Scalar result) const {
        return type(form.condition) == Scalar::Bool && type(form.then_value) == result &&
               type(form.else_value) == result && may_be_evaluated_so(form);
    }
    bool may_be_evaluated_so(const Select& form) const {
        const Properties& first = properties_[form.then_value.index];
        const Properties& second = properties_[form.else_value.index];
        switch (form.evaluated) {
            case Evaluated::Branch:
            case Evaluated::MostlyFirst:
            case Evaluated::Jump:
                return true;
            case Evaluated::PackBoth:
                return is_droppable(first) && is_droppable(second);
            case Evaluated::Both:
                return !is_lazy(program_, form, first, second);
        }
        return false;
    }
    bool fits(const Apply& form, Scalar result) const {
        if (form.operands.size() != static_cast<std::size_t>(arity_of(form.op))) return false;
        const Scalar operand = type(form.operands.front());
        if (type(form.operands.back()) != operand) return false;
        if (form.place.has_value() != may_fault(form.op, operand == Scalar::Int)) return false;
        return fits(form.op, operand, result) && right_operand_is_lazy_enough(form);
    }
    // C++ spells these && and ||, which would hide a fault of the right operand.
    bool right_operand_is_lazy_enough(const Apply& form) const {
        const bool connective =
            form.op == Operator::And || form.op == Operator::Or || form.op == Operator::Implies;
        return !connective || !properties_[form.operands.back().index].may_fault;
    }
    static bool fits(Operator op, Scalar operand, Scalar result) {
        const bool is_bool = operand == Scalar::Bool;
        switch (typing_of(op)) {
            case Typing::Equality:
                return result == Scalar::Bool;
            case Typing::Order:
                return !is_bool && result == Scalar::Bool;
            case Typing::Logic:
                return is_bool && result == Scalar::Bool;
            case Typing::Numbers:
                return !is_bool && result == operand;
            case Typing::Ints:
                return operand == Scalar::Int && result == Scalar::Int;
            case Typing::Reals:
                return operand == Scalar::Real && result == Scalar::Real;
            case Typing::Rounding:
                return operand == Scalar::Real && result == Scalar::Int;
            case Typing::Sign:
                return !is_bool && result == Scalar::Int;
        }
        return false;
    }
    bool fits(const Reduce& form, Scalar result) const {
        const Scalar body = type(form.body);
        if (form.bounds && !are_uniform_ints(*form.bounds)) return false;
        if (form.over_true && !row_of_bools(program_, form) && !table_of_bools(program_, form))
            return false;
        const bool quantifies = is_quantifier(form.op);
        if (form.several_at_once && (!quantifies || form.bounds)) return false;
        const bool empty = program_[form.variable].size == 0 || form.bounds;
        switch (form.op) {
            case Reduction::ForAll:
            case Reduction::Exists:
                return body == Scalar::Bool && result == Scalar::Bool;
            case Reduction::Sum:
            case Reduction::Product:
                return body != Scalar::Bool && result == body;
            case Reduction::Minimum:
            case Reduction::Maximum:
                return body != Scalar::Bool && result == body && !empty;
            case Reduction::ArgMin:
            case Reduction::ArgMax:
                return body != Scalar::Bool && result == Scalar::Int && !empty;
            case Reduction::Average:
                return false;
        }
        return false;
    }
    bool are_uniform_ints(const Bounds& bounds) const {
        return type(bounds.begin) == Scalar::Int && type(bounds.end) == Scalar::Int &&
               properties_[bounds.begin.index].uniform && properties_[bounds.end.index].uniform;
    }
    bool fits(const Sample& form, Scalar result) const {
        if (form.parameters.size() != arity_of(form.distribution)) return false;
        for (std::size_t i = 0; i < form.parameters.size(); ++i) {
            const Scalar taken = takes_int(form.distribution, i) ? Scalar::Int : Scalar::Real;
            if (type(form.parameters[i]) != taken) return false;
        }
        return drawn(form.distribution) == result &&
               (!form.is_valid || form.distribution == Distribution::Bernoulli);
    }
    static std::optional<Scalar> drawn(Distribution distribution) {
        switch (drawn_by(distribution)) {
            case Drawn::Bool:
                return Scalar::Bool;
            case Drawn::Int:
                return Scalar::Int;
            case Drawn::Real:
                return Scalar::Real;
            case Drawn::AsGiven:
                break;
        }
        return std::nullopt;
    }
    bool fits(const Discrete& form, Scalar result) const {
        const auto is_real = [&](NodeId id) {
            return type(id) == Scalar::Real;
        };
        return result == Scalar::Int && !form.weights.empty() &&
               std::ranges::all_of(form.weights, is_real);
    }
    bool fits(const DiscreteOver& form, Scalar result) const {
        return result == Scalar::Int && type(form.weight) == Scalar::Real &&
               program_[form.variable].size > 0;
    }
    bool fits(const Interval& form, Scalar result) const {
        const Buffer& table = program_[form.table];
        const auto is_int = [&](NodeId id) {
            return type(id) == Scalar::Int;
        };
        return result == Scalar::Int && table.scalar == Scalar::Real &&
               table.storage == Storage::Constant && form.row.size() + 1 == table.shape.size() &&
               std::ranges::all_of(form.row, is_int) && has_sorted_rows(table);
    }
    static bool has_sorted_rows(const Buffer& table) {
        for (std::int64_t i = 1; i < table.values.size(); ++i) {
            const bool is_first = i % table.shape.back() == 0;
            if (!is_first && table.values[i] < table.values[i - 1]) return false;
        }
        return true;
    }
    bool fits(const Fault&, Scalar) const { return true; }

    bool are_indices(const Buffer& buffer, const std::vector<NodeId>& indices) const {
        const auto is_int = [&](NodeId id) {
            return type(id) == Scalar::Int;
        };
        return indices.size() == buffer.shape.size() && std::ranges::all_of(indices, is_int);
    }

    Scalar type(NodeId id) const { return program_[id].type; }

    // --------------------------------------------------------------------- statements

    // The names that a statement may use.
    struct Scope {
        std::set<VariableId> variables;
        std::set<LocalId> locals;
    };

    void reset() {
        computed_ = {Storage::Scratch, Storage::State};
        for (const Definition& definition : program_.reset) {
            defined_.clear();
            body(definition.body, {Storage::Constant, Storage::Scratch});
        }
        defined_.clear();
    }

    void step() {
        const StorageSet readable = {Storage::Constant, Storage::State, Storage::Action,
                                     Storage::Scratch, Storage::Next};
        computed_ = {Storage::Scratch, Storage::Next, Storage::Observation};
        definitions(program_.step, readable);
        computation("reward", program_.reward, Scalar::Real, readable);
    }

    void policy() {
        if (!program_.policy) return;
        const StorageSet readable = {
            Storage::Constant,
            Storage::Memory,
            Storage::Scratch,
            Storage::Action,
            Storage::NextMemory,
            program_.partially_observed() ? Storage::Observation : Storage::State};
        computed_ = {Storage::Scratch, Storage::Action, Storage::NextMemory};
        defined_.clear();
        definitions(program_.policy->act, readable);
    }

    void unchosen(const Definition& definition) {
        const Buffer& target = program_[definition.target];
        require(
            std::ranges::all_of(definition.unchosen->choices,
                                [&](BufferId choice) { return is_action_bools(program_[choice]); }),
            "'{}' is chosen by what is no choice", target.name);
        if (!definition.unchosen->kept) return unread(definition);
        const Buffer& kept = program_[*definition.unchosen->kept];
        const std::span<const Statement> statements = definition.body;
        const auto is_let = [](const Statement& statement) {
            return std::holds_alternative<Let>(statement.form);
        };
        require(kept.storage == Storage::State && kept.scalar == target.scalar &&
                    kept.shape == target.shape && !statements.empty() &&
                    std::holds_alternative<Loop>(statements.back().form) &&
                    std::ranges::all_of(statements.first(statements.size() - 1), is_let),
                "'{}' does not keep '{}'", target.name, kept.name);
    }

    // Its tables are no part of a record.
    void unread(const Definition& definition) {
        for (const BufferId filled : buffers_filled_by(definition.body))
            require(program_[filled].storage == Storage::Scratch, "'{}' is read",
                    program_[filled].name);
    }

    // They fill the records that they compute.
    void definitions(const std::vector<Definition>& definitions, const StorageSet& readable) {
        for (const Definition& definition : definitions) {
            if (definition.unchosen) unchosen(definition);
            body(definition.body, readable);
        }
        for (std::uint32_t index = 0; index < program_.buffers.size(); ++index) {
            const Buffer& buffer = program_.buffers[index];
            const bool filled =
                buffer.storage != Storage::Scratch && computed_.contains(buffer.storage);
            require(!filled || defined_.contains(BufferId{index}), "nothing computes '{}'",
                    buffer.name);
        }
    }

    void conditions() {
        const StorageSet of_state = {Storage::Constant, Storage::State};
        const StorageSet of_action = {Storage::Constant, Storage::State, Storage::Action};
        for (const Computation& condition : program_.preconditions) {
            defined_.clear();  // nothing of the step is there
            computation("precondition", condition, Scalar::Bool, of_action);
        }
        for (const Computation& condition : program_.invariants) {
            defined_.clear();
            computation("invariant", condition, Scalar::Bool, of_state);
        }
        for (const Computation& condition : program_.terminations) {
            defined_.clear();
            computation("termination", condition, Scalar::Bool, of_state);
        }
    }

    // A table is complete behind the outermost statement that fills it. The scope behind the body.
    Scope body(const Block& statements, const StorageSet& readable) {
        ++body_;
        Scope scope;
        for (const Statement& each : statements) {
            statement(each, scope, readable);
            // Inputs that a call has worked in hold nothing any more.
            for_each_statement<Call>({each}, [&](const Call& call) {
                for (BufferId written : written_buffers(call)) defined_.erase(written);
            });
            for (BufferId target : buffers_filled_by({each})) {
                const int first = defined_.emplace(target, body_).first->second;
                require(first == body_, "'{}' is computed twice", program_[target].name);
            }
        }
        return scope;
    }

    void computation(std::string_view name, const Computation& computation, Scalar expected,
                     const StorageSet& readable) {
        const Scope scope = body(computation.body, with_scratch(computation.body, readable));
        use(computation.value, scope, with_scratch(computation.body, readable));
        require(type(computation.value) == expected, "the type of a {} is wrong", name);
    }

    // A computation may read the tables that it fills.
    static StorageSet with_scratch(const Block& statements, StorageSet readable) {
        if (!statements.empty()) readable.insert(Storage::Scratch);
        return readable;
    }

    void statement(const Statement& statement, Scope& scope, const StorageSet& readable) {
        match(
            statement.form, [&](const Let& form) { let(form, scope, readable); },
            [&](const Store& form) { store(form, scope, readable); },
            [&](const Spread& form) { spread(form, scope, readable); },
            [&](const Loop& form) { loop(form, scope, readable); },
            [&](const Visit& form) { visit(form, scope, readable); },
            [&](const Call& form) { call(form, scope, readable); });
    }

    void let(const Let& form, Scope& scope, const StorageSet& readable) {
        use(form.value, scope, readable);
        require(form.local.index < program_.local_count, "there is no local {}", form.local.index);
        require(let_types_.emplace(form.local, type(form.value)).second,
                "local {} is defined twice", form.local.index);
        scope.locals.insert(form.local);
    }

    void store(const Store& form, const Scope& scope, const StorageSet& readable) {
        const Buffer& buffer = program_[form.target];
        require(computed_.contains(buffer.storage), "'{}' is read only", buffer.name);
        require(are_indices(buffer, form.indices), "the indices of '{}' do not fit", buffer.name);
        require(type(form.value) == buffer.scalar, "the type stored to '{}' is wrong", buffer.name);
        for (NodeId index : form.indices) use(index, scope, readable);
        use(form.value, scope, readable);
    }

    void spread(const Spread& form, const Scope& scope, const StorageSet& readable) {
        const Buffer& target = program_[form.target];
        require(is_one_of(target.storage, {Storage::Scratch, Storage::Next}) &&
                    target.scalar == Scalar::Bool && type(form.bits) == Scalar::Int,
                "'{}' is not filled with bits", target.name);
        require(are_leading(target, form.indices) && target.row_size(form.indices.size()) <= 64,
                "a row of '{}' does not hold the bits of an int", target.name);
        for (NodeId index : form.indices) use(index, scope, readable);
        use(form.bits, scope, readable);
    }

    void loop(const Loop& form, Scope scope, const StorageSet& readable) {
        require(scope.variables.insert(form.variable).second, "'{}' is bound inside itself",
                program_[form.variable].name);
        if (form.affected) {
            const Buffer& few = program_[form.affected->few];
            const Buffer& rows = program_[form.affected->rows];
            require(few.storage == Storage::State && few.scalar == Scalar::Bool &&
                        rows.storage == Storage::Constant && rows.count() == few.count() + 1 &&
                        program_[form.affected->objects].storage == Storage::Constant,
                    "'{}' does not say which objects '{}' affects", rows.name, few.name);
            if (form.affected->moves) moves(*form.affected->moves, few);
        }
        if (form.chosen) {
            const Buffer& few = program_[form.chosen->few];
            require(few.storage == Storage::Action && few.scalar == Scalar::Bool,
                    "'{}' does not choose objects", few.name);
            if (form.chosen->kept) keeps(few, program_[*form.chosen->kept]);
        }
        if (form.clearances) near(*form.clearances);
        require(!form.shifts || (!form.several_at_once && shifted_row(program_, form)),
                "'{}' does not shift a row", program_[form.variable].name);
        for (const Statement& each : form.body) statement(each, scope, readable);
    }

    void keeps(const Buffer& few, const Buffer& kept) {
        require(kept.storage == Storage::State && kept.scalar == Scalar::Bool &&
                    kept.shape == few.shape,
                "'{}' does not say which objects keep their elements of '{}'", few.name, kept.name);
    }

    void moves(const Moves& form, const Buffer& few) {
        const Buffer& table = program_[form.table];
        const auto is_bool = [&](BufferId choice) {
            const Buffer& buffer = program_[choice];
            return buffer.shape.empty() && buffer.scalar == Scalar::Bool &&
                   is_one_of(buffer.storage, {Storage::State, Storage::Action});
        };
        require(table.storage == Storage::Constant && table.holds_places &&
                    table.count() == few.count() << form.choices.size() &&
                    std::ranges::all_of(form.choices, is_bool),
                "'{}' does not say where what is true in '{}' moves", table.name, few.name);
    }

    void near(const Clearances& form) {
        const Buffer& table = program_[form.table];
        const auto is_number = [&](BufferId number) {
            return program_[number].shape.empty() && program_[number].scalar == Scalar::Real;
        };
        require(table.storage == Storage::Constant && table.holds_places &&
                    table.shape.size() == form.places.size() &&
                    form.begin.size() == form.places.size() &&
                    form.cells_per_unit.size() == form.places.size() &&
                    std::ranges::all_of(form.places, is_number) &&
                    std::ranges::all_of(form.moves, is_number),
                "'{}' is no table of clearances", table.name);
    }

    void visit(const Visit& form, Scope scope, const StorageSet& readable) {
        const Variable& visited = program_[form.visited];
        const auto* element = std::get_if<Load>(&program_[form.condition].form);
        require(element && type(form.condition) == Scalar::Bool && element->indices.size() == 1 &&
                    program_[element->indices.front()].form ==
                        Node{Scalar::Int, Index{form.visited}}.form,
                "the condition of a visit is no element at '{}'", visited.name);
        std::vector<VariableId> bound = {form.visited};
        if (form.entries) {
            const Buffer& rows = program_[form.entries->rows];
            require(rows.storage == Storage::Constant && rows.scalar == Scalar::Int &&
                        rows.shape == std::vector{visited.size + 1},
                    "'{}' does not hold the rows of '{}'", rows.name, visited.name);
            bound.push_back(form.entries->variable);
        }
        for (const VariableId variable : bound)
            require(scope.variables.insert(variable).second, "'{}' is bound inside itself",
                    program_[variable].name);
        use(form.condition, scope, readable);
        std::map<BufferId, bool> values;
        for (const Mark& each : form.marks) {
            require(values.emplace(each.target, each.value).first->second == each.value,
                    "marks of '{}' contradict each other", program_[each.target].name);
            mark(each, scope, readable);
        }
    }

    void mark(const Mark& form, const Scope& scope, const StorageSet& readable) {
        const Buffer& target = program_[form.target];
        require(is_one_of(target.storage, {Storage::Scratch, Storage::Next}) &&
                    target.scalar == Scalar::Bool && type(form.condition) == Scalar::Bool,
                "'{}' is not marked where a bool is true", target.name);
        require(are_indices(target, form.indices), "the indices of '{}' do not fit", target.name);
        for (NodeId index : form.indices) use(index, scope, readable);
        use(form.condition, scope, readable);
    }

    void call(const Call& form, const Scope& scope, const StorageSet& readable) {
        const std::string name = name_of(program_, form.callee);
        require(are_views(form), "the indices of the tables of '{}' do not fit", name);
        const std::size_t room = match(
            form.callee,
            [&](ExternalId) -> std::size_t {
                require(form.scalars.empty(), "the scalars of '{}' do not fit", name);
                return 0;
            },
            [&](Together) -> std::size_t {
                require(are_together(form), "the scalars of '{}' do not fit", name);
                return 0;
            },
            [&](auto callee) {
                const CallSignature signature = signature_of(callee);
                require(tables_fit(form, signature), "the tables of '{}' do not fit", name);
                require(scalars_fit(form, signature), "the scalars of '{}' do not fit", name);
                return signature.room;
            });
        require(form.place.has_value() == is_draw(form.callee), "'{}' has a place, or needs one",
                name);
        require(std::ranges::find(form.inputs, form.output.buffer, &TableView::buffer) ==
                    form.inputs.end(),
                "'{}' fills a table that it reads", name);
        for (BufferId written : written_buffers(form)) {
            require(program_[written].storage == Storage::Scratch, "'{}' works in '{}'", name,
                    program_[written].name);
        }
        for (NodeId operand : operands_of(form)) use(operand, scope, readable);
        for (std::size_t i = 0; i + room < form.inputs.size(); ++i) {
            readable_now(form.inputs[i].buffer, readable);
        }
    }

    // Sines and cosines, as many as the vector has elements.
    bool are_together(const Call& form) const {
        const auto is_function = [&](NodeId id) {
            return is_sine_or_cosine(program_[id]);
        };
        const Buffer& output = program_[form.output.buffer];
        return form.inputs.empty() && form.output.indices.empty() &&
               output.scalar == Scalar::Real &&
               output.shape == std::vector<std::int64_t>{std::ssize(form.scalars)} &&
               std::ranges::all_of(form.scalars, is_function);
    }

    // Every table has indices for some of its dimensions.
    bool are_views(const Call& form) const {
        const auto is_view = [&](const TableView& view) {
            return view.indices.size() <= program_[view.buffer].shape.size() &&
                   std::ranges::all_of(view.indices,
                                       [&](NodeId id) { return type(id) == Scalar::Int; });
        };
        return std::ranges::all_of(form.inputs, is_view) && is_view(form.output);
    }

    bool tables_fit(const Call& form, const CallSignature& signature) const {
        if (form.inputs.size() != signature.input_axes.size()) return false;
        const auto fits = [&](const TableView& view, std::size_t axes, Scalar scalar) {
            const Buffer& buffer = program_[view.buffer];
            const auto ranges_over_extent = [&](std::int64_t size) {
                return size == extent_of(program_, form).size;
            };
            return view.indices.size() + axes == buffer.shape.size() && buffer.scalar == scalar &&
                   std::all_of(buffer.shape.end() - static_cast<std::ptrdiff_t>(axes),
                               buffer.shape.end(), ranges_over_extent);
        };
        for (std::size_t i = 0; i < form.inputs.size(); ++i) {
            if (!fits(form.inputs[i], signature.input_axes[i], Scalar::Real)) return false;
        }
        return fits(form.output, signature.output_axes, signature.output);
    }

    bool scalars_fit(const Call& form, const CallSignature& signature) const {
        if (!signature.scalar) return form.scalars.empty();
        return form.scalars.size() == 1 && type(form.scalars.front()) == *signature.scalar;
    }

    // Everything below `root` may be evaluated here.
    void use(NodeId root, const Scope& scope, const StorageSet& readable) {
        const auto known = [&](VariableId id) {
            return scope.variables.contains(id);
        };
        const bool bound = std::ranges::all_of(properties_[root.index].free_variables, known);
        require(bound, "a variable of '{}' is not bound", text_unless(bound, root));
        for (NodeId id : below(root)) {
            const Node& node = program_[id];
            if (const auto buffer = buffer_read_by(node)) readable_now(*buffer, readable);
            if (const auto* local = std::get_if<Local>(&node.form)) {
                require(
                    scope.locals.contains(local->local) && let_types_.at(local->local) == node.type,
                    "local {} is not defined here", local->local.index);
            }
            if (const auto variable = bound_variable(node)) {
                require(!known(*variable), "'{}' is bound inside itself", program_[*variable].name);
            }
        }
    }

    void readable_now(BufferId id, const StorageSet& readable) {
        const Buffer& buffer = program_[id];
        require(readable.contains(buffer.storage), "'{}' must not be read here", buffer.name);
        require(!computed_.contains(buffer.storage) || defined_.contains(id),
                "'{}' is read before it is computed", buffer.name);
    }

    std::vector<NodeId> below(NodeId root) const {
        std::set<NodeId> found = {root};
        std::vector<NodeId> waiting = {root};
        while (!waiting.empty()) {
            const NodeId id = waiting.back();
            waiting.pop_back();
            for (NodeId operand : operands_of(program_[id])) {
                if (found.insert(operand).second) waiting.push_back(operand);
            }
        }
        return {found.begin(), found.end()};
    }

    const Program& program_;
    std::vector<Properties> properties_;
    StorageSet computed_;                               // what the current block computes
    std::map<BufferId, int> defined_;                   // and in which body
    int body_ = 0;                                      // how many have been checked
    std::vector<std::vector<VariableId>> bound_below_;  // sorted, by NodeId::index
    std::map<LocalId, Scalar> let_types_;
    std::vector<std::string> complaints_;
};

}  // namespace

std::vector<std::string> verify(const Program& program) {
    return Verifier(program).complaints();
}

void expect_valid(const Program& program, std::string_view stage) {
    const std::vector<std::string> complaints = verify(program);
    if (complaints.empty()) return;
    own_mistake(fmt::format("the program is malformed after {}:\n{}\n", stage,
                            fmt::join(complaints, "\n")));
}

}  // namespace rddlc::ir
