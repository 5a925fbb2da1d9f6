"""Makes contactsim/client.py from contactsim/aio.py: the same calls, not awaited.

`python3 client/python/make_client.py` writes it; a test holds it to this."""

from __future__ import annotations

import pathlib
import re

FOLDER = pathlib.Path(__file__).resolve().parent / "contactsim"

# What is written otherwise, in this order; each occurs.
CHANGES = (
    ('"""The client for asyncio. client.py is made from this file by make_client.py: change this '
     'one."""',
     '"""The client. Made from aio.py by make_client.py: change that one."""'),
    ("A connection to one contactd, as Client, for one event loop; an async context manager.",
     "A connection to one contactd. Thread-safe; also a context manager."),
    ("import asyncio\nimport pathlib\n", "import pathlib\nimport time\n"),
    ("import Any, AsyncIterator, Callable, Iterable, Mapping",
     "import Any, Callable, Iterable, Iterator, Mapping"),
    ("AsyncIterator", "Iterator"),
    ("AsyncClient", "Client"),
    ("open_channel(grpc.aio, ", "open_channel(grpc, "),
    ("__aenter__", "__enter__"),
    ("__aexit__", "__exit__"),
    ("await asyncio.sleep(", "time.sleep("),
)
# The same by pattern.
PATTERNS = (
    (r"await asyncio\.to_thread\(([\w.]+), ", r"\1("),
    (r"\basync (def|for|with) ", r"\1 "),
    (r"\bawait ", ""),
)


def sync_text(text: str) -> str:
    """The synchronous client of the text of the asynchronous one."""
    for old, new in CHANGES:
        if old not in text:
            raise ValueError(f"aio.py has no {old!r} any more")
        text = text.replace(old, new)
    for pattern, new in PATTERNS:
        text, count = re.subn(pattern, new, text)
        if count == 0:
            raise ValueError(f"aio.py has no {pattern!r} any more")
    return _aligned(text)


def _aligned(text: str) -> str:
    """The lines that go on a definition stand below its parenthesis again."""
    lines: list[str] = []
    column = 0  # Of the parenthesis that is open; 0: none.
    for line in text.split("\n"):
        if column and line.strip():
            line = " " * column + line.lstrip()
        if re.match(r"\s*def \w+\(", line):
            column = line.index("(") + 1
        if line.endswith(":"):
            column = 0
        lines.append(line)
    return "\n".join(lines)


if __name__ == "__main__":
    made = sync_text((FOLDER / "aio.py").read_text("utf-8"))
    (FOLDER / "client.py").write_text(made, "utf-8")
