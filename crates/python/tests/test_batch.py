"""Batches on this machine and on a cluster."""

import json
import os
import subprocess
import sys
import threading
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import meshwright as mw
import meshwright._batch

RECIPE = """(
    recipe: 1,
    params: { "input": Path(default: "in/a0.obj"), "levels": Int(default: 1) },
    steps: [
        Load(path: arg("input")),
        LoopSubdivide(levels: arg("levels")),
        Save(path: "{input.stem}.ply"),
    ],
    expect: [Manifold],
)
"""


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "in").mkdir()
    ball = mw.Scene().icosahedron(name="ball").mesh()
    for i in range(12):
        ball.transform(scale=(1 + i, 1, 1)).save(tmp_path / "in" / f"a{i}.obj")
    (tmp_path / "in" / "broken.obj").write_text("v 0 0\nf 1 2 3\n")
    (tmp_path / "clean.ron").write_text(RECIPE)
    return tmp_path


def rows(report: Any) -> list[dict[str, Any]]:
    return [{k: v for k, v in vars(row).items() if k not in ("seconds", "outputs")} for row in report]


def test_the_report_is_that_of_the_program(folder: Path) -> None:
    found = mw.batch("clean.ron", "in/*.obj", out="a", report="a.json")
    assert repr(found) == "Report(12 ok, 1 failed)" and found.failed[0].input == "in/broken.obj"
    command = [sys.executable, "-m", "meshwright", "batch", "clean.ron", "--inputs", "in/*.obj", "--out", "b", "--report", "b.json"]
    assert subprocess.run(command, capture_output=True).returncode == 1
    expected = json.loads(Path("b.json").read_text())["rows"]
    assert rows(found) == [{k: v for k, v in row.items() if k not in ("seconds", "outputs")} for row in expected]
    assert len(json.loads(Path("a.json").read_text())["rows"]) == 13


def test_a_second_run_does_only_what_is_missing(folder: Path) -> None:
    first = mw.batch(mw.Recipe.load("clean.ron"), ["in/*.obj"], out="out")
    written = {row.input: os.stat(row.outputs[0]["path"]).st_mtime_ns for row in first if row.outputs}
    os.remove(first[3].outputs[0]["path"])
    second = mw.batch("clean.ron", "in/*.obj", out="out")
    changed = [row.input for row in second if row.outputs and os.stat(row.outputs[0]["path"]).st_mtime_ns != written[row.input]]
    assert changed == [first[3].input] and rows(first) == rows(second)


def test_another_engine_or_number_of_parts_continues_a_batch(folder: Path) -> None:
    first = mw.batch("clean.ron", "in/*.obj", out="out")
    times = {path: path.stat().st_mtime_ns for path in Path("out").glob("*.ply")}
    command = [sys.executable, "-m", "meshwright", "batch", "clean.ron", "--inputs", "in/*.obj", "--shard", "2/2"]
    subprocess.run(command, capture_output=True)
    distributed = pytest.importorskip("distributed")
    with distributed.LocalCluster(n_workers=1, threads_per_worker=2, dashboard_address=None) as cluster:
        with distributed.Client(cluster) as client:
            for parts in (1, 3):
                assert rows(mw.batch("clean.ron", "in/*.obj", out="out", engine=client, parts=parts)) == rows(first)
    assert times == {path: path.stat().st_mtime_ns for path in Path("out").glob("*.ply")}


