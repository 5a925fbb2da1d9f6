"""Whatever a server says, nothing that contactctl prints steers the terminal."""

import concurrent.futures
import json
import unittest

import grpc
from cli_case import CHAIN, CliTest, SCENARIOS
from contact.v1 import job_pb2, job_service_pb2, job_service_pb2_grpc

# C0, delete, C1, and what separates lines or turns the direction of a text.
CODES = [*range(1, 32), 127, *range(128, 160), 0x61c, 0x200e, 0x200f, *range(0x2028, 0x202f),
         *range(0x2066, 0x206a)]
SILENT = ("watch", "compare")  # Verbs that show none of these texts.
EVIL = "begin" + "".join(map(chr, CODES)) + "end"


def taint(message):
    """Puts the characters into every text for people of the jobs in an answer."""
    for field, value in message.ListFields():
        if field.message_type and not field.message_type.GetOptions().map_entry:
            for inner in value if field.label == field.LABEL_REPEATED else [value]:
                taint(inner)
    if isinstance(message, job_pb2.Job):
        message.title = EVIL
        message.warnings.append(EVIL)
        message.error.message = EVIL
        if message.HasField("scenario"):
            message.scenario.title = EVIL
    return message


class Liar(job_service_pb2_grpc.JobServiceServicer):
    """Answers as a server does, but for the texts."""

    def __init__(self, stub):
        for method in job_service_pb2.DESCRIPTOR.services_by_name["JobService"].methods:
            call = getattr(stub, method.name)
            setattr(self, method.name, self.stream(call) if method.server_streaming
                    else self.unary(call))

    def unary(self, call):
        return lambda request, context: taint(call(request))

    def stream(self, call):
        def answer(request, context):
            for message in call(request):
                yield taint(message)
        return answer


class ControlCharactersTest(CliTest):

    def setUp(self):
        super().setUp()
        liar = grpc.server(concurrent.futures.ThreadPoolExecutor(4))
        job_service_pb2_grpc.add_JobServiceServicer_to_server(Liar(self.server.stub), liar)
        port = liar.add_insecure_port("127.0.0.1:0")
        liar.start()
        self.addCleanup(liar.stop, 0)
        self.liar = f"127.0.0.1:{port}"

    def assertHarmless(self, *arguments):
        out, err = self.run_it(*arguments, server=self.liar, code=None)
        self.assertNotIn("--help", err, f"{arguments} was refused")
        self.assertEqual("begin" in out + err, arguments[0] not in SILENT, arguments)
        self.assertNoneIn(out + err, arguments)
        return out

    def assertNoneIn(self, text, source):
        found = {hex(ord(c)) for c in text if ord(c) in CODES and c != "\n"}
        self.assertEqual(found, set(), source)

    def test_no_printer_lets_one_through(self):
        name = self.run_it("run", CHAIN, "-o", "name")[0].strip()
        sweep = self.run_it("sweep", "run", SCENARIOS / "table-3-sweep.yaml", "-o", "name")[0].strip()
        for words in (["describe", name], ["describe", name, "-o", "yaml"], ["list"],
                      ["list", "-o", "csv"], ["list", "-o", "json"], ["list", "-o", "yaml"],
                      ["watch", name], ["watch", name, "-o", "jsonl"], ["run", CHAIN],
                      ["submit", CHAIN, "-o", "json"], ["describe", sweep],
                      ["export", name, "-o", "csv", "--comments"],
                      ["compare", name, name]):
            with self.subTest(words=words):
                self.assertHarmless(*words)
        for verb in (["plot", name, "force", "-o", "force.pgf"],
                     ["plot", name, "force", "-o", "force.svg"], ["report", name, "-f", "run.html"]):
            path = self.folder / verb.pop()
            self.run_it(*verb, path, server=self.liar)
            text = path.read_text("utf-8")
            self.assertIn("begin", text, path)
            self.assertNoneIn(text, path)
        shown = json.loads(self.assertHarmless("describe", name, "-o", "json"))
        self.assertEqual(shown["title"], EVIL, "escaped, not changed")


if __name__ == "__main__":
    unittest.main()
