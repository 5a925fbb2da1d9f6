"""The part of a run that a figure shows, and the curves, marks and bands of that part."""

from __future__ import annotations

import dataclasses
import math
from typing import TYPE_CHECKING, Callable, Iterator, Sequence

import numpy as np
from contact.v1 import job_pb2

from ..model import Array, ContactLaw, contact_laws
from ..spelling import nearest
from .coarse import cut_spans, joined, loose, stamp
from .figure import Curve, FigureError, Mark, Panel

if TYPE_CHECKING:
    from ..result import Result

#: A number that the ledger tells of a cycle.
OfCycle = Callable[[job_pb2.Cycle], float]

# What the first servers did not record of bodies and supports, and all of the system.
_LATER = (".acceleration", ".support_force", ".support_energy")


@dataclasses.dataclass(frozen=True)
class Part:
    """By default all of a run."""

    contacts: Sequence[str] = ()  #: And so the bodies that they join; empty: all.
    start: float = -math.inf  #: Ends of the time window in s, included.
    end: float = math.inf


class Shown:
    """A run, or a part of it. Bodies and contacts have the colour of their place in the scenario."""

    def __init__(self, result: Result, part: Part = Part()) -> None:
        self.result = result
        self.part = part
        self.laws = contact_laws(result.scenario)
        self._loose: dict[str, list[tuple[float, float]]] = {}  # By contact.
        names = [law.name for law in self.laws]
        for name in part.contacts:
            if name not in names:
                raise FigureError(f"'{name}' is no contact of this job" + nearest(name, names))
        if not part.start < part.end:
            raise FigureError(f"--from {part.start:g} must be before --to {part.end:g}")

    @property
    def contacts(self) -> list[tuple[int, ContactLaw]]:
        """The contacts shown, each with its colour."""
        return [(place, law) for place, law in enumerate(self.laws)
                if not self.part.contacts or law.name in self.part.contacts]

    @property
    def bodies(self) -> list[tuple[int, str]]:
        """The bodies shown, each with its colour: all, or those of the contacts shown."""
        touching = {body for _, law in self.contacts for body in law.bodies}
        return [(place, body.name) for place, body in enumerate(self.result.scenario.bodies)
                if not self.part.contacts or body.name in touching]

    def column(self, name: str) -> Array:
        """The samples of a column, whatever the window."""
        if name not in self.result.arrays:
            new = name.startswith("system.") or name.endswith(_LATER)
            why = ("an older server made it, so run it again" if new and "time" in self.result.arrays
                   else "see output.ledger_only")
            raise FigureError(f"this run recorded no {name}; {why}")
        return self.result.arrays[name]

    def at(self, column: str, time: float) -> float:
        """The value of a column at a time, which may lie between two samples."""
        return interpolate(self.column("time"), self.column(column), time)

    def in_window(self, time: float) -> bool:
        """NaN is in no window."""
        return self.part.start <= time <= self.part.end

    def cycles(self, contact: str) -> Iterator[tuple[int, job_pb2.Cycle]]:
        """The cycles of a contact that overlap the window, with their places in the ledger, from 1."""
        for place, cycle in enumerate(self.result.job.cycles, 1):
            overlaps = (cycle.end_time_s >= self.part.start
                        and cycle.start_time_s <= self.part.end)
            if overlaps and cycle.contact == contact:
                yield place, cycle

    def over_time(self, label: str) -> Panel:
        """A panel over time without curves, with bands where a contact shown is within a cycle or a
        group."""
        names = {law.name for _, law in self.contacts}
        spans = [(max(span.start_time_s, self.part.start), min(span.end_time_s, self.part.end))
                 for spans in (self.result.job.groups, self.result.job.cycles) for span in spans
                 if span.contact in names]
        return Panel("time [s]", label, bands=joined(span for span in spans if span[0] < span[1]),
                     band_label="in contact", cut=cut_spans(self), stamp=stamp(self))

    def loose(self, contacts: Sequence[str]) -> list[tuple[float, float]]:
        """Where samples are too rare to show what these contacts do."""
        for contact in contacts:
            if contact not in self._loose:
                self._loose[contact] = loose(self, contact)
        return joined(span for contact in contacts for span in self._loose[contact])

    def curve(self, values: Array, label: str, colour: int, mark: Mark = Mark.LINE,
              contacts: Sequence[str] | None = None) -> Curve:
        """The part of a curve over time that is in the window, which cuts it where it ends.
        `contacts`: those that it depends on; None: all that are shown."""
        time = self.column("time")
        begin = int(np.searchsorted(time, self.part.start, "left"))
        end = int(np.searchsorted(time, self.part.end, "right"))
        x, y = time[begin:end], values[begin:end]
        if 0 < begin < len(time) and time[begin] > self.part.start:
            x = np.insert(x, 0, self.part.start)
            y = np.insert(y, 0, interpolate(time, values, self.part.start))
        if 0 < end < len(time) and time[end - 1] < self.part.end:
            x = np.append(x, self.part.end)
            y = np.append(y, interpolate(time, values, self.part.end))
        names = [law.name for _, law in self.contacts] if contacts is None else contacts
        return Curve(label, colour, x, y, mark, loose=self.loose(names))

    def marks(self, contact: str, name: str, colour: int, at_start: OfCycle,
              at_end: OfCycle) -> list[Curve]:
        """Marks where the cycles of a contact start and end, at these heights."""
        ends: list[tuple[str, Mark, list[tuple[float, float]]]] = [
            (f"{name} starts", Mark.START, []), (f"{name} ends", Mark.END, [])]
        for _, cycle in self.cycles(contact):
            for (_, _, points), time, value in zip(ends, (cycle.start_time_s, cycle.end_time_s),
                                                   (at_start, at_end)):
                if self.in_window(time):
                    points.append((time, value(cycle)))
        return [Curve(label, colour, np.array([x for x, _ in points]),
                      np.array([y for _, y in points]), mark, False, loose=self.loose([contact]))
                for label, mark, points in ends if points]


def interpolate(xs: Array, ys: Array, x: float) -> float:
    """y at x between samples."""
    i = int(np.searchsorted(xs, x, "left"))
    if i in (0, len(xs)):
        return float(ys[min(i, len(ys) - 1)])
    part = (x - xs[i - 1]) / (xs[i] - xs[i - 1])
    return float(ys[i - 1] + part * (ys[i] - ys[i - 1]))
