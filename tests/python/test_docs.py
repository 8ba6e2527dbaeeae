# SPDX-License-Identifier: BSD-3-Clause
"""What docs/ repeats of the code is what the code says (tests/docs_tables.py), and every link inside docs/ leads somewhere."""

import re
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]


def test_tables_are_those_of_the_code() -> None:
    ran = subprocess.run([sys.executable, ROOT / "tests" / "docs_tables.py"], capture_output=True, text=True)
    assert ran.returncode == 0, ran.stdout + ran.stderr


def anchors(page: Path) -> set[str]:
    """What #... can name on a page: its headings as GitHub writes them, and explicit anchors."""
    text = page.read_text(encoding="utf-8")
    headings = {re.sub(r"[^\w\- ]", "", h.lower()).replace(" ", "-") for h in re.findall(r"^#+ (.*)$", text, re.M)}
    return headings | set(re.findall(r'<a id="([^"]+)">', text))


def test_links_lead_somewhere() -> None:
    for page in (*ROOT.glob("*.md"), *(ROOT / "docs").glob("*.md")):
        text = re.sub(r"^```.*?^```", "", page.read_text(encoding="utf-8"), flags=re.M | re.S)
        for target in re.findall(r"\]\(([^)\s]+)\)", text):
            if "://" in target:
                continue
            name, _, anchor = target.partition("#")
            there = page.parent / name if name else page
            assert there.exists(), f"{page.name}: {target}"
            assert not anchor or anchor in anchors(there), f"{page.name}: {target}"


def test_the_example_of_the_readme_is_compiled() -> None:
    example = (ROOT / "tests" / "packaging" / "readme.cpp").read_text(encoding="utf-8").partition("\n")[2]
    assert f"```cpp\n{example}```" in (ROOT / "README.md").read_text(encoding="utf-8")
