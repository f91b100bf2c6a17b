"""The jobs of tests/measure/improve by harmorph and by other methods: how often harmorph is within 2 % of the best
other method, in the smallest quality, in the mean, and in both; and what elasticity would do as an operator.

usage: peers.py BUILD [SEED]   Environment: HARMORPH, the program (BUILD/harmorph); ONLY, the part of names that jobs
must have; JOBS, processes (1). Walls that slip are left out, as other methods have no such condition. The meshes of the
reference (tests/measure/improve) are counted too, where they are in BUILD.
"""

import glob
import json
import os
import subprocess
import sys
import time
from concurrent.futures import ProcessPoolExecutor

import numpy as np

import jobs
import reference
from methods import Elasticity, InverseDistance, RadialBasis
from meshes import cross

PEERS = {"RBF R=2": lambda d, at: RadialBasis(d, at, 2), "RBF R=5": lambda d, at: RadialBasis(d, at, 5),
         "elastic": Elasticity, "elastic/5": Elasticity, "elastic/20": Elasticity, "inverse": InverseDistance}
STEPS = {"elastic/5": 5, "elastic/20": 20}
ONE_STEP = [name for name in PEERS if name not in STEPS]
MODES = {"displace": [], "auto": ["--operator", "auto"], "safe": ["--safe"], "safe, improve": ["--safe", "--improve"],
         "auto, improve": ["--operator", "auto", "--improve"]}
OPERATORS = ("conformal", "laplace")
CLOSE = 0.98


class Domain:
    """The arrays that the methods need, of a job."""

    def __init__(self, job):
        mesh = job.mesh
        self.start, self.cells = mesh.points, mesh.cells
        faces = np.concatenate([mesh.sides[name] for name in job.given])
        self.wall = np.unique(faces)
        after, before = dict(faces), dict(faces[:, ::-1])  # an end of a wall has one neighbour only, twice
        self.next = np.array([after.get(p, before.get(p)) for p in self.wall])
        self.previous = np.array([before.get(p, after.get(p)) for p in self.wall])
        boundary = np.unique(np.concatenate([faces.ravel() for faces in mesh.sides.values()]))
        self.outer = np.setdiff1d(boundary, self.wall)
        self.inner = np.setdiff1d(np.arange(len(self.start)), boundary)
        self.target = self.start[self.wall].copy()
        self.target[np.searchsorted(self.wall, job.points)] += job.displacement

    def moved(self, method, steps):
        """The mesh after some steps, each with the method prepared on the mesh as it is then."""
        at, begin = self.start, self.start[self.wall]
        for step in range(1, steps + 1):
            at = method(self, at).moved(begin + step / steps * (self.target - begin))
        return at

    def admissible(self, displacement):
        """The part of a displacement at which the first corner of a cell has no area; infinity: none has."""
        first = np.inf
        for cells in self.cells:
            side, move = (np.roll(v[cells], -1, axis=1) - v[cells] for v in (self.start, displacement))
            side, move = side.ravel(), move.ravel()
            back = (np.arange(len(side)).reshape(cells.shape)[:, np.arange(-1, cells.shape[1] - 1)]).ravel()
            c, a = cross(side[back], side), cross(move[back], move)
            b = cross(side[back], move) + cross(move[back], side)
            with np.errstate(all="ignore"):
                root = np.sqrt(b * b - 4 * a * c)
                half = -0.5 * (b + np.where(b < 0, -root, root))
                for s in (half / a, c / half):
                    first = min([first, *s[(s > 0) & np.isfinite(s)]])
        return first


def by_program(folder, job, options):
    """(smallest, mean) of the program, (0, 0) where it does not reach the target, and its report."""
    command = [os.environ["HARMORPH"], "displace", f"{folder}/{job.name}.su2", "--given", ",".join(job.given), "--wall",
               f"{folder}/{job.name}.field", "--json", *job.options, *options]
    done = subprocess.run(command, capture_output=True, text=True)
    report = json.loads(done.stdout) if done.stdout.startswith("{") else {}
    valid = report.get("inverted") == 0 and report.get("step_fraction", 1) == 1
    return (report["min_quality"], report["mean_quality"]) if valid else (0.0, 0.0), report


def judge(task):
    """One row: quality by method, the largest admissible parts of one linear step, and seconds."""
    folder, job = task
    domain, objective = Domain(job), reference.Objective(job.mesh, np.arange(0))
    quality, reach, seconds = {}, {}, {}
    for name, method in PEERS.items():
        begun = time.process_time()
        at = domain.moved(method, STEPS.get(name, 1))
        seconds[name] = time.process_time() - begun
        smallest, mean = objective.report(at)
        quality[name] = (smallest, mean) if smallest > 0 else (0.0, 0.0)
        if name in ONE_STEP:
            reach[name] = domain.admissible(at - domain.start)
    for name, options in MODES.items():
        quality[name], _ = by_program(folder, job, options)
    for operator in OPERATORS:
        quality[operator], report = by_program(folder, job, ["--operator", operator])
        step = report.get("admissible_step", np.nan)
        reach[operator] = np.inf if step is None else step
    for path in glob.glob(f"{folder.replace('/compare/jobs-', '/improve/')}/{job.name}-*.npy"):
        quality["reference"] = objective.report(np.load(path))
    return job, quality, reach, seconds


