"""contactctl open: the page of the server or of a job; its address where there is no browser."""

import pathlib
import subprocess
import unittest

from cli_case import CONTACTCTL
from contactd import PATIENCE_S, Server, ServerTest, three_ball_chain


class OpenTest(ServerTest):

    def open(self, *arguments, code=0, **variables):
        run = subprocess.run(
            [CONTACTCTL, "--server", f"127.0.0.1:{self.server.port}", "open", *arguments],
            env={"PATH": "/usr/bin:/bin", "HOME": str(self.folder), **variables},
            capture_output=True, encoding="utf-8", timeout=PATIENCE_S)
        self.assertEqual(run.returncode, code, run.stdout + run.stderr)
        return run.stdout if code == 0 else run.stderr

    def test_it_prints_the_address_where_there_is_no_browser(self):
        name = self.server.run(three_ball_chain()).name
        self.assertRegex(self.open(), r"^http://127\.0\.0\.1:\d+/\n$")
        for job in (name, "last"):
            self.assertRegex(self.open(job),
                             rf"^http://127\.0\.0\.1:\d+/runs/{name.removeprefix('jobs/')}\n$")

    def test_a_file_is_told_with_the_verb_that_makes_a_job_of_it(self):
        file = self.folder / "chain.yaml"
        file.write_text("title: x\n")
        self.assertIn(f"contactctl submit {file}", self.open(str(file), code=2))

    def test_it_gives_the_address_to_the_browser(self):
        seen = self.folder / "seen"
        browser = self.folder / "browser"
        browser.write_text(f'#!/bin/sh\necho "$1" > {seen}\n')
        browser.chmod(0o755)
        printed = self.open(BROWSER=str(browser))
        self.assertEqual(seen.read_text(), printed)

    def test_an_address_of_its_own_for_browsers_is_told(self):
        self.server.kill()
        self.server = Server(pathlib.Path(self.folder / "other"), "--http-listen=127.0.0.1:0")
        self.addCleanup(self.server.kill)
        self.server.start()
        self.assertNotIn(f":{self.server.port}/", self.open())

    def test_a_page_at_a_socket_file_says_how_to_reach_it(self):
        self.server.kill()
        file = self.folder / "http"
        self.server = Server(pathlib.Path(self.folder / "other"), f"--http-listen=unix:{file}")
        self.addCleanup(self.server.kill)
        self.server.start()
        self.assertIn(f"ssh -N -L 8080:{file} HOST", self.open(code=11))


if __name__ == "__main__":
    unittest.main()
