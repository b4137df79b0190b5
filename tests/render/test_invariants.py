"""What must be true of every render, whatever the scene."""

from __future__ import annotations

import numpy as np
import pytest

from graphfx.render import compositing, order
from graphfx.render import scene as scenery
from graphfx.render.camera import Camera
from graphfx.render.falloff import FALLOFFS
from graphfx.render.streaks import Streaks

from .scenes import CAMERA, FLAT, comets, film, sort_all_whole, streaks

PIXELS = Camera(projection="orthographic", view_width=64.0, position=(0, 0, 10))
"""One pixel a metre, 64 wide."""


def one(head, tail=None, radius=0.7, **look) -> Streaks:
    """Return one particle."""
    return Streaks(np.array([head], np.float32).T, None if tail is None else np.array([tail], np.float32).T, radius, **look)


def total(streak: Streaks) -> float:
    """Return the sum of alpha over a picture of 64 x 64 pixels."""
    return float(film(streak, camera=PIXELS, size=(64, 64)).pixels[..., 3].sum(dtype=float))


@pytest.mark.parametrize("threads", [2, 7])
def test_threads_change_no_byte(threads, monkeypatch):
    """Any number of threads gives the same film, deep groups included."""
    monkeypatch.setattr(order, "GRAIN", 16)
    monkeypatch.setattr(scenery, "GRAIN", 16)
    streams = [comets(1, 300), streaks(2, 200, blend="add"), _piercing(300)]
    alone, together = film(*streams), film(*streams, threads=threads)
    assert alone.pixels.tobytes() == together.pixels.tobytes()
    assert (alone.fragments, alone.dropped) == (together.fragments, together.dropped)


def _piercing(count: int) -> Streaks:
    draw = np.random.default_rng(5)
    head, tail = draw.uniform(-1, 1, (3, count)), draw.uniform(-1, 1, (3, count))
    head[2], tail[2] = 3.0, -20.0
    return Streaks(head.astype(np.float32), tail.astype(np.float32), 0.3, head_opacity=0.05)


def test_lists_that_overflow_are_sorted(monkeypatch):
    """The scene of piercing streaks does overflow the pending lists."""
    numbers = []
    sort = compositing.render_deep
    monkeypatch.setattr(compositing, "render_deep", lambda *given: numbers.append(given[2]) or sort(*given))
    film(_piercing(300))
    assert numbers


def test_lists_and_whole_sorts_give_the_same_bytes(monkeypatch):
    """A group sorted whole holds what its list would have given, to the last bit."""
    streams = [comets(3, 300), streaks(4, 200, blend="add"), *_tied(200)]
    normal = film(*streams, camera=FLAT).pixels
    sort_all_whole(monkeypatch)
    assert film(*streams, camera=FLAT).pixels.tobytes() == normal.tobytes()


@pytest.mark.parametrize("capacity", [1, 3, 40, 1000])
def test_room_for_whole_sorts_changes_no_byte(capacity, monkeypatch):
    """However few layers there is room for at first, what is sorted whole comes out the same, and so does their number."""
    streams = [comets(3, 300), streaks(4, 200, blend="add"), _piercing(300), *_tied(200)]
    normal = film(*streams, camera=FLAT)
    sort_all_whole(monkeypatch)
    monkeypatch.setattr(compositing, "FIRST_CAPACITY", capacity)
    whole = film(*streams, camera=FLAT)
    assert whole.pixels.tobytes() == normal.pixels.tobytes()
    assert whole.fragments == normal.fragments


def test_tiles_put_aside_untried_hold_what_they_would_have_held(monkeypatch):
    """Beside tiles whose lists overflow, tiles with little or nothing in them are drawn as ever."""
    crowd, few = _piercing(600), streaks(5, 40)
    crowd.head[0], crowd.tail[0] = np.minimum(crowd.head[0], 0.2), np.minimum(crowd.tail[0], 0.2)
    normal = film(crowd, few, size=(200, 32))
    sort_all_whole(monkeypatch)
    whole = film(crowd, few, size=(200, 32))
    assert whole.pixels.tobytes() == normal.pixels.tobytes()
    assert whole.fragments == normal.fragments


def _tied(count: int) -> list[Streaks]:
    """Return still particles, and streaks whose nearer ends are just where those are."""
    still, moving = streaks(31, count, length=0.0), streaks(32, count, radius=(0.2, 0.4))
    moving.tail[:] = still.head
    moving.head[2] = moving.tail[2] - 30 * np.abs(moving.head[0])
    return [still, moving]


@pytest.mark.parametrize("falloff", FALLOFFS)
@pytest.mark.parametrize("streak", ["exposed", "solid"])
@pytest.mark.parametrize("opacity", [0.3, 1.0])
def test_total_of_a_small_particle_is_even_as_it_moves(falloff, streak, opacity):
    """Wherever a particle under a pixel is, and however it is streaked, its total stays within 1 %."""
    draw = np.random.default_rng(6)
    for length in (0.0, 0.3, 2.0, 7.0):
        wanted = FALLOFFS[falloff].area * 0.6**2 + (FALLOFFS[falloff].width * 0.6 * length if streak == "solid" else 0)
        for _ in range(20):
            x, y = draw.uniform(-8, 8, 2)
            angle = draw.uniform(0, 2 * np.pi)
            tail = (x + length * np.cos(angle), y + length * np.sin(angle), 0)
            got = total(one((x, y, 0), tail, 0.6, falloff=falloff, streak=streak, head_opacity=opacity))
            assert got == pytest.approx(opacity * wanted, rel=0.01)


