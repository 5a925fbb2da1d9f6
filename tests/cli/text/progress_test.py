"""Progress for programs, and in the task bar of terminals."""

import json
import os
import pty
import signal
import subprocess
import unittest

from cli_case import CHAIN, LONG, SPRING, CliTest, read_until
from contactd import PATIENCE_S

TASKBAR_OFF = b"\x1b]9;4;0\x07"


class ProgressTest(CliTest):

    def told(self, *arguments, code=0):
        said = self.run_it(*arguments, "--progress", "json", "-o", "name", code=code)[1]
        return [json.loads(line) for line in said.splitlines()]

    def test_run_is_told_in_lines_of_json_up_to_its_end(self):
        lines = self.told("run", CHAIN)
        self.assertEqual(list(lines[-1]), ["kind", "job", "done", "time_s", "end_time_s", "steps",
                                           "cycles", "iterations", "eta_s"])
        self.assertEqual((lines[-1]["kind"], lines[-1]["done"]), ("run", 1))
        self.assertEqual((lines[-1]["time_s"], lines[-1]["cycles"]), (4e-3, 2))
        parts = [line["done"] for line in lines]
        self.assertEqual(parts, sorted(parts))

    def test_sweep_tells_its_cells(self):
        lines = self.told("sweep", "run", CHAIN, "--grid", "contacts[*].restitution=0.5:0.9:100")
        self.assertEqual({line["kind"] for line in lines}, {"sweep"})
        self.assertEqual((lines[-1]["cells"], lines[-1]["cells_done"]), (100, 100))
        self.assertEqual((lines[-1]["cells_failed"], lines[-1]["eta_s"]), (0, 0))

    def test_watch_tells_it_beside_the_events(self):
        name = self.run_it("run", CHAIN, "-o", "name")[0].strip()
        printed, said = self.run_it("watch", name, "--progress", "json")
        self.assertIn("SUCCEEDED", printed)
        self.assertEqual(json.loads(said.splitlines()[-1])["done"], 1)

    def on_terminal(self, *arguments, env=None):
        """A process whose messages go to a terminal, and its other end."""
        master, slave = pty.openpty()
        self.addCleanup(os.close, master)
        process = subprocess.Popen(self.command(*arguments), stdin=subprocess.DEVNULL,
                                   stdout=subprocess.DEVNULL, stderr=slave,
                                   env={**os.environ, "TERM": "xterm", **(env or {})})
        os.close(slave)
        self.addCleanup(process.wait)
        self.addCleanup(process.kill)
        return process, master

    def test_task_bar_shows_it_and_is_taken_back(self):
        process, master = self.on_terminal("run", CHAIN, "--taskbar-progress")
        seen = read_until(master, TASKBAR_OFF)
        self.assertIn(b"\x1b]9;4;1;100\x07", seen)
        self.assertEqual(process.wait(PATIENCE_S), 0)

    def test_task_bar_is_taken_back_on_interrupt(self):
        process, master = self.on_terminal("run", SPRING, *LONG, "--iterations", "none",
                                           env={"CONTACT_TASKBAR_PROGRESS": "true"})
        read_until(master, b"\x1b]9;4;1;")
        process.send_signal(signal.SIGINT)
        self.assertIn(TASKBAR_OFF, read_until(master, b"Ctrl-C again"))
        process.send_signal(signal.SIGINT)
        self.assertEqual(process.wait(PATIENCE_S), 130)

    def test_task_bar_is_for_terminals_and_for_who_wants_it(self):
        said = self.run_it("run", CHAIN, "--taskbar-progress")[1]
        self.assertNotIn("\x1b]9", said)
        process, master = self.on_terminal("run", CHAIN)
        self.assertNotIn(b"\x1b]9", read_until(master, b"Next:"))
        self.assertEqual(process.wait(PATIENCE_S), 0)


if __name__ == "__main__":
    unittest.main()
