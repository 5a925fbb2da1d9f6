"""The alerts and the dashboard of deploy/monitoring ask for what contactd tells."""

import json
import pathlib
import re
import subprocess
import tempfile
import unittest
import urllib.request

import yaml
from contactd import PATIENCE_S, ServerTest, three_ball_chain
from tools import tool

MONITORING = pathlib.Path(__file__).resolve().parents[2] / "deploy/monitoring"
NAME = re.compile(r"contactd_[a-z_]+")
# Told by a server with TLS alone.
OF_TLS = {"contactd_tls_not_after_seconds"}
# What Grafana puts in before it asks Prometheus.
GRAFANA = {"$__rate_interval": "5m", "$instance": ".+"}


def promtool(*arguments):
    done = subprocess.run([tool("promtool"), *map(str, arguments)], text=True, timeout=PATIENCE_S,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    assert done.returncode == 0, done.stdout


def asked_by_dashboard():
    dashboard = json.loads((MONITORING / "dashboard.json").read_text())
    queries = [target["expr"] for panel in dashboard["panels"] for target in panel.get("targets", [])]
    for name, value in GRAFANA.items():
        queries = [query.replace(name, value) for query in queries]
    return queries


def asked_by_alerts():
    groups = yaml.safe_load((MONITORING / "alerts.yml").read_text())["groups"]
    return [rule["expr"] for group in groups for rule in group["rules"]]


class PromtoolTest(unittest.TestCase):

    def test_each_alert_fires_for_its_cause_alone(self):
        promtool("check", "rules", MONITORING / "alerts.yml")
        promtool("test", "rules", MONITORING / "alerts_test.yml")

    def test_each_query_of_the_dashboard_is_one(self):
        rules = [{"record": f"panel:{number}", "expr": query}
                 for number, query in enumerate(asked_by_dashboard())]
        with tempfile.NamedTemporaryFile("w", suffix=".yml") as file:
            yaml.safe_dump({"groups": [{"name": "dashboard", "rules": rules}]}, file)
            file.flush()
            promtool("check", "rules", file.name)


class NamesTest(ServerTest):

    flags = ("--metrics-listen=127.0.0.1:0",)

    def setUp(self):
        super().setUp()
        self.server.run(three_ball_chain())
        port = re.findall(r"metrics on port (\d+)", self.server.log())[-1]
        with urllib.request.urlopen(f"http://127.0.0.1:{port}/metrics", timeout=PATIENCE_S) as page:
            self.told = OF_TLS | set(re.findall(r"# TYPE (contactd_\S+)", page.read().decode()))

    def families(self, queries):
        names = {name for query in queries for name in NAME.findall(query)}
        return {name if name in self.told else re.sub(r"_(bucket|sum|count)$", "", name)
                for name in names}

    def test_alerts_ask_for_what_is_told(self):
        self.assertLessEqual(self.families(asked_by_alerts()), self.told)

    def test_dashboard_shows_all_that_is_told(self):
        self.assertEqual(self.families(asked_by_dashboard()), self.told)


if __name__ == "__main__":
    unittest.main()
