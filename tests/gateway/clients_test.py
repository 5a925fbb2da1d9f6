"""The gateway as clients of other projects see it: connect-es, grpc-web, buf. See clients/."""

import pathlib
import re
import shutil
import subprocess
import os
import unittest

from contactd import PATIENCE_S
from gateway import GatewayTest

ROOT = pathlib.Path(__file__).parents[2]
CLIENTS = pathlib.Path(__file__).parent / "clients"


class ClientsTest(GatewayTest):

    def install(self):
        """A folder with the packages of the lock file."""
        if not shutil.which("npm"):
            self.skipTest("npm is not installed")
        folder = self.folder / "clients"
        shutil.copytree(CLIENTS, folder, ignore=shutil.ignore_patterns("node_modules"))
        try:
            run = subprocess.run(["npm", "ci", "--no-audit", "--no-fund", "--fetch-retries=0",
                                  "--fetch-timeout=20000"],
                                 cwd=folder, capture_output=True, text=True, timeout=180)
        except subprocess.TimeoutExpired:
            self.skipTest("npm's registry does not answer")
        if re.search(r"ENOTFOUND|EAI_AGAIN|ECONNREFUSED|ETIMEDOUT", run.stderr):
            self.skipTest("npm's registry is not reachable")
        self.assertEqual(run.returncode, 0, run.stderr)
        return folder

    def test_all_clients(self):
        folder = self.install()
        contract = folder / "contract.binpb"
        proto = ROOT / "proto"
        subprocess.run(
            ["protoc", f"-I{proto}", "--include_imports", "--include_source_info",
             f"--descriptor_set_out={contract}", "google/rpc/error_details.proto",
             *(str(path.relative_to(proto)) for path in (proto / "contact/v1").glob("*.proto"))],
            check=True)
        run = subprocess.run(
            ["node", "--test", "--test-reporter=spec", "clients.test.mjs"], cwd=folder,
            capture_output=True, text=True, timeout=4 * PATIENCE_S,
            env=os.environ | {"SERVER": f"http://127.0.0.1:{self.http}", "JOB": self.one_job(),
                              "DESCRIPTORS": str(contract)})
        self.assertEqual(run.returncode, 0, run.stdout + run.stderr)
        print(re.search(r"ℹ pass \d+", run.stdout)[0])


if __name__ == "__main__":
    unittest.main()
