"""How Sphinx makes the site of documentation: client/docs/build calls it.

The pages load nothing from elsewhere and have no script or style but files, because contactd serves
them under the policy of the dashboard, `default-src 'self'`.
"""

import hashlib
import pathlib
import re

from docutils import nodes
from docutils.utils.math import latex2mathml, unichar2tex

ROOT = pathlib.Path(__file__).resolve().parents[2]  # Also of the copy in build/docs-source.
JAVASCRIPT = pathlib.Path("/usr/share/javascript")  # Debian's.

project = "contactd"
author = "the authors of contactd"
copyright = "the authors of contactd, Apache-2.0"
release = re.search(r"project\(contactd VERSION (\S+)", (ROOT / "CMakeLists.txt").read_text("utf-8"))[1]
version = release

extensions = ["myst_parser", "sphinx_copybutton", "sphinx_inline_tabs"]
myst_enable_extensions = ["deflist", "dollarmath", "fieldlist", "substitution"]
myst_heading_anchors = 4
exclude_patterns = ["README.md", "evidence/table.md"]

html_theme = "furo"
html_title = f"contactd {release}"
html_static_path = ["static"]
html_css_files = ["site.css"]
html_math_renderer = "mathml"
html_show_sphinx = False
html_copy_source = False
html_permalinks_icon = "#"
pygments_style = "xcode"
pygments_dark_style = "github-dark"
copybutton_prompt_text = r"\$ |>>> "
copybutton_prompt_is_regexp = True
copybutton_only_copy_prompt_lines = True


def math(self, node, block):
    """Writes a formula as MathML, which browsers draw without a script or font."""
    code = node.astext().translate(unichar2tex.uni2tex_table)
    formula = latex2mathml.tex2mathml(code, inline=not block)
    self.body.append(f'<div class="math">{formula}</div>' if block else formula)
    raise nodes.SkipNode


def mend_theme(static):
    """Brings together what Debian's furo leaves in parts: it expects /javascript of its server, its
    script imports what is no module, and its sassc has lost the rule for who prefers dark pages."""
    style, script = static / "styles/furo.css", static / "scripts/furo.js"
    parts = re.sub(r"@import url\(/javascript/([^)]*)\);",
                   lambda match: (JAVASCRIPT / match[1]).read_text("utf-8"),
                   style.read_text("utf-8"))
    dark = re.search(r'body\[data-theme="dark"\] {(.*?)}', parts, re.S)[1]
    parts += ('@media screen and (prefers-color-scheme: dark) { '
              f'body:not([data-theme="light"]) {{{dark}}} }}\n')
    style.write_text(parts, "utf-8")
    script.write_text(re.sub(r'^import Gumshoe from .*;$', "", script.read_text("utf-8"), 1, re.M),
                      "utf-8")


def mend_tags(text):
    """A page that loads all parts of the theme's script, and whose wide blocks can be scrolled with
    keys."""
    text = re.sub(r'<script src="([^"]*scripts/)furo\.js"',
                  r'<script src="\1gumshoe-patched.js"></script><script src="\1furo.js"', text)
    text = text.replace('style="display: none;"', 'class="unseen"')
    return re.sub(r'<(pre|div(?= class="(?:table-wrapper|math)\b))\b', r'<\1 tabindex="0"', text)


def mend(app, error):
    """Moves the scripts and styles that the theme writes into pages to files of their own."""
    if error or app.builder.format != "html":
        return
    out = pathlib.Path(app.outdir)
    mend_theme(out / "_static")
    tags = {"script": (".js", '<script src="{}"></script>'),
            "style": (".css", '<link rel="stylesheet" href="{}"/>')}
    for page in out.rglob("*.html"):
        up = "../" * (len(page.relative_to(out).parts) - 1)

        def as_file(match):
            ending, tag = tags[match[1]]
            name = f"_static/page-{hashlib.sha256(match[2].encode()).hexdigest()[:8]}{ending}"
            (out / name).write_text(match[2], "utf-8")
            return tag.format(up + name)

        text = page.read_text("utf-8")
        moved = re.sub(r"<(script|style)>(.*?)</\1>", as_file, mend_tags(text), flags=re.S)
        page.write_text(moved, "utf-8")


def setup(app):
    app.add_html_math_renderer(
        "mathml", (lambda self, node: math(self, node, False), None),
        (lambda self, node: math(self, node, True), None))
    app.connect("build-finished", mend)
