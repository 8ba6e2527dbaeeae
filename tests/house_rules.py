#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""The rules of the source tree that no compiler checks.

    house_rules.py [--root DIR]     check the tree; one line a breach; exit status 1 if there is any
    house_rules.py --write          write include/gyrostat/gyrostat.hpp anew from the headers that are there, and the umbrella of each
                                    family (gyrostat/rotor.hpp) from the page docs/headers.md, which lists what is public
    house_rules.py --self-test      break each rule in a scratch tree and see that it is noticed

Layers: core <- math <- rotation <- body <- models <- ladder; ode sees core and math only. core, math and ode know no Eigen;
GSL is included by math/gsl.hpp alone, SUNDIALS by src/cvode.cpp alone. No function is longer than 80 lines;
what a comment cites (docs/x.md, section 3; math/root.hpp) exists. No header throws, and what x_definition.hpp defines is
inline where the headers are used alone. Needs Python 3.9 and nothing else.
"""
import argparse
import ast
import os
import pathlib
import re
import sys
import tempfile

LAYERS = {
    "core": {"core"},
    "math": {"core", "math"},
    "rotation": {"core", "math", "rotation"},
    "body": {"core", "math", "rotation", "body"},
    "ode": {"core", "math", "ode"},
    "models": {"core", "math", "rotation", "body", "models"},
    "ladder": {"core", "math", "rotation", "body", "ode", "models", "ladder"},
}
NO_EIGEN = {"core", "math", "ode"}
HEAVY = {"iostream", "functional", "string"}
OPTIONAL = re.compile(r"(^|/)(gsl|cvode)[^/]*$")  # headers of gyrostat::gsl and gyrostat::cvode, named after them
UNTESTED = {"gyrostat.hpp", "version.hpp"}  # checked by the noexcept program
TABLES = {  # tables and the like: tested where they are used
    "core/linkage.hpp": "noexcept/linkage.cmake",
    "ladder/monitor.hpp": "ladder/rotor/solve_test.cpp",
    "math/complete_coefficients.hpp": "math/complete_test.cpp",
    "ode/dop853.hpp": "ode/runge_kutta_test.cpp",
}
UMBRELLA = "gyrostat.hpp"
LEVEL = "core/level.hpp"  # the inline namespace of the instruction level, and all that stands in it
PAGE_OF_HEADERS = "docs/headers.md"  # what it names is public, and so is what the umbrella of a family includes; all else is a detail
OF_EVERY_FAMILY = ["ladder/{}/inputs.hpp", "ladder/{}/solve.hpp"]
UMBRELLAS_TEST = "ladder/one_form_test.cpp"
COMMON = "free"  # the family of models that the others stand on: their motion where nothing acts
DEFINITION = "_definition.hpp"  # what x_definition.hpp defines x.hpp declares, and includes unless the library is compiled

SPDX = "SPDX-License-Identifier: BSD-3-Clause"
SPDX_KINDS = {".hpp", ".cpp", ".h", ".c", ".rs", ".py", ".sh", ".cmake", ".toml", ".in"}
SPDX_NAMES = {"CMakeLists.txt", "dev", "run", ".clang-format", ".clang-tidy", ".editorconfig", ".gitignore"}
NOT_OURS = {"build", "demo", "dist", "__pycache__"}  # and every hidden folder but .ci

INCLUDE = re.compile(r'^[ \t]*#[ \t]*include[ \t]*([<"])([^">]+)[">]', re.M)


def headers(root):
    base = root / "include" / "gyrostat"
    return sorted(path.relative_to(base).as_posix() for path in base.rglob("*.hpp"))


def includes(path):
    return [(kind, name) for kind, name in INCLUDE.findall(path.read_text(encoding="utf-8"))]


def family(relative):
    """The family of models/<family>/x.hpp; None elsewhere."""
    parts = relative.split("/")
    return parts[1] if parts[0] == "models" and len(parts) > 2 else None


def families(root):
    """The families, by the folders of their ladders."""
    return sorted(path.parent.name for path in (root / "include" / "gyrostat" / "ladder").glob("*/solve.hpp"))


def umbrellas(root):
    return {UMBRELLA, *(f"{name}.hpp" for name in families(root))}


def check_layers(root):
    known = set(headers(root))
    for header in sorted(known - umbrellas(root)):
        path = root / "include" / "gyrostat" / header
        layer = header.split("/")[0] if "/" in header else None
        if layer is not None and layer not in LAYERS:
            yield f"include/gyrostat/{header}: no layer is called {layer}; there are {', '.join(LAYERS)}"
            continue
        for kind, name in includes(path):
            where = f"include/gyrostat/{header} includes {name}"
            if kind == '"':
                target = name[len("gyrostat/"):]
                if not name.startswith("gyrostat/"):
                    yield f'{where}: write "gyrostat/..." in full'
                elif target not in known:
                    yield f"{where}: there is no such header"
                elif target in umbrellas(root):
                    yield f"{where}: include what is used, not everything"
                elif OPTIONAL.search(target) and not OPTIONAL.search(header):
                    yield f"{where}: a header that every build has cannot need an optional library"
                elif layer is not None and "/" in target and target.split("/")[0] not in LAYERS[layer]:
                    yield f"{where}: {layer} may see {', '.join(sorted(LAYERS[layer]))} only"
                elif family(header) and family(target) not in (None, family(header), COMMON):
                    yield f"{where}: one family of models does not see another"
            elif name in HEAVY:
                yield f"{where}: headers stay free of <{name}>"
            elif name.startswith("Eigen/") and layer in NO_EIGEN:
                yield f"{where}: {layer} knows no Eigen"
            elif name.startswith("gsl/") and header != "math/gsl.hpp":
                yield f"{where}: only math/gsl.hpp includes GSL"


def check_sundials(root):
    for folder in ("include", "src", "python", "tests", "bench"):
        for path in sorted((root / folder).rglob("*.[ch]pp")):
            for kind, name in includes(path):
                if re.match(r"(cvodes?|nvector|sundials|sunmatrix|sunlinsol|sunnonlinsol)/", name) and kind == "<":
                    relative = path.relative_to(root).as_posix()
                    if relative != "src/cvode.cpp":
                        yield f"{relative} includes {name}: only src/cvode.cpp includes SUNDIALS"


def including(comment, names):
    return f"// {SPDX}\n{comment}\n#pragma once\n\n" + "\n".join(f'#include "gyrostat/{name}"' for name in names) + "\n"


def listed(root):
    """Section -> the headers that the page of headers names there, first column of its tables."""
    page = root / PAGE_OF_HEADERS
    found = {}
    for section in re.split(r"^## ", page.read_text(encoding="utf-8") if page.is_file() else "", flags=re.M)[1:]:
        cells = re.findall(r"^\|([^|]*)\|", section, re.M)
        found[re.match(r"[^:\n]*", section)[0]] = [name for cell in cells for name in re.findall(r"`([\w/]+\.hpp)`", cell)]
    return found


def umbrella_texts(root):
    """The text of each umbrella."""
    ours = umbrellas(root)
    every = [h for h in headers(root) if h not in ours and not OPTIONAL.search(h) and not h.endswith(DEFINITION)]
    texts = {UMBRELLA: including("// Everything but the headers of the optional targets gyrostat::gsl and gyrostat::cvode.", every)}
    for name in families(root):
        public = {each.format(name) for each in OF_EVERY_FAMILY} | set(listed(root).get(name, ()))
        texts[f"{name}.hpp"] = including(
            f"// What is public of the family `{name}`: its ladder, and the models that {PAGE_OF_HEADERS} lists. What else its folders hold are\n"
            "// details: free to read, and to change from one version to the next.", sorted(public))
    return texts


def check_umbrellas(root):
    for name, text in umbrella_texts(root).items():
        path = root / "include" / "gyrostat" / name
        if not path.is_file() or path.read_text(encoding="utf-8") != text:
            yield f"include/gyrostat/{name} does not list the headers that it should: run tests/house_rules.py --write"


def check_page_of_headers(root):
    known, sections = set(headers(root)), listed(root)
    for section, names in sections.items():
        for name in names:
            if known.isdisjoint(name.replace("FAMILY", each) for each in families(root) + [""]):
                yield f"{PAGE_OF_HEADERS} lists {name}, which is not there"
    for name in families(root):
        if name not in sections:
            yield f"{PAGE_OF_HEADERS} has no section of the family {name}"


def check_headers(root):
    for header in headers(root):
        text = (root / "include" / "gyrostat" / header).read_text(encoding="utf-8")
        if "#pragma once" not in text:
            yield f"include/gyrostat/{header}: no #pragma once"
        own = header.replace(DEFINITION, ".hpp")[:-len(".hpp")] + "_test.cpp"
        test = "tests/" + (UMBRELLAS_TEST if header in umbrellas(root) else TABLES.get(header, own))
        if header not in UNTESTED and not (root / test).is_file():
            yield f"include/gyrostat/{header}: its test {test} is missing"


def our_files(root):
    for folder, folders, names in os.walk(root):
        folders[:] = sorted(name for name in folders if name not in NOT_OURS and (name == ".ci" or not name.startswith(".")))
        for name in sorted(names):
            path = pathlib.Path(folder, name)
            if path.is_file():
                yield path


def check_spdx(root):
    for path in our_files(root):
        if path.suffix in SPDX_KINDS or path.name in SPDX_NAMES:
            lines = path.read_text(encoding="utf-8").split("\n")
            first = lines[1] if lines[0].startswith("#!") and len(lines) > 1 else lines[0]
            if not first.removesuffix(" */").endswith(SPDX):
                yield f"{path.relative_to(root).as_posix()}: the first line is not the licence line ({SPDX})"


VERSIONS = {
    "CMakeLists.txt": r"project\(gyrostat VERSION ([\d.]+)",
    "pyproject.toml": r'^version = "([^"]+)"',
    "include/gyrostat/version.hpp": r'header_version = "([^"]+)"',
    "CITATION.cff": r"^version: (\S+)",
    "CHANGELOG.md": r"^## (\d+\.\d+\.\d+)",
}


def check_version(root):
    found = {}
    for name, pattern in VERSIONS.items():
        path = root / name
        match = re.search(pattern, path.read_text(encoding="utf-8"), re.M) if path.is_file() else None
        if match is None:
            yield f"{name}: no version found"
        else:
            found[name] = match[1]
    if len(set(found.values())) > 1:
        yield "the versions differ: " + ", ".join(f"{name} {version}" for name, version in found.items())
    macros = re.findall(r"#define GYROSTAT_VERSION_\w+ (\d+)", (root / "include/gyrostat/version.hpp").read_text(encoding="utf-8")) \
        if "include/gyrostat/version.hpp" in found else []
    if macros and ".".join(macros) != found["include/gyrostat/version.hpp"]:
        yield f"include/gyrostat/version.hpp: its macros say {'.'.join(macros)}"
    ours = found.get("CMakeLists.txt", "") + "."
    for path in our_files(root):
        if path.suffix in (".md", ".txt"):
            for asked in re.findall(r"find_package\(gyrostat ([\d.]+)", path.read_text(encoding="utf-8")):
                if not ours.startswith(asked + "."):
                    yield f"{path.relative_to(root).as_posix()}: asks for version {asked}, and this is {ours[:-1]}"


LONGEST = 80  # lines of a function, from its name to its closing brace
COMMENTS_AND_TEXTS = re.compile(r"""//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"|(?<!\w)'(?:\\.|[^'\\\n])'""", re.S)
TEMPLATE = re.compile(r"(?:\s*template\s*<[^{}]*>[ \t]*\n)*\s*")
SCOPE = re.compile(r"\bnamespace\b[^()]*$|(^|>|\s)(class|struct|union|enum)\b[^=;]*$")


