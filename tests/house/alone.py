#!/usr/bin/env python3
"""Compiles every source and every header of Rink by itself, without generating code, and fails with what the compiler says of those that lean on others.

In two steps: --configure makes the work folder, --part K/N then compiles the Kth of N shares of the files, one at a time.
"""
import argparse
import json
import os
import pathlib
import re
import subprocess
import sys
import zlib

arguments = argparse.ArgumentParser(description=__doc__)
arguments.add_argument("--root", type=pathlib.Path, required=True, help="the folder of Rink's sources")
arguments.add_argument("--work", type=pathlib.Path, required=True, help="a folder to configure in")
arguments.add_argument("--cmake", default="cmake")
arguments.add_argument("--configure", action="store_true", help="make the work folder and end")
arguments.add_argument("--part", default="0/1", metavar="K/N", help="only files whose path's CRC-32 modulo N is K")
arguments.add_argument("--compiler", default="g++")
arguments.add_argument("--only", type=re.compile, default=re.compile(""), metavar="REGEX", help="only files whose path, as it is given to the compiler, matches")
options = arguments.parse_args()

if options.configure:
    subprocess.run([options.cmake, "-G", "Ninja", "-S", options.root, "-B", options.work, "-DRINK_UNITY=OFF", "-DRINK_PRECOMPILED=OFF", "-DCMAKE_BUILD_TYPE=None",
                    f"-DCMAKE_CXX_COMPILER={options.compiler}", "-DCMAKE_CXX_FLAGS="], check=True, stdout=subprocess.DEVNULL)
    subprocess.run([options.cmake, "--build", options.work, "--target", "build-facts"], check=True, stdout=subprocess.DEVNULL)
    sys.exit()
commands = json.loads((options.work / "compile_commands.json").read_text())

# One command per source: a file that two targets share is the same file, but for the engine's scalar, and then double counts.
commands.sort(key=lambda command: "-DRINK_EXTENDED_PRECISION" not in command["command"])
checks = {command["file"]: re.sub(r" -o \S+ -c ", " -fsyntax-only -Werror -c ", command["command"]) for command in commands}
# A header may be used wherever all that Rink depends on is at hand.
places = sorted({place for command in commands for place in re.findall(r"-(?:I|isystem )\S+", command["command"])})
headers = {}
for folder in ("im", "rti", "game", "loadgen"):
    for header in sorted((options.root / folder).rglob("*.h")):
        unit = options.work / "headers" / header.relative_to(options.root).with_suffix(".h.cpp")
        headers[str(unit)] = header
        checks[str(unit)] = " ".join([options.compiler, "-std=c++20 -Wall -Wextra -Wconversion -Werror -fsyntax-only", *places, "-c", str(unit)])

share, shares = map(int, options.part.split("/"))


def is_chosen(file):
    path = os.path.relpath(file, options.work if file in headers else options.root)
    return options.only.search(file) and zlib.crc32(path.encode()) % shares == share


chosen = [file for file in checks if is_chosen(file)]
failures = 0
for file in chosen:
    if file in headers:
        pathlib.Path(file).parent.mkdir(parents=True, exist_ok=True)
        pathlib.Path(file).write_text(f'#include "{headers[file]}"\n' * 2)
    done = subprocess.run(checks[file], shell=True, cwd=options.work, capture_output=True, text=True)
    if done.returncode:
        failures += 1
        print(f"{file} does not compile alone:\n{done.stderr}")
print(f"{len(chosen) - failures} of {len(chosen)} files compile alone")
sys.exit(bool(failures))
