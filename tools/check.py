#!/usr/bin/env python3
"""Checks on the sources that no compiler makes. Prints `file:line: what is wrong`, exits 1 if anything is.

layers      an include goes downwards only, and no include cycle exists
standard    a header, or one of ours that it includes, includes what it takes from the standard library
libraries   hypre, METIS, SuiteSparse, MUMPS, fmt, toml++, CLI11 and zlib stay out of the public headers
equations   every `(eq. N)` cited in a source or document is defined, once, in docs/equations.md
functions   none over 80 lines, and half of them at most 10; no driver over 80 lines
links       every relative link of the documents leads somewhere
cases       every driver has its page, docs/cases/CASE.md, and a link to it in docs/cases/README.md
"""

import argparse
import pathlib
import re
import statistics
import sys

# What each layer may include, besides itself.
LAYERS = {
    "core": "",
    "element": "core",
    "material": "core",
    "time": "core",
    "linalg": "core",
    "quadrature": "core element",
    "fluid": "core element material time quadrature",
    "solid": "core element material time quadrature",
    "mesh": "core element quadrature linalg",
    "coupling": "core element material time linalg quadrature fluid solid mesh",
    "assembly": "core element material time linalg quadrature fluid solid mesh coupling",
    "io": "core element material time linalg quadrature fluid solid mesh coupling",
    "simulation": "core element material time linalg quadrature fluid solid mesh coupling assembly io",
}
HIDDEN_LIBRARIES = re.compile(
    r"(HYPRE|_hypre|metis|umfpack|[sd]mumps|cholmod|klu|amd|SuiteSparse|suitesparse/|hypre/|fmt/|toml\+\+|CLI/|zlib)")
INCLUDE = re.compile(r'^\s*#\s*include\s*[<"]([^>"]+)[>"]', re.M)
# What headers may take from the standard library, where precompiled headers hide from the compiler what is missing.
STANDARD = {
    "algorithm": "all_of any_of clamp copy copy_n count erase_if fill fill_n find lower_bound max min min_element "
                 "next_permutation none_of nth_element sort unique upper_bound",
    "array": "array", "chrono": "chrono", "concepts": "convertible_to same_as", "cstdio": "snprintf",
    "cmath": "abs asin atan atan2 cbrt ceil copysign cos exp floor ilogb isfinite llround log lround pow remainder sin "
             "sqrt tan",
    "cstdint": "int64_t uint16_t uint32_t uint64_t uint8_t", "cstring": "memcpy", "ctime": "clock clock_t",
    "functional": "function greater", "initializer_list": "initializer_list", "limits": "numeric_limits", "map": "map",
    "memory": "make_shared make_unique shared_ptr unique_ptr", "numbers": "numbers", "numeric": "iota partial_sum",
    "optional": "optional", "span": "span", "stdexcept": "logic_error runtime_error", "string": "string to_string",
    "string_view": "string_view", "tuple": "tie tuple", "type_traits": "conditional_t is_same_v "
    "is_trivially_copyable_v", "unordered_map": "unordered_map unordered_multimap", "utility": "exchange index_sequence "
    "make_index_sequence", "variant": "variant", "vector": "vector",
}
CITATION = re.compile(r"\(eqs?\.\s*(\d+[a-z]?(?:(?:\s*,\s*|\s*-\s*|\s+and\s+|\s+to\s+)\d+[a-z]?)*)")
DEFINITION = re.compile(r"^\*\*\(eq\. (\d+[a-z]?)\)", re.M)
MAX_FUNCTION_LINES = 80
MAX_MEDIAN_LINES = 10
MAX_DRIVER_LINES = 80


def line_of(text, position):
    return text.count("\n", 0, position) + 1


