#!/usr/bin/env python3
"""Has clang-tidy check the sources by the rules of .clang-tidy: the Kth of N shares of those that the work folder of alone.py compiles. Fails with what it finds.
Prints "skipped: ..." where there is no clang-tidy."""
import argparse
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import zlib

arguments = argparse.ArgumentParser(description=__doc__)
arguments.add_argument("--root", type=pathlib.Path, required=True, help="the folder of Rink's sources")
arguments.add_argument("--work", type=pathlib.Path, required=True, help="a folder that alone.py has configured")
arguments.add_argument("--part", default="0/1", metavar="K/N", help="only files whose path's CRC-32 modulo N is K")
arguments.add_argument("--only", type=re.compile, default=re.compile("^(im|rti|game|loadgen|bench)/"), metavar="REGEX",
                       help="only files whose path from the root matches (default: all but tests)")
options = arguments.parse_args()

tidy = shutil.which("clang-tidy")
if not tidy:
    print("skipped: there is no clang-tidy")
    sys.exit()
share, shares = map(int, options.part.split("/"))
paths = sorted({os.path.relpath(command["file"], options.root) for command in json.loads((options.work / "compile_commands.json").read_text())})
chosen = [path for path in paths if options.only.search(path) and zlib.crc32(path.encode()) % shares == share]
findings = 0
for path in chosen:
    done = subprocess.run([tidy, "-p", options.work, "--quiet", options.root / path], cwd=options.root, capture_output=True, text=True)
    if done.returncode:
        findings += 1
        print(f"{path}:\n{done.stdout}{done.stderr if not done.stdout else ''}")
print(f"{len(chosen)} sources, {findings} with findings")
sys.exit(findings > 0)
