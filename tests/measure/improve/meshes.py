"""Small meshes of all kinds for measurements of quality, made with numpy and scipy alone: channels, steps, O-meshes,
triangles of any size between given loops, and layers of quadrilaterals inside such triangles. Points are complex."""

import numpy as np
from scipy.spatial import Delaunay, cKDTree


class Mesh:
    """Points [n] (complex), cells: arrays [m, 3] and [m, 4], counter-clockwise; sides: marker -> faces [k, 2]."""

    def __init__(self, points, triangles, quads, sides):
        self.points = np.asarray(points, complex)
        self.cells = [np.asarray(c, int).reshape(-1, n) for n, c in ((3, triangles), (4, quads))]
        self.sides = {name: np.asarray(faces, int) for name, faces in sides.items()}
        assert all((area(self.points[c]) > 0).all() for c in self.cells), "a cell is not counter-clockwise"

    def on(self, *names):
        """The points on these markers."""
        return np.unique(np.concatenate([self.sides[name].ravel() for name in names]))

    def write(self, path):
        with open(path, "w") as file:
            print(f"NDIME= 2\nNELEM= {sum(len(c) for c in self.cells)}", file=file)
            for kind, cells in zip((5, 9), self.cells):
                for cell in cells:
                    print(kind, *cell, file=file)
            print(f"NPOIN= {len(self.points)}", file=file)
            for z in self.points:
                print(f"{z.real:.17g} {z.imag:.17g}", file=file)
            print(f"NMARK= {len(self.sides)}", file=file)
            for name, faces in self.sides.items():
                print(f"MARKER_TAG= {name}\nMARKER_ELEMS= {len(faces)}", file=file)
                for a, b in faces:
                    print(3, a, b, file=file)


def read(path):
    """Read a mesh as Mesh.write leaves it (also others in SU2's format in two dimensions, without comments)."""
    words = iter(open(path).read().replace("=", "= ").split("\n"))
    cells, sides, points = {5: [], 9: []}, {}, []
    for line in words:
        key, _, value = line.partition("=")
        if key.strip() == "NELEM":
            for _ in range(int(value)):
                kind, *numbers = map(int, next(words).split())
                cells[kind].append(numbers[: 3 if kind == 5 else 4])
        elif key.strip() == "NPOIN":
            points = [complex(*map(float, next(words).split()[:2])) for _ in range(int(value.split()[0]))]
        elif key.strip() == "MARKER_TAG":
            count = int(next(words).partition("=")[2])
            sides[value.strip()] = [list(map(int, next(words).split()[1:3])) for _ in range(count)]
    points = np.array(points)
    return Mesh(points, *(oriented(points, np.array(cells[n], int).reshape(-1, k)) for n, k in ((5, 3), (9, 4))), sides)


def oriented(points, cells):
    """The cells counter-clockwise."""
    return np.where((area(points[cells]) < 0)[:, None], cells[:, ::-1], cells)


def cross(u, v):
    return (u.conj() * v).imag


def area(z):
    return 0.5 * cross(z, np.roll(z, -1, axis=1)).sum(axis=1) if len(z) else np.zeros(0)


def heights(total, layers, first):
    """Distances from the wall of layers that grow by one ratio, the first one `first` high; None: of equal height."""
    if first is None or first * layers >= total:
        return total * np.arange(layers + 1) / layers
    low, high = 1 + 1e-12, 10.0
    for _ in range(200):
        ratio = (low * high) ** 0.5
        low, high = (ratio, high) if first * (ratio**layers - 1) / (ratio - 1) < total else (low, ratio)
    level = (ratio ** np.arange(layers + 1) - 1) / (ratio**layers - 1)
    return total * level


def _quads(number):
    """Quadrilaterals of a table of point numbers [rows, columns]; the corners are counter-clockwise."""
    a, b, c, d = number[:-1, :-1], number[:-1, 1:], number[1:, 1:], number[1:, :-1]
    return np.stack([a, b, c, d], axis=-1).reshape(-1, 4)