def sources(root, folders, suffixes):
    return [path for path in our_files(root) if path.suffix in suffixes and path.relative_to(root).parts[0] in folders]


def cpp_functions(text):
    """Name, first and last line of what is defined in a namespace or a class: a matching of braces, not a parser."""
    def blank(match):
        return re.sub(r"[^\n]", " ", match[0])
    text = re.sub(r"^[ \t]*#(?:[^\n]*\\\n)*[^\n]*", blank, COMMENTS_AND_TEXTS.sub(blank, text), flags=re.M)
    stack, head = [], 0  # a stack of (is a scope, name, line, head); where the text before the next brace begins
    for i, c in enumerate(text):
        within = not stack or stack[-1][0]
        if c == ";" and within:
            head = i + 1
        elif c == "{":
            opening = text[head:i] if within else ""
            skipped = TEMPLATE.match(opening).end()
            opening = opening[skipped:]
            name = re.search(r"(operator\s*(?:\(\)|[^\s(]+)|[\w~]+)\s*\(", opening)
            if within and SCOPE.search(opening) and not (name and ")" in opening and "enum" not in opening):
                stack.append((True, None, 0, i + 1))
            elif within and name and not opening.rstrip().endswith("="):
                stack.append((False, name[1], text.count("\n", 0, head + skipped) + 1, head))
            else:
                stack.append((False, None, 0, i + 1))
            head = i + 1 if within else head
        elif c == "}" and stack:
            _, name, line, begin = stack.pop()
            if name and re.match(r"\s*[{,]", text[i + 1:i + 80]):
                head = begin  # a member's initializer: the body is still to come
                continue
            if name:
                yield name, line, text.count("\n", 0, i) + 1
            head = i + 1


