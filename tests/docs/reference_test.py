"""The reference of the site names whatever contract, programs and contactsim have."""

import os
import pathlib
import re
import sys
import unittest

import contactsim
from contact.v1 import event_pb2, job_pb2, scenario_pb2

ROOT = pathlib.Path(__file__).resolve().parents[2]
FOLDER = ROOT / "client" / "docs" / "reference"
sys.path.insert(0, str(FOLDER))
for program in ("CONTACTCTL", "CONTACTD"):
    os.environ["PATH"] = f"{pathlib.Path(os.environ[program]).parent}:{os.environ['PATH']}"

import contract  # noqa: E402
import make  # noqa: E402
import python_page  # noqa: E402


def fields_of(file):
    """The names of all fields of a file of the contract."""
    def below(message):
        yield from (field.name for field in message.fields)
        for inner in message.nested_types:
            yield from below(inner)
    return {name for message in file.message_types_by_name.values() for name in below(message)}


class ReferenceTest(unittest.TestCase):

    def test_every_field_of_the_contract_has_a_row(self):
        pages = {scenario_pb2: contract.messages_page("", "scenario.proto"),
                 job_pb2: contract.messages_page("", "job.proto"),
                 event_pb2: contract.messages_page("", "event.proto")}
        for module, page in pages.items():
            names = fields_of(module.DESCRIPTOR) - {"key", "value"}  # Of maps.
            self.assertGreater(len(names), 10)
            self.assertEqual({name for name in names if f"| `{name}` |" not in page}, set())

    def test_a_row_has_unit_range_default_and_meaning(self):
        page = contract.messages_page("", "scenario.proto")
        self.assertIn("| `velocity_m_per_s` | number | m/s | [-1e6, 1e6] | 0 | Velocity at time 0. |",
                      page)
        self.assertIn("| `stiffness` | number | N/m^exponent | (0, 1e30] |", page)

    def test_every_reason_of_an_error_is_told(self):
        source = (ROOT / "server/jobs/job/errors.cpp").read_text("utf-8")
        reasons = set(re.findall(r'\{Reason::k\w+, "([A-Z_]+)"', source))
        self.assertGreater(len(reasons), 20)
        self.assertEqual(reasons - set(contract.errors(*make.SERVICES)), set())

    def test_every_metric_is_told(self):
        source = (ROOT / "server/rpc/metrics/metrics_page.cpp").read_text("utf-8")
        self.assertEqual({name for name, _, _ in make.metrics()},
                         set(re.findall(r'"(contactd_\w+)"', source)))

    def test_every_verb_has_its_help(self):
        verbs = (ROOT / "client/cli/verbs/verbs.def").read_text("utf-8")
        page = make.commands_page()
        for verb in re.findall(r'^VERB\(\w+, "([a-z]+)"', verbs, re.M) or self.fail("no verbs"):
            self.assertIn(f"\n## {verb}\n", page)
        self.assertIn("\n## sweep heatmap\n", page)

    def test_all_that_contactsim_exports_is_described(self):
        page = python_page.page()
        for name in contactsim.__all__:
            self.assertIn(f"\n## {name}\n", page)


if __name__ == "__main__":
    unittest.main()
