"""Figures of a page that are zoomed and tell their values: living.js does it there."""

from __future__ import annotations

import html
import json
import pathlib
import re
from typing import TYPE_CHECKING, Any, Sequence

import matplotlib

from .draw import drawn
from .figure import Figure, Kind, Panel, keep_largest
from .files import drawing, inline, page_file
from .look import Look

if TYPE_CHECKING:
    from matplotlib.axes import Axes

#: What a page with such figures has once, at its end.
SCRIPT = f"<script>\n{pathlib.Path(__file__).with_name('living.js').read_text('utf-8')}</script>\n"
_STAYS = "living-label"  # What is not zoomed.


def living(figure: Figure, name: str) -> str:
    """A figure as an element of an HTML page. `name` begins the names in it, which a page has once."""
    keep_largest(figure)
    look = Look()
    with drawing(look):
        page = drawn(figure, look)
        axes = page.axes[:len(figure.panels)]
        labels = _mark(axes)
        svg = inline(page_file(page, "svg", figure.title, figure.sources), name)
        told = [_told(ax, panel) for ax, panel in zip(axes, figure.panels)]
    svg = re.sub(r'id="[^"]*-living-curve-(\d+)"',
                 lambda found: f'data-name="{html.escape(labels[int(found[1])])}"', svg)
    svg = re.sub(rf'id="[^"]*-{_STAYS}"', 'class="label"', svg)
    svg = re.sub(r'id="[^"]*-[xy]tick_\d+"', 'class="tick"', svg)
    return f'<figure data-axes="{html.escape(json.dumps(told))}">{svg}</figure>\n'


def _mark(axes: Sequence[Axes]) -> list[str]:
    """Gives numbers to curves with a name, which it returns in their order."""
    labels: list[str] = []
    for ax in axes:
        for line in ax.lines:
            if not line.get_label().startswith("_"):
                line.set_gid(f"living-curve-{len(labels)}")
                labels.append(line.get_label())
        for text in ax.texts:
            text.set_gid(_STAYS)
    return labels


def _told(ax: Axes, panel: Panel) -> dict[str, Any]:
    """What living.js reads of a pair of axes that is drawn."""
    width, height = (72 * inches for inches in ax.figure.get_size_inches())
    place = ax.get_position()
    box = (place.x0 * width, (1 - place.y1) * height, place.width * width, place.height * height)
    rows = 0 if panel.kind is Kind.LINES else 1  # They count from 1.
    return {"box": [round(value, 3) for value in box], "x": _scale(ax.xaxis, 0), "y": _scale(ax.yaxis, rows),
            "names": [re.sub(r"\$_\\mathrm\{(\w)\}\$", r"_\1", label)
                      for label in (ax.get_xlabel(), ax.get_ylabel())],
            "size": matplotlib.rcParams["font.size"]}


def _scale(axis: Any, first: int) -> list[float]:
    """From where to where an axis goes in the numbers that it shows, and 1 if it is logarithmic."""
    size = getattr(axis.get_major_formatter(), "size", 1.0)
    return [*(float(end) / size + first for end in axis.get_view_interval()),
            int(axis.get_scale() == "log")]
