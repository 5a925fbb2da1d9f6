"""A TCP proxy that cuts its connections, for tests of what survives that."""

import itertools
import socket
import threading


class CuttingProxy:
    """Forwards connections to a port of this machine.

    Each is cut after so many bytes from the server, perhaps in the middle of a message: `budgets`
    by turns, until there have been `cuts`. Later connections are whole.
    """

    def __init__(self, port, cuts, budgets):
        self.cuts = 0  #: Connections that were cut.
        self._port, self._most, self._budgets = port, cuts, itertools.cycle(budgets)
        self._lock = threading.Lock()
        self._closed = False
        self._listener = socket.create_server(("127.0.0.1", 0))
        self.address = f"127.0.0.1:{self._listener.getsockname()[1]}"
        threading.Thread(target=self._accept, daemon=True).start()

    def close(self):
        self._closed = True
        self._listener.close()

    def _accept(self):
        while not self._closed:
            try:
                client, _ = self._listener.accept()
            except OSError:
                return
            try:
                server = socket.create_connection(("127.0.0.1", self._port))
            except OSError:
                client.close()
                continue
            for source, target, budget in ((client, server, None),
                                           (server, client, next(self._budgets))):
                threading.Thread(target=self._pump, args=(source, target, budget),
                                 daemon=True).start()

    def _pump(self, source, target, budget):
        try:
            while data := source.recv(16384):
                if budget is not None:
                    if len(data) > budget and self._may_cut():
                        target.sendall(data[:budget])
                        break
                    budget = max(0, budget - len(data))
                target.sendall(data)
        except OSError:
            pass
        for end in (source, target):
            try:
                end.shutdown(socket.SHUT_RDWR)
            except OSError:
                pass
        source.close()  # The other thread closes the target.

    def _may_cut(self):
        with self._lock:
            if self.cuts == self._most:
                return False
            self.cuts += 1
            return True
