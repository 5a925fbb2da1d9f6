"""The flags that contactd has."""

import functools
import os
import re
import subprocess

FLAG = re.compile(r"(?<![\w-])--[a-z][a-z-]+")
# What the roles bring; while contactd lacks some, files may name all.
OF_ROLES = {
    "--role", "--lease", "--exit-when-idle", "--stop-after", "--grant-front", "--grant-worker",
    "--launcher", "--min-workers", "--max-workers", "--worker-threads", "--launch-interval",
    "--slurm-partition", "--slurm-account", "--slurm-time", "--slurm-job-name", "--slurm-option",
}


def _help(*words):
    return subprocess.run([os.environ["CONTACTD"], *words, "--help"], check=True,
                          capture_output=True, text=True).stdout


@functools.cache
def existing():
    """All of the program and of its subcommands."""
    texts = [_help(), *map(_help, ("migrate", "copy-store", "fsck"))]
    return set(FLAG.findall("".join(texts)))


def known():
    """Those that a file may name."""
    return existing() if OF_ROLES <= existing() else existing() | OF_ROLES


def has_roles():
    return "--role" in existing()


def unknown(arguments):
    """Those of the arguments that are no flag of contactd."""
    return [word for word in arguments
            if word.startswith("-") and word.split("=")[0] not in known()]
