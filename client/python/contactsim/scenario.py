"""Scenarios from dicts, YAML or JSON files: one schema, that of contact.v1.Scenario."""

from __future__ import annotations

import difflib
import os
import pathlib
import re
from collections.abc import Mapping, Sequence
from typing import Any, Union

import yaml
from contact.v1 import scenario_pb2
from google.protobuf.descriptor import Descriptor, EnumDescriptor, FieldDescriptor

from .errors import InvalidScenario, Violation

_VARIABLE = re.compile(r"\$\$\{|\$\{([^}]+)\}")

ScenarioLike = Union[scenario_pb2.Scenario, Mapping[str, Any], str, "os.PathLike[str]"]


def load_scenario(source: ScenarioLike,
                  variables: Mapping[str, Any] | None = None) -> scenario_pb2.Scenario:
    """The scenario of a dict, of a YAML or JSON file, or the message itself.

    `variables` are other values for those that the file declares and uses as `${name}`. Raises
    ValueError if it has not one of them, and InvalidScenario with every field that does not exist
    or has the wrong type. Ranges are for the server to check.
    """
    if isinstance(source, scenario_pb2.Scenario):
        if variables:
            raise ValueError("a message has no variables")
        return source
    if not isinstance(source, Mapping):
        # BaseLoader: every scalar stays text, so that 1e8, on and 007 mean what they say.
        source = yaml.load(pathlib.Path(source).read_bytes(), yaml.BaseLoader)
    scenario = scenario_pb2.Scenario()
    reader = _Reader()
    reader.message(reader.resolved(source, variables or {}), "", scenario)
    if reader.violations:
        raise InvalidScenario(reader.violations)
    return scenario


class _Reader:
    """Fills a message and notes every mistake instead of stopping at the first."""

    def __init__(self) -> None:
        self.violations: list[Violation] = []

    def resolved(self, source: Any, given: Mapping[str, Any]) -> Any:
        """The document without its `variables`, their values where it names them."""
        declared = source.get("variables") if isinstance(source, Mapping) else None
        values = dict(declared) if isinstance(declared, Mapping) else {}
        for name in given:
            if name not in values:
                known = ", ".join(values) or "none"
                raise ValueError(f"unknown variable '{name}': the file has {known}")
        if not isinstance(source, Mapping) or "variables" not in source:
            return source
        values.update(given)
        return {key: self._put(value, values, str(key)) for key, value in source.items()
                if key != "variables"}

    def _put(self, part: Any, values: Mapping[str, Any], path: str) -> Any:
        if isinstance(part, Mapping):
            return {key: self._put(value, values, f"{path}.{key}") for key, value in part.items()}
        if isinstance(part, (list, tuple)):
            return [self._put(value, values, f"{path}[{i}]") for i, value in enumerate(part)]
        if not isinstance(part, str):
            return part
        unknown = [name for name in _VARIABLE.findall(part) if name and name not in values]
        if unknown:
            known = f"there are {', '.join(values)}" if values else "the file has none"
            self.violations.append(Violation(path, f"undefined variable '{unknown[0]}'", known))
            return None
        alone = _VARIABLE.fullmatch(part)
        if alone and alone[1]:
            return values[alone[1]]
        return _VARIABLE.sub(lambda found: str(values[found[1]]) if found[1] else "${", part)

    def message(self, source: Any, path: str, message: Any) -> None:
        if source is None or source == "":
            return
        if not isinstance(source, Mapping):
            return self._refuse(path, "a mapping", source)
        for name, value in source.items():
            field = message.DESCRIPTOR.fields_by_name.get(name)
            where = f"{path}.{name}" if path else str(name)
            if field is None:
                hint = _field_hint(message.DESCRIPTOR, str(name))
                self.violations.append(Violation(where, "unknown field", hint))
            else:
                self._field(value, where, field, message)

    def _field(self, value: Any, path: str, field: FieldDescriptor, message: Any) -> None:
        if value is None:
            return
        oneof = field.containing_oneof
        rival = message.WhichOneof(oneof.name) if oneof else None
        if rival:
            self.violations.append(
                Violation(path, f"cannot stand beside {rival}", "make an entry of each"))
        elif field.label == FieldDescriptor.LABEL_REPEATED:
            self._list(value, path, field, getattr(message, field.name))
        elif field.message_type:
            part = getattr(message, field.name)
            part.SetInParent()
            self.message(value, path, part)
        else:
            scalar = self._scalar(value, path, field)
            if scalar is not None:
                setattr(message, field.name, scalar)

    def _list(self, values: Any, path: str, field: FieldDescriptor, target: Any) -> None:
        if isinstance(values, (str, Mapping)) or not isinstance(values, Sequence):
            return self._refuse(path, "a list", values)
        for index, value in enumerate(values):
            where = f"{path}[{index}]"
            if field.message_type:
                self.message(value, where, target.add())
            else:
                scalar = self._scalar(value, where, field)
                if scalar is not None:
                    target.append(scalar)

    def _scalar(self, value: Any, path: str, field: FieldDescriptor) -> Any:
        if field.enum_type:
            return self._enum(value, path, field.enum_type)
        try:
            return _READERS[field.cpp_type](value)
        except (TypeError, ValueError, OverflowError):
            self._refuse(path, _EXPECTED[field.cpp_type], value)
        return None

    def _enum(self, value: Any, path: str, type_: EnumDescriptor) -> int | None:
        choices = [choice.name for choice in type_.values if choice.number != 0]
        name = str(value).upper().replace("-", "_")
        if isinstance(value, int) and value in type_.values_by_number:
            return value
        if name in type_.values_by_name:
            return type_.values_by_name[name].number
        near = difflib.get_close_matches(name, choices, 1)
        hint = (f"did you mean {near[0]}? " if near else "") + f"one of {', '.join(choices)}"
        self.violations.append(Violation(path, f"unknown value '{value}'", hint))
        return None

    def _refuse(self, path: str, expected: str, value: Any) -> None:
        got = ("a mapping" if isinstance(value, Mapping) else
               "a list" if isinstance(value, (list, tuple)) else f"'{value}'")
        self.violations.append(Violation(path or "scenario", f"expected {expected}, got {got}"))