def python_functions(text):
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, (ast.FunctionDef, ast.AsyncFunctionDef)):
            yield node.name, node.lineno, node.end_lineno


def check_functions(root):
    for path in sources(root, {"include", "src", "python"}, {".hpp", ".cpp", ".py"}):
        functions = python_functions if path.suffix == ".py" else cpp_functions
        for name, first, last in functions(path.read_text(encoding="utf-8")):
            if last - first + 1 > LONGEST:
                yield f"{path.relative_to(root).as_posix()}:{name} (line {first}) has {last - first + 1} lines: cut it along its ideas"


EXCEPTIONS = re.compile(r"\b(throw|try|catch|dynamic_cast|typeid)\b")
DEFINES = re.compile(r"^(?!(?:GYROSTAT_COMPILED_ONCE|inline|constexpr|consteval|static|extern|static_assert|using|namespace|struct|class|template)\b)"
                     r"[A-Za-z_][^\n;={}]*\(", re.M)


def check_headers_alone(root):
    """What only a program of the headers alone would show: that none throws, and that each definition may stand in two files."""
    for path in sources(root, {"include"}, {".hpp"}):
        name = path.relative_to(root).as_posix()
        text = COMMENTS_AND_TEXTS.sub(lambda match: re.sub(r"[^\n]", " ", match[0]), path.read_text(encoding="utf-8"))
        for found in EXCEPTIONS.finditer(text):
            yield f"{name}:{text.count(chr(10), 0, found.start()) + 1} has the word {found[0]}: exceptions exist only in Python"
        if path.name.endswith(DEFINITION):
            for found in DEFINES.finditer(text):
                before = text[:found.start()].rstrip()
                if not re.search(r"(template <[^\n]*|\brequires\b[^\n]*|\\)$", before):
                    yield f"{name}:{text.count(chr(10), 0, found.start()) + 1} is no template and not GYROSTAT_COMPILED_ONCE"


