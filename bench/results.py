#!/usr/bin/env python3
"""Measures what bench/results.md asks for and writes it into docs/results.md, its first table also into README.md, with the best rival: one machine, one commit, each figure below its command."""
import argparse
import csv
import json
import math
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
POINTS_WANTED = 5  # on either side of an error, as loadgen/measure/equal_error.h has it
THRESHOLD = 0.005  # of dead reckoning in the table [m]
BEGIN, END = "<!-- measured by ./rink results -->", "<!-- end of what is measured -->"
FORETOLD, TOO_FEW = "Foretold is {} to {} % {} what held.", "Probes of fewer clients were too few to foretell {}."
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


def best_rival_lines(folder):
    """What the best rival sends at equal error and equal recall, by margins, at each delay: in one sentence for the head of README.md."""
    first = {}
    for row in rows_of(folder / "equal_error.csv"):
        if row["policy"] == "on-event" and row["recall_is"] != "own":
            first.setdefault(float(row["delay_ms"]), row)
    parts = [f"`{row['rival']}` {ratio_text(row, 'payload', 'end')} " + (f"with {delay:g} ms of delay" if delay else "without delay") for delay, row in sorted(first.items())]
    return textwrap.wrap("At equal displayed error and equal recall the best rival of `on-event` sends so many times its payload: " + ", ".join(parts) + " ([all](docs/results.md#the-crowd-filters-policies-and-rivals-at-equal-error)).", 160,
                         break_on_hyphens=False)


def three_digits(text):
    value = float(text)
    if value >= 100:
        return f"{value:.0f}"
    return f"{value:.1f}" if value >= 10 else f"{value:.2f}"


CROWD = [  # part, filter, policy, extrapolate, in words
    ("prompt", "none", "periodic", "0", "`periodic (paper)`: shown where they were said to be; in virtual time"),
    ("sockets", "none", "periodic", "1", "`periodic`: every position at every tick"),
    ("sockets", "region", "periodic", "1", "`periodic`"),
    ("sockets", "region", "snapshot", "1", "`snapshot`: differences to what clients have"),
    ("sockets", "region", "dead-reckoning", "1", "`dead-reckoning`: when clients are 5 mm off (IEEE 1278.1)"),
    ("prompt", "region", "dead-reckoning-drag", "1", "`dead-reckoning-drag`: clients know the drag; in virtual time"),
    ("sockets", "region", "on-event", "1", "`on-event`: a trajectory when it changes")]


def crowd_table(folder):
    """The table and the sentences at the head of README.md, of the default experiment's report in `folder`."""
    summary = rows_of(folder / "summary.csv")
    lines = ["|filter|update policy|payload, kB/s|on the wire, kB/s|recall|displayed error, mm|", "|---|---|---|---|---|---|"]
    for part, scheme, policy, extrapolates, words in CROWD:
        found = [row for row in summary if (row["part"], row["scheme"], row["policy"], row["extrapolate"]) == (part, scheme, policy, extrapolates)]
        if len(found) != 1:
            raise Failure(f"{folder.name}/summary.csv has {len(found)} rows of {scheme}, {policy} in the part {part}")
        row = found[0]
        lines.append(f"|`{scheme}`|{words}|{three_digits(float(row['down_bytes_per_client_per_s_mean']) / 1e3)}|{three_digits(float(row['wire_bytes_per_client_per_s_mean']) / 1e3)}|"
                     f"{four_decimals(row['delivered_recall_mean'])}|{three_digits(row['displayed_error_mm_rms_mean'])}|")
    return lines + ["", *equal_error_lines(folder)]


def four_decimals(text):
    """Never rounded up to 1."""
    return f"{math.floor(float(text) * 1e4 + 1e-6) / 1e4:.4f}"


def ratio_text(row, figure, end):
    """A ratio with its interval and marks: < at most, ~ no significant difference."""
    if not row[figure + "_ratio"]:
        return "-"
    text = ("<" if row[end] == "not_left" else "") + three_digits(row[figure + "_ratio"])
    if row[figure + "_ratio_low"]:
        text += f" [{three_digits(row[figure + '_ratio_low'])}, {three_digits(row[figure + '_ratio_high'])}]"
    return text + (" ~" if row[figure + "_difference"] == "no significant difference" else "")


def equal_error_lines(folder):
    """What rivals send at equal error and recall, at each delay and recall compared, and how much of it hangs on the error that is compared."""
    rows = [row for row in rows_of(folder / "equal_error.csv") if row["policy"] == "on-event"]
    blocks = {}
    for row in rows:
        blocks.setdefault((float(row["delay_ms"]), row["recall_is"]), []).append(row)
    for delay in (0.0, 50.0):
        if not any(row["payload_ratio"] for row in blocks.get((delay, "own"), [])):
            raise Failure(f"{folder.name}/equal_error.csv has no rival at a delay of {delay:g} ms")
    first = rows[0]
    lines = textwrap.wrap(f"*At equal displayed error and equal recall*, {first['clients']} clients under `{first['scheme']}` in virtual time: how many times the payload, and the bytes on the wire, of `on-event` at "
                          f"{float(first['tick_rate_hz']):g} Hz its rivals send, the best first, with 95 % intervals:", 160) + [""]
    for (delay, recall_is), block in blocks.items():
        means = "without a margin" if recall_is == "own" else "by margins"
        lead = "- " + (f"{delay:g} ms of delay" if delay else "no delay") + f", recall {four_decimals(block[0]['recall'])} {means}: "
        lines += textwrap.wrap(lead + ", ".join(f"`{row['rival']}` {ratio_text(row, 'payload', 'end')} and {ratio_text(row, 'wire', 'wire_end')}" for row in block), 160, subsequent_indent="  ", break_on_hyphens=False)
    return lines + ["", *textwrap.wrap(caveats(folder, rows, blocks), 160, break_on_hyphens=False)]


