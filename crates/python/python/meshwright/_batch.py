"""One recipe on many files, on this machine or on a cluster."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Literal

from . import _core
from ._progress import Progress, callback, numbers
from ._recipe import Recipe
from ._scene import fsspec, is_address, write_bytes
from .errors import Error

#: By default, a batch has this number of parts for each thread of the cluster. Files vary in size, so a thread that
#: finishes a part early runs another part.
PARTS_PER_THREAD = 8
#: The memory that a process takes in addition to its meshes, in bytes.
PROCESS_BYTES = 128 << 20


@dataclass(frozen=True)
class Row:
    """The result of one run of the recipe, with one input file, one parameter set, or both."""

    #: The path of the input file. Empty if the batch has no input files.
    input: str
    #: "ok", "failed", or "skipped" because of Ctrl-C.
    state: Literal["ok", "failed", "skipped"]
    #: The label of the step that failed.
    step: str | None
    #: The errors of the failed step.
    message: str | None
    #: The number of vertices at the end, or before the failed step.
    vertices: int | None
    #: The number of edges.
    edges: int | None
    #: The number of faces.
    faces: int | None
    #: The digest of the scene at the end.
    digest: str | None
    #: The data that were lost, for example because a file format cannot store them.
    losses: list[str]
    #: The files that were written, with their sizes: ``{"path": "out/cow.glb", "bytes": 1200}``.
    outputs: list[dict[str, Any]]
    #: How long the run took.
    seconds: float
    #: The number of the parameter set, counted from 1. The outputs of the set are in a folder with this number as its
    #: name.
    set: int | None = None
    #: The values of the parameter set, as strings.
    values: dict[str, str] = field(default_factory=dict)


class Report(Sequence[Row]):
    """The report of a batch: a row for each input file and parameter set, in the order of the paths and sets. The
    program ``meshwright batch`` writes the same report."""

    def __init__(self, header: dict[str, Any], rows: list[Row]) -> None:
        #: The recipe, its digest, the parameters and the numbers of rows, as in the JSON report of the program.
        self.header = header
        self._rows = rows

    @property
    def failed(self) -> list[Row]:
        """The rows of the runs that failed."""
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
    inputs: str | os.PathLike[str] | Sequence[str | os.PathLike[str]] = (),
    *,
    sets: Sequence[Mapping[str, Any]] | None = None,
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
    progress: bool | Progress | None = None,
) -> Report:
    """Runs one recipe on many files, with many parameter sets, or with both. Several runs take place at the same time.

    >>> mw.batch("clean.ron", "models/*.obj")                                     # doctest: +SKIP
    Report(12 ok, 1 failed)
    >>> report = mw.batch("part.ron", sets=[{"levels": 1}, {"levels": 2}])        # doctest: +SKIP
    >>> [(row.values["levels"], row.faces) for row in report]                     # doctest: +SKIP
    [('1', 80), ('2', 320)]

    If a batch was interrupted, or its workers were killed, call it again to continue. A file is not processed again if
    the recipe, the parameters and every file that the run reads are unchanged. Files are compared by their content. The
    second call can use another engine and another number of parts. If a file fails, its row of the report says why, and
    the batch continues.

    :param recipe: The recipe, or the path of its file. With `inputs`, the recipe needs a parameter of type Path, which
        receives the path of the input.
    :param inputs: Files, or patterns: ``*`` and ``?`` match characters of one name, and ``**`` matches any number of
        folders. Addresses such as ``s3://bucket/*.obj`` need fsspec, and are copied to the folder ``inputs`` in `out`
        first.
    :param sets: Parameter sets: ``[{"levels": 1}, {"levels": 2}]``. The recipe runs once for each set or, if there are
        inputs, once for each combination of a set and an input. The outputs of a set are in a folder in `out` that is
        named after the number of the set, from 1.
    :param engine: "local" uses the processors of this machine, "dask" starts a local cluster of Dask, and "ray" uses
        Ray. A client of Dask can also be given; the batch then runs on the cluster of the client. The workers of a
        cluster need this package, and access to the same folders. Each task states its estimated memory: to Ray as
        ``memory``, and to Dask as the resource ``MEMORY`` if workers have it.
    :param out: The folder for outputs, and for the state of the batch.
    :param values: Values of the other parameters of the recipe.
    :param preset: The name of a preset of the recipe.
    :param param: The parameter that receives the input; required if the recipe has several parameters of type Path.
    :param folders: Whether the outputs of each input go to a separate folder.
    :param retry_failed: Whether files that failed before are processed again.
    :param parts: The number of tasks on a cluster. Defaults to 8 for each thread of the workers.
    :param report: A file for the report: .json, .jsonl or .csv.
    :param budget: The memory budget for the meshes of each process, such as "2GiB". Defaults to 8 GiB.
    :param upload: An address such as ``s3://bucket/clean``, to which outputs are copied at the end.
    :param progress: A callable that receives ``"batch"``, ``"files"``, the number of finished files and the total
        number of files; or `True` for a bar of tqdm. Each file is counted once for each parameter set. On a cluster,
        the callable is called when a part is done. If the callable raises an exception, the batch is canceled.
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
    if not (listed or given == () and sets) or sets is not None and not sets:
        return Report({}, [])
    arguments = [recipe_file(recipe, folder), "--out", os.fspath(out)]
    arguments += ["--inputs", *listed] if listed else []
    for name, value in numbers(dict(values or {})):
        arguments += ["--set", f"{name}={value}"]
    for option, text in (("--preset", preset), ("--param", param), ("--budget", budget)):
        arguments += [option, text] if text is not None else []
    arguments += ["--folders"] if folders else []
    arguments += ["--retry-failed"] if retry_failed else []

    with tempfile.TemporaryDirectory(dir=folder, prefix=".parts-") as temporary:
        merged = os.path.join(temporary, "all.json")
        if sets is not None:
            texts = json.dumps([dict(numbers(dict(values))) for values in sets])
            file = Path(temporary, "sets.json")
            file.write_text(texts, encoding="utf-8")
            arguments += ["--sets", os.fspath(file)]
        with callback(progress) as show:
            if isinstance(engine, str) and engine == "local":
                files = _core.batch_inputs(listed) if show else []
                counter = Counter(show, max(len(files), 1) * max(len(sets or ()), 1))
                run_program(["batch", *arguments, "--report", merged], os.getcwd(), counter.count)
                counter.end()
            else:
                partial = run_parts(engine, arguments, temporary, parts, show)
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
    """Copies the files at an address, which can be a pattern, to a folder. Returns the address of each copy. An
    existing copy is replaced only if its content differs."""
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
    """Returns the path of a file that contains the recipe. If the recipe was built in Python, it is first written to
    `folder`."""
    if not isinstance(recipe, Recipe):
        return os.fspath(recipe)
    path = Path(recipe.path)
    if path.is_file() and path.read_text(encoding="utf-8") == recipe.to_ron():
        return recipe.path
    written = folder / path.name
    if not written.is_file() or written.read_text(encoding="utf-8") != recipe.to_ron():
        written.write_text(recipe.to_ron(), encoding="utf-8")
    return os.fspath(written)


