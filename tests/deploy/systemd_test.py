"""The units of deploy/debian are what systemd takes, and give contactd no more than it needs."""

import os
import pathlib
import re
import shutil
import subprocess
import tempfile
import tomllib
import unittest

from flags import existing, unknown

DEBIAN = pathlib.Path(__file__).resolve().parents[2] / "deploy/debian"
UNITS = ("contactd.service", "contactd-front.service", "contactd-worker@.service",
         "contactd-launcher.service")
SETTINGS = ("contactd.conf", "front.conf", "worker.conf", "launcher.conf")
MOST_EXPOSURE = 20  # Of 100.
PLACE = "lib/systemd/system"


def analyze(*words):
    return subprocess.run(["systemd-analyze", *map(str, words)], capture_output=True, text=True,
                          timeout=60, check=False)


@unittest.skipUnless(shutil.which("systemd-analyze"), "systemd-analyze is not here")
class SystemdTest(unittest.TestCase):

    def setUp(self):
        """The units where the package puts them, below a folder."""
        self.root = pathlib.Path(tempfile.mkdtemp(prefix="contact-units-"))
        self.addCleanup(shutil.rmtree, self.root)
        lines = [line.split() for line in (DEBIAN / "contactd.install").read_text().splitlines()]
        for file, folder in [*lines, ["debian/contactd.service", PLACE]]:
            (self.root / folder).mkdir(parents=True, exist_ok=True)
            shutil.copy(DEBIAN.parent / file, self.root / folder)

    def unit(self, name, program="/usr/bin/contactd"):
        """The path of a unit, or of an instance of it, that starts the program."""
        path = self.root / PLACE / name
        path.write_text(path.read_text().replace("/usr/bin/contactd", str(program)))
        return path.with_name(name.replace("@.", "@1."))

    def exposure(self, name):
        return analyze("security", "--offline=yes", f"--threshold={MOST_EXPOSURE}",
                       self.unit(name))

    def test_systemd_takes_every_unit(self):
        for name in UNITS:
            done = analyze("verify", "--man=no", self.unit(name, os.environ["CONTACTD"]))
            told = [line for line in done.stderr.splitlines() if line.startswith("contactd")]
            self.assertEqual((done.returncode, told), (0, []), name)

    def test_no_unit_is_exposed(self):
        for name in UNITS:
            done = self.exposure(name)
            print(name, re.findall(r"exposure level for .*: (\S+)", done.stdout))
            self.assertEqual(done.returncode, 0, done.stdout)

    def test_hardening_is_what_protects_them(self):
        shutil.rmtree(self.root / PLACE / "contactd-.service.d")
        self.assertNotEqual(self.exposure("contactd-front.service").returncode, 0)

    def test_settings_are_flags_of_contactd(self):
        for name in SETTINGS:
            text = (DEBIAN / name).read_text()
            offered = re.sub(r"^#(?=[a-z-]+ = )", "", text, flags=re.M)
            for setting in tomllib.loads(offered):
                self.assertIn(f"--{setting}", existing(), name)

    def test_commands_have_flags_of_contactd_and_settings_that_are_installed(self):
        for name in UNITS:
            start = re.search(r"^ExecStart=\S+ (.*)$", (DEBIAN / name).read_text(), re.M)
            command = start[1].split()
            self.assertEqual(unknown(command), [], name)
            settings = pathlib.Path(command[command.index("--config") + 1])
            self.assertTrue((self.root / settings.relative_to("/")).exists(), settings)

    def test_workers_of_slurm_log_where_every_node_can_write(self):
        settings = tomllib.loads((DEBIAN / "launcher.conf").read_text())
        self.assertRegex(settings["slurm-output"], "^/tmp/.*%j",
                         "a relative path begins at /, in which the unit is started")

    def test_front_names_the_credentials_that_it_is_given(self):
        unit = (DEBIAN / "contactd-front.service").read_text()
        given = re.findall(r"^LoadCredential=([^:]+):", unit, re.M)
        named = re.findall(r"/run/credentials/contactd-front\.service/([\w.]+)",
                           (DEBIAN / "front.conf").read_text())
        self.assertEqual(set(given), {*named, "pg_service.conf"})


if __name__ == "__main__":
    unittest.main()
