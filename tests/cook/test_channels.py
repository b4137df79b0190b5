"""Channels and deep samples of cooked pictures tell what is known of the particles."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from .effects import effect, graph, made

OpenEXR = pytest.importorskip("OpenEXR")
FLAT = {"type": "camera", "position": [0, 0, 5], "target": [0, 0, 0], "projection": "orthographic", "view_width": 4.8}
"""Ten pixels a metre."""
ALL = ["depth", "velocity", "world_velocity", "id", "stream"]
STILL = {"rate": 0, "count": 3, "set": {"position": {"expr": "vec(at, 0, at)"}, "radius": 0.3, "velocity": [0, 0, 0]}}
MOVING = {"rate": 0, "count": 1, "set": {"position": [0, 0, 0], "velocity": [2.4, -4.8, 1], "radius": 0.5}}


def read(file: Path) -> dict[str, np.ndarray]:
    with OpenEXR.File(str(file), separate_channels=True) as opened:
        return {name: channel.pixels for name, channel in opened.channels().items()}


def header(file: Path):
    with OpenEXR.File(str(file), header_only=True) as opened:
        return dict(opened.header())


def cooked(folder: Path, emit=None, image=None, ops=(), camera=FLAT, frame=3, nodes=None, **keys) -> Path:
    """Cook one frame as EXR; return the file."""
    given = {"file": "x.##.exr", "camera": "look", **(image or {})}
    return made(ops, emit, None, given, {"look": camera, **(nodes or {})}, **keys).cook(folder, [frame], 2)[0]


def flattened(channels, height=32, width=48) -> np.ndarray:
    """Composite deep samples front to back, as the definition of `over` has it."""
    result = np.zeros((height, width, 4))
    for y in range(height):
        for x in range(width):
            samples = [channels[name][y, x] for name in "RGBA"]
            for sample in zip(*samples, strict=True) if samples[0] is not None else ():
                result[y, x] += (1 - result[y, x, 3]) * np.array(sample, float)
    return result


def test_velocities_of_free_flight(tmp_path):
    """2.4 m/s at ten pixels a metre and 24 frames a second is a pixel a frame; upwards counts as positive."""
    for shutter in (0, 0.3, 1):
        channels = cooked_channels(tmp_path, MOVING, {"channels": ["velocity", "world_velocity"], "shutter": shutter})
        seen = channels["A"] > 0
        for name, want in (("velocity.X", 1), ("velocity.Y", -2), ("world_velocity.X", 2.4), ("world_velocity.Y", -4.8),
                           ("world_velocity.Z", 1)):
            np.testing.assert_allclose(channels[name][seen], want, rtol=1e-4)
            assert not channels[name][~seen].any()


def cooked_channels(*given, **named) -> dict[str, np.ndarray]:
    return read(cooked(*given, **named))


def test_applied_velocities_count(tmp_path):
    """What an operator moves without a velocity of its own moves on the screen."""
    ops = [{"type": "translate", "rate": [4.8, 0, 0]}]
    emit = MOVING | {"set": {"position": [0, 0, 0], "radius": 0.5}}
    channels = cooked_channels(tmp_path, emit, {"channels": ["velocity"], "shutter": 0}, ops)
    np.testing.assert_allclose(channels["velocity.X"][channels["A"] > 0], 2, rtol=1e-4)


def test_a_newborn_goes_as_fast_as_it_goes(tmp_path):
    """Born a quarter of a frame ago, its way is short and so is its time."""
    emit = MOVING | {"rate": 32, "count": 0, "life": 0.02}
    channels = cooked_channels(tmp_path, emit, {"channels": ["world_velocity"], "shutter": 1}, frame=2)
    seen = channels["A"] > 0
    assert seen.any()
    np.testing.assert_allclose(channels["world_velocity.X"][seen], 2.4, rtol=1e-3)


def test_depth_of_the_nearest(tmp_path):
    """Five metres before a particle at the origin, four before the one in front of it; 1e30 where nothing is."""
    emit = STILL | {"count": 1, "set": {"position": [0, 0, 0], "radius": 1.0}}
    front = {"type": "emit", "count": 1, "rate": 0, "set": {"position": [0.5, 0, 1], "radius": 0.2, "opacity": 0.01}}
    channels = cooked_channels(tmp_path, emit, {"from": ["sky", "near"], "channels": ["depth"]}, nodes={"near": front})
    depth, seen = channels["Z"], channels["A"] > 0
    assert set(np.unique(depth)) == {np.float32(4), np.float32(5), np.float32(1e30)}
    assert (depth[~seen] == np.float32(1e30)).all() and depth[15, 28] == 4 and depth[15, 20] == 5


def test_id_and_stream_of_what_is_seen_most(tmp_path):
    """A veil in front leaves them to what shines through; ids are those of the simulation."""
    emit = {"rate": 0, "count": 5, "set": {"position": {"in_box": {"min": [-2, -1, 0], "max": [2, 1, 0]}}, "radius": 0.2}}
    veil = {"type": "emit", "count": 1, "rate": 0, "set": {"position": [0, 0, 1], "radius": 9, "opacity": 0.1}}
    image = {"from": [{"stream": "sky", "falloff": "disc"}, {"stream": "veil", "falloff": "disc"}], "channels": ["id", "stream"]}
    found = made((), emit, None, image | {"file": "x.##.exr", "camera": "look"}, {"look": FLAT, "veil": veil})
    columns = found.simulate(1)["sky"]
    channels = read(found.cook(tmp_path, [1])[0])
    assert channels["id"].dtype == channels["stream"].dtype == np.uint32
    alone = 0
    for place, number in zip(columns["position"], columns["id"], strict=True):
        x, y = int(24 + 10 * place[0]), int(16 - 10 * place[1])
        if (np.hypot(*(columns["position"] - place)[:, :2].T) < 0.4).sum() == 1:
            assert (channels["id"][y, x], channels["stream"][y, x]) == (number, 1)
            alone += 1
    assert alone >= 2
    assert channels["stream"][0, 0] == 2


def test_deep_samples_flatten_to_the_picture(tmp_path):
    """Over and add, to float's precision, with exposure in both; sorted by depth; flames hide nothing."""
    emit = {"rate": 400, "set": {"position": {"in_sphere": {"radius": 1}}, "velocity": [3, 0, 0], "opacity": 0.7,
                                 "color": {"rand": [[0, 0, 0], [3, 2, 1]]}, "radius": 0.3}}
    fire = {"type": "emit", "rate": 200, "set": {"position": {"in_sphere": {"radius": 1}}, "radius": 0.4, "opacity": 0.5}}
    image = {"from": ["sky", {"stream": "fire", "blend": "add"}], "bits": 32, "exposure": -1.5}
    flat = read(cooked(tmp_path / "a", emit, image, frame=6, nodes={"fire": fire}))
    deep = read(cooked(tmp_path / "b", emit, image | {"deep": True, "channels": ["stream"]}, frame=6, nodes={"fire": fire}))
    assert set(deep) == {"R", "G", "B", "A", "Z", "id", "stream"}
    np.testing.assert_allclose(flattened(deep), np.stack([flat[name] for name in "RGBA"], axis=-1), atol=3e-6)
    for depth, alpha, stream in zip(deep["Z"].ravel(), deep["A"].ravel(), deep["stream"].ravel(), strict=True):
        assert depth is None or ((np.diff(depth) >= 0).all() and ((alpha == 0) == (stream == 2)).all())


