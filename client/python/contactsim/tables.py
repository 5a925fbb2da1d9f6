"""Tables of numbers as loggers and people write them: the same reader as that of contactctl."""

from __future__ import annotations

import collections
import dataclasses
import os
import re
from typing import NamedTuple

import numpy as np

from .model import Array
from .units import is_unit

_MOST_LOOKS = 1000  # Lines that are looked at to find how a table is written.
_MOST_MISTAKES = 20
_GAPS = ("", "nan", ".nan", "-nan", "na", "n/a")
_HEADER = re.compile(r"(?P<name>.*\S)\s*(?:\[\s*(?P<unit>[^\[\]]*?)\s*\]|\((?P<other>[^()]*)\))")


class TableMistake(ValueError):
    """What is wrong in a table; each mistake is `file:line:column: what`."""

    def __init__(self, mistakes: list[str]) -> None:
        super().__init__("\n".join(mistakes))
        self.mistakes = mistakes


@dataclasses.dataclass(frozen=True)
class Column:
    """What a table says of one of its columns."""

    header: str  #: As it stands in the file; empty if there is none.
    name: str  #: The header without its unit.
    unit: str  #: At the end of the header, or below it; may be empty.


class _Field(NamedTuple):
    text: str
    column: int  # Where it begins in its line, from 1.


