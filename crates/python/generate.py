"""Writes the Python sources that follow from the schema of the operations: `_operations.py`, `sel.py`, `choice.py` and
`expect.py`. Run it after the operations or their documentation have changed; a test compares the files with its output.

    cargo build -p meshwright-python && python crates/python/generate.py

It needs NumPy. It uses the library that cargo built, not an installed package.
"""

from __future__ import annotations

import importlib.machinery
import importlib.util
import keyword
import re
import sys
import textwrap
import types
from pathlib import Path
from typing import Any

FOLDER = Path(__file__).parent / "python" / "meshwright"


def use_built_library() -> None:
    """Makes a package of the sources beside this file and of the library that cargo built."""
    folder = Path(__file__).resolve().parents[2] / "target" / "debug"
    found = [path for path in folder.glob("*meshwright_core.*") if path.suffix in (".so", ".dylib", ".dll")]
    if not found:
        sys.exit("the library is missing: run cargo build -p meshwright-python")
    name = "meshwright._core"
    loader = importlib.machinery.ExtensionFileLoader(name, str(found[0]))
    spec = importlib.util.spec_from_file_location(name, found[0], loader=loader)
    assert spec
    package = types.ModuleType("meshwright")
    package.__path__ = [str(FOLDER)]
    sys.modules["meshwright"] = package
    sys.modules[name] = importlib.util.module_from_spec(spec)
    loader.exec_module(sys.modules[name])


if __name__ == "__main__":
    use_built_library()

from meshwright._ron import definition, name_of, operations, options, resolve  # noqa: E402

SELECTIONS = ["VertexSelection", "EdgeSelection", "FaceSelection", "Region", "Elements"]
WIDTH = 100


def snake(name: str) -> str:
    return re.sub(r"(?<=[a-z0-9])(?=[A-Z])|(?<=[A-Z])(?=[A-Z][a-z])", "_", name).lower()


def python_name(name: str) -> str:
    return name + "_" if keyword.iskeyword(name) else name


def kind(schema: Any, depth: int = 0) -> str:
    """The Python type of a value."""
    found: list[str] = []
    words: list[str] = []
    for option in options(schema):
        named = name_of(option)
        types = option.get("type")
        for single in types if isinstance(types, list) else [types]:
            if "const" in option and single == "string":
                words.append(repr(option["const"]))
            elif "enum" in option and single == "string":
                words += [repr(word) for word in option["enum"]]
            elif named:
                found.append("Choice")
            elif single == "string":
                found.append("str")
            elif single == "boolean":
                found.append("bool")
            elif single == "integer":
                found.append("int")
            elif single == "number":
                found.append("float")
            elif single == "array":
                if "prefixItems" in option:
                    inner = {kind(part, depth + 1) for part in option["prefixItems"]}
                    found.append(f"Sequence[{' | '.join(sorted(inner))}]")
                elif option.get("items"):
                    found.append(f"Sequence[{kind(option['items'], depth + 1)}]")
                else:
                    found.append("Sequence[Any]")
            elif single == "object":
                found.append("Mapping[str, Any]")
            elif single != "null":
                found.append("Any")
    if words:
        found.insert(0, f"Literal[{', '.join(dict.fromkeys(words))}]")
    if any(f.startswith("Sequence[") for f in found):
        found.append("NDArray[Any]")
    found = list(dict.fromkeys(found))
    if "Any" in found or not found:
        return "Any"
    return " | ".join(found)


def default(schema: Any) -> str | None:
    if "default" not in schema or schema["default"] is None:
        return None
    value = schema["default"]
    if isinstance(value, str | bool | int | float):
        return str(value)
    return None


def sentence(text: str) -> str:
    return " ".join(text.replace("`", "``").split())


def wrapped(text: str, indent: str, more: str = "") -> list[str]:
    width = 120 - len(indent)
    return [indent + line for line in textwrap.wrap(text, width, subsequent_indent=more, break_long_words=False)]


