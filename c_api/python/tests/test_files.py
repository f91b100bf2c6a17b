"""Mesh files by the readers of the program."""

import os
import stat

import harmorph
import numpy as np
import pytest

NAMES = ["naca0012.su2", "cascade.su2", "three_element.su2", "block.su2"]


@pytest.mark.parametrize("name", NAMES)
def test_a_file_is_written_as_it_was(meshes, tmp_path, name):
    mesh = harmorph.Mesh.read(meshes / name)
    assert mesh.report().points == mesh.n_points
    mesh.write(tmp_path / "same.su2")
    assert (tmp_path / "same.su2").read_bytes() == (meshes / name).read_bytes()


def test_a_moved_mesh(meshes, tmp_path):
    mesh = harmorph.Mesh.read(meshes / "naca0012.su2")
    moved = mesh.points + np.array([0.25, 0.5])
    mesh.write(tmp_path / "moved.su2", moved)
    again = harmorph.Mesh.read(tmp_path / "moved.su2")
    assert abs(again.points - moved).max() < 1e-14 and again.markers == mesh.markers


@pytest.mark.parametrize("ending", [".su2", ".msh", ".vtk", ".vtu"])
def test_new_files(mesh, tmp_path, ending):
    path = tmp_path / ("new" + ending)
    mesh.write(path)
    again = harmorph.Mesh.read(path)
    assert np.array_equal(again.points, mesh.points) and again.n_cells == mesh.n_cells
    if ending in (".su2", ".msh"):
        assert again.markers == {"far": 0, "wall": 1}
        for name in again.markers:
            assert np.array_equal(np.sort(again.faces(name), axis=None), np.sort(mesh.faces(name), axis=None))


def test_another_format_by_name(meshes, tmp_path):
    mesh = harmorph.Mesh.read(meshes / "naca0012.su2", format="su2")
    mesh.write(tmp_path / "mesh.txt", format="gmsh")
    again = harmorph.Mesh.read(tmp_path / "mesh.txt")
    assert again.markers == mesh.markers and np.array_equal(again.points, mesh.points)


@pytest.mark.parametrize("ending", [".su2", ".msh"])
@pytest.mark.parametrize("names", [("", "wall"), ("far", ""), ("", "_")])
def test_an_empty_name_is_written_as_one_that_can_be_read(mesh, tmp_path, ending, names):
    boundary = {name: mesh.faces(old) for name, old in zip(names, ("far", "wall"))}
    given = harmorph.Mesh(mesh.points, mesh.cell_rows(), boundary)
    path = tmp_path / ("mesh" + ending)
    given.write(path)
    again = harmorph.Mesh.read(path)
    assert len(again.markers) == 2 and "" not in again.markers
    for name in names:
        if name and names != ("", "_"):
            assert len(again.faces(name)) == len(given.faces(name))
    assert sorted(len(again.faces(name)) for name in again.markers) == sorted(
        len(given.faces(name)) for name in names)


def test_names_of_groups_that_are_empty_in_a_file(mesh, tmp_path):
    mesh.write(tmp_path / "mesh.msh")
    text = (tmp_path / "mesh.msh").read_text()
    (tmp_path / "mesh.msh").write_text(text.replace('"wall"', '""'))
    again = harmorph.Mesh.read(tmp_path / "mesh.msh")
    assert len(again.markers) == 2 and "" not in again.markers and "far" in again.markers


def test_remarks(meshes, tmp_path):
    text = (meshes / "naca0012.su2").read_text()
    (tmp_path / "odd.su2").write_text(text + "\nNOTHING= 4\n")
    assert isinstance(harmorph.Mesh.read(tmp_path / "odd.su2").remarks, list)


@pytest.mark.parametrize("data, words", [
    (b"", "the file is empty"),
    (b"\x00\x01\x02 no mesh", "no known mesh file"),
    (b"NDIME= 2\nNELEM= 1\n5 0 1\n", ":3"),
])
def test_damaged_files_are_refused(tmp_path, data, words):
    (tmp_path / "bad.su2").write_bytes(data)
    with pytest.raises(harmorph.Error, match=words) as refused:
        harmorph.Mesh.read(tmp_path / "bad.su2")
    assert refused.value.code == harmorph.Error.BAD_FILE and "bad.su2" in refused.value.text


def test_refusals_of_names(mesh, tmp_path):
    with pytest.raises(harmorph.Error, match="No such file"):
        harmorph.Mesh.read(tmp_path / "none.su2")
    with pytest.raises(harmorph.Error, match="the format .abc. is unknown"):
        harmorph.Mesh.read(tmp_path / "none.su2", format="abc")
    with pytest.raises(harmorph.Error, match="no format has this extension"):
        mesh.write(tmp_path / "mesh.abc")
    with pytest.raises(harmorph.Error, match="cannot be written"):
        mesh.write(tmp_path / "none" / "mesh.su2")
    assert list(tmp_path.iterdir()) == []


def test_a_refused_write_leaves_the_file(meshes, tmp_path):
    mesh = harmorph.Mesh.read(meshes / "naca0012.su2")
    path = tmp_path / "mesh.su2"
    path.write_text("before")
    with pytest.raises(harmorph.Error, match="shape"):
        mesh.write(path, mesh.points[1:])
    assert path.read_text() == "before" and list(tmp_path.iterdir()) == [path]


