"""The page of all items of the paper."""

from __future__ import annotations

import dataclasses
import math
from typing import Mapping, Sequence

from ..html import Row, escape, page, table
from .items import Item

_READING = (
    "<p><b>Published</b> is what the paper prints. <b>By its process</b> is ours, computed as the "
    "paper says it did: Runge-Kutta with 1e-6 s, its updates of μ, its tolerance and its definition "
    "of the phases. <b>Converged</b> is ours by the default solver, to 1e-8. A deviation of process "
    "from print beyond the documented limit is marked.</p>\n")
_HEADERS = ("Number", "Published", "By its process", "Converged", "Deviation", "Limit", "Why")


@dataclasses.dataclass(frozen=True)
class Origin:
    """What made the items."""

    server: str  #: Its version and revision.
    solver: str  #: Options of the solver of the converged numbers, as JSON.
    command: str  #: The command that makes the page again.


def index_page(items: Sequence[Item], figures: Mapping[str, str], origin: Origin) -> str:
    """One HTML page with the numbers and figures of all items, links to their data, and how to make it
    again. It refers to no file but the data. `figures` has SVG elements by item."""
    verdicts = [Row((item.id, item.title, _verdict(item)), not item.holds) for item in items]
    body = _READING + table(("Item", "What it shows", "Verdict"), verdicts)
    if not figures:
        body += "<p>Figures were not drawn: matplotlib was not there. Their data are.</p>\n"
    body += "".join(_section(item, figures.get(item.id, "")) for item in items)
    body += (f"<h2>How to make this again</h2>\n<pre>{escape(origin.command)}</pre>\n<p>Made by "
             f"{escape(origin.server)}. Solver of the converged numbers: "
             f"<code>{escape(origin.solver)}</code></p>\n")
    return page("The paper's figures and tables, made again", body)


def _verdict(item: Item) -> str:
    compared = any(not math.isnan(number.limit) for number in item.numbers)
    return "shown" if not compared else "holds" if item.holds else "DIFFERS"


def _section(item: Item, figure: str) -> str:
    parts = [f'<h2 id="{item.id}">{item.id}: {escape(item.title)}</h2>\n',
             f"<figure>{figure}</figure>\n" if figure else "",
             f"<p>{escape(item.note)}</p>\n" if item.note else "",
             _numbers(item, bool(item.map and figure)) if item.numbers else ""]
    links = [f'<a href="{data.name}.csv">{data.name}.csv</a>, {len(data.rows)} rows'
             + (f" ({escape(data.note)})" if data.note else "") for data in item.data]
    return "".join(parts) + (f"<p>Data: {'; '.join(links)}.</p>\n" if links else "")


def _numbers(item: Item, drawn: bool) -> str:
    """Columns of which no number has anything are left out. What a map shows is folded."""
    cells = [(n.what, *n.texts, n.why) for n in item.numbers]
    used = [place for place in range(len(_HEADERS)) if any(row[place] for row in cells)]
    rows = table([_HEADERS[place] for place in used],
                 [Row([row[place] for place in used], not n.holds)
                  for row, n in zip(cells, item.numbers)])
    return f"<details><summary>{len(cells)} numbers</summary>\n{rows}</details>\n" if drawn else rows
