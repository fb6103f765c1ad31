#!/usr/bin/env python3
"""Runs every probe of probes/*.txt in pyRDDLGym and compares with what the files say.

Development only: the C++ tests check rddlc's side of the same file. Needs pyRDDLGym.
    python tests/check/compare_probes.py [part of a probe]
"""

import contextlib
import io
import pathlib
import re
import sys
import tempfile
import warnings

FOLDER = pathlib.Path(__file__).parent / "probes"
PROBE = re.compile(r"^(?P<text>[^#].*?)\s*// (?P<said>.*)$")
STEPS = 5


def problem_with(probe: str) -> str:
    """The problem with the change, or with the definition in the place of the one of its name."""
    text = (FOLDER / "problem.rddl").read_text()
    if " ==>" in probe:
        old, new = (part.strip().replace("\\n", "\n") for part in probe.split(" ==>"))
        assert old in text, old
        return text.replace(old, new, 1)
    head, cpfs_on = text.split("    cpfs {\n", 1)
    cpfs, tail = cpfs_on.split("    };\n", 1)
    name = re.match(r"[\w-]+", probe).group()
    if name == "reward":
        return head + "    cpfs {\n" + cpfs + "    };\n" + tail.replace("reward = 0;", probe)
    if probe.endswith("};") and "{" in probe.split("=")[0]:
        return head + "    cpfs {\n" + cpfs + "    };\n" + tail.replace("reward = 0;", "reward = 0; " + probe)
    kept = [line for line in cpfs.splitlines() if not re.match(rf"\s*{name}['( =]", line)]
    return head + "    cpfs {\n" + "\n".join(kept + ["        " + probe]) + "\n    };\n" + tail


def outcome(text: str) -> tuple[str, str]:
    """accepts, load, step or path; and the exception."""
    from pyRDDLGym import RDDLEnv

    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder) / "problem.rddl"
        path.write_text(text)
        try:
            environment = RDDLEnv(str(path), None)
        except Exception as error:  # noqa: BLE001: whatever it raises
            return "load", f"{type(error).__name__}: {error}"
        step = 0
        try:
            environment.reset(seed=1)
            for step in range(STEPS):
                actions = {"ab": bool(step % 2), "ai": step}
                _, _, terminated, truncated, _ = environment.step(actions)
                if terminated or truncated:
                    break
            environment.sampler.check_action_preconditions(environment.sampler.noop_actions, silent=True)
        except Exception as error:  # noqa: BLE001
            return ("step" if step == 0 else "path"), f"{type(error).__name__}: {error}"
    return "accepts", ""


def main() -> int:
    wanted = sys.argv[1] if len(sys.argv) > 1 else ""
    differences = 0
    lines = [line for file in sorted(FOLDER.glob("*.txt")) for line in file.read_text().splitlines()]
    for line in lines:
        match = PROBE.match(line)
        if not match or wanted not in line:
            continue
        words = match["said"].split(",")[0].split()
        codes = [word for word in words if re.fullmatch(r"[EW]\d{4}|ok", word)]
        assert codes, line
        said = words[len(codes)] if len(words) > len(codes) else "accepts"
        with contextlib.redirect_stdout(io.StringIO()), contextlib.redirect_stderr(io.StringIO()), warnings.catch_warnings():
            warnings.simplefilter("ignore")
            found, why = outcome(problem_with(match["text"].strip()))
        if found != said:
            differences += 1
            print(f"{match['text'].strip()}\n    said {said} ({' '.join(codes)}), pyRDDLGym: {found}  {why[:200]}")
    print(f"{differences} differences")
    return min(differences, 1)


if __name__ == "__main__":
    sys.exit(main())
