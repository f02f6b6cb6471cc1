"""Recordings: what they hold, and the files they become, opened by those files' own readers."""

import base64
import html
import importlib.util
import io
import json
import re
import struct
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import tautline as tl
from tautline import _save

PACKAGE = Path(__file__).resolve().parents[1]


@pytest.fixture(scope="module")
def recording() -> tl.Recording:
    world = tl.World()
    world.add(tl.HalfSpace(), name="floor")
    world.add(tl.RigidBody(tl.Shape.sphere(0.3), position=(0, 0.6, 0), velocity=(1, 0, 0)), name="ball")
    world.add(tl.Cloth(tl.Grid(8, 8, 1, 1), position=(0, 1.2, 0)), name="a cloth")
    world.add(tl.Rope(tl.line((1, 2, 0), (2, 2, 0), 5), pins=[0]), name="rope")
    return world.run(0.5, every=2)


def test_what_it_holds(recording: tl.Recording) -> None:
    assert recording.tracks == ["floor", "ball", "a cloth", "rope"]
    assert (recording.frame_count, recording.frame_rate, recording.steps) == (16, pytest.approx(30), 30)
    assert recording.positions("a cloth").shape == (16, 64, 3)
    assert recording.positions("floor").shape[0] == 1
    poses = recording.poses("ball")
    assert poses is not None and poses.shape == (16, 7) and recording.poses("rope") is None
    series = recording.series
    assert all(len(values) == 16 for values in series.values())
    assert series["time"][-1] == pytest.approx(0.5)
    with pytest.raises(tl.InvalidValueError, match="there are: floor, ball"):
        recording.positions("balloon")


def test_a_run_without_pictures_has_figures(tmp_path: Path) -> None:
    recording = tl.Scene.named("tower", n=3).run(0.2, record=False)
    assert recording.frame_count == 0 and len(recording.series["time"]) == 7
    with pytest.raises(tl.InvalidValueError, match="record=True"):
        recording.save(tmp_path / "a.gif")


def test_npz(recording: tl.Recording, tmp_path: Path) -> None:
    recording.save(tmp_path / "a.npz")
    arrays = np.load(tmp_path / "a.npz")
    assert list(arrays["names"]) == recording.tracks
    assert np.array_equal(arrays["a cloth/positions"], recording.positions("a cloth"))
    assert np.array_equal(arrays["ball/poses"], recording.poses("ball"))
    assert np.array_equal(arrays["rope/triangles"], recording.triangles("rope"))
    assert np.allclose(arrays["times"], recording.series["time"])


def test_pc2_has_the_layout_that_blender_reads(recording: tl.Recording, tmp_path: Path) -> None:
    recording.save(tmp_path / "a.pc2")
    data = (tmp_path / "a.pc2").read_bytes()
    magic, version, points, start, rate, samples = struct.unpack("<12siiffi", data[:32])
    assert (magic, version, start, rate, samples) == (b"POINTCACHE2\0", 1, 0.0, 1.0, 16)
    frames = np.frombuffer(data[32:], "<f4").reshape(samples, points, 3)
    expected = [np.broadcast_to(recording.positions(track), (16, *recording.positions(track).shape[1:])) for track in recording.tracks]
    assert np.array_equal(frames, np.concatenate(expected, axis=1))
    lines = (tmp_path / "a.obj").read_text().splitlines()
    assert sum(line.startswith("v ") for line in lines) == points


