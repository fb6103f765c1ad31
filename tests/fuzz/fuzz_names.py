"""Problems whose names are those that C++, its libraries and we use: docs/fuzzing.md says why.

    tests/fuzz/fuzz_names.py --rddl build/bin/rddl --problems 8               a fixed set
    tests/fuzz/fuzz_names.py --rddl build/bin/rddl --hours 1 --first 100000   until the time is over
    tests/fuzz/fuzz_names.py --rddl build/bin/rddl --first 1234 --problems 1  one of them again

Every problem is compiled without a warning and makes the same steps as in the interpreter. What
fails is kept in --failures. Exit status: 0 if nothing fails, else 1.
"""

import argparse
import concurrent.futures
import os
import random
import re
import subprocess
import sys
import tempfile
import time
from collections import Counter
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
RUNTIME = ROOT / "runtime"
IDENTIFIER = re.compile(r"[A-Za-z_][A-Za-z0-9_]*")
RDDL_NAME = re.compile(r"[A-Za-z]([A-Za-z0-9_-]*[A-Za-z0-9])?")

# Drops what makes compilers slow, and lets them warn. $1 is the compiler.
WRAPPER = """#!/bin/sh
for word; do
    shift
    test "$word" = -O3 && word=-O0
    set -- "$@" "$word"
done
exec {compiler} "$@" -Wall -Wextra -Werror
"""


def identifiers(text: str) -> set[str]:
    return set(IDENTIFIER.findall(text))


def in_files(*patterns: str) -> set[str]:
    texts = [file.read_text() for pattern in patterns for file in ROOT.glob(pattern)]
    return identifiers(" ".join(texts))


def preprocessed(compiler: str, *options: str) -> str:
    headers = "#include <rddl/simulator.hpp>\n#include <rddl/external.hpp>\n"
    command = [*compiler.split(), f"-I{RUNTIME}", "-pthread", "-E", "-x", "c++", *options, "-"]
    return subprocess.run(command, input=headers, capture_output=True, text=True, check=True).stdout


def taken_by_rddl() -> set[str]:
    """Words of the grammar, and functions."""
    grammar = (ROOT / "grammar/RDDL.g4").read_text()
    vocabulary = "".join(file.read_text() for file in ROOT.glob("compiler/vocabulary/*.cpp"))
    return set(re.findall(r"'([A-Za-z_-]+)'", grammar)) | set(re.findall(r'"(\w+)"', vocabulary))


TAKEN = taken_by_rddl()


def collect(compilers: list[str]) -> dict[str, list[str]]:
    """Maps the origins of names to the names, as far as RDDL can spell them."""
    skeleton = in_files("templates/*", "runtime/rddl/step/compiled.hpp", "runtime/rddl/simulator*")
    for emitter in ("names/names", "lower/functions", "lower/about", "lower/tables", "emit"):
        strings = re.findall(r'"([^"\n]*)"', (ROOT / f"compiler/emit/{emitter}.cpp").read_text())
        skeleton |= identifiers(" ".join(strings))
    ours = in_files("runtime/rddl/**/*.h*", "compiler/emit/**/*.cpp", "generated/*.cpp")
    libraries, macros = set(), set()
    for compiler in compilers:
        for standard in ("-std=c++20", "-std=gnu++20"):
            libraries |= identifiers(preprocessed(compiler, standard, "-P"))
            for line in preprocessed(compiler, standard, "-dM").splitlines():
                macros |= set(re.findall(r"^#define (\w+)", line))
    words = identifiers((ROOT / "compiler/emit/names/reserved_words.cpp").read_text())
    sources = {"skeleton": skeleton, "ours": ours, "macros": macros, "words": words, "libraries": libraries}
    result = {}
    for source, names in sources.items():
        spelled = {re.sub("_+", "_", name.strip("_")) for name in names}
        result[source] = sorted(n for n in spelled if RDDL_NAME.fullmatch(n) and n not in TAKEN)
    return result


