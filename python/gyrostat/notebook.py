# SPDX-License-Identifier: BSD-3-Clause
"""Answers, scenes and charts as HTML, for notebooks."""

from collections.abc import Iterable, Sequence
from html import escape
from typing import TYPE_CHECKING, Final

from gyrostat.console import short, small

if TYPE_CHECKING:
    from gyrostat.answer import Answer
    from gyrostat.charts import Chart
    from gyrostat.scenes import Scene

__all__ = ["answer_html", "chart_html", "scene_html"]

LONGEST: Final = 80  # characters of a value


def _title(text: str) -> str:
    return f"<p><b>{escape(text)}</b></p>"


def _paragraphs(lines: Iterable[str]) -> str:
    return "".join(f"<p>{escape(line)}</p>" for line in lines if line)


def _table(title: str, heads: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    def line(cells: Sequence[str], tag: str) -> str:
        return "<tr>" + "".join(f'<{tag} style="text-align: left">{escape(cell)}</{tag}>' for cell in cells) + "</tr>"

    caption = f'<caption style="text-align: left">{escape(title)}</caption>' if title else ""
    body = "".join(line(row, "td") for row in rows)
    return f"<table>{caption}<thead>{line(heads, 'th')}</thead><tbody>{body}</tbody></table>" if body else ""


def answer_html(answer: "Answer") -> str:
    """The report of the command."""
    from gyrostat.report import head, tables, tail

    title, *lines = head(answer)
    return _title(title) + _paragraphs(lines) + "".join(_table(*table) for table in tables(answer)) + _paragraphs([tail(answer)])


def scene_html(scene: "Scene") -> str:
    """Every key that has a value, with unit and meaning."""
    from gyrostat.families import FAMILIES
    from gyrostat.toml_text import toml_value

    fields = {f"{table}.{field.name}".lstrip("."): field for table, keys in FAMILIES[scene.kind].keys.items() for field in keys}

    def line(key: str, value: object) -> list[str]:
        field = fields.get(key)
        return [key, shown(value), "" if field is None or key in scene.written else field.unit, "" if field is None else field.meaning]

    def shown(value: object) -> str:
        text = toml_value(value)
        return text if len(text) <= LONGEST else text[:LONGEST - 3] + "..."

    rows = []
    for table, values in scene.to_dict().items():
        if isinstance(values, dict) and table not in fields:
            rows += [line(f"{table}.{name}", value) for name, value in values.items()]
        elif table not in ("name", "kind", "source"):
            rows += [line(table, each) for each in values] if isinstance(values, list) else [line(table, values)]
    return _title(f"{scene.name} ({scene.kind})") + _paragraphs([scene.source]) + _table("", ["key", "value", "unit", "meaning"], rows)


def chart_html(chart: "Chart") -> str:
    """The table of the command."""
    rows = [[p.label, p.setting, *(small(p.error.get(m.key)) for m in chart.measures), short(p.seconds, 3), str(p.rhs), p.note] for p in chart.points]
    heads = ["method", "setting", *(measure.head for measure in chart.measures), "CPU seconds", "rhs", ""]
    return (_title(chart.name) + _paragraphs([chart.title]) + _table("", heads, rows)
            + _paragraphs(f"left out: {each}" for each in chart.left_out))
