"""Pages for a folder: a report about runs, the paper made again. Each is written through a client of its
own, which a thread of an event loop may use."""

from __future__ import annotations

import os
import pathlib
from typing import TYPE_CHECKING, Iterable, Mapping, Sequence, Union

from .paper.make import write_paper
from .report import report_page

if TYPE_CHECKING:
    from .client import Client

PathLike = Union[str, "os.PathLike[str]"]
Files = Mapping[str, Union[str, None]]


def report(files: Files, address: str, jobs: Sequence[str], path: PathLike) -> pathlib.Path:
    """See Client.report."""
    with _client(files, address) as client:
        return write_report(client, jobs, path)[0]


def paper(files: Files, address: str, items: Iterable[str], folder: PathLike) -> bool:
    """See Client.paper."""
    with _client(files, address) as client:
        made, _ = write_paper(client, list(items), folder)
    return all(item.holds for item in made)


def write_report(client: Client, jobs: Sequence[str], path: PathLike) -> tuple[pathlib.Path, bool]:
    """Writes the page of jobs. Returns where, and True if it has its figures."""
    runs = [client.result(job, failed=True) for job in jobs]
    drawn = True
    try:
        text = report_page(runs, client.address)
    except ModuleNotFoundError:  # matplotlib
        drawn = False
        text = report_page(runs, client.address, draw=False)
    target = pathlib.Path(path)
    target.write_text(text, "utf-8")
    return target, drawn


def _client(files: Files, address: str) -> Client:
    from .client import Client  # Which has these functions as methods.

    return Client(address, tls_ca=files["tls_ca"], cert=files["cert"], key=files["key"],
                  token_file=files["token_file"])
