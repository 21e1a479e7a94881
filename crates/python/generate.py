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
from collections.abc import Sequence
from pathlib import Path
from typing import Any

FOLDER = Path(__file__).parent / "python" / "meshwright"


def use_built_library() -> None:
    """Makes a package from the sources beside this file and the library that cargo built."""
    folder = Path(__file__).resolve().parents[2] / "target"
    found = [path for path in folder.glob("*/*meshwright_core.*") if path.suffix in (".so", ".dylib", ".dll")]
    found.sort(key=lambda path: path.stat().st_mtime, reverse=True)
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

from meshwright._names import (  # noqa: E402
    EXPECTATIONS,
    SELECTIONS,
    TOKEN,  # noqa: F401
    callable_name,
    code_in_python,
    in_python,
    others,
    python_name,
    selections,
    snake,
    variants,
)
from meshwright._ron import definition, name_of, operations, options, resolve  # noqa: E402


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
    if isinstance(value, str):
        return f'``"{value}"``'
    return f"``{value}``" if isinstance(value, bool | int | float) else None


def sentence(text: str) -> str:
    """A paragraph on one line, with its values written as in Python."""
    return code_in_python(" ".join(text.split()), "``")


def wrapped(text: str, indent: str, more: str = "") -> list[str]:
    width = 120 - len(indent)
    parts = textwrap.wrap(text, width, subsequent_indent=more, break_long_words=False, break_on_hyphens=False)
    return [indent + line for line in parts]


def block(text: str, indent: str) -> list[str]:
    """The lines of a paragraph, of a list, or of a table, which becomes a list."""
    rows = [line.strip() for line in text.splitlines()]
    if rows[0].startswith("|"):
        cells = [[cell.strip() for cell in row.strip("|").split("|")] for row in rows[2:]]
        items = [f"{method_word(first)}: {'; '.join(rest)}." for first, *rest in cells]
    elif rows[0].startswith("- "):
        items = [sentence(item) for item in re.split(r"(?:^|\n)\s*- ", text)[1:]]
    else:
        return wrapped(sentence(text), indent)
    return [line for item in items for line in wrapped(f"- {item}", indent, "  ")]


def method_word(cell: str) -> str:
    """The first cell of a row of a table: a variant, if it names one."""
    name = cell.strip("`")
    known = name in others() and cell.startswith("`")
    return f"``choice.{name}``" if known else sentence(cell)


def variant_lines(schema: Any, indent: str) -> list[str]:
    """A line for each variant of a parameter, except for selections, of which there are many."""
    lines = []
    for option in options(schema):
        name, text = name_of(option), sentence(option.get("description", "")).partition(". ")[0].rstrip(".")
        if name is None or not text:
            continue
        code = f'"{name}"' if "const" in option else f"choice.{name}(..)"
        lines += wrapped(f"``{code}``: {text}.", indent, "    ")
    return lines


def field_lines(schema: Any, indent: str) -> list[str]:
    """A line for each key of a parameter that is a mapping or a list of mappings."""
    each = [part for option in options(schema) for part in (options(option["items"]) if option.get("items") else [option])]
    lines = []
    for option in each:
        for name, inner in option.get("properties", {}).items() if name_of(option) is None else ():
            text = sentence(inner.get("description") or resolve(inner).get("description") or "")
            lines += wrapped(f'``"{name}"``: {text}', indent, "    ")
    return lines


def takes_selection(schema: Any) -> bool:
    """Whether a parameter is a selection of elements or a region."""
    alternatives = [schema, *schema.get("anyOf", [])]
    return any(part.get("$ref", "").rsplit("/", 1)[-1] in SELECTIONS for part in alternatives)


