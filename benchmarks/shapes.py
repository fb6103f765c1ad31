"""RDDL texts of many shapes, each as long as one asks: what must not take more than about n log n.

Each shape is a function of n that gives one text with domain, non-fluents and instance, of about n lines. Some are
mistaken on purpose.

Over 400 lines: a function for each shape.
"""

from collections.abc import Callable, Iterable

SHAPES: dict[str, Callable[[int], str]] = {}


def shape(make: Callable[[int], str]) -> Callable[[int], str]:
    SHAPES[make.__name__] = make
    return make


def lines(n: int, line: str) -> str:
    """n times a line, with {i} for its number, {h} for the one before, and {j} for one far away."""
    return "\n".join(line.format(i=i, h=i - 1, j=i * 7919 % n) for i in range(n))


def listed(n: int, word: str, separator: str = ", ", row: int = 8) -> str:
    """n words in rows of some."""
    words = [word.format(i=i, j=i * 7919 % n) for i in range(n)]
    rows = [separator.join(words[k : k + row]) for k in range(0, n, row)]
    return (separator.rstrip(" ") + "\n").join(rows)


def problem(  # noqa: PLR0913
    pvariables: str = "",
    cpfs: str = "",
    reward: str = "s",
    types: str = "",
    sections: str = "",
    objects: str = "",
    values: str = "",
    init: str = "",
    before: str = "",
) -> str:
    return f"""{before}domain d {{
types {{ {types} }};
pvariables {{
s : {{ state-fluent, real, default = 0.0 }};
a : {{ action-fluent, real, default = 0.0 }};
{pvariables}
}};
cpfs {{
s' = s + a;
{cpfs}
}};
reward = {reward};
{sections}
}}
non-fluents v {{ domain = d; objects {{ {objects} }}; non-fluents {{ {values} }}; }}
instance i {{ domain = d; non-fluents = v; init-state {{ {init} s = 1.0; }}; max-nondef-actions = pos-inf; horizon = 5; discount = 1.0; }}
"""


def objects_of(n: int, kind: str = "o") -> str:
    return f"{kind} : {{ {listed(n, kind + '{i}')} }};"


# ------------------------------------------------------------------------------ declarations


@shape
def types(n: int) -> str:
    return problem(types=lines(n, "t{i} : object;"), objects=lines(n, "t{i} : {{ x{i} }};"))


@shape
def enumerations(n: int) -> str:
    return problem(types=lines(n, "t{i} : {{ @x{i}, @y{i} }};"))


@shape
def objects(n: int) -> str:
    return problem("p(o) : { state-fluent, bool, default = false };", "p'(?x) = ~p(?x);",
                   "sum_{?x : o} p(?x)", types="o : object;", objects=objects_of(n))  # fmt: skip


@shape
def members(n: int) -> str:
    return problem("p(o) : { state-fluent, bool, default = false };", "p'(?x) = ~p(?x);",
                   "sum_{?x : o} p(?x)", types=f"o : {{ {listed(n, '@m{i}')} }};")  # fmt: skip


@shape
def member_conditions(n: int) -> str:
    return problem("e : { state-fluent, o, default = @m0 };", "e' = e;",
                   balanced([f"(e == @m{i}) * {i}.5" for i in range(n)], "+"),
                   types=f"o : {{ {listed(n, '@m{i}')} }};")  # fmt: skip


@shape
def state_fluents(n: int) -> str:
    return problem(lines(n, "p{i} : {{ state-fluent, real, default = {i}.0 }};"), lines(n, "p{i}' = p{j} + 1;"))


@shape
def bool_fluents(n: int) -> str:
    return problem(lines(n, "p{i} : {{ state-fluent, bool, default = false }};"), lines(n, "p{i}' = p{j} ^ ~p{i};"))


@shape
def parametrised_fluents(n: int) -> str:
    fluents = lines(n, "p{i}(o) : {{ state-fluent, real, default = {i}.0 }};")
    return problem("K(o) : { non-fluent, real, default = 2.0 };" + fluents, lines(n, "p{i}'(?x) = p{j}(?x) + K(?x);"),
                   types="o : object;", objects=objects_of(3), values="K(o1) = 3.0;")  # fmt: skip


