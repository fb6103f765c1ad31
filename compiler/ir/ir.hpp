// The intermediate representation, on one page.
//
// A program is a few blocks of statements over named buffers. Expressions live in one flat pool
// and are addressed by id; the builder (builder.hpp) folds constants and hash-conses, so equal
// expressions have equal ids. Loops over objects stay loops. Objects are integers.
//
// Invariants, checked by verify.hpp: operands precede their users in the pool; every loop index is
// used inside the statement or reduction that binds it, and not bound again there (several loops
// side by side may bind the same variable); types fit; each site is used by one node or call; the
// right operand of And, Or and Implies cannot fault; buffers are read after they are computed.
//
// Over 400 lines: readers of the representation find all of it here.
#pragma once

#include "ir/shared_reals.hpp"
#include "model/table.hpp"
#include "support/box.hpp"
#include "support/source.hpp"
#include "vocabulary/range.hpp"
#include "vocabulary/vocabulary.hpp"

#include <compare>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace rddlc {

// The type in which a simulator computes reals: 64 bits, as the interpreter does, or 32.
enum class RealType : std::uint8_t { Double, Float };
std::string_view name_of(RealType real);  // "double", "float"

}  // namespace rddlc

namespace rddlc::ir {

// Typed ids: an index into the table of the same name in Program.
template <class Tag>
struct Id {
    std::uint32_t index = 0;
    auto operator<=>(const Id&) const = default;
};
using NodeId = Id<struct NodeTag>;
using VariableId = Id<struct VariableTag>;
using BufferId = Id<struct BufferTag>;
using LocalId = Id<struct LocalTag>;
using SiteId = Id<struct SiteTag>;
using ExternalId = Id<struct ExternalTag>;

enum class Scalar : std::uint8_t { Bool, Int, Real };
using Value = rddlc::Value;

// The enumerators stand in the order of a Value's alternatives.
inline Scalar scalar_of(const Value& value) {
    return static_cast<Scalar>(value.index());
}

// A loop index, running over [0, size). Named as in the RDDL text, without "?".
struct Variable {
    std::string name;
    std::optional<std::uint32_t> type;  // index into Program::types; absent: entries of a table
    std::int64_t size;
};

enum class Storage : std::uint8_t {
    Constant,  // a table fixed by the instance
    State,     // read only, except in `reset`
    Action,    // read only, except in the policy, which computes it
    Scratch,   // interm- and derived-fluents, those of the policy too, large temporaries
    Next,      // the next state: one buffer for each State buffer, same name and shape
    Observation,
    Memory,      // what the policy remembers; read only, except in its reset
    NextMemory,  // one buffer for each Memory buffer, same name and shape
};

// Named storage of fixed shape, row-major over the objects of its parameter types.
struct Buffer {
    std::string name;  // the RDDL name of the fluent, or a name made by a pass
    Storage storage;
    Scalar scalar;
    std::vector<std::int64_t> shape = {};  // empty: one value
    // One per dimension, index into Program::types; empty for a table over something else.
    std::vector<std::uint32_t> types = {};
    // Index into Program::fluents; absent: the policy's own.
    std::optional<std::uint32_t> fluent = {};
    // Constant: the table; State, Memory: initial; Action: defaults.
    Table values = {};
    Span span;
    // Within which every element lies, where that is known: of reals that the step computes
    // (is_computed_in_step), and of those of a program for moderate values.
    std::optional<Range> range = {};
    // Action: of its bools no more are true in an action that is allowed, where that is known.
    // Values do not depend on it.
    std::optional<std::int64_t> most_true = {};
    // Constant ints that only Element reads: emitted code keeps each in as few bytes as it takes.
    bool holds_places = false;

