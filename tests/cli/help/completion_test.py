"""What bash, zsh and fish offer for the words of contactctl."""

import os
import pathlib
import pty
import shutil
import subprocess
import time
import unittest

from cli_case import CHAIN, CONTACTCTL, SCENARIOS, CliTest, read_until
from contactd import PATIENCE_S
from contactsim.figures.look import PRINT


class CompletionTest(CliTest):

    def setUp(self):
        super().setUp()
        self.work = self.folder / "work"
        (self.work / "sub").mkdir(parents=True)
        for name in ("a.yaml", "b c.yaml", "notes.txt"):
            (self.work / name).touch()
        self.environment = {**os.environ, "CONTACT_SERVER": f"127.0.0.1:{self.server.port}",
                            "HOME": str(self.folder), "TERM": "xterm",
                            "PATH": f"{pathlib.Path(CONTACTCTL).parent}:{os.environ['PATH']}"}

    def shell(self, *command, script):
        run = subprocess.run(command, input=script, cwd=self.work, env=self.environment,
                             capture_output=True, encoding="utf-8", timeout=PATIENCE_S)
        self.assertEqual(run.stderr, "")
        return run.stdout.splitlines()

    def offered(self, *words, **changes):
        """What the program itself answers: the candidates, and the rule of the last line."""
        run = subprocess.run([CONTACTCTL, "__complete", *words], cwd=self.work,
                             env={**self.environment, **changes}, capture_output=True,
                             encoding="utf-8", timeout=PATIENCE_S)
        self.assertEqual((run.returncode, run.stderr), (0, ""))
        *lines, rule = run.stdout.splitlines()
        return [line.split("\t")[0] for line in lines], rule

    def bash(self, line):
        """The COMPREPLY of a line, its words split as bash does, the cursor at its end."""
        script = f"""source <({CONTACTCTL} completion bash)
            COMP_WORDS=({line}); COMP_CWORD=$((${{#COMP_WORDS[@]}} - 1)); _contactctl
            printf '%s\\n' "${{COMPREPLY[@]}}" """
        return self.shell("bash", "--norc", script=script)

    def test_verbs_and_flags_are_those_of_the_program(self):
        verbs, _ = self.offered("")
        self.assertLessEqual({"run", "watch", "sweep", "completion", "config"}, set(verbs))
        self.assertEqual([verb for verb in verbs if verb.startswith("_")], [])
        self.assertEqual(self.offered("sweep", "ex"), (["export"], ":none"))
        flags, _ = self.offered("run", "--")
        self.assertLessEqual({"--set", "--label", "--server", "--output", "--help"}, set(flags))

    def test_values_are_those_that_the_parser_takes(self):
        self.assertEqual(self.offered("plot", "x", "hy")[0], ["hysteresis"])
        self.assertEqual(self.offered("list", "-o", "ta")[0], ["table"])
        self.assertEqual(self.offered("list", "--output=ta")[0], ["--output=table"])
        self.assertEqual(self.offered("list", "--output", "=", "ta")[0], ["table"])
        self.assertEqual(self.offered("list", "--state", "SU")[0], ["SUCCEEDED"])
        self.assertEqual(self.offered("model", "show", "hunt")[0], ["hunt-crossley"])
        self.assertEqual(self.offered("init", "three")[0], ["three-ball-chain"])
        self.assertEqual(self.offered("completion", "")[0], ["bash", "zsh", "fish"])
        self.assertEqual(self.offered("help", "t")[0], ["tutorial"])
        self.assertEqual(self.offered("explain", "INF")[0], ["INFEASIBLE"])
        self.assertEqual(self.offered("explain", "JU")[0], ["JUMP"])
        self.assertEqual(self.offered("run", "-t", "newt")[0], ["newton-cradle"])
        self.assertEqual(self.offered("run", "")[1], ":scenarios")
        self.assertEqual(self.offered("plot", "--keep", "")[1], ":directories")
        self.assertEqual(self.offered("plot", "x", "--style", "")[0], ["colour", *PRINT])
        self.assertEqual(self.offered("plot", "x", "force", "hy")[0], ["hysteresis"])
        self.assertEqual(self.offered("plot", "x", "force", "-o", "s")[0], ["svg"])

    def test_fields_are_those_of_the_scenario_named(self):
        chain = ("run", str(CHAIN), "--set")
        self.assertEqual(self.offered(*chain, "contacts[1].rest"),
                         (["contacts[1].restitution="], ":nospace"))
        self.assertEqual(self.offered(*chain, "contacts[2]")[0], [])
        self.assertEqual(self.offered(*chain, "solver.tension=")[0],
                         ["solver.tension=ALLOW", "solver.tension=CLIP"])
        self.assertEqual(self.offered(*chain, "solver.tension", "=", "CL")[0], ["CLIP"])
        self.assertEqual(self.offered("run", "--set", "contacts[*].rest")[0],
                         ["contacts[*].restitution="])
        for field in self.offered(*chain, "")[0]:
            with self.subTest(field):
                self.assertNotIn("unknown field", self.run_it(
                    "validate", CHAIN, "--set", field + "x", code=None)[1])

    def test_jobs_and_channels_come_from_the_server(self):
        job = self.run_it("run", CHAIN, "-o", "name")[0].strip().removeprefix("jobs/")
        self.assertEqual(self.offered("describe", job[:2])[0], [job])
        self.assertIn("B3.velocity", self.offered("series", job, "--channel", "B3.")[0])
        self.assertEqual(self.offered("plot", job, "force", "--contacts", "")[0],
                         ["B1-B2", "B2-B3"])
        self.assertEqual(self.offered("--server", "127.0.0.1:1", "describe", "")[0], [])

    def test_lists_are_completed_at_their_last_entry(self):
        job = self.run_it("run", CHAIN, "-o", "name")[0].strip().removeprefix("jobs/")
        offer, rule = self.offered("watch", job, "--plot", "B1.velocity,B")
        self.assertEqual(rule, ":nospace")
        self.assertIn("B1.velocity,B2.velocity", offer)
        self.assertNotIn("B1.velocity,B1.velocity", offer)
        self.assertEqual(self.offered("export", job, "--channels=B3.velocity,B1.p")[0],
                         ["--channels=B3.velocity,B1.position"])
        self.assertEqual(self.offered("export", job, "--channels", "=", "B3.velocity,B1.p")[0],
                         ["B3.velocity,B1.position"])
        self.assertEqual(self.offered("watch", job, "--kinds", "cycle,progr")[0],
                         ["cycle,progress"])

    def test_artifacts_and_metrics_are_those_of_the_job(self):
        job = self.run_it("run", CHAIN, "-o", "name")[0].strip()
        self.assertEqual(self.offered("artifact", "get", job, "traj")[0], ["trajectory.csv"])
        sweep = self.run_it("sweep", "run", SCENARIOS / "table-3-sweep.yaml", "-o", "name")[0]
        self.assertEqual(self.offered("sweep", "export", sweep.strip(), "--metric", "iter")[0],
                         ["iterations"])

    def test_without_a_server_it_is_silent_and_soon_over(self):
        start = time.monotonic()
        offer = self.offered("describe", "", CONTACT_SERVER="10.255.255.1:7070")
        self.assertEqual(offer, ([], ":none"))
        self.assertLess(time.monotonic() - start, 5)  # 0.4 on a machine with nothing else to do.
        self.assertEqual(self.offered("describe", "", CONTACT_SERVER="nonsense")[0], [])

    def test_bash_completes(self):
        job = self.run_it("submit", CHAIN, "-o", "name")[0].strip().removeprefix("jobs/")
        self.assertEqual(self.bash("contactctl des"), ["describe"])
        self.assertEqual(self.bash("contactctl watch ''"), [job])
        self.assertEqual(self.bash("contactctl list --output = cs"), ["csv"])
        self.assertEqual(sorted(self.bash("contactctl run ''")), ["a.yaml", "b c.yaml", "sub"])
        self.assertEqual(self.bash("contactctl plot x --file n"), ["notes.txt"])
        self.assertEqual(self.bash("contactctl run a.yaml --set output.led"),
                         ["output.ledger_only="])
        self.assertEqual(self.bash("contactctl run a.yaml --set output.ledger_only = t"), ["true"])

    def test_zsh_completes(self):
        if not shutil.which("zsh"):
            self.skipTest("zsh is not installed")
        master, slave = pty.openpty()
        process = subprocess.Popen(["zsh", "-f", "-i"], stdin=slave, stdout=slave, stderr=slave,
                                   cwd=self.work, env=self.environment)
        os.close(slave)
        self.addCleanup(process.wait)
        self.addCleanup(process.kill)
        os.write(master, b"autoload -U compinit; compinit -u -D; LISTMAX=1000\n"
                 b"source <(contactctl completion zsh); echo re''ady\n")
        read_until(master, b"ready")
        os.write(master, b"contactctl desc\t\x01echo '\x05'\n")
        read_until(master, b"\ncontactctl describe")
        os.write(master, b"contactctl run a\t\x01echo '\x05'\n")
        read_until(master, b"\ncontactctl run a.yaml")
        os.write(master, b"contactctl run a.yaml --set output.led\ttrue\x01echo '\x05'\n")
        read_until(master, b"\ncontactctl run a.yaml --set output.ledger_only=true")

    def test_fish_completes(self):
        if not shutil.which("fish"):
            self.skipTest("fish is not installed")
        def ask(line):
            offer = self.shell("fish", "--no-config",
                               script=f"contactctl completion fish | source; complete -C '{line}'")
            return [part.split("\t")[0] for part in offer]
        self.assertEqual(ask("contactctl des"), ["describe"])
        self.assertEqual(ask("contactctl plot x hy"), ["hysteresis"])
        self.assertIn("a.yaml", ask("contactctl run a"))
        self.assertEqual(ask("contactctl run a.yaml --set output.led"), ["output.ledger_only="])


if __name__ == "__main__":
    unittest.main()
