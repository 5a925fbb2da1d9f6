"""Every exit code of contactctl, by a command that gives it; and what Ctrl-C does on a terminal."""

import os
import pty
import signal
import subprocess
import time
import unittest

from cli_case import CHAIN, LONG, SPRING, CliTest, read_until
from contactd import PATIENCE_S


class ExitCodes(CliTest):

    flags = ("--workers=1", "--max-queued-jobs=1")

    def test_each_code_has_a_command(self):
        hard = ("--set", "solver.max_iterations=1", "--set", "solver.restitution_tolerance=1e-12")
        commands = {
            0: ("version",),
            1: ("run", CHAIN, *hard, "--set", "solver.on_not_converged=FAIL"),
            2: ("rnu",),
            3: ("run", CHAIN, "--set", "contacts[0].restitution=2"),
            6: ("describe", "nosuchjob1"),
            7: ("run", CHAIN, *hard),
            11: ("validate", "no-such-file.yaml"),
        }
        for code, command in commands.items():
            with self.subTest(code):
                self.run_it(*command, code=code)
        with self.subTest(4):
            self.run_it("list", code=4, server="127.0.0.1:1")
        if "\n  compare " in self.run_it("--help")[0]:
            with self.subTest(8):
                other = ("--set", "contacts[0].restitution=0.5")
                jobs = [self.run_it("run", CHAIN, *changes, "-o", "name")[0].strip()
                        for changes in ((), other)]
                self.run_it("compare", *jobs, code=8)
        job = self.submit_long()
        with self.subTest(5):
            self.run_it("wait", job, "--timeout", "0.5s", code=5)
        with self.subTest(10):
            self.submit_long()
            self.run_it("submit", CHAIN, code=10)
        with self.subTest(130):
            process = self.start("watch", job)
            read_until(process.stdout, b"cycle 1")
            process.send_signal(signal.SIGINT)
            process.communicate(timeout=PATIENCE_S)
            self.assertEqual(process.returncode, 130)

    def run_on_a_terminal(self, command, running):
        """Starts what submits a long job, and interrupts it once it is `running`."""
        master, slave = pty.openpty()
        self.addCleanup(os.close, master)
        process = subprocess.Popen(self.command(*command), stdin=slave, stdout=slave,
                                   stderr=slave, env={**os.environ, "TERM": "xterm"})
        os.close(slave)
        self.addCleanup(process.wait)
        self.addCleanup(process.kill)
        read_until(master, running)
        process.send_signal(signal.SIGINT)
        read_until(master, b"again within 2 s")
        return process, master

    def check_interrupts(self, command, running):
        process, master = self.run_on_a_terminal(command, running)
        read_until(master, b"the job continues")
        self.assertEqual(process.wait(PATIENCE_S), 130)
        job = self.run_it("list", "--state", "RUNNING", "-o", "name")[0].strip()
        self.run_it("cancel", job)
        self.run_it("wait", job, code=1)

        process, master = self.run_on_a_terminal(command, running)
        process.send_signal(signal.SIGINT)
        read_until(master, b"is asked to stop")
        self.assertEqual(process.wait(PATIENCE_S), 130)
        newest = self.run_it("list", "--limit", "1", "-o", "name")[0].strip()
        self.run_it("wait", newest, code=1)
        self.assertIn("CANCELLED", self.run_it("describe", newest)[0])

    def test_one_interrupt_leaves_the_job_and_two_cancel_it(self):
        self.check_interrupts(("run", SPRING, *LONG), b"NEWTON")

    def test_one_interrupt_leaves_the_sweep_and_two_cancel_it(self):
        axes = "".join(f"- {{field: {field}, values: [{value}]}}\n" for field, value in
                       (setting.split("=") for setting in LONG if setting != "--set"))
        path = self.folder / "long.yaml"
        path.write_text(f"base: {SPRING}\nmetrics: [iterations]\naxes:\n{axes}")
        self.check_interrupts(("sweep", "run", path), b"submitted")


if __name__ == "__main__":
    unittest.main()
