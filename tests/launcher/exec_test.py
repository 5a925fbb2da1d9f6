"""The launcher with workers that are processes of this machine."""

import os
import subprocess
import time
import unittest

from launching import BINARY, PATIENCE_S, LauncherTest


class ExecTest(LauncherTest):

    def alive(self):
        """Process numbers of the workers that run."""
        pids = [int(path.name) for path in (self.folder / "notes").iterdir()
                if path.suffix != ".new"]
        return [pid for pid in pids if os.path.exists(f"/proc/{pid}")]

    def wait_for_workers(self, count):
        return self.wait_for(lambda: len(self.alive()) == count and self.alive(),
                             f"there are not {count} workers")

    def test_nobody_runs_while_nothing_waits(self):
        self.launch("--max-workers=4")
        time.sleep(1)
        self.assertEqual(self.notes(), [])

    def test_workers_follow_the_demand_up_to_the_limit(self):
        self.launch("--max-workers=3", "--worker-threads=2")
        self.demand(1)
        self.wait_for_workers(1)
        self.demand(2, 2)
        self.wait_for_workers(2)
        self.demand(1000)
        self.wait_for_workers(3)
        time.sleep(1)
        self.assertEqual(len(self.notes()), 3)

    def test_a_worker_that_is_killed_is_replaced(self):
        self.launch("--max-workers=2")
        self.demand(2)
        first = self.wait_for_workers(2)
        os.kill(first[0], 9)
        self.wait_for(lambda: len(self.notes()) == 3, "no third worker has come")
        self.assertIn("was ended by signal 9", self.log())

    def test_workers_that_leave_are_not_replaced_when_nothing_waits(self):
        self.launch("--max-workers=2")
        self.demand(2)
        self.wait_for_workers(2)
        self.demand(0)
        (self.folder / "leave").touch()
        self.wait_for(lambda: not self.alive(), "the workers do not leave")
        time.sleep(1)
        self.assertEqual(len(self.notes()), 2)

    def test_workers_end_with_the_launcher(self):
        self.launch("--min-workers=2", "--max-workers=2")
        self.wait_for_workers(2)
        self.assertEqual(self.end(), 0)
        self.assertEqual(self.alive(), [])
        for note in self.notes():
            self.assertIn("terminated", note)

    def test_the_address_of_the_store_is_in_no_word(self):
        store = self.store.replace("contactd@", "contactd:secret@")
        greeting = self.launch("--min-workers=1", store=store)
        pid = self.wait_for_workers(1)[0]
        with open(f"/proc/{pid}/cmdline", encoding="utf-8") as words:
            self.assertNotIn("secret", words.read())
        self.assertIn(f"CONTACTD_STORE={store}\n", self.notes()[0])
        self.assertNotIn("secret", greeting + self.log())

    def test_workers_that_fail_at_once_are_tried_less_and_less_often(self):
        self.worker.write_text(f"#!/bin/sh\ntouch {self.folder}/notes/$$\nexit 2\n")
        self.launch("--min-workers=1")  # At 0, 0.2, 0.6, 1.4, 3, 6.2 s.
        self.wait_for(lambda: "soon after their start" in self.log(), "nothing is logged")
        time.sleep(3)
        self.assertLess(len(self.notes()), 8)
        self.assertEqual(self.log().count("soon after their start"), 1)

    def test_settings_that_do_not_belong_together_are_refused(self):
        for flag in ("--store=", "--min-workers=2", "--launch-interval=0", "--slurm-job-name=a,b"):
            run = subprocess.run([BINARY, "--role=launcher", "--store=postgresql:///x", flag],
                                 capture_output=True, text=True, timeout=PATIENCE_S, check=False)
            self.assertEqual(run.returncode, 2, run.stderr)
            self.assertIn(flag.split("=")[0], run.stdout + run.stderr)

    def test_without_a_database_the_launcher_says_so(self):
        self.assertEqual(self.launch(store="postgresql:///x?host=/nowhere"), "")
        self.launcher.wait(10)
        self.assertEqual(self.end(), 3)

    def test_a_database_that_is_away_for_a_while_stops_starts_only(self):
        self.launch("--max-workers=2")
        self.demand(1)
        self.wait_for_workers(1)
        self.postgres.kill()
        self.wait_for(lambda: "error" in self.log(), "nothing is logged")
        self.assertEqual(len(self.alive()), 1)
        self.postgres.start()
        self.demand(2)
        self.wait_for_workers(2)
        self.assertIn("all is well again", self.log())


if __name__ == "__main__":
    unittest.main()
