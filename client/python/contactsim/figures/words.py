"""words.json: titles, prefixes, colours and dashes that contactsim and the dashboard share."""

from __future__ import annotations

import json
import pathlib
from typing import Any

WORDS: dict[str, Any] = json.loads(pathlib.Path(__file__).with_name("words.json").read_text("utf-8"))
