"""Pages made from the contract: proto/contact/v1, its comments and the rules of its fields."""

from __future__ import annotations

import pathlib
import re
import subprocess
import tempfile
from typing import Iterator

from contact.v1 import field_rules_pb2
from google.protobuf import descriptor_pb2
from google.protobuf.descriptor_pb2 import FieldDescriptorProto as Field

PROTO = pathlib.Path(__file__).resolve().parents[3] / "proto"
PACKAGE = ".contact.v1."
#: The numbers of the fields of descriptors, of which paths in source info consist.
MESSAGE, NESTED, FIELD, ENUM_IN_FILE, ENUM, VALUE, SERVICE, METHOD = 4, 3, 2, 5, 4, 2, 6, 2
NUMBERS = {Field.TYPE_DOUBLE: "number", Field.TYPE_FLOAT: "number", Field.TYPE_BOOL: "true or false",
           Field.TYPE_STRING: "text", Field.TYPE_BYTES: "bytes"}
UNITS = {"kg": "kg", "m": "m", "s": "s", "n": "N", "pa": "Pa", "j": "J", "rad": "rad",
         "kg_per_m3": "kg/m³", "m_per_s": "m/s", "m_per_s2": "m/s²", "n_per_m": "N/m",
         "n_s_per_m": "N·s/m", "rad_per_s": "rad/s", "s_per_m": "s/m", "bytes": "bytes"}


class Contract:
    """The descriptors of a file of the contract, with the comment of each."""

    def __init__(self, name: str) -> None:
        with tempfile.TemporaryDirectory() as folder:
            out = pathlib.Path(folder) / "set"
            subprocess.run(["protoc", f"-I{PROTO}", "--include_source_info",
                            f"--descriptor_set_out={out}", str(PROTO / "contact/v1" / name)],
                           check=True)
            self.file = descriptor_pb2.FileDescriptorSet.FromString(out.read_bytes()).file[0]
        self._comments = {tuple(place.path): place.leading_comments
                          for place in self.file.source_code_info.location}

    def comment(self, path: tuple[int, ...]) -> str:
        """The comment before an element, without the space that begins each line."""
        text = self._comments.get(path, "")
        return "\n".join(line.removeprefix(" ") for line in text.splitlines()).strip()

    def messages(self) -> Iterator[tuple[str, tuple[int, ...], descriptor_pb2.DescriptorProto]]:
        """Each message with its name within the package, those inside others behind them."""
        for place, message in enumerate(self.file.message_type):
            yield from self._with_nested(message.name, (MESSAGE, place), message)

    def _with_nested(self, name: str, path: tuple[int, ...],
                     message: descriptor_pb2.DescriptorProto) -> Iterator:
        yield name, path, message
        for place, inner in enumerate(message.nested_type):
            if not inner.options.map_entry:
                yield from self._with_nested(f"{name}.{inner.name}", (*path, NESTED, place), inner)


def escaped(text: str) -> str:
    """Text outside of backticks with each character that Markdown would take for a mark escaped."""
    parts = text.split("`")
    parts[::2] = [re.sub(r"([*<>|$\\])", r"\\\1", part) for part in parts[::2]]
    return "`".join(part.replace("|", "\\|") if place % 2 else part
                    for place, part in enumerate(parts))


def prose(comment: str) -> str:
    """A comment in Markdown: paragraphs, lists, and formulae, which are indented, as code."""
    lines = []
    for line in comment.splitlines():
        item = re.match(r"(\* )(.*)", line)
        formula = line.startswith("  F = ")
        lines.append(f"\n`{line.strip()}`\n" if formula else
                     f"{item[1]}{escaped(item[2])}" if item else escaped(line))
    return "\n".join(lines)


def cell(comment: str) -> str:
    """A comment in one line."""
    return escaped(" ".join(comment.split()))


def rule_of(field: Field) -> field_rules_pb2.FieldRule:
    return field.options.Extensions[field_rules_pb2.rule]


def type_of(field: Field) -> str:
    """The type of a field in words."""
    word = NUMBERS.get(field.type, "whole number")
    if field.type_name:
        short = field.type_name.removeprefix(PACKAGE).removeprefix(".google.protobuf.")
        word = "map" if short.endswith("Entry") else short
    many = field.label == Field.LABEL_REPEATED and word != "map"
    return f"list of {word}" if many else word


def unit_of(field: Field) -> str:
    """The unit of a field: that of its rule, or the end of its name."""
    words = field.name.split("_")
    ends = ("_".join(words[place:]) for place in range(1, len(words)))
    return rule_of(field).unit or next((UNITS[end] for end in ends if end in UNITS), "")


def number(value: float) -> str:
    """A number as files have it, such as 1e6."""
    return re.sub(r"e\+?(-?)0*", r"e\1", f"{value:g}")


