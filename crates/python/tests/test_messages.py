"""Error messages use the names and values of Python."""

from typing import Any

import numpy as np
import pytest

import meshwright as mw
from meshwright import choice, sel


def test_a_mask_is_not_a_list_of_ids(ball: mw.Mesh) -> None:
    faces, vertices = np.arange(20) > 3, np.arange(12) > 3
    m = ball.with_attribute("high", faces, "face")
    wrong: list[Any] = [
        lambda: m.delete_faces(faces=sel.Faces(faces)),
        lambda: m.delete_faces(faces=sel.Not(sel.Faces(faces.tolist()))),
        lambda: m.delete_faces(faces=faces),  # type: ignore[arg-type]
        lambda: m.tag_vertices(vertices=sel.And([sel.Vertices(vertices)]), name="a"),
        lambda: m.select(sel.Faces(faces)),
        lambda: mw.recipe().delete_faces(faces=sel.Faces(faces)),
    ]
    for call in wrong:
        with pytest.raises(TypeError, match=r"flatnonzero\(mask\).*sel\.Tagged") as info:
            call()
        assert len(str(info.value)) < 160
    by_ids = m.delete_faces(faces=sel.Faces(np.flatnonzero(faces)))
    assert by_ids == m.delete_faces(faces=sel.Tagged("high"))


def test_a_list_of_ids_needs_its_selection(ball: mw.Mesh) -> None:
    with pytest.raises(TypeError, match=r"sel\.Faces\(ids\)"):
        ball.delete_faces(faces=[1, 2])  # type: ignore[arg-type]


def test_the_name_of_a_value_with_parameters(ball: mw.Mesh) -> None:
    for by, written in (
        ("Taubin", r"choice\.Taubin\(\)"),
        ("Implicit", r"choice\.Implicit\(time=\.\.\)"),
    ):
        with pytest.raises(TypeError, match=written):
            ball.smooth(by=by)  # type: ignore[arg-type]
    # Several modules have values of these names. The message names the module whose value fits the parameter.
    for by, written in (("Random", r"choice\.Random\(\)"), ("Attribute", r"choice\.Attribute\(name=\.\.\)")):
        with pytest.raises(TypeError, match=written):
            ball.displace(by=by, distance=1)  # type: ignore[arg-type]
    with pytest.raises(TypeError, match=r"sel\.Degree\(\.\.\)"):
        ball.delete_faces(faces="Degree")  # type: ignore[arg-type]


def test_errors_of_methods_are_written_in_python(ball: mw.Mesh) -> None:
    wrong: list[tuple[Any, str]] = [
        (lambda: ball.remesh(), "remesh() needs `length` or `curvature`; write, for example, `remesh(length=0.02)`"),
        (lambda: ball.delete_faces(faces=sel.Sharp(above=30)), "write `sel.FacesBeside(sel.Sharp(..))`"),
        (lambda: ball.smooth(choice.Taubin(factor=3)), "`factor` is 3, expected less than 1"),
        (lambda: ball.apply("Weld", distnce=1), "unknown field `distnce` in `weld()`; did you mean `distance`?"),
        (lambda: ball.delete_faces(faces=sel.Tagged("x")), "no earlier operation creates"),
        (lambda: ball.delete_faces(faces="lid"), "`help(meshwright.sel)` lists all selections, such as `sel.Tagged(..)`"),
        (lambda: ball.select("Sharp", "face"), "`sel.FacesBeside(sel.Sharp(..))`"),
    ]
    for call, message in wrong:
        with pytest.raises(mw.RecipeError) as info:
            call()
        assert message in str(info.value) and "step" not in str(info.value)
    with pytest.raises(mw.RecipeError, match="Remesh()"):
        mw.recipe().icosahedron().remesh().check()


def test_a_value_of_several_types_says_what_it_means_where() -> None:
    distance = choice.Distance.__doc__ or ""
    for place, form in (("extrude_faces(by=..)", "value"), ("move_vertices(by=..)", "value"), ("measure(of=..)", "to=.., signed=..")):
        assert f"- In ``{place}``, as ``choice.Distance({form})``:" in " ".join(distance.split())
    for module in (sel, choice):
        for name, value in vars(module).items():
            if callable(value) and name[:1].isupper() and getattr(value, "__module__", "") == module.__name__:
                first = (value.__doc__ or "").split("\n\n")[0]
                assert first.count(". ") == 0 and value.__doc__.count("The meaning depends") <= 1, name
