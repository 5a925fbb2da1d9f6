"""HTML of pages that need nothing but themselves."""

from __future__ import annotations

import dataclasses
import html
from typing import Sequence

from .figures.sources import printable

_STYLE = (
    "body{font:15px/1.45 system-ui,sans-serif;max-width:72rem;margin:2rem auto;padding:0 1rem;"
    "color:#1a1a1a;background:#fff}"
    "h1{font-size:1.6rem}h2{font-size:1.2rem;margin-top:2.2rem}"
    "table{border-collapse:collapse;display:block;overflow-x:auto;font-variant-numeric:tabular-nums;"
    "font-size:.82rem;margin:.8rem 0}"
    "th,td{padding:.2rem .35rem;text-align:left;border-bottom:1px solid #ddd;vertical-align:top}"
    "th{vertical-align:bottom}.n{text-align:right}td.n{white-space:nowrap}tr.d{background:#fde7d9}"
    "svg{max-width:100%;height:auto}"
    "pre{background:#f5f5f5;padding:.7rem;overflow-x:auto;font-size:.82rem}"
    "figure{margin:1rem 0}")


@dataclasses.dataclass(frozen=True)
class Row:
    """Cells of a table; marked if they differ from what they should be."""

    cells: Sequence[str]
    differs: bool = False


def escape(text: str) -> str:
    """A text of a user, without what steers a terminal."""
    return html.escape(printable(text, "\n"))


def table(headers: Sequence[str], rows: Sequence[Row]) -> str:
    """A table whose columns are aligned as most of their cells are."""
    numbers = [_holds_numbers([row.cells[place] for row in rows]) for place in range(len(headers))]

    def line(cells: Sequence[str], element: str, mark: str = "") -> str:
        kinds = [' class="n"' if number else "" for number in numbers]
        parts = (f"<{element}{kind}>{escape(cell)}</{element}>" for cell, kind in zip(cells, kinds))
        return f"<tr{mark}>{''.join(parts)}</tr>\n"
    body = "".join(line(row.cells, "td", ' class="d"' if row.differs else "") for row in rows)
    return f"<table>\n{line(headers, 'th')}{body}</table>\n"


def page(title: str, body: str) -> str:
    """A whole page."""
    name = escape(title)
    return ('<!DOCTYPE html>\n<html lang="en">\n<head>\n<meta charset="utf-8">\n'
            f'<meta name="viewport" content="width=device-width">\n<title>{name}</title>\n'
            f"<style>{_STYLE}</style>\n</head>\n<body>\n<h1>{name}</h1>\n{body}</body>\n</html>\n")


def _holds_numbers(cells: Sequence[str]) -> bool:
    told = [cell[0] in "0123456789+-" for cell in cells if cell]
    return 2 * sum(told) > len(told)
