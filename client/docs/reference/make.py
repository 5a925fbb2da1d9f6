"""Writes the pages of the reference: each from what the programs themselves say.

    make.py FOLDER    with contactctl and contactd in the PATH
"""

from __future__ import annotations

import pathlib
import re
import subprocess
import sys

import contract
import python_page

SERVICES = ("job_service.proto", "model_service.proto", "admin_service.proto")


def output(*command: str) -> str:
    """What a program prints."""
    return subprocess.run(command, check=True, capture_output=True, encoding="utf-8").stdout


def below(*words: str) -> list[list[str]]:
    """The commands that the help of contactctl, or of one of its verbs, lists."""
    listed = output("contactctl", *words, "--help").partition("Subcommands:\n")[2]
    names = re.findall(r"^  ([a-z-]+)(?:, [a-z-]+)* {2,}\S", listed.partition("\n\n")[0], re.M)
    return [[*words, name] for name in names]


def commands_page() -> str:
    """The help of each verb, and of those below it."""
    lines = ["# Commands", "", "What `contactctl --help` prints, and `contactctl VERB --help`.", "",
             *printed("contactctl", "--help")]
    for verb in below():
        for words in [verb, *below(*verb)]:
            lines += [f"## {' '.join(words)}", "", *printed("contactctl", *words, "--help")]
    return "\n".join(lines)


def printed(*command: str) -> list[str]:
    """The output of a program as a block."""
    return ["```text", output(*command).rstrip(), "```", ""]


def settings_page() -> str:
    """The flags of contactd."""
    return "\n".join(["# Flags of contactd", "", "What `contactd --help` prints.", "",
                      *printed("contactd", "--help")])


def metrics() -> list[tuple[str, str, str]]:
    """Name, type and meaning of each metric, from the source of the page that contactd serves."""
    source = (contract.PROTO.parent / "server/rpc/metrics/metrics_page.cpp").read_text("utf-8")
    found = re.findall(r'page->(Gauge|Counter|Distribution)\(\s*"(\w+)",\s*"([^"]*)"\)', source)
    types = {"Gauge": "gauge", "Counter": "counter", "Distribution": "histogram"}
    return sorted((name, types[kind], meaning) for kind, name, meaning in found)


def metrics_page() -> str:
    """The metrics of contactd."""
    lines = ["# Metrics", "", "`contactd --metrics-listen 127.0.0.1:9464` serves them under `/metrics` "
             "in the format of Prometheus; `contactctl server metrics` prints them. Alerts and a "
             "dashboard for Grafana are in `deploy/monitoring`.", "",
             "| Metric | Type | Meaning |", "|---|---|---|"]
    lines += [f"| `{name}` | {kind} | {contract.escaped(meaning)} |"
              for name, kind, meaning in metrics()]
    return "\n".join([*lines, ""])


def main(folder: pathlib.Path) -> None:
    pages = {
        "scenario": contract.messages_page("Scenario and sweep", "scenario.proto"),
        "results": contract.messages_page("Jobs, ledger and events", "job.proto", "event.proto"),
        "services": contract.services_page("Services", *SERVICES),
        "requests": contract.messages_page("Requests and answers", *SERVICES),
        "errors": contract.errors_page(*SERVICES),
        "python": python_page.page(),
        "commands": commands_page(),
        "settings": settings_page(),
        "metrics": metrics_page(),
    }
    for name, text in pages.items():
        (folder / f"{name}.md").write_text(re.sub(r"\n{3,}", "\n\n", text), "utf-8")


if __name__ == "__main__":
    main(pathlib.Path(sys.argv[1]))
