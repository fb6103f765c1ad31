"""Compares one problem in pyRDDLGym and in rddlc: the same, or the first difference."""

import contextlib
import io
import json
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests/conformance"))

from model import REWARD, TERMINATED, TRUNCATED, Columns, stack  # noqa: E402
from ours import ReplayFailure, outcome_columns, request_line  # noqa: E402
from problems import Case  # noqa: E402
from rddl_problem import Problem  # noqa: E402
from reference import Reference  # noqa: E402

ROUGH = 1e-9  # relative, or 1e-7 absolute, of values whose last digits depend on rounding
REFUSED = (ValueError, ArithmeticError, TypeError, IndexError, SyntaxError, RuntimeError)


@dataclass
class Verdict:
    """The comparison's extent, and the first difference: its kind, stable while reduced, and its
    text."""

    values: int = 0
    steps: int = 0
    refused_steps: int = 0  # by the reference
    refused: str = ""  # by the reference, altogether
    kind: str = ""
    text: str = ""

    def fail(self, kind: str, text: str) -> "Verdict":
        self.kind, self.text = kind, text
        return self


def compare_with_reference(problem: Problem, folder: Path, rddl: Path, seed: int, steps: int) -> Verdict:
    """Steps from random states under random actions, in pyRDDLGym and in our interpreter."""
    verdict = Verdict()
    case = write(problem, folder)
    try:
        with contextlib.redirect_stdout(io.StringIO()):
            reference = Reference(case)
    except Exception as error:  # whatever it raises for what it does not support
        verdict.refused = f"{type(error).__name__}: {error}".splitlines()[0]
        return verdict
    rows = reference_steps(reference, seed, steps, verdict)
    if not rows:
        return verdict
    states, actions, outcomes, legal = zip(*rows)
    try:
        answers = replay(rddl, case, reference.problem, states, actions)
        for number, answer in enumerate(answers):
            if "error" in answer and "precondition" in answer["error"]:
                answer["legal"] = False
            elif "error" in answer or "fault" in answer:
                start = show(states[number], actions[number])
                return verdict.fail("refused", f"{answer.get('error') or answer['fault']}; {start}")
    except ReplayFailure as failure:
        return verdict.fail("replay", str(failure))
    for number, answer in enumerate(answers):
        if answer.get("legal", True) != legal[number]:
            start = show(states[number], actions[number])
            return verdict.fail("precondition", f"expected legal: {legal[number]}; {start}")
    kept = [number for number, answer in enumerate(answers) if answer.get("legal", True)]
    verdict.steps = len(kept)
    if not kept:
        return verdict
    found = outcome_columns(reference.problem, [answers[number] for number in kept])
    expected = stack([outcomes[number] for number in kept])
    return compare_columns(verdict, problem, expected, found, [show(states[n], actions[n]) for n in kept])


def reference_steps(reference: Reference, seed: int, steps: int, verdict: Verdict):
    """State, action, outcome and whether the preconditions hold."""
    random = np.random.default_rng(seed)
    rows = []
    state = reference.initial_state()
    for number in range(steps):
        try:
            if not reference._is_running(state):
                state = random_state(reference, random)
                continue
            action = random_action(reference, random)
            reference.simulator.subs = reference._table(state)
            actions = reference._action(action)
            legal = reference.simulator.check_action_preconditions(actions, silent=True)
            outcome = reference.step(state, action)
        except REFUSED:
            verdict.refused_steps += 1
            state = random_state(reference, random)
            continue
        rows.append((state, action, outcome, bool(legal)))
        follows = random.random() < 0.5 and not outcome[TERMINATED][0]
        if follows:
            state = {f.name: outcome[f.name] for f in reference.problem.states}
        else:
            state = random_state(reference, random)
    return rows


def random_state(reference: Reference, random) -> dict:
    return {f.name: random_values(f, random) for f in reference.problem.states}


