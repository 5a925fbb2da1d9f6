"""What the axes and metrics of a sweep are in words with their units, as contactctl and the dashboard
have them."""

from __future__ import annotations

from typing import Callable

from contact.v1 import job_pb2, scenario_pb2
from google.protobuf.descriptor import Descriptor, FieldDescriptor

from .figures.words import WORDS
from .units import ENDINGS, series_metric, stated_unit, steps_of

_BEFORE = {"final_bodies": "final", "groups": "group"}  # Of metrics from these lists.


def axis_label(sweep: scenario_pb2.Sweep, axis: int) -> str:
    """The label of an axis; without one what it varies, such as `velocity of B1 [m/s]`, or its path if
    the contract does not know that."""
    varied = sweep.axes[axis]

    def owner(name: str, entry: str) -> str:
        return _owner(sweep.base, name, entry)
    return (varied.label or _label(steps_of(varied.field), scenario_pb2.Scenario.DESCRIPTOR, "", owner)
            or varied.field)


def metric_label(metric: str) -> str:
    """A metric, such as `final velocity of B3 [m/s]`, or its path if the contract does not know
    that."""
    series = series_metric(metric)
    if series is not None:
        word, quantity, whose, unit = series
        of = f" of {whose}" if whose else ""
        return f"{WORDS['picks'][word]} {quantity.replace('_', ' ')}{of} [{unit}]"
    steps = steps_of(metric)
    before = _BEFORE.get(steps[0][0], "") if steps else ""
    own = steps[1:] if steps and steps[0][0] == "summary" else steps

    def owner(name: str, entry: str) -> str:
        return f"{name}[{entry}]" if entry.isdigit() else entry
    found = (_label(own, type_, before, owner)
             for type_ in (job_pb2.RunSummary.DESCRIPTOR, job_pb2.Job.DESCRIPTOR))
    return next(filter(None, found), metric)


def _label(steps: list[tuple[str, str]], type_: Descriptor, before: str,
           owner: Callable[[str, str], str]) -> str:
    """`before`, what the path says without its entries, and whose it is: `wall position of ball-wall
    [m]`; empty if the contract has no such field."""
    field: FieldDescriptor | None = None
    message: Descriptor | None = type_
    for name, _ in steps:
        field = message.fields_by_name.get(name) if message else None
        if field is None:
            return ""
        message = field.message_type
    if field is None:
        return ""
    name, unit = _quantity(field)
    words = [before, *(step for step, entry in steps[:-1] if not entry), name]
    label = " ".join(filter(None, words)).replace("_", " ")
    whose = " of ".join(owner(step, entry) for step, entry in reversed(steps) if entry)
    # Restitution goes in and out, but not out of a contact.
    link = ", " if label.endswith((" in", " out")) else " of "
    return label + (link + whose if whose else "") + (f" [{unit}]" if unit else "")


def _quantity(field: FieldDescriptor) -> tuple[str, str]:
    """The name of a field without its unit, and the unit; empty for whole numbers and words."""
    name: str = field.name
    if field.cpp_type != FieldDescriptor.CPPTYPE_DOUBLE:
        return name, ""
    if stated_unit(field):
        return name, stated_unit(field)
    ending, unit = next(((e, u) for e, u in ENDINGS if name.endswith(e)), ("", "1"))
    return name[:len(name) - len(ending)], unit


def _owner(base: scenario_pb2.Scenario, name: str, entry: str) -> str:
    """Whose the entry of a scenario's list is."""
    if entry == "*":
        return f"all {name}"
    if not entry.isdigit():
        return entry
    place = int(entry)
    if name == "bodies" and place < len(base.bodies):
        return str(base.bodies[place].name)
    if name == "contacts" and place < len(base.contacts):
        contact = base.contacts[place]
        return str(contact.name) or "-".join(contact.between) + "-wall" * contact.HasField("wall")
    on = f" on {base.loads[place].body}" if name == "loads" and place < len(base.loads) else ""
    return f"{name}[{entry}]{on}"
