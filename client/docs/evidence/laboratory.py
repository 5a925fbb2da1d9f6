"""Where the rows of the evidence run their scenarios: a contactd, asked through contactsim."""

from __future__ import annotations

import functools
import json
import pathlib
from typing import Any, Sequence

import contactsim

ROOT = pathlib.Path(__file__).resolve().parents[3]

#: Accurate to about 1e-11, which every closed form allows.
SHARP = {"restitution_tolerance": 1e-11, "relative_tolerance": 1e-12}


class Laboratory:
    """Runs scenarios, each once however many rows need it."""

    def __init__(self, client: contactsim.Client) -> None:
        self.client = client
        self._results: dict[str, contactsim.Result] = {}

    def run(self, scenario: Any, **overrides: Any) -> contactsim.Result:
        """The result of a scenario or template; `overrides` are those of Client.run."""
        key = json.dumps([scenario, overrides], sort_keys=True)
        if key not in self._results:
            self._results[key] = self.client.run(scenario, **overrides)
        return self._results[key]

    def cycles(self, scenario: Any, **overrides: Any) -> list[Any]:
        """The ledger of a run."""
        return list(self.run(scenario, **overrides).job.cycles)

    def velocities(self, scenario: Any, **overrides: Any) -> list[float]:
        """The final velocities of a run, in m/s."""
        bodies = self.run(scenario, **overrides).job.final_bodies
        return [body.velocity_m_per_s for body in bodies]

    @property
    def version(self) -> tuple[str, str]:
        """Version and revision of the server that computes."""
        info = self.client.server_info()
        return info.version, info.revision


@functools.cache
def reference(name: str) -> list[dict[str, Any]]:
    """The solved cases of a file in tests/reference."""
    cases: list[dict[str, Any]] = json.loads(
        (ROOT / "tests" / "reference" / f"{name}.json").read_text("utf-8"))
    return cases


def row_of_balls(masses: Sequence[float], velocity: float, end: float, *,
                 stiffness: float | Sequence[float] = 1.0,
                 restitution: float | Sequence[float] = 1.0, radius: float = 0.5,
                 exponent: float = 1.5, gap: float = 0.0) -> dict[str, Any]:
    """Balls in a row, of which the first one moves; touching if the gap is 0."""
    pairs = len(masses) - 1
    stiffnesses = _each(stiffness, pairs)
    restitutions = _each(restitution, pairs)
    return {
        "bodies": [{"name": f"B{i + 1}", "mass_kg": mass, "radius_m": radius,
                    "position_m": i * (2 * radius + gap),
                    "velocity_m_per_s": velocity if i == 0 else 0.0}
                   for i, mass in enumerate(masses)],
        "contacts": [{"name": f"C{i + 1}", "between": [f"B{i + 1}", f"B{i + 2}"],
                      "stiffness": stiffnesses[i], "restitution": restitutions[i],
                      "exponent": exponent} for i in range(pairs)],
        "solver": SHARP, "end_time_s": end, "output": {"ledger_only": True}}


def ball_and_wall(mass: float, stiffness: float, restitution: float, end: float, *,
                  velocity: float = 0.0, position: float = 0.0, side: str = "LEFT",
                  loads: Sequence[dict[str, Any]] = (), **contact: Any) -> dict[str, Any]:
    """A point of mass beside a wall at 0."""
    return {
        "bodies": [{"name": "ball", "mass_kg": mass, "position_m": position,
                    "velocity_m_per_s": velocity}],
        "contacts": [{"name": "wall", "between": ["ball"], "wall": {"side": side},
                      "stiffness": stiffness, "restitution": restitution, **contact}],
        "loads": [{"body": "ball", **load} for load in loads],
        "solver": SHARP, "end_time_s": end, "output": {"ledger_only": True}}


def _each(value: float | Sequence[float], count: int) -> list[float]:
    return list(value) if isinstance(value, (list, tuple)) else [float(value)] * count  # type: ignore
