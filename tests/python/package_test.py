"""The package as it is installed: with the modules generated from the contract."""

import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).parents[2]


class PackageTest(unittest.TestCase):

    def test_built_package_needs_nothing_of_the_source_tree(self):
        with tempfile.TemporaryDirectory() as folder:
            # A copy, because setuptools leaves files beside the sources.
            for part in ("client/python", "client/scenarios", "proto"):
                shutil.copytree(ROOT / part, pathlib.Path(folder) / part)
            shutil.copy(ROOT / "CMakeLists.txt", folder)
            built = pathlib.Path(folder) / "built"
            subprocess.run([sys.executable, "setup.py", "-q", "build", "--build-lib", built],
                           cwd=pathlib.Path(folder) / "client/python", check=True, timeout=120,
                           capture_output=True)
            for file in ("contactsim/py.typed", "contact/v1/py.typed", "contact/v1/job_pb2.pyi"):
                self.assertTrue((built / file).exists(), file)
            self.assertFalse((built / "grpc").exists())  # It would hide grpcio.
            environment = {**os.environ, "PYTHONPATH": str(built)}
            said = subprocess.run(
                [sys.executable, "-B", "-c",
                 "import contactsim, contact.v1.job_pb2 as j; print(j.__file__); "
                 "print(contactsim.load_scenario('two-balls').title)"],
                cwd=folder, env=environment, check=True, timeout=120, capture_output=True,
                text=True)
            self.assertTrue(said.stdout.startswith(str(built)), said.stdout)
            self.assertIn("Two balls, one collision", said.stdout)

    def test_wheel_installs_without_protoc_in_a_bare_environment(self):
        with tempfile.TemporaryDirectory() as folder:
            wheel = subprocess.run([ROOT / "deploy" / "wheel", folder], check=True, timeout=120,
                                   capture_output=True, text=True).stdout.strip()
            bare = pathlib.Path(folder) / "bare"
            subprocess.run([sys.executable, "-m", "venv", bare], check=True, timeout=120)
            python = bare / "bin" / "python"
            # Without an index: what it depends on is lent by Debian below.
            subprocess.run([python, "-m", "pip", "install", "-q", "--no-index", "--no-deps", wheel],
                           check=True, timeout=120)
            environment = {"PATH": str(bare / "bin"), "PYTHONPATH": "/usr/lib/python3/dist-packages"}
            said = subprocess.run(
                [python, "-c", "import contactsim, contact.v1.job_service_pb2_grpc as g; "
                 "print(contactsim.__file__, g.__file__); print(contactsim.__version__); "
                 "print(contactsim.load_scenario('two-balls').title)"],
                cwd=folder, env=environment, check=True, timeout=120, capture_output=True,
                text=True).stdout
            self.assertEqual(said.count(str(bare)), 2, said)
            self.assertRegex(said, r"(?m)^\d+\.\d+\.\d+$")
            self.assertIn("Two balls, one collision", said)


if __name__ == "__main__":
    unittest.main()
