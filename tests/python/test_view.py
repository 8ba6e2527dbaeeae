# SPDX-License-Identifier: BSD-3-Clause
"""The motion as a page: that it needs nothing else, that its data are those of the answer, and that a browser plays it."""

import json
import math
import re
import shutil
import subprocess
from pathlib import Path
from typing import Any

import gyrostat
import gyrostat.free
import numpy as np
import pytest
from gyrostat.cli import main
from gyrostat.rotation import matrix_from_quaternion
from gyrostat.scenes import scene_from
from gyrostat.view import TURNS, View, view

# One of each family; the tops with and without an attitude.
SCENES = ("tiangong-1", "intelsat-v-flat-spin", "gyrostat-kick", "toy-top", "half-rate-tongue", "cubesat-pyramid", "rolling-gyroscope", "gravity-gradient-boom")
CHROMIUM = shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")


def shown(page: str) -> Any:
    """The data in the page."""
    found = re.search(r'<script id="data" type="application/json">(.*?)</script>', page, re.S)
    assert found
    return json.loads(found[1], parse_constant=lambda constant: pytest.fail(f"{constant} is no JSON"))


@pytest.fixture(scope="module", params=SCENES)
def made(request: pytest.FixtureRequest) -> View:
    return view(gyrostat.load(request.param))


def test_a_page_needs_nothing_else(made: View) -> None:
    assert not re.search(r"https?:|\bsrc=|\bhref=|url\(|@import|\bimport\b|\bfetch\b|XMLHttpRequest", made.html)
    assert made.html.startswith("<!doctype html>") and made.html.count("</script>") == 2


def test_a_page_shows_its_answer(made: View) -> None:
    data, answer = shown(made.html), made.answer
    assert data["summary"].startswith(f"answered by {answer.model}") and data["errors"]["attitude"] == f"{answer.error['attitude']:.2g}"
    assert (data["begin"], data["end"]) == (answer.t[0], answer.t[-1]) and data["notes"] == list(made.notes)
    q = np.array(data["attitude"])
    assert np.all(np.sum(q[1:] * q[:-1], axis=1) > 0.8)  # steps are small, and no sign jumps
    np.testing.assert_allclose(np.abs(np.sum(q * answer["attitude"], axis=1)), 1, atol=1e-6)
    np.testing.assert_allclose(data["angular_velocity"], answer["angular_velocity"], rtol=1e-6, atol=1e-12)
    assert np.linalg.norm(data["axis"]) == pytest.approx(1)
    assert all(np.linalg.norm(axis) == pytest.approx(1) for axis in data["wheels"])


@pytest.mark.parametrize("name", ["tumbling-brick", "cubesat-pyramid", "rotor-paper-repaired", "t-handle"])
def test_without_loads_the_momentum_stands_in_space(name: str) -> None:
    data = shown(view(gyrostat.load(name)).html)
    M_I = np.einsum("nij,nj->ni", matrix_from_quaternion(np.array(data["attitude"])), np.array(data["angular_momentum"]))
    np.testing.assert_allclose(M_I, np.broadcast_to(M_I[0], M_I.shape), atol=1e-5 * np.linalg.norm(M_I[0]))


@pytest.mark.parametrize("name", SCENES)
def test_the_box_has_the_moments_of_the_body(name: str) -> None:
    """An even box of unit mass has b^2 + c^2 thirds of the half edges about its centre, and more about a fixed point."""
    data = shown(view(gyrostat.load(name)).html)
    half, axes, centre = (np.array(data["box"][key]) for key in ("half", "axes", "centre"))
    inertia = axes.T @ np.diag((half @ half - half**2) / 3) @ axes + centre @ centre * np.eye(3) - np.outer(centre, centre)
    moments = np.linalg.eigvalsh(inertia)
    assert moments / moments[2] == pytest.approx(np.array(data["moments"]) / data["moments"][2], rel=2e-3)
    np.testing.assert_allclose(axes @ axes.T, np.eye(3), atol=1e-6)


def test_a_fixed_body_without_a_mass_can_be_seen_and_so_can_one_with_wheels_apart() -> None:
    body = {"inertia": [3.0, 2.5, 1.5], "fixed": True, "centre_of_mass": [0.0, 0.0, 0.2]}
    scene: dict[str, Any] = {"name": "x", "kind": "general", "body": body, "initial": {"angular_velocity": [0.1, 0.2, 0.3]}, "solve": {"times": [0.0, 5.0]}}
    assert shown(view(scene_from(scene)).html)["box"]["centre"][2] > 0
    wheel = {"axis": [0.0, 0.0, 1.0], "axial_inertia": 0.1, "equatorial_inertia": 0.06, "mass": 50.0, "position": [0.0, 0.0, -0.2]}
    apart = {**scene, "body": {**body, "mass": 1.0, "wheels_in_inertia": False}, "wheel": [wheel]}
    assert shown(view(scene_from(apart)).html)["box"]["centre"][2] < 0


def test_the_window_is_some_tens_of_turns() -> None:
    made = view(gyrostat.load("stage-despin-study"))
    assert shown(made.html)["turns"] == pytest.approx(TURNS, rel=0.05)
    assert any(f"The first {TURNS} turns of" in note for note in made.notes)
    short = gyrostat.solve("t-handle").view(begin=1.0, end=3.0)
    assert (short.answer.t[0], short.answer.t[-1]) == (1.0, 3.0)
    long = view(gyrostat.load("stage-despin-study"), end=16000.0)
    assert any("Thinned" in note for note in long.notes) and len(long.answer.t) < 7000


