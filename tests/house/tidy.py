#!/usr/bin/env python3
"""Has clang-tidy check the sources by the rules of .clang-tidy, all but those of tests and benchmarks. In two steps: --configure makes the work folder, --part K/N then checks the
Kth of N shares of what it compiles. Sources of a target are checked several at a time, which reads their headers once. Fails with what it finds.
Prints "skipped: ..." where there is no clang-tidy."""
import argparse
import json
import os
import pathlib
import shutil
import subprocess
import sys
import zlib

arguments = argparse.ArgumentParser(description=__doc__)
arguments.add_argument("--root", type=pathlib.Path, required=True, help="the folder of Rink's sources")
arguments.add_argument("--work", type=pathlib.Path, required=True, help="a folder to configure in")
arguments.add_argument("--cmake", default="cmake")
arguments.add_argument("--compiler", default="g++")
arguments.add_argument("--configure", action="store_true", help="make the work folder and end")
arguments.add_argument("--part", default="0/1", metavar="K/N", help="only files whose path's CRC-32 modulo N is K")
options = arguments.parse_args()

if options.configure:
    subprocess.run([options.cmake, "-G", "Ninja", "-S", options.root, "-B", options.work, "-DRINK_UNITY=ON", "-DRINK_PRECOMPILED=OFF", "-DCMAKE_BUILD_TYPE=None",
                    "-DCMAKE_EXPORT_COMPILE_COMMANDS=ON", f"-DCMAKE_CXX_COMPILER={options.compiler}", "-DCMAKE_CXX_FLAGS="], check=True, stdout=subprocess.DEVNULL)
    subprocess.run([options.cmake, "--build", options.work, "--target", "build-facts"], check=True, stdout=subprocess.DEVNULL)
    sys.exit()

tidy = shutil.which("clang-tidy")
if not tidy:
    print("skipped: there is no clang-tidy")
    sys.exit()


def place(file):
    """The path from the root or, of files that include several sources, from the work folder."""
    return os.path.relpath(file, options.work if pathlib.Path(file).is_relative_to(options.work) else options.root)


share, shares = map(int, options.part.split("/"))
files = {command["file"] for command in json.loads((options.work / "compile_commands.json").read_text())}
chosen = sorted(file for file in files if not place(file).startswith(("tests/", "bench/")) and zlib.crc32(place(file).encode()) % shares == share)
findings = 0
for file in chosen:
    done = subprocess.run([tidy, "-p", options.work, "--quiet", f"--config-file={options.root}/.clang-tidy", "--checks=-bugprone-suspicious-include", file],
                          cwd=options.root, capture_output=True, text=True)
    # What is an error to the compiler in clang-tidy alone is none: version 14 lacks parts of C++20 that g++ 12 has.
    if "-warnings-as-errors]" in done.stdout or done.returncode and not done.stdout:
        findings += 1
        print(f"{place(file)}:\n{done.stdout}{done.stderr if not done.stdout else ''}")
print(f"{len(chosen)} files, {findings} with findings")
sys.exit(findings > 0)
