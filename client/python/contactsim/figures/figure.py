"""What a figure shows, as plain values in SI units: panels with curves, marks, bands and labels."""

from __future__ import annotations

import csv
import dataclasses
import enum
import io
from typing import Iterable, Mapping, Sequence

import numpy as np

from ..errors import ContactError
from ..model import Array

#: Where a figure comes from: title, job, scenario_sha256, version, revision.
Source = Mapping[str, str]


#: Of bodies or contacts whose lines have colours of their own; of more the colour is the place.
MOST_ROWS = 12


class FigureError(ContactError, ValueError):
    """There is no such figure of these data; the text says why."""


class Mark(enum.Enum):
    """How the points of a curve are drawn."""

    LINE = enum.auto()
    DASHED = enum.auto()
    DOTTED = enum.auto()
    START = enum.auto()  #: A circle at each point: where cycles start.
    END = enum.auto()  #: A cross at each point: where cycles end.
    LINE_POINTS = enum.auto()  #: A circle at each point, joined by lines.
    POINTS = enum.auto()  #: A small dot at each point.
    RARE = enum.auto()  #: A tiny one: samples that are too rare to be joined.
    FAINT = enum.auto()  #: A thin grey line, for what is shown beside,
    FAINT_DOTS = enum.auto()  #: or a grey dot at each point.


class Kind(enum.Enum):
    """How the curves of a panel are drawn."""

    LINES = enum.auto()
    MAP = enum.auto()  #: Each as a row of colours, the first one lowest.
    WATERFALL = enum.auto()  #: Each on a line of its own, the first one lowest.


@dataclasses.dataclass
class Curve:
    """Points in the order in which they are joined; NaN breaks the line."""

    label: str  #: Its entry in the key, and its name in CSV.
    colour: int  #: Place in the palette; curves that belong together have one colour.
    x: Array  #: In the unit of the panel's `x_label`.
    y: Array  #: In the unit of the panel's `y_label`.
    mark: Mark = Mark.LINE
    keyed: bool = True  #: False if it has no entry in the key, as without a label.
    shade: float | None = None  #: Of many rows its place among them, from 0 to 1: it is its colour.
    loose: Sequence[tuple[float, float]] = ()  #: Spans of x whose points are too rare to be joined.

    @property
    def is_mark(self) -> bool:
        """True for circles and crosses on other curves."""
        return self.mark in (Mark.START, Mark.END)

    @property
    def is_faint(self) -> bool:
        """True for what is shown beside."""
        return self.mark in (Mark.FAINT, Mark.FAINT_DOTS)


@dataclasses.dataclass
class Range:
    """Between which values something was, over spans of x."""

    colour: int  #: As that of its curve.
    start: Array
    end: Array
    low: Array
    high: Array


@dataclasses.dataclass(frozen=True)
class Label:
    """A text above a point."""

    x: float
    y: float
    text: str


@dataclasses.dataclass
class Panel:
    """One pair of axes."""

    x_label: str  #: Quantity and unit, such as `time [s]`.
    y_label: str
    curves: list[Curve] = dataclasses.field(default_factory=list)
    kind: Kind = Kind.LINES  #: Others have curves over the same x, a row each.
    row_label: str = ""  #: What each row is.
    counted_x: bool = False  #: True if x are whole numbers, such as passes.
    x_words: dict[float, str] = dataclasses.field(default_factory=dict)  #: At ticks, for numbers.
    log_x: bool = False
    log_y: bool = False
    lowest_y: float | None = None  #: Lower end of the y axis; None: that of the points.
    by_span: bool = False  #: True if the largest curves are those that go furthest, not highest.
    dashed: str = ""  #: What dashed curves are, where the key cannot list them all.
    bands: list[tuple[float, float]] = dataclasses.field(default_factory=list)  #: Shades over x.
    band_label: str = ""
    cut: list[tuple[float, float]] = dataclasses.field(default_factory=list)  #: Hatched over x:
    #: what the end of the run cuts.
    ranges: list[Range] = dataclasses.field(default_factory=list)
    letter: str = ""  #: Such as (a), of one of several.
    stamp: str = ""  #: What the samples are too few for.
    labels: list[Label] = dataclasses.field(default_factory=list)
    dotted: list[float] = dataclasses.field(default_factory=list)  #: Values of y of dotted lines.


@dataclasses.dataclass
class Figure:
    """Panels below each other."""

    title: str
    panels: list[Panel]
    sources: Sequence[Source] = ()  #: The runs that it shows, for the caption.
    note: str = ""  #: What marks mean that are not in the key.
    most_colours: int = 10  #: Above it, keep_largest leaves curves out of the key.
    crowd: int = 0  #: Colours that it has left out.


