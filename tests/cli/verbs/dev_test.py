"""contactctl dev: a private server that leaves nothing; contactctl doctor; the manual."""

import json
import os
import pathlib
import re
import shutil
import signal
import subprocess
import tempfile
import time
import unittest

from cli_case import CHAIN, CONTACTCTL, read_until
from contactd import PATIENCE_S

CONTACTD = os.environ["CONTACTD"]


def runs(pid):
    """Whether the process is there and no zombie."""
    try:
        return pathlib.Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()[0] != "Z"
    except FileNotFoundError:
        return False


class LocalTest(unittest.TestCase):

    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="contactctl-dev-"))
        self.addCleanup(shutil.rmtree, self.folder)
        clean = {k: v for k, v in os.environ.items() if not k.startswith("CONTACT_")}
        self.environment = {**clean, "TMPDIR": str(self.folder), "HOME": str(self.folder),
                            "LC_ALL": "C.UTF-8"}

    def run_it(self, *arguments, code=0, **variables):
        run = subprocess.run([CONTACTCTL, *map(str, arguments)], cwd=self.folder,
                             env={**self.environment, **variables}, capture_output=True,
                             encoding="utf-8", timeout=PATIENCE_S)
        self.assertEqual(run.returncode, code, run.stdout + run.stderr)
        return run.stdout, run.stderr


class DevTest(LocalTest):

    def start(self):
        """A server of its own; its process, address and the pid of contactd."""
        process = subprocess.Popen([CONTACTCTL, "dev", "--contactd", CONTACTD], bufsize=0,
                                   env=self.environment, stdout=subprocess.PIPE)
        self.addCleanup(process.stdout.close)
        self.addCleanup(process.wait)
        self.addCleanup(process.kill)
        said = read_until(process.stdout, b"Ctrl-C").decode()
        children = pathlib.Path(f"/proc/{process.pid}/task/{process.pid}/children").read_text()
        return process, re.search(r"export CONTACT_SERVER=(\S+)", said)[1], int(children)

    def test_it_serves_until_a_signal_and_leaves_nothing(self):
        for how in (signal.SIGINT, signal.SIGTERM):
            process, address, child = self.start()
            self.assertIn("SUCCEEDED", self.run_it("run", CHAIN, CONTACT_SERVER=address)[0])
            process.send_signal(how)
            self.assertEqual(process.wait(PATIENCE_S), 0)
            self.assertFalse(runs(child))
            self.assertEqual(list(self.folder.glob("contactctl-*")), [])

    def test_server_dies_with_it(self):
        process, _, child = self.start()
        process.kill()
        deadline = time.monotonic() + PATIENCE_S
        while runs(child) and time.monotonic() < deadline:
            time.sleep(0.05)
        self.assertFalse(runs(child))

    def test_server_that_ends_is_told(self):
        process, _, child = self.start()
        os.kill(child, signal.SIGKILL)
        self.assertEqual(process.wait(PATIENCE_S), 11)

    def test_command_has_the_server_and_gives_its_code(self):
        inner = [CONTACTCTL, "run", CHAIN, "--set", "end_time_s=1e-3", "-o", "name"]
        printed, _ = self.run_it("dev", "--contactd", CONTACTD, "--", *inner)
        self.assertRegex(printed, r"^jobs/\w+\n$")
        self.run_it("dev", "--contactd", CONTACTD, "--", "sh", "-c", "exit 42", code=42)
        self.run_it("dev", "--contactd", CONTACTD, "--", "sh", "-c", "kill -9 $$", code=137)
        self.run_it("dev", "--contactd", CONTACTD, "--", "no-such-command", code=127)
        self.assertEqual(list(self.folder.glob("contactctl-*")), [])

    def test_no_contactd_is_code_11(self):
        self.assertIn("--contactd", self.run_it("dev", "--contactd", "/no/such", code=11)[1])
        self.assertEqual(list(self.folder.glob("contactctl-*")), [])


class DoctorTest(LocalTest):

    def test_all_is_well_beside_a_server(self):
        printed, _ = self.run_it("dev", "--contactd", CONTACTD, "--", CONTACTCTL, "doctor", "-o",
                                 "json")
        checks = {check["check"]: check for check in json.loads(printed)}
        self.assertEqual(set(checks), {"config", "server", "version", "clock", "figures",
                                       "terminal"})
        self.assertTrue(all(check["ok"] for check in checks.values()), printed)

    def test_every_trouble_has_a_fix_and_a_code(self):
        printed, _ = self.run_it("--server", "127.0.0.1:1", "doctor", code=4)
        self.assertIn("BAD  server", printed)
        self.assertIn("fix: contactctl dev", printed)
        (self.folder / "contact.toml").write_text("sever = 'x:1'\n")
        printed, _ = self.run_it("doctor", "-o", "json", code=11, PATH="/nowhere", LC_ALL="C")
        bad = {check["check"] for check in json.loads(printed) if not check["ok"]}
        self.assertEqual(bad, {"config", "server", "terminal"})
        self.assertTrue(all(check["fix"] for check in json.loads(printed) if not check["ok"]))


class ManualTest(LocalTest):

    def test_every_command_has_a_page_without_warnings(self):
        for tool in ("scdoc", "man"):
            if not shutil.which(tool):
                self.skipTest(f"{tool} is not installed")
        self.run_it("__man", self.folder, CONTACTD)
        verbs = [line.split()[0].rstrip(",") for line in
                 self.run_it("--help")[0].split("Subcommands:")[1].split("\n\n")[0].splitlines()
                 if line.strip() and not line.startswith("   ")]
        wanted = {f"contactctl-{verb}.1" for verb in verbs}
        wanted |= {"contactctl.1", "contactd.8", "contact-scenario.5"}
        self.assertGreater(len(wanted), 20)
        self.assertEqual({page.stem for page in self.folder.glob("*.scd")}, wanted)
        for source in self.folder.glob("*.scd"):
            with self.subTest(source.name):
                page = subprocess.run(["scdoc"], input=source.read_bytes(), capture_output=True,
                                      timeout=PATIENCE_S)
                self.assertEqual((page.returncode, page.stderr), (0, b""))
                path = source.with_suffix("")
                path.write_bytes(page.stdout)
                shown = subprocess.run(["man", "-l", "--warnings", str(path)], timeout=PATIENCE_S,
                                       capture_output=True, text=True,
                                       env={**self.environment, "MANWIDTH": "80", "PAGER": "cat"})
                self.assertEqual((shown.returncode, shown.stderr), (0, ""))
                self.assertIn("NAME", shown.stdout)


if __name__ == "__main__":
    unittest.main()
