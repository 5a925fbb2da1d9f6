"""What the evidence leaves: a table for people, the same for programs, and a history."""

from __future__ import annotations

import csv
import datetime
import pathlib
from typing import Sequence

from rows import Measured

COMMAND = "client/docs/evidence/run"
HISTORY = ("date", "version", "revision", "row", "ours", "difference")


def write(folder: pathlib.Path, found: Sequence[Measured], version: tuple[str, str]) -> None:
    """Writes table.md and table.csv, and appends to history.csv."""
    folder.mkdir(parents=True, exist_ok=True)
    today = datetime.datetime.now(datetime.timezone.utc).date().isoformat()
    (folder / "table.md").write_text(page(found, version, today), "utf-8")
    with open(folder / "table.csv", "w", encoding="utf-8", newline="") as file:
        table = csv.writer(file)
        table.writerow(("row", "group", "what", "ours", "theirs", "difference", "tolerance",
                        "holds", "source"))
        table.writerows((m.row.key, m.row.group, m.row.what, repr(m.ours), repr(m.theirs),
                         f"{m.difference:.1e}", m.row.tolerance, m.holds, m.row.source)
                        for m in found)
    append(folder / "history.csv", found, version, today)


def append(path: pathlib.Path, found: Sequence[Measured], version: tuple[str, str],
           today: str) -> None:
    """A line a row, with the day and the program."""
    new = not path.exists()
    with open(path, "a", encoding="utf-8", newline="") as file:
        history = csv.writer(file)
        if new:
            history.writerow(HISTORY)
        history.writerows((today, *version, m.row.key, f"{m.ours:.12g}", f"{m.difference:.1e}")
                          for m in found)


def page(found: Sequence[Measured], version: tuple[str, str], today: str) -> str:
    """The table in Markdown, with a heading for each group."""
    held = sum(m.holds for m in found)
    lines = [f"{held} of {len(found)} rows hold. Computed on {today} by contactd {version[0]}, "
             f"revision {version[1][:8] or 'unknown'}.", ""]
    groups: dict[str, list[Measured]] = {}
    for measured in found:
        groups.setdefault(measured.row.group, []).append(measured)
    for group, members in groups.items():
        lines += [f"## {group}", "",
                  "| What, and its name | Ours | Theirs | Difference | Theirs is from |",
                  "|---|---|---|---|---|", *map(line, members), ""]
    return "\n".join(lines)


def line(measured: Measured) -> str:
    """A row in Markdown."""
    claim = measured.row
    mark = "" if measured.holds else " **missed**"
    cells = (f"{claim.what} `{claim.key}`", number(measured.ours), number(measured.theirs),
             f"{measured.difference:.1e} of {claim.tolerance:g}{mark}", claim.source)
    return "| " + " | ".join(cell.replace("|", "\\|") for cell in cells) + " |"


def number(value: float) -> str:
    """Eight digits; table.csv has all."""
    return f"{value:.8g}"


def verdict(measured: Measured) -> str:
    """A row on a terminal."""
    word = "ok    " if measured.holds else "MISSED"
    return (f"{word} {measured.row.key:36} {number(measured.ours):>18} "
            f"{number(measured.theirs):>18} {measured.difference:8.1e} "
            f"of {measured.row.tolerance:g}")