def test_progress(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    calls: list[tuple[str, str, int, int]] = []

    def show(*call: Any) -> None:
        calls.append(call)

    mw.batch("clean.ron", "in/*.obj", out="out", progress=show)
    assert calls == [("batch", "files", done, 13) for done in (*range(1, 14), 13)]
    calls.clear()
    os.remove("out/a3.ply")
    mw.batch("clean.ron", "in/*.obj", out="out", progress=show)
    assert calls == [("batch", "files", 1, 13), ("batch", "files", 13, 13)]

    pytest.importorskip("tqdm")
    mw.batch(ball_file(folder), sets=SETS, out="sets", progress=True)
    assert "batch files 100%" in capsys.readouterr().err

    def stop(*call: Any) -> None:
        raise RuntimeError("enough")

    with pytest.raises(RuntimeError, match="enough"):
        mw.batch("clean.ron", "in/*.obj", out="stopped", progress=stop)

    distributed = pytest.importorskip("distributed")
    calls.clear()
    with distributed.LocalCluster(n_workers=1, threads_per_worker=2, dashboard_address=None) as cluster:
        with distributed.Client(cluster) as client:
            mw.batch("clean.ron", "in/*.obj", out="parts", engine=client, parts=3, progress=show)
    assert len(calls) == 3 and calls[-1] == ("batch", "files", 13, 13)


def test_addresses(folder: Path) -> None:
    fsspec = pytest.importorskip("fsspec")
    for i in range(3):
        with fsspec.open(f"memory://models/a{i}.obj", "wb") as file:
            file.write((folder / "in" / f"a{i}.obj").read_bytes())
    found = mw.batch("clean.ron", "memory://models/*.obj", out="out", upload="memory://clean")
    assert [row.input for row in found] == [f"memory:///models/a{i}.obj" for i in range(3)]
    assert mw.read("memory://clean/a1.ply").mesh().n_faces == 80
    local = mw.batch("clean.ron", (folder / "in" / "a1.obj").as_uri(), out="other", upload=(folder / "up").as_uri())
    assert local[0].digest == found[1].digest and (folder / "up" / "a1.ply").is_file()


def test_errors_of_the_whole_batch(folder: Path) -> None:
    with pytest.raises(mw.Error, match="missing.ron"):
        mw.batch("missing.ron", "in/*.obj")
    with pytest.raises(ValueError, match="unknown engine"):
        mw.batch("clean.ron", "in/*.obj", engine="slurm")


BALL = """(
    recipe: 1,
    params: { "levels": Int(default: 1), "center": Vector(default: (0, 0, 0)) },
    steps: [
        Icosahedron(name: "ball", center: arg("center")),
        LoopSubdivide(levels: arg("levels")),
        Save(path: "ball.ply"),
    ],
)
"""
SETS = [{"levels": 1}, {"levels": np.int64(2), "center": np.array([0, 0.5, 1])}, {"levels": 99}]


def program(*arguments: str) -> list[dict[str, Any]]:
    """Runs `meshwright batch`, and returns the rows of its report without times and outputs."""
    command = [sys.executable, "-m", "meshwright", "batch", *arguments, "--report", "program.json"]
    assert subprocess.run(command, capture_output=True).returncode in (0, 1)
    expected = json.loads(Path("program.json").read_text())["rows"]
    return [{k: v for k, v in row.items() if k not in ("seconds", "outputs")} for row in expected]


def test_parameter_sets(folder: Path) -> None:
    found = mw.batch(mw.Recipe(BALL, path="ball.ron"), sets=SETS, out="out")
    assert [(row.set, row.faces, row.state) for row in found] == [(1, 80, "ok"), (2, 320, "ok"), (3, None, "failed")]
    assert found[1].values == {"levels": "2", "center": "(0.0, 0.5, 1.0)"} and found[1].input == ""
    assert mw.read(found[1].outputs[0]["path"]).mesh().n_faces == 320 and Path("out/2/ball.ply").is_file()
    texts = [{"levels": 1}, {"levels": 2, "center": "(0.0, 0.5, 1.0)"}, {"levels": 99}]
    Path("sets.json").write_text(json.dumps(texts))
    assert rows(found) == program("out/ball.ron", "--sets", "sets.json", "--out", "b")
    assert len(mw.batch(ball_file(folder), sets=[])) == 0

    both = mw.batch("clean.ron", "in/a*.obj", sets=[{"levels": 0}, {"levels": 2}], out="c")
    assert [(row.input, row.set) for row in both[:3]] == [("in/a0.obj", 1), ("in/a0.obj", 2), ("in/a1.obj", 1)]
    with pytest.raises(mw.Error, match="the recipe has no parameter `level`: did you mean `levels`"):
        mw.batch("clean.ron", "in/a*.obj", sets=[{"level": 0}])
    with pytest.raises(mw.Error, match="no parameter of type Path"):
        mw.batch(ball_file(folder), "in/a*.obj")


def ball_file(folder: Path) -> Path:
    path = folder / "ball.ron"
    path.write_text(BALL)
    return path


def many(folder: Path) -> None:
    """Writes 2,000 small files. Four of them are invalid."""
    (folder / "many").mkdir()
    for i in range(2000):
        faces = "f 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n" if i % 500 else "f 1 2 9\n"
        points = f"v 0 0 0\nv {i + 1} 0 0\nv 0 1 0\nv 0 0 1\n"
        (folder / "many" / f"m{i:04}.obj").write_text(points + faces)


def kill_when_files_exist(pid: Callable[[], int | None]) -> threading.Thread:
    """Kills a process after some outputs were written."""

    def kill() -> None:
        while len(list(Path("out").glob("*.ply"))) < 200:
            time.sleep(0.01)
        while (found := pid()) is None:
            time.sleep(0.01)
        os.kill(found, 9)

    killer = threading.Thread(target=kill)
    killer.start()
    return killer


def test_2000_files_on_dask_with_a_killed_worker(folder: Path) -> None:
    distributed = pytest.importorskip("distributed")
    many(folder)
    expected = program("clean.ron", "--inputs", "many/*.obj", "--out", "local")
    memory = {"MEMORY": 1 << 30}
    with distributed.LocalCluster(n_workers=2, threads_per_worker=1, resources=memory, dashboard_address=None) as cluster:
        with distributed.Client(cluster) as client:
            pids = list(client.run(os.getpid).values())
            killer = kill_when_files_exist(lambda: pids[0])
            found = mw.batch("clean.ron", "many/*.obj", out="out", engine=client)
            killer.join()
            assert pids[0] not in client.run(os.getpid).values()
            assert repr(found) == "Report(1996 ok, 4 failed)" and rows(found) == expected
            times = {path: path.stat().st_mtime_ns for path in Path("out").glob("*.ply")}
            again = mw.batch("clean.ron", "many/*.obj", out="out", engine=client)
            assert rows(again) == expected
            assert times == {path: path.stat().st_mtime_ns for path in Path("out").glob("*.ply")}
    for path in times:
        assert path.read_bytes() == Path("local", path.name).read_bytes()
    assert not list(Path("out").glob(".parts-*"))


def test_2000_files_on_ray_with_a_killed_worker(folder: Path) -> None:
    ray = pytest.importorskip("ray")
    psutil = pytest.importorskip("psutil")
    many(folder)
    expected = program("clean.ron", "--inputs", "many/*.obj", "--out", "local")
    ray.init(num_cpus=2, include_dashboard=False, log_to_driver=False)
    try:

        def worker() -> int | None:
            for process in psutil.Process().children(recursive=True):
                if process.name().startswith("ray::run_part") or "ray::run_part" in " ".join(process.cmdline()):
                    return int(process.pid)
            return None

        killer = kill_when_files_exist(worker)
        found = mw.batch("clean.ron", "many/*.obj", out="out", engine="ray")
        killer.join()
        assert repr(found) == "Report(1996 ok, 4 failed)" and rows(found) == expected
        with pytest.raises(mw.Error, match="no parameter of type Path"):
            mw.batch(ball_file(folder), "in/a*.obj", engine="ray")
        assert rows(mw.batch(ball_file(folder), sets=SETS, out="r", engine="ray")) == rows(
            mw.batch(ball_file(folder), sets=SETS, out="l")
        )
    finally:
        ray.shutdown()


def test_tasks_state_their_memory(folder: Path) -> None:
    """The estimate grows with the mesh. A task runs even if it needs more memory than any worker has."""
    distributed = pytest.importorskip("distributed")
    tasks = meshwright._batch.tasks
    arguments = [str(ball_file(folder)), "--out", "out", "--set"]
    [small], [large] = (tasks([*arguments, f"levels={n}"] + ["--sets", one(folder)], str(folder), 1) for n in (1, 7))
    assert large.bytes - small.bytes > 30 * (20 << 14)
    memory = {"MEMORY": 1 << 20}
    with distributed.LocalCluster(n_workers=1, threads_per_worker=2, resources=memory, dashboard_address=None) as cluster:
        with distributed.Client(cluster) as client:
            assert len(mw.batch("clean.ron", "in/a*.obj", engine=client, parts=3)) == 12


def one(folder: Path) -> str:
    path = folder / "one.json"
    path.write_text("[{}]")
    return str(path)
