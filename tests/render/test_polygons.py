"""What must be true of polygons, whatever the scene."""

from __future__ import annotations

import numpy as np
import pytest

from graphfx.geometry import sphere
from graphfx.render import Light, Lighting, Polygons, surfaces
from graphfx.render.camera import Camera
from graphfx.render.patches import Patch
from graphfx.render.renderer import LEAST_MEMORY, render
from graphfx.render.surfaces import Surfaces
from graphfx.render.triangles import face_normals

from .meshes import CAMERA, film, triangles
from .scenes import comets, sort_all_whole, streaks

PIXELS = Camera(projection="orthographic", view_width=64.0, position=(0, 0, 10))
"""One pixel a metre, 64 wide, x from -32 to 32."""
BEHIND = {"lighting": Lighting((Light((0, 0, -1)),), (0, 0, 0))}


def sheet(z: float = 0.0, width: float = 100.0, height: float = 100.0, centre=(0.0, 0.0), **look) -> Polygons:
    """Return a rectangle that looks to +z."""
    x, y = width / 2, height / 2
    corners = np.array([[-x, -y, 0], [x, -y, 0], [x, y, 0], [-x, y, 0]]) + np.array([*centre, z])
    coordinates = np.array([[[0, 0], [1, 0], [1, 1]], [[0, 0], [1, 1], [0, 1]]], float)
    given = {"shading": "unlit", "coordinates": coordinates}
    return Polygons(corners, np.array([[0, 1, 2], [0, 2, 3]]), **(given | look))


def flat(*polygons, size=(64, 64), **given):
    """Return the pixels of polygons, a metre to a pixel."""
    return film(list(polygons), camera=PIXELS, size=size, **given).pixels


@pytest.mark.parametrize("turn", range(6))
def test_closed_surface_never_shows_what_is_behind(turn):
    """Inside the outline of a fine sphere alpha is exactly 1, and no light of the wall behind comes through its seams."""
    mesh = sphere(1.0, 5)
    draw = np.random.default_rng(turn)
    position = tuple(draw.normal(0, 1, 3) * 2 + [0, 0, 3])
    camera = Camera(position=position, lens=35.0 + 40 * draw.random(), near=1e-3)
    ball = Polygons(mesh.vertices, mesh.triangles, color=(1, 1, 1), shading="unlit")
    wall = Polygons(20 * mesh.vertices, mesh.triangles, color=(0, 0, 9), shading="unlit")
    alone, both = (film(scene, camera=camera, size=(160, 120)).pixels for scene in ([ball], [wall, ball]))
    inside = alone[..., 3] > 0
    for axis, step in ((axis, step) for axis in (0, 1) for step in (-2, -1, 1, 2)):
        inside &= np.roll(inside, step, axis)
    inside[:2] = inside[-2:] = inside[:, :2] = inside[:, -2:] = False
    assert inside.sum() > 1000
    assert (alone[inside] == 1.0).all()
    assert (both[inside] == 1.0).all()
    assert (both[..., 3] == 1.0).all()


@pytest.mark.parametrize("opacity", [1.0, 0.5])
def test_samples_belong_to_one_of_two_triangles(opacity):
    """However a rectangle is cut into triangles, its alpha is that of the rectangle: nothing is covered twice, or not at all."""
    draw = np.random.default_rng(3)
    for _ in range(20):
        middle = draw.uniform(-20, 20, 2)
        corners = np.array([[-25.3, -24.7, 0], [26.1, -25.9, 0], [24.4, 27.2, 0], [-26.6, 23.5, 0], [*middle, 0]])
        if draw.random() < 0.5:
            corners = np.round(corners * 4) / 4 + 1 / 32  # samples lie on edges
        fan = Polygons(corners, np.array([[k, (k + 1) % 4, 4] for k in range(4)]), opacity=opacity, shading="unlit")
        two = Polygons(corners[:4], np.array([[0, 1, 2], [2, 3, 0]]), opacity=opacity, shading="unlit")
        np.testing.assert_allclose(flat(fan), flat(two), rtol=0, atol=1e-6)


def test_coverage_is_the_area():
    """Over many places and turns, the alpha of a pixel at an edge differs from the area covered by 1/16 at most, without bias."""
    draw = np.random.default_rng(4)
    errors = []
    for _ in range(300):
        width, height = draw.uniform(0.2, 9, 2)
        x, y = draw.uniform(-20, 20, 2)
        alpha = flat(sheet(width=width, height=height, centre=(x, y)))[..., 3].astype(float)
        edges = np.arange(-32, 33)
        across, down = (np.diff(np.clip(edges, c - s / 2, c + s / 2)) for c, s in ((x, width), (y, height)))
        errors.append((alpha - np.outer(down[::-1], across))[alpha > 0])
    errors = np.concatenate(errors)
    assert np.sqrt((errors**2).mean()) < 1 / 16 / 1.7
    assert abs(errors.mean()) < 1e-3


