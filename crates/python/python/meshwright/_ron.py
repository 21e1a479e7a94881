"""Writes Python values as the text of recipes (RON). The schema of a parameter says how its value is written. If the
schema lists words, a Python string is written as a word, such as ``Area``. Otherwise, a Python string is written as a
text in quotes."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from ._names import call
from ._schema import Schema, definition, name_of, options, resolve, takes_text, words

#: The characters that are escaped in texts, and the short escapes. Characters without a short escape are escaped by
#: number.
ESCAPED = re.compile(r'["\\\x00-\x1f\x7f-\x9f]')
ESCAPES = {'"': '\\"', "\\": "\\\\", "\n": "\\n", "\r": "\\r", "\t": "\\t"}


class Choice:
    """A value with a name and parameters, such as ``Longest(count: 12)``. The functions of :mod:`meshwright.sel`,
    :mod:`meshwright.choice` and :mod:`meshwright.expect` return these values."""

    __slots__ = ("args", "fields", "name")

    def __init__(self, name: str, /, *args: Any, **fields: Any) -> None:
        self.name = name
        self.args = args
        self.fields = {k: v for k, v in fields.items() if v is not None}

    def __repr__(self) -> str:
        return write(self, {})

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Choice) and repr(self) == repr(other)

    def __hash__(self) -> int:
        return hash(repr(self))


class Ron(str):
    """A value that is written in RON. The text is copied into the recipe unchanged."""

    def __repr__(self) -> str:
        return f"Ron({super().__repr__()})"


@dataclass(frozen=True)
class Arg:
    """A reference to a parameter of a recipe. :func:`meshwright.arg` returns it."""

    name: str
    declaration: str = field(repr=False)


def quoted(text: str) -> str:
    """Writes a text in quotes. Quotes, backslashes and control characters are escaped."""

    def escape(found: re.Match[str]) -> str:
        return ESCAPES.get(found[0]) or f"\\u{{{ord(found[0]):x}}}"

    return '"' + ESCAPED.sub(escape, text) + '"'


def number(value: float) -> str:
    """Writes a number with enough digits to read the same number back."""
    if value != value or value in (float("inf"), float("-inf")):
        raise ValueError(f"{value} is not a finite number")
    text = repr(float(value))
    return text[:-2] if text.endswith(".0") and "e" not in text else text


def field_name(name: str) -> str:
    """Returns the name that a Python parameter has in recipes: ``from`` for ``from_``."""
    return name.removesuffix("_")


def struct(fields: Mapping[str, Any], schema: Schema) -> str:
    """Writes fields with their names: ``(levels: 2)``."""
    known = resolve(schema).get("properties", {})
    parts = []
    for python_name, value in fields.items():
        name = field_name(python_name)
        parts.append(f"{name}: {write(value, known.get(name, {}))}")
    return f"({', '.join(parts)})"


def write_choice(value: Choice, schema: Schema) -> str:
    """Writes a variant with its parameters."""
    found: Schema = {}
    for option in options(schema):
        if name_of(option) == value.name and "properties" in option:
            found = resolve(option["properties"][value.name])
    if not value.args and not value.fields:
        return f"{value.name}()" if "properties" in found else value.name
    if value.fields:
        return value.name + struct(value.fields, found)
    parts = found.get("prefixItems")
    if parts and len(parts) == len(value.args) > 1:
        inner = [write(a, part) for a, part in zip(value.args, parts, strict=True)]
    elif len(value.args) == 1:
        inner = [write(value.args[0], found)]
    else:
        inner = [write(a, {}) for a in value.args]
    return f"{value.name}({', '.join(inner)})"


def ids_of(schema: Schema) -> str | None:
    """Returns the name of the variant of this schema that takes a list of ids, such as ``Faces``. Returns `None` if
    there is no such variant."""
    for option in options(schema):
        name = name_of(option)
        if name and "properties" in option:
            items = resolve(option["properties"][name]).get("items", {})
            if resolve(items).get("type") == "integer":
                return name
    return None


def check_list(items: Sequence[Any], schema: Schema) -> None:
    """Raises `TypeError` if a mask is given in place of a list of ids, or a list of ids in place of a selection."""
    lists = [o for o in options(schema) if o.get("type") == "array"]
    takes_integers = any(resolve(o.get("items", {})).get("type") == "integer" for o in lists)
    selection = None if lists else ids_of(schema)
    if not takes_integers and selection is None:
        return
    if any(isinstance(item, bool | np.bool_) for item in items):
        ids = f"sel.{selection}(numpy.flatnonzero(mask))" if selection else "numpy.flatnonzero(mask)"
        tag = 'with_attribute("name", mask) and sel.Tagged("name")'
        raise TypeError(f"a list of ids cannot be a mask of Booleans: use {ids}, or {tag}")
    if selection:
        raise TypeError(f"a selection cannot be a plain list: use sel.{selection}(ids) for a list of ids")


def check_word(word: str, schema: Schema) -> None:
    """Raises `TypeError` if the word is the name of a variant that has parameters."""
    for option in options(schema):
        if name_of(option) == word and "properties" in option:
            raise TypeError(f'"{word}" has parameters of its own: write {call(option)} without quotes')


def write_list(items: Sequence[Any], schema: Schema) -> str:
    """Writes a list ``[a, b]``, or a tuple ``(a, b)`` if the schema has a fixed length."""
    for option in options(schema):
        parts = option.get("prefixItems")
        is_fixed = parts or option.get("minItems") is not None and option.get("minItems") == option.get("maxItems")
        if is_fixed:
            inner = [write(v, parts[i] if parts and i < len(parts) else option.get("items", {})) for i, v in enumerate(items)]
            return f"({', '.join(inner)})"
    check_list(items, schema)
    lists = [o for o in options(schema) if o.get("type") == "array"]
    each = lists[0].get("items", {}) if lists else {}
    inner = [write(v, each) for v in items]
    if not lists and isinstance(items, tuple):
        return f"({', '.join(inner)})"
    return f"[{', '.join(inner)}]"


def write(value: Any, schema: Schema) -> str:
    """Writes a value in the syntax of recipes."""
    if isinstance(value, Ron):
        return str.__str__(value)
    if isinstance(value, Arg):
        return f"arg({quoted(value.name)})"
    if isinstance(value, Choice):
        return write_choice(value, schema)
    if value is None:
        return "None"
    if isinstance(value, bool | np.bool_):
        return "true" if value else "false"
    if isinstance(value, int | np.integer):
        return str(int(value))
    if isinstance(value, float | np.floating):
        return number(float(value))
    if isinstance(value, str):
        if value in words(schema):
            return value
        if schema and not takes_text(schema):
            check_word(value, schema)
        if schema and not takes_text(schema) and options(schema) and words(schema) and value.isidentifier():
            return value
        return quoted(value)
    if hasattr(value, "__fspath__"):
        return quoted(value.__fspath__())
    if isinstance(value, np.ndarray):
        return write_list(value.tolist(), schema)
    if isinstance(value, Mapping):
        kinds = [o for o in options(schema) if "properties" in o and name_of(o) is None]
        if kinds:
            return struct(value, kinds[0])
        maps = [o for o in options(schema) if "additionalProperties" in o]
        each = maps[0]["additionalProperties"] if maps and isinstance(maps[0]["additionalProperties"], dict) else {}
        inner = [f"{quoted(str(k))}: {write(v, each)}" for k, v in value.items()]
        return "{" + ", ".join(inner) + "}"
    if isinstance(value, Sequence):
        return write_list(value, schema)
    raise TypeError(f"cannot write {type(value).__name__} in a recipe")


def color_by(value: Any) -> Any:
    """Converts the value of the parameter `color_by` to a mapping. A text that does not name a quantity is taken as the
    name of an attribute."""
    if value is None or isinstance(value, Ron | Arg):
        return value
    given = dict(value) if isinstance(value, Mapping) else {"of": value}
    of = given.get("of")
    if isinstance(of, str) and not isinstance(of, Ron) and of not in words(definition("Quantity")):
        given["of"] = Choice("Attribute", name=of)
    return given


def step(operation: str, fields: Mapping[str, Any]) -> str:
    """Writes a step: ``LoopSubdivide(levels: 2)``. Parameters that are ``None`` are omitted."""
    given = {name: value for name, value in fields.items() if value is not None}
    if "color_by" in given:
        given["color_by"] = color_by(given["color_by"])
    return operation + struct(given, definition(operation))


def arguments(value: Any) -> list[Arg]:
    """Returns the references to recipe parameters that a value contains."""
    if isinstance(value, Arg):
        return [value]
    if isinstance(value, Choice):
        return arguments([*value.args, *value.fields.values()])
    if isinstance(value, Mapping):
        return arguments(list(value.values()))
    if isinstance(value, list | tuple):
        return [a for v in value for a in arguments(v)]
    return []
