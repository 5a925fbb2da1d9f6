"""deploy/setup installs what building and running needs, says first what that takes, and does without
npm where it must; deploy/run does without the ports that it wants."""

import os
import pathlib
import re
import shutil
import socket
import subprocess
import tempfile
import tomllib
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
TOOLS = ("bash", "dirname", "comm", "grep", "sort", "sed", "awk", "env")

# Stand-ins for Debian's programs: g++ is installed, and npm cannot be had if NPM_FAILS is set.
DPKG_QUERY = "echo 'installed g++'; echo 'config-files cmake'"
APT_GET = """
case "$*" in
*print-uris*)
  echo "0 upgraded, 575 newly installed, 0 to remove and 0 not upgraded."
  echo "Need to get 12 MB/210 MB of archives."
  echo "After this operation, 1041 MB of additional disk space will be used." ;;
*npm*) echo "APT $*" >&2; exit ${NPM_FAILS:-0} ;;
*install*) echo "APT $*" >&2 ;;
esac
"""


def listed(name):
    lines = (ROOT / "deploy" / name).read_text("utf-8").splitlines()
    return [line for line in lines if not line.startswith("#")]


class DependenciesTest(unittest.TestCase):

    def test_drawing_is_no_dependency_of_the_command_line(self):
        control = (ROOT / "deploy/debian/control").read_text("utf-8")
        package = control.split("\nPackage: contactctl\n")[1].split("\nDescription:")[0]
        self.assertNotIn("Recommends", package)
        self.assertRegex(package, "Suggests: .*python3-contactsim, python3-matplotlib")
        for name in ("packages", "docs-packages", "test-packages", "debian/control"):
            self.assertNotIn("gnuplot", (ROOT / "deploy" / name).read_text("utf-8"), name)
        install = r"apt install --no-install-recommends \./build/package/\*\.deb"
        self.assertRegex((ROOT / "deploy/README.md").read_text("utf-8"), install)


@unittest.skipIf(os.geteuid() != 0, "only root asks nobody for rights")
class SetupTest(unittest.TestCase):

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.bin = pathlib.Path(folder.name)
        for tool in TOOLS:
            (self.bin / tool).symlink_to(shutil.which(tool))
        self.add("dpkg-query", DPKG_QUERY)
        self.add("apt-get", APT_GET)

    def add(self, name, script):
        (self.bin / name).write_text(f"#!{shutil.which('bash')}\n{script}\n")
        (self.bin / name).chmod(0o755)

    def setup(self, *arguments, **variables):
        """The lines that deploy/setup prints, and apt-get when it installs."""
        run = subprocess.run([ROOT / "deploy" / "setup", *arguments], stdout=subprocess.PIPE,
                             stderr=subprocess.STDOUT, encoding="utf-8",
                             env={"PATH": str(self.bin), **variables})
        self.assertEqual(run.returncode, 0, run.stdout)
        return run.stdout.splitlines()

    def test_says_what_it_takes_and_installs_what_is_missing(self):
        cost, needed, npm = self.setup()
        self.assertEqual(cost, "setup: 575 packages, 12 MB to fetch, 1041 MB on disk, about 3 min")
        self.assertEqual(set(needed.split("--no-install-recommends ")[1].split()),
                         set(listed("packages")) - {"g++"})
        self.assertTrue(npm.endswith("--no-install-recommends nodejs npm"), npm)

    def test_installs_what_tests_need_only_for_tests(self):
        needed = self.setup("tests")[1]
        self.assertEqual(set(needed.split("--no-install-recommends ")[1].split()),
                         {*listed("packages"), *listed("docs-packages"),
                          *listed("test-packages")} - {"g++"})

    def test_installs_what_the_documentation_needs_without_what_tests_need(self):
        needed = self.setup("docs")[1]
        self.assertEqual(set(needed.split("--no-install-recommends ")[1].split()),
                         {*listed("packages"), *listed("docs-packages")} - {"g++"})

    def test_does_without_npm(self):
        self.assertEqual(self.setup(NPM_FAILS="100")[-1],
                         "setup: no Node 18 with npm; the dashboard cannot be built")

    def test_takes_the_node_that_is_there(self):
        self.add("npm", "")
        self.add("node", "")
        self.assertFalse([line for line in self.setup() if "nodejs" in line])


