"""What is said where contactctl, which makes reports, is not there or fails."""

import os
import pathlib
import tempfile
import unittest
from unittest import mock

from contactsim import Client, ToolFailed, translate


class ToolsTest(unittest.TestCase):

    def setUp(self):
        self.client = Client("127.0.0.1:1")
        self.addCleanup(self.client.close)
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.program = pathlib.Path(folder.name) / "contactctl"

    def ask(self, act):
        with mock.patch.dict(os.environ, {"CONTACTCTL": str(self.program)}):
            return act()

    def write(self, script):
        self.program.write_text("#!/bin/sh\n" + script)
        self.program.chmod(0o755)

    def test_missing_program_is_told_with_its_package(self):
        with mock.patch.dict(os.environ, {"PATH": "/nowhere"}):
            os.environ.pop("CONTACTCTL", None)
            with self.assertRaisesRegex(ToolFailed, "apt install contactctl"):
                self.client.report(["x"])
        with self.assertRaisesRegex(ToolFailed, "cannot be run: No such file"):
            self.ask(lambda: self.client.report(["x"]))

    def test_words_of_a_failure_are_those_of_the_program(self):
        self.write("echo no such job >&2; exit 6\n")
        with self.assertRaisesRegex(ToolFailed, "^no such job$"):
            self.ask(lambda: self.client.report(["x"]))

    def test_server_jobs_and_file_are_handed_over(self):
        self.write('echo "$@" > "$0.said"\n')
        page = self.ask(lambda: self.client.report(["a", "jobs/b"], "r.html"))
        self.assertEqual(page, pathlib.Path("r.html"))
        said = pathlib.Path(f"{self.program}.said").read_text("utf-8")
        self.assertEqual(said, "--server 127.0.0.1:1 report jobs/a jobs/b -f r.html\n")

    def test_translation_is_that_of_the_program(self):
        answer = translate("mujoco", mass=2, velocity=0.5, restitution=0.5, contact_time=0.01)
        found, = answer["translations"]
        stiffness, damping = (parameter["value"] for parameter in found["parameters"])
        self.assertAlmostEqual(found["delivered"]["velocity_ratio"], 0.5, delta=1e-6)
        self.assertAlmostEqual(damping, 2 * 0.255276 * stiffness**0.5, delta=1e-3)
        values = {"stiffness": stiffness, "damping": damping}
        back = translate("drake", mass=2, velocity=[0.5, 5], start="mujoco", values=values)
        self.assertEqual([rebound["velocity_m_per_s"] for rebound in back["rebounds"]], [0.5, 5])
        self.assertAlmostEqual(back["translations"][0]["delivered"]["velocity_ratio"], 0.5,
                               delta=1e-6)
        with self.assertRaisesRegex(ToolFailed, "there is no tool 'mujoko'"):
            translate("mujoko", mass=1, velocity=1, restitution=0.5, stiffness=1)

    def test_numbers_of_the_paper_that_deviate_are_no_failure(self):
        self.write("exit 8\n")
        self.assertFalse(self.ask(lambda: self.client.paper("p")))
        self.write("exit 0\n")
        self.assertTrue(self.ask(lambda: self.client.paper("p")))


if __name__ == "__main__":
    unittest.main()
