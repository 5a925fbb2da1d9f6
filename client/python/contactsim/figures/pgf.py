"""Figures for LaTeX documents, without LaTeX."""

from __future__ import annotations

import io
from typing import Any

from matplotlib.backends import backend_pgf
from matplotlib.textpath import text_to_path

# What a text may have, as LaTeX writes it; of a user, too, whose words are no commands.
_ESCAPES = str.maketrans({
    "&": r"\&", "%": r"\%", "$": r"\$", "#": r"\#", "_": r"\_", "{": r"\{", "}": r"\}",
    "\\": r"\textbackslash{}", "^": r"\textasciicircum{}", "~": r"\textasciitilde{}",
    "<": r"\textless{}", ">": r"\textgreater{}", "|": r"\textbar{}", "μ": r"$\mu$", "µ": r"$\mu$",
    "ε": r"$\varepsilon$", "δ": r"$\delta$", "α": r"$\alpha$", "Δ": r"$\Delta$", "×": r"$\times$",
    "−": "$-$", "·": r"$\cdot$", "ᐟ": "$^/$", "ⁿ": "$^n$", "⁺": "$^+$", "⁻": "$^-$",
    **{raised: f"$^{digit}$" for digit, raised in enumerate("⁰¹²³⁴⁵⁶⁷⁸⁹")}})


class _Renderer(backend_pgf.RendererPgf):  # type: ignore[misc]  # matplotlib has no types.
    """Takes the sizes of texts from matplotlib's own font, for which no LaTeX is run, and leaves
    mathematics alone in what is escaped."""

    def draw_text(self, gc: Any, x: float, y: float, s: str, prop: Any, angle: float,
                  ismath: Any = False, mtext: Any = None) -> None:
        super().draw_text(gc, x, y, s if ismath else s.translate(_ESCAPES), prop, angle, ismath,
                          mtext)

    def get_text_width_height_descent(self, s: str, prop: Any,
                                      ismath: Any) -> tuple[float, float, float]:
        points = self.dpi / 72
        width, height, descent = text_to_path.get_text_width_height_descent(s, prop, ismath)
        return width * points, height * points, descent * points


def text(page: Any) -> str:
    """The commands that draw a page of matplotlib, for `\\input` after `\\usepackage{pgf}`."""
    buffer = io.StringIO()
    own = backend_pgf.RendererPgf
    backend_pgf.RendererPgf = _Renderer  # The canvas makes one by this name.
    try:
        backend_pgf.FigureCanvasPgf(page).print_figure(buffer, format="pgf")
    finally:
        backend_pgf.RendererPgf = own
    return buffer.getvalue()
