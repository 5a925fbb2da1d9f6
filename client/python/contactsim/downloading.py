"""An artifact on its way into a file, across connections."""

from __future__ import annotations

import hashlib
import os
import pathlib
from typing import BinaryIO

import grpc
from contact.v1 import job_pb2, job_service_pb2

from .errors import DownloadFailed
from .pages import PathLike
from .watching import Link


class Download(Link):
    """Writes what streams bring to PATH.part, which gets its name once it is whole.

    A part that an earlier try has left is gone on with. Chunks carry a CRC-32C, which Python has
    not; the SHA-256 of the whole tells the same.
    """

    def __init__(self, job: str, artifact: str, path: PathLike, address: str,
                 deadline: float | None) -> None:
        super().__init__(address, deadline)
        self._job, self._artifact, self._path = job, artifact, pathlib.Path(path)
        self._part = self._path.with_name(self._path.name + ".part")
        self._digest = hashlib.sha256()
        self._size = 0
        self._file: BinaryIO = open(self._part, "a+b")
        self._file.seek(0)
        while block := self._file.read(1 << 20):
            self._count(block)

    def __enter__(self) -> Download:
        return self

    def __exit__(self, *_: object) -> None:
        self._file.close()
        if self._size == 0:  # Nothing came.
            self._part.unlink(missing_ok=True)

    def request(self) -> job_service_pb2.ReadArtifactRequest:
        """What to ask now."""
        return job_service_pb2.ReadArtifactRequest(name=self._job, artifact=self._artifact,
                                                   offset=self._size)

    def take(self, message: job_service_pb2.ReadArtifactResponse) -> list[job_pb2.Artifact]:
        """Adds a chunk to the part; the last one brings the artifact."""
        self.heard()
        if message.offset != self._size:
            self._fail()
        self._file.write(message.data)
        self._count(message.data)
        if not message.HasField("artifact"):
            return []
        self._finish(message.artifact)
        return [message.artifact]

    def lost(self, error: grpc.RpcError | None) -> float:
        if error is not None and error.code() == grpc.StatusCode.OUT_OF_RANGE:
            self._fail()  # The part is longer than the artifact.
        return super().lost(error)

    def _count(self, block: bytes) -> None:
        self._digest.update(block)
        self._size += len(block)

    def _finish(self, artifact: job_pb2.Artifact) -> None:
        if (self._size, self._digest.digest()) != (artifact.size_bytes, artifact.sha256):
            self._fail()
        self._file.close()
        os.replace(self._part, self._path)
        self.finished = True

    def _fail(self) -> None:
        self._part.unlink()
        raise DownloadFailed(f"{self._part} is not what the server has of {self._artifact}; "
                             "it was removed, try again")
