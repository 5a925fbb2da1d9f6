"""contactctl watch --plot: curves on a terminal."""

import fcntl
import os
import pty
import select
import signal
import struct
import subprocess
import termios
import time
import unittest

from cli_case import CHAIN, CliTest, read_until
from contactd import PATIENCE_S


def read_all(terminal):
    """All that is written until the other side has closed it."""
    seen = b""
    deadline = time.monotonic() + PATIENCE_S
    while time.monotonic() < deadline:
        try:
            if select.select([terminal], [], [], 1)[0]:
                seen += os.read(terminal, 65536)
        except OSError:  # Linux's word for the end of a terminal.
            break
    return seen


class LivePlotTest(CliTest):

    def setUp(self):
        super().setUp()
        self.job = self.run_it("run", CHAIN, "-o", "name")[0].strip()

    def on_terminal(self, *flags, locale="C.UTF-8", columns=60, rows=20):
        master, slave = pty.openpty()
        self.addCleanup(os.close, master)
        fcntl.ioctl(slave, termios.TIOCSWINSZ, struct.pack("HHHH", rows, columns, 0, 0))
        process = subprocess.Popen(
            self.command("watch", self.job, "--plot", "B1.velocity,B1-B2.contact_force", *flags),
            stdout=slave, stderr=slave, stdin=slave, env={**os.environ, "LC_ALL": locale})
        self.addCleanup(process.wait)
        self.addCleanup(process.kill)
        os.close(slave)
        return master, process

    def test_draws_braille_and_leaves_the_plot(self):
        master, process = self.on_terminal()
        seen = read_all(master).decode()
        self.assertIn("B1-B2.contact_force [N]", seen)
        self.assertIn("t = ", seen.split("\x1b[?1049l")[1])
        self.assertTrue(any("\u2801" <= c <= "\u28ff" for c in seen))
        self.assertEqual(process.wait(PATIENCE_S), 0)

    def test_draws_ascii_without_utf8(self):
        master, process = self.on_terminal(locale="C")
        seen = read_all(master)
        self.assertIn(b"*", seen)
        self.assertTrue(seen.isascii())

    def test_replay_takes_its_time_and_follows_the_size(self):
        start = time.monotonic()
        master, process = self.on_terminal("--replay", "2e-3x")  # 4 ms in 2 s.
        read_until(master, b"t = ")
        fcntl.ioctl(master, termios.TIOCSWINSZ, struct.pack("HHHH", 6, 30, 0, 0))
        seen = read_all(master)
        self.assertGreaterEqual(time.monotonic() - start, 2)
        last = seen.decode().split("\x1b[?1049l")[0].split("\x1b[H")[-1].split("\x1b[J")[0]
        self.assertLessEqual(len(last.split("\r\n")), 6)
        self.assertEqual(process.wait(PATIENCE_S), 0)

    def test_interrupt_gives_the_terminal_back(self):
        master, process = self.on_terminal("--replay", "1e-6x")
        read_until(master, b"t = ")
        process.send_signal(signal.SIGINT)
        read_until(master, b"\x1b[?25h\x1b[?1049l")
        self.assertIn(process.wait(PATIENCE_S), (0, 130))

    def test_wrong_uses_are_told(self):
        _, said = self.run_it("watch", self.job, "--plot", "B1.velocity", code=2)
        self.assertIn("draws on a terminal", said)
        self.run_it("watch", self.job, "--replay", "1x", code=2)
        self.run_it("watch", self.job, "--plot", "B1.velocity", "--replay", "0x", code=2)
        master, process = self.on_terminal("--plot", "B1.velocty")
        read_until(master, b"did you mean 'B1.velocity'?")
        self.assertEqual(process.wait(PATIENCE_S), 2)


if __name__ == "__main__":
    unittest.main()
