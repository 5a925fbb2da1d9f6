"""Makes the OpenAPI document of the gateway from the contract: `openapi.py CONTRACT VERSION OUTPUT`.

CONTRACT is a FileDescriptorSet with comments. The document has the calls of all services in it as the
protocol Connect has them, in JSON, and the plain routes of the gateway. Descriptions are the comments
of the contract, constraints its rules. OUTPUT is C++ if its name ends so, else JSON."""

from __future__ import annotations

import json
import pathlib
import re
import sys
from typing import Any, Iterator

from contact.v1 import field_rules_pb2
from google.protobuf import descriptor_pb2
from google.protobuf.descriptor_pb2 import DescriptorProto, FieldDescriptorProto, MethodOptions

Json = dict[str, Any]
Field = FieldDescriptorProto

# The numbers of the fields of descriptors, of which paths in source info consist.
_MESSAGE, _NESTED, _FIELD, _ENUM_IN_FILE, _ENUM, _VALUE, _SERVICE, _METHOD = 4, 3, 2, 5, 4, 2, 6, 2

# What is no call; served by Service::Answer and Readiness.
_PLAIN = {
    "/healthz": ("Whether the process answers.", "text/plain", (200,)),
    "/readyz": ("Whether gRPC serves; 503 while it ends.", "text/plain", (200, 503)),
    "/metrics": ("Counters for Prometheus; 403 where callers are asked who they are.", "text/plain",
                 (200, 403)),
    "/v1/openapi.json": ("This document.", "application/json", (200,)),
}
_ABOUT = """Contact simulations as jobs. Each call is a POST of JSON by the protocol
[Connect](https://connectrpc.com/docs/protocol); unary calls without side effects may be a GET. Answers
leave out fields that have their default: 0, false, empty. Requests may have the names of fields in
snake case, too, and null for a field that is unset. Answers that are streams are a row of frames: a
byte of flags, four of length with the highest first, and a message; the frame with flag 2 is the last
and says how the stream ended."""

_INT32 = {"type": "integer", "minimum": -2**31, "maximum": 2**31 - 1}
_UINT32 = {"type": "integer", "minimum": 0, "maximum": 2**32 - 1}
_INT64 = {"type": ["string", "integer"], "format": "int64", "pattern": "^-?[0-9]+$"}
_UINT64 = {"type": ["string", "integer"], "format": "uint64", "pattern": "^[0-9]+$", "minimum": 0}
_SCALARS = {
    Field.TYPE_DOUBLE: {"type": "number", "format": "double"},
    Field.TYPE_FLOAT: {"type": "number", "format": "float"},
    Field.TYPE_BOOL: {"type": "boolean"}, Field.TYPE_STRING: {"type": "string"},
    Field.TYPE_BYTES: {"type": "string", "contentEncoding": "base64"},
    Field.TYPE_INT32: _INT32, Field.TYPE_SINT32: _INT32, Field.TYPE_SFIXED32: _INT32,
    Field.TYPE_UINT32: _UINT32, Field.TYPE_FIXED32: _UINT32,
    Field.TYPE_INT64: _INT64, Field.TYPE_SINT64: _INT64, Field.TYPE_SFIXED64: _INT64,
    Field.TYPE_UINT64: _UINT64, Field.TYPE_FIXED64: _UINT64,
}
# Messages whose JSON is not that of their fields.
_WELL_KNOWN = {
    ".google.protobuf.Timestamp": {"type": "string", "format": "date-time"},
    ".google.protobuf.Duration": {"type": "string", "pattern": r"^-?[0-9]+(\.[0-9]{1,9})?s$"},
    ".google.protobuf.FieldMask": {"type": "string", "description": "Names with commas between."},
    ".google.protobuf.Empty": {"type": "object", "additionalProperties": False},
    ".google.protobuf.Any": {"type": "object", "properties": {"@type": {"type": "string"}},
                             "required": ["@type"]},
}
# Answers of ListJobs have jobs without their spec, so that a job need not have one; that of a
# CreateJobRequest must.
_WITHOUT_CHOICE = "contact.v1.Job"
_CODES = ["canceled", "unknown", "invalid_argument", "deadline_exceeded", "not_found", "already_exists",
          "permission_denied", "resource_exhausted", "failed_precondition", "aborted", "out_of_range",
          "unimplemented", "internal", "unavailable", "data_loss", "unauthenticated"]