def docstring(first: str, rest: str, fields: list[tuple[str, Any]], indent: str) -> list[str]:
    lines = wrapped(f'"""{first}', indent)
    for paragraph in rest.split("\n\n"):
        text = sentence(paragraph)
        if text and text.rstrip(".") != first.rstrip("."):
            lines += ["", *wrapped(sentence(paragraph), indent)]
    if fields:
        lines.append("")
    for name, schema in fields:
        text = sentence(schema.get("description") or resolve(schema).get("description") or "")
        value = default(schema)
        note = f" Defaults to {value}." if value is not None and "Defaults to" not in text else ""
        lines += wrapped(f":param {python_name(name)}: {text}{note}", indent, "    ")
    if len(lines) == 1 and len(lines[0]) < 117:
        return [lines[0] + '"""']
    return [*lines, indent + '"""']


def literal(text: str) -> str:
    return text.replace("\\", "\\\\")


def method(name: str, entry: Any, of_mesh: bool) -> list[str]:
    schema = definition(name)
    properties = schema.get("properties", {})
    required = [n for n in properties if n in schema.get("required", [])]
    optional = [n for n in properties if n not in required]
    head = ["self"]
    for n in required:
        ordered = list(dict.fromkeys([*split_union(kind(properties[n])), "Arg", "Ron"]))
        if of_mesh and is_other(name, n):
            ordered.insert(0, '"Mesh"')
        if n == "path":
            ordered.insert(1, "os.PathLike[str]")
        head.append(f"{python_name(n)}: {' | '.join(ordered)}")
    tail = []
    for n in optional:
        ordered = list(dict.fromkeys([*split_union(kind(properties[n])), "Arg", "Ron"]))
        if of_mesh and is_other(name, n):
            ordered.insert(0, '"Mesh"')
        tail.append(f"{python_name(n)}: {' | '.join([*ordered, 'None'])} = None")
    if not of_mesh and entry["takes_on"]:
        tail.append("on: str | Sequence[str] | None = None")
    tail.append("id: str | None = None")
    lines = [f"    def {snake(name)}("]
    lines += [f"        {part}," for part in [*head, "*", *tail]]
    lines.append("    ) -> Self:")
    first = entry["summary"] + "."
    rest = schema.get("description", "") + f"\n\nIn a recipe: `{entry['example']}`"
    lines += [literal(line) for line in docstring(first, rest, list(properties.items()), " " * 8)]
    given = ", ".join(f"{n!r}: {python_name(n)}" for n in properties)
    on = "on" if not of_mesh and entry["takes_on"] else "None"
    lines.append(f"        return self._apply({name!r}, {{{given}}}, {on}, id)")
    lines.append("")
    return lines


def split_union(text: str) -> list[str]:
    parts, depth, start = [], 0, 0
    for i, c in enumerate(text):
        depth += (c == "[") - (c == "]")
        if depth == 0 and text.startswith(" | ", i):
            parts.append(text[start:i])
            start = i + 3
    return [*parts, text[start:]]


def is_other(operation: str, parameter: str) -> bool:
    """Whether a parameter names another object, for which a method of a mesh takes a mesh."""
    return (operation, parameter) in OTHERS


OTHERS = {("Transfer", "from"), ("Project", "onto")}

HEADER = '''"""{doc}

Generated from the schema of the operations by `generate.py`: do not edit.
"""

from __future__ import annotations

{imports}from collections.abc import Mapping, Sequence
from typing import {typing}

from numpy.typing import NDArray

from ._ron import Arg, Choice, Ron
'''


def operations_file() -> str:
    lines = [HEADER.format(doc="Every operation as a method.", typing="TYPE_CHECKING, Any, Literal, Self", imports="import os\n")]
    lines += ["if TYPE_CHECKING:", "    from ._mesh import Mesh", ""]
    for of_mesh in (False, True):
        doc = "The operations on one mesh." if of_mesh else "The operations on a scene, and the steps of a recipe."
        lines += ["", f"class {'MeshOperations' if of_mesh else 'SceneOperations'}:", f'    """{doc}"""', ""]
        lines += ["    def _apply(", "        self, operation: str, fields: Mapping[str, Any], on: str | Sequence[str] | None, id: str | None"]
        lines += ["    ) -> Self:", "        raise NotImplementedError", ""]
        for name, entry in operations().items():
            if entry["takes_on"] or not of_mesh:
                lines += method(name, entry, of_mesh)
    return "\n".join(lines).rstrip() + "\n"


