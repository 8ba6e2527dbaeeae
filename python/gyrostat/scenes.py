# SPDX-License-Identifier: BSD-3-Clause
"""Scene files: read, checked in full, and handed on as a `Scene`. Whatever is wrong comes back as one `SceneError`."""

import json
import os
import re
import tomllib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from dataclasses import field as member
from functools import cached_property
from pathlib import Path
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from gyrostat.advice import advice, kinds_with, meaning_of, nearest, show, type_of, wanted, ways, ways_of_kind
from gyrostat.asking import AskError, asked, knows_attitude
from gyrostat.errors import DomainError, Mistake, Refused, SceneError
from gyrostat.families import FAMILIES, Family
from gyrostat.fields import GENERAL, REQUIRED, TIMES, UNSET, Choices, Field, Values, table_of
from gyrostat.orientation import form_of, settle
from gyrostat.overriding import SET_OUTSIDE, override
from gyrostat.reading import as_given, plain, read_value, worded
from gyrostat.rows import SETTINGS, plan_of
from gyrostat.toml_text import toml_text

__all__ = ["Scene", "bundled", "find", "load", "scene_from"]

MOST_BYTES: Final = 64 * 2**20
# Scenes that go on from each other.
MOST_BEFORE: Final = 16


@dataclass(frozen=True, eq=False)
class Scene:
    """A checked scene: what `tables` holds is complete (defaults filled in), finite and physical, in SI units; the attitude at the start, in
    whatever form it was given, is the quaternion `attitude`, too.

    `written` holds by full key what was given with units. `path` is the file it came from, or None. Change a value with `replace`, which checks again.
    Scenes are equal that say the same, whatever files they came from.
    """

    name: str
    kind: str
    source: str
    tables: Values
    path: Path | None = None
    top: Mapping[str, Any] = member(default_factory=dict)  # keys of the kind's own at the top, such as the wheels
    written: Mapping[str, Any] = member(default_factory=dict)
    before: "Scene | None" = member(default=None, repr=False)  # the scene at whose end this one begins

    @property
    def times(self) -> NDArray[np.float64]:
        """Times of the answer (n,) [s]."""
        return self._times.copy()

    @cached_property
    def _times(self) -> NDArray[np.float64]:
        solve = self.tables["solve"]
        if solve["times"] is not UNSET:
            return np.array(solve["times"], dtype=np.float64)
        begin = self.start_time
        return np.linspace(begin, begin + solve["duration"], solve["samples"])

    @property
    def start_time(self) -> float:
        """Where the clock of this scene begins [s]: by default 0, or at the last time of the scene before it."""
        if self.before is not None:
            return float(self.before.times[-1])
        return float(self.tables.get("initial", {}).get("time") or 0.0)

    @property
    def starts_plainly(self) -> bool:
        """The start is told by the scene itself, without error, at t = 0."""
        start = self.tables.get("initial", {})
        return self.before is None and not start.get("time") and start.get("error") is UNSET

    @property
    def tolerance(self) -> float:
        """Greatest relative error wanted in any output column."""
        return float(self.tables["solve"]["tolerance"])

    @property
    def vary(self) -> Mapping[str, Any]:
        """The table [vary]: what varies from row to row of a sweep."""
        return self.top.get("vary") or {}

    @property
    def model(self) -> str:
        """Rung asked for, or "auto"."""
        return str(self.tables["solve"]["model"])

    def to_dict(self) -> dict[str, Any]:
        """Plain data in the layout of a scene file, with units where they were given; keys without a value are left out."""
        made: dict[str, Any] = {"name": self.name, "kind": self.kind}
        if self.source:
            made["source"] = self.source
        made |= {key: plain(self.written.get(key, value)) for key, value in self.top.items() if value}
        for table, values in self.tables.items():
            instead = table == "initial" and form_of(values)  # of the attitude
            if given := {key: plain(self.written.get(f"{table}.{key}", value)) for key, value in values.items()
                         if value is not UNSET and not (instead and key == "attitude")}:
                made[table] = given
        return made

    @cached_property
    def _words(self) -> str:
        """All that it says, and what the scenes before it say."""
        return json.dumps([self.to_dict(), self.before and self.before._words], default=str)

    def __eq__(self, other: object) -> bool:
        return self._words == other._words if isinstance(other, Scene) else NotImplemented

    def __hash__(self) -> int:
        return hash(self._words)

    def told(self) -> dict[str, Any]:
        """As to_dict(), for wherever it is read: the file that the motion goes on `from` by its full path, unless it is bundled."""
        made = self.to_dict()
        if self.before is None:
            return made
        given = made["from"]
        if not isinstance(given, str) and "scene" in given:
            made["from"] = {**given, "scene": self.before.told()}
        elif self.before.path is not None:
            name = given if isinstance(given, str) else given["file"]
            if name not in dict(bundled()):
                full = str(self.before.path.resolve())
                made["from"] = full if isinstance(given, str) else {**given, "file": full}
        return made

    def replace(self, **overrides: Any) -> "Scene":
        """The same scene with some keys changed: by name (`tolerance=1e-9`) or dotted (`**{"torque.drag": 0.0}`)."""
        if not overrides:
            return self
        return self._changed(overrides) or self.with_data(self.to_dict(), overrides)

    def with_data(self, data: Mapping[str, Any], overrides: Mapping[str, Any] | None = None) -> "Scene":
        """The scene that plain data make in the place of this one, beside the same file."""
        return _check(data, _Source(self._label(), path=self.path), overrides or {})

    def _changed(self, overrides: Mapping[str, Any]) -> "Scene | None":
        """The scene with keys changed that stand alone, or were chosen among alternatives before, or are times, where all is well; None: the whole is to be
        checked."""
        family = FAMILIES[self.kind]
        tables, written, of_motion, new_times = dict(self.tables), dict(self.written), False, set()
        for key, value in overrides.items():
            found = family.single_keys.get(key) or family.chosen_keys.get(key) or family.time_keys.get(key)
            if found is None:
                return None
            table, field = found
            if key in family.time_keys and value is not None:
                new_times.add(f"{table}.{field.name}")
            elif key not in family.single_keys and (value is None or self.tables[table][field.name] is UNSET):
                return None
            try:
                read = read_value(field, value := plain(value))
            except Refused:
                return None
            tables[table] = {**tables[table], field.name: read}
            of_motion |= table != "solve" or field.name in ("ask", "euler")
            written.pop(f"{table}.{field.name}", None)
            if worded(field, value):
                written[f"{table}.{field.name}"] = as_given(field, value, read)
        if new_times and not _one_way(tables, written, new_times):
            return None
        if of_motion:
            try:
                asked(self.kind, tables["solve"]["ask"], knows_attitude(self.kind, tables))
            except AskError:
                return None
            if any(family.mistakes({"": self.top, **tables})):
                return None
        made = Scene(self.name, self.kind, self.source, tables, self.path, self.top, written, self.before)
        if not new_times and made.start_time == self.start_time:
            made.__dict__["_times"] = self._times
        elif made._times[0] < made.start_time:
            return None
        return made

    def _label(self) -> str:
        return self.name if self.path is None else str(self.path)

    def __str__(self) -> str:
        """The text of a scene file."""
        return toml_text(self.to_dict())

    def _repr_html_(self) -> str:
        from gyrostat.notebook import scene_html

        return scene_html(self)