def check_levels(root):
    """That every namespace gyrostat::x is the one of the instruction level, as core/level.hpp declares it first."""
    level = root / "include" / "gyrostat" / LEVEL
    declared = re.findall(r"^namespace (\w+) \{\}", level.read_text(encoding="utf-8"), re.M)
    for path in sources(root, {"include"}, {".hpp"}):
        for name in sorted(set(re.findall(r"^namespace gyrostat::(\w+)", path.read_text(encoding="utf-8"), re.M)) - {"inline", *declared}):
            yield f"{path.relative_to(root).as_posix()}: {LEVEL} does not declare namespace {name}: its functions would be the same at every instruction level"


NUMBERS = r"\d+(?:\.\d+)*(?:(?:, | and | to )\d+(?:\.\d+)*)*"
PAGE = re.compile(r"((?:docs/)?[\w-]+\.md)(?:,? sections? (" + NUMBERS + "))?")
CITED = re.compile(r"(?<![\w<>*./-])((?:[\w-]+/)*[\w-]+\.(?:hpp|cpp))\b")


def comments(path):
    """The comments of a C++ file, or the whole of a Python file, each without its marks and line ends, with its line."""
    text = path.read_text(encoding="utf-8")
    if path.suffix == ".py":
        yield 1, re.sub(r"\s*\n\s*#?\s*", " ", text)
        return
    for match in re.finditer(r"(?:[ \t]*//[^\n]*\n?)+", text):
        yield text.count("\n", 0, match.start()) + 1, re.sub(r"\s*\n?\s*//[/!<]*\s*", " ", match[0])


