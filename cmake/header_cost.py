#!/usr/bin/env python3
"""What an edit of each header costs: the time of the sources that must be compiled again, as a share of the time of all, from a finished build of Ninja.

Times are those of the last build of each object; build from nothing and with CCACHE_DISABLE=1 for true ones. Example:
  cmake --preset dev && CCACHE_DISABLE=1 cmake --build --preset dev -j2 && cmake/header_cost.py build-dev
"""
import argparse
import pathlib
import subprocess

arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
arguments.add_argument("build", type=pathlib.Path, help="the folder of the build")
arguments.add_argument("--worst", type=int, default=12, metavar="N", help="how many of the most expensive headers are named (default: %(default)s)")
options = arguments.parse_args()

root = pathlib.Path(__file__).resolve().parent.parent
seconds = {}
for line in (options.build / ".ninja_log").read_text().splitlines()[1:]:
    begin, end, _, output, _ = line.split("\t")
    if output.endswith((".o", ".gch")):
        seconds[output] = (int(end) - int(begin)) / 1000
total = sum(seconds.values())

cost = {}
listed = subprocess.run(["ninja", "-C", options.build, "-t", "deps"], capture_output=True, text=True, check=True).stdout
for block in listed.split("\n\n"):
    head, *paths = block.strip().split("\n")
    output = head.split(": #deps")[0]
    if output not in seconds:
        continue
    for path in paths:
        header = (options.build / path.strip()).resolve()
        if header.suffix == ".h" and header.is_relative_to(root) and not header.is_relative_to(root / "cmake"):
            cost[header.relative_to(root)] = cost.get(header.relative_to(root), 0.0) + seconds[output]

shares = sorted(value / total for value in cost.values())
print(f"{len(seconds)} objects, {total:.0f} s; {len(shares)} headers: an edit recompiles, of that time, {100 * shares[len(shares) // 2]:.1f} % in the median, "
      f"{100 * shares[int(0.9 * len(shares))]:.1f} % at the 90th percentile, {100 * shares[-1]:.1f} % at worst")
for header, value in sorted(cost.items(), key=lambda item: -item[1])[:options.worst]:
    print(f"{100 * value / total:5.1f} %  {header}")
