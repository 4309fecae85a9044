"""Mean stress against mean strain, and the shear band, in plane strain compression.

Example 2, Figs. 4 and 5 of Chen, Huang & Lyamin 2020.
"""

import common
import matplotlib.pyplot as plt

HEIGHT, SPACING = 0.2, 0.005  # [m]
STRENGTH = 42.844  # [kPa] 2 c tan(45 + phi / 2)
STRAINS = [0.02, 0.05, 0.10, 0.15]


def plot_curves(options, axes):
    homogeneous = common.reference("compression_homogeneous_drucker_prager.csv")
    fem = common.reference("compression_weak_patch_fem_10x20.csv")
    axes.plot(
        homogeneous["mean_axial_strain"], homogeneous["mean_stress_kPa"], color="black",
        linewidth=1, label="homogeneous solution",
    )  # fmt: skip
    axes.plot(
        fem["mean_axial_strain"], fem["mean_stress_kPa"], color=common.GREY, linestyle="--",
        label="finite elements 10 x 20, weak patch",
    )  # fmt: skip
    runs = [
        ("compression", [], "particles, weak patch", common.BLUE),
        ("compression-uniform", ["material.1.cohesion=15e3"], "particles, uniform", common.ORANGE),
    ]
    for name, settings, label, colour in runs:
        folder = common.run(
            options, name, "compression.toml", "output.frames_every=2", *settings
        )
        curve = common.curve(folder)
        stress = curve["mean_pressure_Pa"] / 1e3
        axes.plot(curve["settlement_over_B"], stress, color=colour, label=label)
        print(f"{label}: peak {stress.max():.2f} kPa, at 15 % {stress[-1]:.2f} kPa")
    axes.axhline(STRENGTH, color=common.GREY, linewidth=0.8, linestyle=":")
    axes.annotate("2c tan(45° + φ/2)", (0.15, STRENGTH + 0.5), ha="right", color=common.GREY)
    axes.set(xlabel="mean axial strain", ylabel="mean axial stress [kPa]", xlim=(0, 0.15), ylim=(0, 55))
    axes.legend(loc="lower right")


def main():
    options = common.arguments(__doc__, "compression.png")
    figure = plt.figure(figsize=(9, 7), layout="constrained")
    upper, lower = figure.subfigures(2, 1, height_ratios=[1, 1.1])
    plot_curves(options, upper.subplots(1, 1))
    panels = lower.subplots(1, len(STRAINS))
    folder = common.OUT / "compression"
    spacing = options.spacing or SPACING
    for axes, strain in zip(panels, STRAINS):
        at = common.frame(folder, strain * HEIGHT)
        squares = common.field_plot(
            axes, at, at["plastic_strain"], spacing, at["plastic_strain"].max()
        )
        axes.set(xticks=[], yticks=[])
        axes.spines[:].set_visible(False)
        axes.set_title(f"mean strain {at['time'] / HEIGHT:.3f}", fontsize=9)
        lower.colorbar(squares, ax=axes, orientation="horizontal", shrink=0.9)
    lower.supxlabel("equivalent plastic strain", fontsize=9)
    common.save(figure, options)


if __name__ == "__main__":
    main()