def range_of(field: Field) -> str:
    """The values that a field may have."""
    rule = rule_of(field)
    low = {"min": f"[{number(rule.min)}", "above": f"({number(rule.above)}"}.get(rule.WhichOneof("low"), "")
    high = f"{number(rule.max)}]" if rule.HasField("max") else ""
    span = f"{low or '(−∞'}, {high or '∞)'}" if low or high else ""
    counts = [f"{count} {words}" for count, words in (
        (rule.max_characters, "characters at most"), (rule.min_entries, "entries at least"),
        (rule.max_entries, "entries at most")) if count]
    return ", ".join(filter(None, [span, *counts]))


def default_of(field: Field) -> str:
    """What an unset field means."""
    rule = rule_of(field)
    kind = rule.WhichOneof("default")
    if rule.required:
        return "required"
    return {"default_number": number(rule.default_number), "default_name": rule.default_name,
            "default_text": escaped(rule.default_text), None: ""}[kind]


def table(contract: Contract, path: tuple[int, ...],
          message: descriptor_pb2.DescriptorProto) -> list[str]:
    """The fields of a message."""
    if not message.field:
        return []
    lines = ["| Field | Type | Unit | Range | Default | Meaning |", "|---|---|---|---|---|---|"]
    for place, field in enumerate(message.field):
        cells = (f"`{field.name}`", type_of(field), unit_of(field), range_of(field),
                 default_of(field), cell(contract.comment((*path, FIELD, place))))
        lines.append("| " + " | ".join(cells) + " |")
    return [*lines, ""]


def enumeration(contract: Contract, path: tuple[int, ...], name: str,
                enum: descriptor_pb2.EnumDescriptorProto) -> list[str]:
    """The values of an enum, but for that which is never sent."""
    lines = [f"### {name}", "", prose(contract.comment(path)), "", "| Value | Meaning |",
             "|---|---|"]
    lines += [f"| `{value.name}` | {cell(contract.comment((*path, VALUE, place)))} |"
              for place, value in enumerate(enum.value) if not value.name.endswith("UNSPECIFIED")]
    return [*lines, ""]


def messages_page(title: str, *names: str) -> str:
    """All messages of files of the contract."""
    lines = [f"# {title}", ""]
    for contract in map(Contract, names):
        for name, path, message in contract.messages():
            lines += [f"## {name}", "", prose(contract.comment(path)), "",
                      *table(contract, path, message)]
            for place, enum in enumerate(message.enum_type):
                lines += enumeration(contract, (*path, ENUM, place), f"{name}.{enum.name}", enum)
    return "\n".join(lines)


def services_page(title: str, *names: str) -> str:
    """The calls of the services."""
    lines = [f"# {title}", ""]
    for contract in map(Contract, names):
        for place, service in enumerate(contract.file.service):
            path = (SERVICE, place)
            lines += [f"## {service.name}", "", prose(contract.comment(path)), ""]
            for index, call in enumerate(service.method):
                stream = "stream of " if call.server_streaming else ""
                given, got = (kind.removeprefix(PACKAGE).removeprefix(".")
                              for kind in (call.input_type, call.output_type))
                lines += [f"### {call.name}", "", f"Takes {given}, returns {stream}{got}.", "",
                          prose(contract.comment((*path, METHOD, index))), ""]
    return "\n".join(lines)


def errors(*names: str) -> dict[str, tuple[str, dict[str, str]]]:
    """Of each reason its code, and what it means in each call; `any call` for those of all."""
    found: dict[str, tuple[str, dict[str, str]]] = {}
    for contract in map(Contract, names):
        for place, service in enumerate(contract.file.service):
            texts = {"any call": contract.comment((SERVICE, place))}
            texts |= {call.name: contract.comment((SERVICE, place, METHOD, index))
                      for index, call in enumerate(service.method)}
            for call, text in texts.items():
                for item in re.split(r"^\* ", text, flags=re.M)[1:]:
                    head = re.match(r"`([A-Z_]+)` \(([A-Z_, ]+)\)[:.]?\s*(.*)", item, re.S)
                    for reason in head[2].split(", ") if head else ():
                        meaning = " ".join(head[3].split("\n\n")[0].split())
                        found.setdefault(reason, (head[1], {}))[1][call] = meaning
    return found


def errors_page(*names: str) -> str:
    """The reasons of errors."""
    lines = ["# Errors", "",
             "Every error of a call carries a `google.rpc.ErrorInfo` with one of these reasons, made "
             "from the comments of the services. Errors of a run are in its job, "
             "[`Job.state_reason`](results.md).", "",
             "| Reason | Code | Where, and what it means |", "|---|---|---|"]
    for reason, (code, calls) in sorted(errors(*names).items()):
        where = "; ".join(f"{call}: {escaped(text.rstrip('.'))}" if text else call
                          for call, text in calls.items())
        lines.append(f"| `{reason}` | `{code}` | {where} |")
    return "\n".join([*lines, ""])
