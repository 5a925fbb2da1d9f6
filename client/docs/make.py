"""Makes the moving picture of the front page in a folder: static/chain-moving.svg and, for readers
who want nothing to move, static/chain-still.svg.

    make.py FOLDER

Each pass of the search for μ in the triple-ball chain is run again with the μ that it had. The
picture shows the balls, displacements 250 times as large, the loops of force over deformation, and
how far ε is off after each pass.
"""

import pathlib
import sys

import contactsim
import numpy as np

CONTACTS = {"B1-B2": "#0072B2", "B2-B3": "#D55E00"}
ASKED = {"B1-B2": 0.8, "B2-B3": 0.7}
PASS_S, LAST_S = 2.0, 4.0  # How long a pass is shown, and the last one.
FRAMES = 24                # Of a pass.
MAGNIFIED = 250
PX_PER_M = 480
WIDTH, HEIGHT = 720, 330


def passes(client):
    """A run for each pass, with its μ and with what its ε was off."""
    chain = client.run("three-ball-chain")
    table = chain.iterations
    for number in sorted(set(table["pass"])):
        mu = table[table["pass"] == number].set_index("contact").mu
        change = {}
        for name in CONTACTS:
            change |= {f"contacts[{name}].damping": "MU", f"contacts[{name}].mu": float(mu[name])}
        scenario = contactsim.load_scenario("three-ball-chain")
        for contact in scenario.contacts:
            contact.ClearField("restitution")
        run = client.run(scenario, set=change)
        had = run.cycles.set_index("contact").restitution_out
        yield run, {name: abs(had[name] / ASKED[name] - 1) for name in CONTACTS}, had


class Clock:
    """Where the passes are in the time of the picture, from 0 to 1."""

    def __init__(self, count):
        self.total_s = PASS_S * (count - 1) + LAST_S
        self.count = count

    def begin(self, number):
        return number * PASS_S / self.total_s

    def times(self, number):
        """Of the frames of a pass, which fill 9/10 of PASS_S."""
        return self.begin(number) + np.linspace(0, 0.9 * PASS_S / self.total_s, FRAMES)


def animate(clock, attribute, times, values, mode="linear"):
    """An animation through values at times, which begins at 0 and ends at 1."""
    keys = ";".join(f"{time:.4f}" for time in [*times, 1])
    shown = ";".join(f"{value:.5g}" for value in [*values, values[-1]])
    return (f'<animate attributeName="{attribute}" dur="{clock.total_s:g}s" '
            f'repeatCount="indefinite" calcMode="{mode}" keyTimes="{keys}" values="{shown}"/>')


def from_pass(clock, number):
    """Shows an element from the end of a pass on."""
    return animate(clock, "opacity", [0, clock.times(number)[-1]], [0, 1], "discrete")


def during_pass(clock, number):
    """Shows an element in a pass only."""
    if number == 0:
        return animate(clock, "opacity", [0, clock.begin(1)], [1, 0], "discrete")
    if number == clock.count - 1:
        return animate(clock, "opacity", [0, clock.begin(number)], [0, 1], "discrete")
    return animate(clock, "opacity", [0, clock.begin(number), clock.begin(number + 1)], [0, 1, 0],
                   "discrete")


def balls(clock, runs, moving):
    """The three balls."""
    at = np.linspace(0, 0.004, FRAMES)
    for i, name in enumerate(("B1", "B2", "B3")):
        x = [240 + PX_PER_M * (0.1 * i + MAGNIFIED * np.interp(
            at, run["time"], run[f"{name}.position"] - 0.1 * i)) for run in runs]
        times = np.concatenate([clock.times(number) for number in range(len(runs))])
        motion = animate(clock, "cx", times, np.concatenate(x)) if moving else ""
        yield (f'<circle cx="{x[-1][-1]:.1f}" cy="62" r="{PX_PER_M * 0.05:g}" fill="#56B4E9" '
               f'fill-opacity="0.6" stroke="#222">{motion}</circle>')


