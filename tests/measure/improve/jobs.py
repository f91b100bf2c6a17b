"""Jobs for measurements of quality: meshes, movements of their walls and options, all from one seed.

usage: jobs.py FOLDER [SEED]   Leaves NAME.su2 and NAME.field in the folder, and jobs.txt with the lines
NAME KIND MOVEMENT MARKERS OPTIONS: `harmorph displace NAME.su2 --given MARKERS --wall NAME.field OPTIONS` is the job.
"""

import os
import sys

import numpy as np
import meshes
from meshes import Mesh

SEED = 54


# ---- Movements of wall points z (complex) of a section from x = 0 to 1; they return displacements ----


def turn(z, degrees, centre=0.25):
    return (z - centre) * (np.exp(1j * np.radians(degrees)) - 1)


def ramp(x, begin, end):
    t = np.clip((x - begin) / (end - begin), 0, 1)
    return t * t * (3 - 2 * t)


def camber(z, height):
    return 4j * height * z.real * (1 - z.real)


def flap(z, degrees, hinge=0.7, smooth=0.1):
    """What is behind the hinge turns downwards."""
    return (z - hinge) * (np.exp(-1j * np.radians(degrees) * ramp(z.real, hinge - smooth, hinge + smooth)) - 1)


def wave(z, height, number=2.0, phase=0.3):
    """A travelling wave that grows along the chord, as a fish swims."""
    return 1j * height * (0.2 + 0.8 * z.real**2) * np.sin(2 * np.pi * (number * z.real - phase))


def bump(z, height, at=0.35, width=0.05):
    """The upper side rises as a Gaussian."""
    upper = z.imag > np.interp(z.real, [0, 1], [0, 0])
    return 1j * height * np.exp(-(((z.real - at) / width) ** 2)) * upper


def growth(z, factor):
    """The thickness grows by this factor."""
    return 1j * (factor - 1) * z.imag


def horn(z, height, width=0.03):
    """The nose grows forward and upward."""
    return height * np.exp(1j * np.radians(125)) * np.exp(-((abs(z - z[z.real.argmin()]) / width) ** 2))


def plunge(z, distance):
    return np.full(len(z), 1j * distance)


SECTION = {"camber": (camber, 0.38), "flap": (flap, 65.0), "wave": (wave, 0.12), "bump": (bump, 0.14),
           "rotation": (turn, 90.0), "growth": (growth, 3.5), "horn": (horn, 0.16), "plunge": (plunge, -3.0)}


# ---- Movements of a floor of the length 1 ----


def arc(z, height):
    return 4j * height * z.real * (1 - z.real)


def floor_wave(z, height, number=3):
    return 1j * height * np.sin(np.pi * number * z.real) ** 2 * np.sin(2 * np.pi * z.real + 0.6)


def throat(z, height):
    return 0.5j * height * (1 - np.cos(2 * np.pi * z.real))


def lean(z, height):
    """A hill whose top leans over to the right."""
    hill = np.exp(-(((z.real - 0.45) / 0.14) ** 2)) * ramp(z.real, 0, 0.15) * ramp(1 - z.real, 0, 0.15)
    return (0.6 + 1j) * height * hill


FLOOR = {"bump": (arc, 0.55), "wave": (floor_wave, 0.45), "gap": (throat, 0.75), "growth": (lean, 0.5)}


class Job:
    """One mesh, the displacements of the points on the markers `given`, and options of the program."""

    def __init__(self, name, kind, movement, mesh, given, displacement, options=()):
        self.name, self.kind, self.movement, self.mesh = name, kind, movement, mesh
        self.given, self.options = tuple(given), tuple(options)
        self.points = mesh.on(*given)
        self.displacement = displacement

    def write(self, folder):
        self.mesh.write(f"{folder}/{self.name}.su2")
        with open(f"{folder}/{self.name}.field", "w") as file:
            for point, by in zip(self.points, self.displacement):
                print(f"{point} {by.real:.17g} {by.imag:.17g}", file=file)


def _joined(mesh, name, *markers):
    """The mesh with these markers as one."""
    sides = {k: v for k, v in mesh.sides.items() if k not in markers}
    sides[name] = np.concatenate([mesh.sides[k] for k in markers])
    return Mesh(mesh.points, *mesh.cells, sides)


def section_meshes(random):
    """Kinds of meshes round sections."""
    def between(low, high):
        return int(random.integers(low, high))

    around = between(64, 80)
    layered = 1 + np.array(meshes.heights(40.0, between(40, 48), random.uniform(3e-4, 8e-4)))
    yield "isotropic-quads", meshes.o_mesh(around, np.exp(2 * np.pi / around * np.arange(int(0.57 * around))), -0.08)
    yield "layered", meshes.o_mesh(between(88, 112), layered, -0.1)
    around = between(60, 72)
    yield "isotropic-rings", meshes.o_mesh(around, np.exp(np.pi * 3**0.5 / around * np.arange(int(0.66 * around))),
                                           -0.07, kind="triangles")
    yield "isotropic", meshes.free([meshes.naca(between(90, 110), random.uniform(0.09, 0.14))], ["airfoil"], random)
    yield "hybrid", meshes.free([meshes.naca(between(100, 130), random.uniform(0.1, 0.14), 0.02)], ["airfoil"], random,
                                layers=between(9, 14), first=random.uniform(3e-4, 1e-3))


