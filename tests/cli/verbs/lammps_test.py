"""LAMMPS, where it is installed, gives back what contactctl says that its parameters give back."""

import pathlib
import shutil
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "peers"))
from simulators import Case, lammps, translate  # noqa: E402  The path is that of tests/peers.

MODELS = ("hooke", "hertz", "tsuji")
RESTITUTION = 0.5
STEP = 1e-5  # A contact takes 1,400 steps.


@unittest.skipUnless(shutil.which("lmp"), "LAMMPS is not installed")
class LammpsTest(unittest.TestCase):

    def test_models_give_back_what_is_asked_for(self):
        for model in MODELS:
            for tool in (f"lammps-{model}", f"lammps-{model}-limited"):
                case = Case(tool, RESTITUTION, STEP)
                told = translate(case)
                came = lammps(case, told)
                self.assertAlmostEqual(came, RESTITUTION, delta=1e-3, msg=tool)
                self.assertAlmostEqual(came, told.predicted, delta=2e-4, msg=tool)


if __name__ == "__main__":
    unittest.main()
