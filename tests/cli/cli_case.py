"""A contactd with contactctl beside it, for tests of the command line."""

import os
import pathlib
import select
import subprocess
import time

from contactd import PATIENCE_S, ServerTest

CONTACTCTL = os.environ["CONTACTCTL"]
SCENARIOS = pathlib.Path(__file__).parents[2] / "client" / "scenarios"
REFERENCE = pathlib.Path(__file__).parents[1] / "reference" / "spring_ball.json"
CHAIN = SCENARIOS / "three-ball-chain.yaml"
SPRING = SCENARIOS / "spring-wall.yaml"

# More cycles than anyone waits for.
LONG = ("--set", "end_time_s=1e5", "--set", "output.sample_interval_s=0.1", "--set",
        "solver.max_steps=1e12")


class CliTest(ServerTest):

    def command(self, *arguments, server=None):
        return [CONTACTCTL, "--server", server or f"127.0.0.1:{self.server.port}",
                *map(str, arguments)]

    def run_it(self, *arguments, code=0, server=None):
        """Runs contactctl to its end; returns what it printed and what it said."""
        run = subprocess.run(self.command(*arguments, server=server), capture_output=True,
                             encoding="utf-8", timeout=PATIENCE_S)
        if code is not None:
            self.assertEqual(run.returncode, code, run.stdout + run.stderr)
        return run.stdout, run.stderr

    def start(self, *arguments, server=None):
        process = subprocess.Popen(self.command(*arguments, server=server),
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE, bufsize=0)
        self.addCleanup(process.stderr.close)
        self.addCleanup(process.stdout.close)
        self.addCleanup(process.wait)
        self.addCleanup(process.kill)
        return process

    def submit_long(self):
        return self.run_it("submit", SPRING, *LONG, "-o", "name")[0].strip()


def read_until(stream, text):
    """Reads until `text` has come; returns all that was read."""
    seen = b""
    deadline = time.monotonic() + PATIENCE_S
    while text not in seen and time.monotonic() < deadline:
        if select.select([stream], [], [], 1)[0]:
            block = os.read(stream if isinstance(stream, int) else stream.fileno(), 65536)
            if not block:
                break
            seen += block
    if text not in seen:
        raise AssertionError(f"{text!r} did not come, but {seen[-2000:]!r}")
    return seen
