# SPDX-License-Identifier: BSD-3-Clause
"""What the C++ headers declare for their users, with the comments as they stand there, as Markdown.

No compiler: the sources are laid out by clang-format, which sets a space before the brace of a body and none before that of a value.
"""
import dataclasses
import pathlib
import re

TYPE = re.compile(r"(struct|class|union|enum class|enum) (?:\[\[\w+\]\] |alignas\(.*?\) )?(\w[\w:<>, ]*?)(?: : .*)?$")
ACCESS = re.compile(r"(public|private|protected):")
TEMPLATE = re.compile(r"template <")
# Not for users, or said elsewhere.
LEFT_OUT = re.compile(r"using namespace|using [\w:, ]+$|static_assert|extern |friend |~|template (?:class|struct|<>) ")
BRACKETS = {"(": ")", "[": "]", "{": "}"}


@dataclasses.dataclass
class Declaration:
    """What is declared, the comment above or behind it, and, of a type, what is declared within for its users."""

    words: str  # in one line
    text: str
    comment: str
    members: list["Declaration"]

    @property
    def name(self) -> str:
        """Of a type its own, of all else the word before its arguments or its value."""
        plain = without_template(self.words)
        if found := TYPE.match(plain):
            return found[2]
        if found := re.search(r"\(\*(\w+)\)", plain):
            return found[1]
        if found := re.search(r"operator *(?:\(\)|\[\]|[^\w\s(]+|\w+(?=\())", plain):
            return found[0]
        head = re.split(r"\(| = |\{|\[|$", re.sub(r"^(concept|using) ", "", plain), maxsplit=1)[0]
        return head.split()[-1].strip("*&")


def without_template(text: str) -> str:
    """A declaration in one line less its attribute, its template <...> and what that requires."""
    text = text.removeprefix("[[nodiscard]] ")
    while TEMPLATE.match(text):
        depth, end = 0, 0
        for end, c in enumerate(text):
            depth += (c == "<") - (c == ">" and text[end - 1] != "-")
            if c == ">" and depth == 0:
                break
        text = re.sub(r"^requires (?:requires *(?:\(.*?\) )?\{.*\} |\(.*?\) |[\w:<>, ]+? (?=\w))", "", text[end + 1:].strip()).removeprefix("[[nodiscard]] ")
    return text


def outside(text: str) -> str:
    """A declaration in one line, less what is in brackets."""
    text = without_template(" ".join(text.split()))
    while (less := re.sub(r"\([^()]*\)", "", text)) != text:
        text = less
    return text


class Reader:
    """Reads the text of a header."""

    def __init__(self, source: str) -> None:
        self.source = source
        self.at = 0

    def matched(self, pattern: str) -> str | None:
        """What stands here, if it is of this pattern, and past it."""
        found = re.compile(pattern).match(self.source, self.at)
        self.at = found.end() if found else self.at
        return found[0] if found else None

    def balanced(self) -> None:
        """From an opening bracket past its closing one; comments and quotes are no brackets."""
        closing = BRACKETS[self.source[self.at]]
        self.at += 1
        while self.source[self.at] != closing:
            self.step()
        self.at += 1

    def step(self) -> None:
        """Past a comment, a quoted text, what is in brackets, or one character."""
        if self.matched(r"//.*|\"(?:\\.|[^\"\\])*\"|'(?:\\.|[^'\\])'"):
            return
        if self.source[self.at] in BRACKETS:
            self.balanced()
        else:
            self.at += 1

    def block(self, shown: bool) -> list[Declaration]:
        """What is declared up to a closing brace or the end; only what is `shown`."""
        made: list[Declaration] = []
        comment = ""
        while self.at < len(self.source) and self.source[self.at] != "}":
            if space := self.matched(r"\s+"):
                comment = "" if space.count("\n") > 1 else comment
            elif said := self.matched(r"///(?!<).*"):
                comment += said[3:].removeprefix(" ") + "\n"
            elif access := self.matched(ACCESS.pattern):
                shown = access == "public:"
            elif not self.matched(r"#(?:.*\\\n)*.*|//.*|;|[A-Z_]+\n"):
                found = self.declaration(comment)
                made += found if shown else []
                comment = ""
        return made

    def declaration(self, comment: str) -> list[Declaration]:
        """One declaration, or those of a namespace, and past it."""
        begin = self.at
        while True:
            c = self.source[self.at]
            head = self.source[begin:self.at]
            if c == ";" or c == "{" and self.source[self.at - 1].isspace() and not re.search(r" =( |$)", outside(head)) \
                    and not re.search(r"requires\s*(\([^{}]*\)\s*)?$", head):
                break
            self.step()
        words = " ".join(re.sub(r"//.*", "", head).split())
        kind = TYPE.match(without_template(words))
        members: list[Declaration] = []
        if c == "{" and (words.startswith("namespace") or kind and not kind[1].startswith("enum")):
            self.at += 1
            members = self.block(not (words.startswith("class") or kind and kind[1] == "class") and not words.endswith("detail"))
            self.at += 1
            if words.startswith("namespace"):
                return members
        elif c == "{":
            self.balanced()
            if kind:
                head = self.source[begin:self.at]
        self.matched(r";")
        comment += "".join(line.strip().removeprefix("///<").strip() + "\n" for line in (self.matched(r"(?: *///<.*\n?)+") or "").splitlines())
        made = Declaration(words, shifted(head), comment, members)
        return [] if LEFT_OUT.match(words) or kind and c == ";" or "::" in made.name else [made]


