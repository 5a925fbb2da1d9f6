"""Units, as the contract has them in names and rules, and as people write them."""

from __future__ import annotations

import re

from contact.v1 import field_rules_pb2, job_pb2
from google.protobuf.descriptor import Descriptor, FieldDescriptor

from .figures.words import WORDS

#: How names in the contract end, and the unit that this means; longer endings first.
ENDINGS: list[tuple[str, str]] = [(ending, unit) for ending, unit in WORDS["endings"]]
_POWERS = str.maketrans("23", "²³")
_WORDS = (FieldDescriptor.CPPTYPE_STRING, FieldDescriptor.CPPTYPE_ENUM)
_PICKS = ("first", "last", "max", "min")  #: What a metric takes of the entries of a list.

_PREFIXES = {"": 1.0, "n": 1e-9, "u": 1e-6, "µ": 1e-6, "μ": 1e-6, "m": 1e-3, "c": 1e-2, "k": 1e3,
             "M": 1e6, "G": 1e9}
_TIMES = {"min": 60.0, "h": 3600.0}


def steps_of(path: str) -> list[tuple[str, str]]:
    """The names of a path, each with what stands in its brackets; none if it is no path."""
    found = re.findall(r"([^.\[\]]+)(?:\[([^\[\]]+)\])?(\.|$)", path)
    whole = "".join(f"{name}[{key}]{end}" if key else name + end for name, key, end in found)
    good = whole == path and found and not path.endswith(".")
    return [(name, key) for name, key, _ in found] if good else []


def field_at(type_: Descriptor, path: str) -> FieldDescriptor | None:
    """The field at a path from a message, whatever entries its lists have."""
    message: Descriptor | None = type_
    field: FieldDescriptor | None = None
    for name, _ in steps_of(path):
        field = message.fields_by_name.get(name) if message else None
        if field is None:
            return None
        message = field.message_type
    return field


def unit_of(field: FieldDescriptor | None) -> str:
    """SI unit of a field: `1` without dimension, empty for words."""
    if field is None or field.cpp_type in _WORDS:
        return ""
    unit = next((unit for ending, unit in ENDINGS if field.name.endswith(ending)), "1")
    return stated_unit(field) or unit.replace("^", "").translate(_POWERS)


def stated_unit(field: FieldDescriptor) -> str:
    """The unit that the rule of a field has; empty if its name tells it."""
    rule: field_rules_pb2.FieldRule = field.GetOptions().Extensions[field_rules_pb2.rule]
    return str(rule.unit)


def unit_of_metric(metric: str) -> str:
    """SI unit of a metric of a sweep."""
    series = series_metric(metric)
    if series is not None:
        return series[3].replace("^", "").translate(_POWERS)
    steps = [name for name, _ in steps_of(metric) if name not in _PICKS]
    if steps and steps[-1] == "count":
        return "1"
    type_ = job_pb2.Job.DESCRIPTOR
    if len(steps) == 1 and steps[0] not in type_.fields_by_name:
        type_ = job_pb2.RunSummary.DESCRIPTOR  # A name alone.
    return unit_of(field_at(type_, ".".join(steps)))


def series_metric(metric: str) -> tuple[str, str, str, str] | None:
    """Word, quantity, owner and unit of a metric of samples such as `series[B1.velocity].max`: max,
    velocity, B1 and m/s; None of others. The owner of `time` is empty."""
    steps = steps_of(metric)
    if len(steps) != 2 or steps[0][0] != "series" or steps[1][1]:
        return None
    owner, _, quantity = steps[0][1].rpartition(".")
    word = steps[1][0]
    if quantity not in WORDS["channels"] or word not in WORDS["picks"]:
        return None
    unit = "s" if word.startswith("time_of_") else WORDS["channels"][quantity]
    return word, quantity, owner, str(unit)


def factor(unit: str, si: str) -> float | None:
    """What a number in `unit` is multiplied with to be in `si`; None if that cannot be."""
    parts, base = unit.split("/"), si.split("/")
    factors = [_simple(part, of) for part, of in zip(parts, base)]
    if len(parts) != len(base) or None in factors:
        return None
    known = [value for value in factors if value is not None]
    return known[0] / known[1] if len(known) == 2 else known[0]


def _simple(unit: str, si: str) -> float | None:
    if si == "s" and unit in _TIMES:
        return _TIMES[unit]
    if unit == si:
        return 1.0
    known = si in ("s", "m", "N") and unit.endswith(si)
    return _PREFIXES.get(unit.removesuffix(si)) if known else None
