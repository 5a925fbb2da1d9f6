"""The names and numbers in the pages of server/ are those of the server."""

import os
import pathlib
import re
import subprocess
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
SERVER = ROOT / "server"
ROOMS = SERVER / "README.md"
SETTINGS = SERVER / "settings.md"
LIMITS = SERVER / "jobs/quota/README.md"
UNITS = {"": 1, "s": 1, "h": 3600, "MiB": 2**20, "GiB": 2**30, "GB": 1e9, "ms": 1e-3}


def rows(page, title=""):
    """The cells of each row of the tables in a section of a page, or in all of the page."""
    text = page.read_text("utf-8")
    section = text.split(f"\n## {title}\n", 1)[1].split("\n## ", 1)[0] if title else text
    lines = [line for line in section.splitlines() if line.startswith("| ")]
    return [[cell.strip() for cell in line.strip("|").split("|")] for line in lines]


def number(text):
    """What a cell such as `8 MiB`, `20,000` or `0: any` begins with, in seconds or bytes."""
    digits, unit = re.match(r"([\d.,]+)\s*([A-Za-z]*)", text).groups()
    return float(digits.replace(",", "")) * UNITS.get(unit, 1)


def help_text():
    return subprocess.run([os.environ["CONTACTD"], "--help"], check=True, text=True,
                          stdout=subprocess.PIPE).stdout


def defaults_of_help():
    """{flag: default} of `contactd --help`, of those that are numbers."""
    text = help_text()
    found = re.findall(r"(--[a-z-]+) [^\n]*=([\d.e+]+)(?:s| % of [a-z -]+)?"
                       r"(?:; any number where nobody is asked who calls)? \(Env", text)
    return {flag: float(value) for flag, value in found}


def sources():
    return [path.read_text("utf-8") for ending in ("*.h", "*.cpp")
            for path in SERVER.rglob(ending)]


class ReadmeTest(unittest.TestCase):

    def test_defaults_of_flags_are_those_of_the_help(self):
        told = {flag: row[row.index(f"`{flag}`") + 1]
                for page in (SETTINGS, LIMITS) for row in rows(page)
                for flag in re.findall(r"`(--[a-z-]+)`", " ".join(row[:2]))
                if f"`{flag}`" in row}
        numbers = {flag: number(cell) for flag, cell in told.items() if cell[0].isdigit()}
        self.assertGreater(len(numbers), 20)
        defaults = defaults_of_help()
        self.assertEqual(numbers, {flag: defaults.get(flag) for flag in numbers})
        words = " ".join(help_text().split())
        for flag in told.keys() - numbers.keys():
            self.assertRegex(words, f" {flag} [^=]+(=1[^=]+)*={re.escape(told[flag])} ")

    def test_every_limit_of_the_help_has_its_row(self):
        limits = {flag for flag in defaults_of_help()
                  if re.match("--(max|retain|compact|write|step|checkpoint)-", flag)}
        self.assertGreater(len(limits), 20)
        told = "".join(page.read_text("utf-8") for page in SERVER.rglob("*.md"))
        self.assertEqual({flag for flag in limits if f"`{flag}`" not in told}, set())

    def test_limits_without_a_flag_are_those_of_the_code(self):
        told = {row[0]: number(row[2]) for row in rows(LIMITS) if row[1] == "–"}
        gateway = (SERVER / "gateway/call/options.h").read_text("utf-8")
        guard = (SERVER / "rpc/call/call_guard.cpp").read_text("utf-8")
        handshake = re.search(r"handshake\{([\d']+)\}", gateway).group(1)
        deadline = re.search(r"seconds kDefaultDeadline\{(\d+)\}", guard).group(1)
        budget = (SERVER / "rpc/call/request_budget.cpp").read_text("utf-8")
        fields = re.search(r"kMostFields = 1 << (\d+)", budget).group(1)
        entries, shift = re.search(r"kMostMessages = (\d+) << (\d+)", budget).groups()
        service = (SERVER / "rpc/job_service.h").read_text("utf-8")
        requests = re.search(r"requests_\{(\d+) << 20\}", service).group(1)
        http2 = (SERVER / "gateway/http2/connection.cpp").read_text("utf-8")
        streams = re.search(r"kStreams = (\d+)", http2).group(1)
        frames = (SERVER / "gateway/http2/frame_budget.h").read_text("utf-8")
        free = re.search(r"kFree = ([\d']+)", frames).group(1)
        budgets = (SERVER / "jobs/quota/message_bytes.cpp").read_text("utf-8")
        messages = re.search(r"kAllBytes = std::size_t\{(\d+)\} << 20", budgets).group(1)
        columns = (SERVER / "wire/chunk_columns.h").read_text("utf-8")
        chunk = re.search(r"kMostChunkBytes = std::size_t\{(\d+)\} << 20", columns).group(1)
        loads = (SERVER / "wire/scenario/load_codec.cpp").read_text("utf-8")
        pieces = re.search(r"kMostPieces = ([\d']+)", loads).group(1)
        table = (ROOT / "proto/contact/v1/scenario.proto").read_text("utf-8")
        table_rows = re.search(r"times_s = 2 \[.*max_entries: (\d+)", table).group(1)
        self.assertEqual(told, {
            "rows of a table of a load or motion": float(table_rows),
            "pieces of tables with a period until the end of the run": float(pieces.replace("'", "")),
            "streams of a connection": float(streams),
            "frames of a connection in a second that move no bytes and ask nothing":
                float(free.replace("'", "")),
            "messages of all streams": int(messages) * 2**20,
            "bytes of a frame chunk": int(chunk) * 2**20,
            "fields in a CreateJob request": 2.0 ** int(fields),
            "messages in a CreateJob request, as entries of its lists":
                int(entries) * 2.0 ** int(shift),
            "memory of CreateJob requests that are not answered yet": int(requests) * 2**20,
            "time until a connection has said its first bytes": float(handshake.replace("'", "")) / 1000,
            "time in the queue of a unary call without deadline": float(deadline)})

    def test_threads_are_those_of_the_code(self):
        named = re.compile(r'(?:setname_np\(pthread_self\(\), |Executor \w+\{)"([^"]+)"')
        in_code = {name for text in sources() for name in named.findall(text)}
        told = {name for row in rows(ROOMS, "Threads") for name in re.findall(r"^`([^`]+)`$", row[0])}
        self.assertEqual(told, in_code)
        self.assertEqual({name for name in in_code if len(name) > 15}, set(), "Linux cuts names")

    def test_every_thread_has_a_name(self):
        starts = re.compile(r"std::j?thread\w*(?: \w+)?\(\[|thread_\(\[")
        for path in SERVER.rglob("*.cpp"):
            text = path.read_text("utf-8")
            if starts.search(text):
                self.assertIn("pthread_setname_np", text, path.name)

    def test_rooms_are_those_of_the_layering(self):
        text = (ROOT / "tests/layering_test.py").read_text("utf-8")
        order = dict(re.findall(r'"(server[/a-z]*)": \[([^\]]*)\]', text))
        names = lambda folder: re.findall(r'"(\w+)"', order.get(folder, ""))
        told = {row[0].strip("`/"): re.findall(r"`(\w+)`", row[2]) for row in rows(ROOMS, "Rooms")
                if row[0].endswith("/`")}
        self.assertEqual(list(told), names("server"))
        for room, inner in told.items():
            self.assertEqual(inner, names(f"server/{room}"), room)


if __name__ == "__main__":
    unittest.main()