def best(quality, names):
    return tuple(max((quality[name][k], name) for name in names) for k in (0, 1))


def show(rows):
    print("\n== Other methods on the jobs of tests/measure/improve\n\ntable Smallest / mean quality; the best other "
          "method in each; harmorph; a star: within 2 % of the best other method in both")
    heads = [f"{text:>17}" for text in ("best smallest", "best mean")] + [f"{mode:>13}" for mode in MODES]
    print("  ".join([f"  {'job':27}", *heads]))
    for job, quality, _, _ in rows:
        top = best(quality, PEERS)
        cells = [f"{value:.3f} {name:>11}" for value, name in top]
        for mode in MODES:
            star = "*" if all(close(quality[mode], top)) else " "
            cells.append(f"{quality[mode][0]:.3f}/{quality[mode][1]:.3f}{star}")
        print(f"  {job.name:27}  " + "  ".join(f"{cell:>13}" for cell in cells))


def close(quality, top):
    """Whether a valid mesh is within 2 % of the best in the smallest quality, and in the mean."""
    return [quality[0] > 0 and quality[k] >= CLOSE * top[k][0] for k in (0, 1)]


def count(rows, ours, names=PEERS):
    """How often the better of some methods (of the larger smallest quality) is close to the best of others."""
    counts = np.zeros(3, int)
    for _, quality, _, _ in rows:
        near = close(max(quality[name] for name in ours), best(quality, names))
        counts += [*near, all(near)]
    return counts


def summary(rows):
    print(f"\ntable Rows, of {len(rows)}, in which harmorph is within 2 % of the best other method")
    print(f"  {'command':36}  {'smallest':>8}  {'mean':>8}  {'both':>8}  {'in parts':>8}")
    for name, options in MODES.items():
        counts = count(rows, [name])
        print(f"  {' '.join(['displace', *options]):36}  " + "  ".join(f"{c:8d}" for c in counts) +
              f"  {100 * counts[2] / len(rows):6.0f} %")
    known = [row for row in rows if "reference" in row[1]]
    if known:
        counts = count(known, ["reference"])
        print(f"  {f'L-BFGS of tests/measure/improve, {len(known)} rows':36}  " + "  ".join(f"{c:8d}" for c in counts) +
              f"  {100 * counts[2] / len(known):6.0f} %")
    print("\ntable Rows in which each other method has the best smallest quality, or mean; median of its processor "
          "time [s]")
    print(f"  {'method':12}  {'smallest':>8}  {'mean':>8}  {'seconds':>8}")
    tops = [best(quality, PEERS) for _, quality, _, _ in rows]
    for name in PEERS:
        wins = [sum(top[k][1] == name for top in tops) for k in (0, 1)]
        print(f"  {name:12}  {wins[0]:8d}  {wins[1]:8d}  {np.median([s[name] for *_, s in rows]):8.4f}")


def study(rows):
    """Elasticity in one step as an operator of harmorph."""
    print("\ntable One linear step up to the first inverted cell, in parts of the job's movement: the geometric mean "
          "of each family (values above 100 count as 100)")
    names = [*OPERATORS, *ONE_STEP]
    print(f"  {'movement':10}  {'rows':>4}  " + "  ".join(f"{n:>9}" for n in names))
    families = sorted({job.movement for job, *_ in rows})
    for family in families:
        mine = [reach for job, _, reach, _ in rows if job.movement == family]
        means = [np.exp(np.mean([np.log(min(reach[name], 100)) for reach in mine])) for name in names]
        print(f"  {family:10}  {len(mine):4d}  " + "  ".join(f"{mean:9.2f}" for mean in means))
    print(f"\ntable Rows, of {len(rows)}, within 2 % of the best one-step method, and of the best of all others, by one "
          "step of the better of some operators")
    heads = [f"{of} {what}" for of in ("one-step:", "all:") for what in ("smallest", "mean", "both")]
    print("  ".join([f"  {'operators':30}", *heads]))
    for ours in (["conformal"], ["laplace"], ["elastic"], ["conformal", "laplace"], ["conformal", "elastic"],
                 ["conformal", "laplace", "elastic"]):
        counts = [*count(rows, ours, ONE_STEP), *count(rows, ours)]
        print("  ".join([f"  {', '.join(ours):30}", *(f"{c:{len(head)}d}" for c, head in zip(counts, heads))]))


def main(build, seed=jobs.SEED):
    os.environ.setdefault("HARMORPH", f"{build}/harmorph")
    folder = f"{build}/compare/jobs-{seed}"
    wanted = [job for job in jobs.write(folder, seed)
              if "--slip" not in job.options and os.environ.get("ONLY", "") in job.name]
    with ProcessPoolExecutor(int(os.environ.get("JOBS") or 1)) as pool:
        rows = list(pool.map(judge, [(folder, job) for job in wanted]))
    show(rows)
    summary(rows)
    study(rows)


if __name__ == "__main__":
    main(sys.argv[1], int(sys.argv[2]) if len(sys.argv) > 2 else jobs.SEED)
