"""Meshes from arrays in every layout."""

import copy
import pickle

import harmorph
import numpy as np
import pytest
from conftest import ring, ring_mesh

SQUARE = np.array([[0, 0], [1, 0], [2, 0], [0, 1], [1, 1], [2, 1]], float)
EDGES = {"low": [0, 1, 2], "rest": [[2, 5], [5, 4], [4, 3], [3, 0]]}
LAYOUTS = {
    "triangles": [[0, 1, 4], [0, 4, 3], [1, 2, 5], [1, 5, 4]],
    "quads": [[0, 1, 4, 3], [1, 2, 5, 4]],
    "quads with triangles": [[0, 1, 4, 3], [1, 2, 5, 5], [1, 5, 4, 4]],
    "mixed": (np.array([[1, 2, 5], [1, 5, 4]]), np.array([[0, 1, 4, 3]])),
    "rows": ([0, 4, 7, 10], [0, 1, 4, 3, 1, 2, 5, 1, 5, 4]),
}


@pytest.mark.parametrize("layout", LAYOUTS)
def test_layouts(layout):
    mesh = harmorph.Mesh(SQUARE, LAYOUTS[layout], EDGES)
    found = mesh.report()
    assert found.boundary_edges == 6 and found.inverted == 0 and found.points == 6
    assert found.cells == mesh.n_cells == found.triangles + found.quads
    start, points = mesh.cell_rows()
    x, y = SQUARE.T
    area = 0
    for a, b in zip(start[:-1], start[1:]):
        one = points[a:b]
        area += 0.5 * (x[one] * np.roll(y[one], -1) - y[one] * np.roll(x[one], -1)).sum()
    assert area == pytest.approx(2, abs=1e-15)


def test_polygons():
    points = np.array([[0, 0], [1, 0], [2, 0], [2, 1], [0, 1], [0, -1], [1, -1], [2, -1]], float)
    rows = ([0, 5, 9, 13], [0, 1, 2, 3, 4, 5, 6, 1, 0, 6, 7, 2, 1])
    edges = {"wall": [[5, 6], [6, 7], [7, 2], [2, 3], [3, 4], [4, 0], [0, 5]]}
    assert harmorph.Mesh(points, rows, edges).report().polygons == 1
    quads = harmorph.Mesh(SQUARE, LAYOUTS["quads"], EDGES, polygons=True)
    assert quads.report().quads == 2


def test_markers_have_names_and_numbers():
    mesh = harmorph.Mesh(SQUARE, LAYOUTS["quads"], {"b": [0, 1], "a": [1, 2], 1: EDGES["rest"]})
    assert mesh.markers == {1: 1, "a": 0, "b": 2}
    assert mesh.marker("b") == 2 and mesh.names == {0: "a", 2: "b"}
    assert mesh.numbers_of(["a", 1]) == [0, 1] and mesh.numbers_of("b") == [2]
    assert mesh.faces("b").tolist() == [[0, 1]]


def test_points_are_viewed(curves):
    points = ring()
    mesh = harmorph.Mesh.structured(points, j_min="wall", j_max="far")
    assert np.shares_memory(mesh.points, points)
    x, y = np.ascontiguousarray(points.reshape(-1, 2).T)
    pair = harmorph.Mesh((x, y), mesh.cell_rows(), {"wall": mesh.faces("wall"), "far": mesh.faces("far")})
    assert pair.points[0] is x and pair.points[1] is y
    assert pair.report().min_area == pytest.approx(mesh.report().min_area)
    single = harmorph.Mesh.structured(points.astype(np.float32), j_min="wall", j_max="far")
    assert single.points.dtype == np.float64


def test_blocks():
    whole = ring(9, 5)
    one = harmorph.Mesh.structured(whole, j_min="wall", j_max="far")
    two = harmorph.Mesh.blocks([whole[:, :5], whole[:, 4:]],
                               [(None, None, "wall", "far"), (None, None, "wall", "far")])
    assert two.n_points == one.n_points + 5 and two.n_cells == one.n_cells
    assert two.report().min_area == one.report().min_area


