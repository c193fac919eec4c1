#!/usr/bin/env python3
"""Runs ctest and ends with the tests that were skipped, the reason of each, and the total; with --long-share, runs this commit's seventh of the long tests."""
import math
import os
import pathlib
import re
import signal
import subprocess
import sys
import tempfile
import time
import xml.etree.ElementTree
import zlib

SHARES = 7
SHARE_S = float(os.environ.get("RINK_LONG_SHARE_S", 360))


def results_in(folder):
    """What ctest wrote of each test that it began, by name; nothing where the user chose another file."""
    try:
        return {case.get("name"): case for case in xml.etree.ElementTree.parse(folder / "results.xml").iter("testcase")}
    except (OSError, xml.etree.ElementTree.ParseError):
        return {}


def reason_of(case):
    """Why a test was skipped: GoogleTest prints it below the line of the skip, others after "skipped:"."""
    said = "" if case is None else case.findtext("system-out") or ""
    found = re.search(r": Skipped\n(.+)", said) or re.search(r"^skipped: (.+)", said, re.MULTILINE)
    return found[1] if found else "it gave no reason"


def ended(log, how):
    """The names of those that ctest lists as having ended so."""
    return re.findall(rf"^\s+\d+ - (.+) \({how}\)$", log, re.MULTILINE)


def run(build, folder, arguments):
    # Two places for each processor: a test takes two, one that mostly waits takes one (cmake/modules.cmake).
    places = 2 * len(os.sched_getaffinity(0))
    command = ["ctest", "--test-dir", build, "--output-on-failure", "-j", str(places), "--output-log", folder / "log", "--output-junit", folder / "results.xml"]
    return subprocess.run([*command, *arguments]).returncode


def log_in(folder):
    file = folder / "log"
    return file.read_text(errors="replace") if file.exists() else ""


def this_share(build):
    """The long tests whose turn it is."""
    source = pathlib.Path(__file__).parent
    counted = subprocess.run(["git", "-C", source, "rev-list", "--count", "HEAD"], capture_output=True, text=True)
    commits = int(counted.stdout) if counted.returncode == 0 else 0
    listed = subprocess.run(["ctest", "--test-dir", build, "-N", "-L", "long"], capture_output=True, text=True, check=True).stdout
    names = re.findall(r"^ *Test *#\d+: (.+)$", listed, re.MULTILINE)
    return [name for name in names if zlib.crc32(name.encode()) % SHARES == commits % SHARES]


def run_share(build, folder, arguments):
    """A test that the limit ends is named. It fails only if it had half of the time, for then it hangs or must be split."""
    names = this_share(build)
    # ctest wants an instant of the local day, in whole seconds.
    os.environ["TZ"] = "UTC0"
    stop = time.strftime("%H:%M:%S", time.gmtime(math.ceil(time.time() + SHARE_S)))
    chosen = "^(" + "|".join(re.sub(r"([^\w/])", r"\\\1", name) for name in names) + ")$"
    status = run(build, folder, ["--no-tests=ignore", "-L", "long", "-R", chosen, "--stop-time", stop, *arguments])
    log, results = log_in(folder), results_in(folder)
    took_s = {name: float(results[name].get("time")) for name in ended(log, "Timeout") if name in results}
    for name, seconds in took_s.items():
        print(f"\n{name}: cut off by the limit of {SHARE_S:g} s, after {seconds:.1f} s")
    for name in names:
        if results and name not in results:
            print(f"\n{name}: cut off by the limit of {SHARE_S:g} s before it began")
    if any(seconds >= SHARE_S / 2 for seconds in took_s.values()):
        print("\nwhat takes more than half of the limit hangs, or must be split")
        return status or 1
    if not results:
        return status
    failed = re.search(r"The following tests FAILED:\n((?:\s+\d+ - .*\n?)+)", log)
    return status if failed and not all(line.endswith(" (Timeout)") for line in failed[1].strip().split("\n")) else 0


def summarise(folder):
    log, results = log_in(folder), results_in(folder)
    skipped = ended(log, "Skipped")
    if skipped:
        print("\nSkipped:")
    for name in skipped:
        print(f"  {name}: {reason_of(results.get(name))}")
    for total in re.findall(r"^.*tests passed, .* failed out of .*$", log, re.MULTILINE)[-1:]:
        print(f"\n{total}")


def main():
    build, *arguments = sys.argv[1:]
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(143))  # takes ctest along
    with tempfile.TemporaryDirectory(prefix="rink-tests-") as name:
        folder = pathlib.Path(name)
        try:
            if arguments[:1] == ["--long-share"]:
                status = run_share(build, folder, arguments[1:])
            else:
                status = run(build, folder, ["--no-tests=error", *arguments])
        except KeyboardInterrupt:
            return 130
        summarise(folder)
        return status


if __name__ == "__main__":
    sys.exit(main())