def section_jobs(random):
    for kind, mesh in section_meshes(random):
        z = mesh.points[mesh.on("airfoil")]
        for movement, (move, most) in SECTION.items():
            yield Job(f"{kind}-{movement}", kind, movement, mesh, ["airfoil"], move(z, random.uniform(0.4, 1.2) * most))


def channel_jobs(random):
    for kind, first, triangles in (("structured", None, False), ("structured-layered", 1e-3, False),
                                   ("isotropic-channel", None, True)):
        height = random.uniform(0.3, 0.5)
        columns = int(random.integers(40, 64))
        rows = int(columns * height) if first is None else int(random.integers(18, 30))
        whole = meshes.channel(columns, rows, 1.0, height, first and first * random.uniform(0.3, 1), triangles)
        mesh = _joined(whole, "far", "top", "in", "out")
        z = mesh.points[mesh.on("floor")]
        for movement, (move, most) in FLOOR.items():
            by = move(z, random.uniform(0.7, 1.15) * most * height)
            yield Job(f"{kind}-{movement}", kind, movement, mesh, ["floor"], by)


def other_jobs(random):
    """Walls that turn against others with slip between, a step, two sections in tandem."""
    for kind, first in (("turned", None), ("turned-layered", 2e-3)):
        columns = int(random.integers(20, 40))
        mesh = meshes.channel(columns, columns // 2, 1.0, 0.5, first)
        z = mesh.points[mesh.on("floor")]
        for centre in (0.25, 0.5):
            by = turn(z, random.uniform(18, 32), centre)
            yield Job(f"{kind}-{centre}", kind, "rotation", mesh, ["floor"], by, ["--slip", "in,out"])
    mesh = meshes.step(60, 24, 2.0, 0.8, 8, 20)
    z = mesh.points[mesh.on("floor")]
    for movement, height, width in (("bump", 0.3, 0.18), ("growth", 0.42, 0.25)):
        by = 1j * random.uniform(0.8, 1.1) * height * np.exp(-(((z.real - 1.2) / width) ** 2)) * (z.imag < 1e-9)
        by *= ramp(z.real, 0.67, 0.9)
        yield Job(f"step-{movement}", "step", movement, mesh, ["floor"], by)
    gap = random.uniform(0.1, 0.2)
    rear = 1 + gap + 0.6 * (meshes.naca(60, 0.12) - 0.02j)
    mesh = meshes.free([meshes.naca(90, 0.12), rear], ["front", "rear"], random)
    given = mesh.on("front", "rear")
    z, at_rear = mesh.points[given], np.isin(given, mesh.on("rear"))
    for movement, by in (("gap", -random.uniform(0.3, 0.6) * gap), ("rotation", turn(z, -35, 1 + gap)),
                         ("camber", 1j * random.uniform(0.15, 0.3) * 4 * (z.real - 1 - gap) * (1.6 + gap - z.real))):
        yield Job(f"tandem-{movement}", "tandem", movement, mesh, ["front", "rear"], np.where(at_rear, by, 0))


def known_jobs(random):
    """The kinds of some jobs that are known to be hard, made anew."""
    for columns, rows, height, first, part in ((42, 20, 0.3, 1e-3, 0.4), (42, 20, 0.3, 1e-3, 0.6),
                                               (58, 30, 0.3, 1e-4, 0.8), (78, 40, 0.5, 1e-4, 0.9)):
        mesh = _joined(meshes.channel(columns, rows, 1.0, height, first), "far", "top", "in", "out")
        by = arc(mesh.points[mesh.on("floor")], height * (part + random.uniform(-0.02, 0.02)))
        yield Job(f"known-channel-{part}", "structured-layered", "bump", mesh, ["floor"], by)
    mesh = meshes.free([meshes.naca(102, 0.12)], ["airfoil"], random)
    z = mesh.points[mesh.on("airfoil")]
    for movement, by in (("camber", camber(z, 0.3)), ("bump", bump(z, 0.08, width=0.055)), ("wave", wave(z, 0.085))):
        yield Job(f"known-{movement}", "isotropic", movement, mesh, ["airfoil"], by)
    mesh = meshes.free([meshes.naca(150, 0.12, 0.02)], ["airfoil"], random, layers=20, first=1e-4)
    by = flap(mesh.points[mesh.on("airfoil")], 95.0, smooth=0.15)
    yield Job("known-flap", "hybrid", "flap", mesh, ["airfoil"], by)
    for columns, degrees in ((18, 38), (30, 40)):
        mesh = meshes.channel(columns, columns // 2, 1.0, 0.5)
        by = turn(mesh.points[mesh.on("floor")], degrees)
        yield Job(f"known-turned-{degrees}", "turned", "rotation", mesh, ["floor"], by, ["--slip", "in,out"])


def jobs(seed=SEED):
    """All jobs of a seed."""
    for k, make in enumerate((section_jobs, channel_jobs, other_jobs, known_jobs)):
        yield from make(np.random.default_rng([seed, k]))


def write(folder, seed=SEED):
    """Write all jobs of a seed, and return them."""
    os.makedirs(folder, exist_ok=True)
    made = list(jobs(seed))
    for job in made:
        job.write(folder)
    with open(f"{folder}/jobs.txt", "w") as file:
        for job in made:
            print(job.name, job.kind, job.movement, ",".join(job.given), *job.options, file=file)
    return made


if __name__ == "__main__":
    write(sys.argv[1], int(sys.argv[2]) if len(sys.argv) > 2 else SEED)