def test_deep_halves_flatten_to_their_precision(tmp_path):
    """Eleven bits of every sample."""
    emit = {"rate": 200, "set": {"position": {"in_sphere": {"radius": 1}}, "opacity": 0.3, "radius": 0.3}}
    flat = read(cooked(tmp_path / "a", emit, {"bits": 32}, frame=6))
    deep = read(cooked(tmp_path / "b", emit, {"deep": True}, frame=6))
    assert deep["R"][16, 24].dtype == np.float16 and deep["Z"][16, 24].dtype == np.float32
    np.testing.assert_allclose(flattened(deep), np.stack([flat[name] for name in "RGBA"], axis=-1), atol=2e-3)


def test_an_exr_keeps_alpha_unless_a_background_is_stated(tmp_path):
    """As compositing wants it; a stated background makes it opaque, `transparent` takes that back."""
    emit = STILL | {"set": {"position": [0, 0, 0], "radius": 1.0, "opacity": 0.5}}
    kept = cooked_channels(tmp_path / "a", emit, {"bits": 32})
    over = cooked_channels(tmp_path / "b", emit, {"bits": 32, "background": [0.25, 0, 2]})
    without = cooked_channels(tmp_path / "c", emit, {"bits": 32, "background": [0.25, 0, 2], "transparent": True})
    assert kept["A"][0, 0] == 0 and 0 < kept["A"][16, 24] < 1 and (over["A"] == 1).all()
    for name, behind in zip("RGB", (0.25, 0, 2), strict=True):
        np.testing.assert_allclose(over[name], kept[name] + (1 - kept["A"]) * behind, rtol=1e-6)
        np.testing.assert_array_equal(without[name], kept[name])


