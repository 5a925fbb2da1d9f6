"""What a scenario says about its contacts and bodies, as far as plots need it."""

from __future__ import annotations

import dataclasses
import math

import numpy as np
import numpy.typing as npt
from contact.v1 import scenario_pb2

Array = npt.NDArray[np.float64]

_STANDARD_GRAVITY = 9.80665  # m/s²


@dataclasses.dataclass(frozen=True)
class ContactLaw:
    """One contact after neighbours are expanded."""

    name: str
    bodies: tuple[str, ...]
    stiffness: float  #: N/m^exponent
    exponent: float


def contact_pairs(contact: scenario_pb2.Contact) -> list[tuple[str, ...]]:
    """The bodies of each contact that an entry makes."""
    between = list(contact.between)
    if contact.HasField("clearance_m"):
        return [tuple(between)] * 2
    return list(zip(between, between[1:])) or [tuple(between)]


def contact_names(contact: scenario_pb2.Contact) -> list[str]:
    """The names that the server gives to the contacts of an entry."""
    pairs = contact_pairs(contact)
    if contact.HasField("clearance_m"):
        name = contact.name or "-".join([*contact.between, "wall"][:2])
        return [f"{name}-left", f"{name}-right"]
    if not contact.name:
        return ["-".join(bodies if len(bodies) > 1 else [*bodies, "wall"]) for bodies in pairs]
    if len(pairs) == 1:
        return [contact.name]
    return [f"{contact.name}-{number}" for number in range(1, len(pairs) + 1)]


def contact_laws(scenario: scenario_pb2.Scenario) -> list[ContactLaw]:
    """The contacts with the names that the server gives them."""
    laws = []
    for contact in scenario.contacts:
        exponent = contact.exponent if contact.HasField("exponent") else 1.5
        laws += [ContactLaw(name, bodies, contact.stiffness, exponent)
                 for name, bodies in zip(contact_names(contact), contact_pairs(contact))]
    return laws


def wall_touches(scenario: scenario_pb2.Scenario) -> list[float]:
    """Positions of a body's centre, in m, at which it touches its wall, if that stands still."""
    radii = {body.name: body.radius_m for body in scenario.bodies}
    touches = []
    for c in scenario.contacts:
        if not c.HasField("wall") or c.wall.HasField("motion"):
            continue
        wall = c.wall.position_m
        if c.HasField("clearance_m"):
            touches += [wall - c.clearance_m, wall + c.clearance_m]
        else:
            right = c.wall.side == scenario_pb2.Wall.RIGHT
            touches.append(wall - radii[c.between[0]] * (1 if right else -1))
    return touches


def mass(body: scenario_pb2.Body) -> float:
    """In kg; 0 for a fixed body without one, and for one that moves as given."""
    if body.HasField("motion"):
        return 0.0
    if body.HasField("density_kg_per_m3"):
        return 4 / 3 * math.pi * body.radius_m**3 * body.density_kg_per_m3
    return body.mass_kg


def constant_loads(scenario: scenario_pb2.Scenario) -> list[tuple[str, float]]:
    """Body and force, in N, of each load that stays the same: gravity and constant ones."""
    forces = []
    for load in scenario.loads:
        kind = load.WhichOneof("kind")
        if kind == "constant":
            forces.append((load.body, load.constant.force_n))
        elif kind == "gravity":
            given = load.gravity.HasField("acceleration_m_per_s2")
            acceleration = load.gravity.acceleration_m_per_s2 if given else -_STANDARD_GRAVITY
            forces += [(body.name, mass(body) * acceleration) for body in scenario.bodies
                       if not (body.fixed or body.HasField("motion"))
                       and load.body in ("", body.name)]
    return forces


def mechanical_energy(scenario: scenario_pb2.Scenario,
                      arrays: dict[str, Array]) -> dict[str, Array]:
    """Kinetic energy, elastic energy of contacts and supports, that of constant loads, which is 0
    where positions are, and their sum, in J."""
    zero = np.zeros_like(arrays["time"])
    kinetic = sum((0.5 * mass(b) * arrays[f"{b.name}.velocity"]**2 for b in scenario.bodies), zero)
    contacts = sum((_elastic(law, arrays) for law in contact_laws(scenario)), zero)
    supports = sum((_spring(support, arrays) for support in scenario.supports), zero)
    parts = {"kinetic": kinetic, "contacts": contacts}
    if scenario.supports:
        parts["supports"] = supports
    loads = [-force * arrays[f"{body}.position"] for body, force in constant_loads(scenario)]
    if loads:
        parts["constant loads"] = sum(loads, zero)
    return {**parts, "sum": sum(parts.values(), zero)}


def _elastic(law: ContactLaw, arrays: dict[str, Array]) -> Array:
    """∫ k δⁿ dδ."""
    deformation = np.maximum(arrays[f"{law.name}.deformation"], 0)
    return law.stiffness * deformation**(law.exponent + 1) / (law.exponent + 1)


def _spring(support: scenario_pb2.Support, arrays: dict[str, Array]) -> Array:
    stretch = arrays[f"{support.body}.position"] - support.rest_position_m
    if support.other:
        stretch = stretch - arrays[f"{support.other}.position"]
    return 0.5 * support.stiffness_n_per_m * stretch**2
