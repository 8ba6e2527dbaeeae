# SPDX-License-Identifier: BSD-3-Clause
"""The families of motions: a folder each, of the name that the scene file calls its kind.

families/KIND/
    functions.py   the functions over arrays, public as gyrostat.KIND
    scene.py       KEYS and ALTERNATIVES of the scene file, an EXAMPLE of every key without default, `arguments` of `solve` from a checked
                   scene (the forms of an attitude come by themselves: orientation.py); for checks that take more than one key `mistakes`, and where an argument has not the name of its key ARGUMENTS
    chart.py       `problem` of a scene: what is charted, for charts/
    rows.py        `request` of the rows of a sweep; where scenes of the kind do not all have the same numbers
    figures.py     `figure` of an answer
    gallery.py     `figures` of the paper and their `drawings`
    stability.py   `report` of a scene, its `tables`, `sentence` and `plot`; where the question has a meaning
Columns, scalars, rungs and integrators are those of the compiled ladder (facts.py).
"""

from collections.abc import Callable, Mapping
from copy import deepcopy
from dataclasses import dataclass
from functools import cache, cached_property, partial
from importlib import import_module
from importlib.util import find_spec
from typing import TYPE_CHECKING, Any, Final

import numpy as np

from gyrostat.answer import Answer
from gyrostat.facts import FACTS, Facts
from gyrostat.fields import TIMES, Choices, Field, Found, Table, Values, head_keys, needed, solve_keys
from gyrostat.orientation import EXAMPLE, FORMS, with_alternatives, with_forms

if TYPE_CHECKING:
    from gyrostat.scenes import Scene

__all__ = ["FAMILIES", "Family", "answer_of"]


def _nothing(_: Values) -> Found:
    yield from ()


@cache
def _module(kind: str, name: str) -> Any:
    return import_module(f"{__name__}.{kind}.{name}")