def _one_way(tables: dict[str, Any], written: dict[str, Any], new: set[str]) -> bool:
    """Leave of the alternative ways of telling times the one to which the new keys belong; False: they are none, or not whole."""
    chosen = [choice for choice in TIMES if new <= set(choice)]
    if not chosen:
        return False
    for key in (key for choice in TIMES if choice not in chosen for key in choice):
        table, _, name = key.rpartition(".")
        tables[table] = {**tables[table], name: UNSET}
        written.pop(key, None)
    return all(tables[table_of(key)][key.rpartition(".")[2]] is not UNSET for key in chosen[0])


@dataclass
class _Source:
    """Where the data came from, for messages."""

    label: str
    text: str = ""
    path: Path | None = None
    after: tuple[Path | None, ...] = ()  # the files of scenes that go on from this one; None: such a scene was no file
    overridden: frozenset[str] = frozenset()

    def where(self, key: str) -> str:
        """Of a table of an array of tables, `wheel[1].rate`, where that table is."""
        listed = re.match(r"([^.\[]+)\[(\d+)\]", key)
        if (listed[1] if listed else key) in self.overridden:
            return f"{self.label} {SET_OUTSIDE}"
        line = self._line(listed[1], int(listed[2]) + 1) if listed else self._line(key)
        return f"{self.label}:{line}" if line else self.label

    def _line(self, key: str, element: int = 1) -> int:
        table, _, name = key.rpartition(".")
        inside, seen = "", 0
        for number, line in enumerate(self.text.splitlines(), 1):
            if header := re.match(r"\s*\[+\s*([\w.-]+)\s*\]+", line):
                inside = header[1]
                seen += inside == key
                if seen == element:
                    return number
            elif (found := re.match(r"\s*([\w-]+)\s*=", line)) and found[1] == name and inside == table:
                return number
        return 0


