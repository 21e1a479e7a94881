"""The steps that made a scene or a mesh."""

from __future__ import annotations

from collections.abc import Sequence

from . import _core, _ron

#: The advice to users if no recipe can repeat a change.
SAVE = "Save the result as an .mws file and read this file: the recipe then starts with the file."


class History:
    """The steps that made a scene, from the first to the last. Each history refers to the history before its last step.
    The texts of all steps stay in memory, but not the meshes between the steps.

    If no recipe can repeat a change, the history contains only the reason.
    """

    __slots__ = ("_earlier", "_reason", "_step")

    def __init__(self, earlier: History | None = None, step: str = "", reason: str = "") -> None:
        self._earlier = earlier
        self._step = step
        self._reason = reason

    @property
    def is_empty(self) -> bool:
        """Whether the history is empty: it has no steps, and no reason why a recipe cannot repeat them."""
        return self._earlier is None and not self._reason

    def then(self, step: str) -> History:
        """Returns this history with one more step."""
        return self if self._reason else History(self, step)

    def lost(self, change: str, advice: str = SAVE) -> History:
        """Returns the history after a change that no recipe can make. `change` completes the message "no recipe can ..",
        for example with "repeat `edit()`". If the history already has such a change, the new change is not recorded."""
        if self._reason:
            return self
        step = self._step if len(self._step) <= 80 else f"{self._step[:77]}..."
        after = f" after the step `{step}`" if step else ""
        return History(reason=f"no recipe can {change}{after}. {advice}")

    def only(self, core: _core.Scene, names: Sequence[str]) -> History:
        """Returns the history of a scene that has only the named objects of the scene `core`."""
        if self._reason:
            return self
        if not core.only_is_delete(names):
            change = "make this part of a scene, because it lacks nodes, cameras or lights of the scene"
            return self.lost(change, 'Use methods of the scene, or read the file with placements="Bake".')
        others = [name for name in core.names() if name not in names]
        return self.then(_ron.step("Delete", {"objects": others})) if others else self

    def steps(self) -> tuple[str, ...]:
        """The steps. Raises `ValueError` if no recipe can repeat a change."""
        if self._reason:
            raise ValueError(self._reason)
        found, history = [], self
        while history._earlier is not None:
            found.append(history._step)
            history = history._earlier
        return tuple(reversed(found))
