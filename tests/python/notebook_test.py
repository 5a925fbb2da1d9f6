"""The notebook of the Python client runs from its first cell to its last, and holds no output."""

import ast
import json
import os
import pathlib
import unittest
from unittest import mock

import matplotlib.pyplot as plt
from contactd import ServerTest

NOTEBOOK = pathlib.Path(__file__).parents[2] / "client" / "python" / "tutorial.ipynb"


def shown(value):
    """A value as Jupyter asks for it."""
    page = getattr(value, "_repr_html_", None)
    return page() if page else repr(value)


def run(source, names):
    """Runs a cell; what it shows is its last expression, unless a semicolon ends it."""
    body = ast.parse(source).body
    last = body.pop() if body and isinstance(body[-1], ast.Expr) and not source.endswith(";") else None
    exec(compile(ast.Module(body, []), "cell", "exec"), names)
    return shown(eval(compile(ast.Expression(last.value), "cell", "eval"), names)) if last else ""


class NotebookTest(ServerTest):

    def test_every_cell_runs_and_shows_what_the_text_says(self):
        self.addCleanup(plt.close, "all")
        address = {"CONTACT_SERVER": f"127.0.0.1:{self.server.port}"}
        self.enterContext(mock.patch.dict(os.environ, address))
        notebook = json.loads(NOTEBOOK.read_text("utf-8"))
        self.assertEqual(notebook["nbformat"], 4)
        cells = [cell for cell in notebook["cells"] if cell["cell_type"] == "code"]
        names, pages = {}, []
        for cell in cells:
            self.assertEqual((cell["outputs"], cell["execution_count"]), ([], None))
            pages.append(run("".join(cell["source"]), names))
        self.addCleanup(names["client"].close)
        text = "\n".join(pages)
        for word in ("three-ball-chain", "COLLISION", "B1-B2", "final_bodies[B3].velocity_m_per_s",
                     "Triple-ball chain", "SUCCEEDED"):
            self.assertIn(word, text)
        self.assertEqual(len(plt.get_fignums()), 2)


if __name__ == "__main__":
    unittest.main()
