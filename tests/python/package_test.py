"""The package as it is installed: with the modules generated from the contract."""

import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest
import zipfile

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
            python = installed(wheel_in(folder), pathlib.Path(folder) / "bare")
            said = run(python, USE + "; print(contactsim.__version__); "
                       "print(contactsim.load_scenario('two-balls').title)", DEBIAN)
            self.assertEqual(said.count(str(python.parents[1])), 2, said)
            self.assertRegex(said, r"(?m)^\d+\.\d+\.\d+$")
            self.assertIn("Two balls, one collision", said)

    def test_wheel_owns_no_file_of_google_and_takes_its_modules_where_they_are(self):
        with tempfile.TemporaryDirectory() as folder:
            wheel = wheel_in(folder)
            names = zipfile.ZipFile(wheel).namelist()
            self.assertEqual({name.split("/")[0] for name in names if "dist-info" not in name},
                             {"contact", "contactsim"})
            python = installed(wheel, pathlib.Path(folder) / "bare")
            foreign = pathlib.Path(folder) / "foreign"
            self.assertIn("contact.rpc.own.status_pb2", run(python, USE + WHOSE, DEBIAN))
            other_google_rpc(foreign)
            for order in (USE + THEIRS, THEIRS[2:] + "; " + USE):
                self.assertIn("google.rpc.status_pb2",
                              run(python, order + WHOSE, f"{foreign}:{DEBIAN}"))

    def test_wheel_works_with_another_python_of_the_same_version(self):
        # Such as one of pyenv or conda. The compiled modules of Debian fit the same version only.
        version = f"{sys.version_info.major}.{sys.version_info.minor}"
        found = [path for path in pathlib.Path.home().glob(f".pyenv/versions/{version}.*/bin/python")]
        if not found:
            self.skipTest(f"no Python {version} of pyenv is here")
        with tempfile.TemporaryDirectory() as folder:
            python = installed(wheel_in(folder), pathlib.Path(folder) / "bare", found[0])
            self.assertIn(str(python.parents[1]), run(python, USE, DEBIAN))


USE = ("import contactsim, contact.v1.job_service_pb2_grpc as g; "
       "print(contactsim.__file__, g.__file__)")
THEIRS = "; from google.rpc import error_details_pb2, status_pb2"
WHOSE = "; from contactsim import errors; print(errors.status_pb2.__name__)"
DEBIAN = "/usr/lib/python3/dist-packages"  # Lends what the package depends on.


def wheel_in(folder):
    return subprocess.run([ROOT / "deploy" / "wheel", folder], check=True, timeout=120,
                          capture_output=True, text=True).stdout.strip()


def installed(wheel, folder, base=sys.executable):
    """The Python of a new environment with the wheel; without an index."""
    subprocess.run([base, "-m", "venv", folder], check=True, timeout=120)
    subprocess.run([folder / "bin" / "python", "-m", "pip", "install", "-q", "--no-index", "--no-deps",
                    wheel], check=True, timeout=120)
    return folder / "bin" / "python"


def run(python, program, path):
    """What the program prints."""
    done = subprocess.run([python, "-c", program], cwd=python.parent, timeout=120, text=True,
                          env={"PATH": str(python.parent), "PYTHONPATH": path},
                          capture_output=True)
    if done.returncode:
        raise AssertionError(done.stderr)
    return done.stdout


def other_google_rpc(folder):
    """google.rpc as another package has it: the same messages, of files that are not the same."""
    sources = folder / "proto" / "google" / "rpc"
    sources.mkdir(parents=True)
    for proto in (ROOT / "proto" / "google" / "rpc").glob("*.proto"):
        (sources / proto.name).write_text(f"{proto.read_text()}\nmessage Other{proto.stem.title()} {{}}\n")
    subprocess.run(["protoc", f"--python_out={folder}", "google/rpc/status.proto",
                    "google/rpc/error_details.proto"], cwd=folder / "proto", check=True)


if __name__ == "__main__":
    unittest.main()
