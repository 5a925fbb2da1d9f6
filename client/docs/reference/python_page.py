"""The page of contactsim, made from its docstrings and signatures."""

from __future__ import annotations

import inspect
import re
from typing import Any

import contactsim

from contract import escaped


def page() -> str:
    """All that contactsim exports."""
    names = [name for name in contactsim.__all__ if name != "__version__"]
    lines = ["# Python", "", "`import contactsim`; the guide is in the tutorials.", ""]
    for name in names:
        lines += element(name, getattr(contactsim, name))
    return "\n".join(lines)


def element(name: str, thing: Any) -> list[str]:
    """A class with its public members, a function, or a constant."""
    if inspect.isclass(thing):
        lines = [f"## {name}", "", text(thing), ""]
        for member, value in vars(thing).items():
            if not member.startswith("_") and (callable(value) or is_property(value)):
                lines += entry(f"{name}.{member}", value)
        return lines
    if callable(thing):
        return ["## " + name, "", *entry(name, thing)[2:]]
    return [f"## {name}", "", f"`{thing!r}`", ""]


def is_property(value: Any) -> bool:
    return isinstance(value, property) or hasattr(value, "func")


def entry(name: str, thing: Any) -> list[str]:
    """A function, method or property."""
    function = inspect.unwrap(getattr(thing, "fget", None) or getattr(thing, "func", thing))
    signature = "" if is_property(thing) else signature_of(function)
    return [f"### {name}", "", "```text", f"{name}{signature}", "```", "", text(function), ""]


def signature_of(function: Any) -> str:
    """The parameters, without `self`; a line each if they are long."""
    try:
        signature = inspect.signature(function)
    except (TypeError, ValueError):
        return "(…)"
    parameters = [p for p in signature.parameters.values() if p.name != "self"]
    whole = unquoted(str(signature.replace(parameters=parameters)))
    if len(whole) < 70:
        return whole
    bare = inspect.Signature(return_annotation=signature.return_annotation)
    lines = [unquoted(str(parameter)) for parameter in parameters]
    first = next((place for place, parameter in enumerate(parameters)
                  if parameter.kind is parameter.KEYWORD_ONLY), None)
    if first is not None and not any(p.kind is p.VAR_POSITIONAL for p in parameters):
        lines.insert(first, "*")
    return "(\n    " + ",\n    ".join(lines) + unquoted(str(bare)).replace("(", "\n", 1)


def unquoted(text_: str) -> str:
    """A signature whose annotations, which are texts, have lost their quotes."""
    return re.sub(r"(: |-> )'([^']*)'", r"\1\2", text_)


def text(thing: Any) -> str:
    """The docstring."""
    return escaped(inspect.getdoc(thing) or "")
