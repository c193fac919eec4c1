#!/usr/bin/env python3
"""Reads tidy.csv of a report of `rink compare`, prints means with intervals and draws bytes against displayed error, of one part of the experiment."""
import argparse
import math
import pathlib
import statistics
import sys
import tomllib

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plot
import pandas

CELL = ["part", "mode", "scheme", "policy", "clients", "pucks", "bats", "server_cores", "view_fraction", "view_margin",
        "sweep_ticks", "cell_size", "tick_rate_hz", "threshold", "extrapolate", "nodes", "output_rate_hz"]
BYTES, ERROR = "down_bytes_per_client_per_s", "displayed_error_mm_rms"
MARKERS, LABELS_A_COLUMN = "osD^vP*X", 24
FRACTIONS = ("_fraction", "_precision", "_recall", "_jain", "_share")
# Student's t at 0.975 for 1 to 30 degrees of freedom; beyond them the first terms of Cornish and Fisher's expansion.
T = [12.706205, 4.302653, 3.182446, 2.776445, 2.570582, 2.446912, 2.364624, 2.306004, 2.262157, 2.228139, 2.200985, 2.178813,
     2.160369, 2.144787, 2.131450, 2.119905, 2.109816, 2.100922, 2.093024, 2.085963, 2.079614, 2.073873, 2.068658, 2.063899,
     2.059539, 2.055529, 2.051831, 2.048407, 2.045230, 2.042272]


def t_quantile(degrees):
    z = 1.959963985
    return T[degrees - 1] if degrees <= len(T) else z + (z**3 + z) / (4 * degrees) + (5 * z**5 + 16 * z**3 + 3 * z) / (96 * degrees**2)


def interval(values, is_fraction):
    """95 % interval of the mean on the scale of logarithms, of fractions that of logits (docs/experiments.md)."""
    if len(values) < 2:
        return math.nan, math.nan
    mean = statistics.fmean(values)
    half = t_quantile(len(values) - 1) * statistics.stdev(values) / math.sqrt(len(values))
    if half == 0 or mean == 0:
        return mean, mean
    if not is_fraction:
        return mean * math.exp(-half / mean), mean * math.exp(half / mean)
    logit, width = math.log(mean / (1 - mean)), half / (mean * (1 - mean))
    return 1 / (1 + math.exp(width - logit)), 1 / (1 + math.exp(-width - logit))


def means_of(tidy):
    """A row for each cell and figure that every valid run of the cell has."""
    runs = tidy.groupby(CELL)["seed"].nunique()
    rows = []
    for key, group in tidy.groupby(CELL + ["figure", "unit"]):
        cell, figure, unit = key[:-2], key[-2], key[-1]
        if len(group) == runs[cell]:
            low, high = interval(list(group["value"]), figure.endswith(FRACTIONS))
            rows.append([*cell, figure, unit, len(group), group["value"].mean(), low, high])
    return pandas.DataFrame(rows, columns=CELL + ["figure", "unit", "runs", "mean", "low", "high"])


def parts_of_curves(report):
    """Names of the parts whose cells are only points of curves along which policies are compared."""
    with (report / "experiment.toml").open("rb") as stream:
        return {part["name"] for part in tomllib.load(stream).get("parts", ()) if part.get("curves")}


def part_shown(tidy, curves, wanted):
    """`wanted`, or else the part with most cells and runs of those that are not points of curves; with a sentence about the others."""
    parts = list(dict.fromkeys(tidy["part"]))
    if wanted is not None and wanted not in parts:
        raise ValueError(f"no part with valid runs is called {wanted or '(nothing)'}; there are {', '.join(parts)}")
    sizes = {part: len(tidy[tidy["part"] == part].groupby([*CELL, "seed"])) for part in parts if part not in curves or len(parts) == 1}
    if wanted is None and not sizes:
        raise ValueError(f"all parts are points of curves: choose one by --part ({', '.join(parts)})")
    part = wanted if wanted is not None else max(sizes, key=sizes.get)
    others = [each + (" (points of curves)" if each in curves else "") for each in parts if each != part]
    return part, f"part {part}; by --part also {', '.join(others)}" if others else ""


