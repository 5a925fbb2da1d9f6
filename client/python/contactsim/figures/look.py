"""How a figure looks: size, font, colours, dashes."""

from __future__ import annotations

import dataclasses
import re
from typing import Any, Sequence

from .figure import Curve, FigureError, Mark
from .words import WORDS

BY_PLACE = "viridis"  #: Colours of rows by their place, from 0 to 0.9: the rest is too light.
_INCHES = {None: 1.0, "in": 1.0, "cm": 1 / 2.54, "mm": 1 / 25.4}
_WIDTH = 8.0
_STEEPER = 1.2  # Figures a column wide are higher for their width, so that there is space for texts.
_POINTS = 9.0
_SERIF = ("Times New Roman", "Nimbus Roman", "Liberation Serif", "DejaVu Serif")
_SANS = ("Arial", "Liberation Sans", "Nimbus Sans", "DejaVu Sans")

#: Of a style for print: the width of a column in inches, its fonts, the first one that is there, and
#: their size. Those of publishers are what these ask of figures: columns of 84 mm (Springer), 90 mm
#: (Elsevier), 3.5 in (IEEE) and 8.6 cm (APS), and letters of 7 or 8 points.
PRINT: dict[str, tuple[float, tuple[str, ...], float]] = {
    "paper": (3.4, _SERIF, 8.0), "springer": (84 / 25.4, _SANS, 8.0),
    "elsevier": (90 / 25.4, _SANS, 7.0), "ieee": (3.5, _SERIF, 8.0), "aps": (8.6 / 2.54, _SERIF, 8.0)}


@dataclasses.dataclass(frozen=True)
class Look:
    """How a figure is to look; by default for a screen."""

    size: tuple[float, float] | None = None  #: Width and height in inches.
    family: str = ""  #: Of the font of all texts; empty: that of the style.
    points: float = 0.0  #: Size of the font in 1/72 in; 0: that of the style.
    style: str = "colour"  #: Or one of PRINT: black curves that dashes tell apart, a column wide.
    title: bool = True
    provenance: bool = True  #: The line that says where the figure comes from.
    units: Sequence[str] = ()  #: Units that the axes are to have; others read best.

    @property
    def paper(self) -> bool:
        """True for print."""
        return self.style in PRINT

    @property
    def rc(self) -> dict[str, Any]:
        """The settings of matplotlib."""
        _, fonts, usual = PRINT.get(self.style, (_WIDTH, (), _POINTS))
        points = self.points or usual
        families = [self.family, *fonts] if self.family else [*fonts]
        return {"font.size": points, "font.family": [*families, "DejaVu Sans"],
                "axes.titlesize": points, "figure.titlesize": 1.2 * points,
                "axes.grid": not self.paper, "grid.color": "#dddddd", "grid.linewidth": 0.6,
                "axes.linewidth": 0.6 if self.paper else 0.8, "axes.axisbelow": True,
                "legend.frameon": False, "legend.fontsize": 0.9 * points,
                "lines.markersize": 3.5 if self.paper else 5.0,
                "xtick.direction": "in", "ytick.direction": "in", "xtick.top": True,
                "ytick.right": True, "svg.fonttype": "none", "svg.hashsalt": "contactsim",
                "pdf.fonttype": 42, "ps.fonttype": 42, "pgf.rcfonts": False, "path.simplify": True,
                "axes.unicode_minus": True, "figure.dpi": 100}

    def inches(self, panels: int) -> tuple[float, float]:
        """The size of a figure with so many panels."""
        if self.size:
            return self.size
        height = 3.5 * panels if panels > 1 else 5.0
        width = PRINT[self.style][0] if self.paper else _WIDTH
        return (width, height * width / _WIDTH * _STEEPER) if self.paper else (width, height)

    def line(self, curve: Curve) -> dict[str, Any]:
        """Colour, dashes and marker of a curve, for Axes.plot."""
        if curve.is_faint:
            dots = curve.mark is Mark.FAINT_DOTS
            return {"color": self.shade_of(curve) or WORDS["faint"], "linewidth": 0.5, "linestyle": "" if dots else "-",
                    "marker": "." if dots else "", "markersize": 3.0, "zorder": 1.5}
        shade = self.shade_of(curve)
        ink, dashes = (shade, []) if shade else self._pen(curve)
        style: dict[str, Any] = {"color": ink, "linewidth": 1.0 if self.paper else 1.3}
        if curve.mark is Mark.RARE:
            return style | {"linestyle": "", "marker": ".", "markersize": 2.0, "markeredgewidth": 0.0}
        if curve.mark in (Mark.START, Mark.END, Mark.POINTS):
            marker = {Mark.START: "o", Mark.END: "x", Mark.POINTS: "."}[curve.mark]
            return style | {"linestyle": "", "marker": marker, "fillstyle": "none"}
        if curve.mark is Mark.LINE_POINTS:
            style |= {"marker": "o", "fillstyle": "none"}
        if curve.mark is Mark.DASHED:
            beside = WORDS["paper_dashes"][1:]  # Without colours each has its own.
            own = beside[curve.colour % len(beside)] if self.paper else (4, 2)
            return style | {"dashes": own, "linewidth": 0.8}
        if curve.mark is Mark.DOTTED:
            return style | {"dashes": (1, 1.5)}
        return style | ({"dashes": dashes} if dashes else {})

    def shade_of(self, curve: Curve) -> str | None:
        """The colour of one of many rows by its place, as a waterfall has it; not in print."""
        if curve.shade is None or self.paper:
            return None
        import matplotlib  # Only who draws needs it.
        from matplotlib.colors import to_hex

        return str(to_hex(matplotlib.colormaps[BY_PLACE](0.9 * curve.shade)))

    def _pen(self, curve: Curve) -> tuple[str, Sequence[float]]:
        """Colours come again with other dashes; on paper dashes come again in grey."""
        if not self.paper:
            turn, place = divmod(curve.colour, len(WORDS["palette"]))
            return WORDS["palette"][place], WORDS["dashes"][turn % len(WORDS["dashes"])]
        turn, place = divmod(curve.colour, len(WORDS["paper_dashes"]))
        inks = WORDS["paper_inks"]
        # What is dashed beside a curve must not look like another curve.
        ink = inks[-1] if curve.mark is Mark.DASHED else inks[turn % len(inks)]
        return ink, WORDS["paper_dashes"][place]


def parse_size(text: str) -> tuple[float, float]:
    """A size such as `85x60mm`, `8.5x6cm` or, in inches, `3.4x2.5`."""
    found = re.fullmatch(r"(\d{1,4}(?:\.\d{1,6})?)x(\d{1,4}(?:\.\d{1,6})?)(in|cm|mm)?", text)
    if not found:
        raise FigureError(f"--size {text}: must be a width and a height, such as 85x60mm or "
                          "3.4x2.5in")
    width, height = (float(part) * _INCHES[found[3]] for part in found.groups()[:2])
    if not (1 <= width <= 100 and 1 <= height <= 100):
        raise FigureError(f"--size {text}: must be from 1 to 100 inches")
    return width, height


def parse_font(text: str) -> tuple[str, float]:
    """A font such as `Times,9`, `Times` or `9`: its family and size."""
    found = re.fullmatch(r"([A-Za-z][A-Za-z0-9 _-]*)?(?:,?(\d{1,2}(?:\.\d{1,3})?))?", text)
    if not text or not found:
        raise FigureError(f"--font {text}: must be a font, such as Times,9 or Times or 9")
    points = float(found[2] or 0)
    if found[2] and points < 2:
        raise FigureError(f"--font {text}: a size is at least 2 points")
    return found[1] or "", points
