"""A way to a server that stalls, breaks and mends again, as networks do."""

import asyncio
import contextlib
import functools
import threading

BUFFER = 1 << 22  # Bytes of a direction that wait here while a connection is stalled.


@functools.cache
def _loop():
    """The thread that carries for all proxies of this program."""
    loop = asyncio.new_event_loop()
    threading.Thread(target=loop.run_forever, daemon=True, name="proxy").start()
    return loop


def _on_loop(coroutine):
    return asyncio.run_coroutine_threadsafe(coroutine, _loop()).result()


class Proxy:
    """Carries what comes to a port of this machine to a socket file, and back.

    A stalled connection loses nothing: what was sent arrives once it goes on, even if its sender
    has given up by then. The methods are for any thread."""

    def __init__(self, target):
        self.target = str(target)
        self._gates = {}  # Of each connection: the client's writer -> whether it may carry.
        self._paused = False
        self._server = _on_loop(asyncio.start_server(self._serve, "127.0.0.1", 0, limit=BUFFER))
        self.port = self._server.sockets[0].getsockname()[1]

    def stall(self):
        """Connections that there are carry nothing; new ones do."""
        self._on_gates(asyncio.Event.clear)

    def pause(self):
        """No connection carries anything, also none that comes."""
        self._on_gates(asyncio.Event.clear, paused=True)

    def resume(self):
        self._on_gates(asyncio.Event.set, paused=False)

    def cut(self):
        """Clients lose their connections. What they have sent still arrives."""
        async def abort():
            for writer in self._gates:
                writer.transport.abort()
        _on_loop(abort())

    def close(self):
        async def close():
            self._server.close()
        _on_loop(close())
        self.cut()
        self.resume()

    def _on_gates(self, act, paused=None):
        async def run():
            if paused is not None:
                self._paused = paused
            for gate in self._gates.values():
                act(gate)
        _on_loop(run())

    async def _serve(self, reader, writer):
        gate = self._gates[writer] = asyncio.Event()
        if not self._paused:
            gate.set()
        try:
            await gate.wait()
            there, back = await asyncio.open_unix_connection(self.target, limit=BUFFER)
            await asyncio.gather(_carry(reader, back, gate), _carry(there, writer, gate))
            back.close()
        except OSError:
            pass  # The server is away: so is the connection.
        finally:
            del self._gates[writer]
            writer.close()


async def _carry(source, sink, gate):
    """All of one direction, then its end."""
    with contextlib.suppress(OSError):  # One of the two is lost: that is an end, too.
        while data := await source.read(1 << 16):
            await gate.wait()
            sink.write(data)
            await sink.drain()
    await gate.wait()
    with contextlib.suppress(OSError):
        sink.write_eof()
