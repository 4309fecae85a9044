"""Plane strain compression of a softening clay at three spacings: what depends on them, and what is left of that if
the residual strain grows as the spacing falls.

share/scenes/softening.toml. A band at 45 degrees of thickness t slips by g t, g its plastic shear strain; the
sample's height H changes by H s / E' in elastic strain, E' = E / (1 - nu^2), and by g t / sqrt 2. With
s = 2 c(k), k = g / sqrt 3, a curve that falls from s1 to s2 over du has

    t = (du + (s1 - s2) H / E') sqrt 2 / (sqrt 3 (k2 - k1)).
"""

import common
import matplotlib.pyplot as plt
import numpy as np

HEIGHT, MODULUS = 0.2, 50e6 / (1 - 0.3**2)
PEAK, RESIDUAL, STRAIN = 30e3, 12e3, 0.05  # 2 c [Pa], residual_strain
SPACINGS = [0.01, 0.005, 0.0025]
COLOURS = [common.BLUE, common.ORANGE, common.GREEN]


def at_stress(curve, stress):
    """The settlement at which the falling branch comes to a stress."""
    s, u = curve["mean_pressure_Pa"], curve["settlement_m"]
    for i in range(int(np.argmax(s)) + 1, len(s)):
        if s[i] <= stress:
            return u[i - 1] + (s[i - 1] - stress) / (s[i - 1] - s[i]) * (u[i] - u[i - 1])
    return np.nan


def thickness(curve, residual_strain):
    """Of the band, from the middle of the falling branch."""
    s1, s2 = RESIDUAL + 0.75 * (PEAK - RESIDUAL), RESIDUAL + 0.25 * (PEAK - RESIDUAL)
    slip = at_stress(curve, s2) - at_stress(curve, s1) + (s1 - s2) * HEIGHT / MODULUS
    return slip * np.sqrt(2 / 3) / (0.5 * residual_strain)


def work_to(curve, settlement):
    """Of the platen [J/m] up to a settlement."""
    u = np.linspace(0, settlement, 2001)
    return np.trapz(np.interp(u, curve["settlement_m"], curve["mean_pressure_Pa"]) * 0.1, u)


def main():
    options = common.arguments(__doc__, "softening.png")
    figure, panels = plt.subplots(1, 3, figsize=(11, 3.8), layout="constrained", width_ratios=[1, 1, 0.55])
    print("| residual_strain | spacing [mm] | peak [kPa] | at 0.25 % [kPa] | at the end [kPa] | work to 1 % [J/m] | "
          "band [spacings] |\n|---|---|---|---|---|---|---|")
    for axes, scaled in zip(panels, (False, True)):
        for spacing, colour in zip(SPACINGS, COLOURS):
            strain = STRAIN * (0.005 / spacing if scaled else 1.0)
            folder = common.run(
                options, f"softening-{spacing}-{strain:g}", "softening.toml", f"geometry.spacing={spacing}",
                f"material.0.residual_strain={strain}", f"material.1.residual_strain={strain}",
                "output.frames_every=1000",
            )  # fmt: skip
            curve = common.curve(folder)
            stress, settlement = curve["mean_pressure_Pa"], curve["settlement_m"]
            axes.plot(100 * settlement / HEIGHT, stress / 1e3, color=colour, label=f"{1e3 * spacing:g} mm")
            print(f"| {strain:g} | {1e3 * spacing:g} | {stress.max() / 1e3:.2f} | "
                  f"{np.interp(0.0025 * HEIGHT, settlement, stress) / 1e3:.1f} | {stress[-1] / 1e3:.2f} | "
                  f"{work_to(curve, settlement[-1]):.1f} | {thickness(curve, strain) / spacing:.2f} |")
            last = folder
        axes.set(xlabel="mean strain [%]", ylabel="mean stress [kPa]", xlim=(0, 1), ylim=(0, 32))
        axes.set_title("residual strain / spacing fixed" if scaled else "residual strain 5 %", fontsize=9)
        axes.legend(loc="upper right")
        if not scaled:
            shown = last
    at = common.frame(shown)
    squares = common.field_plot(panels[2], at, at["plastic_strain"], SPACINGS[-1], at["plastic_strain"].max(), 1e3)
    panels[2].set(xlabel="x [mm]", ylabel="y [mm]")
    panels[2].set_title("plastic strain, 2.5 mm, 5 %", fontsize=9)
    figure.colorbar(squares, ax=panels[2])
    common.save(figure, options)


if __name__ == "__main__":
    main()
