#!/usr/bin/env python3
"""Compiles every source and every header of Rink by itself, without generating code, and fails with what the compiler says of those that lean on others."""
import argparse
import concurrent.futures
import json
import os
import pathlib
import re
import subprocess
import sys

arguments = argparse.ArgumentParser(description=__doc__)
arguments.add_argument("--root", type=pathlib.Path, required=True, help="the folder of Rink's sources")
arguments.add_argument("--work", type=pathlib.Path, required=True, help="a folder to configure in")
arguments.add_argument("--cmake", default="cmake")
arguments.add_argument("--compiler", default="g++")
arguments.add_argument("--only", type=re.compile, default=re.compile(""), metavar="REGEX", help="only files whose path, as it is given to the compiler, matches")
options = arguments.parse_args()

subprocess.run([options.cmake, "-G", "Ninja", "-S", options.root, "-B", options.work, "-DRINK_UNITY=OFF", "-DCMAKE_BUILD_TYPE=None",
                f"-DCMAKE_CXX_COMPILER={options.compiler}", "-DCMAKE_CXX_FLAGS="], check=True, stdout=subprocess.DEVNULL)
subprocess.run([options.cmake, "--build", options.work, "--target", "build-facts"], check=True, stdout=subprocess.DEVNULL)
commands = json.loads((options.work / "compile_commands.json").read_text())

# One command per source: a file that two targets share is the same file.
checks = {command["file"]: re.sub(r" -o \S+ -c ", " -fsyntax-only -Werror -c ", command["command"]) for command in commands}
# A header may be used wherever all that Rink depends on is at hand.
places = sorted({place for command in commands for place in re.findall(r"-(?:I|isystem )\S+", command["command"])})
for folder in ("im", "rti", "game", "loadgen"):
    for header in sorted((options.root / folder).rglob("*.h")):
        unit = options.work / "headers" / header.relative_to(options.root).with_suffix(".h.cpp")
        unit.parent.mkdir(parents=True, exist_ok=True)
        unit.write_text(f'#include "{header}"\n' * 2)
        checks[str(unit)] = " ".join([options.compiler, "-std=c++20 -Wall -Wextra -Wconversion -Werror -fsyntax-only", *places, "-c", str(unit)])
checks = {file: command for file, command in checks.items() if options.only.search(file)}


def check(file):
    done = subprocess.run(checks[file], shell=True, cwd=options.work, capture_output=True, text=True)
    return file, done.returncode, done.stderr


with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
    failures = [(file, said) for file, code, said in pool.map(check, checks) if code]
for file, said in failures:
    print(f"{file} does not compile alone:\n{said}")
print(f"{len(checks) - len(failures)} of {len(checks)} files compile alone")
sys.exit(bool(failures))
