#!/usr/bin/env python3
"""A plugin built from the installed template, and a condition, decide in `rink compare` as the built-in schemes that mean the same: plugin_test.py CMAKE BUILD WORK COMPILER"""
import json
import os
import pathlib
import shutil
import subprocess
import sys

EXPERIMENT = """name = "same"
scene = "crowd"
schemes = ["diamond", "when near_by_steps", "aura", "when 'gap <= reach'", "region with nearest(k=1000)", "region"]
policies = ["on-event"]
clients = [10]
duration_s = 1
warm_up_s = 0.2
transport = "virtual"
view_margin = 0
"""
SAME = [("diamond", "when near_by_steps"), ("aura", "when 'gap <= reach'"), ("region", "region with nearest(k=1000)")]
# Decided by what each client is told of, in virtual time.
FIELDS = ["state_hash", "down_bytes_per_client_per_s", "filter_precision", "filter_recall", "delivered_recall", "churn_per_client_per_s"]


def run(*command, status=0):
    """What the command has said; ends the test where it ends otherwise."""
    done = subprocess.run(command, capture_output=True, text=True, cwd=work)
    said = done.stdout + done.stderr
    if done.returncode != status:
        sys.exit(f"{' '.join(map(str, command))} ended with {done.returncode}:\n{said}")
    return said


cmake, build, work, compiler = sys.argv[1], sys.argv[2], pathlib.Path(sys.argv[3]), sys.argv[4]
os.environ.pop("MAKEFLAGS", None)
shutil.rmtree(work, ignore_errors=True)
work.mkdir(parents=True)
for component in ("library", "commands"):
    run(cmake, "--install", build, "--component", component, "--prefix", work / "prefix")
run(cmake, "-S", work / "prefix/share/rink/plugin", "-B", "plugin", f"-DCMAKE_PREFIX_PATH={work / 'prefix'}", "-DCMAKE_BUILD_TYPE=Release", f"-DCMAKE_CXX_COMPILER={compiler}")
run(cmake, "--build", "plugin")

(work / "same.toml").write_text(EXPERIMENT)
rink = work / "prefix/bin/rink"
refusal = run(rink, "compare", "same.toml", "--out", "none", status=2)
if "name its file with --plugin" not in refusal:
    sys.exit(f"without the plugin: {refusal}")
run(rink, "compare", "same.toml", "--plugin", "plugin/near_by_steps.so", "--out", "out")
rows = map(json.loads, (work / "out/runs.jsonl").read_text().splitlines())
by_scheme = {row["scheme"]: row for row in rows if "scheme" in row}
for built_in, own in SAME:
    for field in FIELDS:
        if by_scheme[built_in][field] != by_scheme[own][field]:
            sys.exit(f"{field}: {by_scheme[built_in][field]} under {built_in}, {by_scheme[own][field]} under {own}")
if by_scheme["aura"]["filter_recall"] == by_scheme["diamond"]["filter_recall"]:
    sys.exit("schemes that mean different things decide the same")
shutil.rmtree(work)
