"""Generates Python sources from the schema of the operations: `_operations.py`, `sel.py`, `choice.py` and `expect.py`.
Run this script after the operations or their documentation have changed. A test compares the files with the output of
the script.

    cargo build -p meshwright-python && python crates/python/generate.py

The script needs NumPy. It uses the library that cargo built, not an installed package.
"""

from __future__ import annotations

import importlib.machinery
import importlib.util
import re
import sys
import textwrap
import types
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any

FOLDER = Path(__file__).parent / "python" / "meshwright"


def use_built_library() -> None:
    """Makes the package `meshwright` from the sources in this repository and the library that cargo built."""
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
    code_in_python,
    in_python,
    module_of,
    others,
    owner,
    python_name,
    selections,
    snake,
    uses,
    variants,
    without_steps,
)
from meshwright._schema import definition, name_of, operations, options, resolve  # noqa: E402


def kind(schema: Any, depth: int = 0) -> str:
    """Returns the Python type of the values of a schema."""
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
    """Joins the lines of a paragraph, and writes the code in it as Python."""
    text = " ".join(text.split()).replace("Without `on`, the step", "Without `on`, a method of a scene")
    return code_in_python(without_steps(text), "``")


def described(schema: Any) -> str:
    """Returns the description of a parameter, or the description of its type if the parameter has none."""
    return str(schema.get("description") or resolve(schema).get("description") or "")


def sentences(text: str) -> list[str]:
    return re.split(r"(?<=[.:]) (?=[A-Z`])", " ".join(text.split()))


def for_mesh(text: str) -> str:
    """Rewrites a text for a method of a mesh: sentences about recipes and about the other objects of a scene are
    removed."""
    for other, own in (
        ("the folder of the recipe", "the working directory"),
        ("another object", "another mesh"),
        ("the object `", "the mesh `"),
    ):
        text = text.replace(other, own)
    paragraphs = []
    for paragraph in text.split("\n\n"):
        kept = [part for part in sentences(paragraph) if not re.search(r"Without `on`|\brecipe\b", part)]
        if len(kept) == len(sentences(paragraph)):
            paragraphs.append(paragraph)
        elif kept:
            paragraphs.append(" ".join(kept))
    return "\n\n".join(paragraphs)


#: The beginning of the description of a parameter that names another object.
OBJECT = "The name of the object "


def names_object(schema: Any) -> bool:
    """Whether a parameter names another object. A method of a mesh takes a mesh in place of the name."""
    return str(schema.get("description", "")).startswith(OBJECT)


def wrapped(text: str, indent: str, more: str = "") -> list[str]:
    width = 120 - len(indent)
    parts = textwrap.wrap(text, width, subsequent_indent=more, break_long_words=False, break_on_hyphens=False)
    return [indent + line for line in parts]


def block(text: str, indent: str) -> list[str]:
    """Returns the lines of a paragraph, a list or a table. A table is converted to a list."""
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
    """Converts the first cell of a row of a table. If the cell names a variant, returns the Python name of the
    variant."""
    name = cell.strip("`")
    known = name in others() and cell.startswith("`")
    return f"``choice.{name}``" if known else sentence(cell)


def variant_lines(schema: Any, indent: str) -> list[str]:
    """Returns a list item for each variant of a parameter. The caller does not list selections, because there are too
    many."""
    lines = []
    for option in options(schema):
        name, text = name_of(option), sentence(option.get("description", "")).partition(". ")[0].rstrip(".")
        if name is None or not text:
            continue
        code = f'"{name}"' if "const" in option else f"{module_of(option)}.{name}(..)"
        lines += wrapped(f"``{code}``: {text}.", indent, "    ")
    return lines


def field_lines(schema: Any, indent: str) -> list[str]:
    """Returns a list item for each key of a parameter that is a mapping or a list of mappings."""
    each = [part for option in options(schema) for part in (options(option["items"]) if option.get("items") else [option])]
    lines = []
    for option in each:
        for name, inner in option.get("properties", {}).items() if name_of(option) is None else ():
            text = sentence(described(inner))
            lines += wrapped(f'``"{name}"``: {text}', indent, "    ")
    return lines


def takes_selection(schema: Any) -> bool:
    """Whether a parameter is a selection of elements or a region."""
    alternatives = [schema, *schema.get("anyOf", [])]
    return any(part.get("$ref", "").rsplit("/", 1)[-1] in SELECTIONS for part in alternatives)