class Names:
    """Draws names, each once a problem."""

    def __init__(self, pool: dict[str, list[str]], seed: int):
        self.random = random.Random(seed)
        self.pool = pool
        self.drawn = set()
        self.twin = ""

    def __call__(self) -> str:
        while True:
            name = self.twin or self.varied(self.drawn_from_pool())
            self.twin = ""
            if name in self.drawn or not RDDL_NAME.fullmatch(name):
                continue
            if self.random.random() < 0.1:  # and one that C++ spells alike
                self.twin = self.random.choice(
                    [name.replace("_", "-"), name.replace("_", "--"), name.swapcase(), name + "-2"]
                )
                self.twin = "" if self.twin in TAKEN else self.twin
            self.drawn.add(name)
            return name

    def drawn_from_pool(self) -> str:
        source = self.random.choices(list(self.pool), weights=[6, 2, 3, 1, 2])[0]
        return self.random.choice(self.pool[source])

    def varied(self, name: str) -> str:
        """Varies the name so that a name derived from it is that of something else."""
        choice = self.random.randrange(12)
        if choice == 0:
            name = name.replace("_", "-")
        if choice == 1:
            for ending in ("_count", "_objects", "_lower", "_upper", "_values", "_places", "_2", "_0"):
                name = name.removesuffix(ending)
        if choice == 2:
            for beginning in ("initial_", "set_", "of_", "scope_", "rddl_"):
                name = name.removeprefix(beginning)
        if choice == 3:
            name = self.random.choice(["initial_", "set_", "of_", "scope_", "rddl_", "RDDL_"]) + name
        if choice == 4:
            name += self.random.choice(["_count", "_objects", "_lower", "_rows", "_2", "_entries"])
        return name if name not in TAKEN else "x_" + name

    def split(self) -> tuple[str, str]:
        """Two names that make one: 'size' and 't'."""
        while True:
            name = self.drawn_from_pool()
            at = [i for i, c in enumerate(name) if c == "_"]
            if at:
                i = self.random.choice(at)
                first, second = name[:i], name[i + 1 :]
                if all(RDDL_NAME.fullmatch(n) and n not in TAKEN for n in (first, second)):
                    return first, second


