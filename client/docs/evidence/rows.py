"""What a row of the evidence is: a number that contactd computes, beside one that it did not make."""

from __future__ import annotations

import dataclasses
from typing import Callable, Sequence, Union

Value = Union[float, Sequence[float]]

#: Every row, in the order of the table.
ROWS: list[Row] = []


@dataclasses.dataclass(frozen=True)
class Row:
    """A claim and how it is computed.

    `compute` takes the Laboratory and returns ours and theirs: a number each, or as many of both.
    """

    key: str  #: Name on the command line.
    group: str  #: Heading of the table under which the row stands.
    what: str  #: What is compared, with its unit.
    source: str  #: Where theirs comes from.
    tolerance: float  #: Largest difference allowed.
    compute: Callable[..., tuple[Value, Value]]
    each: bool = False  #: True: every number relative to its own; else to the largest of theirs.
    slow: bool = False  #: True: left out by --fast.
    needs: str = ""  #: A program that may be missing, as in tests: then the row is left out.


@dataclasses.dataclass(frozen=True)
class Measured:
    """What became of a row."""

    row: Row
    ours: float
    theirs: float
    difference: float

    @property
    def holds(self) -> bool:
        """False for NaN, too."""
        return self.difference <= self.row.tolerance


def row(key: str, group: str, what: str, source: str, tolerance: float, *, each: bool = False,
        slow: bool = False, needs: str = "") -> Callable[[Callable[..., tuple[Value, Value]]],
                                        Callable[..., tuple[Value, Value]]]:
    """Enters a function into ROWS."""
    def enter(compute: Callable[..., tuple[Value, Value]]) -> Callable[..., tuple[Value, Value]]:
        if any(known.key == key for known in ROWS):
            raise ValueError(f"two rows are called {key}")
        ROWS.append(Row(key, group, what, source, tolerance, compute, each, slow, needs))
        return compute
    return enter


def measure(claim: Row, laboratory: object) -> Measured:
    """Computes a row. Of several numbers it keeps the one that differs most."""
    ours, theirs = (listed(value) for value in claim.compute(laboratory))
    if len(ours) != len(theirs):
        raise ValueError(f"{claim.key}: {len(ours)} numbers of ours, {len(theirs)} of theirs")
    largest = max(map(abs, theirs))
    scales = [abs(value) if claim.each else largest for value in theirs]
    differences = [abs(our - their) / (scale or 1.0)
                   for our, their, scale in zip(ours, theirs, scales)]
    unknown = [place for place, value in enumerate(differences) if value != value]
    worst = unknown[0] if unknown else differences.index(max(differences))
    return Measured(claim, ours[worst], theirs[worst], differences[worst])


def listed(value: Value) -> list[float]:
    """The numbers of a value."""
    return [float(number) for number in value] if hasattr(value, "__len__") else [float(value)]
