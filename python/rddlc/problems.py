"""Loads simulators from files, or from a name of rddlrepository."""

from __future__ import annotations

import atexit
import hashlib
import os
import shutil
import sys
import tempfile
import time
import warnings
import weakref
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property, lru_cache
from importlib.util import find_spec
from pathlib import Path
from typing import Any

from . import _native
from .arguments import flag, one_of, text, whole_or_none
from .errors import ArgumentError
from .model import Model, model_of
from .states import StateForm

ENGINES = ("auto", "compiled", "interpreter")
NO_HORIZON = -1  # of a batch; its 0 is the instance's


def batch_horizon(horizon: int | None) -> int:
    """Converts a user's horizon to a batch's: None is the instance's, and 0 is no horizon."""
    given = whole_or_none("horizon", horizon, 0)
    return 0 if given is None else given or NO_HORIZON


@dataclass(frozen=True)
class ListedProblem:
    """A problem of rddlrepository."""

    name: str
    instances: tuple[str, ...]
    description: str


class Problem:
    """A problem that is loaded: what `rddlc.make` makes environments of. Pickled by its files."""

    def __init__(
        self,
        domain: str | os.PathLike[str],
        instance: str | int | os.PathLike[str] | None = None,
        *,
        instance_name: str = "",
        engine: str = "auto",
        externs: Sequence[str | os.PathLike[str]] = (),
        extended: bool = False,
        details: bool = False,
    ) -> None:
        """`domain` and `instance` are two files, one file that holds both, a folder and the name of
        its instance, or a problem and an instance of rddlrepository.

        instance_name: the name of the instance to take, where the files hold several; else the last.
        engine: "auto" starts at once with the interpreter, and changes to the compiled simulator, in the
            middle of an episode if need be, when it is ready in the background: the values are the
            same to the last bit. "compiled" waits for it (kept in ~/.cache/rddlc), "interpreter" needs
            no C++ compiler.
        externs: C++ headers that define external functions.
        extended: whether the extensions of docs/dialects.md are allowed.
        details: whether a compiled problem can be asked for interm-fluents; an interpreted one always
            can.

        Raises CompileError with the compiler's diagnostics, and Error where files are missing.
        """
        one_of("engine", engine, ENGINES)
        if isinstance(externs, (str, bytes, os.PathLike)):
            raise ArgumentError(f"externs is a list of headers, not {externs!r}")
        self._options: dict[str, Any] = {
            "instance_name": text("instance_name", instance_name),
            "engine": engine,
            "externs": tuple(_native.path_text(each) for each in externs),
            "extended": flag("extended", extended),
            "details": flag("details", details),
        }
        domain, instance = _written(domain, instance)
        self.engine = _engine_at_hand(engine)
        self.simulator = self._load(
            domain,
            _name_of(instance),
            is_path=_native.is_path(domain),
            engine=self.engine,
            details=details,
        )
        self.name: str = self.simulator.name
        if not self.simulator.is_settled:
            _building.add(self)

    def _load(
        self, domain: Any, instance: Any, *, is_path: bool, engine: str, details: bool
    ) -> _native.Simulator:
        return _native.load(
            domain,
            instance,
            repository="" if is_path else repository_folder(),
            instance_name=self._options["instance_name"],
            engine=engine,
            externs=list(self._options["externs"]),
            extended=self._options["extended"],
            details=details or engine == "interpreter",
            on_compiling=_tell_compiling,
        )

    @property
    def is_compiled(self) -> bool:
        """Whether the compiled simulator is there: with engine="auto", later than the problem."""
        return self.simulator.is_compiled

    def wait(self, timeout: float | None = None) -> bool:
        """Waits until what engine="auto" builds in the background is there, or has failed, or these
        seconds are over. Returns whether the compiled simulator is there."""
        end = None if timeout is None else time.monotonic() + timeout
        while not self.simulator.is_settled and (end is None or time.monotonic() < end):
            time.sleep(0.005)
        return self.is_compiled

    @property
    def has_details(self) -> bool:
        """Whether the simulator reports interm-fluents, and objects that violate a precondition."""
        return self.engine == "interpreter" or self._options["details"]

    @cached_property
    def detailed(self) -> _native.Simulator:
        """The same problem, interpreted, with details."""
        domain, *instance = self.files
        return self._load(domain, "".join(instance), is_path=True, engine="interpreter", details=True)

    @cached_property
    def model(self) -> Model:
        return model_of(self.simulator.describe())

    @cached_property
    def state_form(self) -> StateForm:
        return StateForm(self.model)

    @property
    def files(self) -> list[str]:
        """The domain's and, unless it is the same, the instance's."""
        return [os.path.abspath(each) for each in self.simulator.files]

    @property
    def externs(self) -> tuple[str, ...]:
        """Headers of external functions."""
        return self._options["externs"]

    def constants(self, fluent: str) -> list[Any]:
        """The values, row-major, that the instance fixes: of a non-fluent; of a state-fluent at the
        start; the defaults of an action-fluent."""
        return self.simulator.constants(self.model.fluents[fluent].index)

    @property
    def options(self) -> dict[str, Any]:
        """Those that it was loaded with."""
        return dict(self._options)

    def __reduce__(self) -> tuple[Any, ...]:
        return _load_again, (self.files, self._options)

    def __repr__(self) -> str:
        return f"Problem({self.name!r}, engine={self.engine!r})"


