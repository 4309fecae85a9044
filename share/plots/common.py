"""What the plot scripts share: running scenes once, reading curves and frames, one look.

A script asks for runs by name. A run lives in out/plots/NAME of the repository and is used again
until its scene or its settings change; one that was interrupted goes on. --again runs everything
anew.
"""

import argparse
import csv
import json
import os
import subprocess
import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402
from matplotlib.collections import PolyCollection  # noqa: E402

try:
    import h5py
except ImportError:
    sys.exit("plots need the Debian packages python3-matplotlib and python3-h5py")

ROOT = Path(__file__).resolve().parents[2]
OUT = ROOT / "out" / "plots"
# FPM_RUN names a program to use instead of the one that fpmw builds.
PROGRAM = [os.environ["FPM_RUN"]] if "FPM_RUN" in os.environ else [ROOT / "fpmw", "run"]

# Okabe and Ito's colours, distinct for colour-blind readers too.
BLUE, ORANGE, GREEN, RED, GREY = "#0072B2", "#E69F00", "#009E73", "#D55E00", "#777777"

plt.rcParams.update(
    {
        "font.size": 9,
        "axes.spines.top": False,
        "axes.spines.right": False,
        "axes.grid": True,
        "grid.color": "#dddddd",
        "grid.linewidth": 0.6,
        "legend.frameon": False,
        "lines.linewidth": 1.4,
        "savefig.dpi": 110,
        "savefig.bbox": "tight",
    }
)


def arguments(description, png):
    """The options every script has."""
    parser = argparse.ArgumentParser(description=description)
    parser.add_argument("--png", type=Path, default=OUT / png, help="picture (default: %(default)s)")
    parser.add_argument("--again", action="store_true", help="run the scenes even if they were run")
    parser.add_argument(
        "--spacing", type=float, metavar="M", help="particle spacing instead of the scene's"
    )
    return parser.parse_args()


def run(options, name, scene, *settings, may_fail=False):
    """Runs a scene of share/scenes with settings unless it was; returns its output folder.

    may_fail: a run that stops short of its target (exit code 3) is a result, too.
    """
    file = ROOT / "share" / "scenes" / scene
    settings = list(settings)
    if options.spacing:
        settings.append(f"geometry.spacing={options.spacing}")
    folder = OUT / name
    begun, done = folder / "plots.begun", folder / "plots.done"
    wanted = "\n".join([*settings, file.read_text()])
    if not options.again and done.exists() and done.read_text() == wanted:
        return folder
    command = [*PROGRAM, file, "--out", folder]
    if not options.again and begun.exists() and begun.read_text() == wanted:
        if any(folder.glob("checkpoints/*.hdf")):
            command.append("--resume")
    for setting in settings:
        command += ["--set", setting]
    print(f"plots: running {scene} as {name}", file=sys.stderr)
    folder.mkdir(parents=True, exist_ok=True)
    begun.write_text(wanted)
    done.unlink(missing_ok=True)
    code = subprocess.run(command, check=False).returncode
    if code != 0 and not (may_fail and code == 3):
        sys.exit(f"plots: {scene} ended with code {code}; see {folder}")
    done.write_text(wanted)
    return folder


def curve(folder):
    """curve.csv of a run as {column: array}."""
    return table(folder / "curve.csv")


def table(file):
    """A CSV file with a header as {column: array}."""
    with open(file, newline="") as stream:
        rows = list(csv.reader(stream))
    values = np.array(rows[1:], dtype=float)
    return {name: values[:, i] for i, name in enumerate(rows[0])}


def reference(name):
    return table(ROOT / "share" / "references" / name)


def frame(folder, time=None):
    """The frame nearest to a time (default: the last one) as {field: array}.

    "position" holds the current positions [m], "initial" those before the displacement, "time" the
    frame's time: the settlement [m] if a side is driven, else the load parameter.
    """
    entries = json.loads((folder / "run.hdf.series").read_text())["files"]
    if time is None:
        entry = entries[-1]
    else:
        entry = min(entries, key=lambda e: abs(e["time"] - time))
    with h5py.File(folder / entry["name"]) as file:
        group = file["VTKHDF"]
        fields = {name: data[...] for name, data in group["PointData"].items()}
        fields["position"] = group["Points"][...]
    fields["initial"] = fields["position"] - fields["displacement"]
    fields["time"] = entry["time"]
    return fields


def field_plot(axes, at, values, spacing, limit, scale=1.0):
    """Particles at their current places as coloured squares of about their size."""
    axes.set_aspect("equal")
    axes.grid(False)
    x, y = at["position"][:, 0] * scale, at["position"][:, 1] * scale
    axes.set_xlim(x.min() - spacing * scale, x.max() + spacing * scale)
    axes.set_ylim(y.min() - spacing * scale, y.max() + spacing * scale)
    corners = spacing * scale / 2 * np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]])
    squares = PolyCollection(
        corners + np.stack([x, y], axis=1)[:, None, :], array=values, cmap="magma_r",
        edgecolors="face", linewidths=0.2,
    )  # fmt: skip
    squares.set_clim(0, limit)
    axes.add_collection(squares)
    return squares


def save(figure, options):
    options.png.parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(options.png)
    print(options.png)
