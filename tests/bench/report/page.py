"""The page of make.py: HTML with everything in it, of what the measurements printed and wrote."""

import csv
import html

import bars

STYLE = """
body { font: 15px/1.5 sans-serif; max-width: 70rem; margin: 2rem auto; padding: 0 1rem; color: #222; }
h2 { margin-top: 3rem; border-bottom: 1px solid #ccc; } code, pre { font-family: monospace; font-size: 13px; }
pre { overflow-x: auto; background: #f6f6f6; padding: 1rem; } table { border-collapse: collapse; font-size: 13px; }
td, th { padding: 0.15rem 0.6rem; text-align: right; border-bottom: 1px solid #eee; }
td:first-child, th:first-child { text-align: left; } .wide { overflow-x: auto; } svg { max-width: 100%; height: auto; }
.met { color: #2e933c; } .missed { color: #d1495b; font-weight: bold; }
"""

# A longer table is left to the file that it is in.
MOST_ROWS = 60


def table_of(path):
    """(columns, rows) of a CSV file."""
    with open(path, newline="") as file:
        lines = list(csv.reader(file))
    return (lines[0], lines[1:]) if lines else ([], [])


def html_table(columns, rows):
    def line(cells, tag):
        return "<tr>" + "".join(f"<{tag}>{html.escape(cell)}</{tag}>" for cell in cells) + "</tr>"

    more = f"<p>and {len(rows) - MOST_ROWS} more rows in the file</p>" if len(rows) > MOST_ROWS else ""
    return ('<div class="wide"><table>' + line(columns, "th") + "".join(line(row, "td") for row in rows[:MOST_ROWS])
            + "</table></div>" + more)


def verdict(run):
    if run["exit_code"] == 0:
        return '<span class="met">all that it asks for holds</span>'
    return f'<span class="missed">exit code {run["exit_code"]}: something it asks for does not hold</span>'


def section(run, folder):
    """One measurement: how it was run, its plots, its tables, and all that it printed."""
    parts = [f'<h2 id="{run["name"]}">{run["name"]}: {html.escape(run["what"])}</h2>',
             f'<p><code>{html.escape(run["command"])}</code><br>{run["date"]}, {run["seconds"]:.0f} s, load before it '
             f'{run["load"]}; {verdict(run)}</p>']
    for drawing in sorted(folder.glob("*.svg")):
        parts.append(drawing.read_text())
    for path in sorted(folder.glob("*.csv")):
        columns, rows = table_of(path)
        parts.append(f"<h3>{path.stem.replace('_', ' ')}</h3>")
        parts.extend(bars.chart(chart, columns, rows) for chart in bars.CHARTS.get(path.name, []))
        parts.append(html_table(columns, rows))
    output = html.escape((folder / "output.txt").read_text())
    opened = "" if any(folder.glob("*.csv")) else " open"
    parts.append(f"<details{opened}><summary>what it printed</summary><pre>{output}</pre></details>")
    return "\n".join(parts)


def page(machine, runs, folder):
    facts = html_table(["", ""], [list(pair) for pair in machine])
    contents = "".join(f'<li><a href="#{run["name"]}">{run["name"]}</a>: {html.escape(run["what"])}; {verdict(run)}</li>'
                       for run in runs)
    sections = "\n".join(section(run, folder / run["name"]) for run in runs)
    return (f'<!doctype html><html lang="en"><meta charset="utf-8"><title>Poolhall, measured</title><style>{STYLE}</style>'
            f"<h1>Poolhall, measured</h1>{facts}<ul>{contents}</ul>{sections}</html>\n")
