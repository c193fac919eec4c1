#!/usr/bin/env python3
"""Reads tidy.csv of a report of `rink compare`, prints means with intervals and draws bytes against displayed error."""
import argparse
import math
import pathlib
import statistics
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plot
import pandas

CELL = ["part", "mode", "scheme", "policy", "clients", "pucks", "bats", "server_cores", "view_fraction", "view_margin",
        "sweep_ticks", "cell_size", "tick_rate_hz", "threshold", "extrapolate"]
BYTES, ERROR = "down_bytes_per_client_per_s", "displayed_error_mm_rms"
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


def draw(means, file):
    names = [key for key in CELL if means[key].nunique() > 1] or ["scheme"]
    bytes_, error = (means[means["figure"] == figure].set_index(CELL) for figure in (BYTES, ERROR))
    figure, axes = plot.subplots(figsize=(6.4, 4.4), constrained_layout=True)
    for cell in bytes_.index.intersection(error.index):
        x, y = error.loc[cell], bytes_.loc[cell]
        bars = [None if math.isnan(of["low"]) else [[of["mean"] - of["low"]], [of["high"] - of["mean"]]] for of in (x, y)]
        label = ", ".join(str(value) for key, value in zip(CELL, cell) if key in names)
        axes.errorbar([x["mean"]], [y["mean"]], xerr=bars[0], yerr=bars[1], fmt="o", capsize=3, label=label)
    axes.set(xscale="log", yscale="log", xlabel="displayed error, RMS [mm]", ylabel="payload [bytes per second and client]")
    axes.legend(title=", ".join(names), fontsize=7)
    figure.savefig(file)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("report", type=pathlib.Path, help="folder with tidy.csv")
    parser.add_argument("--out", default="bytes-against-error.svg", help="picture; its ending says which kind (svg, png, pdf)")
    parser.add_argument("--figure", action="append", help="print this figure (may be repeated); default: payload and displayed error")
    options = parser.parse_args()
    try:
        tidy = pandas.read_csv(options.report / "tidy.csv", comment="#", keep_default_na=False)
    except OSError as error:
        sys.exit(f"{error.filename}: {error.strerror}: expected the tidy table of a report folder")
    means = means_of(tidy[tidy["valid"].astype(str).str.lower() == "true"])
    unknown = sorted(set(options.figure or []) - set(means["figure"]))
    if unknown:
        sys.exit(f"{options.report / 'tidy.csv'}: no figure that every valid run of a cell has is called {', '.join(unknown)}; data-dictionary.csv lists them")
    shown = means[means["figure"].isin(options.figure or [BYTES, ERROR])]
    constant = [key for key in CELL if means[key].nunique() == 1]
    print(shown.drop(columns=constant).to_string(index=False))
    draw(means, options.out)


if __name__ == "__main__":
    main()
