"""The table of jobs: smallest / mean quality by programs of several commits and by the reference, and what is reached.

usage: table.py BUILD [SEED]   Environment: HARMORPH, the program to judge (BUILD/harmorph); BEFORE and TODAY, programs
of other commits to show beside it; JOBS, processes (1); ONLY, the part of names that jobs must have. The files of jobs
and the meshes of the reference are kept in BUILD/improve.
"""

import hashlib
import json
import os
import subprocess
import sys
from concurrent.futures import ProcessPoolExecutor

import numpy as np

import jobs
import meshes
import reference

MODES = {"safe": ["--safe"], "improve": ["--safe", "--improve"]}


def run(program, folder, job, options):
    """The program's report with the points of its mesh, or None and the reason."""
    out = f"{folder}/{job.name}-{os.getpid()}.su2"
    begun = [program, "displace", f"{folder}/{job.name}.su2", "--given", ",".join(job.given), "--wall",
             f"{folder}/{job.name}.field", *job.options, *options, "--json", "-o", out]
    done = subprocess.run(begun, capture_output=True, text=True)
    report = json.loads(done.stdout) if done.stdout.startswith("{") else {"refused": done.stderr.strip()}
    if os.path.exists(out):
        report["points"] = meshes.read(out).points
        os.remove(out)
    return report


def cost(report, plain):
    """Solutions that the safe displacement took: as the program reports them, else its time in solutions of all
    functions that the displacement needs."""
    if "solutions" in report:
        return report["solutions"]
    return (report["displace_seconds"] - plain.get("displace_seconds", 0)) / report["factor_seconds"]


class Judged:
    """One job by all programs and by the reference."""

    def __init__(self, programs, folder, job):
        self.name = job.name
        self.layer = reference.Layer(job.mesh, job.given)
        self.objective = reference.Objective(job.mesh, reference.free_points(job.mesh, self.layer))
        self.found, self.problems = {}, []
        starts = []
        for who, program in programs.items():
            plain = run(program, folder, job, [])
            for mode, options in MODES.items():
                report = run(program, folder, job, options)
                self.found[who, mode] = self._judge(report, plain, f"{who} {mode}")
                valid = "points" in report and self.objective.report(report["points"])[0] > 0
                if valid and report["step_fraction"] == 1:
                    starts.append(report["points"])
        self.reference = self._reference(folder, job, starts) if starts else None
        self.layer = self.objective = None  # large, and not wanted in the other process

    def _judge(self, report, plain, who):
        if "min_quality" not in report:
            return None
        found = {"quality": (report["min_quality"], report["mean_quality"]), "part": report["step_fraction"],
                 "cost": cost(report, plain), "layer": np.nan}
        if "points" not in report:  # a part of the movement, of which the program writes no mesh
            return found
        smallest, mean = self.objective.report(report["points"])
        error = max(abs(smallest - report["min_quality"]), abs(mean - report["mean_quality"]))
        if error > 1e-9 + self.objective.rounding(report["points"]):
            self.problems.append(f"{who}: {smallest}/{mean}, reported {report['min_quality']}/{report['mean_quality']}")
        return {**found, "layer": self.layer.error(report["points"])}

    def _reference(self, folder, job, starts):
        boundary = [start[self.layer.boundary] for start in starts]
        own = boundary[-1]  # of the program to judge; points that slip may be elsewhere by other programs
        places = np.round(own / np.ptp(own.real), 9)
        key = hashlib.sha256(job.mesh.points.tobytes() + places.tobytes() + bytes(str(reference.WEIGHT), "ascii"))
        path = f"{folder}/{job.name}-{key.hexdigest()[:12]}.npy"
        starts = [s for s, b in zip(starts, boundary) if abs(b - own).max() < 1e-9]
        kept = np.load(path) if os.path.exists(path) else None
        if kept is not None:  # a better mesh than the kept one is a new start
            best = self.objective.value(kept)
            starts = [s for s in starts if self.layer.error(s) < 1e-6 and self.objective.value(s) > best + 1e-5]
        else:
            starts = sorted(starts, key=self.objective.value)
            starts = [starts[0], starts[-1]]
        if starts:
            at = reference.reference(job.mesh, job.given, starts)[0]
            if kept is None or self.objective.value(at) > self.objective.value(kept):
                kept = at
                np.save(path, kept)
        return {"quality": self.objective.report(kept), "layer": self.layer.error(kept)}


