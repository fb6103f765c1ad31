"""Keeps recordings of the reference on disk, so that only the first run waits for it."""

import hashlib
import pickle
from importlib.metadata import version
from pathlib import Path

from problems import Case
from reference import Plan, Recording, record
from refusals import RefusalPlan, Refusals, record_refusals

PACKAGES = ("pyRDDLGym", "rddlrepository", "numpy")
SOURCES = ("model.py", "reference.py")  # what the contents of a recording depend on
REFUSAL_SOURCES = (*SOURCES, "refusals.py")


def recording_of(case: Case, plan: Plan, folder: Path | None) -> Recording:
    return kept(case, plan, folder, "", SOURCES, record)


def refusals_of(case: Case, plan: RefusalPlan, folder: Path | None) -> Refusals:
    return kept(case, plan, folder, "-refusals", REFUSAL_SOURCES, record_refusals)


def kept(case: Case, plan, folder: Path | None, suffix: str, sources: tuple[str, ...], record):
    """Returns the recording from the folder if it is there, else from the reference."""
    if folder is None:
        return record(case, plan)
    mark = fingerprint(case, plan, sources)
    path = folder / f"{case.problem}-{case.instance}-{mark}{suffix}.pickle"
    if path.exists():
        return pickle.loads(path.read_bytes())
    recording = record(case, plan)
    folder.mkdir(parents=True, exist_ok=True)
    unfinished = path.with_suffix(".part")
    unfinished.write_bytes(pickle.dumps(recording))
    unfinished.rename(path)
    return recording


def fingerprint(case: Case, plan, sources: tuple[str, ...]) -> str:
    """Changes with anything that the recording depends on."""
    digest = hashlib.sha256(repr([plan, *(f"{name} {version(name)}" for name in PACKAGES)]).encode())
    for path in (case.domain_path, case.instance_path, case.python_functions):
        digest.update(path.read_bytes() if path else b"")
    for name in sources:
        digest.update(Path(__file__).with_name(name).read_bytes())
    return digest.hexdigest()[:16]
