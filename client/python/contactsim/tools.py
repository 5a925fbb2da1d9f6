"""What contactctl computes for the package: translations."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
from typing import Any, Mapping, Optional, Sequence, Union

from .errors import ContactError


class ToolFailed(ContactError):
    """contactctl is not there, or ended with an error; the text says which."""


def translate(*tools: str, mass: float, velocity: Union[float, Sequence[float]],
              start: Optional[str] = None, values: Optional[Mapping[str, float]] = None,
              **given: float) -> dict[str, Any]:
    """A contact in the parameters of other simulators, and what they give back with them.

    `tools` are contact models, such as `"mujoco"` or `"lammps-hooke"`; without any, all of them.
    The contact is given by `restitution` and `stiffness` (with `exponent`, 1.5 unless given) or
    `contact_time`; or by the parameters `values` of the tool `start`: then the answer also has
    what that gives back at each velocity. Further: `gravity`, `radius`, `step`. All in SI units, as
    `contactctl model translate --help` says, which computes this and must be installed. No server
    is asked.

    Returns what `contactctl model translate -o json` prints: `translations`, and `rebounds` where
    `start` is given. Raises ToolFailed.
    """
    velocities = [velocity] if isinstance(velocity, (int, float)) else velocity
    flags = [f"--{name.replace('_', '-')}={value!r}" for name, value in given.items()]
    flags += [f"--mass={mass!r}", "--velocity=" + ",".join(map(repr, velocities))]
    if start is not None:
        flags += [f"--from={start}"]
        flags += [f"--set={name}={value!r}" for name, value in (values or {}).items()]
    printed = _contactctl("model", "translate", *tools, *flags, "-o", "json").stdout
    answer: dict[str, Any] = json.loads(printed)
    return answer


def _contactctl(*arguments: str) -> subprocess.CompletedProcess[str]:
    """Runs contactctl to its end, with success."""
    program = os.environ.get("CONTACTCTL") or shutil.which("contactctl")
    if program is None:
        raise ToolFailed("this needs contactctl on the PATH, or its path in the variable "
                         "CONTACTCTL: apt install contactctl")
    try:
        run = subprocess.run([program, *arguments], capture_output=True, encoding="utf-8",
                             check=False)
    except OSError as error:
        raise ToolFailed(f"{program} cannot be run: {error.strerror}") from error
    if run.returncode != 0:
        raise ToolFailed(run.stderr.strip() or f"contactctl ended with code {run.returncode}")
    return run
