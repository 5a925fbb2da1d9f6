"""The flags that contactd has."""

import functools
import os
import re
import subprocess

FLAG = re.compile(r"(?<![\w-])--[a-z][a-z-]+")


def _help(*words):
    return subprocess.run([os.environ["CONTACTD"], *words, "--help"], check=True,
                          capture_output=True, text=True).stdout


@functools.cache
def existing():
    """All of the program and of its subcommands."""
    texts = [_help(), *map(_help, ("migrate", "copy-store", "fsck"))]
    return set(FLAG.findall("".join(texts)))


def unknown(arguments):
    """Those of the arguments that are no flag of contactd."""
    return [word for word in arguments
            if word.startswith("-") and word.split("=")[0] not in existing()]
