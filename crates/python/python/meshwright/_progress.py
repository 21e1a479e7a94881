"""Progress of long computations."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

#: Called with the step, the task, the number of finished parts and the total number of parts. An exception cancels the
#: computation.
Progress = Callable[[str, str, int, int], object]


@contextmanager
def callback(progress: bool | Progress | None) -> Iterator[Progress | None]:
    """A context manager that returns the callable for progress reports. This is the given callable, or `None`, or a
    callable that moves a bar of tqdm if `progress` is `True`."""
    if progress is None or progress is False:
        yield None
        return
    if progress is not True:
        yield progress
        return
    try:
        from tqdm.auto import tqdm
    except ImportError as error:
        raise ImportError("progress=True needs tqdm: pip install tqdm; or pass a callable") from error
    with tqdm(total=1.0, bar_format="{desc} {percentage:3.0f}%|{bar}| {elapsed}") as bar:

        def show(step: str, task: str, done: int, total: int) -> None:
            bar.set_description_str(" ".join(dict.fromkeys(part for part in (step, task) if part)), refresh=False)
            bar.n = done / max(total, 1)
            bar.refresh()

        yield show


def numbers(values: dict[str, Any]) -> list[tuple[str, str]]:
    """Converts the values of recipe parameters to text, in the form that the command line accepts."""

    def text(value: Any) -> str:
        if isinstance(value, bool):
            return "true" if value else "false"
        if isinstance(value, tuple | list) or hasattr(value, "tolist"):
            parts = value.tolist() if hasattr(value, "tolist") else value
            return f"({', '.join(text(v) for v in parts)})" if isinstance(parts, list | tuple) else text(parts)
        return str(value)

    return [(name, text(value)) for name, value in values.items()]
