"""Every fix repairs its diagnostic: in the test cases and pages that have mistakes, each fix is made by itself, and then its
diagnostic is gone and no syntax error has come.

    RDDLC_BIN=build/bin test_fixes.py
"""

import collections
import json
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
BIN = Path(os.environ.get("RDDLC_BIN", ROOT / "build/bin")).resolve()


def problems():
    """Lists of texts."""
    for folder in sorted((ROOT / "tests/cases").glob("error-*")):
        files = sorted(folder.glob("*.rddl"))
        yield folder.name, [path.read_bytes() for path in files]
    for page in sorted((ROOT / "docs/diagnostics").glob("[EW]*.md")):
        for number, block in enumerate(re.findall(r"```rddl\n(.*?)```", page.read_text(), flags=re.S)):
            yield f"{page.name} {number}", [block.encode()]


def check(texts, folder):
    files = []
    for number, text in enumerate(texts):
        files.append(folder / f"{number}.rddl")
        files[-1].write_bytes(text)
    done = subprocess.run([BIN / "rddlc", "--check", "--diagnostics-format", "json", *files], stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    return json.loads(done.stderr or b"[]")


def offset(text, line, column):
    """Of a line and a column that counts characters."""
    begin = 0
    for _ in range(line - 1):
        begin = text.index(b"\n", begin) + 1
    return begin + len(text[begin:].decode(errors="surrogateescape")[:column - 1].encode(errors="surrogateescape"))


def repaired(texts, fix):
    texts = list(texts)
    for part in sorted(fix, key=lambda part: (part["line"], part["column"]), reverse=True):
        number = int(Path(part["file"]).stem)
        text = texts[number]
        begin, end = offset(text, part["line"], part["column"]), offset(text, part["end_line"], part["end_column"])
        texts[number] = text[:begin] + part["text"].encode() + text[end:]
    return texts


def syntax(codes):
    return sum(count for code, count in codes.items() if code.startswith("E01"))


def main():
    fixes, codes_with_fix, failures = 0, set(), []
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for name, texts in problems():
            if len(texts) > 2:
                continue
            before = check(texts, folder)
            codes = collections.Counter(each["code"] for each in before)
            for each in before:
                if "fix" not in each:
                    continue
                found = check(repaired(texts, each["fix"]), folder)
                after = collections.Counter(other["code"] for other in found)
                same = [other for other in found if all(other.get(key) == each.get(key) for key in ("code", "file", "line", "message"))]
                known = [other for other in before if all(other.get(key) == each.get(key) for key in ("code", "file", "line", "message"))]
                if len(same) >= len(known) or syntax(after) > syntax(codes):
                    failures.append(f"{name}: {each['code']} at {each['line']}: {each['fix']} {codes} {after}")
                fixes += 1
                codes_with_fix.add(each["code"])
    print("\n".join(failures))
    print(f"{fixes} fixes of {len(codes_with_fix)} codes: {' '.join(sorted(codes_with_fix))}")
    return 1 if failures or len(codes_with_fix) < 25 else 0


if __name__ == "__main__":
    sys.exit(main())
