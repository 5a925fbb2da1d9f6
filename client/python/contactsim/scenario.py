"""Scenarios from dicts, files and templates: one schema, that of contact.v1.Scenario."""

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
from .file_tables import FILE_KEYS, may_be_in_file, read_into
from .model import contact_names
from .spelling import expected, shown
from .units import steps_of

_VARIABLE = re.compile(r"\$\$\{|\$\{([^}]+)\}")

ScenarioLike = Union[scenario_pb2.Scenario, Mapping[str, Any], str, "os.PathLike[str]"]


def load_scenario(source: ScenarioLike, variables: Mapping[str, Any] | None = None, *,
                  set: Mapping[str, Any] | None = None) -> scenario_pb2.Scenario:
    """The scenario of a dict, of a YAML or JSON file, of a template, or the message itself.

    A text names a file, or else one of `templates()`. A table of a load or motion may be in a file
    of its own, `{"file": "measured.csv", "unit": "kN"}`, from the folder of the scenario's file. `variables` are other values for those that
    the file declares and uses as `${name}`. `set` has values by the path of their fields, such as
    `{"contacts[0].restitution": 0.7}`; in brackets may stand the name of a body or contact, or `*`
    for every entry. The message that is given is not changed.

    Raises ValueError if it has not one of the variables, FileNotFoundError if there is neither file
    nor template, and InvalidScenario with every field that does not exist or has the wrong type.
    Ranges are for the server to check.
    """
    return read_scenario(source, variables, set)[0]


def read_scenario(source: ScenarioLike, variables: Mapping[str, Any] | None,
                  set_: Mapping[str, Any] | None
                  ) -> tuple[scenario_pb2.Scenario, dict[str, list[str]]]:
    """As load_scenario, and the fields of each variable: those whose whole value it is."""
    _require_dict(variables, "variables", '{"height_m": 0.5}')
    _require_dict(set_, "set", '{"contacts[0].restitution": 0.7}')
    reader = _Reader(_folder(source))
    scenario = scenario_pb2.Scenario()
    if isinstance(source, scenario_pb2.Scenario):
        if variables:
            raise ValueError("a message has no variables")
        if not set_:
            return source, {}
        scenario.CopyFrom(source)
    else:
        document = source if isinstance(source, Mapping) else _document(source)
        reader.message(reader.resolved(document, variables or {}), "", scenario)
    for path, value in (set_ or {}).items():
        reader.set(path, value, scenario)
    if reader.violations:
        raise InvalidScenario(reader.violations)
    return scenario, reader.fields


def _require_dict(given: Any, name: str, example: str) -> None:
    if given is not None and not isinstance(given, Mapping):
        raise TypeError(f"{name} is a dict such as {example}, and not {shown(given)}")


def templates() -> list[str]:
    """The names of the scenarios that come with the package, for load_scenario and run."""
    return sorted(path.stem for path in _template_folder().glob("*.yaml")
                  if not path.stem.endswith("-sweep"))


def _folder(source: ScenarioLike) -> pathlib.Path:
    """Where the files are that a scenario names: beside its own file, else where we are."""
    if isinstance(source, (str, os.PathLike)) and pathlib.Path(source).is_file():
        return pathlib.Path(source).parent
    return pathlib.Path()


def _template_folder() -> pathlib.Path:
    here = pathlib.Path(__file__).resolve()
    packed = here.parent / "templates"  # Where setup.py puts them.
    return packed if packed.is_dir() else here.parents[2] / "scenarios"


def _document(source: Any) -> Any:
    """What a file holds, or the template of this name."""
    if not isinstance(source, (str, os.PathLike)):
        raise TypeError("a scenario is a file, the name of a template, a dict or a "
                        f"contact.v1.Scenario, and not {shown(source)}")
    path = pathlib.Path(source)
    if not path.is_file() and isinstance(source, str):
        names = templates()
        if source not in names:
            raise FileNotFoundError(f"there is no file and no template {source!r}"
                                    + expected(source, names))
        path = _template_folder() / f"{source}.yaml"
    # BaseLoader: every scalar stays text, so that 1e8, on and 007 mean what they say.
    return yaml.load(path.read_bytes(), yaml.BaseLoader)


