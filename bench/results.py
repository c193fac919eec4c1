#!/usr/bin/env python3
"""Measures what bench/results.md asks for and writes it into docs/results.md, its first table also into README.md: one machine, one commit, each figure below its command."""
import argparse
import csv
import json
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import textwrap
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent
WORDS_MAX = 3000
WIDTH = 118
BEGIN, END = "<!-- measured by ./rink results -->", "<!-- end of what is measured -->"
FAILED, TOO_LONG, INTERRUPTED = 3, 4, 130


class Failure(Exception):
    """What ends the whole, with its exit status."""

    def __init__(self, words, status=FAILED):
        super().__init__(words)
        self.status = status


def say(words):
    print("rink results: " + words, file=sys.stderr, flush=True)


class Measurements:
    """Outputs of commands by command, kept in a folder so that an interrupted measurement goes on."""

    def __init__(self, folder, commit, resumes):
        self.folder = folder
        self.file = folder / "measured.json"
        self.outputs = {}
        if folder.exists() and not self.file.exists() and any(folder.iterdir()):
            raise Failure(f"{folder.name}/ holds something else; move it away", 2)
        kept = json.loads(self.file.read_text()) if self.file.exists() else {"commit": commit, "outputs": {}}
        if resumes:
            if kept["commit"] != commit:
                raise Failure(f"--resume: {folder.name}/ was measured at {kept['commit']}, this is {commit}", 2)
            self.outputs = kept["outputs"]
        elif folder.exists():
            shutil.rmtree(folder)
        folder.mkdir(exist_ok=True)
        self.commit = commit
        self.keep()

    def keep(self):
        self.file.write_text(json.dumps({"commit": self.commit, "outputs": self.outputs}, indent=1))

    def output_of(self, command, allowed):
        """Standard output of `command`, which is run in a shell unless it was before."""
        if command not in self.outputs:
            say(command)
            began = time.monotonic()
            for taken in re.findall(r"--out (\S+)", command):
                shutil.rmtree(ROOT / taken, ignore_errors=True)
            done = subprocess.run(["bash", "-o", "pipefail", "-c", command], cwd=ROOT, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
            if done.returncode in (-signal.SIGINT, INTERRUPTED):
                raise KeyboardInterrupt
            if done.returncode not in allowed:
                raise Failure(f"'{command}' ended with status {done.returncode}: " + "\n".join(done.stderr.splitlines()[-8:]))
            say(f"took {time.monotonic() - began:.0f} s")
            self.outputs[command] = done.stdout
            self.keep()
        return self.outputs[command]


def rows_of(file):
    with open(file, newline="") as lines:
        return list(csv.DictReader(line for line in lines if not line.startswith("#")))


def three_digits(text):
    value = float(text)
    if value >= 100:
        return f"{value:.0f}"
    return f"{value:.1f}" if value >= 10 else f"{value:.2f}"


def crowd_table(folder):
    """The table and the sentences at the head of README.md, of the default experiment's report in `folder`."""
    shown = [("none", "periodic", "`periodic`: every position at every tick"), ("region", "periodic", "`periodic`"), ("region", "snapshot", "`snapshot`: differences to what clients have"),
             ("region", "dead-reckoning", "`dead-reckoning`: when clients are 5 mm off (IEEE 1278.1)"), ("region", "on-event", "`on-event`: a trajectory when it changes")]
    summary = rows_of(folder / "summary.csv")
    lines = ["| filter | update policy | payload, kB/s | on the wire, kB/s | recall | displayed error, mm |", "|---|---|---|---|---|---|"]
    for scheme, policy, words in shown:
        found = [row for row in summary if row["part"] == "sockets" and row["scheme"] == scheme and row["policy"] == policy]
        if len(found) != 1:
            raise Failure(f"{folder.name}/summary.csv has {len(found)} rows of {scheme}, {policy} over sockets")
        row = found[0]
        lines.append(f"| `{scheme}` | {words} | {three_digits(float(row['down_bytes_per_client_per_s_mean']) / 1e3)} | {three_digits(float(row['wire_bytes_per_client_per_s_mean']) / 1e3)} | "
                     f"{float(row['delivered_recall_mean']):.3f} | {three_digits(row['displayed_error_mm_rms_mean'])} |")
    lines.append("")
    for delay in (0.0, 50.0):
        rivals = [row for row in rows_of(folder / "equal_error.csv") if float(row["delay_ms"]) == delay and row["recall_is"] == "own" and row["policy"] == "on-event" and row["payload_ratio"]]
        if not rivals:
            raise Failure(f"{folder.name}/equal_error.csv has no rival at a delay of {delay:g} ms")
        rivals.sort(key=lambda row: float(row["payload_ratio"]))
        best = rivals[0]

        def ratio(row, figure):
            bounds = f" [{three_digits(row[figure + '_low'])}, {three_digits(row[figure + '_high'])}]" if row[figure + "_low"] else ""
            return three_digits(row[figure]) + bounds

        others = ", ".join(f"`{row['rival']}` {three_digits(row['payload_ratio'])} and {three_digits(row['wire_ratio'])}" for row in rivals[1:])
        lead = "At *equal displayed error and equal recall*, without delay," if delay == 0.0 else f"With {delay:g} ms of delay"
        lines += textwrap.wrap(f"{lead} the best rival of `on-event`, `{best['rival']}`, sends {ratio(best, 'payload_ratio')} times its payload and {ratio(best, 'wire_ratio')} times its bytes on the wire; "
                               f"{others} times.", 160)
    return lines


def provenance_lines(folder):
    facts = json.loads((folder / "provenance.json").read_text())
    for told_elsewhere in ("schema", "command"):
        facts.pop(told_elsewhere, None)
    return [line for name, fact in facts.items() for line in textwrap.wrap(f"{name}: {fact}", WIDTH, subsequent_indent="  ", break_long_words=False)]


def measure(template, measurements):
    """Runs all commands of the page in their order."""
    for status, command in re.findall(r"^```measured(?: or (\d+))?\n(.*?)\n```$", template, re.M | re.S):
        measurements.output_of(joined(command.splitlines()), {0} | ({int(status)} if status else set()))


def joined(lines):
    return " ".join(part.strip() for part in lines)


def page_of(template, measurements):
    """The page, and the lines of it that README.md shows, too."""
    lines, head, at = [], [], 0
    source = template.splitlines()
    while at < len(source):
        fence = re.fullmatch(r"```(measured|provenance|crowd)( or \d+)?", source[at])
        if not fence:
            lines.append(source[at])
            at += 1
            continue
        end = source.index("```", at)
        asked = joined(source[at + 1:end])
        if fence[1] == "crowd":
            head = [BEGIN, *crowd_table(ROOT / asked), END]
            lines += head
        elif fence[1] == "provenance":
            lines += ["```", *provenance_lines(ROOT / asked), "```"]
        else:
            output = measurements.outputs[asked].rstrip().splitlines()
            said = textwrap.wrap("$ " + asked, WIDTH, subsequent_indent="    ", break_long_words=False, break_on_hyphens=False)
            lines += ["```", *[line + " \\" for line in said[:-1]], said[-1], *[line.rstrip() for line in output], "```"]
        at = end + 1
    return "\n".join(lines) + "\n", head


def into_readme(readme, head):
    text = readme.read_text()
    if text.count(BEGIN) != 1 or text.count(END) != 1 or text.index(BEGIN) > text.index(END):
        raise Failure(f"{readme.name} has no place for figures: a line '{BEGIN}' and below it one '{END}'")
    begin, end = text.index(BEGIN), text.index(END) + len(END)
    readme.write_text(text[:begin] + "\n".join(head) + text[end:])


def main():
    parser = argparse.ArgumentParser(prog="rink results", description="Measure every figure of docs/results.md on this machine (some twenty minutes, best with nothing else running) and write that page and the table in "
                                     "README.md. Commands and words are those of bench/results.md; reports stay in report-results/.",
                                     epilog="Exit status: 0 done; 2 bad usage; 3 a command failed; 4 the page has more than 3,000 words; 130 interrupted. Example: ./rink results --resume")
    parser.add_argument("--resume", action="store_true", help="go on where a measurement of the same commit was interrupted")
    parser.add_argument("--list", action="store_true", help="print the commands and run none")
    parser.add_argument("--template", type=pathlib.Path, default=ROOT / "bench/results.md", help=argparse.SUPPRESS)
    parser.add_argument("--page", type=pathlib.Path, default=ROOT / "docs/results.md", help=argparse.SUPPRESS)
    parser.add_argument("--readme", type=pathlib.Path, default=ROOT / "README.md", help=argparse.SUPPRESS)
    options = parser.parse_args()
    if options.list:
        for command in re.findall(r"^```measured.*?\n(.*?)\n```$", options.template.read_text(), re.M | re.S):
            print(joined(command.splitlines()))
        return 0
    try:
        commit = subprocess.run([ROOT / "rink", "--version"], capture_output=True, text=True, check=True).stdout.strip()
        template = options.template.read_text()
        measurements = Measurements(ROOT / "report-results", commit, options.resume)
        measure(template, measurements)
        page, head = page_of(template, measurements)
        words = len(page.split())
        if words > WORDS_MAX:
            (ROOT / "report-results/results.md").write_text(page)
            raise Failure(f"the page has {words} words, more than {WORDS_MAX}; it is in report-results/results.md", TOO_LONG)
        into_readme(options.readme, head)
        options.page.write_text(page)
    except KeyboardInterrupt:
        say("interrupted; --resume goes on")
        return INTERRUPTED
    except OSError as error:
        say(str(error))
        return FAILED
    except Failure as failure:
        say(str(failure))
        return failure.status
    say(f"{options.page} and {options.readme} written, {words} words")
    return 0


if __name__ == "__main__":
    sys.exit(main())