def test_an_exr_says_what_it_shows(tmp_path):
    """Frame, time, names, and matrices that lead a particle's place to the camera and into the picture."""
    place = np.array([0.7, -0.4, 1.0, 1.0])
    camera = {"type": "camera", "position": [1, 2, 6], "target": [0.5, 0, 0]}
    emit = STILL | {"set": {"position": list(place[:3]), "radius": 0.02}}
    file = cooked(tmp_path, emit, {"channels": ["depth"]}, camera=camera, frame=4)
    said, channels = header(file), read(file)
    assert (said["frame"], said["time"], said["graph"], said["seed"]) == (4, 0.125, "test", "3")
    right, up, ahead, one = place @ said["worldToCamera"]
    x, y, depth, w = place @ said["worldToNDC"]
    at = int(y / w * 32), int(x / w * 48)
    assert channels["A"][at] > 0 and one == 1
    np.testing.assert_allclose([channels["Z"][at], depth], ahead, rtol=1e-6)
    np.testing.assert_allclose([x / w, y / w], [0.5 + 35 / 36 * right / ahead, 0.5 - 35 / 36 * up / ahead * 48 / 32], rtol=1e-5)


def test_channels_of_a_film():
    """In Python, a film has them by the names that the file gives them; the picture does not change."""
    plain = made((), MOVING, None, {"file": "x.##.exr"}).film(3)
    film = made((), MOVING, None, {"file": "x.##.exr", "channels": ALL}).film(3)
    assert list(film.channels) == ["Z", "velocity.X", "velocity.Y", "world_velocity.X", "world_velocity.Y", "world_velocity.Z",
                                   "id", "stream"]
    assert film.pixels.tobytes() == plain.pixels.tobytes() and not plain.channels


def test_the_plan_keeps_what_channels_read():
    """Ids and tails are stored where a channel wants them, and the listing says for whom; else they are not."""
    image = {"file": "x.##.exr", "shutter": 0}
    bare = made((), MOVING, None, image).plan.emitters["sky"].attributes
    assert not {"id", "tail"} & set(bare.columns)
    found = made((), MOVING, None, image | {"channels": ["id", "velocity"]}).plan.emitters["sky"].attributes
    assert (found.reasons["id"], found.reasons["tail"]) == ("read by the renderer", "where the shutter opened, for motion blur")
    deep = made((), MOVING, None, image | {"deep": True}).plan.emitters["sky"].attributes
    assert "id" in deep.columns and "tail" not in deep.columns