@pytest.mark.parametrize("extension", ["usdc", "usda", "usd"])
def test_usd_opens_with_exact_positions(recording: tl.Recording, tmp_path: Path, extension: str) -> None:
    pxr = pytest.importorskip("pxr")
    from pxr import Usd, UsdGeom

    path = tmp_path / f"a.{extension}"
    recording.save(path)
    stage = Usd.Stage.Open(str(path))
    assert UsdGeom.GetStageUpAxis(stage) == "Y" and UsdGeom.GetStageMetersPerUnit(stage) == 1
    assert stage.GetTimeCodesPerSecond() == pytest.approx(30)
    assert (stage.GetStartTimeCode(), stage.GetEndTimeCode()) == (0, 15)
    cloth = UsdGeom.Mesh(stage.GetPrimAtPath("/recording/a_cloth"))
    expected = recording.positions("a cloth")
    for frame in range(16):
        assert np.array_equal(np.array(cloth.GetPointsAttr().Get(frame)), expected[frame])
    assert cloth.GetDoubleSidedAttr().Get() and len(cloth.GetFaceVertexCountsAttr().Get()) == 98
    ball = UsdGeom.Mesh(stage.GetPrimAtPath("/recording/ball"))
    poses = recording.poses("ball")
    assert poses is not None
    for frame in (0, 7, 15):
        place = ball.GetLocalTransformation(frame).ExtractTranslation()
        assert np.array_equal(np.array(place, np.float32), poses[frame, :3])
        vertex = np.array(ball.GetLocalTransformation(frame).Transform(ball.GetPointsAttr().Get()[5]))
        assert vertex == pytest.approx(recording.positions("ball")[frame, 5], abs=1e-6)
    assert pxr is not None and [file.name for file in tmp_path.iterdir()] == [path.name]


@pytest.mark.skipif(importlib.util.find_spec("bpy") is None, reason="Blender's bpy is not installed")
def test_usd_and_pc2_open_in_blender(recording: tl.Recording, tmp_path: Path) -> None:
    for extension in ("usdc", "pc2"):
        recording.save(tmp_path / f"a.{extension}")
    recording.save(tmp_path / "a.npz")
    # In a process of its own: what Blender brings of USD and what usd-core brings do not go together.
    told = subprocess.run([sys.executable, PACKAGE / "tests/blender.py", tmp_path], capture_output=True, text=True)
    assert told.returncode == 0, told.stdout + told.stderr
    print(told.stdout)


def test_glb_opens_in_trimesh(recording: tl.Recording, tmp_path: Path) -> None:
    trimesh = pytest.importorskip("trimesh")
    recording.save(tmp_path / "a.glb")
    scene = trimesh.load(tmp_path / "a.glb")
    assert len(scene.geometry) == 4
    data = (tmp_path / "a.glb").read_bytes()
    length = struct.unpack("<I", data[12:16])[0]
    document = json.loads(data[20 : 20 + length])
    assert [node["name"] for node in document["nodes"]] == recording.tracks
    cloth = next(mesh for mesh in scene.geometry.values() if len(mesh.faces) == 98)
    assert cloth.vertices.astype(np.float32) == pytest.approx(recording.positions("a cloth")[0], abs=0)


def test_pictures(recording: tl.Recording, tmp_path: Path) -> None:
    image = pytest.importorskip("PIL.Image")
    recording.save(tmp_path / "a.png", size=(120, 90), frame=3)
    recording.save(tmp_path / "a.gif", size=(120, 90), frame_rate=10)
    with image.open(tmp_path / "a.png") as picture:
        assert picture.size == (120, 90)
    with image.open(tmp_path / "a.gif") as animation:
        assert 5 <= animation.n_frames <= 7
    for options in ({"size": (0, 9)}, {"frame": 99}):
        with pytest.raises(tl.InvalidValueError):
            recording.save(tmp_path / "b.png", **options)
    assert not (tmp_path / "b.png").exists()
    with pytest.raises(tl.InvalidValueError, match=r"\.gif, \.glb"):
        recording.save(tmp_path / "a.xyz")


def test_mesh_sequences(recording: tl.Recording, tmp_path: Path) -> None:
    trimesh = pytest.importorskip("trimesh")
    recording.save(tmp_path / "a.ply")
    assert len(list(tmp_path.iterdir())) == 16
    mesh = trimesh.load(tmp_path / "a_0015.ply", process=False)
    expected = np.concatenate([recording.positions(track)[-1] for track in recording.tracks])
    assert np.array_equal(mesh.vertices.astype(np.float32), expected)


