"""podman and buildah with a storage of their own, also where they are only unpacked."""

import os
import pathlib
import subprocess
import unittest

from tools import UNPACKED, tool

LIBRARIES = UNPACKED / "usr/lib/x86_64-linux-gnu"
STORAGE = '[storage]\ndriver = "vfs"\nrunroot = "{0}/run"\ngraphroot = "{0}/storage"\n'
ENGINE = """[engine]
runtime = "crun"
conmon_path = ["{0}/conmon"]
cgroup_manager = "cgroupfs"
events_logger = "none"
tmp_dir = "{0}/tmp"
[engine.runtimes]
crun = ["{0}/crun"]
"""
POLICY = '{"default": [{"type": "insecureAcceptAnything"}]}'
# crun takes one kind of control groups, not two at once. For our processes alone the newer is away;
# for those of a user without_root has done it.
UNIFIED = "/sys/fs/cgroup/unified"
ONE_KIND = f"unshare --mount sh -c 'umount {UNIFIED}; exec \"$@\"' sh"


class Containers:
    """In a folder, with everything that they keep."""

    def __init__(self, folder):
        self.folder = pathlib.Path(folder)
        self.podman, self.buildah = tool("podman"), tool("buildah")
        for name in ("crun", "conmon"):  # podman calls them without our environment.
            self.script(name, f"LD_LIBRARY_PATH={LIBRARIES} exec {tool(name)} \"$@\"")
        (self.folder / "storage.conf").write_text(STORAGE.format(self.folder))
        (self.folder / "containers.conf").write_text(ENGINE.format(self.folder))
        policy = self.folder / ".config/containers/policy.json"
        policy.parent.mkdir(parents=True)
        policy.write_text(POLICY)
        self.environment = {
            **os.environ, "HOME": str(self.folder), "LD_LIBRARY_PATH": str(LIBRARIES),
            "PATH": f"{pathlib.Path(self.buildah).parent}:{os.environ['PATH']}",
            "CONTAINERS_CONF": f"{self.folder}/containers.conf",
            "CONTAINERS_STORAGE_CONF": f"{self.folder}/storage.conf"}

    def script(self, name, text):
        file = self.folder / name
        file.write_text(f"#!/bin/sh\n{text}\n")
        file.chmod(0o755)
        return file

    def run(self, *command, timeout=120):
        """What the command prints."""
        done = subprocess.run([*map(str, command)], env=self.environment, timeout=timeout,
                              text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        if done.returncode != 0:
            raise RuntimeError(done.stdout)
        return done.stdout.strip()

    def look(self, image, seen):
        """What `seen` answers about the root of the image, a folder, by its words."""
        container = self.run(self.buildah, "from", image)
        script = f'cd "$({self.buildah} mount {container})" && {seen}'
        return self.run(*([self.buildah, "unshare"] if os.geteuid() else []), "sh", "-c", script)

    def program(self, image, *options):
        """A program that runs the image with its arguments, without any right."""
        groups = ONE_KIND if os.geteuid() == 0 and os.path.isdir(UNIFIED) else ""
        return self.script(
            "program", f"exec {groups} {self.podman} run --rm "
            "--cgroups=disabled --network=host --read-only --cap-drop=all "
            "--security-opt=no-new-privileges --ulimit=nofile=1024:4096 --ulimit=nproc=4096:4096 "
            f"{' '.join(options)} {image} \"$@\"")

    def stop(self):
        """Ends all that is left, also the process that keeps the namespace of a user."""
        for words in ["rm", "--force", "--all", "--time=0"], ["system", "migrate"]:
            subprocess.run([self.podman, *words], env=self.environment, check=False,
                           stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)


def or_skip(what, call):
    """What the call returns; where this machine cannot do it the test is skipped, and says why."""
    try:
        return call()
    except (RuntimeError, subprocess.TimeoutExpired) as error:
        raise unittest.SkipTest(f"this machine cannot {what}: {str(error)[-300:]}") from None
