"""The contract keeps what was accepted: proto/accepted.txt has a line for each message, field, value
and call, and none of them may go or change, for clients that were built with it would break.

With the argument `update` new lines are added; lines that are gone stay, and fail.
"""

import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

from google.protobuf import descriptor_pb2

PROTO = pathlib.Path(__file__).parents[1] / "proto"
ACCEPTED = PROTO / "accepted.txt"
Field = descriptor_pb2.FieldDescriptorProto


def descriptors(proto):
    """The files of contact.v1 in the folder `proto`, as protoc reads them."""
    with tempfile.NamedTemporaryFile() as out:
        files = sorted((proto / "contact" / "v1").glob("*.proto"))
        subprocess.run(["protoc", f"-I{proto}", f"--descriptor_set_out={out.name}", *files],
                       check=True)
        return descriptor_pb2.FileDescriptorSet.FromString(pathlib.Path(out.name).read_bytes()).file


def field_line(message, at, field):
    kind = field.type_name.lstrip(".") or Field.Type.Name(field.type)[5:].lower()
    label = Field.Label.Name(field.label)[6:].lower()
    words = [f"field {at}.{field.name} = {field.number}: {kind}"]
    if label != "optional" or field.proto3_optional:
        words.append(label)
    if field.HasField("oneof_index") and not field.proto3_optional:
        words.append(f"of {message.oneof_decl[field.oneof_index].name}")
    return ", ".join(words)


def enum_lines(scope, enum):
    for value in enum.value:
        yield f"value {scope}.{enum.name}.{value.name} = {value.number}"


def message_lines(scope, message):
    at = f"{scope}.{message.name}"
    yield f"message {at}"
    yield from (field_line(message, at, field) for field in message.field)
    for enum in message.enum_type:
        yield from enum_lines(at, enum)
    for inner in message.nested_type:
        yield from message_lines(at, inner)


def call_line(service, call):
    def stream(on):
        return "stream " if on else ""
    return (f"call {service}.{call.name}: {stream(call.client_streaming)}{call.input_type[1:]} -> "
            f"{stream(call.server_streaming)}{call.output_type[1:]}")


def lines(proto):
    for file in descriptors(proto):
        for message in file.message_type:
            yield from message_lines(file.package, message)
        for enum in file.enum_type:
            yield from enum_lines(file.package, enum)
        for service in file.service:
            yield from (call_line(f"{file.package}.{service.name}", call)
                        for call in service.method)


def accepted():
    return ACCEPTED.read_text("utf-8").splitlines()


def broken(proto):
    """What was accepted and is not so any more."""
    return sorted(set(accepted()) - set(lines(proto)))


class ContractTest(unittest.TestCase):

    def test_nothing_that_was_accepted_has_gone_or_changed(self):
        self.assertEqual(broken(PROTO), [])

    def test_what_is_new_is_accepted_too(self):
        self.assertEqual(sorted(set(lines(PROTO)) - set(accepted())), [],
                         "python3 tests/contract_test.py update")

    def after(self, file, old, new):
        """What would be broken by this change of a file."""
        with tempfile.TemporaryDirectory() as folder:
            copy = pathlib.Path(folder) / "proto"
            shutil.copytree(PROTO, copy)
            path = copy / "contact" / "v1" / file
            text = path.read_text("utf-8")
            self.assertEqual(text.count(old), 1, old)
            path.write_text(text.replace(old, new), "utf-8")
            return broken(copy)

    def test_changes_that_break_clients_are_seen(self):
        steps = "field contact.v1.Estimate.steps = 1: int64"
        for old, new, line in (
                ("  int64 steps = 1;\n  // Rows", "  // Rows", steps),
                ("  int64 steps = 1;\n  // Rows", "  int64 steps = 101;\n  // Rows", steps),
                ("  int64 steps = 1;\n  // Rows", "  int64 paces = 1;\n  // Rows", steps),
                ("  int64 steps = 1;\n  // Rows", "  double steps = 1;\n  // Rows", steps),
                ("  int64 steps = 1;\n  // Rows", "  repeated int64 steps = 1;\n  // Rows", steps)):
            with self.subTest(new):
                self.assertEqual(self.after("job.proto", old, new), [line])

    def test_a_new_field_breaks_nothing(self):
        self.assertEqual(self.after("job.proto", "  int64 steps = 1;\n  // Rows",
                                    "  int64 steps = 1;\n  int64 fresh = 99;\n  // Rows"), [])


if __name__ == "__main__":
    if sys.argv[1:] == ["update"]:
        ACCEPTED.write_text("".join(f"{line}\n" for line in dict.fromkeys([*accepted(),
                                                                          *lines(PROTO)])), "utf-8")
    else:
        unittest.main()