def test_the_wall_in_order(mesh):
    points, is_loop = mesh.wall("wall")
    assert is_loop and len(points) == 64
    x, y = mesh.points[points].T
    assert 0.5 * (x * np.roll(y, -1) - y * np.roll(x, -1)).sum() < 0  # clockwise around the body
    with pytest.raises(harmorph.Error):
        mesh.wall(["wall"], piece=1)


@pytest.mark.parametrize("points, cells, boundary, words", [
    (SQUARE, [[0, 1]], EDGES, "3 or 4 columns"),
    (SQUARE, [[0.0, 1.0, 4.0]], EDGES, "integers"),
    (SQUARE, [[0, 1, 2**40]], EDGES, "beyond 32 bits"),
    (SQUARE, ([0, 2, 5], [0, 1, 4, 3, 1]), EDGES, "Cell 0 has 2 points"),
    (SQUARE, ([0, 3], [0, 1, 4, 3]), EDGES, "must begin with 0 and end with 4"),
    (SQUARE, (np.zeros((1, 4), int), np.zeros((1, 4), int)), EDGES, "triangles of shape"),
    (SQUARE[:, :1], LAYOUTS["quads"], EDGES, "shape"),
    (SQUARE * 1j, LAYOUTS["quads"], EDGES, "real numbers"),
    (SQUARE, LAYOUTS["quads"], [[0, 1]], "dict"),
    (SQUARE, LAYOUTS["quads"], {"a": [[0, 1, 2]]}, "marker 'a'"),
    (SQUARE, LAYOUTS["quads"], {"a": 3}, "marker 'a'"),
    (SQUARE, LAYOUTS["quads"], {0.5: [0, 1]}, "a name or an integer"),
    (SQUARE, LAYOUTS["quads"], {2**31: [0, 1]}, "beyond 32 bits"),
])
def test_wrong_arrays_are_refused(points, cells, boundary, words):
    with pytest.raises(harmorph.Error, match=words):
        harmorph.Mesh(points, cells, boundary)


@pytest.mark.parametrize("cells, boundary, kind", [
    ([[0, 1, 6, 3]], EDGES, "cell"),
    ([[0, 1, 0, 3], [1, 2, 5, 4]], EDGES, "cell"),
    (LAYOUTS["quads"], {"low": [0, 1, 2]}, None),
])
def test_wrong_meshes_are_refused_by_the_library(cells, boundary, kind):
    mesh = harmorph.Mesh(SQUARE, cells, boundary)
    with pytest.raises(harmorph.Error) as refused:
        mesh.report()
    assert refused.value.code == harmorph.Error.BAD_MESH
    assert kind is None or refused.value.kind == kind


@pytest.mark.parametrize("again", [copy.copy, copy.deepcopy, lambda one: pickle.loads(pickle.dumps(one))])
def test_copies(mesh, again):
    other = again(mesh)
    assert vars(other.report()) == vars(mesh.report()) and other.markers == mesh.markers
    moved = mesh.with_points(mesh.points * 2)
    assert moved.report().min_area == pytest.approx(4 * mesh.report().min_area)
    assert "1105 points" in repr(other)


def test_pictures():
    import xml.etree.ElementTree as tree

    mesh = far_ring(17, 0.5)  # the body fills the domain, which has no inset
    svg = mesh._repr_svg_()

    drawn = sum(one.get("d").count("M") for one in tree.fromstring(svg).iter("{http://www.w3.org/2000/svg}path")
                if one.get("class") is None)
    edges = mesh.report().edges + 16  # the edges of the seam twice
    assert drawn == edges
    pyplot = pytest.importorskip("matplotlib.pyplot")
    pyplot.switch_backend("agg")
    axes = mesh.plot()
    assert len(axes.collections[0].get_segments()) == edges
    pyplot.close("all")


def far_ring(layers, growth, fat=0.4):
    angle = 2 * np.pi * (np.arange(65) % 64) / 64
    radius = np.exp(growth * np.arange(layers) / (layers - 1))[:, None]
    points = np.stack([(radius + fat / radius) * np.cos(angle), (radius - fat / radius) * np.sin(angle)], axis=-1)
    return harmorph.Mesh.structured(points, j_min="wall", j_max="far")


