"""contactctl open: the page of the server or of a job; its address where there is no browser."""

import pathlib
import subprocess
import unittest

from cli_case import CONTACTCTL
from contactd import PATIENCE_S, Server, ServerTest, three_ball_chain


class OpenTest(ServerTest):

    flags = ("--http-listen=127.0.0.1:0",)

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

    def test_it_gives_the_address_to_the_browser(self):
        seen = self.folder / "seen"
        browser = self.folder / "browser"
        browser.write_text(f'#!/bin/sh\necho "$1" > {seen}\n')
        browser.chmod(0o755)
        printed = self.open(BROWSER=str(browser))
        self.assertEqual(seen.read_text(), printed)

    def test_a_server_without_a_page_says_what_it_needs(self):
        self.server.kill()
        self.server = Server(pathlib.Path(self.folder / "other"))
        self.addCleanup(self.server.kill)
        self.server.start()
        self.assertIn("--http-listen", self.open(code=11))


if __name__ == "__main__":
    unittest.main()
