"""Converts names and values from the syntax of recipes to Python."""

from __future__ import annotations

import keyword
import re
from functools import cache
from typing import Any

from ._schema import Schema, definition, name_of, operations, options, resolve, root

SELECTIONS = ["VertexSelection", "EdgeSelection", "FaceSelection", "Region", "Elements"]
EXPECTATIONS = ["Expectation", "OtherMesh", "Group"]


def snake(name: str) -> str:
    return re.sub(r"(?<=[a-z0-9])(?=[A-Z])|(?<=[A-Z])(?=[A-Z][a-z])", "_", name).lower()


def python_name(name: str) -> str:
    return name + "_" if keyword.iskeyword(name) else name


#: A token of a value in a recipe: a text in quotes, a word, a number, or a punctuation mark.
TOKEN = re.compile(r'\s*("[^"]*"|[A-Za-z_]\w*|[-+]?[\d._]+(?:e[-+]?\d+)?|[()\[\]:,])')


def in_python(code: str) -> str | None:
    """Returns the Python expression for a value or a parameter of a recipe: ``sel.Sharp(above=30)`` for
    `Sharp(above: 30)`. Returns `None` if the text is neither."""
    tokens = TOKEN.findall(code)
    if "".join(tokens) != re.sub(r'\s+(?=(?:[^"]*"[^"]*")*[^"]*$)', "", code):
        return None
    try:
        if len(tokens) > 2 and tokens[1] == ":":
            value, rest = expression(tokens[2:])
            text = f"{python_name(tokens[0])}={value}"
        elif tokens in (["true"], ["false"]):
            text, rest = tokens[0].capitalize(), []
        elif len(tokens) == 1:
            text, rest = word(tokens[0]), []
        elif tokens[1] == "(":
            text, rest = expression(tokens)
        else:
            return None
    except (IndexError, KeyError):
        return None
    return None if rest else text


def code_in_python(text: str, quotes: str = "`") -> str:
    """Rewrites a text about recipes: converts the values between backquotes to Python."""
    return re.sub(r"`([^`]+)`", lambda code: f"{quotes}{in_python(code[1]) or code[1]}{quotes}", text)


def without_steps(text: str) -> str:
    """Rewrites a text about the steps of a recipe: replaces the word "step" by "operation"."""
    text = re.sub(r"\b([Aa]) step\b", r"\1n operation", text)
    before = "[Tt]he|[Tt]his|[Ii]n the same|[Ll]ater|earlier|refused|[Oo]ne|two|any"
    text = re.sub(rf"\b({before}) step(s?)\b", r"\1 operation\2", text)
    return re.sub(r"\bSteps\b", "Operations", text)


def call(option: Schema) -> str:
    """Returns the Python call for a variant with parameters, such as ``choice.Implicit(time=..)``. Each `..` stands for
    a required value."""
    name = str(name_of(option))
    inner = resolve(option["properties"][name])
    fields = [f"{python_name(field)}=.." for field in inner.get("required", [])]
    return f"{module_of(option)}.{name}({', '.join(fields) if 'properties' in inner else '..'})"


def module_of(option: Schema) -> str:
    """Returns the name of the Python module that contains a variant with parameters."""
    return "sel" if owner(option) in SELECTIONS else "expect" if owner(option) in EXPECTATIONS else "choice"


def word(name: str) -> str:
    """Returns the Python name of a single word. Only three kinds of words change: names of operations, keywords of
    Python, and names of variants with parameters that exist in only one module."""
    if name in operations():
        return f"{snake(name)}()"
    modules = [("sel", selections()), ("choice", others()), ("expect", variants(EXPECTATIONS))]
    known = [module for module, found in modules if all("const" not in option for option in found.get(name, [{"const": 0}]))]
    return f"{known[0]}.{name}" if len(known) == 1 else python_name(name)


