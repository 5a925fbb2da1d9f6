"""Makes items of the paper, and a folder with all that they have."""

from __future__ import annotations

import json
import os
import pathlib
from typing import TYPE_CHECKING, Callable, Iterable, Sequence, Union

from contact.v1.scenario_pb2 import Scenario

from ..figures.figure import FigureError
from ..model import solver_in_full
from ..result import Result
from .cases import Solve, triple_chain
from .chain import chain_figures, chain_tables
from .damping import damping_items
from .items import Item
from .page import Origin, index_page
from .spring import spring_items

if TYPE_CHECKING:
    from ..client import Client

PathLike = Union[str, "os.PathLike[str]"]

# The items of a group share its runs.
_GROUPS: tuple[tuple[tuple[str, ...], Callable[[Solve], list[Item]]], ...] = (
    (("fig3", "fig4", "fig5", "exponent"), damping_items),
    (("fig9", "fig10", "fig11", "fig12"), chain_figures),
    (("table2", "table3"), chain_tables),
    (("fig14", "fig15", "fig16", "fig17", "table4"), spring_items))

#: The ids of all items, in the order of the paper within each group.
ITEMS = tuple(id_ for ids, _ in _GROUPS for id_ in ids)
_BATCH = 32  # Jobs in the queue of the server at once, well below its default limit.


def chosen(ids: Iterable[str]) -> list[str]:
    """The items of these ids; all of them for none, or for `all`."""
    asked = list(ids)
    if not asked or "all" in asked:
        return list(ITEMS)
    for id_ in asked:
        if id_ not in ITEMS:
            raise FigureError(f"unknown item '{id_}' — one of {', '.join(ITEMS)} or all")
    return asked


def make_items(ids: Iterable[str], solve: Solve) -> list[Item]:
    """Makes the items with these ids, in the order of ITEMS."""
    wanted = set(ids)
    return [item for of_group, make in _GROUPS if wanted & set(of_group)
            for item in make(solve) if item.id in wanted]


def write_paper(client: Client, ids: Iterable[str], folder: PathLike,
                form: str = "svg") -> tuple[list[Item], int]:
    """Makes items by jobs of a server, which are deleted, and writes data, figures in this format and
    index.html to a folder. Returns the items and the number of figures. Without matplotlib there
    are none."""
    path = pathlib.Path(folder)
    path.mkdir(parents=True, exist_ok=True)
    items = make_items(chosen(ids), _by_jobs(client))
    server = client.server_info()
    for item in items:
        for drawing in (item.figure, item.map):
            if drawing and not drawing.sources:  # Of no single run.
                drawing.sources = [{"version": server.version, "revision": server.revision}]
        item.write(path)
    figures = _draw(items, path, form)
    revision = f" ({server.revision})" if server.revision else ""
    origin = Origin(f"contactd {server.version}{revision}", json.dumps(solver_in_full(triple_chain(0.8, 0.7))),
                    f"contactctl paper {' '.join(ids) or 'all'} -d {os.fspath(folder)}")
    (path / "index.html").write_text(index_page(items, figures, origin), "utf-8")
    return items, len(figures)


def _by_jobs(client: Client) -> Solve:
    def solve(scenarios: Sequence[Scenario]) -> list[Result]:
        results = []
        for first in range(0, len(scenarios), _BATCH):
            jobs = [client.submit(scenario, labels={"made-by": "contactctl-paper"})
                    for scenario in scenarios[first:first + _BATCH]]
            for job in jobs:
                result = client.result(job)
                client.delete(job)
                result.job.name = ""  # Nobody could find it by its name.
                results.append(result)
        return results
    return solve


def _draw(items: Sequence[Item], folder: pathlib.Path, form: str) -> dict[str, str]:
    """Draws the figures beside their data; returns them as SVG, by item, for the page."""
    try:
        from ..figures.files import inline, rendered
        from ..figures.maps import save_map
    except ModuleNotFoundError:
        return {}
    inlined = {}
    for item in items:
        if item.figure:
            svg = rendered(item.figure, "svg")
            inlined[item.id] = inline(svg, item.id)
            (folder / f"{item.id}.{form}").write_bytes(
                svg if form == "svg" else rendered(item.figure, form))
        if item.map:
            drawn = folder / f"{item.id}.svg"
            save_map(item.map, drawn)
            inlined[item.id] = inline(drawn.read_bytes(), item.id)
            if form != "svg":
                drawn.unlink()
                save_map(item.map, drawn.with_suffix(f".{form}"))
    return inlined

