"""Names are found by words and brackets; the compiler tells whether all of them were found. In problems of rddlrepository, at
$RDDL_REPOSITORY, every declared name and variable is renamed, and the diagnostics stay what they were.

    RDDLC_BIN=build/bin test_names.py          some problems
    RDDLC_BIN=build/bin test_names.py --all    all of them (four minutes)
"""

import os
import re
import sys
import tempfile
from pathlib import Path

from client import Client, Failed

SKIPPED = 77
EVERY = 9


def codes(client):
    return sorted((name, each.get("code", "")) for name in ["domain.rddl", "instance.rddl"] for each in client.checked(name))


def declared(client, name):
    """The places of names that the outline shows, and of variables."""
    found = []
    for block in client.request("textDocument/documentSymbol", {"textDocument": {"uri": client.uri(name)}}):
        for section in block["children"]:
            if section["name"] in ("types", "pvariables", "objects"):
                found += [(child["name"], child["selectionRange"]["start"]) for child in section["children"]]
    return found


def rename_all(client):
    count = 0
    for name, _ in declared(client, "domain.rddl"):
        place = {each: where for each, where in declared(client, "domain.rddl")}.get(name)
        client.apply(client.request("textDocument/rename", {
            "textDocument": {"uri": client.uri("domain.rddl")}, "position": place, "newName": f"zz-{count}"}))
        count += 1
    # Variables: the first that has its old name, until all have new ones.
    while match := re.search(r"^[^/\n]*?(\?(?!zz)[A-Za-z0-9_-]*[A-Za-z0-9])", client.texts["domain.rddl"], flags=re.M):
        offset = match.start(1)
        try:
            client.apply(client.ask("rename", "domain.rddl", client.texts["domain.rddl"][offset:], newName=f"zz{count}"))
        except Failed as failed:
            raise AssertionError(match[0]) from failed
        count += 1
    return count


def main():
    repository = os.environ.get("RDDL_REPOSITORY")
    if not repository:
        print("skipped: RDDL_REPOSITORY does not name a copy of rddlrepository")
        return SKIPPED
    domains = sorted(path for path in Path(repository).rglob("domain.rddl"))
    chosen = domains if "--all" in sys.argv else domains[::EVERY]
    names = 0
    for domain in chosen:
        instance = min(domain.parent.glob("instance*.rddl"), key=lambda path: path.stat().st_size, default=None)
        if instance is None:
            continue
        with tempfile.TemporaryDirectory() as folder, Client(Path(folder).resolve()) as client:
            client.open("domain.rddl", domain.read_text(encoding="utf-8", errors="replace"))
            client.open("instance.rddl", instance.read_text(encoding="utf-8", errors="replace"))
            before = codes(client)
            count = rename_all(client)
            after = codes(client)
            assert before == after, (domain, before, client.diagnostics)
            assert count > 2, domain
            names += count
    print(f"{names} names of {len(chosen)} problems renamed")
    return 0


if __name__ == "__main__":
    sys.exit(main())
