"""Every link from one page of the repository to another leads to a file, and to a title in it; and
the tests that the physics names as its evidence are there."""

import pathlib
import re
import subprocess
import unittest

ROOT = pathlib.Path(__file__).resolve().parent.parent
LINK = re.compile(r"\]\(([^()\s]+)\)")
CODE = re.compile(r"^(```+).*?^\1$|`[^`\n]*`", re.S | re.M)


def pages():
    """The pages; those of the site apart, for Sphinx checks their links with what is generated."""
    listed = subprocess.run(["git", "-C", ROOT, "ls-files", "-co", "--exclude-standard", "*.md"],
                            check=True, capture_output=True, encoding="utf-8").stdout.split()
    return [ROOT / name for name in listed if not name.startswith("client/docs/")]


def anchors(text):
    """What the titles of a page are called in addresses, as GitHub makes them."""
    titles = re.findall(r"^#+ (.+)$", re.sub(r"^```.*?^```$", "", text, flags=re.S | re.M), re.M)
    words = [re.sub(r"[^\w\- ]", "", title.lower()) for title in titles]
    return {title.strip().replace(" ", "-") for title in words}


def broken(page, text, read):
    """The links of a page that lead nowhere. `read` tells the text of a path, or None."""
    for link in LINK.findall(CODE.sub("", text)):
        if re.match(r"[a-z]+:", link):
            continue
        path, _, anchor = link.partition("#")
        target = (page.parent / path).resolve() if path else page
        found = text if target == page else read(target)
        if found is None or (anchor and anchor not in anchors(found)):
            yield link


def read(path):
    if path.is_file() and path.suffix == ".md":
        return path.read_text("utf-8")
    return "" if path.exists() else None


class LinksTest(unittest.TestCase):

    def test_every_link_leads_somewhere(self):
        found = {str(page.relative_to(ROOT)): list(broken(page, page.read_text("utf-8"), read))
                 for page in pages()}
        self.assertGreater(len(found), 15, "this test has gone blind")
        self.assertEqual({page: links for page, links in found.items() if links}, {})

    def test_evidence_of_the_physics_is_there(self):
        page = (ROOT / "server/simulation/README.md").read_text("utf-8")
        tests = "".join(path.read_text("utf-8")
                        for path in (ROOT / "tests/simulation").rglob("*.cpp"))
        named = re.findall(r"`([A-Z]\w+)\.([A-Z]\w+)`", page)
        self.assertGreater(len(named), 10, "this test has gone blind")
        self.assertEqual([name for name in named
                          if not re.search(rf"TEST\w*\({name[0]},\s+{name[1]}\)", tests)], [])

    def test_what_leads_nowhere_is_seen(self):
        page = pathlib.Path("/a.md")
        text = "# A `b`: c\n[1](#a-b-c) [2](#d) [3](b.md) [4](c.md) [5](b.md#e)\n`[6](no)`\n"
        texts = {pathlib.Path("/b.md"): "# B\n```\n# e\n```\n"}
        self.assertEqual(list(broken(page, text, texts.get)), ["#d", "c.md", "b.md#e"])


if __name__ == "__main__":
    unittest.main()
