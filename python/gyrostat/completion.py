# SPDX-License-Identifier: BSD-3-Clause
"""gyrostat --print-completion: what a shell needs to complete commands, options, files, kinds and the names of bundled scenes."""

import argparse
import sys
from collections.abc import Iterator, Sequence
from typing import Any, Final

from gyrostat.console import say
from gyrostat.scenes import bundled

__all__ = ["SHELLS", "PrintCompletion"]

SHELLS: Final = ("bash", "zsh", "tcsh")

# Functions of the shells; NAMES stands for the names of the bundled scenes. tcsh knows words or files, not both.
FUNCTIONS: Final = {
    "bash": """\
_gyrostat_names() { compgen -W "NAMES" -- "$1"; }
_gyrostat_scenes() { _gyrostat_names "$1"; compgen -f -X '!*.toml' -- "$1"; compgen -d -- "$1"; }
""",
    "zsh": """\
_gyrostat_names() { compadd -- NAMES }
_gyrostat_scenes() { _gyrostat_names; _files -g '*.toml' }
""",
    "tcsh": ""}


def _arguments(parser: argparse.ArgumentParser) -> Iterator[argparse.Action]:
    """Those of the parser and of its commands."""
    for action in parser._actions:
        yield action
        if isinstance(action, argparse._SubParsersAction):
            for command in action.choices.values():
                yield from _arguments(command)


class PrintCompletion(argparse.Action):
    """Prints the completion for the shell that is named."""

    def __call__(self, parser: argparse.ArgumentParser, _namespace: argparse.Namespace, shell: str | Sequence[Any] | None, _option: str | None = None) -> None:
        try:
            import shtab
        except ImportError:
            parser.exit(2, "gyrostat: shtab is not installed: pip install 'gyrostat[cli]'\n")
        assert isinstance(shell, str)
        names = " ".join(name for name, _ in bundled())
        by_meaning = {"FILE": shtab.FILE, "DIR": shtab.DIRECTORY}
        by_name = {place: {"bash": function, "zsh": function, "tcsh": f"({names})"}
                   for place, function in (("scene", "_gyrostat_scenes"), ("name", "_gyrostat_names"))}
        for action in _arguments(parser):
            completed = by_name.get(action.dest) or by_meaning.get(str(action.metavar))
            if completed is not None:
                action.complete = completed  # type: ignore[attr-defined]  # where shtab looks for it
        functions: Any = {shell: FUNCTIONS[shell].replace("NAMES", names)}  # one shell's of many; shtab's types know the text of one
        say(shtab.complete(parser, shell, preamble=functions), sys.stdout)
        sys.exit(0)
