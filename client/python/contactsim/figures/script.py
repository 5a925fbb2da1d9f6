"""A script that draws the CSV of a figure, for who wants to go on from there."""

from __future__ import annotations

from .figure import Figure

_SCRIPT = '''"""{title}: draws {name}.csv. Values are in SI units without prefix."""

import csv
import pathlib

import matplotlib.pyplot as plt

panels, curves = [], {{}}  # A header begins a panel; rows are curve, x, y.
with (pathlib.Path(__file__).parent / "{name}.csv").open(encoding="utf-8") as file:
    for curve, x, y in csv.reader(file):
        if curve == "curve":
            curves = {{}}
            panels.append((x, y, curves))
        else:
            points = curves.setdefault(curve, ([], []))
            points[0].append(float(x))
            points[1].append(float(y))

page, axes = plt.subplots(len(panels), 1, squeeze=False, layout="constrained")
for (x_label, y_label, curves), log, ax in zip(panels, {logs}, axes[:, 0]):
    for name, (x, y) in curves.items():
        mark = "o" if name.endswith(" starts") else "x" if name.endswith(" ends") else ""
        ax.plot(x, y, mark, label=None if mark else name)
    ax.set(xlabel=x_label, ylabel=y_label, yscale="log" if log else "linear")
    ax.legend()
page.savefig("{name}.svg")
'''


def script(figure: Figure, name: str) -> str:
    """The text of the script, which stands beside `name`.csv."""
    title = "".join(c for c in figure.title if c.isprintable() and c not in '"\\')
    return _SCRIPT.format(title=title or name, name=name,
                          logs=[panel.log_y for panel in figure.panels])
