"""One recipe on many files, on this machine or on a cluster."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal

from ._errors import Error
from ._progress import numbers
from ._recipe import Recipe
from ._scene import fsspec, is_address, write_bytes

#: Parts for each worker: the sizes of files vary, so a worker that is done early takes another part.
PARTS_PER_WORKER = 8


@dataclass(frozen=True)
class Row:
    """The result of one input file."""

    #: The input file.
    input: str
    #: ok, failed, or skipped after Ctrl-C.
    state: Literal["ok", "failed", "skipped"]
    #: The failed step.
    step: str | None
    #: The errors of the failed step.
    message: str | None
    #: The number of vertices at the end, or before the failed step.
    vertices: int | None
    #: The number of edges.
    edges: int | None
    #: The number of faces.
    faces: int | None
    #: The digest of the scene.
    digest: str | None
    #: What was lost.
    losses: list[str]
    #: The files that were written, with their sizes: ``{"path": "out/cow.glb", "bytes": 1200}``.
    outputs: list[dict[str, Any]]
    #: How long the run took.
    seconds: float


class Report(Sequence[Row]):
    """The report of a batch: a row for each input file, in the order of their paths. The same as the report of
    ``meshwright batch``."""

    def __init__(self, header: dict[str, Any], rows: list[Row]) -> None:
        #: The recipe, its digest, the parameters and the numbers of rows, as in the JSON report of the program.
        self.header = header
        self._rows = rows

    @property
    def failed(self) -> list[Row]:
        """The rows of the files that failed."""
        return [row for row in self if row.state == "failed"]

    def __getitem__(self, index: Any) -> Any:
        return self._rows[index]

    def __len__(self) -> int:
        return len(self._rows)

    def __iter__(self) -> Iterator[Row]:
        return iter(self._rows)

    def __repr__(self) -> str:
        counts = {state: sum(row.state == state for row in self) for state in ("ok", "failed", "skipped")}
        return f"Report({', '.join(f'{n} {state}' for state, n in counts.items() if n) or 'no files'})"


def batch(
    recipe: Recipe | str | os.PathLike[str],
    inputs: str | os.PathLike[str] | Sequence[str | os.PathLike[str]],
    *,
    engine: Any = "local",
    out: str | os.PathLike[str] = "out",
    values: Mapping[str, Any] | None = None,
    preset: str | None = None,
    param: str | None = None,
    folders: bool = False,
    retry_failed: bool = False,
    parts: int | None = None,
    report: str | os.PathLike[str] | None = None,
    budget: str | None = None,
    upload: str | None = None,
) -> Report:
    """Runs one recipe on many files, several at the same time.

    A batch that was interrupted, or whose workers were killed, continues when it is called again: a file is not processed
    again if the recipe, the parameters and every file that the run reads are unchanged. This is decided by their content.
    A file that fails is a row of the report, and does not stop the batch.

    :param recipe: The recipe, or the path of its file. It needs a parameter of type Path, which receives the input.
    :param inputs: Files, or patterns: ``*`` and ``?`` match within one folder, ``**`` any number of folders. Addresses such
        as ``s3://bucket/*.obj`` need fsspec, and are copied to the folder ``inputs`` in `out` first.
    :param engine: "local" uses the processors of this machine; "dask" starts a local cluster of Dask, and a client of Dask
        uses its cluster; "ray" uses Ray. The workers of a cluster need this package, and the same folders.
    :param out: The folder for outputs, and for the state of the batch.
    :param values: Values of the other parameters of the recipe.
    :param preset: The name of a preset of the recipe.
    :param param: The parameter that receives the input; needed if the recipe has several of type Path.
    :param folders: Whether the outputs of each input go to a folder of their own.
    :param retry_failed: Whether files that failed before are processed again.
    :param parts: The number of tasks on a cluster. Defaults to 8 for each worker. A batch continues only with the same
        number of parts.
    :param report: A file for the report: .json, .jsonl or .csv.
    :param budget: The memory budget for meshes of a process, such as "2GiB". Defaults to 8 GiB.
    :param upload: An address such as ``s3://bucket/clean``, to which outputs are copied at the end.
    """
    folder = Path(out).absolute()
    folder.mkdir(parents=True, exist_ok=True)
    given = [inputs] if isinstance(inputs, str | os.PathLike) else inputs
    addresses: dict[str, str] = {}
    listed = []
    for path in [os.fspath(path) for path in given]:
        if is_address(path):
            addresses.update(downloaded(path, Path(out) / "inputs"))
        else:
            listed.append(path)
    listed += addresses
    if not listed:
        return Report({}, [])
    arguments = [recipe_file(recipe, folder), "--inputs", *listed, "--out", os.fspath(out)]
    for name, value in numbers(dict(values or {})):
        arguments += ["--set", f"{name}={value}"]
    for option, text in (("--preset", preset), ("--param", param), ("--budget", budget)):
        arguments += [option, text] if text is not None else []
    arguments += ["--folders"] if folders else []
    arguments += ["--retry-failed"] if retry_failed else []

    with tempfile.TemporaryDirectory(dir=folder, prefix=".parts-") as temporary:
        merged = os.path.join(temporary, "all.json")
        if isinstance(engine, str) and engine == "local":
            run_part([*arguments, "--report", merged], os.getcwd())
        else:
            partial = run_parts(engine, arguments, temporary, parts)
            run_program(["batch", "--merge", *partial, "--report", merged], os.getcwd())
        text = Path(merged).read_text(encoding="utf-8")
        if report is not None:
            copy = os.path.join(temporary, f"report{Path(report).suffix}")
            run_program(["batch", "--merge", merged, "--report", copy], os.getcwd())
            shutil.copyfile(copy, report)
    header = json.loads(text)
    rows = [Row(**{**row, "input": addresses.get(row["input"], row["input"])}) for row in header.pop("rows")]
    if upload is not None:
        for row in rows:
            for output in row.outputs:
                file = Path(output["path"])
                name = file.absolute().relative_to(folder).as_posix()
                write_bytes(f"{upload.rstrip('/')}/{name}", file.read_bytes())
    return Report(header, rows)


def downloaded(pattern: str, folder: Path) -> dict[str, str]:
    """Copies the files of an address to a folder. Returns the address of each copy. A file that exists is replaced, which
    does not repeat its run: results belong to contents."""
    system, path = fsspec().core.url_to_fs(pattern)
    found = sorted(system.glob(path)) if any(c in path for c in "*?[") else [path]
    copies = {}
    for remote in found:
        address = system.unstrip_protocol(remote)
        copy = folder / address.partition("://")[2].lstrip("/")
        copy.parent.mkdir(parents=True, exist_ok=True)
        data = system.cat_file(remote)
        if not copy.is_file() or copy.read_bytes() != data:
            copy.write_bytes(data)
        copies[os.fspath(copy)] = address
    return copies


def recipe_file(recipe: Recipe | str | os.PathLike[str], folder: Path) -> str:
    """The path of the file of a recipe. A recipe that was built is written to the folder of outputs."""
    if not isinstance(recipe, Recipe):
        return os.fspath(recipe)
    path = Path(recipe.path)
    if path.is_file() and path.read_text(encoding="utf-8") == recipe.to_ron():
        return recipe.path
    written = folder / path.name
    if not written.is_file() or written.read_text(encoding="utf-8") != recipe.to_ron():
        written.write_text(recipe.to_ron(), encoding="utf-8")
    return os.fspath(written)


def run_parts(engine: Any, arguments: list[str], temporary: str, parts: int | None) -> list[str]:
    """Runs the parts of a batch on a cluster, and returns their reports."""
    here = os.getcwd()

    def tasks(workers: int) -> list[list[str]]:
        n = parts or PARTS_PER_WORKER * max(workers, 1)
        made = []
        for i in range(1, n + 1):
            file = os.path.join(temporary, f"{i}.json")
            made.append([*arguments, "--threads", "1", "--shard", f"{i}/{n}", "--report", file])
        return made

    if engine == "ray":
        ray = needed("ray")
        if not ray.is_initialized():
            ray.init()
        listed = tasks(int(ray.cluster_resources().get("CPU", 1)))
        remote = ray.remote(max_retries=3)(run_part)
        ray.get([remote.remote(task, here) for task in listed])
        return [task[-1] for task in listed]
    if engine == "dask":
        distributed = needed("distributed")
        with distributed.LocalCluster(threads_per_worker=1, dashboard_address=None) as cluster:
            with distributed.Client(cluster) as client:
                return run_parts(client, arguments, temporary, parts)
    if not hasattr(engine, "map") or not hasattr(engine, "gather"):
        raise ValueError(f'unknown engine {engine!r}: expected "local", "dask", "ray" or a client of Dask')
    listed = tasks(len(engine.scheduler_info()["workers"]))
    # Dask takes each part for new work, so that a second call looks at the files again.
    engine.gather(engine.map(run_part, listed, [here] * len(listed), pure=False, retries=3))
    return [task[-1] for task in listed]


def needed(name: str) -> Any:
    """Imports a package, or says how to install it."""
    import importlib

    try:
        return importlib.import_module(name)
    except ImportError as error:
        package = "'dask[distributed]'" if name == "distributed" else name
        raise ImportError(f"this engine needs {name}: pip install {package}") from error


def run_part(arguments: list[str], folder: str) -> str:
    """Runs a part of a batch in a process of its own, and returns the path of its report."""
    run_program(["batch", *arguments], folder)
    return arguments[-1]


def run_program(arguments: list[str], folder: str) -> None:
    """Runs the program in a process that ends with this one. The last argument is a new file that it writes."""
    process = subprocess.Popen(
        [sys.executable, "-m", "meshwright._task", *arguments],
        cwd=folder,
        stdin=subprocess.PIPE,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.PIPE,
        text=True,
    )
    assert process.stderr is not None
    try:
        errors = process.stderr.read()
        code = process.wait()
    except BaseException:
        process.kill()
        process.wait()
        raise
    finally:
        process.stderr.close()
        if process.stdin is not None:
            process.stdin.close()
    if code == 130:
        raise KeyboardInterrupt
    # The code is 1 also if some files fail. They are rows of the report.
    if code > 1 or code < 0 or not os.path.exists(os.path.join(folder, arguments[-1])):
        raise Error(errors.strip() or f"the batch ended with code {code}")
