"""What a run recorded, gathered from its events."""

from __future__ import annotations

import numpy as np
from contact.v1 import event_pb2, job_pb2

from .model import Array

#: The events that a recording needs.
KINDS = ("attempt_started", "iteration", "cycle", "group", "frame_chunk")


class Recording:
    """The iterations and the trajectory of the last attempt of a job."""

    def __init__(self) -> None:
        self.iterations: dict[tuple[int, int], event_pb2.Iteration] = {}
        self.cycles: dict[int, job_pb2.Cycle] = {}  #: By sequence.
        self.groups: dict[int, job_pb2.Group] = {}  #: By sequence.
        self.units: dict[str, str] = {}  #: Unit by name of column, in their order.
        # By first sample and sequence: columns may be split.
        self._chunks: dict[tuple[int, int], event_pb2.FrameChunk] = {}
        self._columns: dict[str, Array] | None = None

    def add(self, event: event_pb2.Event) -> None:
        """Takes an event; one that was taken before changes nothing."""
        kind = event.WhichOneof("payload")
        if kind == "attempt_started":
            self.__init__()  # type: ignore[misc]  # What came before is of an earlier attempt.
        elif kind == "iteration":
            iteration = event.iteration
            self.iterations[iteration.episode, iteration.number] = iteration
        elif kind == "cycle":
            self.cycles[event.sequence] = event.cycle
        elif kind == "group":
            self.groups[event.sequence] = event.group
        elif kind == "frame_chunk":
            self._add_chunk(event.sequence, event.frame_chunk)

    def _add_chunk(self, sequence: int, chunk: event_pb2.FrameChunk) -> None:
        if chunk.columns and chunk.columns[-1].name not in self.units:
            self.units |= {column.name: column.unit for column in chunk.columns}
        self._chunks[chunk.first_sample, sequence] = chunk
        self._columns = None

    @property
    def has_holes(self) -> bool:
        """True if chunks are missing between those that came."""
        following = columns = 0  # First sample, and sequence of the event with its next columns.
        for (first, sequence), chunk in sorted(self._chunks.items(), key=_place):
            if first != following or columns not in (0, sequence):
                return True
            columns = sequence + 1 if chunk.columns_follow else 0
            following += 0 if columns else chunk.samples
        return False

    @property
    def columns(self) -> dict[str, Array]:
        """The samples by name of column, read-only.

        They lie in the bytes of the message where there is one chunk; several are joined once.
        """
        if self._columns is None:
            chunks = [chunk for _, chunk in sorted(self._chunks.items(), key=_place)]
            while chunks and chunks[-1].columns_follow:
                chunks.pop()  # The last columns of the last samples have not come.
            parts: dict[str, list[bytes]] = {name: [] for name in self.units}
            split = False
            for chunk in chunks:
                for column in chunk.columns[1 if split else 0:]:
                    parts[column.name].append(column.values)
                split = chunk.columns_follow
            self._columns = {name: _join(values) for name, values in parts.items() if values}
        return self._columns


def _place(item: tuple[tuple[int, int], event_pb2.FrameChunk]) -> tuple[int, int]:
    return item[0]


def _join(parts: list[bytes]) -> Array:
    if len(parts) == 1:
        return np.frombuffer(parts[0], dtype="<f8")
    joined: Array = np.concatenate([np.frombuffer(part, dtype="<f8") for part in parts])
    joined.flags.writeable = False
    return joined
