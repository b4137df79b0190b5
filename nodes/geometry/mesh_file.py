"""A mesh from a file: OBJ, PLY, STL, glTF (.gltf, .glb), and what else trimesh reads.

Polygons are cut into triangles. What has points alone, such as a PLY of a scan, is a cloud of points. Needs the extra
`mesh`: pip install "graphfx[mesh]".
"""

from graphfx.geometry import Mesh, load_mesh
from graphfx.node import geometry, param


@geometry
def mesh_file(
    file: str = param(type="path", required=True, doc="The file, beside the graph or in a library's graphs folder."),
) -> Mesh:
    """Return the mesh."""
    return load_mesh(file)
