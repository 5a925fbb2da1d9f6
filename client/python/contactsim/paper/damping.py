"""The paper's section 3: isolated collisions under the damping laws of its Table 1 and its own."""

from __future__ import annotations

import math
from typing import Sequence

import numpy as np
from contact.v1 import job_pb2
from contact.v1.scenario_pb2 import Contact, Output, Scenario

from ..figures.figure import Curve, Figure, Mark, Panel
from ..result import Result
from .cases import STUDY_STIFFNESS, STUDY_VELOCITY, Solve, collisions
from .items import Data, Item, Number, cycles_of

_LAWS = (Contact.HUNT_CROSSLEY, Contact.LANKARANI_NIKRAVESH, Contact.FLORES, Contact.HU_GUO,
         Contact.PAPER_EQ23)
_NAMES = ("Hunt and Crossley", "Lankarani and Nikravesh", "Flores et al.", "Hu and Guo",
          "paper, (23)")
_GRID = [i * 0.05 for i in range(1, 20)]


def damping_items(solve: Solve) -> list[Item]:
    """fig3, fig4, fig5, exponent."""
    laws = solve([collisions(_GRID, law) for law in _LAWS])
    return [_deformation_velocity(solve), _post_restitution(laws), _coefficients(laws),
            _exponent(solve)]


def columns_figure(title: str, data: Data, y_label: str, labels: Sequence[str]) -> Figure:
    """Each column of `data` over the first, which is the restitution that was asked for."""
    x, *columns = np.array(data.rows).T
    curves = [Curve(label, place, x, y) for place, (label, y) in enumerate(zip(labels, columns))]
    return Figure(title, [Panel("pre-restitution coefficient", y_label, curves)],
                  most_colours=len(labels))


def ideal() -> Curve:
    """The dotted line y = x, on which a law would deliver what it is asked for."""
    ends = np.array([0.0, 1.0])
    return Curve("", 6, ends, ends, Mark.DOTTED)


def _deformation_velocity(solve: Solve) -> Item:
    restitutions = (0.9, 0.7, 0.5, 0.3, 0.1)
    scenario = collisions(restitutions, Contact.EXACT)
    scenario.end_time_s = 1e-3
    scenario.output.CopyFrom(Output(sample_interval_s=1e-6))
    run, = solve([scenario])
    curves, rows = [], []
    for colour, restitution in enumerate(restitutions):
        delta, rate = run[f"{colour}.deformation"], run[f"{colour}.deformation_velocity"]
        touching = delta >= 0
        rows += [(restitution, *point)
                 for point in zip(delta[touching].tolist(), rate[touching].tolist())]
        for label, mark, phase in ((f"ε = {restitution:g}", Mark.LINE, touching & (rate >= 0)),
                                   ("", Mark.DASHED, touching & (rate < 0))):
            curves.append(Curve(label, colour, delta[phase], np.abs(rate[phase]), mark))
    title = "Deformation velocity: compression solid, restitution dashed"
    panel = Panel("deformation [m]", "|deformation velocity| [m/s]", curves)
    columns = ("restitution", "deformation [m]", "deformation_velocity [m/s]")
    return Item("fig3", "Deformation velocity against deformation at several restitutions",
                data=[Data("fig3", columns, rows)], figure=Figure(title, [panel]))


def _post_restitution(laws: Sequence[Result]) -> Item:
    columns = [f"restitution_out_{Contact.Damping.Name(law).lower()}" for law in _LAWS]
    rows = [(asked, *(_cycle(law, i).restitution_out for law in laws))
            for i, asked in enumerate(_GRID)]
    data = Data("fig4", ["restitution_in", *columns], rows)
    figure = columns_figure("Restitution that each law delivers; ideal dotted", data,
                            "post-restitution coefficient", _NAMES)
    figure.panels[0].curves[-1].mark = Mark.DASHED  # As printed.
    figure.panels[0].curves.append(ideal())
    own = laws[-1]
    numbers = [Number("(23), largest miss at ε 0.05 to 0.30", 0.029, _miss(own, 0.05, 0.30),
                      limit=1.5e-3),
               Number("(23), largest miss above", 0.008, _miss(own, 0.35, 0.95), limit=2e-4,
                      why="0.0081; the paper says less than 0.008")]
    return Item("fig4", "Post-restitution against pre-restitution under five laws", numbers, [data],
                figure)


def _coefficients(laws: Sequence[Result]) -> Item:
    rows = [(asked, _cycle(laws[3], i).alpha, _cycle(laws[4], i).alpha)
            for i, asked in enumerate(_GRID)]
    data = Data("fig5", ["restitution_in", "alpha_hu_guo", "alpha_paper_eq23"], rows)
    figure = columns_figure("Coefficient α of the damping factor", data,
                            "hysteresis damping factor coefficient α", _NAMES[3:])
    for curve in figure.panels[0].curves:
        curve.mark = Mark.LINE_POINTS
    return Item("fig5", "Coefficient α against restitution: Hu–Guo and (23)", data=[data],
                figure=figure)


def _exponent(solve: Solve) -> Item:
    """The exponent a of (21) is sought from 1.00 down."""
    exponents = [i * 0.01 for i in range(100, 79, -1)]
    runs = solve([_with_exponent(a) for a in exponents])
    rows = [(a, _miss(run, 0, 1)) for a, run in zip(exponents, runs)]
    best = min(rows, key=lambda row: row[1])[0]
    return Item("exponent", "The exponent a of (21) whose largest miss of the restitution is least",
                [Number("a", 0.87, best, limit=1e-9)],
                [Data("exponent", ["exponent_a", "largest_relative_miss"], rows)])


def _with_exponent(a: float) -> Scenario:
    """α = 3(1−ε²)/(2(ε²+ε^a)), paper (21)."""
    scenario = collisions(_GRID, Contact.MU)
    for contact, e in zip(scenario.contacts, _GRID):
        alpha = 1.5 * (1 - e * e) / (e * e + math.pow(e, a))
        contact.ClearField("restitution")
        contact.mu = alpha * STUDY_STIFFNESS / STUDY_VELOCITY
    return scenario


def _cycle(run: Result, contact: int) -> job_pb2.Cycle:
    return cycles_of(run, str(contact))[0]


def _miss(run: Result, low: float, high: float) -> float:
    """Largest relative miss over a part of the grid."""
    return max(abs(_cycle(run, i).restitution_out / asked - 1) for i, asked in enumerate(_GRID)
               if low - 1e-9 <= asked <= high + 1e-9)