class Table:
    """Rows of numbers below any lines, headers and perhaps a row of units.

    Finds by itself what separates columns (tabs, semicolons, commas or runs of spaces), decimal
    commas, quotes, where the rows begin, and UTF-16 by its byte order mark. Lines that begin with #
    are comments; the last one before the rows may be the headers. `skip`: so many lines come before
    the headers. Raises TableMistake if there are no rows, OSError if there is no such file.
    """

    def __init__(self, path: str | os.PathLike[str], skip: int = 0) -> None:
        self.source = os.fspath(path)
        with open(path, "rb") as file:
            lines = _in_utf8(file.read()).split("\n")
        self._lines = [line.removesuffix("\r") for line in lines]
        candidates = [i for i in range(skip, len(self._lines))
                      if self._lines[i].strip() and not self._lines[i].startswith("#")]
        self._separator, kinds = self._dialect(candidates)
        first = self._first_row(candidates, kinds) if kinds else None
        if first is None:
            raise TableMistake([f"{self.source}:1:1: has no rows of numbers in two columns or more "
                                "— columns are separated by tabs, semicolons, commas or spaces"])
        self._rows = [i for i in candidates if i >= first]
        self._comma = self._has_decimal_commas()
        self.columns = self._headers(len(kinds), skip)

    def headers(self) -> str:
        """The headers, for messages; the number of a column without one."""
        return ", ".join(column.header or str(i) for i, column in enumerate(self.columns, 1))

    def time_column(self) -> int | None:
        """The first column that is called time or t, if there is one."""
        return next((i for i, c in enumerate(self.columns) if is_time_name(c.name)), None)

    def numbers(self, column: int, gaps: bool) -> Array:
        """The numbers of a column, one a row. `gaps`: what is empty or nan is NaN, no mistake."""
        numbers, mistakes = np.full(len(self._rows), np.nan), []
        for i, row in enumerate(self._rows):
            fields = _split(self._lines[row], self._separator)
            if len(fields) > len(self.columns):
                hint = " — decimals are written with a point" if self._separator == "," else ""
                what = f"has {len(fields)} fields; others have {len(self.columns)}{hint}"
                mistakes.append(self._at(row, len(self.columns), what))
            text = fields[column] if column < len(fields) else ""
            number = None if _is_gap(text) else _read(text, self._comma)
            if number is not None:
                numbers[i] = number
            elif not _is_gap(text):
                hint = (" — decimals are written with a comma here" if self._comma else
                        " — decimals are written with a point" if "," in text else "")
                mistakes.append(self._at(row, column, f"expected a number, got '{text}'{hint}"))
            elif not gaps:
                mistakes.append(self._at(row, column, f"is {text}" if text else "has no number"))
            if len(mistakes) >= _MOST_MISTAKES:
                break
        if mistakes:
            raise TableMistake(mistakes)
        return numbers

    def _at(self, line: int, index: int, what: str) -> str:
        fields = _fields(self._lines[line], self._separator)
        end = len(self._lines[line].encode()) + 1
        column = fields[index].column if index < len(fields) else end
        return f"{self.source}:{line + 1}:{column}: {what}"

    def _dialect(self, candidates: list[int]) -> tuple[str, str]:
        """The separator, and what the fields of a row are: `n` a number, `t` a text."""
        best = ("", "")
        for separator in "\t;, ":  # Earlier ones first, where several fit.
            kinds = self._most_common_kinds(candidates, separator)
            if kinds and (not best[1] or kinds.count("t") < best[1].count("t")):
                best = (separator, kinds)
        return best

    def _most_common_kinds(self, candidates: list[int], separator: str) -> str:
        """What most lines of the second half are with this separator; empty: no rows."""
        half = len(candidates) // 2
        counts: collections.Counter[str] = collections.Counter()
        for i in candidates[half::(len(candidates) - half) // _MOST_LOOKS + 1]:
            kinds = _kinds(self._lines[i], separator).rstrip("g")
            if len(kinds) >= 2 and "n" in kinds:
                counts[kinds.replace("g", "n")] += 1
        return max(counts, key=lambda kinds: (counts[kinds], -kinds.count("t")), default="")

    def _first_row(self, candidates: list[int], row: str) -> int | None:
        """The first of two lines that are rows, and before it those that a mistake hides."""
        def kinds(i: int) -> str:
            return _kinds(self._lines[candidates[i]], self._separator)

        def begins(found: str) -> bool:  # No header: a number where rows have their first one.
            return 2 <= len(found) > row.find("n") and found[row.find("n")] == "n"

        def almost(found: str) -> bool:  # A row with a mistake.
            return begins(found) and len(found) >= len(row) and not found[len(row):].strip("g")

        for i in range(len(candidates)):
            if not _fits(kinds(i), row):
                continue
            if i + 1 < len(candidates) and not (_fits(kinds(i + 1), row) or almost(kinds(i + 1))):
                continue
            while i > 0 and begins(kinds(i - 1)):
                i -= 1
            return candidates[next((j for j in range(i) if almost(kinds(j))), i)]
        return None

    def _has_decimal_commas(self) -> bool:
        """Whether some number has a decimal comma, and none a point."""
        if self._separator == ",":
            return False
        comma = False
        for i in self._rows[::len(self._rows) // _MOST_LOOKS + 1]:
            for text in _split(self._lines[i], self._separator):
                if "." in text and _read(text, False) is not None:
                    return False
                comma = comma or "," in text and _read(text, True) is not None
        return comma

    def _headers(self, count: int, skip: int) -> list[Column]:
        above: list[list[str]] = []
        for i in range(self._rows[0] - 1, skip - 1, -1):
            line = self._lines[i].strip(" ")
            fields = _header_fields(line.removeprefix("#").strip(" "), self._separator)
            if fields and (not line.startswith("#") or len(fields) == count):
                above.append(fields)
            if len(above) == 2:
                break
        headers, units = above[0] if above else [], []
        if len(above) == 2 and _are_units(headers) and len(above[1]) >= max(len(headers), 2):
            headers, units = above[1], headers
        if len(headers) < 2:
            return [Column("", "", "")] * count
        if len(headers) < count:
            raise TableMistake([f"{self.source}:{self._rows[0] + 1}:1: has {count} fields; the "
                                f"header has {len(headers)}"])
        units += [""] * (len(headers) - len(units))
        return [_column(header, _bare(unit)) for header, unit in zip(headers, units)]


def is_time_name(name: str) -> bool:
    """Whether a column of this name holds times."""
    return name.lower() in ("time", "t", "zeit", "temps")


def _in_utf8(data: bytes) -> str:
    if data.startswith((b"\xff\xfe", b"\xfe\xff")):
        return data.decode("utf-16", "replace")
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError:
        return data.decode("latin-1")


def _fields(line: str, separator: str) -> list[_Field]:
    """The fields of a line with their places, which count bytes."""
    texts, places = [""], [1]
    quoted, begun, place, i = False, separator != " ", 0, 0
    while i < len(line):
        char = line[i]
        parts = not quoted and (char == separator or separator == " " and char == "\t")
        place += len(char.encode())
        if char == '"' and quoted and line[i + 1:i + 2] == '"':
            texts[-1] += char
            i, place = i + 1, place + 1
        elif char == '"':
            quoted, begun = not quoted, True
        elif not parts:
            if not begun:
                places[-1] = place
            texts[-1] += char
            begun = True
        elif separator != " " or begun:
            texts.append("")
            places.append(place + 1)
            begun = separator != " "
        i += 1
    found = [_Field(text.strip(), column) for text, column in zip(texts, places)]
    while found and not found[-1].text:
        found.pop()
    return found


def _split(line: str, separator: str) -> list[str]:
    """The texts of the fields of a line."""
    if '"' in line:
        return [field.text for field in _fields(line, separator)]
    fields = _parts(line, separator)
    while fields and not fields[-1]:
        fields.pop()
    return fields


def _parts(line: str, separator: str) -> list[str]:
    """The texts between separators, empty ones at the end with them. Of a line without quotes."""
    return line.split() if separator == " " else [f.strip() for f in line.split(separator)]


def _read(text: str, comma: bool) -> float | None:
    if comma and "." in text or "_" in text:
        return None
    try:
        return float(text.replace(",", ".") if comma else text)
    except ValueError:
        return None


def _is_gap(text: str) -> bool:
    return text.lower() in _GAPS


def _kinds(line: str, separator: str) -> str:
    """Of each field `n` a number, `g` a gap, `t` a text."""
    def kind(text: str) -> str:
        if _is_gap(text):
            return "g"
        return "t" if _read(text, False) is None and (separator == "," or
                                                      _read(text, True) is None) else "n"
    fields = _split(line, separator) if '"' in line else _parts(line, separator)
    return "".join(kind(text) for text in fields)


def _fits(kinds: str, row: str) -> bool:
    """Whether a line is a row of these kinds. It may end early, or with empty fields."""
    return (len(kinds) >= 2 and "n" in kinds and not kinds[len(row):].strip("g")
            and all(kind in ("g", of) for kind, of in zip(kinds, row)))


def _header_fields(line: str, separator: str) -> list[str]:
    """Headers, in which what stands in brackets belongs to what is before it."""
    headers: list[str] = []
    for text in _split(line, separator):
        bracket = separator == " " and text[:1] in ("[", "(") and headers
        if bracket and not is_unit(_bare(headers[-1])):
            headers[-1] += " " + text
        else:
            headers.append(text)
    return headers


def _bare(text: str) -> str:
    bracketed = len(text) > 2 and text[0] + text[-1] in ("[]", "()")
    return text[1:-1].strip() if bracketed else text


def _are_units(fields: list[str]) -> bool:
    """Whether a row below the headers has units. Some may be of other quantities."""
    return (any(is_unit(_bare(field)) for field in fields)
            and all(len(field.encode()) < 16 for field in fields))


def _column(header: str, unit: str) -> Column:
    found = _HEADER.fullmatch(header)
    if not found:
        return Column(header, header, unit)
    own = found["unit"] if found["unit"] is not None else found["other"].strip()
    return Column(header, found["name"], own or unit)
