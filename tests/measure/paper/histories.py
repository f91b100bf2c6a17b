"""Convergence histories of the iterations of the paper, against cycles and against work. Part of run.sh.

usage: histories.py HARMORPH FOLDER LETTER TITLE MESH CONDITIONS...   CONDITIONS: options of `harmorph solve`
"""

import json
import subprocess
import sys

import numpy as np
from matplotlib import pyplot

harmorph, out, letter, title, mesh, *conditions = sys.argv[1:]


def solve(*options):
    """Cycles, residuals, and the work of all cycles."""
    history = f"{out}/history.csv"
    report = json.loads(subprocess.run(
        [harmorph, "solve", mesh, *conditions, "--operator", "laplace", "--tol", "1e-10", "--engine", "fas", *options,
         "--json", "--force", "--history", history, "-o", f"{out}/history.basis"],
        check=True, stdout=subprocess.PIPE).stdout)
    cycle, residual = np.loadtxt(history, delimiter=",", skiprows=1, ndmin=2, usecols=(0, 1)).T
    return cycle, residual, report["work"]


figure, panels = pyplot.subplots(1, 2, figsize=(10, 3.6), sharey=True, layout="constrained")


def draw(name, style, cycle, residual, work, per_cycle):
    """The work of a cycle is the same for all cycles; the start from the coarsest level is work before them."""
    start = work - cycle[-1] * per_cycle
    panels[0].semilogy(cycle, residual, style, linewidth=1, label=name)
    panels[1].semilogy(np.where(cycle == 0, 0, start + cycle * per_cycle), residual, style, linewidth=1)


cycle, residual, work = solve("--levels", "1")
draw("single grid", "k-", cycle, residual, work, work / cycle[-1])
most = 0
for agglomeration, line in (("isotropic", "-"), ("directional", "--")):
    for k, kind in enumerate(("paper", "improved")):
        choice = ["--agglomeration", agglomeration, "--cycle", kind]
        prefix = "improved " if kind == "improved" else ""
        zero, full = solve(*choice, "--start", "zero"), solve(*choice)
        per_cycle = zero[2] / zero[0][-1]  # the cycles of FMG-FAS cost the same as those of FAS
        most = max(most, zero[0][-1], full[0][-1])
        for colour, name, (cycle, residual, work) in ((2 * k, "FAS", zero), (2 * k + 1, "FMG-FAS", full)):
            label = prefix + name if line == "-" else None
            draw(label, f"C{colour}{line}", cycle, residual, work, per_cycle)
panels[0].set(xlim=(0, most), ylim=(1e-11, 2), xlabel="cycles", ylabel="relative residual")
panels[1].set(xlabel="work, in Runge-Kutta steps on the finest mesh")
panels[0].legend(fontsize="small")
figure.savefig(f"{out}/histories-{letter}.svg")
print(f"figure histories-{letter}.svg Figure {letter} | The residual against cycles and against work on {title}. Dashed"
      " lines belong to directional agglomeration. The single grid goes on beyond the right edge of the left panel.")
