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
import postgres
import slurm

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
# Writes its words, environment and end to notes/PID; ends at SIGTERM, or when the file `leave` is
# there.
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

    def wait_for(self, done, why, patience_s=PATIENCE_S, every_s=0.1):
        """Waits until `done` answers something true, and returns that."""
        deadline = time.monotonic() + patience_s
        while not (found := done()):
            self.assertLess(time.monotonic(), deadline, f"{why}\n{self.log()}")
            time.sleep(every_s)
        return found


@unittest.skipIf(slurm.MISSING, f"{', '.join(slurm.MISSING)} not here: deploy/setup tests")
class SlurmLauncherTest(LauncherTest):
    """A test whose workers are jobs of a Slurm, `self.slurm`, of the job name `self.name`."""

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.slurm = slurm.Slurm()
        cls.addClassCleanup(cls.slurm.stop)
        cls.environment = cls.slurm.environment

    def setUp(self):
        super().setUp()
        self.name = self._testMethodName

    def launch(self, *flags, store=None):
        self.addCleanup(self.slurm.run, "scancel", f"--name={self.name}")
        return super().launch("--launcher=slurm", f"--slurm-job-name={self.name}",
                              f"--slurm-output={self.folder}/worker-%j.log", *flags, store=store)

    def jobs(self, *states):
        """Numbers of the jobs of this test, all or those in one of the states."""
        jobs = self.slurm.jobs(self.name)
        return [number for number, state in jobs.items() if not states or state in states]

    def wait_for_workers(self, count):
        """Waits until so many run, and no job is left beside them; returns their numbers."""
        return self.wait_for(
            lambda: len(self.jobs("RUNNING")) == len(self.jobs()) == count and self.jobs("RUNNING"),
            f"there are not {count} workers")
