"""What commands print, on terminals of three widths and into a pipe, is what golden/ holds.

With the argument `update` the files are written anew; look at the difference before committing.
"""

import fcntl
import json
import os
import pathlib
import pty
import re
import struct
import subprocess
import sys
import termios
import time
import unittest

from cli_case import CHAIN, CliTest
from contactd import PATIENCE_S

GOLDEN = pathlib.Path(__file__).parent / "golden"
TABLE3 = CHAIN.parent / "table-3-sweep.yaml"
UPDATE = "update" in sys.argv

# What differs from run to run: names, instants and durations; each keeps its width.
VARIABLE = (
    (r"jobs/[a-z0-9]{10}", "jobs/IDENTIFIER"),
    (r"^([ ]*(?:\x1b\[\d*m)?)[a-z0-9]{10}(?=(?:\x1b\[0m)?  )", r"\g<1>IDENTIFIER"),
    (r"\b[a-z0-9]{10}(?= (?:            |-o json))", "IDENTIFIER"),
    (r"\d{4}-\d\d-\d\d \d\d:\d\d:\d\d", "YYYY-MM-DD hh:mm:ss"),
    (r"[0-9.]+ (?:s|ms|µs) wall", "WALL"),
    (r"\b\d\.\de[-+]\d\d\b", "N.Ne-NN"),  # Round-off.
    (r"\d+ steps", "NNN steps"),
    (r"\r\x1b\[K[^\r\n]*(?=\r\x1b\[K)", ""),  # Progress that was erased again.
    (r"(?:\r\x1b\[K)+", ""),
    (r"\x1b\[K", ""),
)


def settled(text):
    """The text without what differs from run to run."""
    text = text.replace("\r\n", "\n")
    for pattern, word in VARIABLE:
        text = re.sub(pattern, word, text, flags=re.MULTILINE)
    return text


class GoldenTest(CliTest):

    def on_terminal(self, width, *arguments):
        """What stands on a terminal of this width; messages go elsewhere."""
        master, slave = pty.openpty()
        fcntl.ioctl(slave, termios.TIOCSWINSZ, struct.pack("HHHH", 24, width, 0, 0))
        process = subprocess.Popen(self.command(*arguments), stdin=subprocess.DEVNULL,
                                   stdout=slave, stderr=subprocess.DEVNULL,
                                   env={**os.environ, "TERM": "xterm", "NO_COLOR": ""})
        os.close(slave)
        seen = b""
        deadline = time.monotonic() + PATIENCE_S
        while time.monotonic() < deadline:
            try:
                block = os.read(master, 65536)
            except OSError:  # All of it is read, and nobody writes any more.
                break
            if not block:
                break
            seen += block
        os.close(master)
        process.wait(PATIENCE_S)
        return seen.decode()

    def check(self, name, *arguments):
        printed = {f"{name}-{width}": self.on_terminal(width, *arguments)
                   for width in (40, 80, 200)}
        printed[f"{name}-pipe"] = self.run_it(*arguments, code=None)[0]
        for file, text in printed.items():
            path = GOLDEN / f"{file}.txt"
            if UPDATE:
                path.write_text(settled(text), "utf-8")
            with self.subTest(file):
                self.assertEqual(settled(text), path.read_text("utf-8"))
                self.assertFalse("\x1b" in printed[f"{name}-pipe"])

    def test_run_and_describe(self):
        self.check("run", "run", CHAIN)
        job = self.run_it("run", CHAIN, "-o", "name")[0].strip()
        self.check("describe", "describe", job)

    def test_help_of_every_command_fits_a_narrow_terminal(self):
        for words in ((), ("--help",), ("run", "--help"), ("plot", "--help"), ("compare", "--help"),
                      ("help", "tutorial"), ("help", "sweep", "run")):
            printed = self.on_terminal(40, *words).replace("\r", "")
            with self.subTest(words):
                for line in printed.splitlines():
                    self.assertTrue(len(line) <= 40 or " " not in line.strip(), line)
                wide = self.run_it(*words)[0]
                self.assertEqual(re.sub(r"\s", "", printed), re.sub(r"\s", "", wide))

    def test_list(self):
        for _ in range(2):
            self.run_it("run", CHAIN, "--label", "study=chain", "-o", "name")
        self.check("list", "list")

    def test_sweep(self):
        job = self.run_it("sweep", "run", TABLE3, "-o", "name")[0].strip()
        self.check("sweep", "sweep", "watch", job)

    def test_model_list_shows_every_law_once_within_the_width(self):
        laws = json.loads(self.run_it("model", "list", "-o", "json")[0])
        self.assertGreaterEqual(len(laws), 15)
        for width in (40, 80, 200):
            printed = re.sub(r"\x1b\[\d*m", "", self.on_terminal(width, "model", "list"))
            lines = printed.replace("\r", "").splitlines()
            self.assertLessEqual(max(map(len, lines)), width)
            words = " ".join(printed.split())
            for law in laws:
                with self.subTest(law["law"], width=width):
                    self.assertEqual(sum(law["law"] in line.split() for line in lines), 1)
                    self.assertIn(law["formula"], words)


if __name__ == "__main__":
    unittest.main(argv=[arg for arg in sys.argv if arg != "update"])