class Counter:
    """Shows how many files of a batch are done."""

    def __init__(self, show: Progress | None, total: int) -> None:
        self.show = show
        self.done = 0
        self.total = total

    def add(self, files: int) -> None:
        """Adds to the number of files that are done, and reports the new number."""
        self.done += files
        if self.show is not None:
            self.show("batch", "files", self.done, self.total)

    def count(self, line: str) -> None:
        """Counts a file if this line of the program's output reports the result of a file."""
        if line.startswith(("ok ", "FAILED ")):
            self.add(1)

    def end(self) -> None:
        """Counts the files for which the program prints no line, because an earlier run has finished them."""
        self.add(self.total - self.done)


@dataclass(frozen=True)
class Task:
    """A part of a batch, which one process runs."""

    #: The arguments of the program. The last argument is the path of the report.
    arguments: list[str]
    #: The number of files in this part, each counted once for each parameter set.
    runs: int
    #: The estimated memory of the process that runs this part, in bytes.
    bytes: int


def run_parts(engine: Any, arguments: list[str], temporary: str, parts: int | None, show: Progress | None) -> list[str]:
    """Runs the parts of a batch on a cluster, and returns the paths of their reports."""

    def divided(threads: int) -> list[Task]:
        return tasks(arguments, temporary, parts or PARTS_PER_THREAD * max(threads, 1))

    if engine == "ray":
        ran = run_on_ray(needed("ray"), divided, show)
    elif engine == "dask":
        distributed = needed("distributed")
        # Each task starts its own process, so one worker with a thread for each processor is enough. The worker offers
        # the memory of the whole machine.
        memory = {"MEMORY": distributed.system.MEMORY_LIMIT}
        threads = needed("dask.system").CPU_COUNT
        with distributed.LocalCluster(
            n_workers=1, threads_per_worker=threads, resources=memory, dashboard_address=None
        ) as cluster:
            with distributed.Client(cluster) as client:
                ran = run_on_dask(client, divided, show)
    elif hasattr(engine, "submit") and hasattr(engine, "gather"):
        ran = run_on_dask(engine, divided, show)
    else:
        raise ValueError(f'unknown engine {engine!r}: expected "local", "dask", "ray" or a client of Dask')
    return [task.arguments[-1] for task in ran]


