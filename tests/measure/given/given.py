"""Displacements given point by point: the movement of a B-spline, given point by point, moves the mesh as this B-spline
does, and random fields end in a valid mesh or are refused with a reason. Prints a table and "N passed, M failed".

usage: given.py FOLDER [MESH:MARKER or FOLDER ...]   The shipped meshes come always. Of a folder each SU2 file is taken,
with the first marker that is no outer boundary and that a curve can be fitted to. In the environment: SEEDS random
fields of each kind (2), GMSH new meshes of random sections, where gmsh is installed (2), FIRST: the seed of the first
one (1).
"""

import os
import re
import shutil
import subprocess
import sys
import warnings
from pathlib import Path

import numpy as np
import harmorph

# Operators with their engines; the star means multigrid.
WAYS = {"conformal": ("conformal", "direct"), "Laplace": ("laplace", "direct"), "weighted": ("weighted", "direct"),
        "Laplace*": ("laplace", "multigrid"), "weighted*": ("weighted", "multigrid")}
SEEDS, GMSH, FIRST = (int(os.environ.get(name) or usual) for name, usual in (("SEEDS", 2), ("GMSH", 2), ("FIRST", 1)))
counts = {True: 0, False: 0}


def check(holds, what):
    counts[bool(holds)] += 1
    if not holds:
        print(f"FAIL {what}")


def section(seed):
    """The geometry for gmsh: triangles round a random section of NACA's four digits in a rectangle; for even seeds with
    layers of thin quadrilaterals at the wall, marker "wing"."""
    random = np.random.default_rng(seed)
    n, camber, thickness = 40 + int(random.integers(40)), random.uniform(0, 0.08), random.uniform(0.06, 0.22)
    size, k = random.uniform(0.01, 0.03), np.arange(2 * n)
    x = 0.5 * (1 + np.cos(np.pi * k / n))
    half = 5 * thickness * np.polyval([-0.1036, 0.2843, -0.3516, -0.126, 0], x) + 5 * thickness * 0.2969 * np.sqrt(x)
    y = np.where(k <= n, half, -half) + 4 * camber * x * (1 - x)
    corners = [(-4, -4), (6, -4), (6, 4), (-4, 4)]
    points = [(a, b, size) for a, b in zip(x, y)] + [(a, b, 0.8) for a, b in corners]
    lines = [f"Point({i + 1}) = {{{a:.15g}, {b:.15g}, 0, {h}}};" for i, (a, b, h) in enumerate(points)]
    for side in range(2):
        ids = ", ".join(str(i % (2 * n) + 1) for i in range(side * n, (side + 1) * n + 1))
        lines.append(f"Spline({side + 1}) = {{{ids}}};")
    lines += [f"Line({i + 3}) = {{{2 * n + i + 1}, {2 * n + (i + 1) % 4 + 1}}};" for i in range(4)]
    lines.append("Curve Loop(1) = {1, 2}; Curve Loop(2) = {3, 4, 5, 6}; Plane Surface(1) = {2, 1};")
    if seed % 2 == 0:
        lines.append("Field[1] = BoundaryLayer; Field[1].CurvesList = {1, 2}; Field[1].Size = 1e-4; Field[1].Ratio = "
                     "1.25; Field[1].Thickness = .03; Field[1].Quads = 1; Field[1].FanPointsList = {1}; "
                     "BoundaryLayer Field = 1;")
    lines.append('Physical Curve("wing") = {1, 2}; Physical Curve("far") = {3, 4, 5, 6}; '
                 'Physical Surface("air") = {1};')
    return "\n".join(lines) + "\n"


def meshes(folder, words):
    """Pairs of a file and a marker."""
    made = folder.parent / "meshes"
    for word in [f"{made}/naca0012.su2:airfoil", f"{made}/two_bodies.su2:left", *words]:
        if not Path(word).is_dir():
            yield word.rsplit(":", 1)
            continue
        for path in sorted(Path(word).glob("*.su2")):
            mesh = harmorph.Mesh.read(path)
            for marker in mesh.markers:
                if not re.search("far|inlet|outlet|sym", str(marker), re.I) and fit(mesh, marker):
                    yield str(path), marker
                    break
    if GMSH > 0 and not shutil.which("gmsh"):
        print("skipped: meshes of random sections, as gmsh is not installed")
        return
    for seed in range(FIRST, FIRST + GMSH):
        geometry, path = folder / f"section-{seed}.geo", folder / f"section-{seed}.su2"
        geometry.write_text(section(seed))
        subprocess.run(["gmsh", "-2", "-v", "1", geometry, "-format", "su2", "-o", path], check=True)
        yield str(path), "wing"


