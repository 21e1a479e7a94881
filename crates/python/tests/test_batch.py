"""Batches on this machine and on a cluster."""

import json
import os
import subprocess
import sys
import threading
import time
from pathlib import Path
from typing import Any

import pytest

import meshwright as mw

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


def test_a_killed_worker_loses_nothing(folder: Path) -> None:
    distributed = pytest.importorskip("distributed")
    expected = mw.batch("clean.ron", "in/*.obj", out="local", values={"levels": 5})
    with distributed.LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as cluster:
        with distributed.Client(cluster) as client:
            pids = list(client.run(os.getpid).values())

            def kill() -> None:
                while not list(Path("out").glob("*.ply")):
                    time.sleep(0.01)
                os.kill(pids[0], 9)

            killer = threading.Thread(target=kill)
            killer.start()
            found = mw.batch("clean.ron", "in/*.obj", out="out", values={"levels": 5}, engine=client, parts=8)
            killer.join()
            assert pids[0] not in client.run(os.getpid).values()
            assert rows(found) == rows(expected)
            again = mw.batch("clean.ron", "in/*.obj", out="out", values={"levels": 5}, engine=client, parts=8)
            assert rows(again) == rows(expected)
    assert not list(Path("out").glob(".parts-*"))