def check_citations(root):
    files = {"/" + path.relative_to(root).as_posix() for path in our_files(root)}
    sections = {path.name: set(re.findall(r"^#+ (\d+(?:\.\d+)*)", path.read_text(encoding="utf-8"), re.M))
                for path in root.glob("docs/**/*.md")}
    for path in sources(root, {"include", "src", "python", "bench", "tests", "tools"}, {".hpp", ".cpp", ".py"}):
        if path.name == pathlib.Path(__file__).name:
            continue  # breaks the rules in its own test
        for line, text in comments(path):
            where = f"{path.relative_to(root).as_posix()}:{line}"
            for name, numbers in PAGE.findall(text):
                page = name.split("/")[-1]
                if page not in sections and "/" + name not in files:
                    yield f"{where} cites {name}, which is not there"
                for number in re.findall(r"\d+(?:\.\d+)*", numbers):
                    if page in sections and number not in sections[page]:
                        yield f"{where} cites section {number} of {name}, which has none"
            for name in CITED.findall(text) if path.suffix != ".py" else ():
                if not any(file.endswith("/" + name) for file in files):
                    yield f"{where} cites {name}, which is not there"


C_HEADER, C_KEYS = "include/gyrostat/gyrostat.h", "src/c_scene.cpp"
PART = r"(?:body|initial|wheel|torque|orbit|field|solve)\."


def keys_told(text):
    """The keys in the table of the C header, `.rate` behind torque.factor.mean being torque.factor.rate."""
    table = re.search(r"---- A scene ----(.*?)\*/", text, re.S)
    for line in table[1].splitlines() if table else ():
        last = ""
        for name in re.findall(rf"(?<![\w.]){PART}[a-z_.]*[a-z_]|(?<![\w.])\.[a-z_]+", line):
            last = last.rpartition(".")[0] + name if name.startswith(".") else name
            yield last


def check_c_keys(root):
    header, source = root / C_HEADER, root / C_KEYS
    if not header.is_file() or not source.is_file():
        return
    told = set(keys_told(header.read_text(encoding="utf-8")))
    named = set(re.findall(rf'"({PART}[a-z_.]*[a-z_])"', source.read_text(encoding="utf-8")))
    known = {name for name in named if not any(other.startswith(name + ".") for other in named)}  # without names of groups
    for name in sorted(told ^ known):
        yield f"{C_HEADER} lists {name}, which {C_KEYS} does not know" if name in told else f"{C_HEADER} does not list the key {name} of {C_KEYS}"


CHECKS = [check_layers, check_sundials, check_umbrellas, check_page_of_headers, check_headers, check_c_keys, check_spdx, check_version, check_functions, check_headers_alone,
          check_levels, check_citations]


def breaches(root):
    return [line for check in CHECKS for line in check(root)]


# ---- the checker's own test: a small sound tree, then one breach at a time ----

