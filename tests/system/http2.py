"""A client of HTTP/2 made by hand, that may do what no library does."""

import socket
import ssl
import struct

import hpack

PREFACE = b"PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n"
DATA, HEADERS, PRIORITY, RST_STREAM, SETTINGS, PING, WINDOW_UPDATE, CONTINUATION = (
    0, 1, 2, 3, 4, 6, 8, 9)
END_STREAM, ACK, END_HEADERS = 1, 1, 4  # Flags.
INITIAL_WINDOW_SIZE = 4  # A setting.
LARGEST_FRAME = 16384
LARGEST_WINDOW = 2**31 - 1


def frame(kind, flags, stream, payload=b""):
    return struct.pack(">I", len(payload))[1:] + bytes([kind, flags]) + struct.pack(
        ">I", stream) + payload


def header(name, value):
    """HPACK: a literal without index, its lengths below 127 or in continuation bytes."""
    def text(string):
        length, out = len(string), b""
        if length < 127:
            return bytes([length]) + string
        length -= 127
        out = b"\x7f"
        while length > 127:
            out += bytes([length & 127 | 128])
            length >>= 7
        return out + bytes([length]) + string
    return b"\x00" + text(name) + text(value)


def headers(stream, method, *more):
    """HEADERS of a gRPC call, with CONTINUATION as far as they need it."""
    block = b"".join(header(name, value) for name, value in (
        (b":method", b"POST"), (b":scheme", b"http"), (b":path", method.encode()),
        (b":authority", b"x"), (b"te", b"trailers"), (b"content-type", b"application/grpc"),
        *more))
    parts = [block[i:i + LARGEST_FRAME] for i in range(0, len(block), LARGEST_FRAME)]
    return b"".join(
        frame(CONTINUATION if i else HEADERS, END_HEADERS if i == len(parts) - 1 else 0, stream,
              part)
        for i, part in enumerate(parts))


def message(stream, content=b""):
    """DATA with the only message of a call."""
    return frame(DATA, END_STREAM, stream, b"\0" + struct.pack(">I", len(content)) + content)


def greet(port, *, window=None, file=None, tls=False):
    """A connection that has said who it is; `window`: what it is ready to take. To a port of this
    host, or to a socket file."""
    if file:
        connection = socket.socket(socket.AF_UNIX)
        connection.connect(str(file))
    else:
        connection = socket.create_connection(("127.0.0.1", port), 5)
    if tls:
        context = ssl._create_unverified_context()
        context.set_alpn_protocols(["h2"])
        connection = context.wrap_socket(connection)
    settings = struct.pack(">HI", INITIAL_WINDOW_SIZE, window) if window else b""
    connection.sendall(PREFACE + frame(SETTINGS, 0, 0, settings))
    if window:
        connection.sendall(frame(WINDOW_UPDATE, 0, 0, struct.pack(">I", window - 65535)))
    return connection


def read_headers(connection):
    """The first headers that come on the connection; empty if it ends before. They fit a frame."""
    with connection.makefile("rb") as read:
        while len(head := read.read(9)) == 9:
            payload = read.read(int.from_bytes(head[:3], "big"))
            if head[3] == HEADERS:
                return dict(hpack.Decoder().decode(payload))
    return {}
