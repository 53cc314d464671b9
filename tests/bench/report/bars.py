"""Bar charts as SVG, of columns of the measurements' tables."""

import dataclasses
import html
import math
import re

COLOURS = ["#1b6ca8", "#d1495b", "#2e933c", "#8e5ea2", "#e07a1f"]
LABEL_WIDTH = 330
BAR_WIDTH = 460
BAR_HEIGHT = 13


@dataclasses.dataclass
class Chart:
    """Columns by their names; a logarithmic axis begins a decade below the least value."""
    title: str
    labels: list
    values: list
    logarithmic: bool = False


CHARTS = {
    "speed.csv": [Chart("microseconds a shot, as simulate plays and by the paper's scheme", [""],
                        ["us a shot, median", "p90", "paper's scheme us"], True)],
    "accuracy.csv": [Chart("position of the ball that is furthest off, metres", ["", "played"],
                           ["position m, median", "p99.9", "max"], True)],
    "operations.csv": [Chart("operations for a second of three rolling balls", [""], ["counted"], True)],
    "growth.csv": [Chart("growth of a change of the cue ball's place, by ball collisions", ["ball collisions"],
                         ["median", "p90"], True)],
    "clusters.csv": [Chart("cluster against hertz, in cue ball speeds", ["gap m", "materials", "ms later"], ["rms"])],
    "robustness.csv": [Chart("deepest overlap, metres", ["table", "materials", ""], ["overlap m"], True)],
    "lean.csv": [Chart("microseconds a shot, computed and omitted", ["omission"], ["computed", "omitted"], True)],
    "ratings_coverage.csv": [Chart("95 % intervals that hold the truth, percent", ["games of a pair"], ["covered %"])],
    "ratings_sprt.csv": [Chart("pairs until an SPRT decides", ["elo0", "elo1", "alpha", "beta"], ["pairs on average"])],
    "mirrored.csv": [Chart("variance of the score difference of a pair", ["pairs"], ["variance"])],
    "noise.csv": [Chart("p of each test of the deviates", ["neighbours", "test"], ["p"])],
    "rules_games.csv": [Chart("turns of random games, longest", ["game", "table"], ["longest"])],
}


def number(text):
    """The number that a cell begins with, or None."""
    found = re.match(r"[<>= ]*(-?[\d,]*\.?\d+(?:e[-+]?\d+)?)", text)
    return float(found.group(1).replace(",", "")) if found else None


def bars_of(chart, columns, rows):
    """[(label, [value or None])] of a chart; empty if the table has other columns than it wants."""
    if any(name not in columns for name in chart.labels + chart.values):
        return []
    place = {name: columns.index(name) for name in reversed(columns)}
    return [(", ".join(row[place[name]] for name in chart.labels if row[place[name]]),
             [number(row[place[name]]) for name in chart.values]) for row in rows]


def scale_of(chart, bars):
    """A function from a value to its share of the axis."""
    values = [value for _, row in bars for value in row if value is not None and value > 0]
    if not values:
        return lambda value: 0.0
    if not chart.logarithmic:
        return lambda value: max(0.0, value) / max(values)
    low = math.floor(math.log10(min(values))) - 0.5
    high = math.log10(max(values))
    return lambda value: (math.log10(value) - low) / (high - low) if value > 0 else 0.0


def chart(wanted, columns, rows):
    """The chart as an SVG element, or nothing where the table cannot give it."""
    bars = bars_of(wanted, columns, rows[:40])
    if not bars:
        return ""
    scale = scale_of(wanted, bars)
    parts, y = [], 28 + (18 if len(wanted.values) > 1 else 0)
    for index, name in enumerate(wanted.values if len(wanted.values) > 1 else []):
        parts.append(f'<text x="{10 + 200 * index}" y="38" fill="{COLOURS[index]}">{html.escape(name)}</text>')
    for label, values in bars:
        parts.append(f'<text x="{LABEL_WIDTH - 8}" y="{y + 11}" text-anchor="end">{html.escape(label[:52])}</text>')
        for index, value in enumerate(values):
            if value is None:
                continue
            width = BAR_WIDTH * scale(value)
            parts.append(f'<rect x="{LABEL_WIDTH}" y="{y}" width="{width:.1f}" height="{BAR_HEIGHT - 2}" '
                         f'fill="{COLOURS[index]}"/><text x="{LABEL_WIDTH + width + 5:.1f}" y="{y + 10}">{value:g}</text>')
            y += BAR_HEIGHT
        y += 6
    note = ", logarithmic" if wanted.logarithmic else ""
    return (f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {LABEL_WIDTH + BAR_WIDTH + 110} {y + 6}" width="900" '
            f'font-family="sans-serif" font-size="11"><text x="10" y="18" font-weight="bold">'
            f'{html.escape(wanted.title + note)}</text>{"".join(parts)}</svg>')