def docstring(
    text: str, fields: list[tuple[str, Any]], indent: str, example: str = "", more: Sequence[str] = ()
) -> list[str]:
    """The lines of a docstring: the text, an example, the parameters, and the lines `more` after the parameters."""
    first, *paragraphs = filter(str.strip, text.split("\n\n"))
    lines = block('"""' + first, indent)
    for paragraph in paragraphs:
        lines += ["", *block(paragraph, indent)]
    lines += ["", *wrapped(example, indent)] if example else []
    lines += [""] if fields or more else []
    for name, schema in fields:
        text = sentence(schema.get("description") or resolve(schema).get("description") or "")
        value = default(schema)
        is_known = value is None or "Defaults to" in text or "If omitted" in text
        note = "" if is_known else f" Defaults to {value}."
        where = ""
        if takes_selection(schema):
            known = dict.fromkeys(option["const"] for option in options(schema) if "const" in option)
            where = " " + ", ".join([*(f'``"{name}"``' for name in known), "or a value of ``meshwright.sel``."])
        lines += wrapped(f":param {python_name(name)}: {text}{note}{where}", indent, "    ")
        if not where:
            lines += variant_lines(schema, indent + "    ") or field_lines(schema, indent + "    ")
    for line in more:
        lines += wrapped(line, indent, "    ")
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
    # A method of a mesh runs its step immediately, so it cannot take a recipe parameter, which has no value yet.
    extra = ["Ron"] if of_mesh else ["Arg", "Ron"]
    head, tail = ["self"], []
    for n in [*required, *optional]:
        kinds = list(dict.fromkeys([*split_union(kind(properties[n])), *extra]))
        if of_mesh and (name, n) in OTHERS:
            kinds.insert(0, '"Mesh"')
        if n == "path":
            kinds.insert(1, "os.PathLike[str]")
        if n in required:
            head.append(f"{python_name(n)}: {' | '.join(kinds)}")
        else:
            tail.append(f"{python_name(n)}: {' | '.join([*kinds, 'None'])} = None")
    takes_on = not of_mesh and entry["takes_on"]
    tail += ["on: str | Sequence[str] | None = None"] if takes_on else []
    tail += ["id: str | None = None", "progress: bool | Progress | None = None"]
    lines = [f"    def {snake(name)}("]
    lines += [f"        {part}," for part in [*head, "*", *tail]]
    lines.append("    ) -> Self:")
    text = schema.get("description") or entry["summary"] + "."
    fields = [(n, properties[n]) for n in [*required, *optional]]
    fields = [(n, in_working_directory(s, of_mesh)) if n == "path" else (n, s) for n, s in fields]
    if of_mesh:
        fields = [(n, {**s, "description": OTHERS[name, n]} if (name, n) in OTHERS else s) for n, s in fields]
    more = [":param on: The objects that the step acts on. If omitted, all that it supports."] if takes_on else []
    more.append(":param id: The id of the step, which seeds its random choices. Defaults to the name of the operation.")
    shown = ":param progress: Called with the step, the task, the number of finished parts and the total number of parts; or `True` for a bar of tqdm."
    more.append(shown if of_mesh else f"{shown} For a recipe, see :meth:`Recipe.run`.")
    if of_mesh:
        more.append(f":returns: The new mesh. This mesh does not change. {RESULTS.get(name, '')}".rstrip())
    called = in_python(entry["example"]) or ""
    for other in (f'{python_name(n)}="scan"' for operation, n in OTHERS if of_mesh and operation == name):
        called = called.replace(other, f"{other.split('=')[0]}=scan")
    example = f"Example: ``mesh.{called}``" if of_mesh else f"Example: ``scene.{called}``, in a recipe ``{entry['example']}``"
    lines += [literal(line) for line in docstring(text, fields, " " * 8, example, more)]
    given = ", ".join(f"{n!r}: {python_name(n)}" for n in properties)
    lines.append(f"        return self._apply({name!r}, {{{given}}}, {'on' if takes_on else 'None'}, id, progress)")
    lines.append("")
    return lines


def in_working_directory(schema: Any, of_mesh: bool) -> Any:
    """The schema of a path. Outside a recipe, a relative path is relative to the working directory."""
    text = " ".join(schema.get("description", "").split())
    found = RELATIVE.search(text)
    if not found:
        return schema
    # A recipe also replaces parameters in the path.
    outside = "a relative path is relative to the working directory"
    if of_mesh:
        return {**schema, "description": f"{text[: found.start()]}{outside[0].upper()}{outside[1:]}."}
    return {**schema, "description": text.replace(found[0], f"For a scene, {outside}; in a recipe, to {found[1]}.")}


def split_union(text: str) -> list[str]:
    parts, depth, start = [], 0, 0
    for i, c in enumerate(text):
        depth += (c == "[") - (c == "]")
        if depth == 0 and text.startswith(" | ", i):
            parts.append(text[start:i])
            start = i + 3
    return [*parts, text[start:]]


#: Parameters that name another object. A method of a mesh takes a mesh instead of the name, with this description.
OTHERS = {
    ("Transfer", "from"): "The mesh with the attributes.",
    ("Project", "onto"): "The mesh with the surface.",
}

#: What recipes say about a relative path.
RELATIVE = re.compile(r"(?:The|A relative) path is relative to (the output folder|the folder of the recipe)\.")

TAGGED = [("Vertices", "vertex"), ("Edges", "edge"), ("Faces", "face")]
#: Where a method of a mesh leaves its result.
RESULTS = {
    "Measure": 'Its ``attributes["mean_curvature"]``, or the attribute of the given name, is an array of the values.',
    "Unwrap": 'Its ``attributes["uv"]`` has the coordinates of the corners, and ``corners`` has their vertices.',
    "VertexNormals": 'Its ``attributes["normal"]`` has the normals.',
    **{f"Tag{d}": f"Its ``tag(\"{w}\", name)`` is an array of Booleans." for d, w in TAGGED},
}