@shape
def readers_of_a_table(n: int) -> str:
    """n CPFs that read a table of n values."""
    fluents = lines(n, "p{i} : {{ state-fluent, real, default = {i}.0 }};")
    return problem("K(o) : { non-fluent, real, default = 2.0 }; at : { state-fluent, o, default = @m0 };" + fluents,
                   "at' = at;" + lines(n, "p{i}' = p{i} + K(at) * {i};"), types=f"o : {{ {listed(n, '@m{i}')} }};",
                   values=lines(n, "K(@m{i}) = {i}.5;"))  # fmt: skip


@shape
def ambiguous_objects(n: int) -> str:
    """Objects whose names may be parts of grounded names."""
    return problem("p(o, u) : { state-fluent, bool, default = false };", "p'(?x, ?y) = ~p(?x, ?y);",
                   types="o : object; u : object;", objects=f"o : {{ x, {listed(n, 'x__y{i}')} }}; u : {{ y, z }};")  # fmt: skip


@shape
def action_fluents(n: int) -> str:
    return problem(lines(n, "b{i} : {{ action-fluent, bool, default = false }};")
                   + lines(n, "p{i} : {{ state-fluent, bool, default = false }};"), lines(n, "p{i}' = p{i} | b{j};"))  # fmt: skip


@shape
def observ_fluents(n: int) -> str:
    return problem(lines(n, "z{i} : {{ observ-fluent, real }};"), lines(n, "z{i} = s' + {i};"))


@shape
def random_fluents(n: int) -> str:
    return problem(lines(n, "p{i} : {{ state-fluent, real, default = {i}.0 }};"), lines(n, "p{i}' = Normal(p{j}, 1.0);"))


@shape
def non_fluents(n: int) -> str:
    return problem(lines(n, "K{i} : {{ non-fluent, real, default = 0.5 }};"), values=lines(n, "K{i} = {i}.25;"),
                   reward=balanced([f"K{i} * s" for i in range(n)], "+"))  # fmt: skip


@shape
def non_fluent_values(n: int) -> str:
    return problem("K(o, o) : { non-fluent, real, default = 0.0 };p(o) : { state-fluent, real, default = 0.0 };",
                   "p'(?x) = sum_{?y : o} [K(?x, ?y) * p(?y)];", types="o : object;", objects=objects_of(n),
                   values=lines(n, "K(o{i}, o{j}) = {i}.5;"))  # fmt: skip


@shape
def init_values(n: int) -> str:
    return problem("p(o) : { state-fluent, real, default = 0.0 };", "p'(?x) = p(?x);", types="o : object;", objects=objects_of(n),
                   init=lines(n, "p(o{j}) = {i}.5;"))  # fmt: skip


# ----------------------------------------------------------------------------------- sections


def with_terms(n: int, section: str, condition: str) -> str:
    return problem(lines(n, "p{i} : {{ state-fluent, real, default = {i}.0 }};"), lines(n, "p{i}' = p{i};"),
                   sections=f"{section} {{ {lines(n, condition)} }};")  # fmt: skip


@shape
def preconditions(n: int) -> str:
    return problem(lines(n, "b{i} : {{ action-fluent, real, default = 0.0 }};"),
                   sections=f"action-preconditions {{ {lines(n, 'b{i} <= {i}.0 + s;')} }};")  # fmt: skip


@shape
def bounds(n: int) -> str:
    return problem(lines(n, "b{i} : {{ action-fluent, real, default = 0.0 }};"),
                   sections=f"action-preconditions {{ {lines(n, '(b{i} <= {i}.0) ^ (b{i} >= -1.0);')} }};")  # fmt: skip


@shape
def invariants(n: int) -> str:
    return with_terms(n, "state-invariants", "p{i} >= 0.0 - {i};")


@shape
def terminations(n: int) -> str:
    return with_terms(n, "termination", "p{i} >= 1000.0 + {i};")