@dataclass(frozen=True, eq=False)
class Family:
    """A kind of scene and all that belongs to it."""

    name: str

    @property
    def facts(self) -> Facts:
        """What the compiled ladder says of the family."""
        return FACTS[self.name]

    @cached_property
    def keys(self) -> dict[str, Table]:
        """The keys of the scene file by table; "" is the top."""
        own: dict[str, Table] = {table: with_forms(fields) for table, fields in self._module("scene").KEYS.items()}
        solve = (*solve_keys(self.facts.rungs, self.facts.integrators), *own.pop("solve", ()))
        return {"": (*head_keys(self.name), *own.pop("", ())), "solve": solve, **own}

    @cached_property
    def alternatives(self) -> tuple[Choices, ...]:
        """What can be given in one of several ways."""
        return (TIMES, *with_alternatives(self._module("scene").ALTERNATIVES))

    @cached_property
    def example(self) -> dict[str, Any]:
        """A value of every key without default, by full key: a body to start from."""
        own: dict[str, Any] = self._module("scene").EXAMPLE
        vary = {"n": 1000, "body.inertia[0]": f"normal({own['body.inertia'][0]}, 1%)"}
        return {"name": f"my-{self.name}", "kind": self.name, "vary": vary, "solve.times": (0.0, 10.0, 25.0), "solve.ask": "default", **EXAMPLE, **own}

    def needs(self, table: str) -> bool:
        """No scene can do without the table."""
        return needed(table, self.keys, self.alternatives)

    @cached_property
    def single_keys(self) -> dict[str, tuple[str, Field]]:
        """Table and field by full key, and by name where one table has it, of what stands alone: no alternative to anything."""
        return self._fields(lambda table, field: f"{table}.{field.name}" not in self._tied and field.name != "attitude")

    @cached_property
    def chosen_keys(self) -> dict[str, tuple[str, Field]]:
        """The same of what is an alternative to something, and may change where it was the one that was given; the forms of an attitude may not."""
        forms = {"attitude", *(field.name for field in FORMS)}
        return self._fields(lambda table, field: f"{table}.{field.name}" in self._tied and table != "solve" and field.name not in forms)

    @cached_property
    def time_keys(self) -> dict[str, tuple[str, Field]]:
        """The same of the times, in either way of telling them."""
        return self._fields(lambda table, field: any(f"{table}.{field.name}" in choice for choice in TIMES))

    @cached_property
    def _tied(self) -> set[str]:
        return {key for choices in self.alternatives for choice in choices for key in choice}

    def _fields(self, wanted: Callable[[str, Field], bool]) -> dict[str, tuple[str, Field]]:
        fields = [(table, field) for table, own in self.keys.items() if table for field in own]
        names = [field.name for _, own in self.keys.items() for field in own]
        found = [(table, field) for table, field in fields if wanted(table, field)]
        return {**{f"{table}.{field.name}": (table, field) for table, field in found},
                **{field.name: (table, field) for table, field in found if names.count(field.name) == 1}}

    @cached_property
    def mistakes(self) -> Callable[[Values], Found]:
        """What is wrong with a scene of which every key is right."""
        found: Callable[[Values], Found] = getattr(self._module("scene"), "mistakes", _nothing)
        return found

    @cached_property
    def doubts(self) -> Callable[[Values], Found]:
        """What says that a scene which names no kind was meant to be of another."""
        found: Callable[[Values], Found] = getattr(self._module("scene"), "doubts", _nothing)
        return found

    @cached_property
    def places(self) -> dict[str, tuple[str, str]]:
        """Table and key of each argument of `solve`."""
        found = {field.name: (table, field.name) for table, fields in reversed(self.keys.items()) if table for field in fields}
        return found | getattr(self._module("scene"), "ARGUMENTS", {})

    def arguments(self, scene: "Scene") -> dict[str, Any]:
        """What `solve` takes, from a checked scene."""
        return {**self._module("scene").arguments(scene), "ask": scene.tables["solve"]["ask"]}

    def solve(self, **arguments: Any) -> Answer:
        """The answer of the ladder."""
        answer: Answer = self._module("functions").solve(**arguments)
        return answer

    def part(self, name: str) -> Any:
        """The module chart, rows, figures, gallery or stability, which is imported when it is first wanted; None where there is none."""
        return self._module(name) if find_spec(f"{__name__}.{self.name}.{name}") else None

    def _module(self, name: str) -> Any:
        return _module(self.name, name)


FAMILIES: Final[dict[str, Family]] = {name: Family(name) for name in FACTS}


def answer_of(kind: str, made: Mapping[str, Any], arguments: Mapping[str, Any]) -> Answer:
    """What the compiled ladder `made` of the arguments of a family's `solve`, which stand in the answer as a scene."""
    times = np.array(arguments["times"], dtype=float)
    kept = {name: _kept(value) for name, value in arguments.items() if name != "times"} | {"times": times.copy()}
    return Answer.of(partial(_told, kind, kept), times, arguments["tolerance"], made)


def _kept(value: Any) -> Any:
    """A value that does not change where the caller's does."""
    if isinstance(value, np.ndarray):
        return value.copy()
    return deepcopy(value) if isinstance(value, list | Mapping) else value


def _listed(value: Any) -> Any:
    """As a scene file would have it: lists and numbers."""
    if isinstance(value, np.ndarray | np.generic):
        return value.tolist()
    if isinstance(value, Mapping):
        return {key: _listed(item) for key, item in value.items()}
    return [_listed(item) for item in value] if isinstance(value, list | tuple | set | frozenset) else value


def _told(kind: str, arguments: Mapping[str, Any]) -> dict[str, Any]:
    """The arguments of a family's `solve` in the layout of a scene file."""
    places = FAMILIES[kind].places
    scene: dict[str, Any] = {"name": f"gyrostat.{kind}.solve", "kind": kind}
    for name, value in arguments.items():
        if value is not None:
            table, key = places[name]
            home = scene.setdefault(table, {}) if table else scene
            home[key] = _listed(value)
    return scene
