"""How far a job is, as a bar on the terminal or in the notebook."""

from __future__ import annotations

from typing import Any

from contact.v1 import event_pb2, job_pb2


class ProgressBar:
    """Shows the progress of a job, if it is wanted at all; a context manager.

    Raises ImportError where the bar is wanted and tqdm is not installed.
    """

    kinds: tuple[str, ...] = ()  #: Of the events that it shows.

    def __init__(self, wanted: bool) -> None:
        self._bar: Any = None
        if not wanted:
            return
        try:
            from tqdm.auto import tqdm  # Only who wants the bar needs it.
        except ImportError as error:
            raise ImportError("progress=True needs the package tqdm: "
                              "apt install python3-tqdm, or pip install tqdm") from error
        self.kinds = ("progress",)
        self._bar = tqdm(total=100.0, bar_format="{desc}{percentage:3.0f} %|{bar}| "
                                                 "{elapsed}<{remaining}{postfix}")

    def __enter__(self) -> ProgressBar:
        return self

    def __exit__(self, *_: object) -> None:
        if self._bar is not None:
            self._bar.close()

    def hear(self, event: event_pb2.Event) -> None:
        if self._bar is None:
            return
        kind = event.WhichOneof("payload")
        if kind == "progress":
            self._bar.set_postfix_str(_words(event.progress), refresh=False)
            self._move_to(part_done(event.progress))
        elif kind == "state_changed" and event.state_changed.state == job_pb2.Job.SUCCEEDED:
            self._move_to(1.0)

    def _move_to(self, part: float) -> None:
        self._bar.update(100.0 * part - self._bar.n)


def part_done(progress: job_pb2.Progress) -> float:
    """The part of a run or sweep that is done, from 0 to 1."""
    if progress.cells:
        return progress.cells_done / progress.cells
    return min(progress.time_s / progress.end_time_s, 1.0) if progress.end_time_s > 0 else 0.0


def _words(progress: job_pb2.Progress) -> str:
    if progress.cells:
        return (f"{progress.cells_done} of {progress.cells} cells, "
                f"{progress.cells_failed} failed")
    busy = f"; busy: {progress.busy_with}" if progress.busy_with else ""
    return (f"{progress.time_s:.4g} of {progress.end_time_s:.4g} s, "
            f"{progress.cycles} cycles{busy}")
