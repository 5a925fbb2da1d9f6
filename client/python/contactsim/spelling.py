"""What a user may have meant, for the end of a message."""

from __future__ import annotations

import difflib
from typing import Any, Iterable

_FEW = 15  # Words that are listed; of more only how many there are.


def nearest(word: str, words: Iterable[str]) -> str:
    """The nearest word, if one is near."""
    found = difflib.get_close_matches(word, list(words), 1)
    return f" — did you mean '{found[0]}'?" if found else ""


def expected(word: str, words: Iterable[str]) -> str:
    """The words near to one that is none of `words`, else these words."""
    words = list(words)
    near = difflib.get_close_matches(word, words, 3)
    if near:
        return "; did you mean " + " or ".join(map(repr, near)) + "?"
    more = f", … ({len(words)} in all)" if len(words) > _FEW else ""
    return f"; there are {', '.join(words[:_FEW])}{more}" if words else "; there are none"


def shown(value: Any) -> str:
    """A value and its type, for who gave another type than is expected."""
    text = repr(value)
    return f"{type(value).__name__} {text if len(text) <= 40 else text[:37] + '...'}"
