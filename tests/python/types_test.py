"""The package and what its users write have types: mypy --strict finds no mistake, or the right
one."""

import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

PACKAGE = pathlib.Path(__file__).parents[2] / "client" / "python"

RIGHT = """
from contactsim import Client, Result

def residual(client: Client, file: str) -> float:
    result: Result = client.run(file, set={"contacts[0].restitution": 0.7})
    return result.job.summary.energy_residual
"""
WRONG = {"client.run(1)": "[arg-type]", "client.get('x').title + 1": "[operator]"}


class TypesTest(unittest.TestCase):

    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = pathlib.Path(folder.name)  # With what mypy knows of the package by then.

    def mypy(self, *arguments):
        # The contract's stubs are beside its modules.
        stubs = [path for path in sys.path if (pathlib.Path(path) / "contact").is_dir()]
        environment = {**os.environ, "MYPYPATH": os.pathsep.join([str(PACKAGE), *stubs])}
        run = subprocess.run(
            ["mypy", "--strict", "--cache-dir", self.folder, *map(str, arguments)],
            cwd=PACKAGE, env=environment, capture_output=True, encoding="utf-8", timeout=300)
        return run.stdout + run.stderr

    def test_package_is_strictly_typed(self):
        self.assertIn("Success: no issues found", self.mypy("-p", "contactsim"))

    def test_mistakes_of_users_are_found(self):
        program = self.folder / "program.py"
        program.write_text(RIGHT)
        self.assertIn("Success: no issues found", self.mypy(program))
        lines = "".join(f"    {line}\n" for line in WRONG)
        program.write_text(f"{RIGHT}\ndef wrong(client: Client) -> None:\n{lines}")
        said = self.mypy(program)
        for code in WRONG.values():
            self.assertIn(code, said)


if __name__ == "__main__":
    unittest.main()
