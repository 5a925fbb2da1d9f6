"""Adds what lies elsewhere to the package when it is built: the modules generated from the
contract, with stubs for those who check types, and the scenarios that are its templates. Its version
is that of the project in CMakeLists.txt."""

import pathlib
import re
import shutil
import subprocess
import tempfile

from setuptools import setup
from setuptools.command.build_py import build_py

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROTO = ROOT / "proto"
VERSION = re.search(r"project\(contactd VERSION (\S+)", (ROOT / "CMakeLists.txt").read_text())[1]


# google.rpc is of googleapis-common-protos, which may be installed or not: the package has modules of
# its own for where it is not, and no file in google/. Two modules for one file of the contract would
# not do in one process.
RPC = '''"""google.rpc: that which is installed, else the contract's own."""
try:
    from google.rpc import error_details_pb2 as error_details_pb2
    from google.rpc import status_pb2 as status_pb2
except ImportError:
    from contact.rpc.own import error_details_pb2 as error_details_pb2
    from contact.rpc.own import status_pb2 as status_pb2
'''


class BuildWithContract(build_py):
    """Runs protoc with gRPC's plugin, as the build of the server does."""

    def run(self):
        super().run()
        out = pathlib.Path(self.build_lib).resolve()
        own = out / "contact" / "rpc" / "own"
        own.mkdir(parents=True, exist_ok=True)
        generate(out, "contact")
        with tempfile.TemporaryDirectory() as folder:
            generate(pathlib.Path(folder), "google")  # grpc/ is grpcio's own.
            for made in pathlib.Path(folder).rglob("*_pb2.py*"):
                shutil.copy(made, own)
        (out / "contact" / "rpc" / "__init__.py").write_text(RPC)
        for made in (out / "contact" / "v1").glob("*_pb2.py*"):
            made.write_text(made.read_text().replace("from google.rpc import", "from contact.rpc import"))
        for package in ("rpc", "v1"):
            (out / "contact" / package / "py.typed").touch()
        templates = out / "contactsim" / "templates"
        templates.mkdir(exist_ok=True)
        for scenario in (ROOT / "client" / "scenarios").glob("*.yaml"):
            shutil.copy(scenario, templates)


def generate(out, package):
    """The modules of the .proto files in proto/PACKAGE, with stubs."""
    protos = sorted(str(path.relative_to(PROTO)) for path in (PROTO / package).rglob("*.proto"))
    services = [path for path in protos if path.endswith("service.proto")]
    subprocess.run(["protoc", f"--python_out={out}", f"--pyi_out={out}", *protos], cwd=PROTO,
                   check=True)
    if services:
        subprocess.run(["protoc", "--plugin=protoc-gen-grpc=/usr/bin/grpc_python_plugin",
                        f"--grpc_out={out}", *services], cwd=PROTO, check=True)


setup(version=VERSION, cmdclass={"build_py": BuildWithContract})
