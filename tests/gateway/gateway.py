"""A contactd with its gateway, and HTTP by hand."""

import base64
import http.client
import json
import re
import socket
import struct
import time

from contactd import PATIENCE_S, ServerTest, three_ball_chain

SERVICE = "/contact.v1.JobService/"


def frame(payload, flags=0):
    return struct.pack(">BI", flags, len(payload)) + payload


def frames(data):
    """Pairs of flags and payload; fails if bytes are left."""
    found = []
    while data:
        flags, size = struct.unpack(">BI", data[:5])
        assert len(data) >= 5 + size, data
        found.append((flags, data[5:5 + size]))
        data = data[5 + size:]
    return found


class Answer:
    def __init__(self, response):
        self.status = response.status
        self.headers = {name.lower(): value for name, value in response.getheaders()}
        self.body = response.read()

    def json(self):
        return json.loads(self.body)

    def code(self):
        """Connect's code of a call that failed."""
        return self.json()["code"]


class GatewayTest(ServerTest):
    """A test with a server whose gateway is at `self.http`, a port of this host."""

    http_flags = ()

    def setUp(self):
        super().setUp()
        self.http = int((self.folder / "http").read_text())

    @property
    def flags(self):
        return ("--http-listen=127.0.0.1:0", f"--http-port-file={self.folder / 'http'}",
                *self.http_flags)

    def ask(self, method, target, body=None, headers=(), port=None):
        connection = http.client.HTTPConnection("127.0.0.1", port or self.http, timeout=PATIENCE_S)
        try:
            connection.request(method, target, body, dict(headers))
            return Answer(connection.getresponse())
        finally:
            connection.close()

    def call(self, method, message, **headers):
        """A unary call of Connect in JSON."""
        names = {"content-type": "application/json"}
        names |= {name.replace("_", "-"): value for name, value in headers.items()}
        return self.ask("POST", SERVICE + method, json.dumps(message), names)

    def stream(self, method, message, kind="application/connect+json"):
        """The answer to a stream: its head, and its frames once it has ended."""
        body = frame(json.dumps(message).encode())
        answer = self.ask("POST", SERVICE + method, body, {"content-type": kind})
        return answer, frames(answer.body)

    def connect(self):
        """A bare connection."""
        raw = socket.create_connection(("127.0.0.1", self.http), PATIENCE_S)
        self.addCleanup(raw.close)
        return raw

    def request(self, method, body=b"{}", *headers, target=None, version="HTTP/1.1"):
        """The bytes of a request."""
        lines = [f"{method} {target or SERVICE + 'GetServerInfo'} {version}", "host: localhost",
                 "content-type: application/json", *headers]
        if not any(re.match("(transfer-encoding|content-length):", line) for line in headers):
            lines.append(f"content-length: {len(body)}")
        return "\r\n".join(lines).encode() + b"\r\n\r\n" + body

    def wait_until(self, condition):
        end = time.monotonic() + PATIENCE_S
        while not condition():
            self.assertLess(time.monotonic(), end)
            time.sleep(0.05)

    def one_job(self):
        """The name of a job that has ended."""
        return self.server.run(three_ball_chain()).name


def read_all(raw):
    """What comes until the server ends the connection."""
    parts = []
    while part := raw.recv(1 << 16):
        parts.append(part)
    return b"".join(parts)


def read_answer(raw):
    """Status and body of one answer that has a length; what follows stays in the connection."""
    head = b""
    while not head.endswith(b"\r\n\r\n"):
        byte = raw.recv(1)
        if not byte:
            raise EOFError(head)
        head += byte
    size = int(re.search(rb"content-length: (\d+)", head)[1])
    body = b""
    while len(body) < size:
        body += raw.recv(size - len(body))
    return int(head.split()[1]), body


def b64(data):
    return base64.b64encode(data).decode()
