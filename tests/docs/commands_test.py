"""Every command that a README shows in a block marked as runnable works as it stands there.

Such a block begins with ```sh run or ```console run; in the latter the commands follow `$ `, lines
that go on `> `, and what stands between them is their output. A number after `run` is the exit code
of the last command, 0 if there is none. Blocks of Python begin with ```python run or ```pycon run.
The blocks of a file are one session. Jobs have other ids each time: an id is replaced by the one
that the same command printed here.
"""

import ast
import asyncio
import contextlib
import doctest
import os
import pathlib
import re
import shutil
import subprocess
import unittest
from unittest import mock

import contactsim
import matplotlib
from contactd import BINARY, PATIENCE_S, Server, ServerTest, cluster, three_ball_chain

matplotlib.use("agg")
ROOT = pathlib.Path(__file__).parents[2]
TOOLS = ("jq", "curl")  # A command that needs one that is not here is left out.
JOB = re.compile(r"jobs/([0-9a-z]{10})\b")

# What is not run here, since it installs, builds or never ends: how it begins, and what runs it.
RUN_ELSEWHERE = {
    "./deploy/run": "deploy/test",
    "./deploy/package": "tests/package/package_test",
    "./deploy/release": "tests/deploy/release_test.py",
    "$ tar -xzf contactd-": "tests/package/release_test",
    "$ contactctl dev\n": "tests/cli/verbs/dev_test.py",
    "$ contactctl open": "tests/cli/verbs/open_test.py",
    "source <(contactctl completion bash)": "tests/cli/help/completion_test.py",
    "$ cd client/node": "tests/node/example_test.py",
    "$ npm install": "tests/node/example_test.py",
    "client/web/build": "tests/web/run",
    "client/docs/build": "tests/docs/site_test.py",
    "$ client/docs/evidence/run": "tests/docs/evidence_test.py",
    "deploy/wheel": "tests/python/package_test.py",
    "for change in client.watch_jobs": "tests/python/client_test.py",
    "contactctl server backup": "tests/cli/verbs/backup_test.py",
    "$ contactd fsck": "tests/system/storage_test.py",
    "$ createdb contactd": "tests/system/stores_test.py",
    "$ contactd --store": "tests/system/stores_test.py",
    "$ contactd migrate": "tests/system/cluster_test.py",
    "$ createuser": "tests/deploy/pods_test.py",
    "$ deploy/container/build": "tests/deploy/container_test.py",
    "$ sudo install": "tests/deploy/systemd_test.py",
    "$ kubectl": "tests/deploy/kustomize_test.py",
    "$ sudo apt install nginx": "tests/deploy/fronts_test.py",
    "$ sudo systemctl enable": "tests/deploy/systemd_test.py",
    "$ sudo systemctl stop postgresql": "tests/deploy/failover_test.py",
    "$ sudo -u postgres": "tests/deploy/failover_test.py",
    "ssh -N -L /tmp/lab.sock": "tests/cli/link/forwarded_test.py",
    "$ psql -At ADDRESS": "tests/system/stores_test.py",
    "$ pg_dump": "tests/system/stores_test.py",
    "$ contactd --role launcher": "tests/launcher/slurm_test.py",
    "$ squeue": "tests/launcher/slurm_test.py",
    "$ contactctl login": "tests/cli/verbs/login_test.py",
    "$ contactctl server token": "tests/cli/link/credentials_test.py",
}


def blocks(text):
    """Language, exit code and content of each runnable block."""
    found = re.findall(r"^```(sh|console|python|pycon) run ?(\d*)\n(.*?)^```$", text, re.S | re.M)
    return [(language, int(code or 0), content) for language, code, content in found]


def others(text):
    """The content of each block that is not runnable, of a language that could be."""
    return re.findall(r"^```(?:sh|console|python|pycon)\n(.*?)^```$", text, re.S | re.M)


def commands(language, content):
    """Pairs of a command and the output that is shown for it."""
    if language == "sh":
        return [(content, "")]
    parts = re.split(r"^\$ ", content.replace("\\\n> ", ""), flags=re.M)[1:]
    return [(command, output) for command, _, output in (part.partition("\n") for part in parts)]