def _check(data: Mapping[str, Any], source: _Source, overrides: Mapping[str, Any] | None = None) -> Scene:
    """The scene that `data` describes, or SceneError with every mistake found."""
    tree: dict[str, Any] = {str(key): plain(_written_out(value) if key == "from" else value) for key, value in data.items()}
    if overrides:
        source.overridden = override(tree, source.label, {key: _written_out(value) if key == "from" else value for key, value in overrides.items()})
    made = _Reading(tree, source).scene()
    if not overrides:  # what varies may hang on keys that were replaced; a sweep looks again
        _check_varied(made, source)
    return made


def _written_out(given: Any) -> Any:
    """What `from` says, a scene or an answer there as plain data."""
    if isinstance(given, Mapping):
        return {**given, "scene": _as_data(given["scene"])} if "scene" in given else given
    data = _as_data(given)
    return given if data is given else {"scene": data}


def _as_data(given: Any) -> Any:
    if isinstance(given, Scene):
        return given.told()
    if getattr(given, "own_torque", False):
        raise DomainError("from: a torque of your own acted in that answer, which its scene does not hold: give what was at its end as [initial]")
    return getattr(given, "scene", given)  # of an Answer


class _Reading:
    """A scene while it is read: the data as they were given, the values of their keys, and every mistake found so far."""

    def __init__(self, tree: Mapping[str, Any], source: _Source) -> None:
        self.tree, self.source = tree, source
        self.mistakes: list[Mistake] = []
        self.written: dict[str, Any] = {}  # what was given with units, by full key
        self.unread: set[str] = set()  # tables that are missing, or none
        self.family = self._family()

    def _wrong(self, key: str, value: Any, problem: str, remedy: str, shown: bool = True) -> None:
        """In an array of tables the problem begins with the place: of wheel "wheel[1]: ..."."""
        if listed := re.match(rf"({re.escape(key)}\[\d+\]): ", problem):
            key, problem, shown = listed[1], problem[listed.end():], False
        self.mistakes.append(Mistake(self.source.where(key), key, show(value) if shown else "", problem, remedy))

    def _family(self) -> Family:
        kind = self.tree.get("kind", GENERAL)
        if not isinstance(kind, str) or kind not in FAMILIES:
            near = nearest(kind, FAMILIES) if isinstance(kind, str) else ""
            self._wrong("kind", kind, "unknown kind", (f'did you mean "{near}"? ' if near else "") + f"this version answers: {', '.join(FAMILIES)}")
            raise SceneError(*self.mistakes)
        return FAMILIES[kind]

    def scene(self) -> Scene:
        """Raises SceneError."""
        self._look_for_strangers()
        read = {table: values for table in self.family.keys if (values := self._table(table)) is not None}
        for choices in self.family.alternatives:
            if not any(table_of(key) in self.unread for choice in choices for key in choice):
                self._one_of(choices)
        if not self.mistakes:
            self._check_whole(read)
        if self.mistakes:
            if "kind" not in self.tree and _may_be_another(self.tree, self.mistakes):
                self.mistakes.insert(0, Mistake(self.source.label, "kind", "", f"the key is missing, and what is there is no scene of the kind {GENERAL}",
                                                ways_of_kind(self.tree)))
            raise SceneError(*self.mistakes)
        head = read.pop("")
        top = {key: value for key, value in head.items() if key not in ("name", "kind", "source")}
        before = _before(top["from"], self.source) if top.get("from") else None
        made = Scene(head["name"], self.family.name, head["source"], read, self.source.path, top, self.written, before)
        if (times := read["solve"]["times"]) is not UNSET and times[0] < made.start_time:
            raise SceneError(Mistake(self.source.where("solve.times"), "solve.times", show(list(times)), f"the motion begins at {made.start_time!r} s",
                                     "give times from there, or duration and samples, which count from there"))
        return made

    def _look_for_strangers(self) -> None:
        """Keys and tables at the top that the kind does not have."""
        layout = self.family.keys
        for key, value in self.tree.items():
            if key not in layout and all(field.name != key for field in layout[""]):
                table = isinstance(value, dict)
                self._wrong(key, value, "unknown " + ("table" if table else "key"), advice(key, "", self.family), not table)

    def _table(self, table: str) -> dict[str, Any] | None:
        """The values of its keys; None where there is no such table."""
        given: Any = self.tree.get(table, {}) if table else self.tree
        if table and table not in self.tree and self.family.needs(table) and not _goes_on(table, self.tree):
            self._wrong(table, "", f"the table [{table}] is missing", f"add [{table}] with {wanted(self.family, table)}", False)
            self.unread.add(table)
            return None
        if not isinstance(given, dict):
            self._wrong(table, given, f"this is {type_of(given)}, not a table", f"write [{table}] on a line of its own, then its keys")
            self.unread.add(table)
            return None
        fields = self.family.keys[table]
        prefix = table + "." if table else ""
        for key in given if table else ():
            if all(field.name != key for field in fields):
                self._wrong(prefix + str(key), given[key], "unknown key", advice(str(key), table, self.family))
        return {field.name: self._value(field, given, prefix + field.name) for field in fields}

    def _value(self, field: Field, given: Mapping[str, Any], key: str) -> Any:
        """The value of a key, or its default."""
        if field.name not in given:
            if field.default is REQUIRED:
                self._wrong(key, "", "the key is missing", f"give the {meaning_of(field)}", False)
            return field.default
        value = given[field.name]
        try:
            read = read_value(field, value)
        except Refused as error:
            self._wrong(key, value, *error.args)
            return UNSET
        if worded(field, value):
            self.written[key] = as_given(field, value, read)
        return read

    def _one_of(self, choices: Choices) -> None:
        """One of the alternatives stands there, and whole."""
        given = {f"{table}.{name}": value for table, values in self.tree.items() if isinstance(values, dict) for name, value in values.items()}
        started = [choice for choice in choices if any(key in given for key in choice)]
        if not started:
            if () not in choices and not _goes_on(table_of(choices[0][0]), self.tree):
                self._wrong(choices[0][0], "", "the key is missing", ways(choices), False)
        elif len(started) > 1:
            first, extra = (next(key for key in choice if key in given) for choice in started[:2])
            self._wrong(extra, given[extra], f"given beside {first}", ways(choices))
        else:
            for key in started[0]:
                if key not in given:
                    self._wrong(key, "", "the key is missing", ways(choices), False)

    def _check_whole(self, read: dict[str, dict[str, Any]]) -> None:
        """What keys mean together, where each is right by itself."""
        settle(read["initial"])
        kind = self.family.name
        try:
            asked(kind, read["solve"]["ask"], knows_attitude(kind, read))
        except AskError as error:
            self._wrong("solve.ask", read["solve"]["ask"], error.problem, error.remedy)
        for key, value, problem, remedy in (*self.family.mistakes(read), *(() if "kind" in self.tree else self.family.doubts(read))):
            self._wrong(key, plain(value), problem, remedy, value != "")


