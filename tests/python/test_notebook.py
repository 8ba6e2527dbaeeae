# SPDX-License-Identifier: BSD-3-Clause
"""Answers, scenes and charts as HTML."""

import math
from html.parser import HTMLParser

import gyrostat
from gyrostat.charts import Chart, ChartPoint, LeftOut
from gyrostat.charts.problem import Measure


class Reader(HTMLParser):
    """The cells of each table, the text of all, and that what is opened is closed in order."""

    def __init__(self, html: str) -> None:
        super().__init__()
        self.open: list[str] = []
        self.tables: list[list[list[str]]] = []
        self.text = ""
        self.feed(html)
        assert not self.open

    def handle_starttag(self, tag: str, attrs: object) -> None:
        self.open.append(tag)
        if tag == "table":
            self.tables.append([])
        elif tag == "tr":
            self.tables[-1].append([])
        elif tag in ("td", "th"):
            self.tables[-1][-1].append("")

    def handle_endtag(self, tag: str) -> None:
        assert self.open.pop() == tag

    def handle_data(self, data: str) -> None:
        self.text += data
        if self.open and self.open[-1] in ("td", "th"):
            self.tables[-1][-1][-1] += data


def test_an_answer_shows_its_report() -> None:
    answer = gyrostat.solve("tiangong-1")
    page = Reader(answer._repr_html_())
    tried, scalars, columns = page.tables
    assert "tiangong-1 (deceleration)" in page.text and f"estimated error {answer.greatest_error:.2g} (stop_time)" in page.text
    assert ["averaged", f"{answer.greatest_error:.2g}", "answered", ""] in [row[:4] for row in tried]
    assert ["stop_time", f"{answer.scalars['stop_time']:.9g}", "s", f"{answer.scalar_error['stop_time']:.2g}"] in scalars
    assert scalars[0] == ["name", "value", "unit", "estimated error"] and [row[0] for row in columns[1:]] == list(answer)


def test_a_scene_shows_its_keys() -> None:
    page = Reader(gyrostat.load("half-rate-tongue", name="<b> & co")._repr_html_())
    rows = {row[0]: row[1:] for row in page.tables[0]}
    assert "<b> & co (heavy)" in page.text
    assert rows["field.gravity"][1:] == ["m/s^2", "gravity g at the fixed point"] and "cos_inclination = " in rows["initial.periodic"][0]
    long = Reader(gyrostat.load("tiangong-1", times=list(range(100_000)))._repr_html_())
    assert len(long.text) < 5000


def test_a_chart_shows_its_points() -> None:
    measures = (Measure("attitude", "attitude", "Attitude", "rad"), Measure("energy", "energy", "Energy", ""))
    point = ChartPoint("rung", "rung full", "tolerance 1e-06", {"attitude": 1.5e-7, "energy": math.nan}, 0.0123, 42, "stated error 2e-07")
    page = Reader(Chart("a scene", "rotor", "against Taylor", measures, (point,), (LeftOut("rival", "heyoka", ("tolerance 1e-12",), "takes over 3 s"),))._repr_html_())
    assert "left out: heyoka, tolerance 1e-12: takes over 3 s" in page.text
    assert page.tables == [[["method", "setting", "attitude", "energy", "CPU seconds", "rhs", ""],
                            ["rung full", "tolerance 1e-06", "1.5e-07", "-", "0.0123", "42", "stated error 2e-07"]]]
