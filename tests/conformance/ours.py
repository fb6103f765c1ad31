"""Our side: the same steps through `rddl replay`, one process an instance and engine."""

import json
import subprocess
import tempfile
import time
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from model import REWARD, TERMINATED, TRUNCATED, Columns, DrawPoint, Problem, Transitions, Values
from problems import Case


class ReplayFailure(Exception):
    """`rddl replay` failed, or refused a line."""


@dataclass
class Replayed:
    transitions: Columns
    draws: list[Columns]  # one for each draw point
    text: bytes  # the whole output, to compare engines
    seconds_a_step: float


def replay(
    rddl: Path,
    case: Case,
    problem: Problem,
    walk: Transitions,
    points: list[DrawPoint],
    engine: str,
) -> Replayed:
    """All transitions and draws of one instance."""
    lines = [request_line(problem, state, action) for state, action in walk.starts(len(walk))]
    lines += [request_line(problem, p.state, p.action, repeat=p.count()) for p in points]
    begin = time.perf_counter()
    answers, text = ask(rddl, case, lines, engine)
    steps = len(walk) + sum(point.count() for point in points)
    return Replayed(
        transitions=outcome_columns(problem, answers[: len(walk)]),
        draws=[outcome_columns(problem, answer["samples"]) for answer in answers[len(walk) :]],
        text=text,
        seconds_a_step=(time.perf_counter() - begin) / steps,
    )


def faults(
    rddl: Path, case: Case, problem: Problem, starts: list[tuple[Values, Values]], engine: str
) -> list[str | None]:
    """The fault's message for each state and action, or nothing where the step succeeds."""
    lines = [request_line(problem, state, action) for state, action in starts]
    return [answer.get("fault") for answer in ask(rddl, case, lines, engine)[0]]


def ask(rddl: Path, case: Case, lines: list[str], engine: str) -> tuple[list[dict], bytes]:
    """Returns the answers of `rddl replay`, line by line. The horizon is off: lines are independent
    steps."""
    with tempfile.TemporaryDirectory(prefix="conformance-") as folder:
        asked, answered = Path(folder, "input.jsonl"), Path(folder, "output.jsonl")
        asked.write_text("".join(lines))
        command = [rddl, "replay", *problem_words(case)]
        command += ["--input", asked, "--output", answered]
        command += ["--seed", "1", "--horizon", "0", f"--engine={engine}"]
        result = subprocess.run(list(map(str, command)), capture_output=True, text=True)
        if result.returncode != 0:
            raise ReplayFailure(f"exit status {result.returncode}: {last_lines(result.stderr)}")
        text = answered.read_bytes()
    answers = [json.loads(line) for line in text.splitlines()]
    if len(answers) != len(lines):
        raise ReplayFailure(f"{len(lines)} lines asked, {len(answers)} answered")
    for number, answer in enumerate(answers):
        if "error" in answer:
            raise ReplayFailure(f"line {number + 1} refused: {answer['error']}")
    return answers, text


def trace(
    rddl: Path, case: Case, engine: str, episodes: int, horizon: int | None = None
) -> list[str]:
    """The steps of some episodes of random actions, as lines of a trace without its header."""
    command = [rddl, "run", *problem_words(case), f"--engine={engine}", "--quiet"]
    command += ["--episodes", episodes, "--seed", 1, "--threads", 1, "--trace", "-"]
    if horizon is not None:
        command += ["--horizon", horizon]
    result = subprocess.run(list(map(str, command)), capture_output=True, text=True)
    has_trace = result.returncode == 0 or " episodes faulted; " in result.stderr
    if not has_trace:
        raise ReplayFailure(f"exit status {result.returncode}: {last_lines(result.stderr)}")
    return result.stdout.splitlines()[1:]  # the header names the engine


def problem_words(case: Case) -> list:
    functions = ["--extern", case.header] if case.header else []
    return [case.domain_path, case.instance_path, *functions, *case.options]


def request_line(problem: Problem, state: Values, action: Values, **more) -> str:
    request = {
        "state": encode(problem.states, state),
        "action": encode(problem.actions, action),
        **more,
    }
    return json.dumps(request) + "\n"


def encode(fluents, values: Values) -> dict:
    """Values by grounded name."""
    return {
        name: value
        for fluent in fluents
        for name, value in fluent.encode(values[fluent.name]).items()
    }


def outcome_columns(problem: Problem, answers: list[dict]) -> Columns:
    for answer in answers:
        if "fault" in answer:
            raise ReplayFailure(f"faulted: {answer['fault']}")
    states = [answer["state"] for answer in answers]
    observations = [answer["observation"] for answer in answers]
    columns = {fluent.name: fluent.decode(states) for fluent in problem.states}
    columns |= {fluent.name: fluent.decode(observations) for fluent in problem.observations}
    rewards = [float(answer["reward"]) for answer in answers]  # "nan" and "inf" are in quotes
    columns[REWARD] = np.array(rewards, dtype=np.float64).reshape(-1, 1)
    for name, member in ((TERMINATED, "terminated"), (TRUNCATED, "truncated")):
        columns[name] = np.array([answer[member] for answer in answers], dtype=np.bool_)
        columns[name] = columns[name].reshape(-1, 1)
    return columns


def last_lines(text: str, count: int = 6) -> str:
    return "\n".join(text.strip().splitlines()[-count:])
