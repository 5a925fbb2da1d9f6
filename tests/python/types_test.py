"""The package and what its users write have types: mypy --strict finds no mistake, or the right
one."""

import os
import pathlib
import re
import subprocess
import sys
import tempfile
import typing
import unittest

from contactsim.figures import PRESETS
from contactsim.plotting import Preset

PACKAGE = pathlib.Path(__file__).parents[2] / "client" / "python"

RIGHT = """
from contactsim import Client, Result

def residual(client: Client, file: str) -> float:
    result: Result = client.run(file, set={"contacts[0].restitution": 0.7})
    return result.job.summary.energy_residual

def newest(client: Client) -> str:
    found: Result = client.result("last")
    client.cancel(client.last())
    found.plot("force-map")
    return client.result(found).name
"""
WRONG = {"client.run(1)": "[arg-type]", "client.get('x').title + 1": "[operator]",
         "client.get(1)": "[arg-type]", "client.run('x').plot('forces')": "[arg-type]",
         "client.run('x')['a'].shapes": "[attr-defined]", "client.list(state=[])": "[call-arg]",
         "client.run('x').converged.values": "[attr-defined]"}
# Debian has no types for pandas and xarray; with those of PyPI mypy knows what a table is.
STUBS = {"pandas": "class DataFrame: ...\nclass Series: ...\nclass Index: ...\n",
         "xarray": "class Dataset: ...\n"}
TABLES = ["list()", "run('x').series", "run('x').cycles", "run('x').bodies", "run('x').iterations",
          "sweep('x', {}).frame"]


class TypesTest(unittest.TestCase):

    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = pathlib.Path(folder.name)  # With what mypy knows of the package by then.

    def mypy(self, *arguments):
        # The contract's stubs are beside its modules.
        stubs = [path for path in sys.path if (pathlib.Path(path) / "contact").is_dir()]
        environment = {**os.environ, "MYPYPATH": os.pathsep.join([str(PACKAGE), str(self.folder), *stubs])}
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
        for place, (line, code) in enumerate(WRONG.items(), RIGHT.count("\n") + 3):
            self.assertRegex(said, rf"program.py:{place}: error: .*{re.escape(code)}", line)

    def test_presets_of_types_are_those_there_are(self):
        self.assertEqual(typing.get_args(Preset), tuple(PRESETS))

    def test_series_and_tables_are_known_where_pandas_has_types(self):
        for package, stub in STUBS.items():
            (self.folder / f"{package}.pyi").write_text(stub)
            self.addCleanup((self.folder / f"{package}.pyi").unlink)
        program = self.folder / "tables.py"
        shown = "".join(f"reveal_type(client.{table})\n" for table in [*TABLES, "run('x').xr"])
        program.write_text(f"from contactsim import Client\nclient = Client()\n{shown}")
        said = self.mypy("--follow-imports=silent", program)
        self.assertEqual(said.count('Revealed type is "pandas.DataFrame"'), len(TABLES), said)
        self.assertIn('Revealed type is "xarray.Dataset"', said)


if __name__ == "__main__":
    unittest.main()
