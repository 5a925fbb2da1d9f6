"""A figure or table of the paper, made again: its numbers beside those of the paper, its data."""

from __future__ import annotations

import dataclasses
import json
import math
import pathlib
from typing import Any, Sequence

from contact.v1 import job_pb2

from ..figures.figure import Figure, rows_csv
from ..figures.sweeps import HeatMap
from ..result import Result

NONE = math.nan  #: A number that the paper does not print, or that is not compared.


@dataclasses.dataclass(frozen=True)
class Number:
    """A number of the paper beside ours, all in the same unit."""

    what: str  #: What the number is, with its unit.
    published: float = NONE  #: As printed.
    process: float = NONE  #: Ours by the published process and definition.
    converged: float = NONE  #: Ours by the default solver, to its tolerance.
    limit: float = NONE  #: Documented |process − published|; NaN: not compared.
    why: str = ""  #: Why they differ, in a line.

    @property
    def deviation(self) -> float:
        """process − published."""
        return self.process - self.published

    @property
    def holds(self) -> bool:
        """True if the deviation is within the limit, or nothing is compared."""
        return math.isnan(self.limit) or abs(self.deviation) <= self.limit * (1 + 1e-12)

    @property
    def texts(self) -> tuple[str, str, str, str, str]:
        """Published, process, converged, deviation and limit in few digits; empty for none."""
        compared = not math.isnan(self.limit)
        short = ["" if math.isnan(value) else f"{value:.5g}"
                 for value in (self.published, self.process, self.converged)]
        return (*short, f"{self.deviation:+.1e}" if compared else "",  # type: ignore[return-value]
                f"{self.limit:.1g}" if compared else "")


@dataclasses.dataclass(frozen=True)
class Data:
    """Columns of numbers, which become a CSV file."""

    name: str  #: Of the file, without its ending.
    columns: Sequence[str]  #: Names with units, such as `force [N]`.
    rows: Sequence[Sequence[float]]
    note: str = ""  #: What the rows are, where the columns do not tell.


@dataclasses.dataclass
class Item:
    """A figure or table."""

    id: str  #: Such as `fig12`.
    title: str  #: What it shows.
    numbers: Sequence[Number] = ()
    data: Sequence[Data] = ()  #: What its curves or cells are drawn from.
    figure: Figure | None = None  #: None for tables.
    map: HeatMap | None = None  #: Of a table whose numbers are a map.
    note: str = ""  #: What a reader should know of all its numbers, as a sentence.

    @property
    def holds(self) -> bool:
        """True if all its numbers hold."""
        return all(number.holds for number in self.numbers)

    def write(self, folder: pathlib.Path) -> None:
        """Its data as CSV, its numbers as ID.txt and ID.json."""
        for data in self.data:
            (folder / f"{data.name}.csv").write_text(rows_csv([data.columns, *data.rows]), "utf-8")
        if self.numbers:
            note = f"\n{self.note}\n" if self.note else ""
            (folder / f"{self.id}.txt").write_text(f"{self.title}\n\n{table([self])}{note}", "utf-8")
            (folder / f"{self.id}.json").write_text(self._json(), "utf-8")

    def _json(self) -> str:
        """NaN, which JSON lacks, is null."""
        def known(value: float) -> float | None:
            return None if math.isnan(value) else float(value)
        content: dict[str, Any] = {"id": self.id, "title": self.title, "holds": self.holds}
        if self.note:
            content["note"] = self.note
        content["numbers"] = [
            {"what": n.what, "published": known(n.published), "process": known(n.process),
             "deviation": known(n.deviation), "documented_deviation": known(n.limit),
             "converged": known(n.converged), "holds": n.holds, "why": n.why}
            for n in self.numbers]
        return json.dumps(content, indent=2, ensure_ascii=False) + "\n"


def table(items: Sequence[Item]) -> str:
    """The numbers of items as text."""
    rows = [("ITEM", "NUMBER", "PUBLISHED", "PROCESS", "DEVIATION", "LIMIT", "", "CONVERGED", "WHY")]
    for item in items:
        for n in item.numbers:
            published, process, converged, deviation, limit = n.texts
            verdict = "" if math.isnan(n.limit) else "ok" if n.holds else "DIFFERS"
            rows.append((item.id, n.what, published, process, deviation, limit, verdict, converged,
                         n.why))
    widths = [max(map(len, column)) for column in zip(*rows)]
    left = (0, 1, 6, 8)
    lines = ["  ".join(cell.ljust(width) if place in left else cell.rjust(width)
                       for place, (cell, width) in enumerate(zip(row, widths))) for row in rows]
    return "".join(f"{line.rstrip()}\n" for line in lines)


def summary(items: Sequence[Item]) -> str:
    """The numbers of all items as one table with their notes below; empty if there are none."""
    if not any(item.numbers for item in items):
        return ""
    return table(items) + "".join(f"\n{item.id}: {item.note}\n" for item in items if item.note)


def cycles_of(run: Result, contact: str) -> list[job_pb2.Cycle]:
    """The cycles of a contact, in order."""
    return [cycle for cycle in run.job.cycles if cycle.contact == contact]


def samples(name: str, columns: Sequence[str], headers: Sequence[str], runs: Sequence[Result],
            note: str = "") -> Data:
    """The samples of runs, one run after the other: the number of the run from 0, if there are several,
    the time, then these columns below these headers."""
    rows = [[*([float(place)] if len(runs) > 1 else []), *values]
            for place, run in enumerate(runs)
            for values in zip(*(run[column].tolist() for column in ("time", *columns)))]
    return Data(name, [*(["run"] if len(runs) > 1 else []), "time [s]", *headers], rows, note)