def test_a_film_has_every_frame(recording: tl.Recording, tmp_path: Path) -> None:
    try:
        ffmpeg = _save._ffmpeg()
    except ImportError as missing:
        pytest.skip(str(missing))
    image = pytest.importorskip("PIL.Image")
    recording.save(tmp_path / "a.mp4", size=(321, 240))
    raw = ["-f", "rawvideo", "-pix_fmt", "rgb24", "-"]
    read = subprocess.run([ffmpeg, "-i", str(tmp_path / "a.mp4"), *raw], capture_output=True, check=True)
    told = re.search(r"Video: h264.* (\d+)x(\d+).* ([\d.]+) fps", read.stderr.decode())
    assert told is not None and told.groups() == ("320", "240", "30"), "its size is made even"
    frames = np.frombuffer(read.stdout, np.uint8).reshape(-1, 240, 320, 3)
    assert len(frames) == recording.frame_count
    for frame in (0, 15):
        recording.save(tmp_path / "a.png", size=(320, 240), frame=frame)
        with image.open(tmp_path / "a.png") as picture:
            difference = np.abs(frames[frame].astype(float) - np.asarray(picture.convert("RGB")))
        assert difference.mean() < 3, "of 255: as it was drawn, but for what a film loses"
    assert np.abs(frames[0].astype(float) - frames[15]).mean() > 3, "and something moves"


def test_what_is_not_installed_is_said_with_what_brings_it(
    recording: tl.Recording, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("PATH", "")
    for module in ("imageio_ffmpeg", "pxr", "matplotlib.figure", "tqdm.auto", "tautline._plot"):
        monkeypatch.setitem(sys.modules, module, None)
    monkeypatch.delitem(sys.modules, "tautline._plot")
    world = tl.World()
    for extra, use in {
        "film": lambda: recording.save(tmp_path / "a.mp4"),
        "usd": lambda: recording.save(tmp_path / "a.usdc"),
        "plot": recording.plot,
        "progress": lambda: world.run(0.1, progress=True),
    }.items():
        with pytest.raises(ImportError, match=rf'pip install "tautline\[{extra}\]"'):
            use()
    assert not list(tmp_path.iterdir())


def test_a_notebook_plays_a_recording_and_shows_a_world(recording: tl.Recording, tmp_path: Path) -> None:
    image = pytest.importorskip("PIL.Image")
    recording.save(tmp_path / "a.html")
    page = (tmp_path / "a.html").read_text(encoding="utf-8")
    assert page.startswith("<!doctype html>") and "a cloth" in page
    assert not re.search(r'(src|href)="(http|//)', page), "it asks for nothing"
    shown = recording._repr_html_()
    frame = re.fullmatch(r'<iframe title="world" .* sandbox="allow-scripts" srcdoc="([^"]*)"></iframe>', shown, re.DOTALL)
    assert frame is not None and html.unescape(frame[1]) == page
    picture = re.search(r'src="data:image/png;base64,([^"]+)"', tl.Scene.named("tower", n=2).build()._repr_html_())
    assert picture is not None
    with image.open(io.BytesIO(base64.b64decode(picture[1]))) as opened:
        assert opened.size == (640, 480)


def test_plots(recording: tl.Recording, tmp_path: Path) -> None:
    pytest.importorskip("matplotlib")
    figure = recording.plot()
    assert [axes.get_ylabel() for axes in figure.axes] == ["energy in J", "rigid contacts", "largest strain in %"]
    figure.savefig(tmp_path / "a.png")


def test_meshes_from_and_to_trimesh() -> None:
    trimesh = pytest.importorskip("trimesh")
    torus = trimesh.creation.torus(0.4, 0.15, major_sections=12, minor_sections=8)
    shape = tl.Shape.from_mesh(*tl.from_trimesh(torus))
    assert shape.volume == pytest.approx(torus.volume, rel=0.02) and shape.part_count > 1
    world = tl.World()
    body = world.add(tl.RigidBody(shape, position=(1, 2, 3)), name="torus")
    assert tl.to_trimesh(body).volume == pytest.approx(torus.volume, rel=1e-3)
    assert tl.to_trimesh(body).centroid == pytest.approx([1, 2, 3], abs=1e-3)
    recording = world.run(0.1)
    moved = tl.recording_to_trimesh(recording, "torus")
    assert moved.centroid == pytest.approx(body.center_of_mass, abs=1e-3)
