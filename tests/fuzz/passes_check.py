"""Asks fuzz_passes whether the passes keep their contracts on a problem (contracts.hpp)."""

import json
import re
import signal
import subprocess
from dataclasses import dataclass, field
from pathlib import Path

from rddl_problem import Problem

STEPS = 12


@dataclass
class Finding:
    """Something wrong. Kinds stay the same while a problem is reduced."""

    kind: str
    text: str


@dataclass
class Answer:
    outcome: str  # accepted, too large, contradictory, rejected, crashed
    changed: dict[str, int] = field(default_factory=dict)  # runs of passes that changed something
    findings: list[Finding] = field(default_factory=list)


class PassChecker:
    """One process for many problems; a new one after each that ends it."""

    def __init__(self, program: Path, without: tuple[str, ...] = ()):
        self.program = program
        self.without = without
        self.process = None

    def check(self, problem: Problem, seed: int, all_stages: bool = False) -> Answer:
        request = {"text": problem.text(), "seed": seed, "steps": STEPS, "all_stages": all_stages}
        request |= {"wild": problem.flavour == "wild", "fast_math": problem.flavour == "finite"}
        return self.ask(request | {"without": self.without})

    def ask(self, request: dict) -> Answer:
        if self.process is None:
            self.process = subprocess.Popen(
                [self.program], stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
            )
        line = self.line_for(request)
        return answer_of(json.loads(line)) if line else self.end_of_process()

    def line_for(self, request: dict) -> str:
        """Empty if the process ended, before the request or while it worked."""
        try:
            print(json.dumps(request), file=self.process.stdin, flush=True)
        except BrokenPipeError:
            return ""
        return self.process.stdout.readline()

    def end_of_process(self) -> Answer:
        _, errors = self.process.communicate()
        status, self.process = self.process.returncode, None
        if status == -signal.SIGPROF:
            return Answer("crashed", {}, [Finding("too slow", "20 seconds of the processor")])
        return Answer("crashed", {}, [Finding("crash", f"exit status {status}: {errors[-1000:]}")])

    def close(self) -> None:
        if self.process:
            self.process.stdin.close()
            self.process.wait()


def is_contradictory(diagnostics: str) -> bool:
    """Whether all that is wrong is that constraints of a fluent's values exclude each other, as drawn ones may."""
    return set(re.findall(r" error: .* \[(E[0-9]+)\]", diagnostics)) == {"E0602"}


def answer_of(answer: dict) -> Answer:
    if is_contradictory(answer["error"]):
        return Answer("contradictory")
    findings = [Finding(kind_of(b["pass"], b["text"]), f"{b['pass']}: {b['text']}") for b in answer["breaches"]]
    if answer["error"]:
        kind = "rejected" if answer["outcome"] == "rejected" else "internal error"
        findings.append(Finding(kind, answer["error"]))
    # An invalid program stays so in the passes behind it.
    return Answer(answer["outcome"] or "crashed", answer.get("changed", {}), findings[:1] if is_invalid(findings) else findings)


def is_invalid(findings: list[Finding]) -> bool:
    return any(f.kind.endswith("invalid IR") for f in findings)


def kind_of(pass_name: str, text: str) -> str:
    return f"{pass_name}: {'invalid IR' if text.startswith('the IR') else 'other values'}"
