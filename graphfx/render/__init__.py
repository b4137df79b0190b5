"""Particles to pixels: camera, streaks, exact hidden surfaces, film."""

from graphfx.render.camera import Camera
from graphfx.render.film import Film
from graphfx.render.polygons import Light, Lighting, Polygons
from graphfx.render.renderer import render
from graphfx.render.streaks import Streaks
from graphfx.render.textures import Texture

__all__ = ["Camera", "Film", "Light", "Lighting", "Polygons", "Streaks", "Texture", "render"]
