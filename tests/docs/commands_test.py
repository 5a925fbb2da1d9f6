"""Every command that a README shows in a block marked as runnable works as it stands there.

Such a block begins with ```sh run or ```console run; in the latter the commands follow `$ `, and
what stands between them is their output. Those of Python begin with ```python run or ```pycon run.
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

import contactsim
import matplotlib
from contactd import PATIENCE_S, ServerTest

matplotlib.use("agg")
ROOT = pathlib.Path(__file__).parents[2]
TOOLS = ("jq", "gnuplot")  # A command that needs one that is not here is left out.
JOB = re.compile(r"jobs/([0-9a-z]{10})\b")


def blocks(text):
    """Language and content of each runnable block."""
    return re.findall(r"^```(sh|console|python|pycon) run\n(.*?)^```$", text, re.S | re.M)


def commands(language, content):
    """Pairs of a command and the output that is shown for it."""
    if language == "sh":
        return [(content, "")]
    parts = re.split(r"^\$ ", content, flags=re.M)[1:]
    return [(command, output) for command, _, output in (part.partition("\n") for part in parts)]


def examples(content):
    """Pairs of a statement after `>>> ` and what is shown for it."""
    return [(example.source, example.exc_msg or example.want)
            for example in doctest.DocTestParser().get_examples(content)]


class CommandsTest(ServerTest):

    def session(self, path):
        folder = self.folder / "session"
        folder.mkdir()
        (folder / "client").symlink_to(ROOT / "client")
        tools = pathlib.Path(os.environ["CONTACTCTL"]).parent
        env = {**os.environ, "PATH": f"{tools}:{os.environ['PATH']}", "LC_ALL": "C.UTF-8",
               "HOME": str(folder), "CONTACT_SERVER": f"127.0.0.1:{self.server.port}"}
        ids, count = {}, 0
        for language, content in blocks(path.read_text("utf-8")):
            for command, shown in commands(language, content):
                if any(tool in command and not shutil.which(tool) for tool in TOOLS):
                    continue
                for theirs, ours in ids.items():
                    command = command.replace(theirs, ours)
                run = subprocess.run(["bash", "-ec", command], cwd=folder, env=env,
                                     capture_output=True, encoding="utf-8", timeout=5 * PATIENCE_S)
                self.assertEqual(run.returncode, 0, f"$ {command}\n{run.stdout}{run.stderr}")
                printed = dict.fromkeys(JOB.findall(run.stdout + run.stderr))
                new = [name for name in dict.fromkeys(JOB.findall(shown)) if name not in ids]
                ids.update(zip(new, [name for name in printed if name not in ids.values()]))
                count += 1
        return count

    def test_readme(self):
        self.assertGreater(self.session(ROOT / "README.md"), 10)

    def test_client_readme(self):
        self.assertGreater(self.session(ROOT / "client" / "README.md"), 15)

    def test_python_readme(self):
        (self.folder / "client").symlink_to(ROOT / "client")
        self.addCleanup(os.chdir, os.getcwd())
        os.chdir(self.folder)
        names, count = {}, 0
        text = (ROOT / "client" / "python" / "README.md").read_text("utf-8")
        for language, content in blocks(text.replace("127.0.0.1:7070",
                                                     f"127.0.0.1:{self.server.port}")):
            for statements, shown in ([(content, "")] if language == "python" else
                                      examples(content)):
                code = compile(statements, "README.md", "exec", ast.PyCF_ALLOW_TOP_LEVEL_AWAIT)
                refused = re.match(r"contactsim\.errors\.(\w+): ", shown)
                with (self.assertRaises(getattr(contactsim, refused[1])) if refused else
                      contextlib.nullcontext()):
                    done = eval(code, names)
                    if asyncio.iscoroutine(done):
                        asyncio.run(done)
                count += 1
        self.assertGreater(count, 10)


class BlocksTest(unittest.TestCase):

    def test_finds_commands_with_what_they_print(self):
        text = "```console run\n$ a b\nout\n$ c\n```\n```console\n$ x\n```\n```sh run\nd\ne\n```\n"
        found = [pair for block in blocks(text) for pair in commands(*block)]
        self.assertEqual(found, [("a b", "out\n"), ("c", ""), ("d\ne\n", "")])


if __name__ == "__main__":
    unittest.main()
