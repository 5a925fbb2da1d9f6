"""contactctl model translate: what it prints, what it refuses, and that both ways agree."""

import json
import os
import subprocess
import unittest

CONTACT = ("--restitution=0.6", "--velocity=0.5", "--mass=2", "--stiffness=1e6", "--radius=0.03")


def translate(*arguments):
    return subprocess.run([os.environ["CONTACTCTL"], "model", "translate", *arguments],
                          capture_output=True, encoding="utf-8", timeout=60)


def answer(*arguments):
    return json.loads(translate(*arguments, "-o", "json").stdout)


class TranslateTest(unittest.TestCase):

    def refused(self, words, *arguments):
        run = translate(*arguments)
        self.assertEqual(run.returncode, 2, run.stdout)
        self.assertIn(words, run.stderr)

    def test_what_is_missing_or_contradicts_is_refused(self):
        self.refused("--mass must be given", "--restitution=0.5", "--velocity=1", "--stiffness=1")
        self.refused("--velocity must be given", "--restitution=0.5", "--mass=1", "--stiffness=1")
        self.refused("either --stiffness or --contact-time", *CONTACT, "--contact-time=1")
        self.refused("from 0.01 to 1", "--restitution=1.5", *CONTACT[1:])
        self.refused("--mass must be from 0 to 1e30", "--mass=inf", *CONTACT[:2], *CONTACT[3:])
        self.refused("several values of --velocity", *CONTACT, "--velocity=1,2")
        self.refused("--set needs --from", *CONTACT, "--set=kn=1")
        self.refused("follow from --from", *CONTACT, "--from=drake")
        self.refused("did you mean", "mujoko", *CONTACT)

    def test_parameters_of_the_simulator_of_from_are_told(self):
        begin = ("--from=ode", "--mass=1", "--velocity=1")
        self.refused("soft_erp [1], soft_cfm [m/(N*s)]", *begin, "--step=0.01", "--set=soft_erp=1")
        self.refused("ode has the parameters", *begin, "--step=0.01",
                     "--set=soft_erp=1,soft_cfm=1,kp=1")
        self.refused("ode needs --step", *begin, "--set=soft_erp=1,soft_cfm=1")

    def test_what_hardly_rebounds_is_refused(self):
        begin = ("--mass=1", "--velocity=1", "--radius=0.1")
        words = "damps nearly everything"
        self.refused(words, *begin, "--from=simscape-damped", "--set=stiffness=1,damping=1e9")
        self.refused(words, *begin, "--from=ode", "--step=1", "--set=soft_erp=2,soft_cfm=1")
        self.refused(words, *begin, "--from=liggghts-hertz",
                     "--set=youngsModulus=1e7,coefficientRestitution=0")

    def test_both_ways_agree(self):
        there, = answer("lammps-hertz", *CONTACT)["translations"]
        values = ",".join(f"{p['name']}={p['value']!r}" for p in there["parameters"])
        back = answer("lammps-hertz", "--from=lammps-hertz", f"--set={values}", "--mass=2",
                      "--velocity=0.5,2", "--radius=0.03")
        first, second = (r["delivered"]["velocity_ratio"] for r in back["rebounds"])
        self.assertAlmostEqual(first, 0.6, delta=1e-6)
        self.assertLess(second, 0.6)  # ε of a √δ damper falls with the speed.
        for one, other in zip(there["parameters"], back["translations"][0]["parameters"]):
            self.assertAlmostEqual(one["value"] / other["value"], 1, delta=1e-6)

    def test_without_a_name_every_simulator_is_there(self):
        found = answer(*CONTACT, "--step=1e-5")["translations"]
        self.assertEqual(len(found), 26)
        for tool in found:
            self.assertAlmostEqual(tool["delivered"]["restitution_alone"], 0.6, delta=1e-6)
            self.assertTrue(tool["source"].endswith(("read", "run")), tool["tool"])
        printed = translate(*CONTACT, "--step=1e-5").stdout
        for tool in found:
            self.assertIn(f"\n{tool['tool']} ", printed)

    def test_a_load_and_a_coarse_step_are_warned_of(self):
        heavy, = answer("yade", *CONTACT, "--gravity=1e4")["translations"]
        self.assertIsNone(heavy["delivered"]["restitution"])
        self.assertIn("under the load the bodies do not part", heavy["warnings"])
        coarse, = answer("bullet", *CONTACT, "--step=2e-3")["translations"]
        self.assertTrue(any("too few" in warning for warning in coarse["warnings"]))
        self.assertLess(coarse["at_step"]["mean"], 0.5)
        self.assertTrue(any("the step damps too" in warning for warning in coarse["warnings"]))


if __name__ == "__main__":
    unittest.main()