def test_threads_change_no_byte(tmp_path):
    """One thread and three write the same files."""
    emit = {"rate": 300, "set": {"position": {"in_sphere": {"radius": 1}}, "radius": 0.3}}
    for image in ({"channels": ALL}, {"deep": True, "channels": ALL}):
        files = [made((), emit, None, {"file": "x.##.exr", **image}).cook(tmp_path / str(threads), [5], threads)[0]
                 for threads in (1, 3)]
        assert files[0].read_bytes() == files[1].read_bytes()


def test_background_pictures(tmp_path):
    """A picture beside the graph is behind the particles, in files, frames and EXRs alike."""
    from PIL import Image

    picture = np.random.default_rng(0).integers(0, 256, (32, 48, 3), np.uint8)
    Image.fromarray(picture).save(tmp_path / "sky.png")
    given = graph((), {"rate": 0}, None, {"background_image": "sky.png"})
    given["nodes"]["linear"] = given["nodes"]["frames"] | {"file": "y.exr", "bits": 32}
    found = effect(given, (), tmp_path)
    file, light = found.cook(tmp_path / "out", [1])
    with Image.open(file) as opened:
        np.testing.assert_array_equal(np.asarray(opened), picture)
    np.testing.assert_array_equal(np.asarray(found.frame(1)), picture)
    np.testing.assert_allclose(read(light)["G"], ((picture[..., 1] / 255 + 0.055) / 1.055) ** 2.4, atol=2e-3)


@pytest.mark.parametrize("deep", [False, True])
def test_polygons_alone(tmp_path, deep):
    """A picture without particles has the channels too: the depth of what it shows, and 0."""
    nodes = {"box": {"type": "mesh_box"}, "wall": {"type": "polygons", "geometry": "box", "shading": "unlit"}}
    image = {"from": "wall", "channels": ALL, "deep": deep, "bits": 32}
    channels = read(cooked(tmp_path, {"rate": 0}, image, nodes=nodes))
    middle = {name: np.atleast_1d(channel[16, 24]) for name, channel in channels.items()}
    assert middle["Z"][0] == pytest.approx(4.5, rel=1e-5) and middle["A"][0] == 1
    assert all(middle[name][0] == 0 for name in ("id", "stream", "velocity.X", "world_velocity.Z"))


def test_exposure_and_background_may_change_with_time(tmp_path):
    """Each frame has those of its time, as picture, as light and as samples; a transparent backdrop shows the colour."""
    from PIL import Image

    Image.fromarray(np.array([[[255, 0, 0, 51]]], np.uint8)).save(tmp_path / "glass.png")
    changing = {"exposure": {"expr": "24 * time"}, "background": {"expr": "vec(0, 12 * time, 0)"}, "bits": 32}
    emit = STILL | {"count": 1, "set": {"position": [0, 0, 0], "radius": 1, "color": [0.125, 0, 0]}}
    given = graph((), emit, None, {"camera": "look", "file": "a.##.exr", **changing}, {"look": FLAT})
    given["nodes"]["b"] = given["nodes"]["frames"] | {"file": "b.##.exr", "deep": True}
    given["nodes"]["c"] = given["nodes"]["frames"] | {"file": "c.##.png", "bits": 8, "background_image": "glass.png"}
    out = tmp_path / "out"
    effect(given, (), tmp_path).cook(out, [1, 2])
    first, light, samples = (read(out / name) for name in ("a.01.exr", "a.02.exr", "b.02.exr"))
    assert first["R"][16, 24] == pytest.approx(0.125, rel=0.1) and first["G"][0, 0] == 0
    assert light["R"][16, 24] == pytest.approx(0.25, rel=0.1) and light["G"][0, 0] == 0.5
    assert samples["R"][16, 24][0] == pytest.approx(0.25, rel=0.1)
    with Image.open(out / "c.02.png") as opened:
        assert opened.getpixel((0, 0)) == (124, 170, 0)
