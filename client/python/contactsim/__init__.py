"""Contact simulations on a contactd server, with results as numpy arrays and pandas DataFrames."""

from .aio import AsyncClient
from .client import Client
from .errors import (CallError, ContactError, DownloadFailed, InvalidScenario, JobNotFound,
                     Overloaded, RunFailed, Timeout, Unreachable, Violation)
from .result import Result
from .scenario import load_scenario
from .sweeping import SweepResult
from .watching import JobChange

__all__ = [
    "AsyncClient", "CallError", "Client", "ContactError", "DownloadFailed", "InvalidScenario",
    "JobChange", "JobNotFound", "Overloaded", "Result", "RunFailed", "SweepResult", "Timeout",
    "Unreachable", "Violation", "load_scenario"
]
__version__ = "0.1.0"