@shape
def constraints(n: int) -> str:
    return with_terms(n, "state-action-constraints", "p{i} >= 0.0;")


# -------------------------------------------------------------------------------- expressions


def balanced(terms: list[str], operator: str) -> str:
    """The terms joined in a tree of little depth."""
    while len(terms) > 1:
        terms = [f"({f'{chr(10)}{operator} '.join(terms[k : k + 16])})" for k in range(0, len(terms), 16)]
    return terms[0]


MOST_DEEP = 1000


def chunks(n: int, size: int, make: Callable[[int, int], str]) -> Iterable[str]:
    return (make(k, min(size, n - k)) for k in range(0, n, size))


@shape
def sums(n: int) -> str:
    return problem(lines(n, "p{i} : {{ state-fluent, real, default = {i}.0 }};"), lines(n, "p{i}' = p{i};"),
                   balanced([f"{i}.5 * p{i}" for i in range(n)], "+"))  # fmt: skip


@shape
def products(n: int) -> str:
    return problem(reward=balanced([f"(s + {i})" for i in range(n)], "*"))


@shape
def conjunctions(n: int) -> str:
    return problem(lines(n, "p{i} : {{ state-fluent, bool, default = false }};"), lines(n, "p{i}' = p{i};"),
                   balanced([f"~p{i}" for i in range(n)], "^") + " * s")  # fmt: skip


@shape
def comparisons(n: int) -> str:
    return problem(reward=balanced([f"(s > {i})" for i in range(n)], "+") + " * 1.0")


@shape
def disjunctions(n: int) -> str:
    return problem(reward=balanced([f"(s == {i})" for i in range(n)], "|") + " * s")


@shape
def numbers(n: int) -> str:
    return problem(reward=balanced([f"{i}.125" for i in range(n)], "+") + " * s")


@shape
def draws(n: int) -> str:
    return problem(reward=balanced([f"Normal(s, {i + 1})" for i in range(n)], "+"))


@shape
def aggregations(n: int) -> str:
    return problem("p(o) : { state-fluent, real, default = 0.0 };", "p'(?x) = p(?x);",
                   balanced([f"(sum_{{?x : o}} [p(?x) * {i}])" for i in range(n)], "+"),
                   types="o : object;", objects=objects_of(3))  # fmt: skip


@shape
def bool_aggregations(n: int) -> str:
    return problem("p(o) : { state-fluent, bool, default = false }; K(o, o) : { non-fluent, bool, default = false };" + lines(n, "q{i}(o) : {{ state-fluent, bool, default = false }};"), "p'(?x) = p(?x);" + lines(n, "q{i}'(?x) = exists_{{?y : o}} [K(?x, ?y) ^ q{j}(?y)];"),
                   types="o : object;", objects=objects_of(9), values="K(o1, o2); K(o2, o3); K(o7, o1);")  # fmt: skip


@shape
def nested_ifs(n: int) -> str:
    """An `if` in the condition's place, some deep, many of them."""

    def deep(k: int, size: int) -> str:
        text = f"s + {k}.0"
        for i in range(size):
            text = f"if (s > {k + i}) then ({text}) else {i}.0"
        return f"({text})"

    return problem(reward=balanced(list(chunks(n, 100, deep)), "+"))


@shape
def else_ifs(n: int) -> str:
    def chain(k: int, size: int) -> str:
        return "(" + "".join(f"if (s > {k + i}) then {i}.0\nelse " for i in range(size)) + "0.0)"

    return problem(reward=balanced(list(chunks(n, 500, chain)), "+"))


@shape
def else_ifs_of_draws(n: int) -> str:
    def chain(k: int, size: int) -> str:
        return "(" + "".join(f"if (s > {k + i}) then Normal(s, 1.0)\nelse " for i in range(size)) + "0.0)"

    return problem(reward=balanced(list(chunks(n, 200, chain)), "+"))


@shape
def switch_cases(n: int) -> str:
    return problem("e : { state-fluent, o, default = @m0 };", "e' = e;",
                   f"switch (e) {{ {listed(n, 'case @m{i} : {i}.0 + s', row=1)} }}",
                   types=f"o : {{ {listed(n, '@m{i}')} }};")  # fmt: skip