_ERROR = {
    "description": "Why a call failed, as Connect has it.", "type": "object", "required": ["code"],
    "properties": {
        "code": {"type": "string", "enum": _CODES},
        "message": {"type": "string"},
        "details": {"type": "array", "items": {
            "type": "object", "required": ["type", "value"], "properties": {
                "type": {"type": "string", "description": "Such as `google.rpc.BadRequest`."},
                "value": {"type": "string", "contentEncoding": "base64"},
                "debug": {"type": "object", "description": "The detail in JSON."}}}}}}


class Document:
    """The document of all files of a contract."""

    def __init__(self, contract: descriptor_pb2.FileDescriptorSet, version: str) -> None:
        self._schemas: Json = {"Error": _ERROR}
        self._messages: dict[str, DescriptorProto] = {}
        self._enums: dict[str, Json] = {}
        self._comments: dict[str, str] = {}
        files = [file for file in contract.file if not file.name.startswith("google/protobuf/")]
        for file in files:
            self._read(file)
        self._paths: Json = {path: _plain(path, *about) for path, about in _PLAIN.items()}
        for file in files:
            for service in file.service:
                for method in service.method:
                    path = f"/{file.package}.{service.name}/{method.name}"
                    self._paths[path] = self._path(service.name, method, self._comments[path])
        self._version = version

    def json(self) -> Json:
        """The whole."""
        return {
            "openapi": "3.1.0",
            "info": {"title": "contactd", "version": self._version, "description": _ABOUT,
                     "license": {"name": "Apache-2.0", "identifier": "Apache-2.0"}},
            "servers": [{"url": "/"}],
            "security": [{}, {"token": []}],
            "paths": self._paths,
            "components": {
                "schemas": dict(sorted(self._schemas.items())),
                "securitySchemes": {"token": {"type": "http", "scheme": "bearer"}},
                "parameters": {"timeout": {
                    "name": "connect-timeout-ms", "in": "header", "description": "How long the caller waits.",
                    "schema": {"type": "integer", "minimum": 0, "maximum": 9_999_999_999}}},
                "responses": {"failed": {"description": "The call failed.",
                                         "content": _in_json({"$ref": "#/components/schemas/Error"})}}}}

    def _read(self, file: descriptor_pb2.FileDescriptorProto) -> None:
        """Notes what there is, with its comment."""
        comments = {tuple(place.path): _prose(place.leading_comments)
                    for place in file.source_code_info.location}
        package = f".{file.package}"
        for place, enum in enumerate(file.enum_type):
            self._read_enum(f"{package}.{enum.name}", enum, comments, (_ENUM_IN_FILE, place))
        for place, message in enumerate(file.message_type):
            self._read_message(f"{package}.{message.name}", message, comments, (_MESSAGE, place))
        for place, service in enumerate(file.service):
            for number, method in enumerate(service.method):
                path = f"/{file.package}.{service.name}/{method.name}"
                self._comments[path] = comments.get((_SERVICE, place, _METHOD, number), "")

    def _read_message(self, name: str, message: DescriptorProto, comments: dict[tuple[int, ...], str],
                      path: tuple[int, ...]) -> None:
        self._messages[name] = message
        self._comments[name] = comments.get(path, "")
        for place, field in enumerate(message.field):
            self._comments[f"{name}.{field.name}"] = comments.get((*path, _FIELD, place), "")
        for place, enum in enumerate(message.enum_type):
            self._read_enum(f"{name}.{enum.name}", enum, comments, (*path, _ENUM, place))
        for place, inner in enumerate(message.nested_type):
            self._read_message(f"{name}.{inner.name}", inner, comments, (*path, _NESTED, place))

    def _read_enum(self, name: str, enum: descriptor_pb2.EnumDescriptorProto,
                   comments: dict[tuple[int, ...], str], path: tuple[int, ...]) -> None:
        about = [f"* `{value.name}`: {' '.join(comments.get((*path, _VALUE, place), '').split())}"
                 for place, value in enumerate(enum.value)]
        self._enums[name] = {"type": "string", "enum": [value.name for value in enum.value],
                             "description": "\n".join([comments.get(path, ""), "", *about]).strip()}

    def _path(self, service: str, method: descriptor_pb2.MethodDescriptorProto, about: str) -> Json:
        """A call: by POST, and by GET if it changes nothing and is no stream."""
        request, answer = self._ref(method.input_type), self._ref(method.output_type)
        stream = method.server_streaming
        operation: Json = {
            "operationId": f"{service}.{method.name}", "tags": [service],
            "summary": about.partition("\n\n")[0].split(". ")[0].replace("\n", " ").rstrip("."),
            "description": about, "parameters": [{"$ref": "#/components/parameters/timeout"}],
            "responses": {"200": {"description": "Frames." if stream else "The answer.",
                                  "content": _frames(answer) if stream else _in_json(answer)}}}
        if not stream:
            operation["responses"]["default"] = {"$ref": "#/components/responses/failed"}
        path = {"post": {**operation, "requestBody": {
            "required": True, "content": _frames(request) if stream else _in_json(request)}}}
        if not stream and method.options.idempotency_level == MethodOptions.NO_SIDE_EFFECTS:
            path["get"] = {**operation, "operationId": f"{service}.{method.name}.get", "parameters": [
                *operation["parameters"], *_query(request)]}
        return path

    def _ref(self, type_: str) -> Json:
        """The schema of a message or enum by its full name, which begins with a dot."""
        if type_ in _WELL_KNOWN:
            return dict(_WELL_KNOWN[type_])
        name = type_.removeprefix(".").removeprefix("contact.v1.")
        if name not in self._schemas:
            self._schemas[name] = {}  # Messages may hold themselves.
            self._schemas[name] = self._enums.get(type_) or self._object(type_)
        return {"$ref": f"#/components/schemas/{name}"}

    def _object(self, name: str) -> Json:
        message = self._messages[name]
        properties = {field.json_name: self._property(name, field) for field in message.field}
        schema: Json = {"type": "object", "description": self._comments[name],
                        "properties": properties, "additionalProperties": False}
        required = [field.json_name for field in message.field if _rule(field).required]
        if required:
            schema["required"] = required
        choices = list(self._choices(name))
        if choices:
            schema["allOf"] = choices
        return schema

    def _choices(self, name: str, always: bool = False) -> Iterator[Json]:
        """Of each oneof at most one field is set, or exactly one."""
        message = self._messages[name]
        for place, group in enumerate(message.oneof_decl):
            fields = [field.json_name for field in message.field if not field.proto3_optional
                      and field.HasField("oneof_index") and field.oneof_index == place]
            one = [{"required": [field]} for field in fields]
            must = group.options.Extensions[field_rules_pb2.choice_required]
            if must and (always or name != f".{_WITHOUT_CHOICE}"):
                yield {"oneOf": one}
            elif len(one) > 1 and not always:
                yield {"oneOf": [*one, {"not": {"anyOf": one}}]}

    def _property(self, owner: str, field: Field) -> Json:
        """The schema of a field, with its rules."""
        rule, about = _rule(field), self._comments[f"{owner}.{field.name}"]
        entry = self._messages.get(field.type_name)
        if entry is not None and entry.options.map_entry:
            schema = {"type": "object", "additionalProperties": self._value(entry.field[1])}
            _limit(schema, "Properties", rule)
        elif field.label == Field.LABEL_REPEATED:
            schema = {"type": "array", "items": self._ruled(field, rule)}
            _limit(schema, "Items", rule)
        else:
            schema = self._ruled(field, rule)
        if rule.required and field.type_name == f".{_WITHOUT_CHOICE}":
            schema = {"allOf": [schema, *self._choices(field.type_name, always=True)]}
        notes = [about, _in_words(field, rule)]
        return {**schema, "description": "\n\n".join(filter(None, notes))}

    def _value(self, field: Field) -> Json:
        return self._ref(field.type_name) if field.type_name else dict(_SCALARS[field.type])

    def _ruled(self, field: Field, rule: field_rules_pb2.FieldRule) -> Json:
        """One value within its range."""
        schema = self._value(field)
        low = rule.WhichOneof("low")
        if field.type_name:  # The bounds of a duration are seconds: they stand in words.
            return schema
        if low:
            schema["minimum" if low == "min" else "exclusiveMinimum"] = getattr(rule, low)
        if rule.HasField("max"):
            schema["maximum"] = rule.max
        if rule.max_characters:
            schema["maxLength"] = rule.max_characters
        if rule.WhichOneof("default") == "default_number" and field.label != Field.LABEL_REPEATED:
            schema["default"] = rule.default_number
        if rule.may_be_nan:
            return {"anyOf": [schema, {"const": "NaN"}]}
        return schema