class Writer:
    """A problem with a name of each role for each of three types."""

    def __init__(self, names: Names, observes: bool, acts: bool):
        self.name, self.observes, self.acts = names, observes, acts
        self.pvariables, self.cpfs, self.values, self.initial, self.sums = [], [], [], [], []
        self.preconditions, self.invariants, self.terminations = [], [], []
        self.memories, self.decisions = [], []
        self.domain, self.instance = names.split()
        self.types = [(names(), [names() for _ in range(size)]) for size in (3, 2, 4)]
        self.mood, self.moods = names(), [names(), names(), names()]
        for type_name, objects in self.types:
            self.describe(type_name, objects)

    def declare(self, kind: str, *parameters: str) -> str:
        fluent = self.name()
        head = f"{fluent}({', '.join(parameters)})" if parameters else fluent
        self.pvariables.append(f"{head} : {{ {kind} }};")
        return fluent

    def describe(self, t: str, objects: list[str]):
        name, chance = self.name, self.name.random
        v, w = name(), name()
        u, partners = chance.choice(self.types)
        a, b, c = self.moods
        weight = self.declare("non-fluent, real, default = 0.5", t)
        link = self.declare("non-fluent, bool, default = false", t, u)
        target = self.declare(f"non-fluent, {t}", t)
        on = self.declare("state-fluent, bool, default = false", t)
        at = self.declare(f"state-fluent, {t}", t)
        amount = self.declare("state-fluent, real, default = 0.0", t)
        number = self.declare("state-fluent, int, default = 0")
        mood = self.declare(f"state-fluent, {self.mood}, default = @{b}", t)
        part = self.declare("interm-fluent, real", t)
        press = self.declare("action-fluent, bool, default = false", t)
        push = self.declare("action-fluent, real, default = 0.0")
        self.initial.append(f"{on}({objects[0]});")
        self.initial += [f"{at}({o}) = {objects[-1]};" for o in objects]
        for i, o in enumerate(objects):
            self.values += [f"{weight}({o}) = {i + 1}.25;", f"{target}({o}) = {chance.choice(objects)};"]
            self.values += [f"{link}({o}, {p});" for p in partners if chance.random() < 0.6]
        self.cpfs += [
            f"{part}(?{v}) = {weight}(?{v}) + (sum_{{?{w} : {u}}} [{link}(?{v}, ?{w})])"
            f" + {amount}({target}(?{v}));",
            f"{on}'(?{w}) = if ({press}(?{w})) then ~{on}(?{w})"
            f" else (exists_{{?{v} : {u}}} [{link}(?{w}, ?{v})]) ^ Bernoulli(0.5);",
            f"{at}'(?{v}) = if ({on}(?{v})) then {target}({at}(?{v})) else {at}(?{v});",
            f"{amount}'(?{v}) = max[-50, min[50, {amount}(?{v}) + {part}({at}(?{v})) - {push}"
            f" + Normal(0, 1)]];",
            f"{number}' = {number} + (sum_{{?{v} : {t}, ?{w} : {u}}} [{on}(?{v}) ^ {link}(?{v}, ?{w})]);",
            f"{mood}'(?{v}) = switch ({mood}(?{v})) {{case @{a} : @{b}, case @{b} : @{c}, default : @{a}}};",
        ]
        self.sums += [
            f"(sum_{{?{v} : {t}}} [{weight}(?{v}) * {on}(?{v}) + {amount}(?{v})])",
            f"{number} + (max_{{?{w} : {t}}} [{part}(?{w})])",
        ]
        self.preconditions += [f"forall_{{?{v} : {t}}} [{press}(?{v}) => {amount}(?{v}) <= 40];"]
        self.preconditions += [f"{push} <= 10;", f"{push} >= -10;"]
        self.invariants += [f"forall_{{?{w} : {t}}} [{amount}(?{w}) <= 1000];", f"{number} >= 0;"]
        self.terminations += [f"{number} > {chance.randrange(40)};"]
        seen = f"{amount}(?{v})"
        if self.observes:
            observed = self.declare("observ-fluent, real", t)
            heard = self.declare("observ-fluent, bool")
            self.cpfs += [
                f"{observed}(?{v}) = {amount}'(?{v}) + {weight}(?{v});",
                f"{heard} = exists_{{?{w} : {t}}} [{on}'(?{w})];",
            ]
            seen = f"{observed}(?{v})"
        if self.acts:
            memory = name()
            self.memories.append(f"{memory}({t}) : {{ state-fluent, real, default = 1.5 }};")
            self.decisions += [
                f"{press}(?{v}) = {seen} > {memory}(?{v});",
                f"{push} = min[10, max[-10, sum_{{?{v} : {t}}} [{memory}(?{v})]]];",
                f"{memory}'(?{v}) = {memory}(?{v}) + {seen} / 8;",
            ]

    def text(self) -> str:
        non_fluents, policy = self.name(), self.name()
        moods = ", ".join("@" + mood for mood in self.moods)
        lines = [f"domain {self.domain} {{", "types {"]
        lines += [f"    {t} : object;" for t, _ in self.types]
        lines += [f"    {self.mood} : {{{moods}}};", "};"]
        lines += ["pvariables {", *self.pvariables, "};", "cpfs {", *self.cpfs, "};"]
        lines += [f"reward = {' + '.join(self.sums)};"]
        lines += ["action-preconditions {", *self.preconditions, "};"]
        lines += ["state-invariants {", *self.invariants, "};"]
        lines += ["termination {", *self.terminations, "};", "}"]
        lines += [f"non-fluents {non_fluents} {{ domain = {self.domain};", "objects {"]
        lines += [f"    {t} : {{{', '.join(objects)}}};" for t, objects in self.types]
        lines += ["};", "non-fluents {", *self.values, "};", "}"]
        lines += [f"instance {self.instance} {{ domain = {self.domain};"]
        lines += [f"non-fluents = {non_fluents};", "init-state {", *self.initial, "};"]
        lines += ["max-nondef-actions = pos-inf; horizon = 8; discount = 0.9;", "}"]
        if self.acts:
            lines += [f"policy {policy} {{ pvariables {{", *self.memories]
            lines += ["}; cpfs {", *self.decisions, "}; }"]
        return "\n".join(lines) + "\n"


def first_errors(result) -> str:
    errors = [line for line in result.stderr.splitlines() if "error" in line or "warning" in line]
    return f"status {result.returncode}\n" + "\n".join(errors[-8:] or [result.stderr])