def fit(mesh, marker):
    try:
        return harmorph.Curves.fit(mesh, marker)
    except harmorph.Error:
        return None


def difference_from_morph(mesh, marker, curves, given, options):
    """The largest difference, in extents of the wall, between the mesh that a B-spline moves and the mesh that is
    displaced as the wall is."""
    functions, wall = harmorph.Morph(mesh, curves, {marker: "curve"}, **options), given.given_points
    extent = np.hypot(*np.ptp(given.start[wall], axis=0))
    expected = functions.displacement(0.01 * extent * np.random.default_rng(7).uniform(-1, 1, (functions.functions, 2)))
    found = given.displace(expected[wall])
    check(np.array_equal(found[wall], expected[wall]), "wall points have the given bits")
    return np.hypot(*(found - expected).T).max() / extent


def field(kind, at, random):
    """Smooth: a few waves along x, 5 % of the extent. Rough: each point by itself, a part of the distance to the
    neighbour. Large: a turn of up to 120 degrees and a shift, with waves."""
    extent, centred = np.hypot(*np.ptp(at, axis=0)), at - at.mean(axis=0)
    turn, shift, phase = 2.1 * random.uniform(-1, 1), 0.2 * extent * random.uniform(-1, 1), random.uniform(-3.2, 3.2, 4)
    s = 2 * np.pi * centred[:, 0] / extent
    if kind == "rough":
        return 0.2 * np.hypot(*(np.roll(at, -1, axis=0) - at).T)[:, None] * random.uniform(-1, 1, at.shape)
    waves = 0.05 * extent * (1 if kind == "smooth" else 0.3) * np.stack([
        0.3 * (np.sin(s + phase[0]) + 0.3 * np.sin(2 * s + phase[1])),
        np.sin(s + phase[2]) + 0.3 * np.sin(3 * s + phase[3])], axis=1)
    if kind == "smooth":
        return waves
    c, d = np.cos(turn), np.sin(turn)
    return waves + centred @ [[c, d], [-d, c]] - centred + shift * np.array([1, 0])


def end_of(morph, wall, by):
    """How a safe displacement ends, after checks that the mesh is valid, or refused with a reason and untouched."""
    out = morph.start.copy()
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        try:
            morph.displace_safe(by, out=out)
        except harmorph.Error as error:
            check(error.code == error.CROSSING and error.text, f"refused: {error.text}")
            check(np.array_equal(out, morph.start), "untouched where refused")
            return "refused"
    quality = morph.assess(points=out, reference=morph.start).quality
    check(quality.inverted == 0, "no inverted cell")
    check(quality.self_crossing == 0, "no crossing")
    codes = [warning.message.code for warning in caught]
    if harmorph.HarmorphWarning.SHORT in codes:
        return "part"
    check(np.array_equal(out[wall], morph.start[wall] + by), "the given wall")
    return "poor" if harmorph.HarmorphWarning.POOR in codes else "reached"


def run(path, marker):
    mesh = harmorph.Mesh.read(path)
    curves, name = harmorph.Curves.fit(mesh, marker), Path(path).stem
    for way, (operator, engine) in WAYS.items():
        options = {"operator": operator, "engine": engine}
        given = harmorph.Morph(mesh, conditions={marker: "given"}, **options)
        worst, wall = difference_from_morph(mesh, marker, curves, given, options), given.given_points
        check(worst <= 1e-9, f"{name}, {way}: the morph by the B-spline, to 1e-9")
        print(f"{name + ':' + str(marker):24} {mesh.n_points:7d}  {way:9} {worst:9.1e} ", end="")
        for kind in ("smooth", "rough", "large"):
            ends = [end_of(given, wall, field(kind, given.start[wall], np.random.default_rng(seed)))
                    for seed in range(SEEDS)]
            print(" ", *(f"{ends.count(end):3d}" for end in ("reached", "poor", "part", "refused")), end="")
        print(flush=True)


print("largest difference from the morph, in extents of the wall (*: by multigrid, to its tolerance of 1e-10);\n"
      "random fields: at the target, poor, part of the way, refused\n"
      f"{'mesh':24} {'points':>7}  {'operator':9} {'morph':>9}  {'smooth':15}  {'rough':15}  {'large':15}")
for path, marker in meshes(Path(sys.argv[1]), sys.argv[2:]):
    run(path, marker)
print(f"{counts[True]} passed, {counts[False]} failed")
sys.exit(counts[False] > 0)