class Tree:
    """The files of the repository with their text."""

    def __init__(self, root):
        self.root = pathlib.Path(root)
        folders = ["include", "src", "drivers", "test", "bench"]
        self.sources = {}
        for folder in folders:
            for path in sorted((self.root / folder).rglob("*")):
                if path.suffix in (".hpp", ".cpp"):
                    self.sources[str(path.relative_to(self.root))] = path.read_text()
        self.documents = [path for folder in ["docs", "data"] for path in sorted((self.root / folder).rglob("*.md"))]
        self.documents += sorted(self.root.glob("*.md"))

    def includes(self, name):
        """Pairs of (line, included path) of one source."""
        text = self.sources[name]
        return [(line_of(text, m.start()), m.group(1)) for m in INCLUDE.finditer(text)]

    def layer(self, name):
        """The layer of a file by its folder, of other files in src/ by the header they include first; None if free."""
        parts = name.split("/")
        if name.startswith("include/ifsi/"):
            return parts[2]
        if name.startswith("src/") and parts[1] in LAYERS:
            return parts[1]
        if name.startswith("src/"):
            first = [path for _, path in self.includes(name) if path.startswith("ifsi/")]
            return first[0].split("/")[1] if first else None
        return None


def check_layers(tree):
    for name in tree.sources:
        layer = tree.layer(name)
        if layer is None:
            continue
        if layer not in LAYERS:
            yield f"{name}:1: '{layer}' is no layer; there are: {' '.join(LAYERS)}"
            continue
        allowed = {layer, *LAYERS[layer].split()}
        for line, path in tree.includes(name):
            parts = path.split("/")
            if parts[0] == "ifsi" and parts[1] not in allowed:
                yield f"{name}:{line}: {layer}/ may not include {path}; it may include: {' '.join(sorted(allowed))}"


def check_standard(tree):
    provider = {name: header for header, names in STANDARD.items() for name in names.split()}

    def included(name, seen):
        """The standard headers that a header includes, by itself or by others of ours."""
        seen.add(name)
        paths = {path for _, path in tree.includes(name)} if name in tree.sources else set()
        ours = {"include/" + path for path in paths if path.startswith("ifsi/")} - seen
        return paths.union(*(included(path, seen) for path in ours))

    for name, text in tree.sources.items():
        if not name.startswith("include/"):
            continue
        known, missing = included(name, set()), {}
        for match in re.finditer(r"\bstd::(\w+)", without_comments(text)):
            header = provider.get(match.group(1))
            if header and header not in known:
                missing.setdefault(header, (line_of(text, match.start()), match.group(1)))
        for header, (line, used) in missing.items():
            yield f"{name}:{line}: std::{used} without #include <{header}>"


def check_libraries(tree):
    for name in tree.sources:
        if not name.startswith("include/"):
            continue
        for line, path in tree.includes(name):
            if HIDDEN_LIBRARIES.match(path):
                yield f"{name}:{line}: <{path}> in a public header; it belongs in src/"


def check_cycles(tree):
    done, path = set(), []

    def visit(name):
        if name in path:
            yield f"{name}:1: include cycle {' -> '.join(path[path.index(name):] + [name])}"
            return
        if name in done or name not in tree.sources:
            return
        path.append(name)
        for _, included in tree.includes(name):
            yield from visit("include/" + included)
        path.pop()
        done.add(name)

    for name in tree.sources:
        yield from visit(name)


def check_equations(tree):
    document = tree.root / "docs" / "equations.md"
    text = document.read_text() if document.exists() else ""
    known = DEFINITION.findall(text)
    for number in {number for number in known if known.count(number) > 1}:
        yield f"docs/equations.md:1: (eq. {number}) is defined {known.count(number)} times"
    documents = {str(path.relative_to(tree.root)): path.read_text() for path in tree.documents}
    for name, source in {**tree.sources, **documents}.items():
        for match in CITATION.finditer(source):
            for number in re.findall(r"\d+[a-z]?", match.group(1)):
                if number not in known:
                    yield f"{name}:{line_of(source, match.start())}: (eq. {number}) is not in docs/equations.md"


def without_comments(text):
    """The text with comments, literals and preprocessor lines blanked, every newline kept."""
    token = re.compile(
        r'//[^\n]*|/\*.*?\*/|R"(\w*)\(.*?\)\1"|"(?:\\.|[^"\\\n])*"|(?<!\w)\'(?:\\.|[^\'\\\n])\''
        r"|^[ \t]*#(?:[^\n]*\\\n)*[^\n]*", re.S | re.M)
    return token.sub(lambda m: re.sub(r"[^\n]", " ", m.group()), text)