class Fuzzer:
    def __init__(self, options, folder: Path):
        self.options, self.folder = options, folder
        self.pool = collect(options.compilers)
        self.wrappers = []
        for number, compiler in enumerate(options.compilers):
            wrapper = folder / f"c++-{number}"
            wrapper.write_text(WRAPPER.format(compiler=compiler))
            wrapper.chmod(0o755)
            self.wrappers.append(wrapper)

    def run(self, seed: int) -> tuple[int, int, str]:
        """How many names were tried, and what failed."""
        names = Names(self.pool, seed)
        writer = Writer(names, observes=seed % 3 == 0, acts=seed % 2 == 0)
        text = writer.text()
        file = self.folder / f"names-{seed}.rddl"
        file.write_text(text)
        policy = "rddl" if writer.acts else "random"
        command = [self.options.rddl, "run", file, f"--policy={policy}", "--quiet", "--episodes", "20"]
        command += ["--seed", "1", "--threads", "1", "--trace", "-"]
        wrapper = self.wrappers[seed % len(self.wrappers)]
        environment = os.environ | {"CXX": str(wrapper), "XDG_CACHE_HOME": str(self.folder)}
        traces = []
        for engine in ("interpreter", "compiled"):
            result = subprocess.run(
                [*command, f"--engine={engine}"], capture_output=True, text=True, env=environment
            )
            if result.returncode != 0:
                return seed, len(names.drawn), self.keep(file, f"{engine}: {first_errors(result)}")
            traces.append(result.stdout.splitlines()[1:])
        for number, (first, second) in enumerate(zip(*traces)):
            if first != second:
                failure = f"step {number}\ninterpreter: {first}\ncompiled:    {second}\n"
                return seed, len(names.drawn), self.keep(file, failure)
        if len(traces[0]) != len(traces[1]) or len(traces[0]) < 20:
            return seed, len(names.drawn), self.keep(file, "traces of different length, or too short")
        file.unlink()
        return seed, len(names.drawn), ""

    def keep(self, file: Path, failure: str) -> str:
        self.options.failures.mkdir(parents=True, exist_ok=True)
        file.rename(self.options.failures / file.name)
        return f"{self.options.failures / file.name}\n{failure}"


def seeds(options):
    end = time.monotonic() + 3600 * options.hours
    seed = options.first
    while time.monotonic() < end if options.hours else seed < options.first + options.problems:
        yield seed
        seed += 1


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("--rddl", type=Path, default=ROOT / "build/bin/rddl")
    parser.add_argument("--problems", type=int, default=8)
    parser.add_argument("--hours", type=float, default=0)
    parser.add_argument("--first", type=int, default=1)
    parser.add_argument("--workers", type=int, default=1)
    parser.add_argument("--compilers", nargs="+", default=[os.environ.get("CXX", "c++")])
    parser.add_argument("--failures", type=Path, default=ROOT / "build/fuzz-failures")
    options = parser.parse_args()
    options.rddl = options.rddl.resolve()
    counts = Counter()
    with tempfile.TemporaryDirectory(prefix="fuzz-names-") as folder:
        fuzzer = Fuzzer(options, Path(folder))
        known = {source: len(names) for source, names in fuzzer.pool.items()}
        print(f"names to draw from: {known}", flush=True)
        with concurrent.futures.ThreadPoolExecutor(options.workers) as workers:
            pending = set()
            for seed in seeds(options):
                pending.add(workers.submit(fuzzer.run, seed))
                while len(pending) >= options.workers:
                    report(pending, counts)
            while pending:
                report(pending, counts)
    print(f"seeds from {options.first}: {dict(counts)}")
    return 1 if counts["failures"] else 0


def report(pending: set, counts: Counter):
    done, _ = concurrent.futures.wait(pending, return_when=concurrent.futures.FIRST_COMPLETED)
    for future in done:
        pending.remove(future)
        seed, names, failure = future.result()
        counts["problems"] += 1
        counts["names"] += names
        if failure:
            counts["failures"] += 1
            print(f"seed {seed}: {failure}", flush=True)


if __name__ == "__main__":
    sys.exit(main())
