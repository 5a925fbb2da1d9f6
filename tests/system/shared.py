"""Several contactd on one PostgreSQL database, as on the machines of a cluster."""

import signal
import subprocess
import time

from contactd import BINARY, PATIENCE_S, Server, cluster, database_of

LEASE_S = 2


class Worker:
    """A `contactd --role worker`; one process after the other."""

    def __init__(self, log_path, store, *flags, environment=None):
        self.log_path = log_path
        self.flags = ("--role=worker", f"--store={store}", f"--lease={LEASE_S}s", *flags)
        self.environment = environment
        self.process = None

    def start(self):
        with open(self.log_path, "ab") as log:
            self.process = subprocess.Popen([BINARY, *self.flags], stdout=subprocess.PIPE,
                                            stderr=log, text=True, env=self.environment)
        greeting = self.process.stdout.readline()
        if "works with" not in greeting:
            raise RuntimeError(f"the worker said {greeting!r} and logged {self.log()}")
        return self

    def log(self):
        return self.log_path.read_text()

    def freeze(self):
        self.process.send_signal(signal.SIGSTOP)

    def thaw(self):
        self.process.send_signal(signal.SIGCONT)

    def kill(self):
        self.end(signal.SIGKILL)

    def end(self, how=signal.SIGTERM):
        """Ends it; returns its exit code and the seconds that took."""
        if self.process is None:
            return None
        start = time.monotonic()
        self.process.send_signal(how)
        if how == signal.SIGKILL:
            self.thaw()
        code = self.process.wait(PATIENCE_S)
        self.process.stdout.close()
        self.process = None
        return code, time.monotonic() - start


class Shared:
    """Fronts and workers of one database. Ends all of them with the test."""

    def __init__(self, test, name="shared"):
        self.test = test
        self.folder = test.folder
        self.name = name
        self.store = database_of(test.folder / name)
        self.count = 0

    def _path(self, kind):
        self.count += 1
        folder = self.folder / f"{self.name}-{kind}-{self.count}"
        folder.mkdir()
        return folder

    def front(self, *flags, store=None):
        """`store`: another address of the database, as for a worker."""
        folder = self._path("front")
        front = Server(folder / "data", "--role=front", f"--store={store or self.store}", *flags,
                       store="")
        self.test.addCleanup(front.kill)
        return front.start()

    def worker(self, *flags, environment=None, store=None):
        worker = Worker(self._path("worker") / "contactd.log", store or self.store, *flags,
                        environment=environment)
        self.test.addCleanup(worker.kill)
        return worker.start()

    def way(self):
        """A proxy before the database, and the address of the database through it."""
        target = cluster().folder / ".s.PGSQL.5432"
        from proxy import Proxy  # cluster() has made it known.
        proxy = Proxy(target)
        self.test.addCleanup(proxy.close)
        return proxy, f"postgresql://contactd@127.0.0.1:{proxy.port}/{self.database}"

    @property
    def database(self):
        return self.store.split("@/")[1].split("?")[0]

    def ask(self, sql):
        return cluster().run(sql, self.database)
