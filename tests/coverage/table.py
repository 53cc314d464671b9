"""table.py ROOT BUILD PROGRAM...: coverage of the rooms as a Markdown table, from gcov's counts in BUILD.

A line counts once however many templates and units hold it, and is run when one of them runs it; one that is only a
brace does not count, for what the compiler puts there is what an exception destroys. A branch is a way
that a condition of the source can go. The compiler has more of them, which do not count: calls that may throw go to the
next line or to a handler, and ends of blocks ask what there is to destroy. (Where a condition itself makes temporaries,
what asks whether to destroy them is not told apart and counts.) What no unit of the build compiles is not seen:
templates that nobody uses.
"""

import collections
import concurrent.futures
import functools
import json
import os
import pathlib
import re
import subprocess
import sys

ROOMS = ["physics", "rules", "protocol", "server/settings", "server/storage", "server/match", "server/tournament",
         "server/ledger", "server/ratings", "server/meter", "server/web", "server/net", "server/app"]

CONDITION = re.compile(r"\b(if|for|while|switch)\b|\?|&&|\|\||==|!=")
DEFAULTED = re.compile(r"= default;")


def room_of(path):
    """The room of a source below the root, or None: reference, tests and clients are not asked about."""
    folder = os.path.dirname(path)
    return folder if folder in ROOMS else None


def counts_of(root, build):
    """file -> {"lines": {line: count}, "branches": {(line, index): count}}"""
    files = collections.defaultdict(lambda: {"lines": collections.Counter(), "branches": collections.Counter()})
    units = sorted(pathlib.Path(build).rglob("*.gcno"))
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        for said in pool.map(lambda unit: gcov(unit, build), units):
            for line in said.splitlines():
                for source in json.loads(line)["files"]:
                    add_file(files, root, build, source)
    return files


def gcov(unit, build):
    # Where there are no counts beside the unit's notes, nothing of it was run: gcov says so.
    return subprocess.run(["gcov", "--json-format", "--stdout", "--branch-probabilities", str(unit.resolve())],
                          stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, cwd=build, check=True).stdout


def add_file(files, root, build, source):
    # The compiler follows the rooms' links: a source has one name, whichever way it was included.
    path = os.path.realpath(os.path.join(build, source["file"]))
    if not path.startswith(root + os.sep):
        return
    name = os.path.relpath(path, root)
    if room_of(name) is None:
        return
    texts, conditions = texts_of(path), conditions_of(path)
    for line in source["lines"]:
        number = line["line_number"]
        if number not in texts:
            continue
        files[name]["lines"][number] += line["count"]
        if number in conditions:
            for index, count in enumerate(ways_of(line["branches"])):
                files[name]["branches"][number, index] += count


@functools.cache
def texts_of(path):
    """number -> line, of those in which a word stands."""
    lines = pathlib.Path(path).read_text().splitlines()
    return {number: text for number, text in enumerate(lines, 1) if re.search(r"\w", text)}


@functools.cache
def conditions_of(path):
    """The numbers of the lines in which a condition stands."""
    return {number for number, text in texts_of(path).items()
            if CONDITION.search(text) and not DEFAULTED.search(text)}


def ways_of(branches):
    """The counts of a line's branches without calls that may throw: gcov names the handler after the next line."""
    ways = []
    for branch in branches:
        if branch["throw"]:
            ways.pop()
        else:
            ways.append(branch["count"])
    return ways


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


def print_rooms(files):
    print("| room | lines | run | branches | taken |\n|---|---|---|---|---|")
    for room in ROOMS:
        of_room = [counter for name, counter in files.items() if room_of(name) == room]
        if of_room:
            print(row(f"`{room}`", of_room))
    of_server = [counter for name, counter in files.items() if name.startswith("server/")]
    print(row("server in all", of_server))
    print(row("all", files.values()))


def missed_lines(counter):
    return sorted(number for number, count in counter["lines"].items() if not count)


def print_worst(files):
    print("\n## Files with most lines that no test runs\n\n| file | lines | run | lines not run |\n|---|---|---|---|")
    for name in sorted(files, key=lambda name: (-len(missed_lines(files[name])), name))[:25]:
        lines, missed = len(files[name]["lines"]), missed_lines(files[name])
        if missed:
            print(f"| `{name}` | {lines} | {share(lines - len(missed), lines)} | {ranges(missed)} |")


def main():
    root, build, *programs = sys.argv[1:]
    files = counts_of(os.path.realpath(root), os.path.realpath(build))
    commit = subprocess.run(["git", "log", "-1", "--format=%h, %cs"], capture_output=True, text=True, cwd=root,
                            check=True).stdout.strip()
    print("# Coverage\n\nMade by `./pool coverage` on commit " + commit + ": the rooms' tests in a build without "
          "optimisation, counted by gcov.\nPrograms: " + ", ".join(programs) + ".\n\n"
          "A line counts once, whichever templates hold it. A branch is a way that a condition can go; where a call "
          "goes when it throws is left out.\n")
    print_rooms(files)
    notes = pathlib.Path(root) / "tests/coverage/notes.md"
    if notes.exists():
        print("\n" + notes.read_text().rstrip())
    print_worst(files)


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
