#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""The tables of docs/ that repeat what the code says.

    docs_tables.py              compare them with the code; one line a table that differs; exit status 1 if there is any
    docs_tables.py --write      write them anew

A table stands between <!-- KIND:FAMILY --> (or <!-- KIND -->) and <!-- end -->. Columns, scalars, rungs and warnings come from the compiled families,
keys of scene files, units and planets from the tables behind the validator, constants from include/gyrostat/ladder/honesty.hpp. What to do about a warning is
written by hand in the last cell of its row, what a scene is behind its command; neither may be empty, and both are kept. The rung of a scene is the
one that answers it. Needs the package gyrostat.
"""
import argparse
import functools
import pathlib
import re
import sys
from collections.abc import Callable, Iterable, Iterator

import gyrostat
from gyrostat import _core
from gyrostat.families import FAMILIES
from gyrostat.families.general.functions import PLANETS
from gyrostat.orientation import FORMS
from gyrostat.scenes import bundled
from gyrostat.schema import key_tables, ways
from gyrostat.units import QUANTITIES

ROOT = pathlib.Path(__file__).resolve().parents[1]
HONESTY = ROOT / "include" / "gyrostat" / "ladder" / "honesty.hpp"
BLOCK = re.compile(r"^<!-- (\w+)(?::(\w+))? -->\n(.*?)^<!-- end -->\n", re.M | re.S)
COMPILED = {family["name"]: family for family in _core.families()}
MEASURES = {"relative": "relative", "angle": "angle, rad", "absolute": "absolute", "": "-"}


def table(heads: Iterable[str], rows: Iterable[Iterable[str]]) -> str:
    def line(cells: Iterable[str]) -> str:
        return "| " + " | ".join(re.sub(r"\s+", " ", cell).replace("|", "\\|") for cell in cells) + " |\n"

    heads = list(heads)
    return line(heads) + "|" + "---|" * len(heads) + "\n" + "".join(map(line, rows))


def cells(row: str) -> list[str]:
    """The cells of a row of a table."""
    return [cell.strip().replace("\\|", "|") for cell in re.split(r"(?<!\\)\|", row.strip())[1:-1]]


def values(kind: str, what: str, *cells: str) -> Iterator[list[str]]:
    for each in COMPILED[kind][what]:
        yield [f"`{each['name']}`", str(each["width"] or "wheels"), *(each[cell] or "-" for cell in cells), MEASURES[each["measure"]], each["meaning"]]


def columns(kind: str, _: str) -> str:
    scales = [each["scale"] or "-" for each in COMPILED[kind]["columns"]]
    rows = [[*row[:-1], scale, row[-1]] for row, scale in zip(values(kind, "columns", "unit", "frame"), scales, strict=True)]
    return table(["column", "width", "unit", "frame", "error", "least scale", "meaning"], rows)


def scalars(kind: str, _: str) -> str:
    return table(["scalar", "width", "unit", "error", "meaning"], values(kind, "scalars", "unit"))


def rungs(kind: str, _: str) -> str:
    listed = table(["rung", "what it is", "columns that it never gives"], [
        [f"`{each['name']}`", each["meaning"], ", ".join(f"`{name}`" for name in each["lacks"]) or "-"] for each in COMPILED[kind]["rungs"]])
    return f"{listed}\nIntegrators of the full equations: {', '.join(f'`{name}`' for name in COMPILED[kind]['integrators'])}.\n"


def warnings(kind: str, was: str) -> str:
    kept = {row[0]: row[2] for row in map(cells, was.splitlines()[2:]) if len(row) == 3}
    rows = [[code := f"`{each['code']}`", each["text"], kept.get(code, "")] for each in COMPILED[kind]["warnings"]]
    return table(["code", "text", "what to do"], rows)


def keys(kind: str, _: str) -> str:
    """Of the forms of an attitude, which all kinds have alike, the first alone."""
    forms = {each.name for field in FORMS for each in (field, *field.parts)}

    def parts() -> Iterator[str]:
        for title, heads, rows in key_tables(kind):
            yield f"`{title}`\n\n" if title.startswith("[") else f"{title[0].upper()}{title[1:]}\n\n"
            yield table(heads, [[f"`{row[0].strip()}`", *row[1:]] for row in rows if title != "[initial]" or row[0].strip() not in forms]) + "\n"
        for choices in FAMILIES[kind].alternatives:
            listed = tuple(choice for choice in choices if not {key.removeprefix("initial.") for key in choice} & forms)
            yield f"* {ways(listed)}\n".replace("initial.attitude", "initial.attitude in one of its [forms](#attitudes)")

    return "".join(parts())


@functools.cache
def scenes() -> dict[str, gyrostat.Scene]:
    return {name: gyrostat.load(name) for name, _ in bundled()}


def gallery(kind: str, was: str) -> str:
    told = {name: text for name, text in re.findall(r"\| `gyrostat solve ([\w-]+)`<br>(.*?) \|", was)}
    rows = [[f"![{name}](gallery/{name}.png)", f"`gyrostat solve {name}`<br>{told.get(name, '')}", f"`{gyrostat.solve(scene).model}`"]
            for name, scene in scenes().items() if scene.kind == kind]
    return table(["motion", "scene", "rung"], rows)


def sentence(comment: str) -> str:
    """Comment lines as running text."""
    return re.sub(r"\s*///<?\s*", " ", comment).strip().rstrip(":;,.")


def constants(_: str, __: str) -> str:
    text = HONESTY.read_text(encoding="utf-8")
    fields = re.findall(r"^ +double\s+(\w+); +///< (.*(?:\n +///< .*)*)", text, re.M)
    sets = [(comment, name, [value.strip() for value in values.split(",")])
            for comment, name, values in re.findall(r"((?:^///[^\n]*\n)+)^inline constexpr Companions (\w+)\{(.*?)\};", text, re.M | re.S)]
    numbers = zip(*(values for _, _, values in sets), strict=True)
    rows = [[f"`{field}`", *values, sentence(meaning)] for (field, meaning), values in zip(fields, numbers, strict=True)]
    made = table(["of companions", *(f"`{name}`" for _, name, _ in sets), "meaning"], rows) + "\n"
    made += "".join(f"* `{name}`: {sentence(comment)}.\n" for comment, name, _ in sets) + "\n"
    single = []
    for comment, values in re.findall(r"((?:^///[^\n]*\n)+)^inline constexpr double ([^;]*);", text, re.M):
        for i, each in enumerate([values] if "{" in values else values.split(",")):
            name, value = (part.strip() for part in each.split("="))
            single.append([f"`{name.partition('[')[0]}`", value.replace("1.0 / ", "1/"), sentence(comment) if i == 0 else "the same"])
    return made + table(["constant", "value", "meaning"], single)


def units(_: str, __: str) -> str:
    return table(["measures", "units"], [[what, ", ".join(f"`{name}`" for name in sizes)] for what, (_, sizes) in QUANTITIES.items()])


def planets(_: str, __: str) -> str:
    return table(["planet", "gravitational parameter, m^3/s^2", "equatorial radius, m"],
                 [[f"`{name}`", repr(mu), repr(radius)] for name, (mu, radius) in PLANETS.items()])


TABLES: dict[str, Callable[[str, str], str]] = {"columns": columns, "scalars": scalars, "rungs": rungs, "warnings": warnings, "keys": keys,
                                                "gallery": gallery, "constants": constants, "units": units, "planets": planets}


def pages() -> Iterator[tuple[pathlib.Path, str, str]]:
    """Each page of docs/ with a table: where it is, as it is, and as it ought to be."""
    for path in sorted((ROOT / "docs").glob("*.md")):
        text = path.read_text(encoding="utf-8")

        def right(block: re.Match[str]) -> str:
            what, kind, was = block.groups()
            if what not in TABLES:
                return block.group()
            return block.group()[:block.start(3) - block.start()] + TABLES[what](kind or "", was) + "<!-- end -->\n"

        if BLOCK.search(text):
            yield path, text, BLOCK.sub(right, text)


def breaches() -> Iterator[str]:
    listed = set()
    for path, text, right in pages():
        listed |= {match.groups()[:2] for match in BLOCK.finditer(text)}
        if text != right:
            yield f"docs/{path.name}: a table differs from the code: run tests/docs_tables.py --write and look at the difference"
        for block in BLOCK.finditer(right):
            if block.group(1) == "warnings":
                yield from (f"docs/{path.name}: what is one to do about {row[0]}?" for row in map(cells, block.group(3).splitlines()[2:]) if not row[2])
            if block.group(1) == "gallery":
                yield from (f"docs/{path.name}: what is this scene? {row[1]}" for row in map(cells, block.group(3).splitlines()[2:]) if row[1].endswith("<br>"))
    for what in set(TABLES) - {"constants", "units", "planets"}:
        yield from (f"docs/: no table <!-- {what}:{kind} -->" for kind in FAMILIES if (what, kind) not in listed)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--write", action="store_true")
    if parser.parse_args().write:
        for path, text, right in pages():
            if text != right:
                path.write_text(right, encoding="utf-8")
    found = list(breaches())
    print("\n".join(found) or "the tables of docs/ are those of the code")
    return bool(found)


if __name__ == "__main__":
    sys.exit(main())
