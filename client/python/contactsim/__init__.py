"""Contact simulations on a contactd server, with results as numpy arrays and pandas DataFrames."""

import importlib.metadata

from .aio import AsyncClient
from .client import Client
from .comparing import Comparison, compare
from .errors import (AmbiguousJob, CallError, ContactError, DownloadFailed, InvalidScenario,
                     JobNotFound, NotAllowed, Overloaded, RunFailed, Timeout, Unreachable, Violation)
from .measured import SignalComparison, compare_measured
from .result import Result
from .scenario import load_scenario, templates
from .sweeping import SweepResult
from .tools import ToolFailed, translate
from .watching import JobChange

__all__ = [
    "AmbiguousJob", "AsyncClient", "CallError", "Client", "Comparison", "ContactError", "DownloadFailed",
    "InvalidScenario", "JobChange", "JobNotFound", "NotAllowed", "Overloaded", "Result",
    "RunFailed", "SignalComparison", "SweepResult", "Timeout", "ToolFailed", "Unreachable", "Violation",
    "compare", "compare_measured", "load_scenario", "templates", "translate"
]
try:
    __version__ = importlib.metadata.version("contactsim")
except importlib.metadata.PackageNotFoundError:  # Imported from a source tree.
    __version__ = "0+source"
