"""Units, as the contract has them in names and rules, and as people write them."""

from __future__ import annotations

import re
from typing import Any

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
_GRAVITY = 9.80665
#: Units beside the SI unit and its prefixes, all exact by definition.
_OTHERS = {"s": {"min": 60.0, "h": 3600.0}, "m": {"in": 0.0254, "ft": 0.3048},
           "N": {"kgf": _GRAVITY, "kp": _GRAVITY, "lbf": 4.4482216152605},
           "m/s": {"mph": 0.44704, "kph": 1 / 3.6},
           "m/s^2": {"g": _GRAVITY, "gn": _GRAVITY, "G": _GRAVITY, "mg": _GRAVITY / 1000}}
_USUAL = {"s": "s, ms, us, min, h", "m": "m, mm, cm, um, in, ft",
          "m/s": "m/s, mm/s, km/h, mph, ft/s", "m/s^2": "m/s^2, mm/s^2, g, ft/s^2",
          "N": "N, kN, mN, MN, kgf, lbf"}


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
    unit, si = _with_power(unit), _with_power(si)
    whole = _simple(unit, si)
    parts, base = unit.partition("/"), si.partition("/")
    if whole is not None or not parts[1] or not base[1]:
        return whole
    above, below = _simple(parts[0], base[0]), _below(parts[2], base[2])
    return None if above is None or below is None else above / below


def in_si(values: Any, factor_: float) -> Any:
    """Numbers in a unit of this factor in SI: divided where it is 1e-3 or alike, which is exact."""
    inverse = 1 / factor_
    return values / inverse if inverse == round(inverse) else values * factor_


def usual_units(si: str) -> str:
    """The units that people know of the quantity with this SI unit, for messages."""
    return _USUAL.get(_with_power(si), si)


def is_unit(text: str) -> bool:
    """Whether a text is a unit of some quantity of loads and motions."""
    return any(factor(text, si) is not None for si in _USUAL)


def _with_power(unit: str) -> str:
    """`m/s²` and `m/s2` as `m/s^2`."""
    unit = unit.replace("²", "^2").replace("**2", "^2")
    return unit[:-1] + "^2" if unit.endswith("/s2") else unit


def _simple(unit: str, si: str) -> float | None:
    if unit == si:
        return 1.0
    if unit in _OTHERS.get(si, {}):
        return _OTHERS[si][unit]
    known = si in ("s", "m", "N") and unit.endswith(si)
    return _PREFIXES.get(unit.removesuffix(si)) if known else None


def _below(unit: str, si: str) -> float | None:
    """The factor of what stands below a quotient, which may be a square."""
    if unit.endswith("^2") != si.endswith("^2"):
        return None
    root = _simple(unit.removesuffix("^2"), si.removesuffix("^2"))
    return root**2 if root is not None and unit.endswith("^2") else root
