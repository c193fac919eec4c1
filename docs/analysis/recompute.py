#!/usr/bin/env python3
"""Computes figures of a report of `rink compare` again from its evidence and holds them against tidy.csv.

Nothing of the product is used: the formulas are those of docs/metrics.md, written anew. Each column is named with how
many of its runs were checked, and with the reason where that is not all. Exit status: 0 all that was checked agrees,
1 something differs, 2 nothing could be checked.
"""
import collections
import csv
import json
import math
import pathlib
import sys
import tomllib

sys.dont_write_bytecode = True
import truth

TOLERANCE = 1e-9  # of the value
ROUNDING_US = 0.5e-3  # evidence has the cost of each tick to the nanosecond, which moves a mean by half of one at most
HEADERS = 66  # bytes: Ethernet 14, IPv4 20, TCP with timestamps 32
PARAMETERS = (("view_fraction", "view", "0.05"), ("view_margin", "margin", "0.3"), ("sweep_ticks", "sweep", "0"),
              ("cell_size", "cell", "0"), ("tick_rate_hz", "rate", "30"), ("threshold", "threshold", "0.005"),
              ("extrapolate", "extrapolate", "1"), ("nodes", "nodes", "1"), ("output_rate_hz", "told", "0"))  # column, what file names call it, what they leave out
KEYS = ("part", "mode", "scheme", "policy", "clients", "pucks", "bats", "server_cores") + tuple(p[0] for p in PARAMETERS) + ("seed",)
COSTS = ("physics_us_per_tick", "filter_us_per_tick", "send_us_per_tick")
OF_TRUTH = ("filter_precision", "filter_recall", "delivered_", "interactions", "missed_", "late_entry_", "position_error_", "displayed_error_", "wasted_")
OF_EVIDENCE = ("ticks", "tick_us_", "churn_", "flapping_", "entities") + COSTS
OF_KERNEL = ("server_cpu_s", "bots_cpu_s", "busiest_node_cpu_s", "mean_node_cpu_s")
# What nothing in cells/ but the report of a process has: that both say the same shows no more than that nobody changed either.
COPIED = {
    "ticks_on_time_fraction": ("server", "ticks_on_time_fraction", "what the server counted by its clock"),
    "measured_s": ("server", "measured_s", "what the server read off its clock"),
    "server_rss_bytes": ("server", "server_rss_bytes", "what the server asked of the kernel"),
    "keys_due": ("bots", "keys_due", "what the bots counted"),
    "keys_sent": ("bots", "keys_sent", "what the bots counted"),
    "late_sends_fraction": ("bots", "late_sends_fraction", "what the bots counted by their clock"),
    "bots_cpu_share": ("bots", "cpu_share", "what the bots asked of the kernel"),
    "histogram_ns_per_record": ("bots", "histogram_ns_per_record", "what the bots measured at their start"),
}


def file_name_of(scheme):
    name = scheme.replace(" ", "_").replace("(", "[").replace(")", "]")
    if len(name) <= 100:
        return name
    digest = 0xCBF29CE484222325  # FNV-1a
    for byte in name.encode():
        digest = ((digest ^ byte) * 0x100000001B3) % 2**64
    return name[:83] + f"-{digest:016x}"


def name_of(cell):
    is_paper = cell["policy"] == "periodic" and cell["extrapolate"] == "0"
    name = (cell["part"] + "-" if cell["part"] else "") + f"{cell['mode']}-{file_name_of(cell['scheme'])}-{cell['policy']}"
    name += ("-paper-" if is_paper else "-") + cell["clients"]
    for key in ("pucks", "bats"):
        name += f"-{key}{cell[key]}" if cell[key] != "0" else ""
    for key, short, standard in PARAMETERS:
        name += f"-{short}{cell[key]}" if cell[key] != standard and not (is_paper and key == "extrapolate") else ""
    return name + (f"-cores{cell['server_cores']}" if cell["server_cores"] != "1" else "") + f"-seed{cell['seed']}"