@shape
def switch_cases_of_draws(n: int) -> str:
    return problem("e : { state-fluent, o, default = @m0 };", "e' = e;",
                   f"switch (e) {{ {listed(n, 'case @m{i} : Normal({i}.0, 1.0)', row=1)} }}",
                   types=f"o : {{ {listed(n, '@m{i}')} }};")  # fmt: skip


@shape
def discrete_cases(n: int) -> str:
    return problem("e : { state-fluent, o, default = @m0 };", f"e' = Discrete(o, {listed(n, f'@m{{i}} : {1 / n:.9f}', row=1)});",
                   types=f"o : {{ {listed(n, '@m{i}')} }};")  # fmt: skip


def chain(n: int, text: str) -> str:
    return problem("x0 : { interm-fluent, real };" + lines(n, "x{i} : {{ interm-fluent, real }};").split("\n", 1)[1],
                   "x0 = s + 1;\n" + lines(n, text).split("\n", 1)[1], reward=f"x{n - 1}")  # fmt: skip


@shape
def chain_read_once(n: int) -> str:
    return chain(n, "x{i} = x{h} * 0.5 + {i};")


@shape
def chain_read_twice(n: int) -> str:
    return chain(n, "x{i} = x{h} * x{h} + a;")


@shape
def chain_of_draws(n: int) -> str:
    return chain(n, "x{i} = Normal(x{h}, 1.0);")


@shape
def chain_of_constants(n: int) -> str:
    return problem(lines(n, "x{i} : {{ interm-fluent, real }};"),
                   "x0 = 1.0;\n" + lines(n, "x{i} = x{h} * 0.5 + {i};").split("\n", 1)[1], reward=f"x{n - 1} * s")  # fmt: skip


@shape
def chain_backwards(n: int) -> str:
    return problem(lines(n, "x{i} : {{ interm-fluent, real }};"),
                   "\n".join(reversed(["x0 = s;", *(f"x{i} = x{i - 1} * 0.5 + {i};" for i in range(1, n))])), reward=f"x{n - 1}")  # fmt: skip


@shape
def chain_of_tables(n: int) -> str:
    return problem(lines(n, "x{i}(o) : {{ interm-fluent, real }};"),
                   "x0(?o) = s;\n" + lines(n, "x{i}(?o) = x{h}(?o) * 0.5 + sum_{{?u : o}} x{h}(?u);").split("\n", 1)[1], reward=f"sum_{{?o : o}} x{n - 1}(?o)",
                   types="o : object;", objects=objects_of(3))  # fmt: skip


@shape
def fan_out(n: int) -> str:
    """One interm-fluent that n CPFs read."""
    return problem("x : { interm-fluent, real };" + lines(n, "p{i} : {{ state-fluent, real, default = {i}.0 }};"),
                   "x = exp[s] + 1;" + lines(n, "p{i}' = x + p{i};"))  # fmt: skip


@shape
def interm_fluents(n: int) -> str:
    return problem(lines(n, "x{i} : {{ interm-fluent, real }};"), lines(n, "x{i} = exp[s + {i}];"),
                   reward=balanced([f"x{i}" for i in range(n)], "+"))  # fmt: skip


@shape
def common_subexpressions(n: int) -> str:
    return problem(lines(n, "p{i} : {{ state-fluent, real, default = {i}.0 }};"),
                   lines(n, "p{i}' = exp[s + a] * exp[s + {j}] + sqrt[s * s + {i}];"))  # fmt: skip


@shape
def aggregation_variables(n: int) -> str:
    """Aggregations of up to 50 variables over types of one object."""
    def over(k: int, size: int) -> str:
        binder = ", ".join(f"?x{i} : o" for i in range(k, k + size))
        return f"(sum_{{{binder}}} [{' + '.join(f'p(?x{i})' for i in range(k, k + size))}])"

    return problem("p(o) : { state-fluent, real, default = 0.0 };", "p'(?x) = p(?x);", balanced(list(chunks(n, 50, over)), "+"),
                   types="o : object;", objects=objects_of(1))  # fmt: skip


