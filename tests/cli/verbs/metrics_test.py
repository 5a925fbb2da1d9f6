"""The metrics of a server, as contactctl prints them."""

import os
import re
import socket
import subprocess
import tempfile
import unittest

from cli_case import CHAIN, CliTest
from contactd import PATIENCE_S

CONTACTD = os.environ["CONTACTD"]


class MetricsTest(CliTest):

    def test_page_of_the_server_is_printed(self):
        with socket.socket() as free:
            free.bind(("127.0.0.1", 0))
            port = free.getsockname()[1]
        with tempfile.TemporaryDirectory() as data:
            server = subprocess.Popen(
                [CONTACTD, "--listen", "127.0.0.1:0", "--data-dir", data, "--metrics-listen",
                 f"127.0.0.1:{port}"], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
            self.addCleanup(server.wait)
            self.addCleanup(server.kill)
            self.addCleanup(server.stdout.close)
            address = re.search(r"127\.0\.0\.1:\d+", server.stdout.readline()).group()
            self.run_it("run", CHAIN, "-o", "name", server=address)
            page = self.run_it("server", "metrics", "--metrics", f"127.0.0.1:{port}")[0]
            server.terminate()
            server.wait(PATIENCE_S)
        self.assertRegex(page, r'(?m)^contactd_job_moves_total\{state="SUCCEEDED",reason=""\} 1$')
        self.assertIn("# TYPE contactd_workers gauge\n", page)

    def test_server_without_metrics_is_told_with_what_to_do(self):
        said = self.run_it("server", "metrics", "--metrics", "127.0.0.1:1", code=4)[1]
        self.assertIn("no metrics at http://127.0.0.1:1/metrics: ", said)
        self.assertIn("contactd --metrics-listen HOST:PORT", said)

    def test_server_that_asks_nobody_has_its_metrics_at_its_address(self):
        page = self.run_it("server", "metrics", "--metrics", f"127.0.0.1:{self.server.port}")[0]
        self.assertIn("# TYPE contactd_workers gauge\n", page)


if __name__ == "__main__":
    unittest.main()
