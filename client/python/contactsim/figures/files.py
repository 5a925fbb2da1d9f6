"""Figures as files, each of which says where the figure comes from."""

from __future__ import annotations

import contextlib
import io
import logging
import os
import pathlib
import re
from typing import Any, Iterator, Sequence, Union

import matplotlib

from . import characters, pgf
from .draw import drawn
from .figure import Figure, FigureError, Kind, Source, keep_largest, points_csv
from .look import Look
from .sources import lines, printable

PathLike = Union[str, "os.PathLike[str]"]

#: Formats of figures by the endings of their files.
FORMATS = {".svg": "svg", ".png": "png", ".pdf": "pdf", ".eps": "eps", ".pgf": "pgf",
           ".txt": "txt", ".csv": "csv"}
_PIXELS = 200  # Of png, in an inch.


def format_of(path: PathLike) -> str:
    """The format that the ending of a file tells; svg without ending."""
    ending = pathlib.Path(path).suffix.lower()
    if ending and ending not in FORMATS:
        raise FigureError(f"{os.fspath(path)}: a figure is drawn as {', '.join(FORMATS)}")
    return FORMATS.get(ending, "svg")


def save(figure: Figure, path: PathLike, form: str = "", look: Look = Look(),
         columns: int = 80) -> None:
    """Draws a figure to a file in a format, by default that of the ending."""
    form = form or format_of(path)
    if form == "csv":
        data = points_csv(figure).encode()
    else:
        data = (characters.text(figure, columns, look).encode() if form == "txt" else
                rendered(figure, form, look))
    pathlib.Path(path).write_bytes(data)


def rendered(figure: Figure, form: str, look: Look = Look()) -> bytes:
    """The file of a figure that matplotlib draws."""
    if form == "pgf" and any(panel.kind is Kind.MAP for panel in figure.panels):
        raise FigureError("pgf has no bitmaps; a map is drawn as svg, png, pdf or eps")
    keep_largest(figure)
    with drawing(look):
        return page_file(drawn(figure, look), form, figure.title, figure.sources)


@contextlib.contextmanager
def drawing(look: Look) -> Iterator[None]:
    """Matplotlib with its own settings but for those of the look, and without words about fonts that
    are not here: a viewer of the file may have them."""
    fonts = logging.getLogger("matplotlib.font_manager")
    level = fonts.level
    fonts.setLevel(logging.ERROR)
    try:
        with matplotlib.rc_context({**matplotlib.rcParamsDefault, **look.rc, "backend": "agg"}):
            yield
    finally:
        fonts.setLevel(level)


def page_file(page: Any, form: str, title: str, sources: Sequence[Source]) -> bytes:
    """The file of a page of matplotlib, which tells title and sources and no time."""
    buffer = io.BytesIO()
    told, name = lines(sources), printable(title)
    if form == "pgf":
        return (lines(sources, "% ") + pgf.text(page)).encode()
    metadata = {"svg": {"Title": name, "Description": told.rstrip(), "Date": None, "Creator": None},
                "png": {"Title": name, "Description": told, "Software": None},
                "pdf": {"Title": name, "Subject": told, "CreationDate": None},
                "eps": {"Creator": "contactsim"}}[form]
    page.savefig(buffer, format=form, dpi=_PIXELS if form == "png" else None, metadata=metadata)
    data = buffer.getvalue()
    return _stamped_eps(data, name, lines(sources, "% ")) if form == "eps" else data


def inline(svg: bytes, name: str) -> str:
    """The file of a figure as an element of an HTML page, which refers to no other file. `name` begins
    the names in it, which a page has once."""
    text = svg.decode()
    text = re.sub(r"<metadata>.*?</metadata>\s*|<title>.*?</title>\s*", "", text[text.index("<svg"):],
                  flags=re.DOTALL)
    text = re.sub(r'\sxmlns(:xlink)?="[^"]*"', "", text)  # HTML knows both.
    return re.sub(r'(\bid="|url\(#|href="#)', rf"\g<1>{name}-", text)


def _stamped_eps(data: bytes, title: str, told: str) -> bytes:
    text = re.sub(rb"%%CreationDate:[^\n]*\n", b"", data)
    text = re.sub(rb"%%Title:[^\n]*\n", lambda _: f"%%Title: {title}\n".encode(), text, count=1)
    return text.replace(b"%%EndComments\n", b"%%EndComments\n" + told.encode(), 1)
