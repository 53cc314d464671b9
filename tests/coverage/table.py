"""table.py ROOT BUILD PROGRAM...: coverage of the rooms as a Markdown table, from gcov's counts in BUILD.

A line counts once however many templates and units hold it, and is run when one of them runs it. A branch is a way
that a condition of the source can go; those that only an exception takes are left out (gcov marks them), for nearly every
call has one. What is compiled into no test program is not seen: headers without code, and rooms that no PROGRAM links.
"""

import collections
import json
import os
import pathlib
import subprocess
import sys

ROOMS = ["physics", "rules", "protocol", "server/settings", "server/storage", "server/match", "server/tournament",
         "server/ledger", "server/ratings", "server/meter", "server/web", "server/net"]


def room_of(path):
    """The room of a source below the root, or None: reference, tests and clients are not asked about."""
    folder = os.path.dirname(path)
    return folder if folder in ROOMS else None


def counts_of(root, build):
    """file -> {"lines": {line: count}, "branches": {(line, index): count}}"""
    files = collections.defaultdict(lambda: {"lines": collections.Counter(), "branches": collections.Counter()})
    # Clang and gcc follow the rooms' links: a source has one name, whichever way it was included.
    for data in sorted(pathlib.Path(build).rglob("*.gcda")):
        said = subprocess.run(["gcov", "--json-format", "--stdout", "--branch-probabilities", str(data.resolve())],
                              capture_output=True, cwd=build, check=True).stdout
        for line in said.splitlines():
            for source in json.loads(line)["files"]:
                add_file(files, root, build, source)
    return files


def add_file(files, root, build, source):
    path = os.path.realpath(os.path.join(build, source["file"]))
    if not path.startswith(root + os.sep):
        return
    name = os.path.relpath(path, root)
    if room_of(name) is None:
        return
    for line in source["lines"]:
        number = line["line_number"]
        files[name]["lines"][number] += line["count"]
        for index, branch in enumerate(b for b in line["branches"] if not b["throw"]):
            files[name]["branches"][number, index] += branch["count"]


def share(hit, total):
    return f"{100 * hit / total:.1f} %" if total else "-"


def totals(counters):
    """(lines hit, lines, branches hit, branches) of some files."""
    found = [0, 0, 0, 0]
    for counter in counters:
        for place, key in enumerate(("lines", "branches")):
            found[2 * place] += sum(1 for count in counter[key].values() if count)
            found[2 * place + 1] += len(counter[key])
    return found


def row(name, counters):
    lines_hit, lines, branches_hit, branches = totals(counters)
    return f"| {name} | {lines} | {share(lines_hit, lines)} | {branches} | {share(branches_hit, branches)} |"


def main():
    root, build, *programs = sys.argv[1:]
    files = counts_of(os.path.realpath(root), os.path.realpath(build))
    commit = subprocess.run(["git", "log", "-1", "--format=%h, %cs"], capture_output=True, text=True, cwd=root,
                            check=True).stdout.strip()
    print("# Coverage\n\nMade by `./pool coverage` on commit " + commit + ": the tests in a build without optimisation, "
          "counted by gcov.\nPrograms: " + ", ".join(programs) + ".\n\n"
          "A line counts once, whichever templates hold it; branches that only an exception takes are left out.\n")
    print("| room | lines | run | branches | taken |\n|---|---|---|---|---|")
    for room in ROOMS:
        of_room = [counter for name, counter in files.items() if room_of(name) == room]
        if of_room:
            print(row(f"`{room}`", of_room))
    print(row("all", files.values()))
    print("\n## Files with most lines that no test runs\n\n| file | lines | run | lines not run |\n|---|---|---|---|")
    worst = sorted(files, key=lambda name: -sum(1 for count in files[name]["lines"].values() if not count))
    for name in worst[:25]:
        lines = files[name]["lines"]
        missed = sorted(number for number, count in lines.items() if not count)
        if missed:
            print(f"| `{name}` | {len(lines)} | {share(len(lines) - len(missed), len(lines))} | {ranges(missed)} |")
    notes = pathlib.Path(root) / "tests/coverage/notes.md"
    if notes.exists():
        print("\n" + notes.read_text().rstrip())


def ranges(numbers):
    """1, 2, 3, 7 -> "1-3, 7"; at the most twelve of them."""
    parts = []
    for number in numbers:
        if parts and parts[-1][1] == number - 1:
            parts[-1][1] = number
        else:
            parts.append([number, number])
    text = [str(a) if a == b else f"{a}-{b}" for a, b in parts[:12]]
    return ", ".join(text) + (f", {len(parts) - 12} more" if len(parts) > 12 else "")


if __name__ == "__main__":
    main()
