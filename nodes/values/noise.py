"""Smooth noise at a place: patches of colour, density, heat, gusts; neighbours are given much the same.

    vector = u(point / size, rate time),    level = u . x / |x|,  x = (1, 1, 1)

The field u of `curl_noise`: the mean of `vector . vector` is 1, that of `level`^2 is 1/3, and their own mean is 0. One field has
one size; add several, each half as large and half as strong, for finer detail. At points of another stream's attribute, such
as `rest_position`, the patches go along with the particles. [Bridson, Hourihan and Nordenstam 2007; `graphfx.math.noise`]

Also called: noise field, vector noise, turbulence texture.
"""

from graphfx.math import Vec3, curl_noise
from graphfx.node import param, value


@value(results=("level", "vector"))
def noise(
    time: float,
    point: Vec3 = param((0, 0, 0), unit="m", doc="Where it is asked, such as the particle's `position`."),
    size: float = param(1.0, unit="m", min=1e-6, doc="Size of the patches; the field repeats after 289 of them."),
    rate: float = param(0.5, unit="1/s", doc="How often the field has become another; 0 stands still."),
    seed: int = param(0, min=0, max=83520, doc="Another seed is another field."),
) -> tuple[float, Vec3]:
    """Return a number, and a vector, of the same patches."""
    vector = curl_noise(point * (1.0 / size), time * rate, seed)
    return (vector.x + vector.y + vector.z) * 0.5773502691896258, vector
