"""Draws the differences of table.csv: a line a group, a dot a row, a bar for what is allowed.

    make.py FOLDER    writes FOLDER/overview.svg
"""

from __future__ import annotations

import csv
import pathlib
import sys

import matplotlib
import matplotlib.pyplot as plt

LEAST = 1e-16  # Where a difference of 0 is drawn.


def main(folder: pathlib.Path) -> None:
    matplotlib.rcParams.update({"svg.hashsalt": "contactd", "svg.fonttype": "path", "font.size": 8})
    with open(folder / "table.csv", encoding="utf-8", newline="") as file:
        table = list(csv.DictReader(file))
    groups = list(dict.fromkeys(row["group"] for row in table))
    figure, ax = plt.subplots(figsize=(8, 0.28 * len(groups) + 0.7), layout="constrained")
    for row in table:
        line = groups.index(row["group"])
        ax.plot(max(float(row["tolerance"]), LEAST), line, "|", color="#D55E00", markersize=9,
                alpha=0.5)
        ax.plot(max(float(row["difference"]), LEAST), line, "o", color="#0072B2", markersize=4,
                alpha=0.5)
    ax.set(xscale="log", xlabel="difference (dot), and what is allowed (bar)",
           yticks=range(len(groups)), yticklabels=groups)
    ax.invert_yaxis()
    ax.grid(axis="x", alpha=0.3)
    figure.savefig(folder / "overview.svg", metadata={"Date": None})


if __name__ == "__main__":
    main(pathlib.Path(sys.argv[1]))