def _number(value: Any) -> float:
    if isinstance(value, bool):
        raise TypeError
    if isinstance(value, str) and value.lstrip("+-")[:2].lower() in (".i", ".n"):
        value = value.replace(".", "", 1)  # .inf and .nan, as YAML writes them.
    return float(value)


def _whole(value: Any) -> int:
    number = _number(value)
    if number != int(number):
        raise ValueError
    return int(number) if isinstance(value, str) else int(value)


def _truth(value: Any) -> bool:
    if isinstance(value, str) and value.lower() in ("true", "false"):
        return value.lower() == "true"
    if not isinstance(value, bool):
        raise TypeError
    return value


def _text(value: Any) -> str:
    if not isinstance(value, str):
        raise TypeError
    return value


_READERS = {
    FieldDescriptor.CPPTYPE_DOUBLE: _number,
    FieldDescriptor.CPPTYPE_INT32: _whole,
    FieldDescriptor.CPPTYPE_INT64: _whole,
    FieldDescriptor.CPPTYPE_BOOL: _truth,
    FieldDescriptor.CPPTYPE_STRING: _text,
}
_EXPECTED = {
    FieldDescriptor.CPPTYPE_DOUBLE: "a number",
    FieldDescriptor.CPPTYPE_INT32: "a whole number",
    FieldDescriptor.CPPTYPE_INT64: "a whole number",
    FieldDescriptor.CPPTYPE_BOOL: "true or false",
    FieldDescriptor.CPPTYPE_STRING: "a text",
}


def _field_hint(type_: Descriptor, name: str) -> str:
    names = [field.name for field in type_.fields]
    near = difflib.get_close_matches(name, names, 1)
    return f"did you mean '{near[0]}'?" if near else f"fields are {', '.join(names)}"