@pytest.mark.parametrize("growth", [3.0, 5.0])
def test_bodies_come_first(growth):
    """The picture is around the body, and the whole domain an inset; only what the picture shows is drawn."""
    import xml.etree.ElementTree as tree

    mesh, space = far_ring(33, growth), "{http://www.w3.org/2000/svg}"
    root = tree.fromstring(mesh._repr_svg_())
    insets = root.findall(f"{space}svg")
    assert len(insets) == 1 and insets[0].get("class") == "inset"
    boundary = next(one for one in root.iter(f"{space}path") if one.get("class") == "boundary")
    places = np.array([[float(x) for x in part.split("L")[0].split()] for part in boundary.get("d").split("M")[1:]])
    far, wall = places[:64], places[64:]  # the wall fills a good part of the width; the far boundary is outside
    assert 0.3 * 600 < np.ptp(wall[:, 0]) < 600 and np.ptp(far[:, 0]) > 1200
    drawn = sum(one.get("d").count("M") for one in root.find(f"{space}g") if one.get("class") is None)
    assert drawn < mesh.report().edges
    pyplot = pytest.importorskip("matplotlib.pyplot")
    pyplot.switch_backend("agg")
    axes = mesh.plot()
    assert len(axes.child_axes) == 1 and np.ptp(axes.get_xlim()) < 8
    mesh.plot(ax=axes)
    assert len(axes.child_axes) == 1
    assert not mesh.plot(ax=pyplot.figure().add_subplot(), whole=True).child_axes
    pyplot.close("all")


@pytest.mark.parametrize("points", [20000, 50000])
def test_lines_that_are_close_are_faint(points):
    """Thin cells are drawn faintly, so that no region has an even colour; ink per area is bounded."""
    import xml.etree.ElementTree as tree

    mesh = ring_mesh(ni=points // 100 + 1, nj=100)
    root = tree.fromstring(mesh._repr_svg_())
    ink = 0.0
    for one in root.iter("{http://www.w3.org/2000/svg}path"):
        if one.get("stroke-opacity") is not None:
            ends = np.array([[float(x) for x in pair.split()] for part in one.get("d").split("M")[1:]
                             for pair in part.split("L")]).reshape(-1, 4)
            inside = (ends >= 0).all(axis=1) & (ends <= 600).all(axis=1)
            length = np.hypot(*(ends[:, 2:] - ends[:, :2]).T)[inside].sum()
            ink += 0.4 * float(one.get("stroke-opacity")) * length
    assert 0.05 < ink / (float(root.get("width")) * float(root.get("height"))) < 0.4


def test_meshio():
    meshio = pytest.importorskip("meshio")
    source = meshio.Mesh(
        np.column_stack([SQUARE, np.zeros(6)]),
        [("triangle", [[1, 2, 5], [1, 5, 4]]), ("quad", [[0, 1, 4, 3]]),
         ("line", [[0, 1], [1, 2], [2, 5], [5, 4], [4, 3], [3, 0]])],
        cell_data={"gmsh:physical": [np.zeros(2, int), np.zeros(1, int), np.array([7, 7, 8, 8, 8, 8])]},
        field_data={"low": np.array([7, 1])},
    )
    mesh = harmorph.Mesh.from_meshio(source)
    assert set(mesh.markers) == {"low", 8} and mesh.faces("low").tolist() == [[0, 1], [1, 2]]
    assert mesh.report().triangles == 2 and mesh.report().quads == 1
    with pytest.raises(harmorph.Error, match="no cell data 'tags'"):
        harmorph.Mesh.from_meshio(source, "tags")
    with pytest.raises(harmorph.Error, match="tetra"):
        harmorph.Mesh.from_meshio(meshio.Mesh(np.zeros((4, 3)), [("tetra", [[0, 1, 2, 3]])]))


def test_pictures_of_large_meshes_are_small():
    assert len(ring_mesh(ni=901, nj=301)._repr_svg_()) < 3e6