def docstring(
    text: str, fields: list[tuple[str, Any]], indent: str, example: str = "", more: Sequence[str] = ()
) -> list[str]:
    """Returns the lines of a docstring: the text, an example, the parameters, and then the lines `more`."""
    first, *paragraphs = filter(str.strip, text.split("\n\n"))
    lines = block('"""' + first, indent)
    for paragraph in paragraphs:
        lines += ["", *block(paragraph, indent)]
    lines += ["", *wrapped(example, indent)] if example else []
    lines += [""] if fields or more else []
    for name, schema in fields:
        text = sentence(described(schema))
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
        if of_mesh and names_object(properties[n]):
            kinds.insert(0, "Mesh")
        if n == "path":
            kinds.insert(1, "os.PathLike[str]")
        if n == "color_by":
            kinds[:0] = ["str", "Choice"]
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
    fields = [(n, {**s, "description": COLOR_BY}) if n == "color_by" else (n, s) for n, s in fields]
    if of_mesh:
        text = for_mesh(text)
        fields = [(n, {**s, "description": for_mesh(described(s)).replace(OBJECT, "The mesh ")}) for n, s in fields]
    more = [":param on: The names of the objects on which the operation acts. If omitted, the operation acts on all objects that it supports."] if takes_on else []
    more.append(":param id, progress: See :class:`Mesh`." if of_mesh else ":param id, progress: See :meth:`Scene.apply`.")
    if name == "Save":
        more.append(":warns meshwright.LossWarning: If the format cannot store some of the data. The text lists what is lost.")
    if of_mesh:
        result = "The same mesh." if "path" in properties else "The new mesh. This mesh does not change."
        more.append(f":returns: {result} {RESULTS.get(name, '')}".rstrip())
    called = in_python(entry["example"]) or ""
    for other in (f'{python_name(n)}="scan"' for n in properties if of_mesh and names_object(properties[n])):
        called = called.replace(other, f"{other.split('=')[0]}=scan")
    example = f"Example: ``mesh.{called}``" if of_mesh else f"Example: ``scene.{called}``, in a recipe ``{entry['example']}``"
    lines += [literal(line) for line in docstring(text, fields, " " * 8, example, more)]
    given = ", ".join(f"{n!r}: {python_name(n)}" for n in properties)
    lines.append(f"        return self._apply({name!r}, {{{given}}}, {'on' if takes_on else 'None'}, id, progress)")
    lines.append("")
    return lines


def in_working_directory(schema: Any, of_mesh: bool) -> Any:
    """Returns the schema of a path with a description for Python: outside a recipe, a relative path is relative to the
    working directory."""
    text = " ".join(schema.get("description", "").split())
    found = RELATIVE.search(text)
    if not found:
        return schema
    # The next sentences say that parameters in the path are replaced. Only recipes do this, so a method of a mesh drops
    # the sentences.
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


#: The description of the parameter `color_by` for Python, where it can have shorter values than in recipes.
QUANTITIES = ", ".join(f'`"{option["const"]}"`' for option in options(definition("Quantity")) if "const" in option)
COLOR_BY = (
    f"What the colors of the surface show: a quantity ({QUANTITIES}, or a value of `meshwright.choice`), the name of an "
    "attribute, or a mapping with more details."
)
#: Matches the sentence about relative paths in the documentation of operations.
RELATIVE = re.compile(r"(?:The|A relative) path is relative to (the output folder|the folder of the recipe)\.")

TAGGED = [("Vertices", "vertex"), ("Edges", "edge"), ("Faces", "face")]
#: How to read the result of a method of a mesh.
RESULTS = {
    "Measure": 'Its ``attributes["mean_curvature"]``, or the attribute of the given name, is an array of the values.',
    "Unwrap": 'Its ``attributes["uv"]`` has the coordinates of the corners, and ``corners`` has their vertices.',
    "VertexNormals": 'Its ``attributes["normal"]`` has the normals.',
    **{f"Tag{d}": f"Its ``tag(\"{w}\", name)`` is an array of Booleans." for d, w in TAGGED},
}

