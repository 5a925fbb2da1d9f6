"""Tables of loads and motions that are in files of their own."""

from __future__ import annotations

import pathlib
from collections.abc import Mapping
from typing import Any

import numpy as np
from google.protobuf.descriptor import Descriptor, FieldDescriptor

from .errors import Violation
from .model import Array
from .tables import Table, TableMistake
from .units import factor, in_si, usual_units

#: The keys that say which numbers of a file a table is.
FILE_KEYS = ("file", "column", "unit", "scale", "time_column", "time_unit", "shift_s", "skip")
_TIMES = "times_s"
_ENDINGS = (("_m_per_s2", "m/s^2"), ("_m_per_s", "m/s"), ("_m", "m"), ("_n", "N"))


def may_be_in_file(type_: Descriptor) -> bool:
    """Whether messages of this type are tables of times and values."""
    return _TIMES in type_.fields_by_name


def read_into(message: Any, source: Mapping[str, Any], path: str,
              folder: pathlib.Path) -> list[Violation]:
    """Fills the lists of a table from the file that `source` names, and returns what is wrong."""
    values = _values_of(message.DESCRIPTOR)
    beside = [field.name for field in message.DESCRIPTOR.fields
              if field.label == FieldDescriptor.LABEL_REPEATED and field.name in source]
    if beside:
        return [Violation(f"{path}.{beside[0]}", "cannot stand beside file")]
    try:
        lists = _read(source, values, folder)
    except _Refused as refused:
        return [Violation(f"{path}.{refused.key}", refused.what, refused.hint)]
    except TableMistake as wrong:
        return [Violation(path, mistake) for mistake in wrong.mistakes]
    getattr(message, _TIMES).extend(lists[0])
    getattr(message, values.name).extend(lists[1])
    return []


class _Refused(Exception):
    """A key that does not fit."""

    def __init__(self, key: str, what: str, hint: str = "") -> None:
        super().__init__(what)
        self.key, self.what, self.hint = key, what, hint


def _values_of(type_: Descriptor) -> FieldDescriptor:
    """The list of values of a type of table."""
    return next(field for field in type_.fields
                if field.label == FieldDescriptor.LABEL_REPEATED and field.name != _TIMES
                and field.cpp_type == FieldDescriptor.CPPTYPE_DOUBLE)


def _read(source: Mapping[str, Any], values: FieldDescriptor,
          folder: pathlib.Path) -> tuple[Array, Array]:
    scale, shift = _number(source, "scale", 1), _number(source, "shift_s", 0)
    try:
        table = Table(folder / str(source["file"]), int(_number(source, "skip", 0)))
    except OSError as error:
        raise _Refused("file", f"cannot read {error.filename}: {error.strerror}") from None
    clock = table.time_column() or 0
    if source.get("time_column") is not None:
        clock = _column(table, source, "time_column")
    column = 1 if clock == 0 else 0
    if source.get("column") is not None:
        column = _column(table, source, "column")
    unit = next(unit for ending, unit in _ENDINGS if values.name.endswith(ending))
    mistakes: list[str] = []
    times = _si(table, clock, source, "time_unit", "s", mistakes)
    numbers = _si(table, column, source, "unit", unit, mistakes)
    if mistakes:
        raise TableMistake(list(dict.fromkeys(mistakes)))
    return times + shift, numbers * scale


def _number(source: Mapping[str, Any], key: str, usual: float) -> float:
    value = source.get(key)
    try:
        return usual if value in (None, "") else float(value)  # type: ignore[arg-type]
    except (TypeError, ValueError):
        raise _Refused(key, f"expected a number, got '{value}'") from None


def _column(table: Table, source: Mapping[str, Any], key: str) -> int:
    name = str(source[key])
    for index, column in enumerate(table.columns):
        if name in (column.header, column.name):
            return index
    if name.isdecimal() and 1 <= int(name) <= len(table.columns):
        return int(name) - 1
    raise _Refused(key, f"{table.source} has no column '{name}'", f"it has {table.headers()}")


def _si(table: Table, index: int, source: Mapping[str, Any], key: str, si: str,
        mistakes: list[str]) -> Array:
    """The numbers of a column in SI. Adds what is wrong in it."""
    column = table.columns[index]
    unit = str(source.get(key) or column.unit)
    last = column.name.rpartition("_")
    known = factor(unit, si) if unit else (factor(last[2], si) if last[1] else None) or 1.0
    if known is None:
        raise _Refused(key, f"'{unit}' is no unit of a quantity in {si}",
                       f"one of {usual_units(si)}")
    try:
        numbers: Array = in_si(table.numbers(index, False), known)
        return numbers
    except TableMistake as wrong:
        mistakes += wrong.mistakes
        return np.empty(0)