def policy_name(cell):
    is_paper = cell["policy"] == "periodic" and not cell["extrapolate"]
    return cell["policy"] + (" (paper)" if is_paper else "")


def draw(means, file):
    """A colour for each scheme, or policy if there is one scheme, a marker for each policy, a mark for each cell, and one label for each scheme and policy."""
    bytes_, error = (means[means["figure"] == figure].set_index(CELL) for figure in (BYTES, ERROR))
    series = {}
    for cell in bytes_.index.intersection(error.index):
        named = dict(zip(CELL, cell))
        series.setdefault((named["scheme"], policy_name(named)), []).append((error.loc[cell], bytes_.loc[cell]))
    schemes, policies = (list(dict.fromkeys(key[i] for key in series)) for i in (0, 1))
    columns = 1 + (len(series) - 1) // LABELS_A_COLUMN
    figure, axes = plot.subplots(figsize=(6.4 + 2.2 * columns, 4.8), constrained_layout=True)
    for (scheme, policy), points in sorted(series.items(), key=lambda item: (schemes.index(item[0][0]), policies.index(item[0][1]))):
        values = [[of["mean"] for of in side] for side in zip(*points)]
        bars = [[[0 if math.isnan(of["low"]) else of["mean"] - of["low"] for of in side], [0 if math.isnan(of["high"]) else of["high"] - of["mean"] for of in side]]
                for side in zip(*points)]
        axes.errorbar(*values, xerr=bars[0], yerr=bars[1], linestyle="none", elinewidth=0.8, capsize=2, markersize=6, color=f"C{schemes.index(scheme) if len(schemes) > 1 else policies.index(policy)}",
                      marker=MARKERS[policies.index(policy) % len(MARKERS)], label=f"{scheme}, {policy}")
    axes.set(xscale="log", yscale="log", xlabel="displayed error, RMS [mm]", ylabel="payload [bytes per second and client]")
    part, varied = means["part"].iloc[0], [key for key in CELL if key not in ("scheme", "policy", "extrapolate") and means[key].nunique() > 1]
    axes.set_title(", ".join(([f"part {part}"] if part else []) + ([f"a mark for each {', '.join(varied)}"] if varied else [])), fontsize=9)
    if series:
        axes.legend(loc="upper left", bbox_to_anchor=(1.02, 1.0), borderaxespad=0.0, fontsize=7, ncol=columns, title="scheme, policy")
    figure.savefig(file)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("report", type=pathlib.Path, help="folder with tidy.csv and experiment.toml")
    parser.add_argument("--out", default="bytes-against-error.svg", help="picture; its ending says which kind (svg, png, pdf)")
    parser.add_argument("--part", help="part of the experiment; default: of those that are not points of curves the one with the most runs")
    parser.add_argument("--figure", action="append", help="print this figure (may be repeated); default: payload and displayed error")
    options = parser.parse_args()
    try:
        tidy = pandas.read_csv(options.report / "tidy.csv", comment="#", keep_default_na=False)
        curves = parts_of_curves(options.report)
    except OSError as error:
        sys.exit(f"{error.filename}: {error.strerror}: expected a file of a report folder")
    tidy = tidy[tidy["valid"].astype(str).str.lower() == "true"]
    if tidy.empty:
        sys.exit(f"{options.report / 'tidy.csv'}: no run counts")
    try:
        part, sentence = part_shown(tidy, curves, options.part)
    except ValueError as error:
        sys.exit(f"{options.report / 'tidy.csv'}: {error}")
    means = means_of(tidy[tidy["part"] == part])
    unknown = sorted(set(options.figure or []) - set(means["figure"]))
    if unknown:
        sys.exit(f"{options.report / 'tidy.csv'}: no figure that every valid run of a cell has is called {', '.join(unknown)}; data-dictionary.csv lists them")
    if sentence:
        print(sentence)
    shown = means[means["figure"].isin(options.figure or [BYTES, ERROR])]
    constant = [key for key in CELL if means[key].nunique() == 1]
    print(shown.drop(columns=constant).to_string(index=False))
    draw(means, options.out)


if __name__ == "__main__":
    main()
