"""Figures of runs and sweeps: what they show as plain values, and how matplotlib draws that."""

from .figure import Curve, Figure, FigureError, Mark, Panel
from .presets import PRESETS, channels_figure, preset_figure, presets_figure

__all__ = ["PRESETS", "Curve", "Figure", "FigureError", "Mark", "Panel", "channels_figure",
           "preset_figure", "presets_figure"]