def json_of(file):
    return json.loads(file.read_text()) if file.exists() else None


def evidence_of(file):
    """The lines before the last, which says how many they are; nothing if the file is missing or cut."""
    if not file.exists():
        return None
    lines = [json.loads(line) for line in file.read_text().splitlines()]
    return lines[:-1] if lines and lines[-1].get("lines") == len(lines) - 1 else None


def percentiles(histogram, field):
    """Of the log-linear buckets: each power of two of a nanosecond in 512 parts; ten samples must lie beyond."""
    count, figures = histogram["count"], {}
    for suffix, fraction in (("p50", 0.5), ("p90", 0.9), ("p95", 0.95), ("p99", 0.99), ("p999", 0.999)):
        if count * (1 - fraction) < 10 - 1e-6:
            continue
        rank, seen = max(1, math.ceil(fraction * count - 1e-6)), 0
        for bucket, times in histogram["buckets"]:
            seen += times
            if seen >= rank:
                break
        shift = bucket // 512 + 1
        middle = (((bucket % 512 + 512) << shift) + 0.5 * 2**shift) * 1e-9
        figures[f"{field}_{suffix}"] = 1e3 * min(max(middle, histogram["min_s"]), histogram["max_s"])
    if count:
        figures[f"{field}_max"] = 1e3 * histogram["max_s"]
    return figures


def traffic_figures(server, bots):
    """Payload, bytes with headers, messages and segments, from what each end counted within its measured span."""
    clients, span, bots_span = server["clients"], server["measured_s"], bots["measured_s"]
    down, up = server["bytes_sent"], server["bytes_received"]
    figures = {"down_bytes_per_client_per_s": down / span / clients, "up_bytes_per_client_per_s": up / span / clients}
    if "between_nodes_bytes" in server:  # of several nodes; what each sent whom is in its own report
        figures["between_nodes_bytes_per_s"] = server["between_nodes_bytes"] / span
    else:
        figures["busiest_node_bytes_per_s"] = (down + up) / span
        figures["busiest_node_events_per_s"] = server["physics_events"] / span
    figures["messages_per_s"] = server["messages_sent"] / span
    figures["writes_per_s"] = server["writes_sent"] / span
    wire = segments = pure = 0.0
    for end, seconds in ((server, span), (bots, bots_span)):
        acknowledgements = end["acknowledgements_sent"] + 0.5 * max(0, end["segments_sent"] - end["kernel_segments_sent"])
        wire += (end["bytes_sent"] + HEADERS * (end["segments_sent"] + acknowledgements)) / seconds
        segments += end["segments_sent"] / seconds
        pure += acknowledgements / seconds
    link = server["busiest_link_bytes"] / span if "busiest_link_bytes" in server else wire
    figures.update(wire_bytes_per_client_per_s=wire / clients, busiest_link_bytes_per_s=link, segments_per_s=segments, acknowledgements_per_s=pure)
    states, keys = server["state_bytes_sent"], server["key_bytes_received"]
    control = max(0, down + up - states - keys)
    figures["control_bytes_fraction"] = control / (down + up)
    for field, part in (("updates", states), ("keys", keys), ("interest", control)):
        figures[field + "_bytes_per_client_per_s"] = part / span / clients
    received = bots["bytes_received_by_bot"]
    squares = sum(share * share for share in received)
    if squares:
        figures["fairness_jain"] = sum(received) ** 2 / (len(received) * squares)
    return figures


def peer_figures(peers):
    """Payload and events of peers, from what they counted within the measured span: what all send is what all receive."""
    clients, span = peers["clients"], peers["measured_s"]
    figures = {"down_bytes_per_client_per_s": peers["bytes_sent"] / span / clients, "up_bytes_per_client_per_s": peers["bytes_received"] / span / clients}
    for subject in ("halo", "claims", "agreement", "interest", "updates", "keys", "standby"):
        figures[subject + "_bytes_per_client_per_s"] = peers[subject + "_bytes"] / span / clients
    figures["busiest_node_bytes_per_s"], figures["busiest_node_events_per_s"] = peers["busiest_node_bytes"] / span, peers["busiest_node_events"] / span
    if "busiest_link_bytes" in peers:
        figures["busiest_link_bytes_per_s"] = peers["busiest_link_bytes"] / span
    return figures