def tasks(arguments: list[str], temporary: str, n: int) -> list[Task]:
    """Divides a batch into parts, and estimates the memory of each."""
    estimate = os.path.join(temporary, "estimate.json")
    run_program(["batch", *arguments, "--estimate", str(n), "--report", estimate], os.getcwd())
    made = []
    for part in json.loads(Path(estimate).read_text(encoding="utf-8"))["parts"]:
        file = os.path.join(temporary, f"{part['part']}.json")
        one = ["--threads", "1", "--shard", f"{part['part']}/{n}", "--report", file]
        made.append(Task([*arguments, *one], part["runs"], PROCESS_BYTES + part["bytes"]))
    return made


def run_on_ray(ray: Any, divided: Callable[[int], list[Task]], show: Progress | None) -> list[Task]:
    """Runs the parts of a batch on Ray."""
    if not ray.is_initialized():
        ray.init(include_dashboard=False)
    nodes = [node["Resources"] for node in ray.nodes() if node["Alive"]]
    threads = int(sum(node.get("CPU", 0) for node in nodes))
    # If a task requested more memory than any machine has, the task would wait forever.
    room = int(max((node.get("memory", 0) for node in nodes), default=0))
    made = divided(threads)
    counter = Counter(show, sum(task.runs for task in made))
    remote = ray.remote(max_retries=3, num_cpus=1)(run_part)
    running = {remote.options(memory=min(task.bytes, room)).remote(task.arguments, os.getcwd()): task for task in made}
    waiting = list(running)
    try:
        while waiting:
            [ended], waiting = ray.wait(waiting)
            ray.get(ended)
            counter.add(running[ended].runs)
    except BaseException:
        for reference in running:
            ray.cancel(reference, force=True)
        raise
    return made


def run_on_dask(client: Any, divided: Callable[[int], list[Task]], show: Progress | None) -> list[Task]:
    """Runs the parts of a batch on a cluster of Dask."""
    threads = sum(client.ncores().values())
    made = divided(threads)
    counter = Counter(show, sum(task.runs for task in made))
    # If a task requested more memory than any worker has, the task would wait forever.
    room = max((m for m in memory_of_workers(client) if m is not None), default=None)
    running = {
        client.submit(
            run_part,
            task.arguments,
            os.getcwd(),
            # With `pure=False`, Dask runs a part even if it has run a part with the same arguments before. The files
            # can have changed in the meantime.
            pure=False,
            retries=3,
            resources=None if room is None else {"MEMORY": min(task.bytes, room)},
        ): task
        for task in made
    }
    for ended in needed("distributed").as_completed(running):
        ended.result()
        counter.add(running[ended].runs)
    return made


def memory_of_workers(client: Any) -> list[float | None]:
    """Returns the resource `MEMORY` of each worker of Dask, or `None` for a worker without this resource."""
    try:
        workers = client.scheduler_info(n_workers=-1)["workers"]
    except TypeError:
        # Older versions of Dask have no parameter `n_workers` and list all workers.
        workers = client.scheduler_info()["workers"]
    return [worker["resources"].get("MEMORY") for worker in workers.values()]


def needed(name: str) -> Any:
    """Imports a package. If the package is missing, the error says how to install it."""
    import importlib

    try:
        return importlib.import_module(name)
    except ImportError as error:
        package = "'dask[distributed]'" if name == "distributed" else name
        raise ImportError(f"this engine needs {name}: pip install {package}") from error


def run_part(arguments: list[str], folder: str) -> str:
    """Runs a part of a batch in a separate process, and returns the path of its report."""
    run_program(["batch", *arguments], folder)
    return arguments[-1]


def run_program(arguments: list[str], folder: str, each_line: Callable[[str], object] = lambda line: None) -> None:
    """Runs the program in a process that ends when this process ends. The last argument is the path of the report,
    which the program writes. Calls `each_line` with each line that the program prints."""
    with tempfile.TemporaryFile("w+", encoding="utf-8", errors="replace") as errors:
        process = subprocess.Popen(
            [sys.executable, "-m", "meshwright._task", *arguments],
            cwd=folder,
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=errors,
            encoding="utf-8",
            errors="replace",
        )
        assert process.stdin is not None and process.stdout is not None
        try:
            for line in process.stdout:
                each_line(line)
            code = process.wait()
        except BaseException:
            process.kill()
            process.wait()
            raise
        finally:
            process.stdout.close()
            process.stdin.close()
        errors.seek(0)
        text = errors.read().strip()
    if code == 130:
        raise KeyboardInterrupt
    # The exit code is also 1 if some files fail. This is not an error here, because the report lists the failed files.
    if code > 1 or code < 0 or not os.path.exists(os.path.join(folder, arguments[-1])):
        raise Error(text or f"the batch ended with code {code}")