TYPE_SCOPE = re.compile(r"\b(namespace|class|struct|union|enum|extern)\b")
FUNCTION_HEAD = re.compile(r"\)\s*(const|noexcept|override|final|mutable|&|->|requires|try|:|\w|[\s:<>,*&()\[\]{}=.!|+-])*$")


def functions(text):
    """Triples (first line, last line, head) of the outermost function bodies of a source."""
    code = without_comments(text)
    stack, head_start, inside = [], 0, None
    for match in re.finditer(r"[{};]", code):
        at, symbol = match.start(), match.group()
        if inside is None:
            head = code[head_start:at].strip()
            plain = re.sub(r"^\s*(template\s*<[^{;]*?>\s*)*(requires[^{;]*?\s)?", "", head)
            if symbol == "{":
                is_type = TYPE_SCOPE.match(plain) is not None and ")" not in plain
                initialises = not is_type and (
                    ")" not in head or (re.search(r"\)\s*:[^:]", head) and re.search(r"[\w>]$", head)))
                is_function = not is_type and not initialises and FUNCTION_HEAD.search(head)
                stack.append("body" if is_function else "initialiser" if initialises else "scope")
                if is_function:
                    inside = (len(stack), at, head_start, head)
                elif is_type:
                    head_start = at + 1
            elif symbol == "}":
                if stack and stack.pop() != "initialiser":
                    head_start = at + 1
            elif "initialiser" not in stack:
                head_start = at + 1
        elif symbol == "{":
            stack.append("inner")
        elif symbol == "}":
            if len(stack) == inside[0]:
                start = inside[2] + len(code[inside[2]:]) - len(code[inside[2]:].lstrip())
                yield line_of(code, start), line_of(code, at), " ".join(inside[3].split())
                inside, head_start = None, at + 1
            stack.pop()


def check_functions(tree):
    lengths = []
    for name, text in tree.sources.items():
        if not name.startswith(("include/", "src/", "drivers/")):
            continue
        for first, last, head in functions(text):
            lengths.append(last - first + 1)
            if last - first + 1 > MAX_FUNCTION_LINES:
                yield f"{name}:{first}: {last - first + 1} lines in '{head[:60]}'; at most {MAX_FUNCTION_LINES}"
        if name.startswith("drivers/") and text.count("\n") > MAX_DRIVER_LINES:
            yield f"{name}:1: a driver has at most {MAX_DRIVER_LINES} lines, not {text.count(chr(10))}"
    if lengths and statistics.median(lengths) > MAX_MEDIAN_LINES:
        yield f"include:1: the median function has {statistics.median(lengths)} lines; at most {MAX_MEDIAN_LINES}"


def check_links(tree):
    for document in tree.documents:
        text = document.read_text()
        for match in re.finditer(r"\]\(([^)#\s]+)(#[^)\s]*)?\)", text):
            target = match.group(1)
            if "://" not in target and not (document.parent / target).exists():
                name = document.relative_to(tree.root)
                yield f"{name}:{line_of(text, match.start())}: the link to {target} leads nowhere"


def check_cases(tree):
    index = tree.root / "docs/cases/README.md"
    listed = index.read_text() if index.exists() else ""
    for driver in sorted(tree.root.glob("drivers/*.cpp")):
        page = f"{driver.stem}.md"
        if not (index.parent / page).exists() or f"]({page})" not in listed:
            yield f"drivers/{driver.name}:1: expected a page docs/cases/{page}, linked in docs/cases/README.md"


CHECKS = [check_layers, check_standard, check_libraries, check_cycles, check_equations, check_functions, check_links,
          check_cases]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("root", nargs="?", default=pathlib.Path(__file__).resolve().parent.parent)
    parser.add_argument("--lengths", action="store_true", help="print the length of every function")
    arguments = parser.parse_args()
    tree = Tree(arguments.root)
    if arguments.lengths:
        for name, text in tree.sources.items():
            for first, last, head in functions(text):
                print(f"{last - first + 1:4d}  {name}:{first}  {head[:80]}")
        return 0
    errors = [error for check in CHECKS for error in check(tree)]
    print("\n".join(dict.fromkeys(errors)), end="\n" if errors else "")
    return 1 if errors else 0


if __name__ == "__main__":
    sys.exit(main())