def tick_figures(evidence):
    """From the first tick that is due when warm-up is over up to the last, which ends the game and is not counted."""
    head = evidence[0]
    costs = [tick for line in evidence if "ticks_us" in line for tick in line["ticks_us"]]
    ticks = [tick for tick in costs if head["from_s"] - 1e-9 <= tick[0] < head["until_s"] - 1e-9]
    figures = {"ticks": len(ticks)}
    if any(sum(tick[1:]) > 0.0 for tick in costs):
        figures.update({figure: math.fsum(tick[i + 1] for tick in ticks) / len(ticks) for i, figure in enumerate(COSTS) if ticks})
        figures.update(truth.percentiles([sum(tick[1:]) for tick in costs], "tick_us", 1.0))
    return figures


def scope_figures(head, bots):
    """Churn and flapping of the watched players, from the times at which changes of scope arrived; the own bat left out."""
    if not bots[0]["is_complete"]:
        return {}
    begin, end, entries, exits, flaps, players = head["from_s"], head["until_s"], 0, 0, 0, 0
    for bot in (line for line in bots if "changes_us" in line):
        players += 1
        present, left_s = set(), {}
        for instant_us, thing, is_in in sorted(bot["changes_us"], key=lambda change: change[0]):
            instant = instant_us * 1e-6
            if instant >= end:
                break
            if (thing in present) == bool(is_in):
                continue
            counts = instant >= begin and thing != bot["bat"]
            if is_in:
                present.add(thing)
                entries += counts
                flaps += counts and instant - left_s.get(thing, -math.inf) < 1.0
            else:
                present.remove(thing)
                left_s[thing] = instant
                exits += counts
    figures = {"churn_per_client_per_s": (entries + exits) / (players * (end - begin))} if players else {}
    if entries:
        figures["flapping_fraction"] = flaps / entries
    return figures


class Recomputed:
    """The figures that the files of the run called `name` give, what they merely repeat, and why there is no more. Points of curves are judged without late entries."""

    def __init__(self, cells, name, is_of_curves):
        self.figures, self.copied = {}, {}
        self.reports = {"server": json_of(cells / f"{name}.server.json"), "bots": json_of(cells / f"{name}.bots.json")}
        self.peers = json_of(cells / f"{name}.peers.json")
        self.why_no_evidence = self.why_not_judged = ""
        self.read_reports()
        self.read_evidence(cells, name, is_of_curves)

    def read_reports(self):
        server, bots = self.reports["server"], self.reports["bots"]
        if server and bots:
            self.figures.update(traffic_figures(server, bots))
        if self.peers:
            self.figures.update(peer_figures(self.peers))
        for figure, (whose, key, _) in COPIED.items():
            report = self.peers or server if whose == "server" else bots
            if report and report.get(key) is not None:
                self.copied[figure] = report[key]
        if bots:
            self.figures.update(percentiles(bots["update_age_ms"], "update_age_ms"))
            self.figures["update_age_samples"] = bots["update_age_ms"]["count"]
            if not bots["schedule_trouble"]:
                self.figures.update(percentiles(bots["key_to_effect_ms"], "key_to_effect_ms"))

    def read_evidence(self, cells, name, is_of_curves):
        server, bots = evidence_of(cells / f"{name}.server.jsonl"), evidence_of(cells / f"{name}.bots.jsonl")
        if server is None or bots is None:
            self.why_no_evidence = self.why_not_judged = "points of curves without evidence" if is_of_curves else "no whole evidence"
            return
        if not self.peers:
            self.figures.update(tick_figures(server))
            self.figures["entities"] = sum(len(line["objects"]) for line in server if "objects" in line)
        self.figures.update(scope_figures(server[0], bots))
        try:
            figures, self.why_not_judged = truth.judged(server, bots, cells / f"{name}.truth.jsonl")
            self.figures.update({figure: value for figure, value in figures.items() if not (is_of_curves and figure.startswith("late_entry_"))})
        except truth.Untold as untold:
            self.why_not_judged = str(untold)

    def reason(self, figure):
        """Why `figure`, which the table has, is not among `figures`."""
        if figure in self.copied:
            return f"in the report of a process alone, {COPIED[figure][2]}"
        if figure in OF_KERNEL:
            return "what the kernel counted for a process, in runs.jsonl alone"
        if figure.startswith(OF_TRUTH) and self.why_not_judged:
            return self.why_not_judged
        if figure.startswith(OF_EVIDENCE) and self.why_no_evidence:
            return self.why_no_evidence
        if self.peers:
            return "not worked out for peers"
        return "no report of a process in cells/" if None in self.reports.values() else "not worked out here"


