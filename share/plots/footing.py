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
        "exact collapse load, associated flow, small strain", (0.148, COLLAPSE - 2.2), ha="right"
    )


def main():
    options = common.arguments(__doc__, "footing.png")
    runs = [
        ("footing", [], "with re-search", common.BLUE),
        ("footing-no-research", ["research.enabled=false"], "without re-search", common.ORANGE),
        ("footing-viscosity", ['hourglass.control="viscosity"', "research.enabled=false"],
         "the paper's viscosity, without re-search", common.GREEN),
    ]  # fmt: skip
    figure = plt.figure(figsize=(8, 9), layout="constrained")
    upper, lower = figure.subfigures(2, 1, height_ratios=[1, 1.05])
    axes = upper.subplots(1, 1)
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

    panels = lower.subplots(2, 1)
    spacing = options.spacing or SPACING
    shown = [(runs[0], "with re-search"), (runs[1], "without re-search")]
    for axes, ((name, *_), label) in zip(panels, shown):
        folder = common.OUT / name
        at = common.frame(folder)
        reached = common.curve(folder)["settlement_over_B"][-1]
        squares = common.field_plot(
            axes, at, at["plastic_strain"], spacing, limit=1.0, scale=1 / HALF_WIDTH
        )
        axes.set(xlim=(0, 4), ylim=(-1.6, 0.3), ylabel="y / B")
        axes.set_title(f"equivalent plastic strain, {label}, d/B = {reached:.3f}", fontsize=9)
        lower.colorbar(squares, ax=axes, shrink=0.9, extend="max")
    panels[-1].set_xlabel("x / B")
    common.save(figure, options)


if __name__ == "__main__":
    main()
