"""All measurements of `poolhall bench` as one page: `./pool bench --report [--share 0.01] [--only speed,server]`.

Runs each in turn, keeps what it printed and wrote in DIR/NAME, and writes DIR/report.html: one file with the tables, the
plots, whether the goals were met, the machine, the commit and the commands. With --again the page is made from what an
earlier run left. The exit code is 1 if a measurement failed or a goal was not met.
"""

import argparse
import json
import pathlib
import re
import subprocess
import sys
import time

import page

ROOT = pathlib.Path(__file__).resolve().parents[3]

# How the share of a measurement becomes its options, where that is not `--share`.
OWN_OPTIONS = {
    # Fewer would miss the goals by chance.
    "ratings": lambda share: ["--share", f"{max(0.2, share):g}"],
    "strength": lambda share: ["--games", str(max(4, 2 * round(100 * share))), "--clock", "20"],
    "server": lambda share: ["--seconds", f"{max(3.0, 10 * share):g}", "--idle", str(int(max(500, 10000 * share)))],
    "faults": lambda share: ["--kills", str(max(5, round(1000 * share))), "--games", str(max(4, round(50 * share)))],
}


def said(*command, default=""):
    """What a command printed, or `default` where there is no such command."""
    try:
        return subprocess.run(command, capture_output=True, text=True, cwd=ROOT, check=True).stdout.strip()
    except (OSError, subprocess.CalledProcessError):
        return default


def sub_commands(program):
    """[(name, what it measures)] as `bench --help` lists them."""
    text = said(str(program), "bench", "--help")
    listed = text[text.index("Subcommands:"):].splitlines()[1:]
    return [tuple(line.split(None, 1)) for line in listed if re.match(r"  [a-z]", line)]


def options_of(program, name, share, folder):
    """The command line of one measurement; what it does not know is left away."""
    known = said(str(program), "bench", name, "--help")
    words = OWN_OPTIONS[name](share) if name in OWN_OPTIONS else []
    words = [part for pair in zip(words[::2], words[1::2]) if pair[0] in known for part in pair]
    if name not in OWN_OPTIONS and "--share" in known:
        words += ["--share", f"{share:g}"]
    if "--out" in known:
        words += ["--out", str(folder)]
    return words


def measure(program, name, what, share, folder):
    """Runs one measurement and leaves its text and how it went in `folder`."""
    folder.mkdir(parents=True, exist_ok=True)
    for old in folder.iterdir():
        old.unlink()
    words = options_of(program, name, share, folder)
    print(f"report: bench {name} {' '.join(words)}", file=sys.stderr, flush=True)
    load = said("cut", "-d", " ", "-f1-3", "/proc/loadavg")
    start = time.monotonic()
    run = subprocess.run([str(program), "bench", name, *words], stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                         text=True, errors="replace", cwd=ROOT, check=False)
    (folder / "output.txt").write_text(run.stdout)
    shown = " ".join(word.replace(str(folder), f"bench-results/{name}") for word in words)
    (folder / "run.json").write_text(json.dumps({
        "name": name, "what": what, "command": f"./pool bench {name} {shown}".rstrip(), "seconds": time.monotonic() - start,
        "exit_code": run.returncode, "load": load, "date": time.strftime("%Y-%m-%d %H:%M UTC", time.gmtime())}))
    print(f"report: exit code {run.returncode} after {time.monotonic() - start:.0f} s", file=sys.stderr, flush=True)


def machine():
    """[(name, value)] of what the figures depend on."""
    cpu = re.search(r"model name\s*: (.*)", pathlib.Path("/proc/cpuinfo").read_text())
    memory = re.search(r"MemTotal: *(\d+)", pathlib.Path("/proc/meminfo").read_text())
    dirty = ", with changes that are not committed" if said("git", "status", "--porcelain", "-uno") else ""
    return [("commit", said("git", "log", "-1", "--format=%h of %cs", default="unknown") + dirty),
            ("processor", (cpu.group(1) if cpu else "unknown") + f", {said('nproc')} cores"),
            ("memory", f"{int(memory.group(1)) / 2**20:.1f} GiB" if memory else "unknown"),
            ("system", said("uname", "-sr") + ", " + said("sed", "-n", 's/^PRETTY_NAME="\\(.*\\)"/\\1/p', "/etc/os-release")),
            ("compiler", said("g++", "--version").splitlines()[0] if said("g++", "--version") else "unknown")]


def arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", type=pathlib.Path, default=ROOT / "build/release/poolhall")
    parser.add_argument("--share", type=float, default=1.0, help="of the full numbers of scenes, kills and seconds")
    parser.add_argument("--only", default="", help="these measurements, parted by commas")
    parser.add_argument("--out", type=pathlib.Path, default=ROOT / "bench-results", help="folder of the page and its parts")
    parser.add_argument("--again", action="store_true", help="measure nothing: the page of what is in the folder")
    given = parser.parse_args()
    if not 1e-6 <= given.share <= 1:
        parser.error(f"--share is {given.share}, expected a number from 1e-6 to 1")
    return given


def main():
    given = arguments()
    known = sub_commands(given.program)
    chosen = [name for name in given.only.split(",") if name] or [name for name, _ in known]
    strange = [name for name in chosen if name not in dict(known)]
    if strange:
        sys.exit(f"report: there is no measurement {', '.join(strange)}; expected some of {', '.join(dict(known))}")
    out = given.out.resolve()
    for name in [] if given.again else chosen:
        measure(given.program, name, dict(known)[name], given.share, out / name)
    runs = [json.loads((out / name / "run.json").read_text()) for name in chosen if (out / name / "run.json").exists()]
    (out / "report.html").write_text(page.page(machine(), runs, out))
    print(out / "report.html")
    sys.exit(0 if runs and all(run["exit_code"] == 0 for run in runs) else 1)


if __name__ == "__main__":
    main()