def random_action(reference: Reference, random) -> dict:
    """Keeps to at most max-nondef-actions values that are not the default."""
    default = reference.default_action()
    wild = {f.name: random_values(f, random) for f in reference.problem.actions}
    return thin(reference, wild, default, random)


def thin(reference: Reference, wild: dict, default: dict, random) -> dict:
    entries = [(name, i) for name in wild for i in range(len(wild[name])) if random.random() < 0.7]
    random.shuffle(entries)
    action = {name: np.copy(values) for name, values in default.items()}
    for name, index in entries[: int(reference.model.max_allowed_actions)]:
        action[name][index] = wild[name][index]
    return action


def random_values(fluent, random) -> np.ndarray:
    """Reals are multiples of a quarter, so that sums and products of few are exact."""
    count = len(fluent.groundings)
    if fluent.range == "bool":
        return random.random(count) < 0.5
    if fluent.objects:
        return random.integers(len(fluent.objects), size=count)
    limit = random.choice([2, 10, 100])
    if fluent.range == "int":
        return random.integers(-limit, limit + 1, size=count)
    return random.integers(-4 * limit, 4 * limit + 1, size=count) / 4.0


def replay(rddl: Path, case: Case, description, states, actions) -> list[dict]:
    lines = [request_line(description, s, a) for s, a in zip(states, actions)]
    command = [rddl, "replay", case.domain_path, case.instance_path, "--seed", "1", "--horizon", "0"]
    command += ["--preconditions=error", "--engine=interpreter"]
    result = execute(command, "".join(lines))
    if result.returncode != 0:
        raise ReplayFailure(f"exit status {result.returncode}: {result.stderr}")
    answers = [json.loads(line) for line in result.stdout.splitlines()]
    if len(answers) != len(lines):
        raise ReplayFailure(f"{len(lines)} lines asked, {len(answers)} answered")
    return answers


def compare_columns(verdict, problem: Problem, expected: Columns, found: Columns, starts) -> Verdict:
    for name, values in expected.items():
        exact = is_exact(problem, name)
        same = equal(values, found[name], exact)
        verdict.values += values.size
        if not same.all():
            row, index = np.argwhere(~same)[0]
            text = f"{name}[{index}]: pyRDDLGym {values[row, index]!r}, rddlc {found[name][row, index]!r}"
            return verdict.fail("reference", f"{text}{'' if exact else ' (rounded)'}; {starts[row]}")
    return verdict


def is_exact(problem: Problem, name: str) -> bool:
    if name == REWARD:
        return problem.reward.kind != "real" or problem.reward.is_exact()
    if name in (TERMINATED, TRUNCATED):
        return True
    fluent = problem.fluent(name)
    return fluent.range != "real" or fluent.is_exact()


def equal(expected: np.ndarray, found: np.ndarray, exact: bool) -> np.ndarray:
    if expected.dtype.kind != "f":
        return expected == found
    with np.errstate(all="ignore"):
        same = (expected == found) | (np.isnan(expected) & np.isnan(found))
        if exact:
            return same
        difference = np.abs(expected - found)
        scale = np.maximum(np.abs(expected), np.abs(found))
        return same | (difference <= np.maximum(1e-7, ROUGH * scale))


def write(problem: Problem, folder: Path) -> Case:
    folder.mkdir(parents=True, exist_ok=True)
    case = Case("fuzz", "1", folder / "domain.rddl", folder / "instance.rddl")
    case.domain_path.write_text(problem.domain_text())
    case.instance_path.write_text(problem.instance_text())
    return case


def execute(command, text: str = "") -> subprocess.CompletedProcess:
    command = [str(word) for word in command]
    try:
        return subprocess.run(command, input=text, capture_output=True, text=True, timeout=120)
    except subprocess.TimeoutExpired:
        return subprocess.CompletedProcess(command, 124, "", "no answer within 120 s")


def show(state: dict, action: dict) -> str:
    def plain(values):
        return {name: array.tolist() for name, array in values.items()}

    return f"state {plain(state)} action {plain(action)}"