def runs_in(file):
    """{cell: {figure: value}} of the valid runs."""
    with file.open(newline="") as stream:
        rows = csv.DictReader(line for line in stream if not line.startswith("#"))
        runs = collections.defaultdict(dict)
        for row in rows:
            if row["valid"] == "true":
                runs[tuple(row[key] for key in KEYS)][row["figure"]] = float(row["value"])
    return runs


def parts_of_curves(experiment):
    with experiment.open("rb") as stream:
        return {part["name"] for part in tomllib.load(stream).get("parts", ()) if part.get("curves")}


def is_alike(figure, found, told):
    return math.isclose(found, told, rel_tol=TOLERANCE, abs_tol=ROUNDING_US if figure in COSTS else 0.0)


def line_of(figure, checked, differing, reasons):
    """What is printed of a column: how many of its runs were checked, and why not the others."""
    runs = checked + sum(reasons.values())
    said = "differs" if differing else "agrees " if checked else "copied " if figure in COPIED else "skipped"
    text = f"{said}  {figure} ({checked} of {runs} runs)" if checked or figure not in COPIED else f"{said}  {figure} ({runs} runs)"
    if figure in COSTS and checked:
        text += f" within {ROUNDING_US} us, as far as evidence in nanoseconds tells"
    why = [reason + (f" ({count})" if len(reasons) > 1 or checked else "") for reason, count in reasons.most_common()]
    return text + (": " if why else "") + ", ".join(why)


def main(folder):
    checked, differing, reasons = collections.Counter(), collections.Counter(), collections.defaultdict(collections.Counter)
    curves = parts_of_curves(folder / "experiment.toml")
    for key, told in runs_in(folder / "tidy.csv").items():
        cell = dict(zip(KEYS, key))
        name, run = name_of(cell), Recomputed(folder / "cells", name_of(cell), cell["part"] in curves)
        for figure, value in sorted((run.copied | run.figures).items()):
            if figure in run.figures:
                checked[figure] += 1
            if figure not in told and figure in run.figures or figure in told and not is_alike(figure, value, told[figure]):
                differing[figure] += 1
                print(f"DIFFERS  {name}: {figure} is {told.get(figure, 'absent')}, {'recomputed' if figure in run.figures else 'in the report'} {value!r}")
        for figure in told.keys() - run.figures.keys():
            reasons[figure][run.reason(figure)] += 1
    for figure in sorted(checked.keys() | reasons.keys()):
        print(line_of(figure, checked[figure], differing[figure], reasons[figure]))
    if not checked:
        return 2
    return 1 if differing else 0


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit("usage: recompute.py REPORT")
    try:
        sys.exit(main(pathlib.Path(sys.argv[1])))
    except OSError as error:
        print(f"recompute.py: {error.filename}: {error.strerror}", file=sys.stderr)
        sys.exit(2)
