"""Rows of another program on the same scenario: LAMMPS, the package `lammps` of Debian."""

from __future__ import annotations

import math
import pathlib
import subprocess
import tempfile
from typing import Any

from isolated import delivered_clamped
from laboratory import Laboratory, ball_and_wall, row_of_balls
from rows import row

PEERS = "LAMMPS on the same scenario"
SOURCE = "LAMMPS, velocity Verlet, fixed step"

#: Balls of diameter 1 and mass 1 on the x axis, touching, the first with velocity 1.
INPUT = """units si
atom_style sphere
atom_modify map array
newton off
comm_modify vel yes
region box block -200 200 -2 2 -2 2
create_box 1 box
{atoms}
set group all diameter 1.0
set group all mass 1.0
set atom 1 vx 1.0
neighbor 0.3 bin
neigh_modify delay 0 every 1 check yes
{law}
fix move all nve/sphere
timestep {step}
thermo_modify lost warn
run {steps}
{variables}
print "velocities {printed}"
"""


def lammps(balls: int, law: str, time: float, step: float) -> list[float]:
    """The final velocities of a row of balls."""
    numbers = range(1, balls + 1)
    text = INPUT.format(
        atoms="\n".join(f"create_atoms 1 single {n - 1} 0 0" for n in numbers), law=law, step=step,
        steps=round(time / step),
        variables="\n".join(f"variable v{n} equal vx[{n}]" for n in numbers),
        printed=" ".join(f"$(v_v{n}:%.12g)" for n in numbers))
    with tempfile.TemporaryDirectory() as folder:
        (pathlib.Path(folder) / "in").write_text(text, "utf-8")
        run = subprocess.run(["lmp", "-in", "in", "-log", "none"], cwd=folder,
                             capture_output=True, encoding="utf-8")
    if run.returncode:
        raise RuntimeError(run.stdout[-500:] + run.stderr)
    line = next(part for part in run.stdout.splitlines() if part.startswith("velocities "))
    return [float(word) for word in line.split()[1:]]


def hertz(balls: int) -> None:
    @row(f"lammps-cradle-{balls}", PEERS,
         f"velocities of {balls} equal balls, the first one struck, Hertz, no damping", SOURCE, 1e-7,
         needs="lmp")
    def _(laboratory: Laboratory) -> Any:
        law = "pair_style gran/hertz/history 2.0e5 0.0 0.0 0.0 0.0 0\npair_coeff * *"
        return (laboratory.velocities(row_of_balls([1.0] * balls, 1, 10.0 * balls)),
                lammps(balls, law, 0.06 * balls, 2e-6))


for count in (3, 5, 10, 20):
    hertz(count)


def linear(limited: bool, words: str) -> None:
    @row(f"lammps-linear{'-limited' if limited else ''}", PEERS,
         f"v⁺/v⁻ of a linear spring and damper {words}, damping for ε = 0.5", SOURCE, 1e-4,
         needs="lmp")
    def _(laboratory: Laboratory) -> Any:
        z = -math.log(0.5) / math.hypot(math.pi, math.log(0.5))
        damping = 2 * z * math.sqrt(1000 * 0.5)
        law = (f"pair_style granular\npair_coeff * * hooke 1000 {damping} damping velocity "
               f"tangential linear_nohistory 0 0{' limit_damping' if limited else ''}")
        first, second = lammps(2, law, 0.2, 1e-6)
        if limited:
            return delivered_clamped(laboratory, 0.5), second - first
        scenario = ball_and_wall(1, 1000, 0.5, 1, velocity=-1, position=0.01, exponent=1,
                                 damping="KELVIN_VOIGT")
        only = laboratory.cycles(scenario)[0]
        return -only.separation_velocity_m_per_s, second - first


linear(False, "that may pull")
linear(True, "kept from pulling")
