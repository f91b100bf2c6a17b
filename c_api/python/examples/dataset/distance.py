"""Learns the distance to the wall from a set of `harmorph sample`: a Dataset of PyTorch, and a linear model.

usage: distance.py MESH SET
"""
import sys
from pathlib import Path

import harmorph
import numpy as np
import torch
from torch.utils.data import DataLoader, Dataset

TRAIN, TEST, OUT = 0, 1, 2  # the array `split` of a shard


class Sections(Dataset):
    """The designs of one split: parameters from -1 to 1, and the distance to the wall at each point of a grid."""

    def __init__(self, mesh, folder, split, grid):
        parameters, fields = [], []
        for path in sorted(Path(folder, "shards").glob("*[0-9].npz")):
            shard, more = np.load(path), np.load(path.with_suffix(".distance.npz"))
            for row in np.flatnonzero(shard["split"] == split):
                # The points of each design lie elsewhere: the field comes to places that all designs share.
                moved = mesh.with_points(shard["coordinates"][row])
                parameters.append(shard["variables"][row])
                fields.append(harmorph.Interpolation(moved, grid)(more["wall_distance"][row]))
        low, high = np.array([0, 0.2, 0.05]), np.array([0.07, 0.6, 0.2])  # camber, its position, thickness
        self.parameters = torch.tensor(2 * (np.array(parameters) - low) / (high - low) - 1)
        self.fields = torch.tensor(np.array(fields))

    def __len__(self):
        return len(self.parameters)

    def __getitem__(self, k):
        return self.parameters[k], self.fields[k]


def train(data, epochs=300):
    torch.manual_seed(1)
    model = torch.nn.Linear(data.parameters.shape[1], data.fields.shape[1], dtype=torch.float64)
    optimiser = torch.optim.Adam(model.parameters(), lr=0.02)
    rate = torch.optim.lr_scheduler.CosineAnnealingLR(optimiser, epochs)
    for _ in range(epochs):
        for parameters, fields in DataLoader(data, batch_size=32, shuffle=True):
            optimiser.zero_grad()
            torch.nn.functional.mse_loss(model(parameters), fields).backward()
            optimiser.step()
        rate.step()
    return model


def main():
    mesh = harmorph.Mesh.read(sys.argv[1])
    x, y = np.meshgrid(np.linspace(-0.2, 1.2, 36), np.linspace(-0.4, 0.4, 21))
    grid = np.stack([x.ravel(), y.ravel()], axis=-1)
    train_set, test, out = (Sections(mesh, sys.argv[2], split, grid) for split in (TRAIN, TEST, OUT))
    print(f"{len(train_set)} designs to train, {len(test)} to test, {len(out)} out of range; {len(grid)} places")
    model = train(train_set)
    mean = train_set.fields.mean(dim=0)
    for name, data in (("test", test), ("out of range", out)):
        error = (model(data.parameters) - data.fields).abs().mean().item()
        plain = (mean - data.fields).abs().mean().item()
        print(f"{name}: mean error {error:.1e} chords, {plain / error:.1f} times less than that of the mean field")


main()