@pytest.mark.parametrize("falloff", FALLOFFS)
@pytest.mark.parametrize("radius", [0.3, 1.0, 3.0])
@pytest.mark.parametrize("length", [0.0, 5.0, 13.0, 40.0])
def test_exposed_streak_has_the_total_of_the_still_particle(falloff, radius, length):
    """A faster particle is fainter: opacity summed over the streak is the disc's, whatever the speed."""
    look = {"falloff": falloff, "head_opacity": 0.5}
    heads = [(-20 + i / 8, i / 7, 0) for i in range(8)]
    moving = [total(one((x, y, z), (x + length * 0.8, y + length * 0.6, z), radius, **look)) for x, y, z in heads]
    disc = 0.5 * FALLOFFS[falloff].area * radius**2
    assert np.mean(moving) == pytest.approx(disc, rel=0.03 + (0.1 if falloff == "disc" else 0) / max(radius, 1))


def test_share_of_the_shutter_scales_the_exposed_alone():
    """A particle alive for a third of the shutter has a third of the opacity; a solid one is solid."""
    for streak, share in (("exposed", 1 / 3), ("solid", 1.0)):
        whole, part = (total(one((0, 0, 0), (9, 4, 0), 3.0, streak=streak, share=s, head_opacity=0.2)) for s in (1.0, 1 / 3))
        assert part == pytest.approx(share * whole, rel=1e-5)


def test_streak_in_two_pieces_exposes_as_one():
    """A streak cut in two, each with its share of the shutter, keeps its total, and nearly (r / L) its brightness."""
    head, middle, tail = (-20.0, 0.3, 0.0), (0.0, 0.3, 0.0), (20.0, 0.3, 0.0)
    whole = film(one(head, tail, 2.0, head_opacity=0.5), camera=PIXELS, size=(64, 64)).pixels[..., 3]
    pieces = film(
        one(head, middle, 2.0, head_opacity=0.5, share=0.5), one(middle, tail, 2.0, head_opacity=0.5, share=0.5),
        camera=PIXELS, size=(64, 64),
    ).pixels[..., 3]
    assert np.abs(whole - pieces)[:, 15:28].max() < 2.0 / 40 * whole.max()
    assert whole.sum() == pytest.approx(pieces.sum(), rel=0.02)


@pytest.mark.parametrize("falloff", FALLOFFS)
def test_shifting_a_scene_by_a_tile_shifts_the_picture(falloff):
    """Pixels do not know their tiles: streaks 8 pixels to the right and 16 down give the same picture there."""
    scene = streaks(7, 40, radius=(0.5, 6.0), length=12.0, spread=12.0, falloff=falloff)
    shifted = Streaks(scene.head + np.float32([[8], [-16], [0]]), scene.tail + np.float32([[8], [-16], [0]]),
                      scene.head_radius, head_color=scene.head_color, head_opacity=scene.head_opacity, falloff=falloff)
    first, second = (film(s, camera=PIXELS, size=(64, 64)).pixels for s in (scene, shifted))
    np.testing.assert_allclose(second[16:, 8:], first[:-16, :-8], rtol=0, atol=2e-5)


def test_film_is_premultiplied():
    """Over-blended colours of at most 1 never exceed alpha, which is at most 1; flames have none."""
    pixels = film(streaks(8, 300, head_opacity=1.0)).pixels
    assert pixels[..., 3].max() <= 1.0 and (pixels[..., :3] <= pixels[..., 3:] + 1e-6).all()
    flames = film(streaks(8, 300, blend="add")).pixels
    assert not flames[..., 3].any() and flames[..., :3].max() > 0.5


def test_opaque_disc_hides_all_behind_it_and_nothing_before():
    """At the centre of an opaque disc only what is nearer shows."""
    behind, disc, before = one((0.5, 0.5, -1), radius=9.0, head_color=(1, 0, 0), falloff="disc"), one(
        (0.5, 0.5, 0), radius=9.0, head_color=(0, 1, 0), falloff="disc"), one(
        (0.5, 0.5, 1), radius=9.0, head_color=(0, 0, 1), falloff="disc", head_opacity=0.25)
    center = film(behind, disc, before, camera=PIXELS, size=(64, 64)).pixels[31, 32]
    np.testing.assert_allclose(center, [0, 0.75, 0.25, 1], atol=1e-6)


def test_nothing_gives_an_empty_film():
    """No streams, and streams of no particles."""
    for scene in ([], [Streaks(np.zeros((3, 0), np.float32))]):
        got = film(*scene)
        assert not got.pixels.any() and got.fragments == got.dropped == 0


def test_uniform_values_are_as_good_as_columns():
    """One number for all particles gives the same bytes as a column of it."""
    head = streaks(9).head
    count = head.shape[1]
    uniform = Streaks(head, None, 0.2, head_color=(0.1, 0.2, 0.3), head_opacity=0.5)
    colors = np.repeat(np.float32([[0.1], [0.2], [0.3]]), count, 1)
    columns = Streaks(
        head, None, np.full(count, 0.2, np.float32), head_color=colors, head_opacity=np.full(count, 0.5, np.float32)
    )
    assert film(uniform, camera=CAMERA).pixels.tobytes() == film(columns, camera=CAMERA).pixels.tobytes()


def test_no_fragment_is_more_than_opaque():
    """An opaque particle of a pixel's radius keeps its total, more than a pixel's, and no pixel's alpha passes 1."""
    look = {"falloff": "linear", "head_opacity": 1.0}
    for x, y in ((0.0, 0.0), (0.5, 0.5), (0.5, 0.0), (0.2, 0.4)):
        for radius in (0.97, 1.0, 1.2):
            alpha = film(one((x, y, 0), None, radius, **look), camera=PIXELS, size=(64, 64)).pixels[..., 3]
            assert alpha.max() <= 1.0
    assert total(one((0.2, 0.4, 0), None, 0.97, **look)) == pytest.approx(np.pi / 3 * 0.97**2, rel=0.01)
