"""Holds the rooms of the tree to their order: a file includes its own room and those before it.

Walks folders recursively. Fails on an include against the order, on a cycle between two units
(a header with its source), on a folder that is too full, and on one that no order names."""

import pathlib
import re
import unittest

ROOT = pathlib.Path(__file__).resolve().parent.parent
MOST_FILES = 35

# The rooms of each folder; a room may include those before it. `.` is the files of the folder.
ORDER = {
    "server": ["base", "identity", "simulation", "translate", "wire", "storage", "launcher", "jobs", "rpc",
               "gateway", "."],
    "server/wire": ["rules", "scenario", "sweep", "."],
    "server/simulation": ["laws", "model", "methods", "motion", "episode", "course", "clusters",
                          "forecast", "statics", "."],
    "server/storage": [".", "sqlite", "postgres"],
    "server/jobs": ["job", "quota", "log", "read", "run", "schedule", "cluster", "."],
    "server/rpc": ["net", "metrics", "call", "stream", "."],
    "server/gateway": ["net", "protocol", "openapi", "call", "http1", "http2", "."],
    "client/cli": ["base", "input", "settings", "link", "text", "export", "help", "verbs", "."],
    "client/cli/text": [".", "comparison", "sweep"],
    "client/cli/help": ["contract", "."],
    "client/cli/verbs": ["identity", "job", "laws", "sweep", "."],
}
# What a folder must not include whatever the order says: folder, pattern, reason.
REFUSED = [
    ("server", r"cli/", "the server does not know its clients"),
    ("server/storage", r"(simulation|wire)/", "storage keeps bytes, it does not read them"),
    ("server/base", r"(.*\.pb\.h|grpc)", "base knows neither contract nor network"),
    ("server/simulation", r"(.*\.pb\.h|grpc|spdlog|fmt/|thread>|mutex>|fstream>|chrono>)",
     "the physics has no I/O, threads, clock, contract or log"),
    ("client", r"(simulation|storage|jobs|rpc)/",
     "clients use the contract, wire/ for its rules, and translate/ for what needs no server"),
    ("server/translate", r"(.*\.pb\.h|grpc|simulation/|spdlog|thread>|mutex>|fstream>|chrono>)",
     "values in, values out: clients link it without the solver"),
]
INCLUDE = re.compile(r'^#include [<"]([^>"]+)', re.MULTILINE)


def sources(root):
    """Path from the root -> what it includes, of every C++ file of server and client."""
    return {
        str(path.relative_to(root)): INCLUDE.findall(path.read_text("utf-8"))
        for folder in ("server", "client")
        for ending in ("*.h", "*.cpp")
        for path in sorted((root / folder).rglob(ending))
        if "node_modules" not in path.parts
    }


def own_includes(files):
    """(file, the file of ours that it includes), of all."""
    for path, included in files.items():
        for name in included:
            for folder in ("server", "client"):
                target = f"{folder}/{name}"
                if target in files:
                    yield path, target


def room(path, folder):
    """The room of a file below the folder."""
    rest = path[len(folder) + 1:].split("/")
    return rest[0] if len(rest) > 1 else "."


def order_violations(files):
    """Includes of a room that comes later."""
    for path, target in own_includes(files):
        for folder, rooms in ORDER.items():
            if path.startswith(folder + "/") and target.startswith(folder + "/"):
                here, there = room(path, folder), room(target, folder)
                if here in rooms and there in rooms and rooms.index(there) > rooms.index(here):
                    yield f"{path} includes {target}: {here} comes before {there} in {folder}"


def refused_includes(files):
    """Includes that a folder must not have at all."""
    for path, included in files.items():
        for folder, pattern, why in REFUSED:
            if path.startswith(folder + "/"):
                yield from (f"{path} includes {name}: {why}" for name in included
                            if re.match(pattern, name))


def unknown_rooms(files):
    """Folders with files that have no place in an order."""
    for path in files:
        for folder, rooms in ORDER.items():
            if path.startswith(folder + "/") and room(path, folder) not in rooms:
                yield f"{path}: {folder} has no room {room(path, folder)}"


def cycles(files):
    """Groups of units that include each other, directly or not."""
    edges = {}
    for path, target in own_includes(files):
        unit, other = path.rsplit(".", 1)[0], target.rsplit(".", 1)[0]
        edges.setdefault(unit, set()).add(other)
        edges.setdefault(other, set())
    reached = {unit: reachable(edges, unit) for unit in edges}
    found = {frozenset(other for other in reached[unit] if unit in reached[other])
             for unit in edges if unit in reached[unit]}
    return [sorted(group) for group in found if len(group) > 1]


def reachable(edges, start):
    """Units that `start` includes, directly or not."""
    seen, waiting = set(), [start]
    while waiting:
        for unit in edges[waiting.pop()] - seen:
            seen.add(unit)
            waiting.append(unit)
    return seen


def full_folders(root):
    """Folders of product code with more files than a reader can survey."""
    for top in ("server", "client/cli"):
        for folder in [root / top, *(p for p in (root / top).rglob("*") if p.is_dir())]:
            count = sum(path.is_file() for path in folder.iterdir())
            if count > MOST_FILES:
                yield f"{folder.relative_to(root)}: {count} files, at most {MOST_FILES}"


class LayeringTest(unittest.TestCase):

    @classmethod
    def setUpClass(cls):
        cls.files = sources(ROOT)

    def test_every_include_follows_the_order(self):
        self.assertEqual(list(order_violations(self.files)), [])

    def test_no_folder_includes_what_it_must_not_know(self):
        self.assertEqual(list(refused_includes(self.files)), [])

    def test_every_folder_has_its_place_in_an_order(self):
        self.assertEqual(list(unknown_rooms(self.files)), [])

    def test_no_unit_includes_itself_through_others(self):
        self.assertEqual(cycles(self.files), [])

    def test_no_folder_is_too_full(self):
        self.assertEqual(list(full_folders(ROOT)), [])

    def test_every_room_has_files(self):
        for folder, rooms in ORDER.items():
            for name in rooms:
                self.assertTrue(
                    any(path.startswith(folder + "/") and room(path, folder) == name
                        for path in self.files), f"{folder}/{name}: this test has gone blind")


class CheckTest(unittest.TestCase):
    """The checks see what they are for."""

    def test_include_of_a_later_room_is_seen(self):
        files = {"server/jobs/log/a.h": ["jobs/run/b.h"], "server/jobs/run/b.h": []}
        self.assertEqual(len(list(order_violations(files))), 1)

    def test_cycle_through_sources_is_seen(self):
        files = {"server/base/a.h": [], "server/base/a.cpp": ["base/b.h"],
                 "server/base/b.h": ["base/a.h"]}
        self.assertEqual(cycles(files), [["server/base/a", "server/base/b"]])

    def test_unknown_room_is_seen(self):
        self.assertEqual(len(list(unknown_rooms({"server/attic/a.h": []}))), 1)


if __name__ == "__main__":
    unittest.main()
