"""Pressure against settlement of the strip footing, and the plastic strain below it.

Example 3, Figs. 6 and 7 of Chen, Huang & Lyamin 2020.
"""

import common
import matplotlib.pyplot as plt

HALF_WIDTH, SPACING = 0.22, 0.01  # [m]
COLLAPSE = 58.437  # [kPa] rough, with weight, associated, small strain: method of characteristics


def plot_references(axes):
    for size, width in ((8, 0.6), (12, 0.8), (20, 1.0)):
        fem = common.reference(f"footing_rough_weight_psi10_finite_strain_fem_B{size}.csv")
        axes.plot(
            fem["settlement_over_B"], fem["pressure_kPa"], color=common.GREY, linewidth=width,
            linestyle="--", label="finite elements, B/8, B/12, B/20" if size == 20 else None,
        )  # fmt: skip
    axes.axhline(COLLAPSE, color="black", linewidth=0.8, linestyle=":")
    axes.annotate(
        "exact collapse load, associated flow, small strain", (0.149, COLLAPSE - 4), ha="right"
    )


def main():
    options = common.arguments(__doc__, "footing.png")
    # Beyond 13 % of B the steps without re-search become very hard; the paper's ended at 8.7 %.
    without = ["re_search.enabled=false", "drive.target=0.0264"]
    runs = [
        ("footing", [], "with re-search", common.BLUE),
        ("footing-no-research", without, "without re-search", common.ORANGE),
        ("footing-viscosity", ['hourglass.control="viscosity"', *without],
         "the paper's viscosity, without re-search", common.GREEN),
    ]  # fmt: skip
    figure, (axes, *panels) = plt.subplots(
        3, 1, figsize=(8, 10.5), height_ratios=[1, 1, 1], layout="constrained"
    )
    plot_references(axes)
    for name, settings, label, colour in runs:
        folder = common.run(options, name, "footing.toml", *settings, may_fail=True)
        curve = common.curve(folder)
        settlement, pressure = curve["settlement_over_B"], curve["mean_pressure_Pa"] / 1e3
        axes.plot(settlement, pressure, color=colour, label=label)
        if name == "footing":
            axes.plot(
                settlement[1:], curve["corrected_pressure_Pa"][1:] / 1e3, color=colour,
                linewidth=0.6, label="with re-search, energy-corrected",
            )  # fmt: skip
        print(f"{label}: {pressure[-1]:.2f} kPa at d/B = {settlement[-1]:.4f}, {len(settlement)} steps")
    axes.set(xlabel="settlement / half width, d/B", ylabel="mean pressure [kPa]", xlim=(0, 0.15), ylim=(0, 80))
    axes.legend(loc="lower right")

    spacing = options.spacing or SPACING
    shown = [(runs[0], "with re-search"), (runs[1], "without re-search")]
    for axes, ((name, *_), label) in zip(panels, shown):
        folder = common.OUT / name
        at = common.frame(folder)
        reached = common.curve(folder)["settlement_over_B"][-1]
        squares = common.field_plot(
            axes, at, at["plastic_strain"], spacing, limit=0.5, scale=1 / HALF_WIDTH
        )
        axes.set(xlim=(0, 4), ylim=(-2.0, 0.3), ylabel="y / B")
        axes.set_title(f"equivalent plastic strain, {label}, d/B = {reached:.3f}", fontsize=9)
        figure.colorbar(squares, ax=axes, shrink=0.7, pad=0.01, extend="max")
    panels[-1].set_xlabel("x / B")
    common.save(figure, options)


if __name__ == "__main__":
    main()
