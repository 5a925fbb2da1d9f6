"""Requests that are too large in every way: the right code, little memory, and life goes on."""

import time
import unittest

import grpc
import http2
from contact.v1 import job_service_pb2, job_service_pb2_grpc
from contactd import PATIENCE_S, Job, ServerTest, details_of, three_ball_chain

LIMIT = 1 << 20  # Of a message.
MOST_GROWTH = 64 << 20
SLACK = 5  # A machine so many times slower must pass too.
CREATE = "/contact.v1.JobService/CreateJob"
INFO = "/contact.v1.JobService/GetServerInfo"


def field(number, content):
    """A length-delimited protobuf field."""
    def varint(value):
        out = b""
        while value > 127:
            out += bytes([value & 127 | 128])
            value >>= 7
        return out + bytes([value])
    return varint(number << 3 | 2) + varint(len(content)) + content


class OversizeTest(ServerTest):

    flags = (f"--max-message-bytes={LIMIT}", f"--max-rpc-memory-bytes={32 << 20}")

    def setUp(self):
        super().setUp()
        for _ in range(3):  # What a first call takes is no growth.
            self.server.create(three_ball_chain(), validate_only=True)
        self.base = self.memory("VmRSS")

    def memory(self, kind):
        """In bytes; VmHWM is the most there ever was."""
        with open(f"/proc/{self.server.process.pid}/status") as status:
            line = next(line for line in status if line.startswith(kind))
        return int(line.split()[1]) * 1024

    def call(self, message, method=CREATE, **keywords):
        """Code of a call with these bytes as its message."""
        call = self.server.channel.unary_unary(method, request_serializer=bytes)
        try:
            call(message, timeout=PATIENCE_S, **keywords)
        except grpc.RpcError as error:
            return error.code()
        return grpc.StatusCode.OK

    def assertLivesOn(self):
        growth = self.memory("VmHWM") - self.base
        start = time.monotonic()
        options = [("grpc.use_local_subchannel_pool", 1)]  # The old one may have been cut.
        with grpc.insecure_channel(f"127.0.0.1:{self.server.port}", options) as channel:
            job_service_pb2_grpc.JobServiceStub(channel).GetServerInfo(
                job_service_pb2.GetServerInfoRequest(), timeout=PATIENCE_S)
        took = time.monotonic() - start
        print(f"{self.id().rsplit('.', 1)[-1]}: {growth / 2**20:.1f} MiB more at most, "
              f"then an answer in {1000 * took:.1f} ms")
        self.assertLess(growth, MOST_GROWTH)
        self.assertLess(took, 0.1 * SLACK)

    def request(self, size):
        """A valid request of exactly so many bytes, the rest in a field we do not know."""
        known = job_service_pb2.CreateJobRequest(
            job=Job(scenario=three_ball_chain()), validate_only=True).SerializeToString()
        request = known + field(1000, bytes(size - len(known) - 5))
        self.assertEqual(len(request), size)
        return request

    def test_message_at_the_limit_is_taken_and_past_it_refused(self):
        for size, code in ((LIMIT - 1, grpc.StatusCode.OK), (LIMIT, grpc.StatusCode.OK),
                           (LIMIT + 1, grpc.StatusCode.RESOURCE_EXHAUSTED)):
            self.assertEqual(self.call(self.request(size)), code, size)
        self.assertLivesOn()

    def test_message_of_60_megabytes_is_refused(self):
        self.assertEqual(self.call(bytes(60 << 20)), grpc.StatusCode.RESOURCE_EXHAUSTED)
        self.assertLivesOn()

    def test_bytes_that_are_no_message_are_an_invalid_argument(self):
        for method in job_service_pb2.DESCRIPTOR.services_by_name["JobService"].methods:
            with self.subTest(method.name):
                channel = self.server.channel
                kind = channel.unary_stream if method.server_streaming else channel.unary_unary
                call = kind(f"/contact.v1.JobService/{method.name}")
                with self.assertRaises(grpc.RpcError) as caught:
                    answer = call(b"\x0a\xff", timeout=PATIENCE_S)
                    for _ in answer if method.server_streaming else ():
                        pass
                self.assertEqual(caught.exception.code(), grpc.StatusCode.INVALID_ARGUMENT)
                self.assertEqual(details_of(caught.exception)["ErrorInfo"].reason, "FIELD_INVALID")

    def test_compressed_message_is_refused_unseen(self):
        bomb = bytes(100 << 20)  # Some 100 KB on the way.
        self.assertEqual(self.call(bomb, compression=grpc.Compression.Gzip),
                         grpc.StatusCode.UNIMPLEMENTED)
        self.assertLivesOn()

    def test_million_of_empty_bodies_is_refused(self):
        self.assertManyAreRefused(2)

    def test_million_of_empty_contacts_is_refused(self):
        self.assertManyAreRefused(3)

    def assertManyAreRefused(self, entry):
        """Two bytes each, hundreds once they are parsed, which only the last ones are."""
        for count, code in ((10**6, grpc.StatusCode.RESOURCE_EXHAUSTED),
                            (LIMIT // 2 - 20, grpc.StatusCode.INVALID_ARGUMENT),
                            (327_677, grpc.StatusCode.INVALID_ARGUMENT)):  # And job and scenario.
            scenario = field(entry, b"") * count
            self.assertEqual(self.call(field(1, field(2, scenario))), code)
        self.assertLivesOn()

    def test_nesting_is_limited(self):
        """Unknown groups: protobuf takes 100 levels."""
        start, end = b"\xc3\x3e", b"\xc4\x3e"  # Of field 1000.
        for depth, code in ((99, grpc.StatusCode.INVALID_ARGUMENT),
                            (101, grpc.StatusCode.INVALID_ARGUMENT)):
            self.assertEqual(self.call(start * depth + end * depth), code, depth)
        self.assertLivesOn()

    def test_large_metadata_is_refused(self):
        refused = (grpc.StatusCode.RESOURCE_EXHAUSTED,)
        # Past 128 KiB the server hangs up; whether the client reads an answer before the end is a
        # race that no server can decide.
        cut = (*refused, grpc.StatusCode.UNAVAILABLE)
        for size, codes in ((7000, (grpc.StatusCode.OK,)), (9 << 10, refused), (1 << 20, cut)):
            self.assertIn(self.call(b"", INFO, metadata=[("note", "x" * size)]), codes, size)
        self.assertLivesOn()

    def test_large_metadata_of_a_client_that_ignores_settings_is_refused(self):
        """It sends more than the settings of the server allow."""
        for size in (9 << 10, 1 << 20):
            answer = self.rude_call(size)
            self.assertNotEqual(answer.get("grpc-status"), "0")  # Refused, or cut off.
            if size == 9 << 10:
                self.assertIn("bytes of metadata; at most 8192 are taken", answer["grpc-message"])
        self.assertLivesOn()

    def rude_call(self, size):
        """The headers of the answer to a call with so much metadata, the server's settings unanswered.
        Empty: none came."""
        out = http2.headers(1, INFO, (b"note", b"x" * size)) + http2.message(1)
        with http2.greet(self.server.port) as connection:
            try:
                connection.sendall(out)
                return http2.read_headers(connection)
            except OSError:  # Cut off, or nothing more to hear.
                return {}


if __name__ == "__main__":
    unittest.main()