def variants(names: list[str]) -> dict[str, list[Any]]:
    """The variants with parameters of these types, by name."""
    found: dict[str, list[Any]] = {}
    for name in names:
        for option in options(definition(name)):
            variant = name_of(option)
            if variant:
                found.setdefault(variant, []).append(option)
    return found


def function(name: str, alternatives: list[Any]) -> list[str]:
    """A function that makes a variant, or a constant for a variant without parameters."""
    doc = " ".join(dict.fromkeys(sentence(a.get("description", "")) for a in alternatives)).strip()
    if all("const" in a for a in alternatives):
        return [f"{name} = Choice({name!r})", *wrapped(f'"""{literal(doc)}"""', ""), ""]
    inner = [resolve(a["properties"][name]) for a in alternatives if "properties" in a]
    structs = [i for i in inner if i.get("type") == "object" and "properties" in i]
    head: list[str]
    fields: list[tuple[str, Any]] = []
    if structs:
        merged: dict[str, list[Any]] = {}
        for i in structs:
            for n, s in i["properties"].items():
                merged.setdefault(n, []).append(s)
        needed = {n for n in merged if all(n in i.get("required", []) for i in structs)}
        order = [n for n in merged if n in needed] + [n for n in merged if n not in needed]
        head = ["*"]
        for n in order:
            kinds = list(dict.fromkeys(k for s in merged[n] for k in split_union(kind(s))))
            ending = "" if n in needed else " | None = None"
            head.append(f"{python_name(n)}: {' | '.join(dict.fromkeys([*kinds, 'Arg', 'Ron']))}{ending}")
            fields.append((n, merged[n][0]))
        call = ", ".join([repr(name), *(f"{python_name(n)}={python_name(n)}" for n in order)])
    elif inner and all("prefixItems" in i for i in inner) and not is_vector(inner[0]):
        parts = inner[0]["prefixItems"]
        head = [f"{'abcd'[i]}: {kind(part)} | Arg" for i, part in enumerate(parts)] + ["/"]
        call = ", ".join([repr(name), *"abcd"[: len(parts)]])
    else:
        kinds = list(dict.fromkeys(k for i in inner for k in split_union(kind(i))))
        head = [f"value: {' | '.join(dict.fromkeys([*kinds, 'Arg', 'Ron']))}", "/"]
        call = f"{name!r}, value"
    lines = [f"def {name}({', '.join(head)}) -> Choice:"]
    if len(lines[0]) > 118:
        lines = [f"def {name}(", *(f"    {part}," for part in head), ") -> Choice:"]
    first, _, rest = doc.partition(". ")
    lines += [literal(line) for line in docstring((first.rstrip(".") or name) + ".", rest, fields, "    ")]
    return [*lines, f"    return Choice({call})", ""]


def is_vector(schema: Any) -> bool:
    return schema.get("description", "").startswith("A point or a direction")


def variants_file(doc: str, found: dict[str, list[Any]]) -> str:
    lines = [HEADER.format(doc=doc, typing="Any, Literal", imports=""), ""]
    for name, alternatives in sorted(found.items()):
        made = function(name, alternatives)
        lines += [*([""] if made[0].startswith("def") else []), *made, *([""] if made[0].startswith("def") else [])]
    return "\n".join(lines).rstrip() + "\n"


def files() -> dict[str, str]:
    """The contents of the generated files."""
    import meshwright._ron as ron

    selections = variants(SELECTIONS)
    expectations = variants(["Expectation", "OtherMesh", "Group"])
    skipped = {*SELECTIONS, "Expectation", "OtherMesh", "Group", "Step", "Param", "OnLoss", "Refusal", *operations()}
    others = variants([name for name in ron.root()["$defs"] if name not in skipped])
    others = {n: a for n, a in others.items() if not all("const" in option for option in a)}
    return {
        "_operations.py": operations_file(),
        "sel.py": variants_file("Selections of vertices, edges and faces, and regions of space.", selections),
        "choice.py": variants_file("Values of parameters that have parameters themselves.", others),
        "expect.py": variants_file("Expectations of recipes.", expectations),
    }


if __name__ == "__main__":
    for name, text in files().items():
        (FOLDER / name).write_text(text)
        print(f"wrote {FOLDER / name}", file=sys.stderr)
