"""One client that sends frames as fast as it can, and reads no answer.

  flooding.py PORT SECONDS KIND [JOB]

Begins anew whenever the server has ended the connection. Prints how many batches it sent, and on how
many connections. A program of its own: a test that forks beside gRPC's threads may hang.
"""

import contextlib
import itertools
import struct
import subprocess
import sys
import time

import http2

INFO = "/contact.v1.JobService/GetServerInfo"
WATCH = "/contact.v1.JobService/WatchJob"


def always(batch):
    return lambda number: batch


def after(start, batch):
    """A batch again and again, once something has begun."""
    return lambda number: batch if number else start


def resets(method, content):
    """Calls that are taken back at once, streams of their connection in turn."""
    def frames(number):
        first = 100 * number
        return b"".join(
            http2.headers(stream, method) + http2.message(stream, content) +
            http2.frame(http2.RST_STREAM, 0, stream, struct.pack(">I", 8))
            for stream in range(2 * first + 1, 2 * first + 201, 2))
    return frames


def unread(number):
    """Calls whose answers are not read. No setting of the server is confirmed, so gRPC lets streams
    be opened without end."""
    return b"".join(http2.headers(stream, INFO) + http2.message(stream)
                    for stream in range(200 * number + 1, 200 * number + 201, 2))


def watch_of(job):
    from contact.v1 import job_service_pb2  # The other kinds need no messages.
    return job_service_pb2.WatchJobRequest(name=job).SerializeToString()


BEGIN = http2.frame(http2.HEADERS, 0, 1, http2.header(b":method", b"POST"))
# No setting of the server is confirmed, so gRPC bounds no header.
LONG_HEADER = http2.frame(http2.CONTINUATION, 0, 1, http2.header(b"n", b"x" * 1000) * 16) * 4

# What a kind sends: bytes of a batch by the number of the batch in its connection.
KINDS = {
    "PING": lambda job: always(http2.frame(http2.PING, 0, 0, bytes(8)) * 500),
    "SETTINGS": lambda job: always(
        http2.frame(http2.SETTINGS, 0, 0, struct.pack(">HI", http2.INITIAL_WINDOW_SIZE, 65535)) * 500),
    "WINDOW_UPDATE": lambda job: always(
        http2.frame(http2.WINDOW_UPDATE, 0, 0, struct.pack(">I", 1)) * 1000),
    "PRIORITY": lambda job: always(
        http2.frame(http2.PRIORITY, 0, 1, struct.pack(">IB", 0, 16)) * 1000),
    "CONTINUATION": lambda job: after(BEGIN, LONG_HEADER),
    "empty CONTINUATION": lambda job: after(BEGIN, http2.frame(http2.CONTINUATION, 0, 1) * 1000),
    "empty DATA": lambda job: after(http2.headers(1, INFO), http2.frame(http2.DATA, 0, 1) * 1000),
    "RST_STREAM": lambda job: resets(INFO, b""),
    "RST_STREAM of watches": lambda job: resets(WATCH, watch_of(job)),
    "unread calls": lambda job: unread,
}


def flood(port, seconds, frames):
    """Number of batches and of connections."""
    until, batches, connections = time.monotonic() + seconds, 0, 0
    while time.monotonic() < until:
        with contextlib.suppress(OSError), http2.greet(port) as connection:
            connections += 1
            connection.settimeout(0.2)
            for number in itertools.count():
                connection.sendall(frames(number))
                batches += 1
                if time.monotonic() > until:
                    break
    return batches, connections


def start(port, seconds, kind, job=""):
    """The program as a process; what it prints is in its stdout."""
    return subprocess.Popen([sys.executable, "-B", __file__, str(port), str(seconds), kind, job],
                            stdout=subprocess.PIPE, text=True)


if __name__ == "__main__":
    port, seconds, kind, *job = sys.argv[1:]
    print(*flood(int(port), float(seconds), KINDS[kind]("".join(job))))
