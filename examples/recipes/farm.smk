# SPDX-License-Identifier: GPL-3.0-or-later
# Makes many droplets on many machines by Snakemake, in shares that go on where they were interrupted, and one manifest:
#
#   snakemake --snakefile farm.smk --cores 2 --config \
#       job="glyphs --font Serif.ttf --all -o out/{gid}.glb --triangles 5k" out=out shares=16
#
# `job` is a command line of `batch` or `glyphs` without `--shard`; `out` is the folder of all outputs, which holds the manifest.
# Snakemake starts the shares on a cluster as it is configured, with `--cluster` or a profile; all machines need the folder.
import json
import shlex
import subprocess

WORDS = shlex.split(config["job"])
OUT = config["out"]
SHARES = int(config.get("shares", 8))
SOME_FAILED = 6  # an exit code of the command: the manifest says which


def make(*more):
    """Runs the command; items that cannot be made do not stop the others."""
    code = subprocess.run(["droplet-shape", *WORDS, "--keep-going", "--quiet", *more]).returncode
    if code not in (0, SOME_FAILED):
        raise RuntimeError(f"droplet-shape ended with {code}")


rule all:
    # Reads the manifests of all shares, makes what is missing, and writes one manifest.
    input:
        expand(OUT + "/.share-{k}-of-{n}", k=range(1, SHARES + 1), n=SHARES),
    run:
        make("--manifest", OUT + "/manifest.json")
        items = json.load(open(OUT + "/manifest.json"))["items"]
        for item in items:
            if item["status"] == "failed":
                print(f"{item['name']}: {item['error']}")
        print(f"{len(items)} items")


rule share:
    # The share's own manifest is no output, as Snakemake removes outputs of what was interrupted.
    output:
        touch(OUT + "/.share-{k}-of-{n}"),
    run:
        make("--manifest", OUT + "/manifest.json", "--shard", f"{wildcards.k}/{wildcards.n}", "--threads", str(threads))
