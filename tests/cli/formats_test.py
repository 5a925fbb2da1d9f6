"""The libraries of netCDF, MAT and PDF are loaded when they are asked for, and from where they are."""

import os
import pathlib
import shutil
import subprocess
import unittest

from contactctl_test import CHAIN, CliTest
from contactd import PATIENCE_S

PROGRAM = pathlib.Path(os.environ["CONTACTCTL"])
MODULE = "contactctl-formats.so"


class FormatsTest(CliTest):

    def setUp(self):
        super().setUp()
        self.job = self.run_it("run", CHAIN, "-o", "name")[0].strip()
        self.bin = self.folder / "usr" / "bin"
        self.bin.mkdir(parents=True)
        shutil.copy(PROGRAM, self.bin)

    def export(self):
        path = self.folder / "chain.nc"
        command = [self.bin / PROGRAM.name, "--server", f"127.0.0.1:{self.server.port}", "export",
                   self.job, "-f", path]
        run = subprocess.run(command, capture_output=True, encoding="utf-8", timeout=PATIENCE_S)
        return run, path

    def test_no_command_starts_with_them(self):
        needed = subprocess.run(["ldd", PROGRAM], capture_output=True, encoding="utf-8",
                                check=True, timeout=PATIENCE_S).stdout
        self.assertIn("libgrpc++", needed)
        for library in ("libnetcdf", "libhdf5", "libmatio", "libqpdf", "libcurl"):
            self.assertNotIn(library, needed)

    def test_module_is_found_where_it_is_installed(self):
        folder = self.folder / "usr" / "lib" / "contactctl"
        folder.mkdir(parents=True)
        shutil.copy(PROGRAM.with_name(MODULE), folder)
        run, path = self.export()
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertEqual(path.read_bytes()[:4], b"\x89HDF")

    def test_without_the_module_it_is_told_what_is_missing(self):
        run, _ = self.export()
        self.assertEqual(run.returncode, 11, run.stderr)
        self.assertIn(f"{MODULE}: neither in {self.bin} nor in ../lib/contactctl", run.stderr)
        self.assertIn("netCDF, MAT and PDF need it", run.stderr)

    def test_damaged_module_is_told_as_such(self):
        (self.bin / MODULE).write_bytes(b"no library")
        run, _ = self.export()
        self.assertEqual(run.returncode, 11, run.stderr)
        self.assertIn(str(self.bin / MODULE), run.stderr)

    def test_failure_of_the_library_is_told_as_that_of_a_file(self):
        said = self.run_it("export", self.job, "-f", self.folder / "missing" / "x.nc", code=11)[1]
        self.assertIn("missing/x.nc", said)


if __name__ == "__main__":
    unittest.main()