def _rule(field: Field) -> field_rules_pb2.FieldRule:
    rule: field_rules_pb2.FieldRule = field.options.Extensions[field_rules_pb2.rule]
    return rule


def _limit(schema: Json, what: str, rule: field_rules_pb2.FieldRule) -> None:
    least = max(rule.min_entries, int(rule.required))
    if least:
        schema[f"min{what}"] = least
    if rule.max_entries:
        schema[f"max{what}"] = rule.max_entries


def _in_words(field: Field, rule: field_rules_pb2.FieldRule) -> str:
    """What no constraint says: units, the bounds of a duration, defaults."""
    words = [f"Unit: {rule.unit}."] if rule.unit else []
    low = rule.WhichOneof("low")
    if field.type_name and low:
        words.append(f"{'At least' if low == 'min' else 'More than'} {getattr(rule, low):.15g} s.")
    if field.type_name and rule.HasField("max"):
        words.append(f"At most {rule.max:.15g} s.")
    kind = rule.WhichOneof("default")
    if kind:
        value = getattr(rule, kind)
        words.append(f"Default: {f'{value:.15g}' if kind == 'default_number' else value}.")
    return " ".join(words)


def _prose(comment: str) -> str:
    return "\n".join(line.removeprefix(" ") for line in comment.splitlines()).strip()


