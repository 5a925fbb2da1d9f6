"""A launcher with a worker that only notes what happens to it, for a demand that a test decides."""

import os
import pathlib
import select
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "testing"))
import postgres  # pylint: disable=wrong-import-position

BINARY = os.environ["CONTACTD"]
PATIENCE_S = 60

# contactd.demand() as a table says.
STUB = """
CREATE SCHEMA contactd;
CREATE TABLE contactd.stub(queued bigint, running bigint);
INSERT INTO contactd.stub VALUES (0, 0);
CREATE FUNCTION contactd.demand(OUT queued bigint, OUT running bigint, OUT workers bigint,
                                OUT threads bigint, OUT cells bigint)
  LANGUAGE sql AS 'SELECT queued, running, 0::bigint, 0::bigint, 0::bigint FROM contactd.stub'
"""
# Writes its words, environment and end to notes/PID; ends at SIGTERM, or when the file `leave` is there.
WORKER = """#!/bin/sh
note="{folder}/notes/$$"
{{ echo "words $*"; env; }} > "$note.new"
mv "$note.new" "$note"
trap 'echo "terminated $(date +%s)" >> "$note"; exit 0' TERM
while [ ! -e "{folder}/leave" ]; do sleep 0.1; done
echo left >> "$note"
"""


class LauncherTest(unittest.TestCase):
    """A test with a database and a folder of its own. `self.launch` starts the launcher."""

    environment = None  # Of the launcher; None: that of the test.

    @classmethod
    def setUpClass(cls):
        cls.postgres = postgres.Cluster()
        cls.addClassCleanup(cls.postgres.stop)

    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="contact-launcher-", dir="/tmp"))
        self.addCleanup(shutil.rmtree, self.folder)
        (self.folder / "notes").mkdir()
        self.worker = self.folder / "worker"
        self.worker.write_text(WORKER.format(folder=self.folder))
        self.worker.chmod(0o755)
        self.database = self._testMethodName[:60]
        self.store = self.postgres.create(self.database)
        self.postgres.run(STUB, self.database)

    def demand(self, queued, running=0):
        self.postgres.run(f"UPDATE contactd.stub SET queued = {queued}, running = {running}",
                          self.database)

    def launch(self, *flags, store=None):
        """Starts a launcher and waits until it says so; returns what it says."""
        self.log_path = self.folder / "log"
        with self.log_path.open("ab") as log:
            self.launcher = subprocess.Popen(
                [BINARY, "--role=launcher", f"--worker-command={self.worker}",
                 "--launch-interval=200ms", *flags],
                env={**(self.environment or os.environ), "CONTACTD_STORE": store or self.store},
                stdout=subprocess.PIPE, stderr=log, text=True, cwd=self.folder)
        self.addCleanup(self.end)
        ready, _, _ = select.select([self.launcher.stdout], [], [], PATIENCE_S)
        self.assertTrue(ready)
        return self.launcher.stdout.readline()

    def end(self):
        """Asks the launcher to end; its exit code."""
        if self.launcher.poll() is None:
            self.launcher.send_signal(signal.SIGTERM)
            self.launcher.wait(PATIENCE_S)
        self.launcher.stdout.close()
        return self.launcher.returncode

    def log(self):
        return self.log_path.read_text()

    def notes(self):
        """The notes of each worker that has begun."""
        return [path.read_text() for path in (self.folder / "notes").iterdir()
                if path.suffix != ".new"]

    def wait_for(self, done, why):
        """Waits until `done` answers something true, and returns that."""
        deadline = time.monotonic() + PATIENCE_S
        while not (found := done()):
            self.assertLess(time.monotonic(), deadline, f"{why}\n{self.log()}")
            time.sleep(0.05)
        return found
