"""Writes the pages of the reference: each from what the programs themselves say.

    make.py FOLDER    with contactctl and contactd in the PATH, and a contactd at CONTACT_SERVER
"""

from __future__ import annotations

import pathlib
import re
import subprocess
import sys

import contract
import python_page

SERVICES = ("job_service.proto", "admin_service.proto")


def output(*command: str) -> str:
    """What a program prints."""
    return subprocess.run(command, check=True, capture_output=True, encoding="utf-8").stdout


def verbs() -> list[str]:
    """The verbs of contactctl, and those below them, as words of a command line."""
    found = []
    for verb in re.findall(r"^  ([a-z-]+) {2,}\S", output("contactctl", "help"), re.M):
        found.append(verb)
        below = output("contactctl", "help", verb).partition("SUBCOMMANDS:")[2]
        below = below or output("contactctl", "help", verb).partition("COMMANDS\n")[2]
        found += [f"{verb} {word}" for word in re.findall(r"^  ([a-z-]+) {2,}\S", below, re.M)]
    return found


def verbs_page() -> str:
    """The help of each verb."""
    lines = ["# Commands", "", "What `contactctl help` prints.", "",
             "```text", output("contactctl", "help").rstrip(), "```", ""]
    for verb in verbs():
        lines += [f"## {verb}", "", "```text", output("contactctl", "help", *verb.split()).rstrip(),
                  "```", ""]
    return "\n".join(lines)


def settings_page() -> str:
    """The flags of contactd."""
    return "\n".join(["# Flags of contactd", "", "What `contactd --help` prints.", "", "```text",
                      output("contactd", "--help").rstrip(), "```", ""])


def metrics_page() -> str:
    """The metrics of a running contactd, with the meaning that it tells Prometheus."""
    lines = ["# Metrics", "", "From `/metrics` of a contactd that has just begun; Prometheus reads "
             "it. A metric that has labels appears there once it has a value.", "",
             "| Metric | Type | Meaning |", "|---|---|---|"]
    text = output("contactctl", "server", "metrics")
    types = dict(re.findall(r"^# TYPE (\S+) (\S+)$", text, re.M))
    lines += [f"| `{name}` | {types.get(name, '')} | {contract.escaped(words)} |"
              for name, words in sorted(re.findall(r"^# HELP (\S+) (.*)$", text, re.M))]
    return "\n".join([*lines, ""])


def main(folder: pathlib.Path) -> None:
    pages = {
        "scenario": contract.messages_page("Scenario and sweep", "scenario.proto"),
        "results": contract.messages_page("Jobs, ledger and events", "job.proto", "event.proto"),
        "services": contract.services_page("Services", *SERVICES),
        "requests": contract.messages_page("Requests and answers", *SERVICES),
        "errors": contract.errors_page(*SERVICES),
        "python": python_page.page(),
        "commands": verbs_page(),
        "settings": settings_page(),
        "metrics": metrics_page(),
    }
    for name, text in pages.items():
        (folder / f"{name}.md").write_text(re.sub(r"\n{3,}", "\n\n", text), "utf-8")


if __name__ == "__main__":
    main(pathlib.Path(sys.argv[1]))
