"""What a scenario says about its contacts and bodies, as far as plots need it."""

from __future__ import annotations

import dataclasses
import math
from typing import Any, Sequence

import numpy as np
import numpy.typing as npt
from contact.v1 import field_rules_pb2, scenario_pb2
from google.protobuf.json_format import MessageToDict

Array = npt.NDArray[np.float64]

# Of δ in the damping force, where it is not that of the spring.
_DAMPING_EXPONENTS = {scenario_pb2.Contact.KELVIN_VOIGT: 0.0, scenario_pb2.Contact.DASHPOT: 0.0,
                      scenario_pb2.Contact.HERTZ_QUARTER_POWER: 0.25}


@dataclasses.dataclass(frozen=True)
class ContactLaw:
    """One contact after neighbours are expanded."""

    name: str
    bodies: tuple[str, ...]
    stiffness: float  #: N/m^exponent
    exponent: float
    damping_exponent: float  #: Of δ in the damping force.
    tabled: bool  #: The force is a table; stiffness and exponent are those of a line to its last point.
    wall_touch: float | None  #: Centre of the body when it touches a wall that stands still, in m.


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
    bodies = {body.name: body for body in scenario.bodies}
    laws = []
    for contact in scenario.contacts:
        tabled = contact.damping == scenario_pb2.Contact.FORCE_TABLE
        exponent = contact.exponent if contact.HasField("exponent") else 1.0 if tabled else 1.5
        damping = _DAMPING_EXPONENTS.get(contact.damping, exponent)
        for name, pair in zip(contact_names(contact), contact_pairs(contact)):
            touching = [bodies[body] for body in pair]
            laws.append(ContactLaw(name, pair, _stiffness(contact, touching), exponent, damping,
                                   tabled, _wall_touch(contact, touching[0], name)))
    return laws


def _stiffness(contact: scenario_pb2.Contact, bodies: Sequence[scenario_pb2.Body]) -> float:
    """As given, of a table the line to its last point, or that of Hertz, which follows from materials and radii."""
    if contact.HasField("stiffness"):
        given: float = contact.stiffness
        return given
    if contact.damping == scenario_pb2.Contact.FORCE_TABLE:
        table = contact.force_table
        line: float = table.forces_n[-1] / table.deformations_m[-1]
        return line
    compliance = _compliance(contact.wall.material) if contact.HasField("wall") else 0.0
    compliance = sum((_compliance(body.material) for body in bodies), compliance)
    curvature = sum(1 / body.radius_m for body in bodies)
    return 4.0 / 3 / (compliance * math.sqrt(curvature))


def _compliance(material: scenario_pb2.Material) -> float:
    """(1−ν²)/E."""
    ratio = material.poisson_ratio
    value: float = (1 - ratio) * (1 + ratio) / material.youngs_modulus_pa
    return value


def _wall_touch(contact: scenario_pb2.Contact, body: scenario_pb2.Body,
                name: str) -> float | None:
    if not contact.HasField("wall") or contact.wall.HasField("motion"):
        return None
    if contact.HasField("clearance_m"):
        side = -1.0 if name.endswith("-left") else 1.0
        middle: float = contact.wall.position_m
        return middle + side * contact.clearance_m
    radius = -body.radius_m if contact.wall.side == scenario_pb2.Wall.LEFT else body.radius_m
    touch: float = contact.wall.position_m - radius
    return touch


def solver_in_full(scenario: scenario_pb2.Scenario) -> dict[str, Any]:
    """Options of the solver with the defaults of those that are not set."""
    given = MessageToDict(scenario.solver, preserving_proto_field_name=True,
                          including_default_value_fields=False)
    fixed = given.get("method") == "RK4" or "step_s" in given
    unused = "relative_tolerance" if fixed else "step_s"
    options: dict[str, Any] = {"method": "RK4" if fixed else "ADAPTIVE"}
    for field in scenario_pb2.Solver.DESCRIPTOR.fields:
        rule = field.GetOptions().Extensions[field_rules_pb2.rule]
        default = rule.default_name or (rule.default_number if rule.HasField("default_number")
                                        else None)
        value = given.get(field.name, default)
        if value is not None and field.name != unused:
            options.setdefault(field.name, value)
    return options