# Problems that are built in the background. A compiler must not outlive the process.
_building: weakref.WeakSet[Problem] = weakref.WeakSet()


@atexit.register
def _stop_building() -> None:
    for problem in list(_building):
        problem.simulator.stop_building()


def _tell_compiling(name: str) -> None:
    """Says what a call waits for."""
    print(f"rddlc: compiling {name}, once; engine='auto' does not wait", file=sys.stderr, flush=True)


def _written(domain: Any, instance: Any) -> tuple[Any, Any]:
    """Texts of RDDL become files."""
    given = {"domain.rddl": domain, "instance.rddl": instance}
    texts = {name: text for name, text in given.items() if isinstance(text, str) and "{" in text}
    files = dict(zip(texts, files_of_texts(texts))) if texts else {}
    return files.get("domain.rddl", domain), files.get("instance.rddl", instance)


def files_of_texts(texts: Mapping[str, str]) -> list[str]:
    """The texts as files, which are written once for each user and content: domain, instance."""
    content = hashlib.sha256(repr(sorted(texts.items())).encode()).hexdigest()[:16]
    folder = Path(tempfile.gettempdir()) / f"rddlc-{os.getuid()}" / content
    folder.mkdir(parents=True, exist_ok=True)
    files = []
    for name, text in texts.items():
        file = folder / name
        if not file.exists():
            fresh = folder / f"{name}.{os.getpid()}"
            fresh.write_text(text)
            fresh.replace(file)  # other processes write it, too
        files.append(str(file))
    return files


def _name_of(instance: Any) -> str | bytes | os.PathLike[str]:
    """A path, a name or a number."""
    if instance is None:
        return ""
    return instance if isinstance(instance, (bytes, os.PathLike)) else str(instance)


def _load_again(files: list[str], options: dict[str, Any]) -> Problem:
    return Problem(*files, **options)


def repository_folder() -> str:
    """Returns the folder of rddlrepository: $RDDL_REPOSITORY, else the installed package; "" if it
    is missing."""
    if given := os.environ.get("RDDL_REPOSITORY"):
        return given
    spec = find_spec("rddlrepository")
    if spec is None or not spec.submodule_search_locations:
        return ""
    return next(iter(spec.submodule_search_locations))


def problems() -> list[ListedProblem]:
    """Returns all problems of rddlrepository, by name; an empty dictionary if it is not installed."""
    folder = repository_folder()
    return list(_problems_in(folder)) if folder else []


@lru_cache(maxsize=4)
def _problems_in(folder: str) -> tuple[ListedProblem, ...]:
    listed = _native.problems_in(folder)
    return tuple(ListedProblem(name, tuple(instances), text) for name, instances, text in listed)


def _engine_at_hand(engine: str) -> str:
    if engine != "interpreter" and not _has_cpp_compiler():
        return "interpreter"
    return engine


@lru_cache(maxsize=1)
def _has_cpp_compiler() -> bool:
    """Warns, once, if the compiler is missing."""
    command = _native.cpp_compiler()[0]
    if shutil.which(command):
        return True
    warnings.warn(
        f"there is no C++ compiler '{command}': problems are interpreted, which is slower. "
        "Install one, set CXX, or say engine='interpreter'",
        stacklevel=5,
    )
    return False
