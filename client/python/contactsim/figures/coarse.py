"""What samples are too rare to show: contacts between two samples, and motion of which there are only
points. The ledger has the extremes of every contact, however rare the samples are."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Callable, Iterable

import numpy as np
from contact.v1 import job_pb2

from ..model import Array
from .figure import Range
from .words import WORDS

if TYPE_CHECKING:
    from .shown import Shown

#: A cycle, or a time from one to the next, with fewer samples has no visible shape.
FEW_SAMPLES: int = WORDS["coarse"]["few"]

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
