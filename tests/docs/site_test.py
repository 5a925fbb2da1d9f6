"""The site of documentation builds, all its links lead somewhere, and it asks nothing of elsewhere.

    site_test.py            on a sample of the gallery, which it builds
    SITE=build/docs site_test.py    on a site that is there
"""

import functools
import html.parser
import os
import pathlib
import re
import subprocess
import unittest
import urllib.parse
from xml.etree import ElementTree

import yaml

ROOT = pathlib.Path(__file__).resolve().parents[2]
DOCS = ROOT / "client/docs"
SITE = pathlib.Path(os.environ.get("SITE", ROOT / "build/docs-sample")).resolve()
DASHBOARD = re.compile(r"/(new|runs|compare|server)\b")  # What contactd has beside the site.
LOADS = {("script", "src"), ("img", "src"), ("source", "srcset"), ("link", "href"),
         ("iframe", "src"), ("object", "data"), ("video", "src")}
NUMBER = re.compile(r"-?\d+\.?\d*(?:e-?\d+)?")


def setUpModule():
    if "SITE" not in os.environ:
        subprocess.run([DOCS / "build", "--sample"], check=True, stdout=subprocess.DEVNULL)


class Page(html.parser.HTMLParser):
    """What a page of the site refers to and what it has within it."""

    def __init__(self, path):
        super().__init__()
        self.ids, self.links, self.loads, self.inline = set(), [], [], []
        self.open_tag = ""
        self.feed(path.read_text("utf-8"))

    def handle_starttag(self, tag, attributes):
        values = dict(attributes)
        self.ids |= {values[name] for name in ("id", "name") if values.get(name)}
        self.inline += [f"{tag} {name}" for name in values
                        if name == "style" or name.startswith("on")]
        for name in ("href", "src", "srcset", "data"):
            if values.get(name):
                (self.loads if (tag, name) in LOADS else self.links).append(values[name])
        self.open_tag = tag

    def handle_data(self, data):
        if self.open_tag in ("script", "style") and data.strip():
            self.inline.append(f"{self.open_tag}: {data.strip()[:60]}")

    def handle_endtag(self, tag):
        self.open_tag = ""


@functools.cache
def read(path):
    return Page(path)


def pages():
    return sorted(SITE.rglob("*.html"))


class SiteTest(unittest.TestCase):

    def broken(self, page, link):
        """Why a link of a page leads nowhere; empty if it does not."""
        address = urllib.parse.urlsplit(link)
        if address.scheme or DASHBOARD.match(address.path):
            return ""
        target = page if not address.path else page.parent / urllib.parse.unquote(address.path)
        if not target.resolve().is_relative_to(SITE) or not target.is_file():
            return "no file"
        fragment = urllib.parse.unquote(address.fragment)
        if fragment and target.suffix == ".html" and fragment not in read(target.resolve()).ids:
            return "no such place"
        return ""

    def test_every_link_leads_somewhere(self):
        found = [(str(page.relative_to(SITE)), link, why) for page in pages()
                 for link in read(page).links + read(page).loads
                 if (why := self.broken(page, link))]
        self.assertEqual(found, [])
        self.assertGreater(len(pages()), 8)

    def test_nothing_is_loaded_from_elsewhere(self):
        for page in pages():
            for link in read(page).loads:
                self.assertFalse(urllib.parse.urlsplit(link).netloc, (page, link))
        for style in SITE.rglob("*.css"):
            self.assertNotRegex(style.read_text("utf-8"), r"(url\(|@import)\s*['\"]?(https?:)?/",
                                style)

    def test_pages_have_no_script_or_style_within_them(self):
        for page in pages():
            self.assertEqual(read(page).inline, [], page)

    def test_the_search_knows_the_words_of_pages(self):
        words = (SITE / "searchindex.js").read_text("utf-8")
        for word in ("restitut", "cradl"):
            self.assertIn(word, words)


class MovingPictureTest(unittest.TestCase):

    def test_the_picture_of_the_readme_is_what_the_site_makes(self):
        kept, made = ((folder / "static/chain-moving.svg").read_text("utf-8")
                      for folder in (DOCS, SITE.with_name(SITE.name + "-source")))
        self.assertEqual(NUMBER.sub("#", kept), NUMBER.sub("#", made))
        for ours, theirs in zip(NUMBER.findall(kept), NUMBER.findall(made)):
            self.assertAlmostEqual(float(ours), float(theirs), delta=0.2)
        ElementTree.fromstring(made)


class CardsTest(unittest.TestCase):

    cards = {path.stem: yaml.safe_load(path.read_text("utf-8"))
             for path in (DOCS / "gallery/cards").glob("*.yaml")}

    def test_each_says_in_two_sentences_what_is_to_be_seen(self):
        self.assertGreaterEqual(len(self.cards), 25)
        for name, card in self.cards.items():
            sentences = re.findall(r"[.?](?=\s|$)", card["text"])
            self.assertIn(len(sentences), (2, 3), name)
            self.assertTrue(card["alt"] and card["title"], name)

    def test_most_have_a_number_beside_its_source(self):
        numbered = [card["number"] for card in self.cards.values() if "number" in card]
        self.assertGreater(len(numbered), 25)
        for number in numbered:
            self.assertLessEqual(set(number) - {"given"},
                                 {"what", "ours", "theirs", "within", "source"})


if __name__ == "__main__":
    unittest.main()