def shifted(text: str) -> str:
    """A declaration as if it stood at the left, without what a constructor makes of its arguments."""
    lines = re.sub(r"\)( noexcept)?\s*\n? +: .*", r")\1", text.rstrip(), flags=re.S).split("\n")
    rest = [line for line in lines[1:] if line.strip()]
    least = min((len(line) - len(line.lstrip()) for line in rest), default=0)
    return "\n".join([lines[0], *(line[least:] if not text.startswith("template") else line[least:] for line in rest)])


def read(source: str) -> list[Declaration]:
    """What a header declares for its users."""
    return Reader(source).block(True)


def escaped(text: str) -> str:
    """Plain text as Markdown: code between backticks, all else as it stands."""
    parts = re.split(r"(`[^`]+`)", text)
    parts[::2] = [re.sub(r"([\\\\*_<>\[\]|$#~])", r"\\\1", part) for part in parts[::2]]
    return "".join(parts)


def prose(comment: str) -> str:
    """A comment as Markdown: formulas are set in by four spaces, items begin with a star."""
    made: list[str] = []
    formula = False
    for line in comment.rstrip().splitlines():
        if (line.startswith("    ") or formula and line.startswith("  ")) != formula:
            formula = not formula
            made += ["", "```text"] if formula else ["```", ""]
        made.append(line if formula else "* " + escaped(line[2:]) if line.startswith("* ") else escaped(line))
    return "\n".join(made + ["```"] * formula)


def member(of: Declaration) -> list[str]:
    """What a type has, an item each; of a type within it what it has, further in."""
    said = " ".join(escaped(" ".join(of.comment.split())).split())
    code = " ".join(line.split("//")[0].strip() for line in of.text.splitlines())
    made = [f"* ``{code}``" + (f": {said}" if said else "")]
    return made + ["  " + line for each in of.members for line in member(each)]


def listed(guide: str, include: pathlib.Path) -> list[str]:
    """The headers in the tables of the page headers.md; FAMILY stands for each of the families."""
    patterns = [name for row in re.findall(r"^\| (`.*?) \|", guide, re.M) for name in re.findall(r"`([\w/]+\.hpp)`", row)]
    return [found.relative_to(include).as_posix() for name in patterns for found in sorted(include.glob(name.replace("FAMILY", "*")))]


def page(folder: str, headers: dict[str, str]) -> str:
    """A page for headers of one folder: name, source."""
    made = [f"# gyrostat/{folder}"]
    for name, source in headers.items():
        made += ["", f"## `{name}`"]
        for each in read(source):
            made += ["", f"```cpp\n{each.text}\n```", "", prose(each.comment), ""]
            made += [line for part in each.members for line in member(part)]
    return "\n".join(made) + "\n"