@shape
def parameters(n: int) -> str:
    """Fluents of up to 50 parameters of a type of one object."""
    rows = list(chunks(n, 50, lambda k, size: f"p{k}({', '.join(['o'] * size)}) : {{ state-fluent, real, default = 0.0 }};"))
    bodies = list(chunks(n, 50, lambda k, size: (lambda v: f"p{k}'({v}) = p{k}({v}) + 1;")(", ".join(f"?x{i}" for i in range(size)))))
    return problem("\n".join(rows), "\n".join(bodies), types="o : object;", objects=objects_of(1))


@shape
def deep_brackets(n: int) -> str:
    return problem(reward=balanced(["(" * 200 + "s" + ")" * 200 for _ in range(n // 200)], "+"))


@shape
def long_sums(n: int) -> str:
    """Written without brackets, as long as may be."""
    return problem(reward=balanced(list(chunks(n, 500, lambda k, size: "(" + " + ".join(f"s * {k + i}" for i in range(size)) + ")")), "+"))


@shape
def conditions_of_ifs(n: int) -> str:
    return problem(lines(n, "p{i} : {{ state-fluent, real, default = {i}.0 }};"), lines(n, "p{i}' = if (s > {i}) then p{i} + 1 else p{j};"))


# ------------------------------------------------------------------------------------ mistakes


@shape
def unknown_names(n: int) -> str:
    return problem(lines(n, "p{i} : {{ state-fluent, real, default = 0.0 }};"), lines(n, "p{i}' = q{j}z + 1;"))


@shape
def unknown_objects(n: int) -> str:
    return problem("p(o) : { state-fluent, real, default = 0.0 };", "p'(?x) = p(?x);", types="o : object;", objects=objects_of(n),
                   init=lines(n, "p(u{j}) = {i}.5;"))  # fmt: skip


@shape
def unknown_members(n: int) -> str:
    return problem("e : { state-fluent, o, default = @m0 };", "e' = e;", types=f"o : {{ {listed(n, '@m{i}')} }};",
                   reward=balanced([f"(e == @u{i})" for i in range(n)], "+"))  # fmt: skip


@shape
def unknown_settings(n: int) -> str:
    return problem(lines(n, "p{i} : {{ state-fluent, real, default = 0.0 }};"), lines(n, "p{i}' = 1.0;"), init=lines(n, "q{i} = 1.0;"))


@shape
def unknown_types(n: int) -> str:
    return problem(lines(n, "p{i}(u{i}) : {{ state-fluent, real, default = 0.0 }};"), lines(n, "p{i}'(?x) = 1.0;"),
                   types=lines(n, "t{i} : {{ @x{i} }};"))  # fmt: skip


@shape
def unknown_variables(n: int) -> str:
    return problem("p(o) : { state-fluent, real, default = 0.0 };", "p'(?x) = p(?x);", types="o : object;", objects=objects_of(3), reward=balanced([f"p(?u{i})" for i in range(n)], "+"))


@shape
def unknown_functions(n: int) -> str:
    return problem(reward=balanced([f"f{i}[s]" for i in range(n)], "+"))


@shape
def duplicate_names(n: int) -> str:
    return problem(lines(n, "p : {{ state-fluent, real, default = 0.0 }};"), lines(n, "p' = 1.0;"))


@shape
def duplicate_objects(n: int) -> str:
    return problem(types="o : object;", objects=f"o : {{ {listed(n, 'same')} }};")


@shape
def duplicate_values(n: int) -> str:
    return problem("p(o) : { state-fluent, real, default = 0.0 };", "p'(?x) = p(?x);", types="o : object;", objects=objects_of(3), init=lines(n, "p(o1) = {i}.0;"))


@shape
def missing_cpfs(n: int) -> str:
    return problem(lines(n, "p{i} : {{ state-fluent, real, default = 0.0 }};"))


@shape
def missing_values(n: int) -> str:
    return problem(lines(n, "K{i} : {{ non-fluent, real }};"))


@shape
def cycle(n: int) -> str:
    return problem(lines(n, "x{i} : {{ interm-fluent, real }};"), f"x0 = x{n - 1};\n" + lines(n, "x{i} = x{h};").split("\n", 1)[1])


@shape
def small_cycles(n: int) -> str:
    return problem(lines(n, "x{i} : {{ interm-fluent, real }};"), lines(n, "x{i} = x{i} + 1;"))


@shape
def type_errors(n: int) -> str:
    return problem(lines(n, "p{i} : {{ state-fluent, bool, default = false }};"), lines(n, "p{i}' = 1.5;"))


@shape
def warnings(n: int) -> str:
    return problem(lines(n, "K{i} : {{ non-fluent, real, default = 0.0 }};"))


@shape
def type_faults(n: int) -> str:
    return problem(lines(n, "p{i} : {{ state-fluent, int, default = 0 }};"), lines(n, "p{i}' = if (s > 0) then 1 else 2.5;"))


@shape
def syntax_errors(n: int) -> str:
    return problem(lines(n, "p{i} : {{ state-fluent, real, default = 0.0 }};"), lines(n, "p{i}' = p{i} + ;"))


@shape
def missing_semicolons(n: int) -> str:
    return problem(lines(n, "p{i} : {{ state-fluent, real, default = 0.0 }};"), lines(n, "p{i}' = p{i}"))


@shape
def foreign_operators(n: int) -> str:
    return problem(lines(n, "p{i} : {{ state-fluent, bool, default = false }};"), lines(n, "p{i}' = p{i} && !p{j};"))


@shape
def stray_characters(n: int) -> str:
    return problem(cpfs=lines(n, "` \" \\"))


@shape
def open_brackets(n: int) -> str:
    return problem(cpfs=lines(n, "p{i}' = [p{i};"))


@shape
def closing_brackets(n: int) -> str:
    return problem(cpfs=lines(n, "p{i}' = p{i});"))


# ---------------------------------------------------------------------------------------- text


@shape
def comments(n: int) -> str:
    return problem(cpfs=lines(n, "// {i} // and more {{ ( ["))


@shape
def comments_inside(n: int) -> str:
    return problem(lines(n, "p{i} // {i}\n: {{ // state\nstate-fluent, real, default = 0.0 }}; // {i}"), lines(n, "p{i}' // is\n= p{i}; // {i}"))


@shape
def comments_in_expression(n: int) -> str:
    return problem(reward=balanced([f"s // {i}\n" for i in range(n)], "+"))


@shape
def blank_lines(n: int) -> str:
    return problem(cpfs="\n" * 20 * n)


@shape
def blanks(n: int) -> str:
    return problem(reward="s" + " " * 20 * n + "+ 1")


@shape
def long_names(n: int) -> str:
    name = "p" * 10 * n
    return problem(f"{name} : {{ state-fluent, real, default = 0.0 }};", f"{name}' = {name} + {name};")


@shape
def long_unknown_names(n: int) -> str:
    return problem("p" * 10 * n + " : { state-fluent, real, default = 0.0 };", "p" * 10 * n + "' = " + "q" * 10 * n + ";")


@shape
def long_line(n: int) -> str:
    return problem(lines(n, "p{i} : {{ state-fluent, real, default = {i}.0 }};").replace("\n", " "), lines(n, "p{i}' = p{j} + 1;").replace("\n", " "))


@shape
def long_line_of_errors(n: int) -> str:
    return problem(lines(n, "p{i} : {{ state-fluent, bool, default = false }};").replace("\n", " "), lines(n, "p{i}' = 1.5;").replace("\n", " "))


@shape
def long_number(n: int) -> str:
    return problem(reward="s + 1." + "5" * 10 * n)


@shape
def blocks(n: int) -> str:
    return problem(before=lines(n, "non-fluents v{i} {{ domain = d; }}"))


@shape
def sections(n: int) -> str:
    return problem(sections=lines(n, "reward = {i}.0;"))