def _line(numbers):
    return np.stack([numbers[:-1], numbers[1:]], axis=1)


def _halves(number):
    """Two triangles of each quadrilateral; the diagonals alternate in both directions."""
    a, b, c, d = _quads(number).T
    rows, columns = np.array(number.shape) - 1
    odd = ((np.arange(rows)[:, None] + np.arange(columns)) % 2 == 1).reshape(-1, 1)
    return np.where(odd, np.stack([a, b, d, b, c, d], 1), np.stack([a, b, c, a, c, d], 1)).reshape(-1, 3)


def channel(columns, rows, length, height, first=None, triangles=False):
    """A rectangle with the markers floor, top, in and out. first: the height of the first layer at the floor."""
    x, y = np.meshgrid(length * np.arange(columns + 1) / columns, heights(height, rows, first))
    number = np.arange(x.size).reshape(x.shape)
    lines = {"floor": number[0], "top": number[-1], "in": number[:, 0], "out": number[:, -1]}
    sides = {name: _line(line) for name, line in lines.items()}
    return Mesh((x + 1j * y).ravel(), _halves(number) if triangles else [], [] if triangles else _quads(number), sides)


def step(columns, rows, length, height, high, behind):
    """A channel whose floor is `high` rows higher in its first `behind` columns; the markers are floor and far."""
    whole = channel(columns, rows, length, height)
    number = np.arange(len(whole.points)).reshape(rows + 1, columns + 1)
    quads = np.concatenate([_quads(number[high:, : behind + 1]), _quads(number[:, behind:])])
    floor = np.concatenate([number[high, :behind], number[high:0:-1, behind], number[0, behind:]])
    far = np.concatenate([number[:, -1], number[-1, -2:0:-1], number[: high - 1 : -1, 0]])
    return compact(whole.points, [], quads, {"floor": _line(floor), "far": _line(far)})


def compact(points, triangles, quads, sides):
    """The mesh without the points that no cell has."""
    used = np.unique(np.concatenate([np.ravel(triangles), np.ravel(quads)]).astype(int))
    number = np.full(len(points), -1)
    number[used] = np.arange(len(used))
    return Mesh(points[used], *(number[np.asarray(c, int)] for c in (triangles, quads)),
                {name: number[faces] for name, faces in sides.items()})


# ---- O-meshes round sections ----


def joukowski(z, shift, lift=0.0):
    """The image of the outside of a circle of radius 1 - shift round `shift` (negative) whose section is rounded."""
    w = z + shift + 1j * lift
    return w + (1 - 0.02) ** 2 / w


def o_mesh(around, radii, shift=-0.08, lift=0.0, kind="quads"):
    """Rings round a section of chord 1 from x = 0 to 1, with the markers airfoil and far. radii: in parts of the first.
    kind: quads, or triangles in staggered rings."""
    radii = np.asarray(radii)
    stagger = 0.5 * (np.arange(len(radii)) % 2) * (kind == "triangles")
    angle = 2 * np.pi * (np.arange(around) + stagger[:, None]) / around
    w = joukowski((1 - shift) * radii[:, None] * np.exp(1j * angle), shift, lift)
    wall = w[0]
    w = ((w - wall.real.min() - 1j * wall.imag.mean()) / np.ptp(wall.real)).ravel()
    here = np.arange(w.size).reshape(angle.shape)
    after = np.roll(here, -1, axis=1)
    sides = {"airfoil": _line(np.append(here[0], 0)), "far": _line(np.append(here[-1], here[-1, 0]))}
    if kind == "quads":
        closed = np.concatenate([here, here[:, :1]], axis=1)
        return Mesh(w, [], _quads(closed)[:, ::-1], sides)
    cells = []
    for k in range(len(radii) - 1):
        a, d, b, c = here[k], after[k], here[k + 1], after[k + 1]
        pair = ((a, b, d), (d, b, c)) if k % 2 == 0 else ((a, c, d), (a, b, c))
        cells += [np.stack(corners, axis=1) for corners in pair]
    return Mesh(w, np.concatenate(cells), [], sides)


