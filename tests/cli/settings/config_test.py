"""Where contactctl takes its settings from: flag, variable, files, profiles."""

import json
import os
import pathlib
import shutil
import subprocess
import tempfile
import unittest

CONTACTCTL = os.environ["CONTACTCTL"]


class ConfigTest(unittest.TestCase):

    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="contactctl-config-"))
        self.addCleanup(shutil.rmtree, self.folder)
        self.user = self.folder / ".config" / "contact" / "config.toml"
        self.here = self.folder / "here" / "contact.toml"
        self.here.parent.mkdir()
        self.user.parent.mkdir(parents=True)

    def run_it(self, *arguments, code=0, **variables):
        clean = {k: v for k, v in os.environ.items()
                 if not k.startswith(("CONTACT_", "XDG_CONFIG"))}
        run = subprocess.run([CONTACTCTL, *arguments], cwd=self.here.parent, encoding="utf-8",
                             env={**clean, "HOME": str(self.folder), **variables},
                             capture_output=True, timeout=60)
        self.assertEqual(run.returncode, code, run.stdout + run.stderr)
        return run.stdout, run.stderr

    def view(self, key, *flags, **variables):
        """Value and origin of a setting."""
        value = json.loads(self.run_it("config", "view", "-o", "json", *flags, **variables)[0])[key]
        return value["value"], value["origin"]

    def test_flag_wins_over_variable_over_folder_over_user_over_default(self):
        self.assertEqual(self.view("server"), ("127.0.0.1:7070", "default"))
        self.user.write_text('\nserver = "user:1"\n')
        self.assertEqual(self.view("server"), ("user:1", f"{self.user}:2"))
        self.here.write_text('server = "here:1"\n')
        self.assertEqual(self.view("server"), ("here:1", "contact.toml:1"))
        variable = {"CONTACT_SERVER": "variable:1"}
        self.assertEqual(self.view("server", **variable), ("variable:1", "CONTACT_SERVER"))
        self.assertEqual(self.view("server", "--server", "flag:1", **variable),
                         ("flag:1", "--server"))

    def test_profile_wins_over_what_is_outside_of_it(self):
        self.here.write_text('server = "here:1"\n')
        self.user.write_text('[profile.lab]\nserver = "lab:1"\ntimeout = "3s"\n')
        self.assertEqual(self.view("server", "--profile", "lab")[0], "lab:1")
        self.assertEqual(self.view("timeout", CONTACT_PROFILE="lab")[0], "3s")
        self.assertEqual(self.view("server")[0], "here:1")

    def test_profile_that_is_typed_wins_over_the_variable(self):
        self.user.write_text('[profile.lab]\nserver = "lab:1"\n')
        variable = {"CONTACT_SERVER": "variable:1"}
        self.assertEqual(self.view("server", "--profile", "lab", **variable),
                         ("lab:1", f"{self.user}:2"))
        self.assertEqual(self.view("server", CONTACT_PROFILE="lab", **variable)[0], "variable:1")

    def test_use_chooses_a_profile_from_now_on(self):
        self.run_it("config", "use", "lab", code=2)
        self.run_it("config", "set", "server", "lab:1", "--profile", "lab")
        self.run_it("config", "use", "lab")
        self.assertEqual(self.run_it("config", "get", "server")[0], "lab:1\n")
        self.assertIn("lab      lab:1   yes", self.run_it("config", "list")[0])
        self.run_it("config", "use", "")
        self.assertEqual(self.run_it("config", "get", "server")[0], "127.0.0.1:7070\n")

    def test_commands_obey(self):
        self.user.write_text('server = "127.0.0.1:1"\ntimeout = "2s"\n')
        self.assertIn("cannot reach contactd at 127.0.0.1:1", self.run_it("list", code=4)[1])
        self.assertIn("CONTACT_OUTPUT: output svg: this command prints",
                      self.run_it("list", code=2, CONTACT_OUTPUT="svg")[1])

    def test_set_keeps_what_else_is_in_the_file(self):
        self.user.write_text("# mine\nserver = 'a:1'  # old\n\n[profile.lab]\n# theirs\n")
        self.run_it("config", "set", "server", "b:2")
        self.run_it("config", "set", "timeout", "5s")
        self.run_it("config", "set", "server", "it's:3", "--profile", "lab")
        self.assertEqual(self.user.read_text(),
                         "# mine\nserver = 'b:2'\ntimeout = '5s'\n\n[profile.lab]\n# theirs\n"
                         'server = "it\'s:3"\n')
        self.run_it("config", "set", "output", "xml", code=2)
        self.assertIn("did you mean 'server'?", self.run_it("config", "set", "sever", "x:1",
                                                            code=2)[1])

    def test_mistakes_in_files_are_told_at_their_place(self):
        for text, told in (('sever = "x:1"\n', "contact.toml:1:9: unknown key 'sever' — did you "
                            "mean 'server'?"),
                           ("server =\n", "contact.toml:"), ("server = [1]\n", "must be a text"),
                           ("[profile.lab]\nsevrer = 'x'\n", "contact.toml:2:"),
                           ('use_profile = "lab"\n', "there is no profile 'lab'"),
                           ('profile = "lab"\n', "use_profile"),
                           ('output = "xml"\n', "contact.toml:1: ")):
            with self.subTest(text):
                self.here.write_text(text)
                code = 2 if "no profile" in told or "xml" in text else 11
                self.assertIn(told, self.run_it("list", code=code)[1])
                self.assertIn(told, self.run_it("config", "view", code=code)[1])
                self.run_it("version")  # Which needs no settings.


if __name__ == "__main__":
    unittest.main()