    std::int64_t count() const;
    // The number of elements that so many leading indices have in common.
    std::int64_t row_size(std::size_t leading) const;
    // Its readers get what the step has computed. Actions and observations may come from elsewhere,
    // also in a program whose policy computes them.
    bool is_computed_in_step() const {
        return storage == Storage::Scratch || storage == Storage::Next;
    }
};

// The place of a draw or a fault: a site of the program text and the place inside its scope.
// Site::series and the index are the counter of the random number generator, so a draw is the same
// wherever and whenever it is evaluated.
struct Place {
    SiteId site;
    NodeId index;  // Int: row-major index over Site::scope
    auto operator<=>(const Place&) const = default;
};
struct Site {
    Span span;
    std::vector<VariableId> scope;  // CPF parameters, then aggregation variables, outermost first
    std::string what;               // "Bernoulli", "pow", ... for messages
    // The site whose random numbers it draws. Absent: its own; else those of a site of the same
    // scope in another branch of an `if` or `switch`, so that no two draws share a number.
    std::optional<SiteId> series = {};
};

// ---------------------------------------------------------------------------- expressions

struct Constant {
    Value value;
    bool operator==(const Constant&) const = default;  // the builder compares reals by their bits
};
struct Index {  // the current value of a loop index; Int
    VariableId variable;
    bool operator==(const Index&) const = default;
};
// How a loop over several objects at once (Loop) reads the elements of its objects. None: there is
// no such loop, or all of them read the same element.
enum class Gather : std::uint8_t {
    None,
    Adjacent,  // the first indices are the variables of the loop: elements side by side
    InRow,     // the last ones are, in a row that is the same for all: elements side by side
    Rows,      // of a constant table: each object, or its kind, has a row, and an index into it
    Own,       // each object has indices of its own
    Chances,   // adjacent ones of a constant table: probabilities of draws. It is known which
               // random numbers are below them, and which objects need none
};
struct Load {
    BufferId buffer;
    std::vector<NodeId> indices;  // Int, one per dimension, in range by construction
    Gather gather = Gather::None;
    bool operator==(const Load&) const = default;
};
// How many entries of a sorted constant table are at most the value; 0 for nan. Int.
struct Search {
    BufferId table;  // of one dimension, Int or Real as the value
    NodeId value;
    bool operator==(const Search&) const = default;
};
// The elements [first, first + 64) of a table of bools, or of the row that leading indices choose,
// in row-major order, as the bits of an Int, the first one lowest; bits beyond its end are 0.
struct Bits {
    BufferId buffer;
    std::int64_t first;
    // Int, of the leading dimensions, the same in all environments, in range by construction.
    std::vector<NodeId> indices = {};
    bool operator==(const Bits&) const = default;
};
// The bits that one mask at least has, of the masks that are chosen by the bits of an Int: bit i
// chooses element i of a row of a constant table of Ints, whose last dimension is at most 64.
struct Union {
    BufferId masks;
    std::vector<NodeId> row;  // Int, one for each dimension but the last, in range by construction
    NodeId bits;              // Int, 0 beyond the end of the row
    bool operator==(const Union&) const = default;
};
// The element of a table of bools, or of the row that leading indices choose, that has this place
// in row-major order.
struct Element {
    BufferId buffer;
    NodeId place;                      // Int, in range by construction
    std::vector<NodeId> indices = {};  // the same
    bool operator==(const Element&) const = default;
};
struct Local {  // the value of an enclosing Let
    LocalId local;
    bool operator==(const Local&) const = default;
};
// Bool -> Int, Bool -> Real, Int -> Real; the target is Node::type.
struct Convert {
    NodeId operand;
    // The operand rounds a real, and the result is made from the rounded real, not from its int.
    bool skips_int = false;
    bool operator==(const Convert&) const = default;
};
struct Apply {
    Operator op;
    std::vector<NodeId> operands;
    std::optional<Place> place;  // exactly for operators that may fault
    bool operator==(const Apply&) const = default;
};
// The parts of a Select that emitted code evaluates. A branch that is not taken is evaluated only
// if that does no harm.
enum class Evaluated : std::uint8_t {
    Branch,    // the branch that is taken; in packs those that a lane takes
    PackBoth,  // the branch that is taken; in packs both
    Both,
    MostlyFirst,  // the branch that is taken, which is hardly ever the second one
    Jump,         // the branch that is taken; in packs those that a lane takes, cheap ones too
};
// Lazy: the branch not taken is not evaluated, so it cannot fault.
struct Select {
    NodeId condition, then_value, else_value;
    Evaluated evaluated = Evaluated::Branch;
    bool operator==(const Select&) const = default;
};
// The part [begin, end) of a variable's range. Both are Int, and the same in all lanes.
struct Bounds {
    NodeId begin, end;
    bool operator==(const Bounds&) const = default;
};
// Over one variable; several variables are nested reductions, outermost first. Average does not
// occur (it is a sum divided by a constant). ArgMin and ArgMax give Int; Minimum, Maximum and
// both Arg forms are never empty, so they have no bounds.
struct Reduce {
    Reduction op;
    VariableId variable;
    NodeId body;
    std::optional<Bounds> bounds;  // absent: all of the range
    // Emitted code visits the true elements of a row or table of bools alone (row_of_bools.hpp),
    // except for several objects at once.
    bool over_true = false;
    // Emitted code evaluates this exists or forall, with those of its kind right inside, for
    // several objects at once where there is but one environment.
    bool several_at_once = false;
    bool operator==(const Reduce&) const = default;
};
// KronDelta and DiracDelta do not occur (they are their argument).
struct Sample {
    Distribution distribution;
    Place place;
    std::vector<NodeId> parameters;
    bool is_valid = false;  // Bernoulli: its probability needs no check
    bool operator==(const Sample&) const = default;
};
struct Discrete {  // an index into `weights`; Int
    bool normalise;
    Place place;
    std::vector<NodeId> weights;
    bool operator==(const Discrete&) const = default;
};
struct DiscreteOver {  // a value of `variable`; Int
    bool normalise;
    Place place;
    VariableId variable;
    NodeId weight;
    bool operator==(const DiscreteOver&) const = default;
};
// How many thresholds of a row are at most a uniform number in [0, 1), the place's first one. Int.
// The rows of the constant table of reals, its last dimension, are sorted.
struct Interval {
    Place place;
    BufferId table;
    std::vector<NodeId> row;  // Int, one for each dimension but the last, in range by construction
    bool operator==(const Interval&) const = default;
};
// Faults when evaluated, with Site::what as the message; its value is zero of Node::type.
struct Fault {
    Place place;
    bool operator==(const Fault&) const = default;
};

struct Node {
    Scalar type;
    std::variant<Constant, Index, Load, Search, Bits, Union, Element, Local, Convert, Apply, Select,
                 Reduce, Sample, Discrete, DiscreteOver, Interval, Fault>
        form;
    bool operator==(const Node&) const = default;
};

// ----------------------------------------------------------------------------- statements

struct Statement;
using Block = std::vector<Statement>;

// Evaluates once and names the value.
struct Let {
    LocalId local;
    NodeId value;
};
struct Store {
    BufferId target;  // Scratch, Next or Observation; in the policy Scratch, Action or NextMemory
    std::vector<NodeId> indices;
    NodeId value;
};
// Fills a row of a table of bools, of at most 64 elements in row-major order, with the bits of an
// Int, the lowest one first.
struct Spread {
    BufferId target;              // Scratch or Next
    std::vector<NodeId> indices;  // of the leading dimensions
    NodeId bits;
};
// Where one element of a table of bools is true, it and a few bools decide which bool of a loop is
// true: the loop has one draw, of which these bools are true or false
// (passes/lanes/look_up_moves.hpp).
struct Moves {
    std::vector<BufferId> choices;  // bools of the state or the action, without parameters
    BufferId table;  // constant rddl::MoveCodes, holds_places: by the place of the element and, as
                     // bits, the choices, the first one lowest
};
// The bools of a loop are false except for objects that read a true element of another table.
struct Affected {
    BufferId few;            // a table of bools, as many as the loop has objects
    BufferId rows, objects;  // constant ints: element i is read by objects[rows[i]], ...
    std::optional<Moves> moves = {};
};
// The objects of a loop over bools whose element of one table is false keep that of another table.
struct Chosen {
    BufferId few;                  // bools of the action, as many as the loop has objects
    std::optional<BufferId> kept;  // bools of the state, of the same shape; absent: all are false
};
// An exists is false, without a look at its objects, where a table says so: for places in one of
// its cells, and moves that are nearer to 0 than the cell's clearance.
struct Clearances {
    BufferId table;  // constant ints, holds_places: multiples of `unit`; a dimension for each place
    std::vector<BufferId> places = {}, moves = {};        // of one real each
    std::vector<double> begin = {}, cells_per_unit = {};  // of each dimension
    double unit, least_move;  // a move that is nearer to 0 than this one has no clearance
};
struct Loop {
    VariableId variable;
    Block body;
    // The loop, with the loops right inside of it, may run over several objects at once: no
    // iteration needs another (passes/lanes/evaluate_together.hpp).
    bool several_at_once = false;
    // Then: its values are bools alone, and a register holds those of many objects
    // (passes/analyses/bool_words.hpp).
    bool as_words = false;
    // Then: one environment computes those alone (passes/lanes/visit_affected.hpp).
    std::optional<Affected> affected = {};
    // Its values are no words: one environment computes those that are chosen alone
    // (passes/lanes/visit_chosen.hpp, draw_for_chosen.hpp).
    std::optional<Chosen> chosen = {};
    // It quantifies (passes/lanes/tabulate_clearances.hpp).
    std::optional<Clearances> clearances = {};
    // It moves the elements of a row one place towards the front, and adds terms to some
    // (shifted_row.hpp). Emitted code moves all rows of the table before the outermost loop.
    bool shifts = false;
};
// An element that gets a value where a condition is true; else it stays as it is.
struct Mark {
    BufferId target;              // Scratch or Next, Bool
    std::vector<NodeId> indices;  // from what the visit binds
    NodeId condition;             // Bool; neither faults nor draws, nor reads what the visit marks
    bool value;                   // the same of all marks of a target
};
// The entries of an object in a sparse table: from rows[object] up to rows[object + 1].
struct Entries {
    VariableId variable;
    BufferId rows;  // constant ints
};
// Visits the objects of which few are true. The order of the visits makes no difference, nor do
// those of objects that are not true, if none of them marks anything.
struct Visit {
    VariableId visited;  // all objects whose condition is true
    NodeId condition;    // the element of a table of bools of one dimension at `visited`
    std::optional<Entries> entries;  // absent: the marks are made once for each object
    std::vector<Mark> marks;
};
// A part of a buffer: the leading dimensions have indices, the others are passed whole.
struct TableView {
    BufferId buffer;
    std::vector<NodeId> indices;
};
// Fills a vector with the scalars, which are sines and cosines: one environment has them in the
// lanes of a register (passes/lanes/group_angles.hpp).
struct Together {};
using Callee = std::variant<MatrixOperator, VectorDistribution, ExternalId, Together>;
// A function of whole tables. call.hpp says what each one expects, and which ones use their inputs
// as room to work in. A matrix without a result gives nan, which Operator::Defined finds. An
// external function takes any tables, also single elements, and is pure: it neither draws nor
// faults, and equal arguments give equal results.
struct Call {
    Callee callee;
    std::vector<TableView> inputs;
    std::vector<NodeId> scalars;
    TableView output;            // Scratch
    std::optional<Place> place;  // exactly for draws; the elements are draws of one place
};
struct Statement {
    std::variant<Let, Store, Spread, Loop, Visit, Call> form;
};

// A function that the user gives in C++ (--extern).
struct External {
    std::string name;  // as in RDDL, without "$"
    Span span;         // of its first use
};

// If all bools of these tables of the action are false, a definition fills its target with a copy
// of a table of the state (passes/lanes/keep_unchosen.hpp), or nothing reads what it fills
// (passes/lanes/skip_unread.hpp).
struct Unchosen {
    std::vector<BufferId> choices;
    std::optional<BufferId> kept;
};
// One CPF, one random initial value, or a table made by a pass: the statements that fill (a part
// of) one buffer.
struct Definition {
    BufferId target;
    Block body;
    Span span;  // of the CPF or the value
    // If set, emitted code may skip the body: Lets and a loop, if it keeps a table.
    std::optional<Unchosen> unchosen = {};
};
// A value with what must be computed before it.
struct Computation {
    Block body;
    NodeId value;
    Span span;
};

// -------------------------------------------------------------------------------- program

struct ObjectType {
    std::string name;
    bool enumerated;
    std::vector<std::string> objects;
};

// A pvariable as declared: the simulator's description of itself.
struct Fluent {
    std::string name;
    Role role;
    Scalar scalar;
    std::optional<std::uint32_t> object_type;    // range, for object- and enumerated-valued fluents
    std::vector<std::uint32_t> parameter_types;  // index into Program::types
    std::optional<BufferId> buffer;              // absent: nothing reads it (a pass found out)
    Span span;
    // NonFluent: the instance's values, whatever passes make of the buffer; else empty.
    Table values;
    // The bounds per grounding, from action-preconditions and state-invariants (Semantics 8.4);
    // -inf/+inf without a bound. Only for numeric State and Action fluents; else empty.
    SharedReals lower, upper;
};

// The policy block: from what is observed (the state, unless there are Observation buffers) and
// from its memory it computes the action and its next memory.
struct Policy {
    std::string name;
    std::vector<Definition> act;  // in evaluation order
    Span span;                    // of its name
};

struct Program {
    std::string domain_name;
    std::string instance_name;
    std::uint64_t fingerprint = 0;  // of the dynamics (model/fingerprint.hpp)
    // The reals of emitted code. Constants are those of doubles here, and rounded where they are
    // written.
    RealType real = RealType::Double;
    // --fast-math: reals that are computed are taken to be never inf or nan.
    bool assumes_finite = false;
    // Right only for steps from moderate states and actions (rddl/values/moderate.hpp).
    bool only_moderate = false;
    // One environment takes the other program, whose loops over several objects at once do more for
    // it than such a program, which leaves out terms.
    bool only_in_packs = false;
    // Makes such steps in place of this program, with less work. It has the same sites.
    std::optional<Box<Program>> moderate = {};
    std::vector<ObjectType> types;
    std::vector<Fluent> fluents;  // in declaration order