def naca(count, thickness, camber=0.0):
    """A loop of `count` points round a section of NACA's four digits with a sharp trailing edge, of equal distances,
    counter-clockwise from the trailing edge."""
    t = np.linspace(0, np.pi, 400)
    x = 0.5 * (1 - np.cos(t))
    half = 5 * thickness * (0.2969 * x**0.5 - 0.126 * x - 0.3516 * x**2 + 0.2843 * x**3 - 0.1036 * x**4)
    middle = 4 * camber * x * (1 - x)
    line = np.append((x + 1j * (middle + half))[::-1], (x + 1j * (middle - half))[1:])
    along = np.append(0, np.cumsum(abs(np.diff(line))))
    at = along[-1] * np.arange(count) / count
    return np.interp(at, along, line.real) + 1j * np.interp(at, along, line.imag)


# ---- Triangles of any size between loops ----


def inside(z, loop):
    """Which points are inside a loop (points on it: either)."""
    a, b = loop[None, :], np.roll(loop, -1)[None, :]
    z = z[:, None]
    over = (a.imag > z.imag) != (b.imag > z.imag)
    with np.errstate(all="ignore"):
        x = a.real + (z.imag - a.imag) * (b.real - a.real) / (b.imag - a.imag)
    return (over & (z.real < x)).sum(axis=1) % 2 == 1


def _pairs(z):
    return np.stack([z.real, z.imag], axis=1)


def _scatter(size, half, random):
    """Points in the square of this half side, at random, about one for each triangle pair of the wanted size."""
    found, centre, side = [], np.array([0.5 + 0j]), 2 * half
    while len(centre):
        fine = side <= 0.93 * size(centre)
        keep = centre[fine]
        chance = 1.155 * (side / size(keep)) ** 2
        jitter = (random.uniform(-0.3, 0.3, len(keep)) + 1j * random.uniform(-0.3, 0.3, len(keep))) * side
        found.append((keep + jitter)[random.uniform(size=len(keep)) < chance])
        centre = (centre[~fine][:, None] + side / 4 * np.array([-1 - 1j, 1 - 1j, -1 + 1j, 1 + 1j])).ravel()
        side /= 2
    return np.concatenate(found)


def between(loops, random, growth=0.22, half=15.0, edge=None):
    """Points, triangles and the faces of each loop (and of the outer square, the last) for triangles whose size at the
    loops is that of their sides and grows with the distance from them. Loops are counter-clockwise; the mesh is
    outside. Points move as if bars pushed them apart (Persson and Strang, SIAM Review 46 (2004) 329), then to the mean
    of the centroids of their triangles weighted by density."""
    wall = np.concatenate(loops)
    tree = cKDTree(_pairs(wall))
    own = np.concatenate([0.5 * (abs(np.roll(p, -1) - p) + abs(np.roll(p, 1) - p)) for p in loops])

    def size(z):
        distance, near = tree.query(_pairs(z))
        return np.minimum(own[near] + growth * distance, edge or 3.0)

    count = int(np.ceil(2 * half / min(edge or 3.0, own.mean() + growth * half)))
    side = half * (2 * np.arange(count) / count - 1)
    square = 0.5 + np.concatenate([side - 1j * half, half + 1j * side, -side + 1j * half, -half - 1j * side])
    fixed = np.append(wall, square)
    free = _scatter(size, half, random)

    def allowed(z):
        good = tree.query(_pairs(z))[0] > 0.6 * size(z)
        reach = half - np.maximum(abs(z.real - 0.5), abs(z.imag))
        good &= reach > 0.4 * size(z)
        for loop in loops:
            good &= ~inside(z, loop)
        return good

    def cells(z):
        triangles = Delaunay(_pairs(z)).simplices
        middle = z[triangles].mean(axis=1)
        for loop in loops:
            out = ~inside(middle, loop)
            triangles, middle = triangles[out], middle[out]
        clockwise = area(z[triangles]) < 0
        triangles[clockwise] = triangles[clockwise, ::-1]
        return triangles[area(z[triangles]) > 0]

    free = free[allowed(free)]
    n = len(fixed)
    for k in range(90):
        z = np.append(fixed, free)
        triangles = cells(z)
        move = _push(z, triangles, size) if k < 60 else _centre(z, triangles, size)
        free = free + move[n:]
        keep = allowed(free)
        free = free[keep] if k < 60 else np.where(keep, free, z[n:])
    z = np.append(fixed, free)
    ends = np.cumsum([0] + [len(loop) for loop in loops] + [len(square)])
    faces = [_line(np.append(np.arange(a, b), a)) for a, b in zip(ends[:-1], ends[1:])]
    triangles = cells(z)
    sides = {tuple(sorted(s)) for t in triangles for s in zip(t, np.roll(t, -1))}
    missing = [face for loop in faces for face in loop if tuple(sorted(face)) not in sides]
    if missing:
        raise ValueError(f"sides of the loops are missing in the triangulation: {missing[:4]}")
    return z, triangles, faces


