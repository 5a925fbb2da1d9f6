"""The states in which a power cut may leave the disk, from the notes of power_cut.c.

After a sync of a file its content is on the disk, and of a directory its names; a new file's name
also after its own sync. Of everything later a power cut may leave any part: writes in any order
and in pieces of a sector, changes of names up to any point.
"""

import os
import pathlib
import struct

LIBRARY = os.environ["POWER_CUT"]
NOTE = struct.Struct("<c3xIQQ")
SECTOR = 512


def environment(folder, log, **options):
    """For a process whose files below `folder` are on such a disk."""
    settings = {f"POWER_CUT_{name.upper()}": str(value) for name, value in options.items()}
    return os.environ | settings | {"LD_PRELOAD": LIBRARY, "POWER_CUT_DIR": str(folder),
                                    "POWER_CUT_LOG": str(log)}


class _File:

    def __init__(self):
        self.synced = bytearray()
        self.pending = []  # Writes (offset, data) and truncations (size, None), oldest first.

    def sync(self):
        for change in self.pending:
            _apply(self.synced, *change)
        self.pending = []


def _apply(content, offset, data):
    if data is None:
        del content[offset:]
        content.extend(bytes(offset - len(content)))
    else:
        content.extend(bytes(max(0, offset - len(content))))
        content[offset:offset + len(data)] = data


class Disk:
    """Follows the notes; `image` leaves it as it is."""

    def __init__(self):
        self.files = {}  # As the process sees them, by path.
        self.named = {}  # As they are on the disk.
        self.renames = []  # Snapshots of the names since the last sync of the directory.

    def do(self, op, path, offset, data):
        if op == b"W":
            self.files[path].pending.append((offset, data))
        elif op == b"T":
            self.files[path].pending.append((offset, None))
        elif op == b"S" and path in self.files:
            self.files[path].sync()
            self.named[path] = self.files[path]
        elif op == b"S":
            self.named, self.renames = dict(self.files), []
        else:
            if op == b"C":
                self.files[path] = _File()
            elif op == b"R":
                self.files[data.decode()] = self.files.pop(path)
            elif op == b"U":
                self.files.pop(path, None)
            self.renames.append(dict(self.files))

    def image(self, folder, random=None):
        """Writes what is left to `folder`: the synced part, and with `random` some of the rest."""
        pathlib.Path(folder).mkdir()
        names = random.choice([self.named, *self.renames]) if random else self.named
        for path, file in names.items():
            content = bytearray(file.synced)
            for offset, data in file.pending if random else ():
                _write_some(content, offset, data, random)
            (pathlib.Path(folder) / os.path.basename(path)).write_bytes(content)


def _write_some(content, offset, data, random):
    if random.random() < 0.3:
        return
    if data is None or random.random() < 0.7:
        return _apply(content, offset, data)
    for start in range(0, len(data), SECTOR):
        if random.random() < 0.5:
            _apply(content, offset + start, data[start:start + SECTOR])


def cuts(log, points, honest=True):
    """The disk at each of the points, sizes of the notes in rising order. One that is not `honest`
    ignores every sync after the first of them."""
    disk = Disk()
    with open(log, "rb") as notes:
        for number, point in enumerate(points):
            while notes.tell() + NOTE.size <= point:
                op, path_length, offset, data_length = NOTE.unpack(notes.read(NOTE.size))
                path = notes.read(path_length).decode()
                data = notes.read(data_length)
                if op != b"S" or honest or number == 0:
                    disk.do(op, path, offset, data)
            yield disk
