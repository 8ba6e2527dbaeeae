# SPDX-License-Identifier: BSD-3-Clause
"""What docs/ repeats of the code is what the code says (tests/docs_tables.py), every link inside docs/ leads somewhere, and what the pages for
readers show runs and prints what they say."""

import contextlib
import importlib
import io
import math
import re
import shlex
import sys
from pathlib import Path

import pytest
from conftest import at_length
from gyrostat.cli import main

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests"))
import docs_tables  # noqa: E402


def test_tables_are_those_of_the_code() -> None:
    assert list(docs_tables.breaches()) == []


def pages() -> list[Path]:
    return [*ROOT.glob("*.md"), *(ROOT / "docs").glob("*.md")]


def anchors(page: Path) -> set[str]:
    """What #... can name on a page: its headings as GitHub writes them, and explicit anchors."""
    text = page.read_text(encoding="utf-8")
    headings = {re.sub(r"[^\w\- ]", "", h.lower()).replace(" ", "-") for h in re.findall(r"^#+ (.*)$", text, re.M)}
    return headings | set(re.findall(r'<a id="([^"]+)">', text))


def test_links_lead_somewhere() -> None:
    for page in pages():
        text = re.sub(r"^```.*?^```", "", page.read_text(encoding="utf-8"), flags=re.M | re.S)
        for target in re.findall(r"\]\(([^)\s]+)\)", text):
            if "://" in target:
                continue
            name, _, anchor = target.partition("#")
            there = page.parent / name if name else page
            assert there.exists(), f"{page.name}: {target}"
            assert not anchor or anchor in anchors(there), f"{page.name}: {target}"


@pytest.mark.parametrize(("page", "program"), [
    ("README.md", "tests/packaging/readme.cpp"), ("docs/tour.md", "tests/packaging/tour.cpp"), ("docs/general.md", "tests/packaging/own_torque.cpp"),
    ("docs/c.md", "examples/c/solve_a_scene.c")])
def test_the_programs_of_the_pages_are_those_compiled(page: str, program: str) -> None:
    example = (ROOT / program).read_text(encoding="utf-8").partition("\n")[2]
    assert f"```{program.rpartition('.')[2]}\n{example}```" in (ROOT / page).read_text(encoding="utf-8")


@pytest.mark.parametrize("page", ["README.md", "docs/site/index.md"])
def test_the_first_screen_shows_parts_of_the_tour(page: str) -> None:
    shown = [text for language, text in blocks(ROOT / page) if language == "cpp"][:1]
    whole = [line.strip() for line in (ROOT / "tests" / "packaging" / "tour.cpp").read_text(encoding="utf-8").splitlines()]
    assert shown and all(line.strip() in whole for line in "".join(shown).splitlines())


def blocks(page: Path) -> list[tuple[str, str]]:
    """Language and text of every fenced block of a page, in order."""
    return re.findall(r"^```(\w*)\n(.*?)^```$", page.read_text(encoding="utf-8"), re.M | re.S)


def alike(printed: str, shown: str) -> bool:
    """The same words, and the same numbers to two per cent or one in their last place."""
    number = re.compile(r"-?\d+(?:\.\d*)?(?:[eE][-+]?\d+)?")

    def near(a: str, b: str) -> bool:
        mantissa, _, exponent = b.lower().partition("e")
        last = 10.0 ** (int(exponent or 0) - len(mantissa.partition(".")[2]))
        return math.isclose(float(a), float(b), rel_tol=0.02, abs_tol=1.01 * last)

    pairs = zip(number.findall(printed), number.findall(shown), strict=False)
    return number.sub("#", " ".join(printed.split())) == number.sub("#", " ".join(shown.split())) and all(near(a, b) for a, b in pairs)


def by_day(words: list[str]) -> list[str]:
    """A command as it is tried by day: of a sweep that is as long as its scene has it few rows, and no chart, which measures for seconds."""
    if words[0] == "chart":
        return words[: at_length(0, len(words))]
    return [*words, "-n", "50"][: at_length(len(words) + 2, len(words))] if words[0] == "sweep" and "-n" not in words else words