def text(found):
    if not found:
        return f"{'refused':>13}"
    part = "" if found.get("part", 1) == 1 else f" {found['part']:.2f}"
    return f"{found['quality'][0]:.3f}/{found['quality'][1]:.3f}{part}".rjust(13)


def show(judged, programs):
    """Print each row as soon as its job is done, and return all jobs."""
    done = []
    head = [f"{who} {mode}" for who in programs for mode in MODES]
    print(f"{'job':28} " + " ".join(f"{h:>13}" for h in head) + f" {'L-BFGS':>13} {'layer':>6} {'cost':>6}")
    for one in judged:
        done.append(one)
        mine = one.found["new", "improve"] or {"layer": np.nan, "cost": np.nan}
        cells = [text(one.found[who, mode]) for who in programs for mode in MODES] + [text(one.reference)]
        mark = "*" if one.reference and one.reference["layer"] > 1e-6 else ""
        print(f"{one.name:28} " + " ".join(cells) + f" {mine['layer']:6.2f} {mine['cost']:6.1f} {mark}", flush=True)
        for problem in one.problems:
            print(f"FAIL {problem}")
    print("layer: the largest distance of an outer end of the first layer from its place, in parts of its edge, with\n"
          "--safe --improve of `new`; cost: in solutions; a number behind the mean: the part of the movement; a star:\n"
          "the reference did not find a valid mesh with the whole layer in its place")
    return done


def share(flags):
    flags = list(flags)
    return f"{sum(flags)} of {len(flags)} ({100 * sum(flags) / max(len(flags), 1):.0f} %)"


def summary(judged, programs):
    """What the jobs reach, program by program."""
    for who in programs:
        for mode in MODES:
            print(f"\n{who}, displace {' '.join(MODES[mode])}")
            whole = [one for one in judged if one.found[who, mode] and one.found[who, mode]["part"] == 1]
            print(f"  whole movement                        {share(one in whole for one in judged)}")
            mine = {one.name: one.found[who, mode]["quality"] for one in whole}
            rows = [(mine[one.name], one.reference["quality"]) for one in whole if one.reference]
            if not rows:
                continue
            print(f"  smallest >= 95 % of the reference     {share(a[0] >= 0.95 * b[0] for a, b in rows)}")
            print(f"  mean     >= 98 % of the reference     {share(a[1] >= 0.98 * b[1] for a, b in rows)}")
            print("  both                                  "
                  f"{share(a[0] >= 0.95 * b[0] and a[1] >= 0.98 * b[1] for a, b in rows)}")
            loss = [np.log(b[0] / a[0]) + reference.WEIGHT * np.log(b[1] / a[1]) for a, b in rows]
            print(f"  J below the reference                 median {np.median(loss):.3f}, largest {max(loss):.3f}")
            if "before" in programs and who != "before":
                pairs = [(mine[one.name][0], one.found["before", "safe"]["quality"][0]) for one in whole
                         if one.found["before", "safe"] and one.found["before", "safe"]["part"] == 1]
                print(f"  smallest >= that before, --safe       {share(a >= 0.999 * b for a, b in pairs)}")
            costs = sorted(one.found[who, mode]["cost"] for one in judged if one.found[who, mode])
            print(f"  solutions                             median {np.median(costs):.1f}, 95 % at most "
                  f"{np.percentile(costs, 95):.1f}, largest {costs[-1]:.1f}")


def judge(task):
    return Judged(*task)


def main(build, seed=jobs.SEED):
    folder = f"{build}/improve/{seed}"
    programs = {"before": os.environ.get("BEFORE"), "today": os.environ.get("TODAY"),
                "new": os.environ.get("HARMORPH") or f"{build}/harmorph"}
    programs = {who: program for who, program in programs.items() if program}
    wanted = [job for job in jobs.write(folder, seed) if os.environ.get("ONLY", "") in job.name]
    with ProcessPoolExecutor(int(os.environ.get("JOBS") or 1)) as pool:
        judged = show(pool.map(judge, [(programs, folder, job) for job in wanted]), programs)
    summary(judged, programs)
    return any(one.problems for one in judged)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], int(sys.argv[2]) if len(sys.argv) > 2 else jobs.SEED))
