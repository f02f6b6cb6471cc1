"""Makes a dataset of 64 drapes on Dask: a file with every motion, and a table of what was varied.

    python dask_dataset.py [FOLDER]

Two workers of this machine here; give ``Client`` the address of a cluster to use that. Call it again after it was
interrupted, and it goes on where it was.
"""

import sys
from pathlib import Path

import numpy as np
from distributed import Client, LocalCluster

import tautline as tl

GRID = {
    "bodies[2].cloth.friction": np.linspace(0.1, 0.9, 8),
    "bodies[2].cloth.mass": np.geomspace(0.1, 2, 8),
}


def main() -> None:
    folder = Path(sys.argv[1] if len(sys.argv) > 1 else "out") / "drapes"
    scene = tl.Scene.named("cloth-on-cube", n=12)
    cluster = LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None)
    with cluster, Client(cluster) as client:
        client.run(tl.set_threads, 1)
        executor = client.get_executor()
        table = tl.sweep(scene, GRID, seconds=0.5, executor=executor, folder=folder, save=".npz")
    print(table.to_string(max_rows=6))

    files = sorted(folder.glob("*.npz"))
    motions = np.stack([np.load(file)["cloth 2/positions"] for file in files])
    print(f"{len(files)} files; motions of the shape {motions.shape}")
    assert (table["error"] == "").all() and len(files) == 64
    assert table["state_hash"].nunique() == 64


if __name__ == "__main__":  # Workers import this file.
    main()