def test_slanting_edge_covers_the_area():
    """An edge at any angle: the mean error of alpha along it is less than 1/16, and there is no bias."""
    draw = np.random.default_rng(5)
    errors = []
    for _ in range(200):
        corners = np.zeros((3, 3))
        corners[:, :2] = draw.uniform(-30, 30, (3, 2))
        area = np.linalg.norm(np.cross(corners[1] - corners[0], corners[2] - corners[0])) / 2
        total = flat(Polygons(corners, np.array([[0, 1, 2]]), shading="unlit"))[..., 3].sum(dtype=float)
        perimeter = np.linalg.norm(corners - np.roll(corners, 1, axis=0), axis=1).sum()
        errors.append((total - area) / perimeter)
    assert np.abs(errors).max() < 1 / 16
    assert abs(np.mean(errors)) < 1e-3


def test_transparent_layers_lie_in_their_order():
    """Nearest first, whatever the order in which they are given, and any number of them."""
    colors, opacities = np.eye(3).repeat(20, axis=0), np.linspace(0.02, 0.5, 60)
    expected, through = np.zeros(4), 1.0
    for color, opacity in zip(colors, opacities, strict=True):
        expected += through * opacity * np.array([*color, 1])
        through *= 1 - opacity
    order = np.random.default_rng(6).permutation(60)
    sheets = [sheet(-k, color=colors[k], opacity=opacities[k]) for k in order]
    np.testing.assert_allclose(flat(*sheets)[32, 32], expected, atol=1e-6)


def test_a_sheet_between_particles():
    """A half-transparent sheet dims the half of a cloud that is behind it."""
    still = streaks(1, 40, length=0.0, spread=12, radius=(3, 5), falloff="disc", head_color=(1, 1, 1), head_opacity=1.0)
    still.head[2] = still.tail[2] = np.where(np.arange(40) % 2, 2.0, -2.0)
    alone = flat(Polygons(np.zeros((0, 3)), np.zeros((0, 3), int)))
    assert not alone.any()
    dimmed = film([sheet(color=(0, 0, 0), opacity=0.5)], still, camera=PIXELS, size=(64, 64)).pixels
    near = film([sheet(color=(0, 0, 0))], still, camera=PIXELS, size=(64, 64)).pixels[..., 0]
    whole = film([], still, camera=PIXELS, size=(64, 64)).pixels[..., 0]
    np.testing.assert_allclose(dimmed[..., 0], near + 0.5 * (whole - near), atol=1e-6)


@pytest.mark.parametrize("normal", [(0, 0, 1), (0, 0.6, 0.8), (-0.6, 0.64, 0.48)])
def test_light_is_lambert(normal):
    """Colour times ambient light and the light's colour times the cosine; a surface that looks away has the ambient alone."""
    ball = np.linalg.qr(np.column_stack([normal, np.eye(3)[:, :2]]))[0][:, 1:]
    corners = np.array([-1.0, -1, 1, -1, 0, 1.5]).reshape(3, 2) @ ball.T * 20
    light = Light((0.0, -3.0, -4.0), (2.0, 1.0, 0.5))
    one = Polygons(corners, np.array([[0, 1, 2]]), color=(0.5, 0.25, 1.0))
    pixel = flat(one, lighting=Lighting((light,), (0.1, 0.2, 0.3)))[32, 32]
    facing = face_normals(corners[None])[0]
    facing *= np.sign(facing[2])
    cosine = max(facing @ (0, 0.6, 0.8), 0.0)
    expected = np.array([0.5, 0.25, 1.0]) * (np.array([0.1, 0.2, 0.3]) + cosine * np.array([2.0, 1.0, 0.5]))
    np.testing.assert_allclose(pixel, [*expected, 1.0], rtol=1e-6)


def test_both_sides_are_lit_alike():
    """Seen from behind, a triangle has its normal turned to the viewer."""
    one = sheet(shading="flat")
    other = Polygons(one.vertices, one.triangles[:, ::-1])
    assert flat(one, **BEHIND).tobytes() == flat(other, **BEHIND).tobytes()
    assert flat(one, **BEHIND)[32, 32].tolist() == [1, 1, 1, 1]


SCENES = {
    "loose": lambda: [triangles(1, 40), triangles(2, 20, opacity=0.5)],
    "walls": lambda: [sheet(z, 3 * k + 2, 3 * k + 2, opacity=1.0 if k % 2 else 0.5) for k, z in enumerate((1, 0.3, -0.4, -1))],
    "fine": lambda: [triangles(3, 2000, size=0.05)],
}
CLOUD = [comets(1, 300), streaks(2, 200, blend="add")]


