"""deploy/release makes what is published of the version that the project has, from a commit and with
notes; its tarball runs where there is nothing but glibc."""

import os
import pathlib
import re
import shutil
import subprocess
import tarfile
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
VERSION = "1.2.3"
CHANGELOG = """# Changelog

## [1.2.3] - {}

### Added

- A new law.

## [1.2.0] - 2026-01-02

- An old law.
"""
# A stand-in for deploy/package.
PACKAGE = """mkdir -p build/package && cd build/package
touch contactd_1.2.3_amd64.deb contactd_1.2.0_amd64.deb contactsim-1.2.3-py3-none-any.whl \\
  contactd-1.2.3-linux-x86_64.tar.gz sbom.json bookworm.tar"""
# Stand-ins for deploy/container/build and buildah, of which $BUILDAH fails.
IMAGE = '[[ ${BUILDAH:-} != fails ]] || { echo "no user namespaces" >&2; exit 1; }'
PUSH = 'file=${4#docker-archive:} && touch "${file%%:*}"'
TOOLS = ("bash", "dirname", "sed", "git", "awk", "grep", "rm", "mkdir", "touch", "cp", "ls",
         "sha256sum")


class ReleaseTest(unittest.TestCase):
    """In a repository of its own, with stand-ins for what it calls."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.tree, self.bin = pathlib.Path(folder.name) / "tree", pathlib.Path(folder.name) / "bin"
        (self.tree / "deploy/container").mkdir(parents=True)
        self.bin.mkdir()
        for name in ("release", "version"):
            shutil.copy(ROOT / "deploy" / name, self.tree / "deploy")
        self.script(self.tree / "deploy/package", PACKAGE)
        self.script(self.tree / "deploy/container/build", IMAGE)
        for tool in TOOLS:
            (self.bin / tool).symlink_to(shutil.which(tool))
        (self.tree / ".gitignore").write_text("/build/\n")
        (self.tree / "CMakeLists.txt").write_text(f"project(contactd VERSION {VERSION} LANGUAGES CXX)\n")
        self.git("init", "--quiet")
        self.commit_changelog("2026-03-04")
        self.out = self.tree / f"build/release-{VERSION}"

    def script(self, path, text):
        path.write_text(f"#!{shutil.which('bash')}\nset -e\n{text}\n")
        path.chmod(0o755)

    def git(self, *arguments):
        return subprocess.run(
            ["git", "-c", "user.name=a", "-c", "user.email=a@example.org", *arguments],
            cwd=self.tree, check=True, capture_output=True, text=True).stdout.strip()

    def commit_changelog(self, date):
        (self.tree / "CHANGELOG.md").write_text(CHANGELOG.format(date))
        self.git("add", ".")
        self.git("commit", "--quiet", "--message", "x")

    def release(self, *arguments, **variables):
        return subprocess.run([self.tree / "deploy/release", *arguments], capture_output=True,
                              text=True, env={"PATH": str(self.bin), "HOME": "/", **variables})

    def assert_refused(self, why, *arguments):
        run = self.release(*arguments)
        self.assertEqual((run.returncode, run.stdout, run.stderr), (2, "", f"release: {why}\n"))
        self.assertFalse(self.out.exists())

    def files(self):
        return {path.name for path in self.out.iterdir()}

    def test_other_version_is_refused(self):
        self.assert_refused("the version in CMakeLists.txt is 1.2.3, not 1.2.4", "1.2.4")
        self.assert_refused("usage: release VERSION [--trial]")
        self.assert_refused("usage: release VERSION [--trial]", VERSION, "--try")

    def test_changed_tree_is_refused_but_for_a_trial(self):
        (self.tree / "new").touch()
        self.assert_refused("git does not know all files as they are; commit, or --trial", VERSION)
        self.assertEqual(self.release(VERSION, "--trial").returncode, 0)
        self.assertRegex((self.out / "NOTES.md").read_text(), r"\nMade from commit [0-9a-f]{40}.*\.\n\Z")

    def test_section_without_date_is_refused_but_for_a_trial(self):
        self.commit_changelog("not released yet")
        self.assert_refused("[1.2.3] in CHANGELOG.md has no date; give it one, or --trial", VERSION)
        self.assertEqual(self.release(VERSION, "--trial").returncode, 0)

    def test_has_everything_of_this_version_with_its_sum(self):
        self.script(self.bin / "buildah", PUSH)
        self.assertEqual(self.release(VERSION).stderr, "")
        self.assertEqual(self.files(), {
            "NOTES.md", "SHA256SUMS", "contactd-1.2.3-image.tar", "contactd-1.2.3-linux-x86_64.tar.gz",
            "contactd_1.2.3_amd64.deb", "contactsim-1.2.3-py3-none-any.whl", "sbom.json"})
        subprocess.run(["sha256sum", "--check", "--strict", "--quiet", "SHA256SUMS"], cwd=self.out,
                       check=True)
        summed = {line.split()[1] for line in (self.out / "SHA256SUMS").read_text().splitlines()}
        self.assertEqual(summed, self.files() - {"SHA256SUMS"})

    def test_notes_are_the_section_of_the_version(self):
        self.release(VERSION)
        self.assertEqual((self.out / "NOTES.md").read_text(),
                         "### Added\n\n- A new law.\n\n"
                         f"Made from commit {self.git('rev-parse', 'HEAD')}.\n")

    def test_missing_image_is_told(self):
        run = self.release(VERSION)
        self.assertEqual(run.returncode, 0)
        self.assertEqual(run.stderr, "release: no image, for buildah is missing: "
                                     "apt-get install buildah\n")
        self.script(self.bin / "buildah", PUSH)
        self.assertEqual(self.release(VERSION, BUILDAH="fails").stderr,
                         "no user namespaces\nrelease: no image, for buildah cannot make it here; "
                         "its reason stands above\n")


class TarballTest(unittest.TestCase):

    @classmethod
    def setUpClass(cls):
        if not shutil.which("patchelf"):
            raise unittest.SkipTest("patchelf is not here; deploy/setup tests installs it")
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.root = pathlib.Path(folder.name)
        made = subprocess.run([ROOT / "deploy/tarball", cls.root, os.environ["CONTACT_BUILD"]],
                              check=True, capture_output=True, text=True, timeout=120).stdout
        cls.file = pathlib.Path(made.strip())
        with tarfile.open(cls.file) as archive:
            cls.members = archive.getmembers()
            archive.extractall(cls.root)
        cls.name = cls.file.name.removesuffix(".tar.gz")

    def test_runs_where_there_is_nothing_but_glibc(self):
        glibc = subprocess.run(["dpkg-query", "--listfiles", "libc6"], check=True, text=True,
                               capture_output=True).stdout.split()
        for library in (path for path in glibc if re.search(r"/[^/]+\.so[.\d]*$", path)):
            place = self.root / library.replace("/usr", "", 1).lstrip("/")
            place.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(library, place)
        for folder in ("proc", "dev", "tmp"):
            (self.root / folder).mkdir()
        contactctl = f"/{self.name}/bin/contactctl"
        inside = ('mount --rbind /dev "$0/dev" && mount -t proc proc "$0/proc" && '
                  'exec chroot "$0" "$@"')
        rights = ["--map-root-user"] if os.geteuid() else []
        run = subprocess.run(
            ["unshare", *rights, "--mount", "--pid", "--fork", "sh", "-c", inside, self.root,
             contactctl, "dev", "--", contactctl, "paper", "fig12", "-d", "/paper"],
            env={"PATH": "/usr/sbin:/usr/bin:/sbin:/bin"}, capture_output=True, text=True, timeout=60)
        if "Operation not permitted" in run.stderr:
            self.skipTest(f"this machine makes no bare root: {run.stderr}")
        self.assertEqual(run.returncode, 11, run.stderr)
        self.assertIn("for drawing: apt-get install python3-grpcio", run.stderr)

    def test_asks_for_no_glibc_newer_than_that_of_debian_12(self):
        files = [path for part in ("bin", "lib") for path in (self.root / self.name / part).iterdir()]
        symbols = subprocess.run(["objdump", "--dynamic-syms", *files], check=True, text=True,
                                 capture_output=True).stdout
        wanted = {tuple(map(int, found.split("."))) for found in
                  re.findall(r"GLIBC_(\d[\d.]*)", symbols)}
        self.assertLessEqual(max(wanted), (2, 36))

    def test_has_scenarios_and_a_license_for_each_library(self):
        names = {member.name.removeprefix(self.name) for member in self.members}
        self.assertIn("/share/doc/contactctl/examples/three-ball-chain.yaml", names)
        self.assertIn("/share/doc/libgrpc++1.51/copyright", names)
        self.assertIn("/LICENSE", names)

    def test_the_same_build_gives_the_same_bytes(self):
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run([ROOT / "deploy/tarball", folder, os.environ["CONTACT_BUILD"]], check=True,
                           capture_output=True, timeout=120)
            again = pathlib.Path(folder) / self.file.name
            self.assertEqual(again.read_bytes(), self.file.read_bytes())


if __name__ == "__main__":
    unittest.main()
