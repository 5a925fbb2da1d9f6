"""The version has one place, CMakeLists.txt. Who cannot read it there states the same; so with the DOI
of the paper, whose place is CITATION.cff."""

import pathlib
import re
import subprocess
import sys
import unittest

ROOT = pathlib.Path(__file__).resolve().parent.parent

# Every statement of the version in a file.
STATED = {
    "client/node/package.json": r'"version": "([^"]+)"',
    "client/node/README.md": r"contactsim-([\d.]+)\.tgz",
    "client/python/README.md": r"contactsim-([\d.]+)-py3",
    "deploy/README.md": r"(?:contactd-|release[ -])(\d[\d.]+\d)",
    "deploy/kubernetes/base/kustomization.yaml": r"newTag: (\S+)",
    "CITATION.cff": r"(?m)^version: (\S+)",
    "CHANGELOG.md": r"(?m)\A(?:[^#]|# |## \[Unreleased\])*?^## \[([^\]]+)\]",  # The newest.
}
DOI = r"10\.\d{4,}/[\w.-]*\w"


def text(path):
    return (ROOT / path).read_text("utf-8")


class VersionTest(unittest.TestCase):

    version = re.search(r"project\(contactd VERSION (\d+\.\d+\.\d+) ", text("CMakeLists.txt"))[1]

    def test_files_state_the_version_of_the_project(self):
        for path, statement in STATED.items():
            self.assertEqual(set(re.findall(statement, text(path))), {self.version}, path)

    def test_python_package_reads_it(self):
        said = subprocess.run([sys.executable, "-B", "setup.py", "--version"], check=True, text=True,
                              cwd=ROOT / "client/python", capture_output=True).stdout
        self.assertEqual(said.split()[-1], self.version)

    def test_program_readme_and_citation_file_have_the_same_doi(self):
        doi = re.search(rf"doi: ({DOI})", text("CITATION.cff"))[1]
        for path in ("README.md", "client/cli/export/provenance.cpp"):
            self.assertEqual(set(re.findall(DOI, text(path))), {doi}, path)


if __name__ == "__main__":
    unittest.main()