def sound_tree(root):
    files = {
        "include/gyrostat/version.hpp": 'inline constexpr const char* header_version = "1.2.3";',
        "include/gyrostat/core/real.hpp": "#include <concepts>",
        "include/gyrostat/core/level.hpp": "namespace math {}",
        "include/gyrostat/math/root.hpp": '#include "gyrostat/core/real.hpp"',
        "include/gyrostat/math/gsl.hpp": "#include <gsl/gsl_sf_ellint.h>",
        "include/gyrostat/rotation/vector.hpp": "#include <Eigen/Core>",
        "include/gyrostat/models/heavy/full.hpp": '#include "gyrostat/rotation/vector.hpp"',
        "include/gyrostat/models/free/full.hpp": '#include "gyrostat/version.hpp"',
        "include/gyrostat/models/rotor/full.hpp": '#include "gyrostat/models/free/full.hpp"\n#include "gyrostat/version.hpp"',
        "include/gyrostat/ode/taylor.hpp": '#include "gyrostat/math/root.hpp"',
        "include/gyrostat/ladder/solve.hpp": '#include "gyrostat/ode/taylor.hpp"\n#include "gyrostat/models/heavy/full.hpp"',
        "include/gyrostat/ladder/heavy/solve.hpp": '#include "gyrostat/models/heavy/full.hpp"',
        "include/gyrostat/ladder/heavy/inputs.hpp": '#include "gyrostat/models/heavy/full.hpp"',
    }
    write = {name: f"// {SPDX}\n#pragma once\n{text}\n" for name, text in files.items()}
    for name in files:
        short = name[len("include/gyrostat/"):]
        if short not in UNTESTED:
            write[f"tests/{short[:-4]}_test.cpp"] = f'// {SPDX}\n#include "gyrostat/{short}"\n'
    write["src/cvode.cpp"] = f"// {SPDX}\n#include <cvode/cvode.h>\n"
    write[C_HEADER] = f"/* {SPDX} */\n/* ---- A scene ----\n * wheel.rate, .angle 1\n */\n"
    write[C_KEYS] = f'// {SPDX}\nKey keys[] = {{{{"wheel.rate"}}, {{"wheel.angle"}}}};\n'
    write["dev"] = f"#!/usr/bin/env bash\n# {SPDX}\n"
    write["CMakeLists.txt"] = f"# {SPDX}\nproject(gyrostat VERSION 1.2.3)\n"
    write["pyproject.toml"] = f'# {SPDX}\nversion = "1.2.3"\n'
    write["CITATION.cff"] = "version: 1.2.3\n"
    write["CHANGELOG.md"] = "## 1.2.3\n"
    write[f"tests/{UMBRELLAS_TEST}"] = f'// {SPDX}\n#include "gyrostat/heavy.hpp"\n'
    write[PAGE_OF_HEADERS] = "# Headers\n\n## heavy: tops\n\n| header | question |\n|---|---|\n| `models/heavy/full.hpp` | all |\n"
    write["docs/heavy.md"] = "# Heavy\n\n## 2. Equations\n\n### 2.1 Numerics\n"
    write["python/gyrostat/tool.py"] = f"# {SPDX}\ndef short():\n    return 1\n"
    for name, text in write.items():
        (root / name).parent.mkdir(parents=True, exist_ok=True)
        (root / name).write_text(text, encoding="utf-8")
    write_umbrellas(root)


def write_umbrellas(root):
    for name, text in umbrella_texts(root).items():
        (root / "include" / "gyrostat" / name).write_text(text, encoding="utf-8")


def append(name, text):
    def change(root):
        path = root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text((path.read_text(encoding="utf-8") if path.is_file() else "") + text, encoding="utf-8")
    return change


def replace(name, old, new):
    return lambda root: (root / name).write_text((root / name).read_text(encoding="utf-8").replace(old, new), encoding="utf-8")