def loops(clock, runs, moving):
    """Force over deformation; each pass is drawn as its run goes on, and stays, pale."""
    at = np.linspace(0, 0.004, FRAMES)
    for number, run in enumerate(runs):
        for contact, colour in CONTACTS.items():
            x = 400 + 290 * run[f"{contact}.deformation"].clip(0) / 1.2e-4
            y = 300 - 150 * run[f"{contact}.contact_force"] / 120
            length = np.concatenate([[0], np.cumsum(np.hypot(np.diff(x), np.diff(y)))])
            drawn = np.interp(at, run["time"], length / length[-1])
            points = " ".join(f"{a:.1f},{b:.1f}" for a, b in zip(x[::10], y[::10]))
            last = number == len(runs) - 1
            motion = "" if not moving else animate(
                clock, "stroke-dashoffset", [0, *clock.times(number)][(number == 0):],
                [1, *(1 - drawn)][(number == 0):])
            yield (f'<polyline points="{points}" pathLength="1" fill="none" stroke="{colour}" '
                   f'stroke-width="{2 if last else 1}" stroke-opacity="{1 if last else 0.45}" '
                   f'stroke-dasharray="1 1">{motion}</polyline>')


def misses(clock, off, moving):
    """How far ε is off after each pass, on a logarithmic axis."""
    for number, row in enumerate(off):
        for contact, colour in CONTACTS.items():
            y = 150 + (300 - 150) * (-np.log10(max(row[contact], 1e-12))) / 12
            motion = from_pass(clock, number) if moving else ""
            yield (f'<circle cx="{110 + 60 * number}" cy="{y:.1f}" r="5" fill="{colour}">'
                   f'{motion}</circle>')


def labels(clock, had, moving):
    """Which pass it is, and its ε."""
    for number, row in enumerate(had):
        if not moving and number < len(had) - 1:
            continue
        motion = during_pass(clock, number) if moving else ""
        yield (f'<text x="400" y="120"><tspan>pass {number}: ε = </tspan>'
               f'<tspan fill="{CONTACTS["B1-B2"]}">{row["B1-B2"]:.6f}</tspan><tspan> and </tspan>'
               f'<tspan fill="{CONTACTS["B2-B3"]}">{row["B2-B3"]:.6f}</tspan>{motion}</text>')


def axes():
    """What does not move."""
    yield f'<rect width="{WIDTH}" height="{HEIGHT}" rx="8" fill="#fff"/>'
    yield '<path d="M20 86.5H700M80 140V306H340M400 140V306H700" fill="none" stroke="#888"/>'
    for power in (0, -4, -8, -12):
        yield (f'<text x="74" y="{154 - power * 12.5:g}" text-anchor="end">'
               f'1e{power}</text>')
    for number in range(4):
        yield f'<text x="{110 + 60 * number}" y="322" text-anchor="middle">pass {number}</text>'
    yield f'<text x="20" y="30">displacements × {MAGNIFIED}</text>'
    yield '<text x="80" y="120">|Δε|/ε of each contact</text>'
    yield '<text x="700" y="322" text-anchor="end">deformation, up to 0.12 mm</text>'
    yield '<text x="406" y="150">force, up to 120 N</text>'


def picture(clock, found, moving):
    runs, off, had = zip(*found)
    parts = [*axes(), *balls(clock, runs, moving), *loops(clock, runs, moving),
             *misses(clock, off, moving), *labels(clock, had, moving)]
    return (f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}" '
            f'font-family="sans-serif" font-size="13" fill="#222">\n<title>Three balls collide in '
            "each pass of the search for μ, until the restitution is right</title>\n" +
            "\n".join(parts) + "\n</svg>\n")


def main(folder):
    found = list(passes(contactsim.Client()))
    clock = Clock(len(found))
    for name, moving in (("moving", True), ("still", False)):
        (folder / "static" / f"chain-{name}.svg").write_text(picture(clock, found, moving), "utf-8")


if __name__ == "__main__":
    main(pathlib.Path(sys.argv[1]))
