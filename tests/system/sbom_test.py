"""deploy/sbom names what the programs load."""

import json
import os
import pathlib
import subprocess
import unittest

from contactd import PATIENCE_S

SBOM = pathlib.Path(__file__).resolve().parents[2] / "deploy/sbom"


class SbomTest(unittest.TestCase):

    def setUp(self):
        done = subprocess.run([SBOM, os.environ["CONTACTD"]], check=True, timeout=PATIENCE_S,
                              stdout=subprocess.PIPE)
        self.document = json.loads(done.stdout)

    def test_libraries_have_the_versions_that_are_installed(self):
        found = {part["name"]: part.get("version") for part in self.document["components"]}
        for package in ("libgrpc++1.51", "libprotobuf32", "libsqlite3-0", "libssl3", "libspdlog1.10"):
            installed = subprocess.run(["dpkg-query", "--show", "--showformat=${Version}", package],
                                       check=True, stdout=subprocess.PIPE, text=True).stdout
            self.assertEqual(found[package], installed)

    def test_program_depends_on_each(self):
        (program,) = self.document["dependencies"]
        libraries = {part["bom-ref"] for part in self.document["components"]
                     if part["type"] == "library"}
        self.assertEqual(program["ref"], "contactd")
        self.assertEqual(set(program["dependsOn"]), libraries)


if __name__ == "__main__":
    unittest.main()