def _push(z, triangles, size):
    bars = np.concatenate([triangles[:, k] for k in ([0, 1], [1, 2], [2, 0])])
    a, b = np.unique(np.sort(bars, axis=1), axis=0).T
    way = z[a] - z[b]
    length, wanted = abs(way), size(0.5 * (z[a] + z[b]))
    wanted = 1.2 * wanted * ((length / wanted) ** 2).mean() ** 0.5
    force = 0.2 * np.maximum(wanted - length, 0) * way / length
    total = np.zeros(len(z), complex)
    np.add.at(total, a, force)
    np.add.at(total, b, -force)
    return total


def _centre(z, triangles, size):
    middle = z[triangles].mean(axis=1)
    weight = area(z[triangles]) / size(middle) ** 3
    total, sum_of = np.zeros(len(z), complex), np.zeros(len(z))
    for k in range(3):
        np.add.at(total, triangles[:, k], weight * middle)
        np.add.at(sum_of, triangles[:, k], weight)
    return np.where(sum_of > 0, total / np.maximum(sum_of, 1e-300) - z, 0)


def free(loops, names, random, layers=0, first=None, **options):
    """Triangles round loops, the markers `names` and far; with layers of quadrilaterals at the first loop, the lowest
    of the height `first` and the last about as high as long."""
    loops = [np.asarray(loop, complex) for loop in loops]
    if not layers:
        z, triangles, faces = between(loops, random, **options)
        return Mesh(z, triangles, [], dict(zip((*names, "far"), faces)))
    wall = loops[0]
    on, back = np.roll(wall, -1) - wall, wall - np.roll(wall, 1)
    normal = -1j * (on / abs(on) + back / abs(back))
    normal /= abs(normal)
    length = abs(on).mean()
    ratio = (0.8 * length / first) ** (1 / (layers - 1))
    level = first * (ratio ** np.arange(layers + 1) - 1) / (ratio - 1)
    for _ in range(3):  # directions that turn gradually from the wall outwards
        normal = 0.5 * normal + 0.25 * (np.roll(normal, 1) + np.roll(normal, -1))
        normal /= abs(normal)
    rings = wall + level[:, None] * normal
    z, triangles, faces = between([rings[-1], *loops[1:]], random, **options)
    n = len(wall)
    points = np.concatenate([z, rings[:-1].ravel()])
    number = np.concatenate([len(z) + np.arange(n * layers).reshape(layers, n), [np.arange(n)]])
    closed = np.concatenate([number, number[:, :1]], axis=1)
    sides = dict(zip((*names, "far"), faces))
    sides[names[0]] = _line(closed[0])
    return Mesh(points, triangles, _quads(closed)[:, ::-1], sides)
