"""Draws what accuracy_benchmark prints: the time of one pass with known μ against the error of the velocities.
Prints a table of the shortest times to three errors.

    accuracy_benchmark >accuracy.csv; accuracy_figure.py accuracy.csv FIGURE.svg
"""

from __future__ import annotations

import csv
import sys

import matplotlib
import matplotlib.pyplot as plt

ERRORS = (1e-6, 1e-9, 1e-11)  # [m/s]
LINES = {"contactd": "o-", "Boost.odeint dopri5": "s--", "Simbody": "^:"}

matplotlib.rcParams.update({
    "svg.hashsalt": "contactd", "svg.fonttype": "path", "font.size": 9, "figure.constrained_layout.use": True,
    "axes.spines.top": False, "axes.spines.right": False})


Points = list[tuple[float, float]]  # Error [m/s] and time [µs].


def time_to(error: float, points: Points) -> str:
    times = [time for reached, time in points if reached <= error]
    return f"{min(times):.3g} µs" if times else "-"


def print_table(points: dict[tuple[str, str], Points]) -> None:
    print("| | | " + " | ".join(f"to {error:.0e} m/s" for error in ERRORS) + " |")
    print("|---" * (2 + len(ERRORS)) + "|")
    for (scenario, program), reached in points.items():
        print(f"| {scenario} | {program} | " + " | ".join(time_to(error, reached) for error in ERRORS) + " |")


def main(table: str, figure: str) -> None:
    points: dict[tuple[str, str], Points] = {}
    with open(table, encoding="utf-8") as file:
        for row in csv.DictReader(file):
            if row["program"] in LINES:
                points.setdefault((row["scenario"], row["program"]), []).append(
                    (float(row["error_m_per_s"]), float(row["time_us"])))
    print_table(points)
    scenarios = list(dict.fromkeys(scenario for scenario, _ in points))
    canvas, axes = plt.subplots(1, len(scenarios), figsize=(9, 3), sharey=True)
    for axis, scenario in zip(axes, scenarios):
        for program, line in LINES.items():
            if (scenario, program) not in points:
                continue
            axis.loglog(*zip(*points[scenario, program]), line, markersize=4, linewidth=1, label=program)
        axis.minorticks_off()
        axis.invert_xaxis()
        axis.set_title(scenario, fontsize=9)
        axis.set_xlabel("error of the velocities [m/s]")
    axes[0].set_ylabel("time [µs]")
    axes[0].legend(frameon=False, fontsize=8)
    canvas.savefig(figure, metadata={"Date": None})


if __name__ == "__main__":
    main(*sys.argv[1:])
