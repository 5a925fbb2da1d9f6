"""What samples are too rare to show: contacts between two samples, and motion of which there are only
points. The ledger has the extremes of every contact, however rare the samples are."""

from __future__ import annotations

import dataclasses
import math
from typing import TYPE_CHECKING, Any, Callable, Iterable

import numpy as np
from contact.v1 import job_pb2

from ..model import Array
from .figure import Curve, Mark, Panel, Range
from .words import WORDS

if TYPE_CHECKING:
    from .shown import Shown

#: A cycle, or a time from one to the next, with fewer samples has no visible shape.
FEW_SAMPLES: int = WORDS["coarse"]["few"]

#: A curve swings if it goes up and down by more than so many times its range: of a swing that is seen
#: too rarely, dots would be a slow one that never was. A drift, such as of dissipated energy, goes 1 times.
_SWING = 1.5

#: Of a cycle, the smallest and the largest value that the ledger tells.
Extremes = tuple[float, float]


def samples_in(cycle: job_pb2.Cycle, time: Array) -> int:
    """The number of samples within a cycle."""
    return int(np.searchsorted(time, cycle.end_time_s, "right")
               - np.searchsorted(time, cycle.start_time_s, "left"))


def coarse_cycles(cycles: Iterable[job_pb2.Cycle], time: Array) -> list[job_pb2.Cycle]:
    """Those with too few samples; one that the end of the run cuts may have any number."""
    return [cycle for cycle in cycles
            if cycle.end != job_pb2.Cycle.RUN_END and samples_in(cycle, time) < FEW_SAMPLES]


def stamp(run: Shown) -> str:
    """How many of the cycles shown have too few samples; empty if all have enough."""
    if "time" not in run.result.arrays:
        return ""
    cycles = [cycle for _, law in run.contacts for _, cycle in run.cycles(law.name)]
    coarse = len(coarse_cycles(cycles, run.column("time")))
    have = "contact has" if len(cycles) == 1 else "contacts have"
    return f"{coarse} of {len(cycles)} {have} fewer than {FEW_SAMPLES} samples" if coarse else ""


def loose(run: Shown, contact: str) -> list[tuple[float, float]]:
    """Where there are fewer than FEW_SAMPLES samples from one cycle of a contact to the next, again
    and again: lines from sample to sample would show a motion that never was."""
    starts = np.array([cycle.start_time_s for _, cycle in run.cycles(contact)])
    rare = np.diff(np.searchsorted(run.column("time"), starts)) < FEW_SAMPLES
    again = np.flatnonzero(rare[1:] & rare[:-1])
    return joined((float(starts[i]), float(starts[i + 2])) for i in again)


def ranges(run: Shown, contact: str, colour: int,
           extremes: Callable[[job_pb2.Cycle], Extremes]) -> list[Range]:
    """What the ledger tells of the cycles of a contact that have too few samples."""
    cycles = coarse_cycles((cycle for _, cycle in run.cycles(contact)), run.column("time"))
    rows = [(max(cycle.start_time_s, run.part.start), min(cycle.end_time_s, run.part.end),
             *extremes(cycle)) for cycle in cycles]
    table = np.array([row for row in rows if math.isfinite(sum(row[2:]))]).reshape(-1, 4)
    return [Range(colour, *table.T)] if len(table) else []


def joined(spans: Iterable[tuple[float, float]]) -> list[tuple[float, float]]:
    """Those that touch or overlap as one, so that no shade lies over another."""
    whole: list[tuple[float, float]] = []
    for start, end in sorted(spans):
        if whole and start <= whole[-1][1]:
            whole[-1] = whole[-1][0], max(whole[-1][1], end)
        else:
            whole.append((start, end))
    return whole


def cut_spans(run: Shown) -> list[tuple[float, float]]:
    """Where the end of the run cuts cycles of contacts shown, whose peaks may be still to come."""
    return joined((max(cycle.start_time_s, run.part.start), min(cycle.end_time_s, run.part.end))
                  for _, law in run.contacts for _, cycle in run.cycles(law.name)
                  if cycle.status in (job_pb2.Cycle.CUT, job_pb2.Cycle.UNFINISHED))


def parted(curve: Curve) -> list[Curve]:
    """The line without the spans in which its points are too rare, and these points unless they swing.
    What is dashed goes with another line, and has none; nor have cycles a mark there."""
    rare, dotted = np.zeros(len(curve.x), bool), np.zeros(len(curve.x), bool)
    for within in _loose_points(curve):
        rare |= within
        if curve.is_faint or not _swings(curve.y[within]):
            dotted |= within
    if not rare.any():
        return [curve]
    if curve.is_mark:
        return [dataclasses.replace(curve, x=curve.x[~rare], y=curve.y[~rare], loose=())]
    line = dataclasses.replace(curve, y=np.where(rare, np.nan, curve.y), loose=())
    if curve.mark is Mark.DASHED or not dotted.any():
        return [line]
    mark = Mark.FAINT_DOTS if curve.is_faint else Mark.RARE
    dots = dataclasses.replace(curve, x=curve.x[dotted], y=curve.y[dotted], mark=mark, keyed=False,
                               loose=())
    return [line, dots]


def spread(panel: Panel) -> list[Range]:
    """Between which values the points of each curve are that swings where they are too rare, unless the
    ledger tells it of each cycle."""
    told = {each.colour for each in panel.ranges}
    spans = [(curve.colour, *ends, curve.y[within]) for curve in panel.curves
             if not (curve.is_mark or curve.is_faint or curve.mark is Mark.DASHED or curve.colour in told)
             for ends, within in zip(curve.loose, _loose_points(curve)) if _swings(curve.y[within])]
    return [Range(colour, *(np.array([end]) for end in (start, stop, np.nanmin(y), np.nanmax(y))))
            for colour, start, stop, y in spans]


def _loose_points(curve: Curve) -> list[np.ndarray[Any, np.dtype[np.bool_]]]:
    return [(curve.x >= start) & (curve.x <= end) for start, end in curve.loose]


def _swings(y: Array) -> bool:
    known = y[np.isfinite(y)]
    return len(known) > 2 and bool(np.abs(np.diff(known)).sum() > _SWING * np.ptp(known))
