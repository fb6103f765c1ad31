"""Keeps recordings of the reference on disk, so that only the first run waits for it."""

import hashlib
import pickle
from importlib.metadata import version
from pathlib import Path

from problems import Case
from reference import Plan, Recording, record

PACKAGES = ("pyRDDLGym", "rddlrepository", "numpy")
SOURCES = ("model.py", "reference.py")  # what the contents of a recording depend on


def recording_of(case: Case, plan: Plan, folder: Path | None) -> Recording:
    """From the folder if it is there, else from the reference."""
    if folder is None:
        return record(case, plan)
    path = folder / f"{case.problem}-{case.instance}-{fingerprint(case, plan)}.pickle"
    if path.exists():
        return pickle.loads(path.read_bytes())
    recording = record(case, plan)
    folder.mkdir(parents=True, exist_ok=True)
    unfinished = path.with_suffix(".part")
    unfinished.write_bytes(pickle.dumps(recording))
    unfinished.rename(path)
    return recording


def fingerprint(case: Case, plan: Plan) -> str:
    """Changes with anything that the recording depends on."""
    digest = hashlib.sha256(repr([plan, *(f"{name} {version(name)}" for name in PACKAGES)]).encode())
    for path in (case.domain_path, case.instance_path):
        digest.update(path.read_bytes())
    for name in SOURCES:
        digest.update(Path(__file__).with_name(name).read_bytes())
    return digest.hexdigest()[:16]
