"""The image of deploy/container has nothing but contactd, which runs in it without any right."""

import os
import pathlib
import shutil
import tempfile
import unittest

import contactd
from contactd import Job, Server, ServerTest, three_ball_chain
from container import Containers, or_skip

ROOT = pathlib.Path(__file__).resolve().parents[2]
IMAGE = "localhost/contactd-test"
USER = 65532


class ContainerTest(ServerTest):

    @classmethod
    def setUpClass(cls):
        folder = tempfile.mkdtemp(prefix="contact-image-")
        cls.addClassCleanup(shutil.rmtree, folder, ignore_errors=True)
        cls.containers = Containers(folder)
        cls.addClassCleanup(cls.containers.stop)
        buildah = cls.containers.buildah
        or_skip("make images", lambda: cls.containers.run(buildah, "from", "scratch"))
        cls.containers.run(ROOT / "deploy/container/build", IMAGE, os.environ["CONTACT_BUILD"])
        program = cls.containers.program(IMAGE)
        or_skip("run containers", lambda: cls.containers.run(program, "--version"))

    def make_server(self):
        """contactd in a container, which may write into the test's folder alone."""
        self.folder.chmod(0o777)
        program = self.containers.program(IMAGE, f"--volume={self.folder}:{self.folder}")
        self.addCleanup(setattr, contactd, "BINARY", contactd.BINARY)
        if os.geteuid() != 0:  # A subordinate id of the user, who may not delete it outside.
            self.addCleanup(self.containers.run, self.containers.podman, "unshare", "rm", "-rf",
                            self.folder / "data")
        contactd.BINARY = str(program)
        return Server(self.folder / "data", environment=self.containers.environment)

    def test_image_solves_the_papers_chain_and_ends_when_it_is_told(self):
        self.assertEqual(self.server.run(three_ball_chain()).state, Job.SUCCEEDED)
        if os.geteuid() == 0:
            self.assertEqual((self.folder / "data").stat().st_uid, USER)
        code, seconds = self.server.terminate()
        self.assertEqual(code, 0)
        print(f"ended within {seconds:.1f} s")

    def test_image_has_one_program_and_no_shell(self):
        programs = "find . -type f -perm /111 ! -name '*.so*'"
        self.assertEqual(self.containers.look(IMAGE, programs), "./usr/bin/contactd")
        sizes = self.containers.look(IMAGE, "find . -type f -printf '%s\\n'").split()
        print(f"{sum(map(int, sizes)) / 1e6:.1f} MB")


if __name__ == "__main__":
    unittest.main()
