"""Plots of a result with matplotlib, by preset."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Literal

from .figures import PRESETS, preset_figure
from .figures.figure import keep_largest
from .spelling import expected

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from .result import Result

#: The names of the presets, for those who check types.
Preset = Literal[
    "position", "displacement", "velocity", "acceleration", "force", "deformation-velocity",
    "hysteresis", "restitution", "iterations", "energy", "supports", "force-map", "velocity-map",
    "force-waterfall", "velocity-waterfall"]


class Plots:
    """The presets. Each draws on `ax`, or on axes of its own, and returns them."""

    def __init__(self, result: Result) -> None:
        self._result = result

    def __call__(self, preset: Preset, ax: Any = None) -> Any:
        """The plot with this name, such as `force` or `deformation-velocity`; of a preset with two
        panels, `ax` are two Axes, and both are returned."""
        name = preset.replace("_", "-")
        if name not in PRESETS:
            raise ValueError(f"there is no preset {preset!r}" + expected(name, PRESETS))
        import matplotlib.pyplot as plt  # Only who plots needs matplotlib.
        import numpy as np

        from .figures.draw import Key, draw_panel
        from .figures.look import Look

        figure = preset_figure(name, self._result)
        keep_largest(figure)
        if ax is None:
            ax = plt.subplots(len(figure.panels), 1, layout="constrained")[1]
        axes: list[Axes] = list(np.ravel(ax))
        for panel, each in zip(figure.panels, axes):
            width = each.figure.get_size_inches()[0] * each.get_position().width
            draw_panel(panel, each, Look(), Key(panel, figure.crowd, Look(), width))
        return ax

    def position(self, ax: Axes | None = None) -> Axes:
        """x over t of each body; dotted where its centre is when it touches a wall."""
        return self("position", ax)

    def displacement(self, ax: Axes | None = None) -> Axes:
        """x less that at the start, over t, of each body."""
        return self("displacement", ax)

    def velocity(self, ax: Axes | None = None) -> Axes:
        """v over t of each body."""
        return self("velocity", ax)

    def acceleration(self, ax: Axes | None = None) -> Axes:
        """a over t of each body."""
        return self("acceleration", ax)

    def force(self, ax: Axes | None = None) -> Axes:
        """Contact force over t, with the equivalent external force dashed and μ/k at the largest
        peaks."""
        return self("force", ax)

    def deformation_velocity(self, ax: Axes | None = None) -> Axes:
        """δ̇ over t of each contact."""
        return self("deformation-velocity", ax)

    def hysteresis(self, ax: Axes | None = None) -> Axes:
        """F over δ: a loop for each cycle, whose area is the energy lost."""
        return self("hysteresis", ax)

    def restitution(self, ax: Any = None) -> Any:
        """ε asked for (o) and had by its group (×), for each cycle of the ledger; |Δε|/ε below."""
        return self("restitution", ax)

    def iterations(self, ax: Any = None) -> Any:
        """μ and the residual |f| over the passes of the longest episode, on two Axes."""
        return self("iterations", ax)

    def energy(self, ax: Axes | None = None) -> Axes:
        """What holds energy over t, what is dissipated, the work of loads, and their balance."""
        return self("energy", ax)

    def supports(self, ax: Any = None) -> Any:
        """Force of each support over t, and the energy in its spring, on two Axes."""
        return self("supports", ax)

    def force_map(self, ax: Axes | None = None) -> Axes:
        """Contact force over t as colours, a row for each contact: how a wave goes through many."""
        return self("force-map", ax)

    def velocity_map(self, ax: Axes | None = None) -> Axes:
        """v over t as colours, a row for each body."""
        return self("velocity-map", ax)

    def force_waterfall(self, ax: Axes | None = None) -> Axes:
        """Contact force over t, each contact on a line of its own."""
        return self("force-waterfall", ax)

    def velocity_waterfall(self, ax: Axes | None = None) -> Axes:
        """v over t, each body on a line of its own."""
        return self("velocity-waterfall", ax)