class PortTest(unittest.TestCase):
    """The port that deploy/run gives to contactd."""

    def port(self, wanted):
        """What it takes instead of a wanted port, and what it says."""
        text = (ROOT / "deploy" / "run").read_text("utf-8")
        function = text[text.index("free_port() {"):].split("\n}\n")[0] + "\n}\n"
        run = subprocess.run(["bash", "-euc", f"{function}free_port {wanted}"], capture_output=True,
                             text=True, check=True)
        return int(run.stdout), run.stderr

    def test_taken_port_is_told_and_any_other_is_taken(self):
        with socket.create_server(("127.0.0.1", 0)) as other:
            taken = other.getsockname()[1]
            self.assertEqual(self.port(taken), (0, f"run: port {taken} is taken by another program; "
                                                   "contactd gets another port\n"))
        self.assertEqual(self.port(taken), (taken, ""))


class PackagesTest(unittest.TestCase):

    def test_no_package_is_in_two_lists(self):
        packages = listed("packages") + listed("docs-packages") + listed("test-packages")
        self.assertEqual(len(packages), len(set(packages)))

    def fetched(self, *packages):
        """Of a Debian with nothing installed: the files that apt-get fetches, with their bytes."""
        with tempfile.NamedTemporaryFile() as nothing_installed:
            plan = subprocess.run(
                ["apt-get", "install", "--print-uris", "--yes", "--no-install-recommends", "-o",
                 f"Dir::State::status={nothing_installed.name}", *packages],
                capture_output=True, text=True)
        if plan.returncode != 0:
            self.skipTest("apt-get has no lists of packages")
        lines = [line.split() for line in plan.stdout.splitlines() if line.startswith("'")]
        return {words[1]: int(words[2]) for words in lines}

    def test_packages_of_a_release_need_few_others_and_little_to_fetch(self):
        """Of `apt install --no-install-recommends ./build/package/*.deb`; what it installs of ours
        needs the libraries of the programs and the modules of the Python client."""
        linked = "".join(subprocess.run(["ldd", os.environ[program]], capture_output=True, text=True,
                                        check=True).stdout for program in ("CONTACTD", "CONTACTCTL"))
        paths = {pathlib.Path(path) for path in re.findall(r"=> (/\S+)", linked)}
        owners = subprocess.run(
            ["dpkg-query", "--search", *(f"*/{path.parent.name}/{path.name}" for path in paths)],
            capture_output=True, text=True, check=True).stdout
        modules = tomllib.loads((ROOT / "client/python/pyproject.toml").read_text("utf-8"))
        needed = {*re.findall(r"^([^:]+):", owners, re.MULTILINE),
                  *("python3-" + re.match(r"(?:py(?=yaml))?(\w+)", module)[1]
                    for module in modules["project"]["dependencies"])}
        self.assertLessEqual({"libgrpc++1.51", "libnetcdf19", "python3-yaml", "python3-numpy"}, needed)
        minimal = ("apt", "?essential", "?priority(required)")
        fetched, there = self.fetched(*minimal, *needed), self.fetched(*minimal)
        new = [size for file, size in fetched.items() if file not in there]
        self.assertLessEqual(len(new), 100)
        self.assertLessEqual(sum(new), 60e6)

    def test_building_and_running_needs_few_packages_and_no_server(self):
        packages = {file.split("_")[0] for file in self.fetched(*listed("packages"))}
        # Beside the 96 of a minimal Debian, of which half are needed here too, 220.
        self.assertLess(len(packages), 270)
        self.assertEqual(packages & {*listed("test-packages"), "systemd", "dbus"}, set())


if __name__ == "__main__":
    unittest.main()
