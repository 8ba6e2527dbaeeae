# SPDX-License-Identifier: BSD-3-Clause
"""How Sphinx makes the site: the pages as they are in the tree, and the docstrings of the Python package."""

import re
from typing import Any

import gyrostat
import numpy as np
from numpy.typing import ArrayLike, NDArray
from sphinx.util.typing import stringify_annotation

project = "gyrostat"
author = "The gyrostat authors"
version = release = gyrostat.__version__

extensions = ["myst_parser", "sphinx.ext.autodoc", "sphinx.ext.viewcode"]
root_doc = "index"
highlight_language = "none"
myst_heading_anchors = 4
suppress_warnings = ["myst.header"]  # a page may begin below its first level

autodoc_member_order = "bysource"
autodoc_preserve_defaults = True
maximum_signature_line_length = 100
python_use_unqualified_type_names = True

html_theme = "furo"
html_title = f"gyrostat {version}"
html_static_path = ["static"]
html_css_files = ["site.css"]
html_copy_source = html_show_sourcelink = html_show_copyright = False

ANCHOR = re.compile(r'^<a id="([^"]+)"></a>', re.M)
NUMPY = {stringify_annotation(ArrayLike, "smart"): "ArrayLike",
         **{stringify_annotation(NDArray[each], "smart"): f"NDArray[{name}]" for name, each in
            (("float64", np.float64), ("int64", np.int64), ("complex128", np.complex128), ("bool", np.bool_), ("str", np.str_), ("Any", Any))}}
ITEM = re.compile(r"([\w*][\w*, ]*?) : (.*)")


def anchors(_app: Any, _page: str, text: list[str]) -> None:
    """The anchors of plain Markdown at the head of a paragraph, as those of MyST, whose links are checked."""
    text[0] = ANCHOR.sub(r"(\1)=\n", text[0])


def escaped(line: str) -> str:
    """Plain text as reStructuredText: code between backticks, all else as it stands."""
    parts = re.split(r"`([^`]+)`", line)
    parts[::2] = [re.sub(r"([\\*|`]|_\b|_$)", r"\\\1", part) for part in parts[::2]]
    parts[1::2] = [f"``{part}``" for part in parts[1::2]]
    return "".join(parts)


def docstring(_app: Any, _what: str, _name: str, _object: Any, _options: Any, lines: list[str]) -> None:
    """Plain paragraphs, in which `name : meaning` at the head of a line is an argument, and goes on until a new sentence begins a line."""
    made: list[str] = []
    within = False  # an argument
    for line in lines:
        item = ITEM.fullmatch(line)
        if item:
            made += ["", f"* ``{item[1]}``: {escaped(item[2])}"]
        elif within and re.match(r" |[^A-Z`]", line):
            made.append("  " + escaped(line.strip()))
            continue
        else:
            made += [""] * within + [escaped(line.strip())]
        within = item is not None
    lines[:] = made + [""]


def signature(_app: Any, _what: str, _name: str, _object: Any, _options: Any, given: str | None, returned: str | None) -> tuple[str | None, str | None]:
    """The types of numpy by their short names."""
    for long, short in NUMPY.items():
        given, returned = given and given.replace(long, short), returned and returned.replace(long, short)
    return given, returned


def setup(app: Any) -> None:
    app.connect("source-read", anchors)
    app.connect("autodoc-process-signature", signature)
    app.connect("autodoc-process-docstring", docstring)
