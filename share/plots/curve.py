"""Pressure against settlement of runs of one's own, and the bounds of the collapse load where a run
had `limit.check = true`.
"""

import argparse
import json
from pathlib import Path

import common
import matplotlib.pyplot as plt

COLOURS = [common.BLUE, common.ORANGE, common.GREEN, common.RED]


def arguments():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", type=Path, nargs="+", help="output folder of a run")
    parser.add_argument(
        "--png", type=Path, default=common.OUT / "curve.png", help="picture (default: %(default)s)"
    )
    return parser.parse_args()


def plot_bracket(axes, folder, colour):
    """A band between the certified bounds, and what they are."""
    record = folder / "limit" / "bracket.json"
    if not record.exists():
        return
    bracket = json.loads(record.read_text())
    if not bracket["certified"]:
        print(f"{folder}: no certified bracket ({bracket['status']})")
        return
    lower, upper = bracket["lower_bound"] / 1e3, bracket["upper_bound"] / 1e3
    axes.axhspan(lower, upper, color=colour, alpha=0.25, linewidth=0)
    axes.annotate(f"collapse load {lower:.4g} .. {upper:.4g} kPa", (0.99, lower), va="top", ha="right",
                  xycoords=("axes fraction", "data"))  # fmt: skip
    print(f"{folder}: collapse load {lower:.6g} .. {upper:.6g} kPa")


def main():
    options = arguments()
    figure, axes = plt.subplots(figsize=(7, 4.5), layout="constrained")
    for i, folder in enumerate(options.folder):
        colour = COLOURS[i % len(COLOURS)]
        curve = common.curve(folder)
        axes.plot(curve["settlement_m"], curve["mean_pressure_Pa"] / 1e3, color=colour, label=folder.name)
        plot_bracket(axes, folder, colour)
    axes.set(xlabel="settlement [m]", ylabel="mean pressure [kPa]")
    axes.set_xlim(left=0)
    axes.set_ylim(bottom=0)
    axes.legend(loc="lower right")
    common.save(figure, options)


if __name__ == "__main__":
    main()