    std::vector<Node> nodes;
    std::vector<Variable> variables;
    std::vector<Buffer> buffers;
    std::vector<Site> sites;
    std::vector<External> externals;
    std::uint32_t local_count = 0;

    // The draws at the start of an episode, into State buffers that hold their values already. They
    // read constants only.
    std::vector<Definition> reset;
    // The CPFs in evaluation order. CPFs that fill Observation buffers run like all others, in
    // their place.
    std::vector<Definition> step;
    Computation reward;                      // Real
    std::vector<Computation> preconditions;  // Bool, as are the next two
    std::vector<Computation> invariants;
    std::vector<Computation> terminations;

    std::int64_t horizon = 0;  // 0: no horizon (pos-inf)
    double discount = 1.0;
    std::optional<std::int64_t> max_nondef_actions;

    std::optional<Policy> policy;

    const Node& operator[](NodeId id) const { return nodes[id.index]; }
    const Variable& operator[](VariableId id) const { return variables[id.index]; }
    const Buffer& operator[](BufferId id) const { return buffers[id.index]; }
    const Site& operator[](SiteId id) const { return sites[id.index]; }
    SiteId series_of(SiteId id) const { return sites[id.index].series.value_or(id); }
    const External& operator[](ExternalId id) const { return externals[id.index]; }
    bool partially_observed() const;
};

}  // namespace rddlc::ir
