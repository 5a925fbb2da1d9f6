"""Figures in characters, on a terminal and in files."""

import fcntl
import os
import pty
import struct
import subprocess
import termios
import unittest

from cli_case import CHAIN, CliTest
from contactd import PATIENCE_S


class PlotFormsTest(CliTest):

    def setUp(self):
        super().setUp()
        self.name = self.run_it("run", CHAIN, "-o", "name")[0].strip()

    def on_terminal(self, width):
        master, slave = pty.openpty()
        self.addCleanup(os.close, master)
        fcntl.ioctl(slave, termios.TIOCSWINSZ, struct.pack("HHHH", 24, width, 0, 0))
        with os.fdopen(slave, "wb") as terminal:
            process = subprocess.Popen(self.command("plot", self.name, "force", "-o", "txt"),
                                       stdout=terminal, env={**os.environ, "TERM": "xterm"})
        seen = b""
        while True:
            try:
                block = os.read(master, 65536)
            except OSError:  # Nobody writes any more.
                break
            if not block:
                break
            seen += block
        self.assertEqual(process.wait(PATIENCE_S), 0)
        return seen.decode().splitlines()

    def test_figure_in_characters_is_as_wide_as_the_terminal(self):
        for width in (60, 120):
            border = next(line for line in self.on_terminal(width) if "+---" in line)
            self.assertIn(len(border), range(width - 8, width + 1))

    def test_figure_in_characters_goes_to_a_file_that_is_named(self):
        path = self.folder / "a.txt"
        self.assertEqual(self.run_it("plot", self.name, "force", "-f", path)[0], f"{path}\n")
        self.assertEqual(path.read_text("utf-8"),
                         self.run_it("plot", self.name, "force", "-o", "txt")[0])
        both = self.folder / "both.txt"
        self.run_it("compare", self.name, self.name, "--plot", both)
        self.assertIn("contact force of B1-B2 [N]", both.read_text("utf-8"))


if __name__ == "__main__":
    unittest.main()