def expression(tokens: list[str]) -> tuple[str, list[str]]:
    """Returns the Python expression for the value at the beginning of the tokens, and the tokens after this value."""
    first, rest = tokens[0], tokens[1:]
    if first in "([":
        parts, rest = arguments(rest)
        if first == "(" and all("=" in part for part in parts):
            fields = [part.split("=", 1) for part in parts]
            return "{" + ", ".join(f'"{name}": {value}' for name, value in fields) + "}", rest
        return (f"[{', '.join(parts)}]" if first == "[" else f"({', '.join(parts)})"), rest
    if not first[0].isalpha():
        return first, rest
    if first in ("true", "false"):
        return first.capitalize(), rest
    if rest[:1] != ["("]:
        return f'"{first}"', rest
    parts, rest = arguments(rest[1:])
    return f"{callable_name(first)}({', '.join(parts)})", rest


def arguments(tokens: list[str]) -> tuple[list[str], list[str]]:
    """Returns the Python expressions for the values before the closing bracket, and the tokens after the bracket."""
    parts = []
    while tokens[0] not in ")]":
        name = ""
        if len(tokens) > 1 and tokens[1] == ":":
            name, tokens = f"{python_name(tokens[0])}=", tokens[2:]
        value, tokens = expression(tokens)
        parts.append(name + value)
        tokens = tokens[1:] if tokens[0] == "," else tokens
    return parts, tokens[1:]


def callable_name(name: str) -> str:
    """The Python name of an operation or of a variant with parameters."""
    if name in operations():
        return snake(name)
    modules = [("sel", selections()), ("expect", variants(EXPECTATIONS)), ("choice", others())]
    return next(f"{module}.{name}" for module, known in [*modules, ("mw", {name: []})] if name in known)


def variants(names: list[str]) -> dict[str, list[Any]]:
    """Returns the variants of these types by name. Several types can have a variant of the same name."""
    found: dict[str, list[Any]] = {}
    for name in names:
        for option in options(definition(name)):
            variant = name_of(option)
            if variant:
                found.setdefault(variant, []).append(option)
    return found


@cache
def selections() -> dict[str, list[Any]]:
    """The variants of selections and regions."""
    return variants(SELECTIONS)


@cache
def others() -> dict[str, list[Any]]:
    """Returns the variants that the module `choice` contains: all variants with parameters, except selections and
    expectations."""
    skipped = {*SELECTIONS, *EXPECTATIONS, "Step", "Param", "OnLoss", "Refusal", *operations()}
    found = variants([name for name in root()["$defs"] if name not in skipped])
    return {n: a for n, a in found.items() if not all("const" in option for option in a)}


def owner(option: Schema) -> str:
    """The name of the type that has this variant."""
    return owners()[id(option)]


@cache
def owners() -> dict[int, str]:
    """Maps the schemas of variants, as their `id()`, to the names of the types that have these variants."""
    found = {}
    for name in root()["$defs"]:
        schema = definition(name)
        own = [part for part in [*schema.get("oneOf", []), *schema.get("anyOf", [])] if "$ref" not in part]
        found.update({id(option): name for part in own for option in options(part)})
    return found


@cache
def uses() -> dict[str, list[str]]:
    """Maps the name of each type to the Python calls that take a value of this type: `SmoothBy` to
    ``smooth(by=..)``."""
    found: dict[str, list[str]] = {}

    def visit(schema: Any, place: str) -> None:
        name = schema.get("$ref", "").rsplit("/", 1)[-1]
        if name == "Quantity":
            # A quantity can be given in place of the mapping, because the other keys of the mapping are optional.
            place = place.replace('{"of": ..}', "..")
        if name in SELECTIONS[:4]:
            return
        is_known = name in found
        if name and place not in found.setdefault(name, []):
            found[name].append(place)
        for option in [] if is_known else options(schema):
            variant = name_of(option) if "properties" in option else None
            inner = option["properties"][variant] if variant else option
            if "$ref" in inner:
                visit(inner, f"choice.{variant}(..)")
            for item in filter(None, [option.get("items"), *option.get("prefixItems", [])]):
                visit(item, place.replace("..", "[..]"))
            for field, value in resolve(inner).get("properties", {}).items():
                for part in value.get("anyOf", [value]):
                    named = f"choice.{variant}({python_name(field)}=..)"
                    visit(part, named if variant else place.replace("..", f'{{"{field}": ..}}'))

    for operation in operations():
        for field, schema in definition(operation).get("properties", {}).items():
            for part in schema.get("anyOf", [schema]):
                visit(part, f"{snake(operation)}({python_name(field)}=..)")
    return found
