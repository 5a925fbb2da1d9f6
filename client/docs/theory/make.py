"""Draws the pictures of the theory: each from runs on the contactd at CONTACT_SERVER.

    make.py FOLDER
"""

from __future__ import annotations

import pathlib
import subprocess
import sys
from typing import Any, Callable

import contactsim
import matplotlib
import matplotlib.pyplot as plt

import pictures
import statuses

matplotlib.rcParams.update({
    "svg.hashsalt": "contactd", "svg.fonttype": "path", "font.size": 9, "figure.figsize": (7, 2.8),
    "axes.spines.top": False, "axes.spines.right": False, "savefig.bbox": "tight",
    "figure.constrained_layout.use": True})

DRAWN: dict[str, Callable[[contactsim.Client], Any]] = {
    "cycle": pictures.cycle, "damping": pictures.damping, "iteration": pictures.iteration,
    "overlap": pictures.overlap, "clusters": pictures.clusters, "nirv": statuses.nirv,
    "grown": statuses.grown, "infeasible": statuses.infeasible, "jump": statuses.jump, "released": statuses.released,
    "limited": statuses.limited, "cut": statuses.cut, "settled": statuses.settled,
    "not-converged": statuses.not_converged}
LAWS = ("hunt-crossley", "lankarani-nikravesh", "flores", "hu-guo", "paper-eq23",
        "carvalho-martins", "gharib-hurmuzlu")


def main(folder: pathlib.Path) -> None:
    client = contactsim.Client()
    for name, draw in DRAWN.items():
        draw(client).savefig(folder / f"{name}.svg", metadata={"Date": None})
        plt.close("all")
    subprocess.run(["contactctl", "model", "plot", "restitution", *LAWS,
                    "-f", str(folder / "laws.svg")], check=True, stdout=subprocess.DEVNULL)


if __name__ == "__main__":
    main(pathlib.Path(sys.argv[1]))
