# SPDX-License-Identifier: BSD-3-Clause
"""Scenes as TOML text, which the standard library only reads."""

import json
import re
from collections.abc import Mapping
from typing import Any

__all__ = ["toml_text", "toml_value"]


def toml_text(data: Mapping[str, Any]) -> str:
    """Plain data in the layout of a scene file (tables of values) as TOML; every number reads back as it was."""
    def several(value: Any) -> bool:
        return isinstance(value, list | tuple) and len(value) > 0 and all(isinstance(item, Mapping) for item in value)

    top = [_line(key, value) for key, value in data.items() if not isinstance(value, Mapping) and not several(value)]
    listed = [[f"[[{name}]]", *(_line(key, value) for key, value in item.items())]
              for name, items in data.items() if several(items) for item in items]
    tables = [[f"[{name}]", *(_line(key, value) for key, value in table.items())]
              for name, table in data.items() if isinstance(table, Mapping)]
    return "\n\n".join("\n".join(lines) for lines in (top, *tables, *listed) if lines) + "\n"


def _line(key: str, value: Any) -> str:
    return f"{key if re.fullmatch(r'[A-Za-z0-9_-]+', key) else json.dumps(key)} = {toml_value(value)}"


def toml_value(value: Any) -> str:
    """A value as it stands behind its key; a table inline."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False).replace("\x7f", "\\u007f")
    if isinstance(value, Mapping):
        return "{ " + ", ".join(_line(key, item) for key, item in value.items()) + " }"
    if isinstance(value, list | tuple):
        return "[" + ", ".join(toml_value(item) for item in value) + "]"
    return repr(value)
