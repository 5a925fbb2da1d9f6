"""A server that writes what steers a terminal into every text: none of it reaches the terminal."""

import concurrent.futures
import os
import pty
import re
import subprocess
import unittest

import grpc
from cli_case import CHAIN, CONTACTCTL
from contact.v1 import event_pb2, job_pb2, job_service_pb2, job_service_pb2_grpc
from google.protobuf.descriptor import FieldDescriptor
from google.rpc import error_details_pb2, status_pb2

HOSTILE = "pwn\x1b]0;pwn\x07\x1b[31m\x1b[2J\u202e\u009b"
PATIENCE_S = 60
# What contactctl itself sends to a terminal: its five tones, and the erasing of its own line.
OWN = re.compile(rb"\x1b\[(0|1|2|31|32|33)m|\r?\x1b\[K|\r\n")
STEERS = re.compile("[\x00-\x08\x0b-\x1f\x7f-\x9f\u061c\u200e\u200f\u2028-\u202e\u2066-\u2069]")


def fill(message, depth=0):
    """Puts the hostile text into every text of a message."""
    for field in message.DESCRIPTOR.fields:
        if field.message_type and field.message_type.GetOptions().map_entry:
            if field.message_type.fields_by_name["value"].type == FieldDescriptor.TYPE_STRING:
                getattr(message, field.name)[HOSTILE] = HOSTILE
        elif field.type == FieldDescriptor.TYPE_STRING:
            if field.label == FieldDescriptor.LABEL_REPEATED:
                getattr(message, field.name).append(HOSTILE)
            else:
                setattr(message, field.name, HOSTILE)
        elif field.message_type and depth < 6 and not (
                field.containing_oneof and message.WhichOneof(field.containing_oneof.name)):
            part = getattr(message, field.name)
            if field.label == FieldDescriptor.LABEL_REPEATED:
                fill(part.add(), depth + 1)
            elif not field.message_type.full_name.startswith("google."):
                part.SetInParent()
                fill(part, depth + 1)
    return message


def add_events(message):
    """One event of each kind, and the end."""
    for field in event_pb2.Event.DESCRIPTOR.oneofs_by_name["payload"].fields:
        event = message.events.add(sequence=len(message.events) + 1)
        getattr(event, field.name).SetInParent()
        fill(getattr(event, field.name))
    message.events.add(sequence=99).state_changed.state = job_pb2.Job.FAILED


class Hostile(job_service_pb2_grpc.JobServiceServicer):
    """Answers all calls with hostile texts, or fails all with them."""

    def __init__(self, fails):
        self.fails = fails
        for method in job_service_pb2.DESCRIPTOR.services_by_name["JobService"].methods:
            setattr(self, method.name, self.answer(method))

    def answer(self, method):
        def unary(request, context):
            self.refuse(context)
            message = fill(method.output_type._concrete_class())
            if method.output_type.full_name == "contact.v1.Job":
                message.state = job_pb2.Job.FAILED
            return message

        def stream(request, context):
            self.refuse(context)
            message = method.output_type._concrete_class()
            if method.name == "WatchJob":
                add_events(message)
            else:
                fill(message)
            yield message
        return stream if method.server_streaming else unary

    def refuse(self, context):
        if not self.fails:
            return
        details = status_pb2.Status()
        for kind in (error_details_pb2.ErrorInfo, error_details_pb2.BadRequest):
            details.details.add().Pack(fill(kind()))
        context.set_trailing_metadata(
            [("grpc-status-details-bin", details.SerializeToString())])
        context.abort(grpc.StatusCode.FAILED_PRECONDITION, HOSTILE)


class HostileServerTest(unittest.TestCase):
    JOB = "eh0scma960"
    VERBS = (
        ("list",), ("list", "-o", "wide"), ("list", "-o", "csv"), ("describe", JOB),
        ("watch", JOB), ("submit", CHAIN), ("run", CHAIN), ("run", "--like", JOB),
        ("cancel", JOB), ("delete", JOB), ("label", JOB, "n=1"), ("series", JOB), ("series", JOB, "-o", "csv"),
        ("artifact", "list", JOB), ("export", JOB, "-o", "csv", "--table", "cycles"),
        ("sweep", "describe", JOB), ("sweep", "export", JOB), ("sweep", "cell", JOB, "0"),
        ("server", "status"), ("doctor",), ("open", JOB), ("compare", JOB, JOB),
        ("plot", JOB, "hysteresis", "-o", "txt"), ("validate", CHAIN, "--server-too"),
    )

    def serve(self, fails):
        server = grpc.server(concurrent.futures.ThreadPoolExecutor(8))
        job_service_pb2_grpc.add_JobServiceServicer_to_server(Hostile(fails), server)
        self.address = f"127.0.0.1:{server.add_insecure_port('127.0.0.1:0')}"
        server.start()
        self.addCleanup(server.stop, None)

    def run_it(self, *verb, terminal=False):
        """What the verb writes, to a pipe or to a terminal."""
        command = [CONTACTCTL, "--server", self.address, "--timeout", "5s", *map(str, verb)]
        environment = os.environ | {"BROWSER": "true", "TERM": "xterm", "LC_ALL": "C.UTF-8"}
        if not terminal:
            run = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                                 stdin=subprocess.DEVNULL, env=environment, timeout=PATIENCE_S)
            return run.stdout
        master, slave = pty.openpty()
        process = subprocess.Popen(command, stdin=slave, stdout=slave, stderr=slave,
                                   env=environment)
        os.close(slave)
        written = b""
        while True:
            try:
                part = os.read(master, 1 << 16)
            except OSError:  # The other end is closed.
                break
            written += part
        os.close(master)
        process.wait(PATIENCE_S)
        return OWN.sub(b"", written)

    def check(self, fails):
        self.serve(fails)
        telling = 0
        for verb in self.VERBS:
            for terminal in (False, True):
                with self.subTest(verb=verb, terminal=terminal):
                    text = self.run_it(*verb, terminal=terminal).decode()
                    self.assertEqual(STEERS.findall(text), [], text)
                    telling += "pwn" in text
        return telling

    def test_no_answer_steers_the_terminal(self):
        self.assertGreater(self.check(fails=False), len(self.VERBS))

    def test_no_error_steers_the_terminal(self):
        self.assertGreater(self.check(fails=True), len(self.VERBS))

    def test_no_json_steers_the_terminal(self):
        self.serve(fails=False)
        for verb in self.VERBS:
            for form in ("json", "yaml"):
                with self.subTest(verb=verb, form=form):
                    text = self.run_it(*verb, "-o", form).decode()
                    self.assertEqual(STEERS.findall(text), [], text)


if __name__ == "__main__":
    unittest.main()
