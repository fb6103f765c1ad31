#!/usr/bin/env python3
"""Writes the EBNF in docs/grammar.md, which is grammar/RDDL.g4 for people.

    scripts/grammar_page.py            brings the page up to date
    scripts/grammar_page.py --check    fails if it is not (a test does this)

What stands between <!-- grammar: NAME --> and <!-- end --> in the page is made: for each section of
RDDL.g4 (the comments "// ---- NAME") its rules in the EBNF of the W3C, and for NAME "precedence" the
table of operators, in the order of the alternatives of `expr`. What ANTLR needs and readers do not
is left out: labels of alternatives, commands to the lexer, and the tokens that only serve messages
about spellings of other languages.
"""

import difflib
import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
GRAMMAR = ROOT / "grammar/RDDL.g4"
PAGE = ROOT / "docs/grammar.md"

SECTION = re.compile(r"^// -{20,} (.+)$")
FOREIGN = "// Spellings of other languages."
# A literal, a class of characters or a run of blanks may hold what looks like a comment or an end.
PIECE = re.compile(
    r"'(?:\\.|[^'\\])*'|\[(?:\\.|[^\]\\])*\]|//[^\n]*|\s+|\w+=(?=['(])|->[^;]*|#\s*\w+|;|.", re.S
)
# The page leaves out tokens that are one fixed text: their names mean nothing to readers.
SPELLED_OUT = re.compile(r"^[A-Z_]+ : '[^']*' ;$")


def sections(grammar: str) -> dict[str, str]:
    """The text of each section, by its name."""
    found = {"blocks": ""}
    name = "blocks"
    for line in grammar.split(FOREIGN)[0].splitlines(keepends=True):
        if match := SECTION.match(line):
            name = match.group(1)
            found[name] = ""
        elif not line.startswith("grammar ") and not SPELLED_OUT.match(line.strip()):
            found[name] += line
    return found


def without_labels(text: str) -> str:
    kept = [piece for piece in PIECE.findall(text) if not re.match(r"//|->|#|\w+=$", piece)]
    return "".join(kept)


def rules(text: str) -> list[tuple[str, str]]:
    """Names and right-hand sides, on one line each."""
    found, pieces = [], []
    for piece in PIECE.findall(without_labels(text)):
        if piece != ";":
            pieces.append(" " if piece.isspace() else piece)
            continue
        name, _, right = "".join(pieces).partition(":")
        found.append((name.strip(), re.sub(r" +", " ", right).strip()))
        pieces = []
    assert not "".join(pieces).strip(), f"not a rule: {''.join(pieces)}"
    return found


def alternatives(right: str) -> list[str]:
    """Split at the bars outside of brackets and literals."""
    result, depth = [""], 0
    for piece in PIECE.findall(right):
        depth += (piece == "(") - (piece == ")")
        if piece == "|" and depth == 0:
            result.append("")
        else:
            result[-1] += piece
    return [alternative.strip() for alternative in result]


def wrapped(line: str, indent: int, width: int = 96) -> list[str]:
    lines = [""]
    for word in re.findall(r"'(?:\\.|[^'\\])*'\S*|\[(?:\\.|[^\]\\])*\]\S*|\S+", line):
        if lines[-1] and len(lines[-1]) + 1 + len(word) > width:
            lines.append(" " * indent + word)
        else:
            lines[-1] += (" " if lines[-1] else "") + word
    return lines


def ebnf(name: str, right: str) -> str:
    right = right.replace("~[", "[^").replace(r"'\''", '"\'"')
    line = f"{name} ::= {right}"
    if len(line) <= 110:
        return line
    parts = [f"    {'|' if i else ' '} {part}" for i, part in enumerate(alternatives(right))]
    if len(parts) == 1:
        return "\n".join(wrapped(line, 6))
    if all(len(part) < 32 for part in parts) and len(parts) > 8:  # a list of words
        words = wrapped(" | ".join(alternatives(right)), 6, 90)
        return "\n".join([f"{name} ::=", "      " + words[0], *words[1:]])
    return "\n".join([f"{name} ::=", *parts])


def block(text: str) -> str:
    return "```ebnf\n" + "\n".join(ebnf(name, right) for name, right in rules(text)) + "\n```\n"


def precedence(text: str) -> str:
    """The operators of `expr`, the tightest first, as its alternatives are ordered."""
    expr = dict(rules(text))["expr"]
    rows = ["| level | operators | |", "|---|---|---|"]
    for alternative in alternatives(expr):
        operators = " ".join(f"`{o}`" for o in re.findall(r"'([^'\w]+)'", alternative))
        operators = operators.replace("|", r"\|")
        if re.fullmatch(r"\(.*\) expr", alternative) and "binder" not in alternative:
            rows.append(f"| {len(rows) - 1} | {operators} | before an operand |")
        elif re.fullmatch(r"expr .* expr", alternative):
            rows.append(f"| {len(rows) - 1} | {operators} | between operands, from left to right |")
    rows.append(f"| {len(rows) - 1} | `if`, aggregations, `Discrete_{{...}}`, `det_{{...}}` "
                "| before an operand that takes all that follows |")
    return "\n".join(rows) + "\n"


def made(page: str, grammar: str) -> str:
    texts = sections(grammar)
    parts = {name: block(text) for name, text in texts.items()}
    parts["precedence"] = precedence(texts["expressions"])
    used = set()

    def replace(match: re.Match) -> str:
        used.add(match.group(1))
        return f"<!-- grammar: {match.group(1)} -->\n{parts[match.group(1)]}<!-- end -->"

    page = re.sub(r"<!-- grammar: (\w+) -->\n.*?<!-- end -->", replace, page, flags=re.S)
    assert used == set(parts), f"the page lacks {sorted(set(parts) - used)}"
    return page


def main() -> int:
    page = PAGE.read_text()
    new = made(page, GRAMMAR.read_text())
    if sys.argv[1:] == ["--check"]:
        differences = list(difflib.unified_diff(page.splitlines(), new.splitlines(),
                                                "docs/grammar.md", "grammar/RDDL.g4", lineterm=""))
        print("\n".join(differences) or "docs/grammar.md is what grammar/RDDL.g4 says")
        if differences:
            print("If the grammar is right: scripts/grammar_page.py")
        return 1 if differences else 0
    PAGE.write_text(new)
    return 0


if __name__ == "__main__":
    sys.exit(main())
