"""The paper's 6.2: the ball on a spring that is pushed against a wall."""

from __future__ import annotations

from typing import Sequence

from contact.v1.scenario_pb2 import Solver

from ..figures import Curve, Mark, preset_figure
from ..result import Result
from .cases import Solve, solve_as_paper, spring_wall
from .items import Data, Item, Number, cycles_of, samples

_CONTACT = "ball-wall"
_STIFFNESS = 1.8e7  # N/m^1.5
_TOLERANCE = 0.005  # ξ of the paper.

# Table 4: corrections for the first eleven cycles, by (29) and by (31) before there is a bracket.
_BY_NEWTON = (0, 0, 1, 1, 5, 1, 1, 1, 1, 1, 0)
_BY_RATIO = (0, 0, 7, 14, 22, 13, 18, 15, 10, 7, 4)
# Fig. 15: μ/k of the first ten, printed as α, in s/m.
_FACTORS = (0.0123, 0.0176, 0.0235, 0.0326, 0.0460, 0.0581, 0.0739, 0.0894, 0.0990, 0.1044)


def spring_items(solve: Solve) -> list[Item]:
    """fig14 to fig17, table4."""
    newton, ratio = spring_wall(), spring_wall()
    solve_as_paper(newton, Solver.PAPER_NEWTON, _TOLERANCE)
    solve_as_paper(ratio, Solver.PAPER_RATIO, _TOLERANCE)
    runs = solve([newton, ratio, spring_wall()])
    fig15 = _item("fig15", "force", "Contact force and equivalent external force", runs[0],
                  [f"{_CONTACT}.contact_force", f"{_CONTACT}.external_force"],
                  ["contact_force [N]", "external_force [N]"])
    fig15.numbers = _factors(runs)
    return [
        _item("fig14", "position", "Position of the ball", runs[0], ["ball.position"],
              ["position [m]"]),
        fig15,
        _item("fig16", "velocity", "Velocity of the ball", runs[0], ["ball.velocity"],
              ["velocity [m/s]"]),
        _item("fig17", "hysteresis", "Hysteresis loops: force against deformation", runs[0],
              [f"{_CONTACT}.deformation", f"{_CONTACT}.contact_force"],
              ["deformation [m]", "contact_force [N]"]),
        _table_4(runs)]


def _item(id_: str, preset: str, title: str, run: Result, columns: Sequence[str],
          headers: Sequence[str]) -> Item:
    figure = preset_figure(preset, run)
    figure.title = title
    _name(figure.panels[0].curves)
    return Item(id_, title, data=[samples(id_, columns, headers, [run]), _marks(id_, run)],
                figure=figure)


def _name(curves: Sequence[Curve]) -> None:
    """Names the curves in the key as the paper does, each mark once."""
    for mark, name in ((Mark.START, "start of a cycle"), (Mark.END, "end of a cycle")):
        first = next((curve for curve in curves if curve.mark is mark), None)
        if first is not None:
            first.label, first.keyed = name, True
    for curve in curves:
        if curve.mark is Mark.DASHED:
            curve.label = "equivalent external force"
        elif curve.label == _CONTACT:
            curve.label = "contact force"


def _marks(id_: str, run: Result) -> Data:
    """Where cycles start and end: the marks o and × of the paper."""
    columns = ["start_time [s]", "end_time [s]", "deformation_start [m]", "deformation_end [m]",
               "mu_over_k [s/m]"]
    return Data(f"{id_}_cycles", columns,
                [(c.start_time_s, c.end_time_s, c.delta_start_m, c.delta_end_m,
                  c.mu_over_k_s_per_m) for c in cycles_of(run, _CONTACT)])


def _factors(runs: Sequence[Result]) -> list[Number]:
    ours, exact = cycles_of(runs[0], _CONTACT), cycles_of(runs[2], _CONTACT)
    return [Number(f"μ/k of cycle {i + 1} [s/m]", printed, ours[i].mu / _STIFFNESS,
                   exact[i].mu / _STIFFNESS, 0.05 * printed,
                   "any μ within ξ = 0.5 % of ε counts as found; printed as α")
            for i, printed in enumerate(_FACTORS)]


def _table_4(runs: Sequence[Result]) -> Item:
    exact = cycles_of(runs[2], _CONTACT)
    creeps = "published count not reached; (31) creeps, so that little changes its count"
    numbers = []
    for rule, published, run, limit, why in (("(27) or (29)", _BY_NEWTON, runs[0], 0.0, ""),
                                             ("(27) or (31)", _BY_RATIO, runs[1], 3.0, creeps)):
        cycles = cycles_of(run, _CONTACT)
        numbers += [Number(f"{rule}, cycle {i + 1}", float(printed), float(cycles[i].iterations),
                           float(exact[i].iterations), limit,
                           "" if printed == cycles[i].iterations else why)
                    for i, printed in enumerate(published)]
    return Item("table4", "Corrections of μ for each of the first eleven cycles", numbers)