def _may_be_another(tree: Mapping[str, Any], mistakes: Sequence[Mistake]) -> bool:
    """Whether a scene of no kind may be one of another kind than general: something is unknown that others have, and nothing stands that they lack."""
    if any(isinstance(tree.get(name), list) for name in ("wheel", "torque")) or "orbit" in tree:
        return False
    keys = [mistake.key for mistake in mistakes if mistake.problem.startswith(("unknown", "the table", "this is a table, not"))]
    return any(any(key in family.keys for family in FAMILIES.values()) or kinds_with(key.rpartition(".")[2], table_of(key)) for key in keys)


def _before(given: Any, source: _Source) -> Scene:
    """The scene at whose end another begins, by its key `from`; `source` is that of the other."""

    def fail(problem: str, remedy: str) -> SceneError:
        return SceneError(Mistake(source.where("from"), "from", "", problem, remedy))

    passed = (*source.after, source.path and source.path.resolve())
    if len(passed) > MOST_BEFORE:
        raise fail(f"over {MOST_BEFORE} scenes go on from each other", "begin one of them with [initial]")
    file, written = (given, UNSET) if isinstance(given, str) else (given["file"], given["scene"])
    if (file is UNSET) == (written is UNSET):
        raise fail("the key file is missing" if file is UNSET else "file and scene are both given", "name the scene that goes before, or write it out as scene")
    if written is not UNSET:
        return _check(written, _Source(f"{source.label}: from.scene", path=source.path, after=passed))
    name = Path(file)
    here = source.path.parent / name if source.path else name
    found = find(here if here.exists() else name)
    if found.resolve() in passed:
        raise fail(f"{name} goes on from this scene in turn", "begin one of the two with [initial]")
    return _load(found, {}, passed)