def _in_json(schema: Json) -> Json:
    return {"application/json": {"schema": schema}}


def _frames(message: Json) -> Json:
    """Frames that hold such messages."""
    return {"application/connect+json": {"schema": {
        "type": "string", "contentMediaType": "application/connect+json",
        "description": "Frames, each with such a message in JSON.", "x-message": message}}}


def _query(request: Json) -> list[Json]:
    """The parameters of a GET."""
    return [{"name": "message", "in": "query", "required": True, "content": _in_json(request)},
            {"name": "encoding", "in": "query", "required": True, "schema": {"const": "json"}}]


def _plain(path: str, about: str, media: str, statuses: tuple[int, ...]) -> Json:
    content = {media: {"schema": {"type": "string" if media == "text/plain" else "object"}}}
    return {"get": {"operationId": re.sub(r"\W", "_", path.strip("/")), "summary": about.rstrip("."),
                    "security": [{}],
                    "responses": {str(status): {"description": about, "content": content}
                                  for status in statuses}}}


def cpp(text: str) -> str:
    """A source that defines OpenApiDocument, in literals below the 64 KiB that compilers must take."""
    assert ')json"' not in text
    parts = [text[start:start + 16_000] for start in range(0, len(text), 16_000)]
    literals = ",\n".join(f'R"json({part})json"' for part in parts)
    return f"""#include "gateway/openapi/openapi.h"

#include <string>

namespace contact::gateway {{

std::string_view OpenApiDocument() {{
  static const std::string document = [] {{
    constexpr std::string_view kParts[] = {{{literals}}};
    std::string text;
    for (const std::string_view part : kParts) text += part;
    return text;
  }}();
  return document;
}}

}}  // namespace contact::gateway
"""


def main(contract: str, version: str, output: str) -> None:
    """Writes the document."""
    files = descriptor_pb2.FileDescriptorSet.FromString(pathlib.Path(contract).read_bytes())
    text = json.dumps(Document(files, version).json(), ensure_ascii=False, separators=(",", ":"))
    pathlib.Path(output).write_text(cpp(text) if output.endswith(".cpp") else text, "utf-8")


if __name__ == "__main__":
    main(*sys.argv[1:])
