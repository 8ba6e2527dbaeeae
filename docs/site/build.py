#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""The documentation as a site: `build.py FOLDER` writes it there.

The Markdown pages of the tree, index.md of this folder before them, a page for each module of the Python package, and one for each folder of C++
headers that docs/headers.md names. Every warning is an
error. Needs the package gyrostat and its extra `docs`.
"""
import importlib
import pathlib
import re
import shutil
import sys

import cpp
import gyrostat
from sphinx.cmd.build import main as sphinx

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[1]
FILES = ["README.md", "NOTATION.md", "CHANGELOG.md", "CONTRIBUTING.md", "LICENSE", "CITATION.cff"]
MODULES = ["gyrostat", "gyrostat.answer", "gyrostat.scenes", "gyrostat.errors", "gyrostat.deceleration", "gyrostat.rotor", "gyrostat.spinning",
           "gyrostat.heavy", "gyrostat.free", "gyrostat.general", "gyrostat.elliptic", "gyrostat.rotation", "gyrostat.sweeps", "gyrostat.vary", "gyrostat.sweep_report",
           "gyrostat.design", "gyrostat.stability", "gyrostat.export", "gyrostat.plots", "gyrostat.view", "gyrostat.gallery",
           "gyrostat.facts", "gyrostat.units"]


def module_page(name: str) -> str:
    """A page with all that a module offers and the package itself does not."""
    module = importlib.import_module(name)
    shown = [each for each in gyrostat.__all__ if name != "gyrostat" and getattr(module, each, None) is getattr(gyrostat, each)]
    return f"{name}\n{'=' * len(name)}\n\n.. automodule:: {name}\n   :members:\n   :exclude-members: {', '.join(shown)}\n"


def stage_headers(folder: pathlib.Path) -> None:
    """A page for each folder with such headers, and links to them."""
    guide = folder / "docs" / "headers.md"
    text = guide.read_text(encoding="utf-8")
    pages: dict[str, dict[str, str]] = {}
    for name in sorted(set(cpp.listed(text, ROOT / "include" / "gyrostat"))):
        pages.setdefault(name.rpartition("/")[0], {})[name] = (ROOT / "include" / "gyrostat" / name).read_text(encoding="utf-8")
    (folder / "cpp").mkdir()
    for place, headers in pages.items():
        (folder / "cpp" / f"{place.replace('/', '-')}.md").write_text(cpp.page(place, headers), encoding="utf-8")
    for place, headers in pages.items():
        for name in headers:
            text = text.replace(f"`{name}`", f"[`{name}`](../cpp/{place.replace('/', '-')}.md#{re.sub('[/.]', '', name)})")
    guide.write_text(text, encoding="utf-8")


def stage(folder: pathlib.Path) -> None:
    """Put together what the site is made from; the folder is made anew."""
    shutil.rmtree(folder, ignore_errors=True)
    shutil.copytree(ROOT / "docs", folder / "docs", ignore=shutil.ignore_patterns("site", "*.py"))
    shutil.copytree(ROOT / "examples", folder / "examples")
    shutil.copytree(HERE / "static", folder / "static")
    shutil.copy(HERE / "index.md", folder)
    for name in FILES:
        shutil.copy(ROOT / name, folder)
    stage_headers(folder)
    (folder / "python").mkdir()
    for name in MODULES:
        (folder / "python" / f"{name}.rst").write_text(module_page(name), encoding="utf-8")


def main() -> int:
    if len(sys.argv) != 2:
        print(__doc__)
        return 2
    folder = pathlib.Path(sys.argv[1]).resolve()
    source = folder.with_name(folder.name + "-source")
    stage(source)
    shutil.rmtree(folder, ignore_errors=True)
    return int(sphinx(["-q", "-W", "--keep-going", "-b", "html", "-c", str(HERE), "-d", str(folder.with_name(folder.name + "-trees")),
                       str(source), str(folder)]))


if __name__ == "__main__":
    sys.exit(main())