def number_text(value: float) -> str:
    """The shortest text that is this number: `0.0001`, but `1e-05`, and `1e+05` for 100000."""
    if not np.isfinite(value):
        return "nan" if np.isnan(value) else "inf" if value > 0 else "-inf"
    mantissa, _, exponent = f"{float(value)!r}".partition("e")
    if exponent:
        fixed = np.format_float_positional(value, trim="-")
        short = f"{mantissa.removesuffix('.0')}e{int(exponent):+03d}"
    else:
        fixed = mantissa.removesuffix(".0")
        short = np.format_float_scientific(value, trim="-", exp_digits=2)
    return fixed if len(fixed) <= len(short) else short


def rows_csv(rows: Iterable[Iterable[str | float]]) -> str:
    """Rows as CSV, whose numbers are the shortest texts that are these numbers."""
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    for row in rows:
        writer.writerow([cell if isinstance(cell, str) else number_text(cell) for cell in row])
    return text.getvalue()


def points_csv(figure: Figure) -> str:
    """The points as CSV: for each panel the labels of its axes, then a row a point."""
    rows: list[Sequence[str | float]] = []
    for panel in figure.panels:
        rows.append(("curve", panel.x_label, panel.y_label))
        rows += [(curve.label, x, y) for curve in panel.curves
                 for x, y in zip(curve.x.tolist(), curve.y.tolist())]
    return rows_csv(rows)


def thin(points: int, figure: Figure) -> None:
    """Reduces each curve to about `points` points. Of each stretch it keeps the first, the last, the
    lowest and the highest, so that no peak is lost."""
    for curve in (curve for panel in figure.panels if panel.kind is Kind.LINES
                  for curve in panel.curves):
        if len(curve.x) <= points:
            continue
        edges = np.linspace(0, len(curve.x), max(points // 4, 1) + 1).astype(int)
        kept: set[int] = set()
        for begin, end in zip(edges, edges[1:]):
            stretch = curve.y[begin:end]
            kept |= {begin, begin + int(np.argmin(stretch)), begin + int(np.argmax(stretch)), end - 1}
        places = sorted(kept)
        curve.x, curve.y = curve.x[places], curve.y[places]


def keep_largest(figure: Figure) -> None:
    """Of a figure with more than `most_colours` leaves these to its largest curves: those with the
    largest |y|, or the widest span, beside the others of the last panel that they are in. All
    others become faint, and have no marks. Of more than MOST_ROWS each has the colour of its place."""
    sizes: dict[int, float] = {}
    for panel in figure.panels:
        if panel.kind is Kind.LINES:
            sizes |= _sizes(panel)
    ranked = sorted(sizes, key=lambda colour: (-sizes[colour], colour))
    if figure.crowd or len(ranked) <= figure.most_colours:
        return
    figure.crowd = len(ranked) - figure.most_colours
    if len(ranked) > MOST_ROWS:
        _shade(figure, {colour: place / (len(ranked) - 1) for place, colour in enumerate(sorted(ranked))})
    kept = {colour: place for place, colour in enumerate(sorted(ranked[:figure.most_colours]))}
    for panel in figure.panels:
        _fade(panel, kept)


def _sizes(panel: Panel) -> dict[int, float]:
    """The size of the largest curve of each colour, the largest of all being 1."""
    sizes: dict[int, float] = {}
    for curve in panel.curves:
        known = curve.y[~np.isnan(curve.y)]
        size = 0.0 if not len(known) else float(
            np.ptp(known) if panel.by_span else max(-known.min(), known.max()))
        sizes[curve.colour] = max(sizes.get(curve.colour, 0.0), size)
    largest = max(sizes.values(), default=0.0)
    return {colour: size / largest if largest > 0 else 0.0 for colour, size in sizes.items()}


def _shade(figure: Figure, shades: Mapping[int, float]) -> None:
    for curve in (curve for panel in figure.panels for curve in panel.curves):
        curve.shade = shades.get(curve.colour)


def _fade(panel: Panel, kept: Mapping[int, int]) -> None:
    lines = not all(curve.is_mark for curve in panel.curves)
    panel.curves = [curve for curve in panel.curves
                    if curve.colour in kept
                    or not ((curve.is_mark and lines) or curve.mark is Mark.DASHED)]
    panel.ranges = [each for each in panel.ranges if each.colour in kept]
    for each in panel.ranges:
        each.colour = kept[each.colour]
    for curve in panel.curves:
        if curve.colour in kept:
            curve.colour = kept[curve.colour]
        else:
            curve.mark = Mark.FAINT_DOTS if curve.is_mark else Mark.FAINT
            curve.keyed = False