class _Reader:
    """Fills a message and notes every mistake instead of stopping at the first."""

    def __init__(self, folder: pathlib.Path) -> None:
        self.folder = folder
        self.violations: list[Violation] = []
        self.fields: dict[str, list[str]] = {}  #: Of each variable those whose whole value it is.

    def resolved(self, source: Any, given: Mapping[str, Any]) -> Any:
        """The document without its `variables`, their values where it names them."""
        declared = source.get("variables") if isinstance(source, Mapping) else None
        values = dict(declared) if isinstance(declared, Mapping) else {}
        for name in given:
            if name not in values:
                raise ValueError(f"unknown variable '{name}'" + expected(name, values))
        if not isinstance(source, Mapping) or "variables" not in source:
            return source
        values.update(given)
        self.fields = {name: [] for name in values}
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
            self.fields[alone[1]].append(path)
            return values[alone[1]]
        return _VARIABLE.sub(lambda found: str(values[found[1]]) if found[1] else "${", part)

    def message(self, source: Any, path: str, message: Any) -> None:
        if source is None or source == "":
            return
        if not isinstance(source, Mapping):
            return self._refuse(path, "a mapping", source)
        if "file" in source and may_be_in_file(message.DESCRIPTOR):
            self.violations += read_into(message, source, path, self.folder)
            source = {key: value for key, value in source.items() if key not in FILE_KEYS}
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
        else:
            self._assign(value, path, field, message)

    def _assign(self, value: Any, path: str, field: FieldDescriptor, message: Any) -> None:
        if field.label == FieldDescriptor.LABEL_REPEATED:
            self._list(value, path, field, getattr(message, field.name))
        elif field.message_type:
            part = getattr(message, field.name)
            part.SetInParent()
            self.message(value, path, part)
        else:
            scalar = self._scalar(value, path, field)
            if scalar is not None:
                setattr(message, field.name, scalar)

    def set(self, path: str, value: Any, scenario: scenario_pb2.Scenario) -> None:
        """Replaces the fields at a path, or clears them if the value is None."""
        steps = steps_of(path)
        if steps:
            self._set(steps, "", value, scenario, scenario)
        else:
            self.violations.append(Violation(path, "is no path", "such as contacts[0].restitution"))

    def _set(self, steps: list[tuple[str, str]], walked: str, value: Any, message: Any,
             scenario: scenario_pb2.Scenario) -> None:
        (name, key), *rest = steps
        here = f"{walked}.{name}" if walked else name
        field = message.DESCRIPTOR.fields_by_name.get(name)
        if field is None:
            hint = _field_hint(message.DESCRIPTOR, name)
            self.violations.append(Violation(here, "unknown field", hint))
        elif key and not rest:
            self.violations.append(Violation(here, "cannot be set entry by entry",
                                             "set a field of it, or the whole list"))
        elif key:
            for index in self._entries(key, here, field, message, scenario):
                part = getattr(message, name)[index]
                self._set(rest, f"{here}[{index}]", value, part, scenario)
        elif not rest:
            message.ClearField(name)
            if value is not None:
                self._assign(value, here, field, message)
        elif field.label == FieldDescriptor.LABEL_REPEATED:
            self.violations.append(
                Violation(here, "is a list", f"{here}[0], or {here}[*] for every entry"))
        elif not field.message_type:
            self.violations.append(Violation(here, f"has no field '{rest[0][0]}'"))
        else:
            self._set(rest, here, value, getattr(message, name), scenario)

    def _entries(self, key: str, here: str, field: FieldDescriptor, message: Any,
                 scenario: scenario_pb2.Scenario) -> list[int]:
        """The indices that stand in brackets, or are meant by a name there."""
        if field.label != FieldDescriptor.LABEL_REPEATED or not field.message_type:
            self.violations.append(Violation(here, "has no entries with fields"))
            return []
        size = len(getattr(message, field.name))
        if key == "*":
            return list(range(size))
        if key.isdecimal():
            if int(key) < size:
                return [int(key)]
            self.violations.append(Violation(f"{here}[{key}]", f"there are only {size}"))
            return []
        entry = _named_entry(scenario, here, key)
        if isinstance(entry, Violation):
            self.violations.append(entry)
            return []
        return [entry]

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
            return int(type_.values_by_name[name].number)
        near = difflib.get_close_matches(name, choices, 1)
        hint = (f"did you mean {near[0]}? " if near else "") + f"one of {', '.join(choices)}"
        self.violations.append(Violation(path, f"unknown value '{value}'", hint))
        return None

    def _refuse(self, path: str, expected: str, value: Any) -> None:
        got = ("a mapping" if isinstance(value, Mapping) else
               "a list" if isinstance(value, (list, tuple)) else f"'{value}'")
        self.violations.append(Violation(path or "scenario", f"expected {expected}, got {got}"))


def _named_entry(scenario: scenario_pb2.Scenario, path: str, name: str) -> int | Violation:
    """The index of a body or contact of this name in its list, or why there is none."""
    names: list[str] = []
    if path == "bodies":
        names = [body.name for body in scenario.bodies]
        if name in names:
            return names.index(name)
    elif path == "contacts":
        for index, contact in enumerate(scenario.contacts):
            made = contact_names(contact)
            if name == contact.name or made == [name]:
                return index
            if name in made:
                return Violation(path, f"'{name}' has its fields in common with the other contacts "
                                 f"of contacts[{index}]", f"contacts[{index}] sets them for all")
            names += made
    else:
        return Violation(path, "its entries have no names", "give an index, or [*]")
    near = difflib.get_close_matches(name, names, 1)
    what = {"bodies": "body", "contacts": "contact"}[path]
    known = f"there are {', '.join(names)}" if 0 < len(names) <= 8 else ""
    return Violation(path, f"there is no {what} '{name}'",
                     f"did you mean '{near[0]}'?" if near else known)


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
