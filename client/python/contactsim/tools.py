"""What contactctl does for the package: pages that it draws through gnuplot."""

from __future__ import annotations

import os
import pathlib
import shutil
import subprocess
from typing import Iterable, Sequence, Union

from .errors import ContactError

PathLike = Union[str, "os.PathLike[str]"]

_DIFFERS = 8  # Exit code: a number is further from its reference than documented.


class ToolFailed(ContactError):
    """contactctl is not there, or ended with an error; the text says which."""


def report(address: str, jobs: Sequence[str], path: PathLike) -> pathlib.Path:
    """Writes a page about jobs that needs no network; see Client.report."""
    target = pathlib.Path(path)
    _contactctl(address, "report", *jobs, "-f", str(target))
    return target


def paper(address: str, items: Iterable[str], folder: PathLike) -> bool:
    """Makes figures and tables of the paper again; see Client.paper."""
    return _contactctl(address, "paper", *items, "-d", str(folder)) != _DIFFERS


def _contactctl(address: str, *arguments: str) -> int:
    """Runs contactctl to its end and returns its exit code: 0 or _DIFFERS."""
    program = os.environ.get("CONTACTCTL") or shutil.which("contactctl")
    if program is None:
        raise ToolFailed(f"{arguments[0]} needs contactctl on the PATH, or its path in the "
                         "variable CONTACTCTL: apt install contactctl")
    try:
        run = subprocess.run([program, "--server", address, *arguments], capture_output=True,
                             encoding="utf-8", check=False)
    except OSError as error:
        raise ToolFailed(f"{program} cannot be run: {error.strerror}") from error
    if run.returncode not in (0, _DIFFERS):
        raise ToolFailed(run.stderr.strip() or f"contactctl ended with code {run.returncode}")
    return run.returncode
