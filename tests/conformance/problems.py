"""Finds the problems to compare: rddlrepository's by name, and the project's own examples."""

from dataclasses import dataclass
from functools import cache
from pathlib import Path

import rddlrepository
from rddlrepository.core.manager import RDDLRepoManager

ROOT = Path(__file__).resolve().parents[2]

CORE = (
    "MountainCar_ippc2023",
    "MountainCar_Continuous_gym",
    "MountainCar_Discrete_gym",
    "CartPole_Continuous_gym",
    "CartPole_Discrete_gym",
    "Pendulum_gym",
    "Reservoir_ippc2023",
    "HVAC_ippc2023",
    "PowerGen_ippc2023",
    "SysAdmin_MDP_ippc2011",
    "GameOfLife_MDP_ippc2011",
    "Wildfire_MDP_ippc2014",
    "Elevators_POMDP_ippc2011",
    "Navigation_MDP_ippc2011",
)


@dataclass(frozen=True)
class Case:
    """One instance of one problem."""

    problem: str
    instance: str
    domain_path: Path
    instance_path: Path
    options: tuple[str, ...] = ()  # with which ours is compiled: --without=PASS, --fast-math

    @property
    def label(self) -> str:
        return f"{self.problem} {self.instance}"

    # The external functions, where there are any, lie beside the domain: once for us, once for
    # pyRDDLGym.

    @property
    def header(self) -> Path | None:
        return self._beside("functions.hpp")

    @property
    def python_functions(self) -> Path | None:
        return self._beside("functions.py")

    def _beside(self, name: str) -> Path | None:
        path = self.domain_path.with_name(name)
        return path if path.exists() else None


def repository_cases(problem: str) -> list[Case]:
    """All instances of a problem of rddlrepository, in order of their numbers."""
    if problem in problems_without_metadata():
        return cases_of_folder(problem, problems_without_metadata()[problem])
    info = RDDLRepoManager().get_problem(problem)
    names = sorted(map(str, info.list_instances()), key=lambda name: (len(name), name))
    return [
        Case(problem, name, Path(info.get_domain()), Path(info.get_instance(name)))
        for name in names
    ]


@cache
def problems_without_metadata() -> dict[str, Path]:
    """Folders of rddlrepository that its manager does not know, under the names of `rddl list`: one
    for each problem and competition, such as Name_p3_ippc2018."""
    manager = RDDLRepoManager()
    domains = (Path(manager.get_problem(problem).get_domain()) for problem in manager.list_problems())
    known = {domain.resolve().parent for domain in domains}
    archive = Path(rddlrepository.__path__[0], "archive").resolve()
    folders = {path.parent for path in archive.rglob("domain.rddl")} - known
    problems = {}
    for folder in sorted(folders):
        _, competition, *parts = folder.relative_to(archive).parts
        problems["_".join([*parts, competition.lower()])] = folder
    return problems


def example_cases() -> list[Case]:
    """The problems of examples/."""
    return cases_in(ROOT / "examples")


def probe_cases() -> list[Case]:
    """The problems of probes/: what no problem of the repository uses; and a case for each rule."""
    probes = Path(__file__).with_name("probes")
    return cases_in(probes) + cases_in(ROOT / "tests/cases", "meaning-*")


def cases_in(folder: Path, names: str = "*") -> list[Case]:
    """The problems in the subfolders of these names."""
    domains = sorted(folder.glob(f"{names}/domain.rddl"))
    return [case for path in domains for case in cases_of_folder(path.parent.name, path.parent)]


def cases_of_folder(problem: str, folder: Path) -> list[Case]:
    """The instances in one folder."""
    return [
        Case(problem, path.stem.removeprefix("instance") or "1", folder / "domain.rddl", path)
        for path in sorted(folder.glob("instance*.rddl"))
    ]


def all_problems() -> list[str]:
    """The names of all problems of rddlrepository."""
    return sorted([*map(str, RDDLRepoManager().list_problems()), *problems_without_metadata()])


def cases_of(problems: list[str]) -> list[Case]:
    """Returns all instances of these problems of rddlrepository; of all problems without a name."""
    return [case for problem in problems or all_problems() for case in repository_cases(problem)]


def spread_by_size(cases: list[Case], count: int | None) -> list[Case]:
    """Up to so many instances of one problem, by the size of their text: the smallest, the largest, then those
    between; all without a count."""
    if count is None:
        return cases
    by_size = sorted(cases, key=lambda case: (case.instance_path.stat().st_size, case.instance))
    if count == 1:
        return by_size[:1]
    picked = {min(i * len(by_size) // (count - 1), len(by_size) - 1) for i in range(count)}
    return [by_size[index] for index in sorted(picked)]