#: Additional sentences in the descriptions of selections for Python.
MORE = {
    "Where": 'For the 10 % of the vertices with the highest values: ``sel.Where(attribute="curvature", '
    'above=numpy.quantile(m.attributes["curvature"], 0.9))``.',
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
    """Returns the source of a function that makes a variant, or of a constant if the variant has no parameters."""
    if all("const" in a for a in alternatives):
        made = docstring(meaning(alternatives), [], "")
        return [f"{name} = Choice({name!r})", *(literal(line) for line in made), ""]
    inner = [resolve(a["properties"][name]) for a in alternatives if "properties" in a]
    structs = [i for i in inner if i.get("type") == "object" and "properties" in i]
    head: list[str]
    fields: list[tuple[str, Any]] = []
    if structs:
        merged: dict[str, list[Any]] = {}
        for i in structs:
            for n, s in i["properties"].items():
                merged.setdefault(n, []).append(s)
        # Other parameters can have a variant with the same name that takes one value without a name.
        plain = [i for i in inner if i not in structs]
        needed = {n for n in merged if not plain and all(n in i.get("required", []) for i in structs)}
        order = [n for n in merged if n in needed] + [n for n in merged if n not in needed]
        head = ["*"]
        if plain:
            head = [f"value: {union([*map(kind, plain), 'Arg', 'Ron', 'None'])} = None", "/", "*"]
        for n in order:
            kinds = ["Mesh"] if names_object(merged[n][0]) else []
            kinds += [*map(kind, merged[n]), "Arg", "Ron", *([] if n in needed else ["None"])]
            head.append(f"{python_name(n)}: {union(kinds)}{'' if n in needed else ' = None'}")
            fields.append((n, combined(merged[n])))
        first = ["*(() if value is None else (value,))"] if plain else []
        call = ", ".join([repr(name), *first, *(f"{python_name(n)}={python_name(n)}" for n in order)])
    elif inner and all("prefixItems" in i for i in inner) and not is_vector(inner[0]):
        parts = inner[0]["prefixItems"]
        head = [f"{'abcd'[i]}: {kind(part)} | Arg" for i, part in enumerate(parts)] + ["/"]
        call = ", ".join([repr(name), *"abcd"[: len(parts)]])
    else:
        is_object = any(BY_NAME in a.get("description", "") for a in alternatives)
        kinds = ["Mesh"] if is_object else []
        head = [f"value: {union([*kinds, *map(kind, inner), 'Arg', 'Ron'])}", "/"]
        fields = [("value", {"description": "The mesh. " + OR_NAME})] if is_object else []
        call = f"{name!r}, value"
    lines = [f"def {name}({', '.join(head)}) -> Choice:"]
    if len(lines[0]) > 118:
        lines = [f"def {name}(", *(f"    {part}," for part in head), ") -> Choice:"]
    lines += [literal(line) for line in docstring(meaning(alternatives), fields, "    ", MORE.get(name, ""))]
    return [*lines, f"    return Choice({call})", ""]


#: This phrase in the description of a selection says that the selection takes the name of an object.
BY_NAME = ", given by its name"
OR_NAME = "For a scene or a recipe, the name of its object."
#: The elements that each type of selection can select.
ELEMENTS = {"VertexSelection": "vertices", "EdgeSelection": "edges", "FaceSelection": "faces"}


def meaning(alternatives: list[Any]) -> str:
    """Returns the description of a variant. If several types have a variant of this name, and the descriptions differ,
    returns a list with the description for each type."""
    texts: dict[str, list[Any]] = {}
    for option in alternatives:
        text = outside_recipes(option.get("description", "")).replace(BY_NAME, "")
        text = text.replace("another mesh of the scene", "another mesh").replace("the mesh of another object", "another mesh")
        texts.setdefault(text, []).append(option)
    places = {text: places_of(found) for text, found in texts.items()}
    if len(texts) > 1 and len({of_elements(text) for text in texts}) == 1:
        texts = {of_elements(text): alternatives for text in texts}
    if len(texts) == 1:
        first, *rest = sentences(next(iter(texts)))
        where = places_of(alternatives)
        return "\n\n".join(filter(None, [first, " ".join(rest), where and f"For {where}."]))
    if not all(places.values()) and not any(owner(option) in ELEMENTS for option in alternatives):
        return " ".join(texts)
    has_forms = len({form(option) for option in alternatives if "properties" in option}) > 1
    # Sentences that all descriptions contain are written only once, after the list.
    parts = {text: sentences(text) for text in texts}
    common = [part for part in next(iter(parts.values())) if all(part in other for other in parts.values())]
    rows = []
    for text, found in texts.items():
        own = " ".join(part for part in parts[text] if part not in common)
        selected = [ELEMENTS[owner(option)] for option in found if owner(option) in ELEMENTS]
        where = f"In {places[text]}{form(found[0]) if has_forms else ''}"
        rows.append(f"- {f'As a selection of {selected[0]}' if selected else where}: {own}")
    head = "The meaning depends on what is selected." if any("As a" in row for row in rows) else "The meaning depends on the parameter."
    return "\n\n".join(filter(None, [head, "\n".join(rows), " ".join(common)]))


def form(option: Any) -> str:
    """Says how the value of a variant is written: as one value, or as parameters with names."""
    name = name_of(option)
    fields = resolve(option["properties"][name]).get("properties") if "properties" in option else None
    given = ", ".join(f"{python_name(field)}=.." for field in fields) if fields else "value"
    return f", as `{module_of(option)}.{name}({given})`" if "properties" in option else ""


def of_elements(text: str) -> str:
    """Replaces the words "vertices", "edges" and "faces" by "elements"."""
    return re.sub(r"\b(vertices|edges|faces)\b", "elements", text)


def places_of(alternatives: list[Any]) -> str:
    """Lists the parameters that take these variants. Selections are left out, because many parameters take them."""
    places = [f"`{place}`" for option in alternatives for place in uses().get(owner(option), [])]
    return " and ".join([", ".join(places[:-1]), places[-1]]) if len(places) > 1 else "".join(places)


def combined(schemas: list[Any]) -> Any:
    """Several variants of the same name can have the same parameter. Merges the schemas of this parameter."""
    text = described(schemas[0])
    if names_object(schemas[0]):
        text = f"{text.replace(OBJECT, 'The mesh ')} {OR_NAME}"
    if len({described(schema) for schema in schemas}) > 1:
        text = of_elements(text)
    return {**schemas[0], "description": outside_recipes(text)}


def outside_recipes(text: str) -> str:
    """Rewrites the sentence about relative paths, so that it describes recipes and Python."""
    python = "A relative path is relative to the working directory; in a recipe, to "
    return RELATIVE.sub(lambda found: f"{python}{found[1]}.", " ".join(text.split()))


def union(kinds: Iterable[str]) -> str:
    """Returns the union of Python types. All `Literal` types are merged into one."""
    parts = list(dict.fromkeys(part for kind in kinds for part in split_union(kind)))
    words = [part.removeprefix("Literal[").removesuffix("]") for part in parts if part.startswith("Literal[")]
    named = list(dict.fromkeys(word for part in words for word in part.split(", ")))
    others = [part for part in parts if not part.startswith("Literal[")]
    return " | ".join([*([f"Literal[{', '.join(named)}]"] if named else []), *others])


def is_vector(schema: Any) -> bool:
    return schema.get("description", "").startswith("A point or a direction")


def variants_file(doc: str, found: dict[str, list[Any]]) -> str:
    made = [line for name, alternatives in sorted(found.items()) for line in function(name, alternatives)]
    takes_mesh = any(": Mesh | " in line for line in made)
    typing = "TYPE_CHECKING, Any, Literal" if takes_mesh else "Any, Literal"
    lines = [HEADER.format(doc=doc, typing=typing, imports="", own="")]
    lines += ["if TYPE_CHECKING:", "    from ._mesh import Mesh", ""] if takes_mesh else []
    listed = textwrap.wrap(", ".join(f'"{name}"' for name in sorted(found)), 115)
    lines += ["", "__all__ = [", *(f"    {line}" for line in listed), "]", ""]
    lines += ["", "def __dir__() -> list[str]:", "    return __all__", "", ""]
    for name, alternatives in sorted(found.items()):
        made = function(name, alternatives)
        lines += [*([""] if made[0].startswith("def") else []), *made, *([""] if made[0].startswith("def") else [])]
    return "\n".join(lines).rstrip() + "\n"


def files() -> dict[str, str]:
    """Returns the contents of the generated files by file name."""
    return {
        "_operations.py": operations_file(),
        "sel.py": variants_file("Selections of the elements of a mesh, which are its vertices, edges and faces, and regions of space.", selections()),
        "choice.py": variants_file("Values of parameters that have parameters themselves.", others()),
        "expect.py": variants_file("Expectations of recipes.", variants(EXPECTATIONS)),
    }


if __name__ == "__main__":
    for name, text in files().items():
        (FOLDER / name).write_text(text)
        print(f"wrote {FOLDER / name}", file=sys.stderr)