HEADER = '''"""{doc}

Generated from the schema of the operations by `generate.py`: do not edit.
"""

from __future__ import annotations

{imports}from collections.abc import Mapping, Sequence
from typing import {typing}

from numpy.typing import NDArray

{own}from ._ron import Arg, Choice, Ron
'''


def operations_file() -> str:
    lines = [HEADER.format(doc="Every operation as a method.", typing="TYPE_CHECKING, Any, Literal, Self", imports="import os\n", own="from ._progress import Progress\n")]
    lines += ["if TYPE_CHECKING:", "    from ._mesh import Mesh", ""]
    for of_mesh in (False, True):
        doc = "The operations on one mesh." if of_mesh else "The operations on a scene, and the steps of a recipe."
        lines += ["", f"class {'MeshOperations' if of_mesh else 'SceneOperations'}:", f'    """{doc}"""', ""]
        lines += ["    def _apply(", "        self,", "        operation: str,", "        fields: Mapping[str, Any],"]
        lines += ["        on: str | Sequence[str] | None,", "        id: str | None,", "        progress: bool | Progress | None,"]
        lines += ["    ) -> Self:", "        raise NotImplementedError", ""]
        for name, entry in operations().items():
            if entry["takes_on"] or not of_mesh:
                lines += method(name, entry, of_mesh)
    return "\n".join(lines).rstrip() + "\n"


def function(name: str, alternatives: list[Any]) -> list[str]:
    """A function that makes a variant, or a constant for a variant without parameters."""
    doc = " ".join(dict.fromkeys(a.get("description", "") for a in alternatives)).strip()
    if all("const" in a for a in alternatives):
        return [f"{name} = Choice({name!r})", *wrapped(f'"""{literal(sentence(doc))}"""', ""), ""]
    inner = [resolve(a["properties"][name]) for a in alternatives if "properties" in a]
    structs = [i for i in inner if i.get("type") == "object" and "properties" in i]
    head: list[str]
    fields: list[tuple[str, Any]] = []
    if structs:
        merged: dict[str, list[Any]] = {}
        for i in structs:
            for n, s in i["properties"].items():
                merged.setdefault(n, []).append(s)
        # In another parameter, the variant of the same name has one value without a name.
        plain = [i for i in inner if i not in structs]
        needed = {n for n in merged if not plain and all(n in i.get("required", []) for i in structs)}
        order = [n for n in merged if n in needed] + [n for n in merged if n not in needed]
        head = ["*"]
        if plain:
            kinds = list(dict.fromkeys(k for i in plain for k in split_union(kind(i))))
            head = [f"value: {' | '.join(dict.fromkeys([*kinds, 'Arg', 'Ron']))} | None = None", "/", "*"]
        for n in order:
            kinds = list(dict.fromkeys(k for s in merged[n] for k in split_union(kind(s))))
            ending = "" if n in needed else " | None = None"
            head.append(f"{python_name(n)}: {' | '.join(dict.fromkeys([*kinds, 'Arg', 'Ron']))}{ending}")
            fields.append((n, merged[n][0]))
        first = ["*(() if value is None else (value,))"] if plain else []
        call = ", ".join([repr(name), *first, *(f"{python_name(n)}={python_name(n)}" for n in order)])
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
    text = f"{first.rstrip('.') or name}.\n\n{rest}"
    lines += [literal(line) for line in docstring(text, fields, "    ")]
    return [*lines, f"    return Choice({call})", ""]


def is_vector(schema: Any) -> bool:
    return schema.get("description", "").startswith("A point or a direction")


def variants_file(doc: str, found: dict[str, list[Any]]) -> str:
    lines = [HEADER.format(doc=doc, typing="Any, Literal", imports="", own=""), ""]
    for name, alternatives in sorted(found.items()):
        made = function(name, alternatives)
        lines += [*([""] if made[0].startswith("def") else []), *made, *([""] if made[0].startswith("def") else [])]
    return "\n".join(lines).rstrip() + "\n"


def files() -> dict[str, str]:
    """The contents of the generated files."""
    return {
        "_operations.py": operations_file(),
        "sel.py": variants_file("Selections of vertices, edges and faces, and regions of space.", selections()),
        "choice.py": variants_file("Values of parameters that have parameters themselves.", others()),
        "expect.py": variants_file("Expectations of recipes.", variants(EXPECTATIONS)),
    }


if __name__ == "__main__":
    for name, text in files().items():
        (FOLDER / name).write_text(text)
        print(f"wrote {FOLDER / name}", file=sys.stderr)
