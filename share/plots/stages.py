"""An excavation dug in two stages and weakened until it fails, and an embankment in three lifts.

The plastic strain at the end of each stage, share/scenes/excavation.toml and embankment.toml.
"""

import common
import matplotlib.pyplot as plt
import numpy as np


def ends_of(curve):
    """The last step of each stage."""
    stage, step = curve["stage"], curve["step"]
    return [int(step[stage == each][-1]) for each in np.unique(stage)]


def main():
    options = common.arguments(__doc__, "stages.png")
    scenes = [
        ("excavation", ["pit 1 is dug", "pit 2 is dug", "strength divided until it fails"], 0.02),
        ("embankment", ["lift 1", "lift 2", "lift 3"], 0.01),
    ]
    figure, panels = plt.subplots(3, 2, figsize=(11, 8), layout="constrained")
    for column, (scene, titles, limit) in zip(panels.T, scenes):
        folder = common.run(options, scene, f"{scene}.toml", "output.frames_every=1")
        curve = common.curve(folder)
        for axes, title, step in zip(column, titles, ends_of(curve)):
            at = common.frame(folder, step)
            squares = common.field_plot(
                axes, at, at["plastic_strain"], options.spacing or 0.5, limit
            )
            axes.set_title(f"{scene}: {title}", fontsize=9)
            axes.set(xlim=(0, 22), ylim=(-10, 4), ylabel="y [m]")
        figure.colorbar(squares, ax=column, shrink=0.5, extend="max", label="plastic strain")
        column[-1].set_xlabel("x [m]")
        if "strength_reduction" in curve:
            print(f"{scene}: strength divided by {curve['strength_reduction'][-1]:.3f} at the end")
    common.save(figure, options)


if __name__ == "__main__":
    main()