SOUND = [  # what the rules must let pass
    ("a table, a class and a short function", append("include/gyrostat/core/real.hpp",
        "constexpr int table[] = {\n" + "  1,\n" * 90 + "};\nstruct S {\n  int f() { return 1; }\n" + "  int x;\n" * 90 + "};\n"
        "#define F(x) { \\\n  x\nconst char* s = \"{\"; char c = '{';  // {\nint f(int x = 1) {\n" + "\n" * 78 + "}\n")),
    ("definitions", append("include/gyrostat/ladder/heavy/solve_definition.hpp", f"// {SPDX}\n#pragma once\n"
        "GYROSTAT_COMPILED_ONCE int f(int x) {\n  return g(x);\n}\ntemplate <class T>\nint h(T) {\n  return 1;\n}\n")),
    ("citations", append("src/cvode.cpp", "/// docs/heavy.md, sections 2 and\n/// 2.1 (real.hpp, gyrostat/math/root.hpp); CHANGELOG.md.\n")),
]

BREACHES = [
    ("core sees math", append("include/gyrostat/core/real.hpp", '#include "gyrostat/math/root.hpp"\n'), "core may see core only"),
    ("math sees ode", append("include/gyrostat/math/root.hpp", '#  include "gyrostat/ode/taylor.hpp"\n'), "math may see"),
    ("ode sees a model", append("include/gyrostat/ode/taylor.hpp", '#include "gyrostat/models/rotor/full.hpp"\n'), "ode may see"),
    ("a model advances", append("include/gyrostat/models/heavy/full.hpp", '#include "gyrostat/ode/taylor.hpp"\n'), "models may see"),
    ("the free motion sees a family that stands on it", append("include/gyrostat/models/free/full.hpp", '#include "gyrostat/models/heavy/full.hpp"\n'), "does not see another"),
    ("family sees family", append("include/gyrostat/models/heavy/full.hpp", '#include "gyrostat/models/rotor/full.hpp"\n'), "does not see another"),
    ("Eigen in math", append("include/gyrostat/math/root.hpp", "#include <Eigen/Core>\n"), "math knows no Eigen"),
    ("GSL in a model", append("include/gyrostat/models/heavy/full.hpp", "#include <gsl/gsl_math.h>\n"), "only math/gsl.hpp includes GSL"),
    ("SUNDIALS in a test", append("tests/ode/taylor_test.cpp", "#include <sundials/sundials_types.h>\n"), "only src/cvode.cpp"),
    ("an optional library in a common header", append("include/gyrostat/ladder/solve.hpp", '#include "gyrostat/math/gsl.hpp"\n'), "optional library"),
    ("iostream", append("include/gyrostat/ladder/solve.hpp", "#include <iostream>\n"), "free of <iostream>"),
    ("functional", append("include/gyrostat/ladder/solve.hpp", "#include <functional>\n"), "free of <functional>"),
    ("string", append("include/gyrostat/ladder/solve.hpp", "#include <string>\n"), "free of <string>"),
    ("short include", append("include/gyrostat/ladder/solve.hpp", '#include "answer.hpp"\n'), "in full"),
    ("lost include", append("include/gyrostat/ladder/solve.hpp", '#include "gyrostat/core/lost.hpp"\n'), "no such header"),
    ("umbrella inside", append("include/gyrostat/ladder/solve.hpp", '#include "gyrostat/gyrostat.hpp"\n'), "not everything"),
    ("umbrella of a family inside", append("include/gyrostat/ladder/solve.hpp", '#include "gyrostat/heavy.hpp"\n'), "not everything"),
    ("umbrella of a family stale", append("docs/headers.md", "| `math/root.hpp` | roots |\n"), "include/gyrostat/heavy.hpp does not list"),
    ("a public header that is not there", append("docs/headers.md", "\n## Mathematics\n\n| `math/lost.hpp` | lost |\n"), "lists math/lost.hpp"),
    ("a family without a section", replace("docs/headers.md", "## heavy", "## light"), "no section of the family heavy"),
    ("a key that the C header does not list", append("src/c_scene.cpp", 'Key more = {"wheel.colour"};\n'), "does not list the key wheel.colour"),
    ("a key that is not there", replace("include/gyrostat/gyrostat.h", ".angle", ".angle, .weight"), "lists wheel.weight"),
    ("no licence line in C", append("tests/c/x.c", "int x;\n"), "tests/c/x.c: the first line is not the licence line"),
    ("stray layer", append("include/gyrostat/extras/x.hpp", f"// {SPDX}\n#pragma once\n"), "no layer is called extras"),
    ("umbrella stale", append("include/gyrostat/gyrostat.hpp", "// more\n"), "does not list"),
    ("no pragma once", replace("include/gyrostat/core/real.hpp", "#pragma once", ""), "no #pragma once"),
    ("no test", lambda root: (root / "tests/math/root_test.cpp").unlink(), "its test tests/math/root_test.cpp is missing"),
    ("no licence line", replace("src/cvode.cpp", SPDX, "none"), "src/cvode.cpp: the first line is not the licence line"),
    ("no licence line in a script", replace("dev", SPDX, ""), "dev: the first line is not the licence line"),
    ("version", replace("CITATION.cff", "1.2.3", "1.2.4"), "the versions differ"),
    ("a version before this one is asked for", append("tests/CMakeLists.txt", "find_package(gyrostat 1.1 REQUIRED)\n"), "asks for version 1.1"),
    ("a long function", append("include/gyrostat/core/real.hpp", "namespace x {\ntemplate <class T>\nint f(T) {\n" + "  // more\n" * 79 + "}\n}\n"),
     "core/real.hpp:f (line 6) has 81 lines"),
    ("a long member", append("src/cvode.cpp", "struct S {\n  S() : a{1}, b(a) {" + "\n" * 80 + "  }\n  int a, b;\n};\n"), "src/cvode.cpp:S (line 4) has 81"),
    ("a long function in Python", append("python/gyrostat/tool.py", "def f():\n" + "    pass\n" * 80), "python/gyrostat/tool.py:f (line 4) has 81 lines"),
    ("a header that throws", append("include/gyrostat/core/real.hpp", "inline int f() {\n  throw 1;\n}\n"), "real.hpp:5 has the word throw"),
    ("a definition that is not inline", append("include/gyrostat/ladder/heavy/solve_definition.hpp",
        f"// {SPDX}\n#pragma once\nint f(int x) {{\n  return x;\n}}\n"), "solve_definition.hpp:3 is no template and not"),
    ("a namespace of no level", append("include/gyrostat/math/root.hpp", "namespace gyrostat::math {}\nnamespace gyrostat::heavy {}\n"),
     "math/root.hpp: core/level.hpp does not declare namespace heavy"),
    ("a page that is not there", append("src/cvode.cpp", "/// See docs/light.md.\n"), "src/cvode.cpp:3 cites docs/light.md"),
    ("a section that is not there", append("src/cvode.cpp", "int a;  // as in heavy.md,\n        // sections 2.1 and 3\n"),
     "src/cvode.cpp:3 cites section 3 of heavy.md"),
    ("a header that is not there", append("src/cvode.cpp", "/// Beside math/roots.hpp.\n"), "src/cvode.cpp:3 cites math/roots.hpp"),
    ("version lost", replace("CHANGELOG.md", "1.2.3", "soon"), "no version found"),
]


def self_test():
    failed = 0
    for name, change, expected in [("sound tree", lambda root: None, None), *((*sound, None) for sound in SOUND), *BREACHES]:
        with tempfile.TemporaryDirectory() as scratch:
            root = pathlib.Path(scratch)
            sound_tree(root)
            change(root)
            found = breaches(root)
            right = not found if expected is None else any(expected in line for line in found)
            failed += not right
            print(f"{'ok  ' if right else 'FAIL'} {name}" + ("" if right else f": expected {expected!r}, found {found}"))
    print(f"{len(BREACHES) + len(SOUND) + 1 - failed} passed, {failed} failed")
    return 1 if failed else 0


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--root", type=pathlib.Path, default=pathlib.Path(__file__).resolve().parents[1])
    parser.add_argument("--write", action="store_true")
    parser.add_argument("--self-test", action="store_true")
    args = parser.parse_args()
    if args.self_test:
        return self_test()
    if args.write:
        write_umbrellas(args.root)
    found = breaches(args.root)
    print("\n".join(found) if found else f"the rules hold in {len(headers(args.root))} headers")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
