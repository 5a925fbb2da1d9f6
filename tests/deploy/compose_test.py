"""deploy/compose.yml is what compose takes, and its contactd has no more rights than it needs."""

import pathlib
import shutil
import subprocess
import tempfile
import unittest

import schemas
import yaml
from flags import unknown

DEPLOY = pathlib.Path(__file__).resolve().parents[2] / "deploy"
COMPOSE = yaml.safe_load((DEPLOY / "compose.yml").read_text())
SERVICES = COMPOSE["services"]
OURS = {name: service for name, service in SERVICES.items() if name != "postgres"}


class ComposeTest(unittest.TestCase):

    def test_schema_allows_the_file(self):
        # The schema of that package is older than `name`.
        value = {key: part for key, part in COMPOSE.items() if key != "name"}
        self.assertEqual(schemas.mistakes("compose.mjs", value), [])

    def test_arguments_are_flags_of_contactd(self):
        for name, service in OURS.items():
            self.assertEqual(unknown(service["command"]), [], name)

    def test_our_containers_have_no_rights(self):
        rights = {"read_only": True, "cap_drop": ["ALL"], "security_opt": ["no-new-privileges"],
                  "user": "65532:65532"}
        for name, service in OURS.items():
            self.assertLessEqual(rights.items(), service.items(), name)

    def test_only_this_machine_reaches_a_port(self):
        for name, service in SERVICES.items():
            for port in service.get("ports", []):
                self.assertTrue(port.startswith("127.0.0.1:"), f"{name}: {port}")
        self.assertIs(COMPOSE["networks"]["inside"]["internal"], True)
        self.assertEqual([name for name, service in SERVICES.items()
                          if service["networks"] != ["inside"]], ["front"])

    def test_what_services_name_is_there(self):
        for name, service in SERVICES.items():
            self.assertLessEqual(set(service["secrets"]), COMPOSE["secrets"].keys(), name)
            self.assertLessEqual(set(service["networks"]), COMPOSE["networks"].keys(), name)
            self.assertLessEqual(service.get("depends_on", {}).keys(), SERVICES.keys(), name)

    def test_secrets_are_made_once_and_are_for_nobody_else(self):
        folder = pathlib.Path(tempfile.mkdtemp(prefix="contact-compose-"))
        self.addCleanup(shutil.rmtree, folder)
        shutil.copy(DEPLOY / "compose-secrets", folder)
        made = []
        for _ in range(2):
            subprocess.run([folder / "compose-secrets"], check=True)
            made.append({path.name: path.read_text() for path in (folder / "secrets").iterdir()})
        self.assertEqual(made[0], made[1])
        self.assertEqual((folder / "secrets").stat().st_mode & 0o777, 0o700)
        wanted = {pathlib.Path(secret["file"]).name for secret in COMPOSE["secrets"].values()}
        self.assertEqual(made[0].keys(), wanted)
        self.assertIn(f"password={made[0]['pg_password']}\n", made[0]["pg_service.conf"])


if __name__ == "__main__":
    unittest.main()
