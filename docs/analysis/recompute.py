#!/usr/bin/env python3
"""Computes figures of a report of `rink compare` again from its evidence and holds them against tidy.csv.

Nothing of the product is used: the formulas are those of docs/metrics.md, written anew. Exit status: 0 all that was
checked agrees, 1 something differs, 2 nothing could be checked.
"""
import collections
import csv
import json
import math
import pathlib
import sys

sys.dont_write_bytecode = True
import truth

TOLERANCE = 1e-9
HEADERS = 66  # bytes: Ethernet 14, IPv4 20, TCP with timestamps 32
PARAMETERS = (("view_fraction", "view", "0.05"), ("view_margin", "margin", "0.3"), ("sweep_ticks", "sweep", "0"),
              ("cell_size", "cell", "0"), ("tick_rate_hz", "rate", "30"), ("threshold", "threshold", "0.005"),
              ("extrapolate", "extrapolate", "1"))  # column, what file names call it, what they leave out
KEYS = ("part", "mode", "scheme", "policy", "clients", "pucks", "bats", "server_cores") + tuple(p[0] for p in PARAMETERS) + ("seed",)
OF_TRUTH = ("filter_precision", "filter_recall", "delivered_", "missed_", "late_entry_", "position_error_", "displayed_error_", "wasted_")


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
    for suffix, fraction in (("p50", 0.5), ("p90", 0.9), ("p99", 0.99), ("p999", 0.999)):
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
    figures.update(wire_bytes_per_client_per_s=wire / clients, segments_per_s=segments, acknowledgements_per_s=pure)
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


def tick_figures(evidence):
    """From the first tick that is due when warm-up is over up to the last, which ends the game and is not counted."""
    head = evidence[0]
    costs = [tick for line in evidence if "ticks_us" in line for tick in line["ticks_us"]]
    ticks = [tick for tick in costs if head["from_s"] - 1e-9 <= tick[0] < head["until_s"] - 1e-9]
    figures = {"ticks": len(ticks)}
    if any(sum(tick[1:]) > 0.0 for tick in costs):
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


def recomputed(cells, name):
    """All that the files of the cell called `name` give, or nothing with the reason."""
    server, bots = json_of(cells / f"{name}.server.json"), json_of(cells / f"{name}.bots.json")
    if server is None or bots is None:
        return {}, "peers, or no reports in cells/"
    figures = traffic_figures(server, bots)
    figures["entities"] = server["entities"]
    figures["late_sends_fraction"] = bots["late_sends_fraction"]
    if server.get("pace") == "realtime":
        for figure in ("ticks_on_time_fraction", "physics_us_per_tick", "filter_us_per_tick", "send_us_per_tick", "server_rss_bytes"):
            figures[figure] = server[figure]
        figures["bots_cpu_share"], figures["histogram_ns_per_record"] = bots["cpu_share"], bots["histogram_ns_per_record"]
    figures.update(percentiles(bots["update_age_ms"], "update_age_ms"))
    if not bots["schedule_trouble"]:
        figures.update(percentiles(bots["key_to_effect_ms"], "key_to_effect_ms"))
    of_server, of_bots = evidence_of(cells / f"{name}.server.jsonl"), evidence_of(cells / f"{name}.bots.jsonl")
    if of_server is None or of_bots is None:
        return figures, "no whole evidence, so reports alone"
    figures.update(tick_figures(of_server))
    figures.update(scope_figures(of_server[0], of_bots))
    try:
        figures.update(truth.judged(of_server, of_bots, cells / f"{name}.truth.jsonl"))
    except truth.Untold as untold:
        return figures, f"not judged again: {untold}"
    return figures, ""


def runs_in(file):
    """{cell: {figure: value}} of the valid runs."""
    with file.open(newline="") as stream:
        rows = csv.DictReader(line for line in stream if not line.startswith("#"))
        runs = collections.defaultdict(dict)
        for row in rows:
            if row["valid"] == "true":
                runs[tuple(row[key] for key in KEYS)][row["figure"]] = float(row["value"])
    return runs


def main(folder):
    checked, differing, known, gaps = collections.Counter(), collections.Counter(), set(), collections.Counter()
    for key, told in runs_in(folder / "tidy.csv").items():
        name = name_of(dict(zip(KEYS, key)))
        found, gap = recomputed(folder / "cells", name)
        known |= told.keys()
        if gap:
            gaps[gap] += 1
        for figure in sorted(found):
            if figure not in told:
                differing[figure] += 1
                print(f"DIFFERS  {name}: {figure} is absent, recomputed {found[figure]!r}")
                continue
            checked[figure] += 1
            if not math.isclose(found[figure], told[figure], rel_tol=TOLERANCE):
                differing[figure] += 1
                print(f"DIFFERS  {name}: {figure} is {told[figure]!r}, recomputed {found[figure]!r}")
    for figure, count in sorted(checked.items()):
        print(f"{'differs' if differing[figure] else 'agrees '}  {figure} ({count} runs)")
    for figure in sorted(known - checked.keys()):
        why = "needs the game played again (rink compare --trace)" if figure.startswith(OF_TRUTH) else "the kernel's count alone, in runs.jsonl"
        print(f"skipped  {figure}: {why}")
    for gap, count in gaps.items():
        print(f"{count} runs: {gap}")
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