@pytest.mark.parametrize("page", ["README.md", "docs/tour.md", "docs/how-to.md", "docs/general.md", "docs/site/index.md"])
def test_what_the_pages_show_runs(page: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    names: dict[str, object] = {}
    printed = None
    for language, text in blocks(ROOT / page):
        if language == "python":
            with contextlib.redirect_stdout(io.StringIO()) as out:
                exec(compile(at_length(text.replace("n=10000", "n=200"), text), page, "exec"), names)
            printed = out.getvalue()
        elif language == "text" and printed is not None:
            assert alike(printed, text), f"{page} shows\n{text}\nand what ran printed\n{printed}"
            printed = None
        elif language == "":
            for command in re.findall(r"^(?:\.venv/bin/)?gyrostat .*", text, re.M):
                words = by_day(shlex.split(command, comments=True)[1:])
                assert not words or main(words) == 0, command
        else:
            printed = None


HEADER = """
namespace a::inline GYROSTAT_LEVEL {
namespace detail {
/// Not for users.
inline int hidden() { return 1; }
}  // namespace detail

struct Later;

/// What is declared:
///     x = 1
/// and so on.
template <class T>
  requires requires(T t) { t.f(); }
class Each {
 public:
  Each() = default;
  explicit Each(int n) noexcept : n_{n} {}
  /// Says it.
  int n(int more = 2) const noexcept { return "}"[0] + n_; }  // it's that
  double x = 0;  ///< m

 private:
  /// Its own.
  int n_ = 0;
};

template <class T>
int Each<T>::out() { return 1; }

/// Which.
enum class Kind { one, two };
inline constexpr int most[] = {1, 2};
}  // namespace a

LOUD_AGAIN
"""


def test_the_pages_of_the_headers_show_what_is_for_users(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.syspath_prepend(str(ROOT / "docs" / "site"))
    cpp = importlib.import_module("cpp")
    each, kind, most = cpp.read(HEADER)
    assert (each.name, kind.name, most.name) == ("Each", "Kind", "most")
    assert [(part.name, part.comment.strip()) for part in each.members] == [("Each", ""), ("Each", ""), ("n", "Says it."), ("x", "m")]
    assert each.members[1].text == "explicit Each(int n) noexcept" and each.members[2].text == "int n(int more = 2) const noexcept"
    assert cpp.prose(each.comment) == "What is declared:\n\n```text\n    x = 1\n```\n\nand so on."
    assert kind.text == "enum class Kind { one, two }" and kind.comment == "Which.\n"
    # those for users are read below
    for header in at_length([], [*(ROOT / "include").rglob("*.hpp")]):
        cpp.read(header.read_text(encoding="utf-8"))


def test_what_the_public_headers_declare_has_a_comment(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.syspath_prepend(str(ROOT / "docs" / "site"))
    cpp, include = importlib.import_module("cpp"), ROOT / "include" / "gyrostat"
    for name in cpp.listed((ROOT / "docs" / "headers.md").read_text(encoding="utf-8"), include):
        declared = cpp.read((include / name).read_text(encoding="utf-8"))
        told = {each.name for each in declared if each.comment.strip()}  # one defined below has it where it is declared
        assert [each.words for each in declared if each.name not in told] == [], name


def test_the_counts_of_the_headers_are_theirs() -> None:
    for row in re.findall(r"^\| `[\w/]+\.hpp`.*$", (ROOT / "docs" / "headers.md").read_text(encoding="utf-8"), re.M):
        paths = [path for name in re.findall(r"`([\w/]+\.hpp)`", row) for path in (ROOT / "include" / "gyrostat").glob(name.replace("FAMILY", "*"))]
        headers = [path.read_text(encoding="utf-8") for path in paths]
        assert headers, row
        for count in re.findall(r"`(\w+ = [^`]+)`", row):
            assert re.search(rf"\b{re.escape(count)}\b", "".join(headers).replace("'", "")), f"docs/headers.md: not in the header: {count}"


def test_every_page_is_on_the_site() -> None:
    index = (ROOT / "docs" / "site" / "index.md").read_text(encoding="utf-8")
    listed = {re.sub(r".*<(.*)>", r"\1", line) for block in re.findall(r"^```\{toctree\}\n(.*?)^```", index, re.M | re.S) for line in block.splitlines()}
    assert {page.relative_to(ROOT).with_suffix("").as_posix() for page in pages()} <= listed
