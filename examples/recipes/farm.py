#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes many droplets on many machines by Dask, in shares that go on where they were interrupted, and one manifest.

    farm.py --out out --shares 16 glyphs --font Serif.ttf --all -o 'out/{gid}.glb' --triangles 5k

The rest of the command line is that of `batch` or `glyphs` without `--shard`; the folder of all outputs holds the manifest. It
takes a cluster's scheduler by `--scheduler tcp://host:8786`; without it, two workers run here. All machines need the folder.
"""
import argparse
import json
import subprocess
import sys

from dask.distributed import Client, LocalCluster, as_completed

SOME_FAILED = 6  # an exit code of the command: the manifest says which


def make(words, manifest, *more):
    """Runs the command; items that cannot be made do not stop the others."""
    command = ["droplet-shape", *words, "--keep-going", "--quiet", "--manifest", manifest, *more]
    code = subprocess.run(command).returncode
    if code not in (0, SOME_FAILED):
        raise RuntimeError(f"droplet-shape ended with {code}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", required=True)
    parser.add_argument("--shares", type=int, default=8)
    parser.add_argument("--scheduler")
    arguments, words = parser.parse_known_args()
    manifest = arguments.out + "/manifest.json"
    cluster = arguments.scheduler or LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None)
    with Client(cluster) as client:
        # A share whose worker is lost goes to another one.
        shares = [client.submit(make, words, manifest, "--shard", f"{k}/{arguments.shares}", "--threads", "1", retries=3, pure=False)
                  for k in range(1, arguments.shares + 1)]
        for done, share in enumerate(as_completed(shares), 1):
            share.result()
            print(f"{done} of {arguments.shares} shares", file=sys.stderr)
    # Reads the manifests of all shares, makes what is missing, and writes one manifest.
    make(words, manifest)
    with open(manifest, encoding="utf-8") as file:
        items = json.load(file)["items"]
    for item in items:
        if item["status"] == "failed":
            print(f"{item['name']}: {item['error']}")
    print(f"{len(items)} items")


if __name__ == "__main__":
    main()
