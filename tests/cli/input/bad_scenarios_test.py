"""Every bad scenario below bad/ is refused in exactly the words beside it."""

import os
import pathlib
import subprocess
import unittest

CONTACTCTL = os.environ["CONTACTCTL"]
BAD = pathlib.Path(__file__).parent / "bad"


class BadScenarios(unittest.TestCase):
    def test_each_is_refused_in_the_words_beside_it(self):
        files = sorted(BAD.glob("*/*.yaml"))
        self.assertGreaterEqual(len(files), 40)
        for file in files:
            with self.subTest(file.name):
                run = subprocess.run([CONTACTCTL, "validate", file.name], cwd=file.parent, timeout=60,
                                     capture_output=True, encoding="utf-8")
                self.assertEqual(run.stderr, file.with_suffix(".txt").read_text("utf-8"))
                self.assertEqual(run.stdout, "")
                self.assertEqual(run.returncode, 3)


if __name__ == "__main__":
    unittest.main()