def among(name, threads=1, memory=np.inf, size=(61, 50)):
    return render(CLOUD, CAMERA, None, *size, threads, memory=memory, polygons=SCENES[name]())


@pytest.mark.parametrize("name", SCENES)
def test_leaving_out_what_is_hidden_changes_no_byte(name, monkeypatch):
    """With and without limits the film is the same."""
    culled = among(name)
    make = Surfaces.layers

    def unlimited(self, patch, threads):
        found = make(self, patch, threads)
        found.limits[:] = np.inf
        return found

    monkeypatch.setattr(Surfaces, "layers", unlimited)
    whole = among(name)
    assert culled.pixels.tobytes() == whole.pixels.tobytes()
    assert culled.fragments <= whole.fragments


def test_a_wall_hides_all_work_behind_it():
    """No fragment of a particle behind an opaque sheet is made."""
    behind = streaks(5, 200, spread=20, length=0.0)
    behind.head[2] = behind.tail[2] = -1.0
    assert film([sheet()], behind, camera=PIXELS, size=(64, 64)).fragments == 0
    assert film([sheet(opacity=0.99)], behind, camera=PIXELS, size=(64, 64)).fragments > 0


@pytest.mark.parametrize("name", SCENES)
@pytest.mark.parametrize("threads", [2, 7])
def test_threads_change_no_byte(name, threads, monkeypatch):
    """Any number of threads gives the same film, however the work is cut."""
    alone = among(name)
    monkeypatch.setattr(surfaces, "FIRST_CAPACITY", 1)
    assert among(name, threads).pixels.tobytes() == alone.pixels.tobytes()


@pytest.mark.parametrize("name", SCENES)
def test_patches_change_no_byte(name, monkeypatch):
    """Patch by patch, and a tile slab by slab, the film is the same."""
    whole = among(name)
    monkeypatch.setattr("graphfx.render.renderer.LEAST_MEMORY", 0)
    for memory in (40_000, 12_000, 2_000):
        assert among(name, memory=memory).pixels.tobytes() == whole.pixels.tobytes()


def test_lists_and_whole_sorts_give_the_same_bytes(monkeypatch):
    """Groups that are sorted whole put polygons where lists put them."""
    normal = among("loose").pixels
    sort_all_whole(monkeypatch)
    assert among("loose").pixels.tobytes() == normal.tobytes()


def test_particles_alone_keep_their_bytes():
    """Where polygons are beside the picture, it is as without them."""
    aside = sheet(centre=(1000.0, 0.0))
    with_them = render(CLOUD, CAMERA, None, 61, 50, polygons=[aside]).pixels
    assert with_them.tobytes() == render(CLOUD, CAMERA, None, 61, 50).pixels.tobytes()


@pytest.mark.parametrize("seed", range(4))
def test_film_is_finite(seed):
    """Whatever numbers polygons are made of, the film is finite, and alpha between 0 and 1."""
    draw = np.random.default_rng(seed)
    for _ in range(20):
        wild = draw.choice([-1, 1], (90, 3)) * 10.0 ** draw.uniform(-40, 40 if draw.random() < 0.5 else 300, (90, 3))
        wild = np.where(draw.random((90, 3)) < 0.5, wild, draw.normal(0, 2, (90, 3)))
        scene = triangles(seed, 30, opacity=0.7, shading=str(draw.choice(["flat", "smooth", "unlit"])))
        scene.vertices, scene.color = wild, np.abs(draw.permutation(wild))
        pixels = film([scene], camera=Camera(near=10.0 ** draw.uniform(-12, 0)), size=(40, 30)).pixels
        assert np.isfinite(pixels).all()
        assert pixels[..., 3].min() >= 0.0 and pixels[..., 3].max() <= 1.0


@pytest.mark.parametrize("name", SCENES)
def test_memory_of_layers_is_known_before(name):
    """No tile takes more than it was said to, and where that is too much the picture is made in patches."""
    made = Surfaces(SCENES[name](), Lighting(), CAMERA, 61, 50)
    bound = made.layer_bytes()
    for row, column in np.ndindex(*bound.shape):
        layers = made.layers(Patch(column, row, column + 1, row + 1))
        assert sum(part.nbytes for part in (layers.firsts, layers.keys, layers.masks, layers.values)) <= bound[row, column]
    steps = []
    memory = max(int(bound.sum()) // 2, LEAST_MEMORY)
    whole = render([], CAMERA, None, 610, 500, polygons=SCENES[name]()).pixels
    apart = render([], CAMERA, None, 610, 500, listener=steps.append, memory=memory, polygons=SCENES[name]()).pixels
    assert whole.tobytes() == apart.tobytes()
    wanted = Surfaces(SCENES[name](), Lighting(), CAMERA, 610, 500).layer_bytes().sum()
    assert (steps.count("polygons") > 2) == (wanted > memory)
