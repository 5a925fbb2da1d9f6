"""Adds what lies elsewhere to the package when it is built: the modules generated from the
contract, with stubs for those who check types, and the scenarios that are its templates. Its version
is that of the project in CMakeLists.txt."""

import pathlib
import re
import shutil
import subprocess

from setuptools import setup
from setuptools.command.build_py import build_py

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROTO = ROOT / "proto"
VERSION = re.search(r"project\(contactd VERSION (\S+)", (ROOT / "CMakeLists.txt").read_text())[1]


class BuildWithContract(build_py):
    """Runs protoc with gRPC's plugin, as the build of the server does."""

    def run(self):
        super().run()
        out = pathlib.Path(self.build_lib).resolve()
        protos = sorted(str(path.relative_to(PROTO)) for folder in ("contact", "google")
                        for path in (PROTO / folder).rglob("*.proto"))  # grpc/ is grpcio's own.
        services = [path for path in protos if path.endswith("service.proto")]
        subprocess.run(["protoc", f"--python_out={out}", f"--pyi_out={out}", *protos], cwd=PROTO,
                       check=True)
        subprocess.run(["protoc", "--plugin=protoc-gen-grpc=/usr/bin/grpc_python_plugin",
                        f"--grpc_out={out}", *services], cwd=PROTO, check=True)
        (out / "contact" / "v1" / "py.typed").touch()
        templates = out / "contactsim" / "templates"
        templates.mkdir(exist_ok=True)
        for scenario in (ROOT / "client" / "scenarios").glob("*.yaml"):
            shutil.copy(scenario, templates)


setup(version=VERSION, cmdclass={"build_py": BuildWithContract})
