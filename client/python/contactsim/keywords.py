"""Keywords that a function does not have, with a hint at what was meant."""

from __future__ import annotations

import difflib
import functools
import inspect
from typing import Any, Callable, Iterator, TypeVar, cast

from contact.v1 import scenario_pb2
from google.protobuf.descriptor import Descriptor

F = TypeVar("F", bound=Callable[..., Any])


def hinted(function: F) -> F:
    """Makes the TypeError for an unknown keyword say what to write instead."""
    known = [name for name in inspect.signature(function).parameters if name != "self"]

    @functools.wraps(function)
    def checked(*arguments: Any, **keywords: Any) -> Any:
        unknown = [name for name in keywords if name not in known]
        if unknown:
            raise TypeError(f"{function.__name__}() has no keyword '{unknown[0]}'"
                            + _hint(unknown[0], keywords[unknown[0]], known))
        return function(*arguments, **keywords)

    return cast(F, checked)


def _hint(name: str, value: Any, known: list[str]) -> str:
    near = difflib.get_close_matches(name, known, 1)
    if near:
        return f"; did you mean '{near[0]}'?"
    path = next(_paths(name), "")
    if path and "set" in known:
        return f"; fields of the scenario are set so: set={{{path!r}: {value!r}}}"
    return f"; there are {', '.join(known)}"


def _paths(name: str) -> Iterator[str]:
    """Paths of fields with this name, or whose name is this one and a unit."""
    for field in scenario_pb2.Scenario.DESCRIPTOR.fields:
        if not field.message_type:
            yield from _named(name, "", field.name)
            continue
        entry = f"{field.name}[*]." if field.label == field.LABEL_REPEATED else f"{field.name}."
        for part in _names(field.message_type):
            yield from _named(name, entry, part)


def _names(type_: Descriptor) -> list[str]:
    return [field.name for field in type_.fields if not field.message_type]


def _named(name: str, entry: str, field: str) -> Iterator[str]:
    if field == name or field.startswith(name + "_"):
        yield entry + field
