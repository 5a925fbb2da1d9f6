"""Other simulators with the parameters that `contactctl model translate` gives them: a collision in
each, at a step that is refined, beside what contactctl says that it gives back."""

from __future__ import annotations

import json
import os
import pathlib
import shlex
import shutil
import subprocess
import tempfile
from collections.abc import Callable
from typing import NamedTuple

HERE = pathlib.Path(__file__).resolve().parent
BUILT = HERE.parents[1] / "build/release/client/cli/contactctl"
CONTACTCTL = os.environ.get("CONTACTCTL", str(BUILT))

#: A ball of 1 kg at 1 m/s whose contacts last about 14 ms and are 4 mm deep: so soft
#: that the positions of Bullet, in single precision, resolve it.
MASS, VELOCITY, RADIUS, STIFFNESS, TIME = 1.0, 1.0, 0.05, 1e6, 0.014


class Case(NamedTuple):
    """A collision in a simulator."""
    tool: str
    restitution: float
    step: float
    gravity: float = 0.0


class Translated(NamedTuple):
    """What contactctl says about a case."""
    values: list[float]
    line: str
    predicted: float


def translate(case: Case) -> Translated:
    """The parameters for the case, and e_N as it is to come out at its step."""
    command = [CONTACTCTL, "model", "translate", case.tool, f"--restitution={case.restitution}",
               f"--velocity={VELOCITY}", f"--mass={MASS}", f"--radius={RADIUS}",
               f"--stiffness={STIFFNESS}", f"--step={case.step}", f"--gravity={case.gravity}",
               "-o", "json"]
    printed = subprocess.run(command, check=True, capture_output=True, encoding="utf-8").stdout
    found = json.loads(printed)["translations"][0]
    at_step = found["at_step"] or {"mean": found["delivered"]["velocity_ratio"]}
    return Translated([p["value"] for p in found["parameters"]], found["line"], at_step["mean"])


def run(command: list[str], folder: str | pathlib.Path = ".") -> str:
    """What a program prints. Raises RuntimeError with its end if it fails."""
    done = subprocess.run(command, cwd=folder, capture_output=True, encoding="utf-8",
                          errors="replace", timeout=600)
    if done.returncode:
        raise RuntimeError(f"{shlex.join(command)}\n{done.stdout[-1500:]}{done.stderr[-1500:]}")
    return done.stdout


#: Two equal balls in a row, the first of which strikes the other. Each has twice the effective mass
#: and radius.
BALLS = """units si
atom_style {style}
atom_modify map array
newton off
{communicate} vel yes
region box block -1 2 -1 1 -1 1
create_box 1 box
neighbor 0.02 bin
neigh_modify delay 0 every 1 check yes
{law}
timestep {step}
create_atoms 1 single 0 0 0
create_atoms 1 single {gap} 0 0
set group all diameter {diameter}
set group all mass {mass}
set atom 1 vx {velocity}
fix move all nve/sphere
variable difference equal vx[2]-vx[1]
thermo_style custom step v_difference
thermo_modify format float %.12g
thermo {steps}
run {steps}
"""


def row_of_two(program: str, case: Case, **words: str) -> float:
    """The velocities' difference at the end, over that at the start, of LAMMPS or LIGGGHTS."""
    steps = round(2 * TIME / case.step)
    text = BALLS.format(step=case.step, steps=steps, diameter=4 * RADIUS, mass=2 * MASS,
                        gap=4 * RADIUS + 0.5 * VELOCITY * case.step, velocity=VELOCITY, **words)
    with tempfile.TemporaryDirectory() as folder:
        (pathlib.Path(folder) / "in").write_text(text, "utf-8")
        printed = run([program, "-in", "in", "-log", "none"], folder)
    last = [line.split() for line in printed.splitlines() if line.split()[:1] == [str(steps)]][-1]
    return float(last[1]) / VELOCITY


def lammps(case: Case, told: Translated) -> float:
    return row_of_two("lmp", case, style="sphere", communicate="comm_modify",
                      law=f"pair_style granular\n{told.line}")


def liggghts(case: Case, told: Translated) -> float:
    style = told.line.partition("#")[0]
    # Its hooke has a characteristic velocity, its hertz has none.
    modulus, restitution, velocity = (told.values + [VELOCITY])[:3]
    law = f"""soft_particles yes
fix 1 all property/global youngsModulus peratomtype {modulus}
fix 2 all property/global poissonsRatio peratomtype 0
fix 3 all property/global coefficientRestitution peratomtypepair 1 {restitution}
fix 4 all property/global characteristicVelocity scalar {velocity}
fix 5 all property/global coefficientFriction peratomtypepair 1 0
{style}
pair_coeff * *"""
    return row_of_two("liggghts", case, style="granular", communicate="communicate single", law=law)


def arguments(case: Case, told: Translated, last: float) -> list[str]:
    numbers = [*told.values, MASS, RADIUS, VELOCITY, case.gravity, last]
    return [f"{number:.17g}" for number in numbers]


def yade(case: Case, told: Translated) -> float:
    script = str(HERE / "yade_peer.py")
    printed = run(["yade", "-n", "-x", script, *arguments(case, told, case.step)])
    return float(printed.split("ratio")[1].split()[0])


#: A program that is compiled here: its header, and the flags that link it.
ENGINES = {
    "bullet": ("bullet/btBulletDynamicsCommon.h",
               "-isystem /usr/include/bullet -lBulletDynamics -lBulletCollision -lLinearMath"),
    "mujoco": ("mujoco/mujoco.h", "-lmujoco"),
    "ode": ("ode/ode.h", "-lode"),
    "simbody": ("simbody/Simbody.h",
                "-isystem /usr/include/simbody -lSimTKsimbody -lSimTKmath -lSimTKcommon"),
}


def compiled(name: str, folder: pathlib.Path) -> Callable[[Case, Translated], float]:
    """Builds the peer of an engine; the function that runs it."""
    program = folder / name
    run(["g++", "-O2", "-std=c++17", str(HERE / f"{name}_peer.cpp"), "-o", str(program),
         *shlex.split(ENGINES[name][1])])

    def collide(case: Case, told: Translated) -> float:
        last = 1e-10 if name == "simbody" else case.step  # It has an accuracy in place of a step.
        return float(run([str(program), *arguments(case, told, last)], folder))

    return collide


def simulators(folder: pathlib.Path) -> dict[str, Callable[[Case, Translated], float]]:
    """The peers that are installed, by how the names of their tools begin."""
    peers = {name: peer for name, program, peer in (("lammps", "lmp", lammps),
                                                    ("liggghts", "liggghts", liggghts),
                                                    ("yade", "yade", yade))
             if shutil.which(program)}
    for name, (header, _) in ENGINES.items():
        if (pathlib.Path("/usr/include") / header).exists():
            peers[name] = compiled(name, folder)
    return peers
