"""The points of every preset are, to the last digit, those that contactctl 0.1.0 drew of the runs in
golden/: files are `contactctl export -o protobuf` and `contactctl plot -o csv` of that version."""

import unittest

from contactsim.figures import FigureError, preset_figure
from contactsim.figures.figure import points_csv
from sample_run import GOLDEN, stored_run


class GoldenTest(unittest.TestCase):

    def test_points_of_every_preset_are_those_drawn_before(self):
        for name in ("chain", "spring"):
            run = stored_run(name)
            for path in GOLDEN.glob(f"{name}-*.csv"):
                preset = path.stem.removeprefix(f"{name}-")
                with self.subTest(f"{name} {preset}"):
                    drawn = points_csv(preset_figure(preset, run)).replace("m^(5/2)", "m^(n+1)")
                    self.assertEqual(drawn, path.read_text("utf-8"))

    def test_what_that_version_did_not_record_is_told(self):
        run = stored_run("spring")
        for preset in ("acceleration", "energy", "supports"):
            with self.subTest(preset), self.assertRaisesRegex(FigureError, "an older server made it"):
                preset_figure(preset, run)


if __name__ == "__main__":
    unittest.main()
