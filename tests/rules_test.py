"""Rules of the C++ sources that no compiler checks: time comes from the injected clock, and unit
tests do not sleep."""

import pathlib
import re
import unittest

ROOT = pathlib.Path(__file__).resolve().parent.parent

# Files of the server that may read a clock of their own, and why.
OWN_CLOCK = {
    "server/base/clock.cpp": "is the clock",
    "server/self_probe.cpp": "deadlines of calls are gRPC's, in system time",
    "server/gateway/call/rpc_call.cpp": "deadlines of calls are gRPC's, in system time",
    "server/gateway/dispatch.cpp": "limits what real sockets do in real time",
    "server/gateway/net/socket.cpp": "limits what real sockets do in real time",
    "server/gateway/http1/connection.cpp": "limits what real sockets do in real time",
    "server/gateway/http2/connection.cpp": "limits what real sockets do in real time",
    "server/gateway/http2/callbacks.cpp": "limits what real sockets do in real time",
    "server/gateway/http2/stream.cpp": "limits what real sockets do in real time",
    "server/gateway/http2/turns.cpp": "waits on a timer of Asio until a real instant",
    "server/rpc/grpc_server.cpp": "gRPC takes the deadline of its shutdown as system time",
    "server/rpc/grpc_log.cpp": "gRPC logs before there is a server to inject a clock into",
    "server/rpc/shutdown_timer.cpp": "waits on a condition until a real instant",
    "server/rpc/call/call_guard.cpp": "deadlines of calls are gRPC's, in system time",
    "server/rpc/metrics/call_monitor.cpp": "gRPC makes the interceptors of calls itself",
    "server/rpc/stream/stream_loop.cpp": "waits on a condition until a real instant",
    "server/rpc/stream/stream_reactor.h": "waits for real sockets",
}
# Tests that may sleep, and why.
SLEEPS = {
    "tests/rpc/watch_stream_test.cpp": "plays clients that stall on real sockets",
    "tests/testing/await.h": "polls what sockets, gRPC and a store at rest tell nobody",
}
# Programs that measure or load a server from outside: no unit tests.
NOT_UNIT = ("tests/benchmark/", "tests/fault/")

NOW = re.compile(r"\b(steady|system|high_resolution)_clock::now\(")
SLEEP = re.compile(r"\b(sleep_for|sleep_until|usleep|nanosleep)\(")
# Readers of the libraries that write exports: hostile files have overwritten memory in them.
READER = re.compile(r"\b(nc_open|nc_open_mem|H5Fopen|Mat_Open|H5::H5File)\(")


def sources(folder):
    """Path from the root -> text of every C++ file in the folder."""
    return {
        str(path.relative_to(ROOT)): path.read_text("utf-8")
        for ending in ("*.h", "*.cpp")
        for path in sorted((ROOT / folder).rglob(ending))
    }


def lines_with(pattern, files):
    """Every line with the pattern, as file:number."""
    return [
        f"{path}:{number}"
        for path, text in files.items()
        for number, line in enumerate(text.splitlines(), 1)
        if pattern.search(line)
    ]


def without(exceptions, found):
    return [place for place in found if place.rsplit(":", 1)[0] not in exceptions]


class RulesTest(unittest.TestCase):
    def test_server_reads_time_only_from_the_injected_clock(self):
        self.assertEqual(without(OWN_CLOCK, lines_with(NOW, sources("server"))), [])

    def test_unit_tests_do_not_sleep(self):
        files = {path: text for path, text in sources("tests").items()
                 if not path.startswith(NOT_UNIT)}
        self.assertEqual(without(SLEEPS, lines_with(SLEEP, files)), [])

    def test_exceptions_are_outside_of_the_rooms_that_compute(self):
        rooms = ("server/simulation/", "server/wire/", "server/storage/", "server/jobs/")
        self.assertEqual([path for path in OWN_CLOCK if path.startswith(rooms)], [])

    def test_no_file_of_hdf5_netcdf_or_matlab_is_read(self):
        files = sources("server") | sources("client/cli")
        self.assertEqual(lines_with(READER, files), [])
        self.assertEqual(len(lines_with(re.compile(r"\b(nc_create|Mat_CreateVer)\("), files)), 2,
                         "this test has gone blind")

    def test_a_line_that_breaks_a_rule_is_found(self):
        files = {"a.cpp": "int x;\nauto t = std::chrono::steady_clock::now();\n",
                 "b.cpp": "std::this_thread::sleep_for(1s);\n"}
        self.assertEqual(lines_with(NOW, files), ["a.cpp:2"])
        self.assertEqual(lines_with(SLEEP, files), ["b.cpp:1"])
        self.assertEqual(without({"a.cpp": "why"}, ["a.cpp:2", "b.cpp:1"]), ["b.cpp:1"])


if __name__ == "__main__":
    unittest.main()
