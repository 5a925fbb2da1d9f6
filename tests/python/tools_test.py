"""Translations are contactctl's; what is said where it is not there or fails."""

import os
import pathlib
import tempfile
import unittest
from unittest import mock

from contactsim import ToolFailed, translate

CONTACT = {"mass": 1, "velocity": 1, "restitution": 0.5, "stiffness": 1}


class ToolsTest(unittest.TestCase):

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.program = pathlib.Path(folder.name) / "contactctl"

    def ask(self):
        with mock.patch.dict(os.environ, {"CONTACTCTL": str(self.program)}):
            return translate("mujoco", **CONTACT)

    def test_missing_program_is_told_with_its_package(self):
        with mock.patch.dict(os.environ, {"PATH": "/nowhere"}):
            os.environ.pop("CONTACTCTL", None)
            with self.assertRaisesRegex(ToolFailed, "apt install contactctl"):
                translate("mujoco", **CONTACT)
        with self.assertRaisesRegex(ToolFailed, "cannot be run: No such file"):
            self.ask()

    def test_words_of_a_failure_are_those_of_the_program(self):
        self.program.write_text("#!/bin/sh\necho no such tool >&2; exit 6\n")
        self.program.chmod(0o755)
        with self.assertRaisesRegex(ToolFailed, "^no such tool$"):
            self.ask()

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


if __name__ == "__main__":
    unittest.main()
