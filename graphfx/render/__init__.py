"""Particles to pixels: camera, streaks, exact hidden surfaces, film."""

from graphfx.render.camera import Camera
from graphfx.render.film import Film
from graphfx.render.renderer import render
from graphfx.render.streaks import Streaks

__all__ = ["Camera", "Film", "Streaks", "render"]
