"""Schemas of other projects, from npm: what a value has that they do not allow."""

import fcntl
import json
import os
import pathlib
import re
import shutil
import subprocess
import unittest

SOURCE = pathlib.Path(__file__).parent / "schemas"
# Kept from one test run to the next.
FOLDER = pathlib.Path(os.environ["SCHEMAS"])
UNREACHABLE = r"ENOTFOUND|EAI_AGAIN|ECONNREFUSED|ETIMEDOUT|ECONNRESET"


def _install():
    """Installs the packages of the lock file, or skips the test."""
    lock = (SOURCE / "package-lock.json").read_text()
    installed = FOLDER / "installed"
    if installed.exists() and installed.read_text() == lock:
        return
    for file in ("package.json", "package-lock.json"):
        shutil.copy(SOURCE / file, FOLDER)
    try:
        run = subprocess.run(["npm", "ci", "--no-audit", "--no-fund", "--ignore-scripts",
                              "--fetch-retries=0", "--fetch-timeout=20000"],
                             cwd=FOLDER, capture_output=True, text=True, timeout=120)
    except subprocess.TimeoutExpired:
        raise unittest.SkipTest("npm's registry does not answer") from None
    if re.search(UNREACHABLE, run.stderr):
        raise unittest.SkipTest("npm's registry is not reachable")
    assert run.returncode == 0, run.stderr
    installed.write_text(lock)


def mistakes(script, value):
    """What the script of schemas/ finds, a line each."""
    if not shutil.which("npm"):
        raise unittest.SkipTest("npm is not installed")
    FOLDER.mkdir(parents=True, exist_ok=True)
    with (FOLDER / "lock").open("w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        _install()
    shutil.copy(SOURCE / script, FOLDER)
    run = subprocess.run(["node", FOLDER / script], input=json.dumps(value), check=True, timeout=60,
                         capture_output=True, text=True)
    return run.stdout.splitlines()