def _check_varied(scene: Scene, source: _Source) -> None:
    """What the table [vary] says has a meaning; a table of cases is looked at when it is wanted."""
    try:
        if not set(scene.vary) <= set(SETTINGS):
            plan_of(scene, cases={} if "cases" in scene.vary else None)
    except DomainError as error:
        problem, _, remedy = str(error).partition("; ")
        raise SceneError(Mistake(source.where("vary"), "vary", "", problem, remedy or "write what docs/sweeps.md says")) from None


def _goes_on(table: str, tree: Mapping[str, Any]) -> bool:
    """The table may be left out, for the scene begins where another ends."""
    return table == "initial" and "from" in tree


def scene_from(data: Mapping[str, Any], label: str = "scene", **overrides: Any) -> Scene:
    """The scene that a dict in the layout of a scene file describes. Raises SceneError."""
    return _check(data, _Source(label), overrides)


def load(path: str | os.PathLike[str], **overrides: Any) -> Scene:
    """Read a scene file (TOML), or a bundled scene by name; overrides as in `Scene.replace`. Raises SceneError, and DomainError for what names no file."""
    if not isinstance(path, str | os.PathLike):
        raise DomainError(f"path = {str(path)[:60]}: name a scene file or a bundled scene; gyrostat.solve and its kin take a dict in the layout of a scene file, too")
    return _load(path, overrides)


def _load(path: str | os.PathLike[str], overrides: Mapping[str, Any], after: tuple[Path | None, ...] = ()) -> Scene:
    file = find(path)
    label = _printable(str(path))

    def fail(problem: str, remedy: str) -> SceneError:
        return SceneError(Mistake(label, "", "", problem, remedy))

    try:
        if file.is_dir():
            raise fail("this is a directory", "name a scene file")
        if file.stat().st_size > MOST_BYTES:
            raise fail(f"the file is over {MOST_BYTES // 2**20} MiB", "a scene file is a few lines of TOML")
        with file.open("rb") as stream:
            raw = stream.read(MOST_BYTES + 1)
    except SceneError:
        raise
    except FileNotFoundError:
        known = [name for name, _ in bundled()]
        near = nearest(str(path), known)
        raise fail("there is no such file", f"did you mean the bundled scene {near}?" if near else
                   "name a scene file, or a bundled scene (gyrostat scenes lists them)") from None
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or str(error)
        raise fail(f"the file cannot be read ({reason})", "name a readable scene file") from None
    if len(raw) > MOST_BYTES:
        raise fail(f"the file is over {MOST_BYTES // 2**20} MiB", "a scene file is a few lines of TOML")
    try:
        text = raw.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise fail(f"byte {error.start + 1} is not UTF-8", "save the file as UTF-8 text") from None
    try:
        data = tomllib.loads(text)
    except tomllib.TOMLDecodeError as error:
        place = re.search(r"\(at line (\d+), column (\d+)\)", str(error))
        where = f"{label}:{place[1]}" if place else label
        problem = str(error)
        if place:
            line = text.split("\n")[int(place[1]) - 1].strip()[:60]
            problem = problem.replace(place[0], f"in column {place[2]} of the line '{line}'")
        raise SceneError(Mistake(where, "", "", f"this is not TOML: {_printable(problem)}", "correct the line")) from None
    except RecursionError:
        raise fail("arrays or tables are nested too deep", "a scene file is a few lines of TOML") from None
    except ValueError as error:
        raise fail(f"a value cannot be read ({_printable(str(error))[:80]})", "write ordinary numbers") from None
    beside = None if file.is_relative_to("/dev") else file  # what comes through a pipe stands in no folder
    return _check(data, _Source(label, text, beside, after), overrides)


def _printable(text: str) -> str:
    return "".join(c if c.isprintable() else "?" for c in text)


def _folder() -> Path | None:
    """Where the bundled scenes are: beside the package, or in the source tree."""
    here = Path(__file__).resolve().parent
    return next((folder for folder in (here / "scenes", here.parents[1] / "scenes") if folder.is_dir()), None)


def bundled() -> list[tuple[str, Path]]:
    """Name and file of each scene that comes with gyrostat."""
    folder = _folder()
    return [(file.stem, file) for file in sorted(folder.glob("*.toml"))] if folder else []


def find(path: str | os.PathLike[str]) -> Path:
    """The file that a path or the name of a bundled scene stands for; the path itself where there is no such scene."""
    file = Path(path)
    try:
        if file.is_file():
            return file
    except (OSError, ValueError):
        return file
    return dict(bundled()).get(str(path), file)
