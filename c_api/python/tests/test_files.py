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


def test_remarks(meshes, tmp_path):
    text = (meshes / "naca0012.su2").read_text()
    (tmp_path / "odd.su2").write_text(text + "\nNOTHING= 4\n")
    assert isinstance(harmorph.Mesh.read(tmp_path / "odd.su2").remarks, list)


@pytest.mark.parametrize("data, words", [
    (b"", "the file is empty"),
    (b"\x00\x01\x02 no mesh", "no mesh file"),
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
    with pytest.raises(harmorph.Error, match="unknown format"):
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