def test_permissions_stay(mesh, tmp_path):
    path = tmp_path / "mesh.su2"
    path.write_text("before")
    path.chmod(0o640)
    link = tmp_path / "link.su2"
    link.symlink_to(path)
    mesh.write(link)
    assert link.is_symlink() and stat.S_IMODE(os.stat(path).st_mode) == 0o640
    assert path.read_text().startswith("NDIME")


def open_foam(folder):
    """Two cells beside each other, one cell thick, as a case of OpenFOAM."""
    poly = folder / "constant/polyMesh"
    poly.mkdir(parents=True)
    points = [(x, y, z) for z in (0, 1) for y in (0, 1) for x in (0, 1, 2)]
    faces = [(1, 4, 10, 7), (0, 1, 7, 6), (1, 2, 8, 7), (2, 5, 11, 8), (5, 4, 10, 11), (4, 3, 9, 10),
             (3, 0, 6, 9), (0, 3, 4, 1), (1, 4, 5, 2), (6, 7, 10, 9), (7, 8, 11, 10)]
    patches = {"low": ("wall", 2, 1), "rest": ("patch", 4, 3), "sides": ("empty", 4, 7)}

    def write(name, kind, entries):
        text = f"FoamFile\n{{ version 2.0; format ascii; class {kind}; object {name}; }}\n"
        (poly / name).write_text(text + f"{len(entries)}\n(\n" + "\n".join(entries) + "\n)\n")

    write("points", "vectorField", [f"({x} {y} {z})" for x, y, z in points])
    write("faces", "faceList", ["4(" + " ".join(map(str, face)) + ")" for face in faces])
    write("owner", "labelList", list("00111000101"))
    write("neighbour", "labelList", ["1"])
    write("boundary", "polyBoundaryMesh", [
        f"{name} {{ type {kind}; nFaces {n}; startFace {first}; }}" for name, (kind, n, first) in patches.items()])
    return poly


def test_a_case_of_openfoam(tmp_path):
    import shutil

    poly = open_foam(tmp_path / "case")
    mesh = harmorph.Mesh.read(tmp_path / "case")
    assert (mesh.n_points, mesh.n_cells, set(mesh.markers)) == (6, 2, {"low", "rest"})
    shutil.copytree(tmp_path / "case", tmp_path / "copy")
    mesh.write(tmp_path / "copy", mesh.points * [1.0, 0.5])
    again = harmorph.Mesh.read(tmp_path / "copy")
    assert np.array_equal(again.points, mesh.points * [1.0, 0.5])
    before, after = ((tmp_path / name / "constant/polyMesh/points").read_text() for name in ("case", "copy"))
    assert before != after and before.split("(")[0] == after.split("(")[0]
    for name in ("faces", "owner", "neighbour", "boundary"):
        assert (poly / name).read_bytes() == (tmp_path / "copy/constant/polyMesh" / name).read_bytes()


def test_compressed_files(meshes, tmp_path):
    import gzip

    data = (meshes / "naca0012.su2").read_bytes()
    (tmp_path / "mesh.su2.gz").write_bytes(gzip.compress(data))
    try:
        mesh = harmorph.Mesh.read(tmp_path / "mesh.su2.gz")
    except harmorph.Error as refused:
        assert "zlib" in refused.text
        pytest.skip("the extension was built without zlib")
    mesh.write(tmp_path / "moved.su2.gz", mesh.points + 1.0)
    assert gzip.decompress((tmp_path / "moved.su2.gz").read_bytes()).startswith(data[:20])
    with pytest.raises(harmorph.Error, match="must end in .gz"):
        mesh.write(tmp_path / "moved.su2")


def test_the_formats_that_a_refusal_lists_are_those_of_the_package(tmp_path):
    with pytest.raises(harmorph.Error, match="plot3d") as refused:
        harmorph.Mesh.read(tmp_path / "a.su2", format="SU2")
    assert "cgns" not in str(refused.value)


def test_names_beside_a_mesh_go_with_the_file(tmp_path):
    names = "1\n1 9 3 2\nwall 1 5 1 2 1 9\nfar 1 6 1 2 1 9\none_to_one 1 3 1 3 1 2 1 4 1 3 1 2 false\n"
    angle, radius = np.meshgrid(np.linspace(0, 2 * np.pi, 9), [1.0, 2.0, 4.0])
    x, y = radius * np.cos(angle), radius * np.sin(angle)
    values = [*x.flat, *x.flat, *y.flat, *y.flat, *np.zeros(27), *np.ones(27)]
    (tmp_path / "ring.p3d").write_text("1\n9 3 2\n" + "\n".join(repr(float(one)) for one in values) + "\n")
    (tmp_path / "ring.nmf").write_text(names)
    mesh = harmorph.Mesh.read(tmp_path / "ring.p3d")
    mesh.write(tmp_path / "wide.p3d", 2 * mesh.points)
    assert (tmp_path / "wide.nmf").read_text() == names
    assert list(harmorph.Mesh.read(tmp_path / "wide.p3d").markers) == list(mesh.markers)
    (tmp_path / "wide.nmf").write_text(names.replace("wall", "wing"))
    mesh.write(tmp_path / "wide.p3d")
    assert "wing" in harmorph.Mesh.read(tmp_path / "wide.p3d").markers
    mesh.write(tmp_path / "other.su2")
    assert not (tmp_path / "other.nmf").exists() and (tmp_path / "ring.nmf").read_text() == names
