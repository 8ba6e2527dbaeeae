#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""The documentation as a site: `build.py FOLDER` writes it there.

The Markdown pages of the tree, index.md of this folder before them, and a page for each module of the Python package. Every warning is an
error. Needs the package gyrostat and its extra `docs`.
"""
import importlib
import pathlib
import shutil
import sys

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


def stage(folder: pathlib.Path) -> None:
    """Put together what the site is made from; the folder is made anew."""
    shutil.rmtree(folder, ignore_errors=True)
    shutil.copytree(ROOT / "docs", folder / "docs", ignore=shutil.ignore_patterns("site", "*.py"))
    shutil.copytree(ROOT / "examples", folder / "examples")
    shutil.copytree(HERE / "static", folder / "static")
    shutil.copy(HERE / "index.md", folder)
    for name in FILES:
        shutil.copy(ROOT / name, folder)
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