def examples(content):
    """Pairs of a statement after `>>> ` and what is shown for it."""
    return [(example.source, example.exc_msg or example.want)
            for example in doctest.DocTestParser().get_examples(content)]


class CommandsTest(ServerTest):

    @property
    def flags(self):
        return ("--http-listen=127.0.0.1:0", f"--http-port-file={self.folder / 'http'}")

    def setUp(self):
        super().setUp()
        self.http = (self.folder / "http").read_text().strip()
        self.new_session()

    def new_session(self):
        """An empty folder but for the link to the repository's client."""
        os.chdir(self.folder)
        shutil.rmtree(self.folder / "session", ignore_errors=True)
        (self.folder / "session").mkdir()
        (self.folder / "session" / "client").symlink_to(ROOT / "client")

    def shell(self, path):
        """Runs the commands of a page; how many."""
        folder = self.folder / "session"
        tools = pathlib.Path(os.environ["CONTACTCTL"]).parent
        env = {**os.environ, "PATH": f"{tools}:{os.environ['PATH']}", "LC_ALL": "C.UTF-8",
               "HOME": str(folder), "CONTACT_SERVER": f"127.0.0.1:{self.server.port}",
               "CONTACT_HTTP": f"http://127.0.0.1:{self.http}"}
        ids, count = {}, 0
        found = [block for block in blocks(path.read_text("utf-8"))
                 if block[0] in ("sh", "console")]
        for language, code, content in found:
            pairs = commands(language, content)
            for place, (command, shown) in enumerate(pairs, 1):
                if any(tool in command and not shutil.which(tool) for tool in TOOLS):
                    continue
                for theirs, ours in ids.items():
                    command = command.replace(theirs, ours)
                run = subprocess.run(["bash", "-ec", command], cwd=folder, env=env,
                                     capture_output=True, encoding="utf-8", timeout=5 * PATIENCE_S)
                expected = code if place == len(pairs) else 0
                self.assertEqual(run.returncode, expected,
                                 f"$ {command}\n{run.stdout}{run.stderr}")
                printed = dict.fromkeys(JOB.findall(run.stdout + run.stderr))
                new = [name for name in dict.fromkeys(JOB.findall(shown)) if name not in ids]
                ids.update(zip(new, [name for name in printed if name not in ids.values()]))
                count += 1
        return count

    def python(self, path):
        """Runs the statements of a page, beside what its commands left; how many."""
        self.addCleanup(os.chdir, os.getcwd())
        os.chdir(self.folder / "session")
        address = {"CONTACT_SERVER": f"127.0.0.1:{self.server.port}"}
        self.enterContext(mock.patch.dict(os.environ, address))
        names, count = {}, 0
        text = path.read_text("utf-8").replace("127.0.0.1:7070", f"127.0.0.1:{self.server.port}")
        found = [block for block in blocks(text) if block[0] in ("python", "pycon")]
        for language, _, content in found:
            for statements, shown in ([(content, "")] if language == "python" else
                                      examples(content)):
                code = compile(statements, path.name, "exec", ast.PyCF_ALLOW_TOP_LEVEL_AWAIT)
                refused = re.match(r"contactsim\.errors\.(\w+): ", shown)
                with (self.assertRaises(getattr(contactsim, refused[1])) if refused else
                      contextlib.nullcontext()):
                    done = eval(code, names)
                    if asyncio.iscoroutine(done):
                        asyncio.run(done)
                count += 1
        return count

    def test_readme(self):
        (self.folder / "session" / "client").unlink()  # Its tour needs nothing of the repository.
        self.assertGreater(self.shell(ROOT / "README.md"), 10)
        self.assertEqual(self.python(ROOT / "README.md"), 1)

    def test_client_readme(self):
        self.assertEqual(self.shell(ROOT / "client" / "README.md"), 1)

    def octave(self, path):
        """Runs the scripts of a page as one, beside what its commands left; what it printed."""
        text = path.read_text("utf-8")
        script = self.folder / "session" / "page.m"
        script.write_text("".join(re.findall(r"^```octave run\n(.*?)^```$", text, re.S | re.M)),
                          "utf-8")
        run = subprocess.run(["octave-cli", "--quiet", "--norc", script.name], cwd=script.parent,
                             env={**os.environ, "CONTACT_HTTP": f"http://127.0.0.1:{self.http}"},
                             capture_output=True, encoding="utf-8", timeout=5 * PATIENCE_S)
        self.assertEqual(run.returncode, 0, run.stdout + run.stderr)
        return run.stdout

    def test_matlab_page(self):
        page = ROOT / "client" / "matlab.md"
        self.assertEqual(self.shell(page), 5)
        if not shutil.which("octave-cli"):
            self.skipTest("octave-cli is not installed: client/matlab.md was run but for its "
                          "scripts")
        printed = self.octave(page)
        self.assertRegex(printed, r"B1-B2\.contact_force: 104\.65\d\d N at 0\.0006\d\d s\n")
        self.assertRegex(printed, r"B2-B3 #1: mu 4\.5638\de\+0?8, restitution 0\.700000000\n")
        lost, ledger = re.search(r"B1-B2 lost (\S+) J; its ledger says (\S+) J", printed).groups()
        self.assertAlmostEqual(float(lost) / float(ledger), 1, delta=0.01)
        self.assertIn("B3 leaves at 0.155004951 m/s\n", printed)
        self.assertRegex(printed, r"jobs/\w{10} FULL: 2 cycles\n")
        self.assertRegex(printed, r"over HTTP: \d+ of 1001 samples\n")

    def test_pages_of_the_site(self):
        count = 0
        for page in sorted((ROOT / "client" / "docs").rglob("*.md")):
            with self.subTest(page=page.relative_to(ROOT)):
                self.new_session()
                count += self.shell(page) + self.python(page)
        self.assertGreater(count, 90)

    def test_curl_page(self):
        self.assertEqual(self.shell(ROOT / "client" / "curl.md"), 9)

    def test_julia_page(self):
        self.assertEqual(self.shell(ROOT / "client" / "julia.md"), 4)

    def test_deploy_readme(self):
        state = self.folder / "session/.local/state"
        state.mkdir(parents=True)
        laptop = Server(state / "contactd")
        laptop.start().run(three_ball_chain())
        laptop.terminate()
        (self.folder / "session" / "contactd").symlink_to(BINARY)
        here = {"PGHOST": str(cluster().folder), "PGUSER": "contactd",
                "PATH": f"{cluster().bin}:{self.folder / 'session'}:{os.environ['PATH']}"}
        with mock.patch.dict(os.environ, here):
            self.assertEqual(self.shell(ROOT / "deploy" / "README.md"), 3)
        self.assertEqual(cluster().run("SELECT count(*) FROM contactd.jobs", "contactd"), "1")

    def test_python_readme(self):
        self.assertGreater(self.python(ROOT / "client" / "python" / "README.md"), 10)


class BlocksTest(unittest.TestCase):

    def test_finds_commands_with_what_they_print(self):
        text = ("```console run\n$ a \\\n>   b\nout\n$ c\n```\n```console\n$ x\n```\n"
                "```sh run 3\nd\ne\n```\n")
        self.assertEqual([code for _, code, _ in blocks(text)], [0, 3])
        found = [pair for language, _, content in blocks(text)
                 for pair in commands(language, content)]
        self.assertEqual(found, [("a   b", "out\n"), ("c", ""), ("d\ne\n", "")])

    def test_what_is_not_run_here_is_run_elsewhere(self):
        files = subprocess.run(["git", "-C", ROOT, "ls-files", "*.md"], check=True,
                               capture_output=True, encoding="utf-8").stdout.split()
        left = [block for file in files for block in others((ROOT / file).read_text("utf-8"))]
        for block in left:
            self.assertTrue(block.startswith(tuple(RUN_ELSEWHERE)), block)
        for begin, test in RUN_ELSEWHERE.items():
            self.assertTrue(any(block.startswith(begin) for block in left), begin)
            self.assertTrue((ROOT / test).exists(), test)


if __name__ == "__main__":
    unittest.main()
