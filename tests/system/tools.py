"""Programs of other projects that tests call."""

import os
import pathlib
import shutil
import unittest

# What deploy/unpack unpacks.
UNPACKED = pathlib.Path(__file__).resolve().parents[2] / "build/tools"


def tool(name):
    """Path of a program, or skips the test."""
    folders = [*os.environ["PATH"].split(":"), "/usr/sbin", UNPACKED / "usr/bin", UNPACKED / "usr/sbin"]
    path = shutil.which(name, path=":".join(map(str, folders)))
    if not path:
        raise unittest.SkipTest(f"{name} is not here; deploy/test unpacks it")
    return path