def test_what_no_view_can_show_is_refused() -> None:
    with pytest.raises(gyrostat.DomainError, match="nothing turns from"):
        view(gyrostat.load("t-handle", **{"initial.angular_velocity": [0.0, 0.0, 0.0]}))
    with pytest.raises(gyrostat.DomainError, match="turns are more than a view shows"):
        view(gyrostat.load("toutatis"), end=1e12)
    with pytest.raises(gyrostat.DomainError, match="nothing to see from 5 s to 3 s"):
        view(gyrostat.load("t-handle"), 5.0, 3.0)
    with pytest.raises(gyrostat.DomainError, match="rung averaged does not give"):
        view(gyrostat.load("tiangong-1", model="averaged"))


def test_a_missing_attitude_is_found() -> None:
    made = view(gyrostat.load("tiangong-1"))
    assert shown(made.html)["attitude"][0] == [0, 0, 0, 1] and any("gives no attitude" in note for note in made.notes)
    top = view(gyrostat.load("half-rate-tongue"))
    periodic = gyrostat.solve("half-rate-tongue", times=[0.0], ask=["down"])
    R_IB = matrix_from_quaternion(np.array(shown(top.html)["attitude"][0]))
    np.testing.assert_allclose(R_IB @ periodic["down"][0], [0, 0, -1], atol=1e-6)
    assert any("vertical alone" in note for note in top.notes)


def test_an_answer_of_a_function_can_be_seen() -> None:
    answer = gyrostat.free.solve(inertia=[1.0, 2.0, 3.0], angular_velocity=[0.1, 1.0, 0.1], times=[0.0, 20.0])
    page = answer.view()._repr_html_()
    assert page.startswith('<iframe srcdoc="&lt;!doctype html&gt;') and page.count("<") == 2


def test_the_command(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file = tmp_path / "view.html"
    assert main(["view", "t-handle", "--from", "1", "--to", "0.05 min", "-o", str(file)]) == 0
    assert (shown(file.read_text())["begin"], shown(file.read_text())["end"]) == (1, 3)
    assert f"wrote {file}: answered by full" in capsys.readouterr().err
    assert main(["view", "tiangong-1", "--set", "model=averaged", "-o", str(file)]) == 2
    with pytest.raises(SystemExit):
        main(["view", "t-handle", "--to", "3 kg"])
    assert "this is no time" in capsys.readouterr().err


# What a reader does once the motion plays: it comes into the page as a script of its own, and leaves what it saw in the text of an element.
READER = """
<script>
const failures = [];
window.addEventListener("error", event => failures.push(event.message));
window.addEventListener("load", function read() {
  if (Number(document.getElementById("time").value) === 0) return void setTimeout(read, 20);
  const press = (key, on = document.body) => on.dispatchEvent(new KeyboardEvent("keydown", { key, bubbles: true }));
  const ink = id => document.getElementById(id).toDataURL();
  const seen = { failures, played: Number(document.getElementById("time").value), button: document.getElementById("play").textContent };
  press(" ");
  seen.paused = document.getElementById("play").textContent;
  press("End");
  paint();
  seen.end = document.getElementById("readout").textContent;
  seen.turned = ["space", "sphere"].map(id => {
    const before = ink(id);
    document.getElementById(id).dispatchEvent(new PointerEvent("pointermove", { buttons: 1, movementX: 40, movementY: 20, bubbles: true }));
    paint();
    return ink(id) !== before;
  });
  document.body.appendChild(document.createElement("pre")).textContent = "SEEN" + JSON.stringify(seen);
});
</script>
"""


@pytest.mark.skipif(CHROMIUM is None, reason="no Chromium")
@pytest.mark.parametrize("name", ["t-handle", "toy-top"])
def test_a_browser_plays_it(name: str, tmp_path: Path) -> None:
    file = tmp_path / "view.html"
    made = view(gyrostat.load(name))
    file.write_text(made.html.replace("<style>", READER + "<style>", 1))
    command = [CHROMIUM or "", "--headless=new", "--no-sandbox", "--disable-gpu", "--enable-logging=stderr", f"--user-data-dir={tmp_path / 'profile'}",
               "--virtual-time-budget=20000", "--dump-dom", file.as_uri()]
    for _ in range(4):  # the browser's virtual clock may run out before its first picture, on a busy machine: then it has seen nothing
        ran = subprocess.run(command, capture_output=True, text=True, timeout=120)
        assert "CONSOLE" not in ran.stderr, ran.stderr
        found = re.search(r"SEEN(\{.*\})</pre>", ran.stdout)
        if found:
            break
    assert found, ran.stdout[-2000:] + ran.stderr
    seen = json.loads(found[1])
    assert seen["failures"] == [] and seen["played"] > 0 and (seen["button"], seen["paused"]) == ("Pause", "Play")
    end = float(re.findall(r"t = ([\d.]+)", seen["end"])[0]) * shown(made.html)["time_unit"][0]
    assert end == pytest.approx(made.answer.t[-1], rel=1e-3) and math.isfinite(end)
    assert seen["turned"] == [True, True]
