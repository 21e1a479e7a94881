"""The JSON schema of recipes: operations, types, and the alternatives of a value."""

from __future__ import annotations

import json
from collections.abc import Mapping
from functools import cache
from typing import Any

from . import _core

Schema = Mapping[str, Any]


@cache
def root() -> dict[str, Any]:
    """The JSON schema of recipes."""
    schema: dict[str, Any] = json.loads(_core.schema())
    return schema


@cache
def operations() -> dict[str, dict[str, Any]]:
    """All operations by their names."""
    return {entry["name"]: entry for entry in json.loads(_core.operations())}


def definition(name: str) -> Schema:
    """The schema of an operation or of another type of recipes."""
    found: Schema = root()["$defs"][name]
    return found


def resolve(schema: Schema) -> Schema:
    """Returns the schema that a reference names. A schema that is not a reference is returned unchanged."""
    while "$ref" in schema:
        schema = definition(schema["$ref"].rsplit("/", 1)[1])
    return schema


def options(schema: Schema) -> list[Schema]:
    """Returns the alternatives of a schema, without ``null``. If the schema has no alternatives, returns only the
    schema."""
    schema = resolve(schema)
    for key in ("oneOf", "anyOf"):
        if key in schema:
            return [option for part in schema[key] for option in options(part)]
    return [] if schema.get("type") == "null" else [schema]


def name_of(option: Schema) -> str | None:
    """Returns the name of the variant that an alternative describes, or `None` if it does not describe a variant."""
    if "const" in option:
        return str(option["const"])
    required = option.get("required", [])
    properties = option.get("properties", {})
    if option.get("type") == "object" and len(required) == 1 == len(properties):
        name = str(required[0])
        return name if name[:1].isupper() else None
    return None


def words(schema: Schema) -> set[str]:
    """Returns the words that this schema allows as values. Recipes write these words without quotes."""
    found: set[str] = set()
    for option in options(schema):
        if isinstance(option.get("const"), str):
            found.add(option["const"])
        found.update(word for word in option.get("enum", []) if isinstance(word, str))
    return found


def takes_text(schema: Schema) -> bool:
    """Whether a value of this schema can be any text."""
    plain = [o for o in options(schema) if "const" not in o and "enum" not in o]
    kinds = [o.get("type") for o in plain]
    return any(k == "string" or isinstance(k, list) and "string" in k for k in kinds)