def caveats(folder, rows, blocks):
    """What marks mean, which rivals have few points, and the best rival at the rate and the threshold of the table."""
    sentences = []
    if any(row[figure + "_difference"] == "no significant difference" for row in rows for figure in ("payload", "wire")):
        sentences.append("~: no significant difference.")
    if any(row[end] == "not_left" for row in rows for end in ("end", "wire_end")):
        sentences.append("<: at most.")
    few = sorted({row["rival"] for row in rows if min(int(row["points_below"]), int(row["points_above"])) < POINTS_WANTED})
    if few:
        sentences.append("Fewer than five points on a side of the error: " + ", ".join(f"`{rival}`" for rival in few) + ".")
    best = blocks[0.0, "own"][0]["rival"]
    rate = float(rows[0]["tick_rate_hz"])
    without, late = (at_same_rate(folder, best, rate, delay) for delay in (0.0, 50.0))
    sentences.append(f"These ratios depend on the error compared, that of `on-event` at {rate:g} Hz. At the same {rate:g} Hz `{best}` with its {1e3 * THRESHOLD:g} mm errs {without[0]} times as far as that and sends {without[1]} times the "
                     f"payload and {without[2]} times the bytes on the wire; with 50 ms of delay {late[0]}, {late[1]} and {late[2]} times.")
    return " ".join(sentences)


def at_same_rate(folder, rival, rate, delay):
    """Displayed error, payload and wire bytes of `rival` at its own threshold over those of on-event, both without a margin: geometric means over seeds."""
    figures = {}
    with open(folder / "runs.jsonl") as lines:
        for run in map(json.loads, lines):
            if "policy" in run and run["valid"] and (run["scheme"], run["view_margin"], run["tick_rate_hz"], run["delay_ms"], run["threshold"]) == ("region", 0, rate, delay, THRESHOLD) and run["transport"] == "virtual":
                figures[run["policy"], run["seed"]] = run["displayed_error_mm"]["rms"], run["down_bytes_per_client_per_s"], run["wire_bytes_per_client_per_s"]
    pairs = [(figures[rival, seed], own) for (policy, seed), own in figures.items() if policy == "on-event" and (rival, seed) in figures]
    if not pairs:
        raise Failure(f"{folder.name}/runs.jsonl has no run of {rival} at {rate:g} Hz and {delay:g} ms of delay")
    return [f"{math.exp(sum(math.log(theirs[i] / own[i]) for theirs, own in pairs) / len(pairs)):.2f}" for i in range(3)]


def saturation_lines(file):
    """How far what is foretold lies from what held, of a saturation.csv."""
    rows = rows_of(file)
    off = [100.0 * (float(row["foretold_clients"]) / float(row["held_clients"]) - 1.0) for row in rows if row["foretold_clients"] and row["held_clients"]]
    without = sorted({f"`{row['scheme']}`" for row in rows if not row["foretold_clients"]})
    sentences = []
    if off:
        lowest, highest = round(min(off)), round(max(off))
        sentences.append(FORETOLD.format(lowest, highest, "above" if lowest >= 0 else "off"))
    if without:
        sentences.append(TOO_FEW.format(", ".join(without)))
    return textwrap.wrap(" ".join(sentences), 160)


def provenance_lines(folder, *others):
    """What made the report in `folder`, and with which flags the programs that wrote `others`, files with provenance at their head, were built."""
    facts = json.loads((folder / "provenance.json").read_text())
    for told_elsewhere in ("schema", "command", "packages"):
        facts.pop(told_elsewhere, None)
    for other in others:
        with open(other) as lines:
            heads = dict(line[2:].rstrip("\n").split(": ", 1) for line in lines if line.startswith("# ") and ": " in line)
        facts["accuracy and bench"] = f"{heads['compiler']}, {heads['flags']}"
        if engines := [f"{engine} {heads[engine]}" for engine in ("chipmunk", "box2d", "box2d3") if engine in heads]:
            facts["other engines"] = ", ".join(engines)
    return [line for name, fact in facts.items() for line in textwrap.wrap(f"{name}: {fact}", WIDTH, subsequent_indent="  ", break_long_words=False)]


def printed(command):
    """`command` in lines that a shell reads as it was run: broken between words alone, never within quotes."""
    words, lines = re.findall(r"""(?:'[^']*'|"(?:\\.|[^"\\])*"|\\.|[^\s'"\\])+""", command), ["$"]
    for word in words:
        if len(lines[-1]) + 1 + len(word) + len(" \\") > WIDTH and lines[-1].strip() not in ("$", ""):
            lines[-1] += " \\"
            lines.append("   ")
        lines[-1] += " " + word
    return lines


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
        fence = re.fullmatch(r"```(measured|provenance|crowd|saturation)( or \d+)?", source[at])
        if not fence:
            lines.append(source[at])
            at += 1
            continue
        end = source.index("```", at)
        asked = joined(source[at + 1:end])
        if fence[1] == "crowd":
            table = crowd_table(ROOT / asked)
            lines += [BEGIN, *table, END]
            head = [BEGIN, *table[:table.index("")], "", *best_rival_lines(ROOT / asked), END]
        elif fence[1] == "provenance":
            lines += ["```", *provenance_lines(*(ROOT / name for name in asked.split())), "```"]
        elif fence[1] == "saturation":
            lines += saturation_lines(ROOT / asked)
        else:
            output = measurements.outputs[asked].rstrip().splitlines()
            lines += ["```", *printed(asked), *[line.rstrip() for line in output], "```"]
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
