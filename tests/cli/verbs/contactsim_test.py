"""What contactctl hands over to contactsim, which draws: words, server and identity."""

import json
import os
import pathlib
import shutil
import subprocess
import tempfile
import unittest

CONTACTCTL = os.environ["CONTACTCTL"]
FAKE = """import json, os, sys
print(json.dumps([sys.argv[1:], {k: v for k, v in os.environ.items() if k.startswith("CONTACT_")},
                  sys.stdin.read()]))
sys.exit(8)
"""
INSTALLED = subprocess.run(["/usr/bin/python3", "-c", "import contactsim"], cwd="/", env={},
                           capture_output=True).returncode == 0


class HandOverTest(unittest.TestCase):

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        (self.folder / "bin").mkdir()
        self.program = shutil.copy(CONTACTCTL, self.folder / "bin")

    def fake(self):
        package = self.folder / "python" / "contactsim"
        package.mkdir(parents=True)
        (package / "__init__.py").touch()
        (package / "__main__.py").write_text(FAKE)

    def run_it(self, *words, **environment):
        return subprocess.run([self.program, *map(str, words)], cwd=self.folder, text=True,
                              capture_output=True, timeout=60, stdin=subprocess.DEVNULL,
                              env={"PATH": os.environ["PATH"], **environment})

    def test_words_server_and_identity_go_over_and_the_exit_code_comes_back(self):
        self.fake()
        (self.folder / "my.token").write_text("secret")
        run = self.run_it("--server", "there:7", "--tls-ca", "ca.pem", "--token-file", "my.token",
                          "--timeout", "3s", "paper", "fig3", "-d", "out", "--format", "png",
                          CONTACT_CERT="c.pem", CONTACT_KEY="k.pem")
        self.assertEqual(run.returncode, 8, run.stderr)
        words, environment, _ = json.loads(run.stdout)
        self.assertEqual(words, ["--timeout=3", "paper", "--directory=out", "--format=png", "--",
                                 "fig3"])
        self.assertEqual(environment, {
            "CONTACT_SERVER": "there:7", "CONTACT_TLS_CA": "ca.pem", "CONTACT_CERT": "c.pem",
            "CONTACT_KEY": "k.pem", "CONTACT_TOKEN_FILE": "my.token"})
        self.assertNotIn("secret", run.stdout)

    def test_laws_go_over_as_a_table(self):
        self.fake()
        run = self.run_it("model", "plot", "alpha", "hu-guo", "-o", "pgf")
        self.assertEqual(run.returncode, 8)
        words, _, table = json.loads(run.stdout)
        self.assertEqual(words[1], "curves")
        self.assertIn("--file=alpha.pgf", words)
        self.assertEqual(table.splitlines()[0], "pre-restitution coefficient,HU_GUO")
        self.assertEqual(len(table.splitlines()), 97)

    @unittest.skipIf(INSTALLED, "contactsim is installed")
    def test_package_that_is_missing_is_named(self):
        run = self.run_it("paper", "fig3")
        self.assertEqual(run.returncode, 11)
        self.assertEqual(run.stderr, "contactctl: for drawing: apt-get install python3-contactsim "
                         "python3-matplotlib\n")


if __name__ == "__main__":
    unittest.main()
