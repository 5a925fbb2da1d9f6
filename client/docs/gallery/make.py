"""Makes the gallery in a folder: a page, a scenario and a picture for each card, and their index.

    make.py FOLDER [--sample] [NAME…]    all cards, those named, or the first ones of each group

A card is a file of cards/. It has `title`, `group` and `text`, and

- `scenario`: a template's name or a text in YAML; or `build`: Python that leaves a dict `scenario`;
- `plot`: arguments of `contactctl plot`; or `draw`: Python that draws with `result` and `plt`;
- `shell` and `python`: what is shown and run instead of the commands that follow from these;
- `number`: `what` is shown, `ours` and `theirs` as expressions in Python, `within` which relative
  difference they agree, and the `source` of theirs; `given` has statements before these.

The texts of shell and Python run as they are shown. A number that is not within is an error.
"""

import os
import pathlib
import re
import subprocess
import sys
import textwrap
import time
import urllib.parse

import contactsim
import matplotlib
import matplotlib.pyplot as plt
import numpy as np
import yaml

SCENARIOS = pathlib.Path(contactsim.scenario.__file__).parents[2] / "scenarios"
GROUPS = ("Collisions", "Chains", "Loads and walls", "Laws and measurements",
          "Figures of the paper")


def scenario_text(card):
    """The scenario of a card as the text of a file; empty if it has none."""
    if "build" in card:
        names = {"np": np}
        exec(card["build"], names)
        return yaml.safe_dump(names["scenario"], sort_keys=False, allow_unicode=True,
                              default_flow_style=None, width=160)
    text = card.get("scenario", "")
    if text and "\n" not in text:
        text = (SCENARIOS / f"{text}.yaml").read_text("utf-8").split("\n", 1)[1]
    return text


def shell_of(name, card):
    """The commands of a card."""
    if "shell" in card:
        return card["shell"]
    plot = f"contactctl plot last {card.get('plot')} --no-provenance -f {name}.svg\n"
    return f"contactctl run {name}.yaml\n" + (plot if "plot" in card else "")


def python_of(name, card):
    """The statements of a card; empty if it has none."""
    if "python" in card or "shell" in card:
        return card.get("python", "")
    preset = card.get("plot", "").split(" ")[0].replace("-", "_")
    drawn = f"result.plot.{preset}()\n" if preset else card["draw"]
    head = "import matplotlib.pyplot as plt\nimport numpy as np\n" if "draw" in card else ""
    return f'{head}import contactsim\n\nresult = contactsim.Client().run("{name}.yaml")\n{drawn}'


def run(name, card):
    """Runs what the card shows in the current folder; the values of its number."""
    shell = subprocess.run(["bash", "-ec", shell_of(name, card)], stdout=subprocess.PIPE,
                           stderr=subprocess.STDOUT, encoding="utf-8")
    if shell.returncode:
        raise SystemExit(f"gallery: {name}: {shell.stdout}")
    names = {"np": np, "plt": plt, "contactsim": contactsim}
    exec(compile(python_of(name, card), name, "exec"), names)
    if "draw" in card or "python" in card and not pathlib.Path(f"{name}.svg").exists():
        plt.gcf().savefig(f"{name}.svg", metadata={"Date": None})
    plt.close("all")
    number = card.get("number")
    if not number:
        return None
    exec(number.get("given", ""), names)
    ours, theirs = (float(eval(str(number[key]), names)) for key in ("ours", "theirs"))
    off = abs(ours - theirs) / (abs(theirs) or 1)
    if not off <= float(number["within"]):
        raise SystemExit(f"gallery: {name}: {number['what']}: {ours}, not {theirs}")
    return ours, theirs, off


def fenced(language, text, indent=0):
    """A block of code in MyST."""
    return textwrap.indent(f"```{language}\n{text.rstrip()}\n```\n", " " * indent)


def tab(title, language, text):
    """A tab of inline-tabs."""
    return f"````{{tab}} {title}\n{fenced(language, text)}````\n"


def page(name, card, scenario, values):
    """The page of a card."""
    parts = [f"# {card['title']}\n", card["text"],
             f"![{card['title']}: {card['alt']}]({name}.svg)\n"]
    if values:
        number = card["number"]
        parts.append(f"| | here | there | difference |\n|---|---|---|---|\n| {number['what']} | "
                     f"{values[0]:.8g} | {values[1]:.8g} | {values[2]:.1e} |\n\n"
                     f"There: {number['source']}.\n")
    tabs = (("Command line", "sh", shell_of(name, card)),
            ("Python", "python", python_of(name, card)))
    parts.append("".join(tab(*parts) for parts in tabs if parts[2]))
    if scenario:
        address = "/new#text=" + urllib.parse.quote(scenario, safe="")
        parts.append(f'{{download}}`Download {name}.yaml <{name}.yaml>` or <a class="open" '
                     f'href="{address}">open it in your dashboard</a>.\n')
        parts.append(f"## {name}.yaml\n\n{fenced('yaml', scenario)}")
    return "\n".join(parts)


def index(cards):
    """The page of all cards."""
    parts = ["# Gallery\n", f"{len(cards)} scenarios, each with its picture, its commands, and most "
             "with a number beside its closed form or source. All of it is run when this page is "
             "made.\n"]
    for group in GROUPS:
        found = {name: card for name, card in cards.items() if card["group"] == group}
        parts.append(f"## {group}\n\n`````{{container}} cards")
        for name, card in found.items():
            parts.append(f"```{{figure}} {name}.svg\n:target: {name}.html\n:alt: {card['alt']}\n\n"
                         f"{card['title']}\n```")
        parts.append("`````\n")
    parts.append("```{toctree}\n:hidden:\n\n" + "\n".join(cards) + "\n```\n")
    return "\n".join(parts)


def place(item):
    """Where a card stands in the gallery."""
    name, card = item
    number = re.fullmatch(r"fig(\d+)", name)
    return GROUPS.index(card["group"]), int(number[1]) if number else 0, name


def main(folder, chosen):
    matplotlib.rcParams.update({
        "svg.hashsalt": "contactd", "svg.fonttype": "none", "figure.figsize": (6.4, 4.0),
        "figure.constrained_layout.use": True, "path.simplify_threshold": 0.5})
    files = sorted((folder / "cards").glob("*.yaml"))
    cards = {file.stem: yaml.safe_load(file.read_text("utf-8")) for file in files}
    if chosen == ["--sample"]:
        chosen = [name for group in GROUPS
                  for name in [name for name in cards if cards[name]["group"] == group][:2]]
    cards = {name: card for name, card in sorted(cards.items(), key=place)
             if not chosen or name in chosen}
    os.chdir(folder)
    for name, card in cards.items():
        begin = time.monotonic()
        scenario = scenario_text(card)
        if scenario:
            pathlib.Path(f"{name}.yaml").write_text(scenario, "utf-8")
        values = run(name, card)
        pathlib.Path(f"{name}.md").write_text(page(name, card, scenario, values), "utf-8")
        print(f"gallery: {name} in {time.monotonic() - begin:.1f} s", flush=True)
    pathlib.Path("index.md").write_text(index(cards), "utf-8")


if __name__ == "__main__":
    main(pathlib.Path(sys.argv[1]).resolve(), sys.argv[2:])
