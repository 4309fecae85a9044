"""Deflection and stress along the beam with and without hourglass control.

Example 1, Figs. 2 and 3 of Chen, Huang & Lyamin 2020, against the exact elastic solution.
"""

import common
import matplotlib.pyplot as plt
import numpy as np

LENGTH, DEPTH, PATCH, LOAD = 10.0, 1.0, 0.5, 10e3  # [m], [m], [m], [N/m]
YOUNG, NU = 100e6, 0.25


def exact_bottom(x, terms=300):
    """Displacement [m] and axial stress [Pa] of the lower face in plane strain, by a sine series.

    Each term is an Airy function sin(a x) f(y) with f a combination of cosh, sinh, ay cosh and
    ay sinh of ay, y from mid-depth. Its ends have neither vertical displacement nor axial stress,
    as the supports ask. On a face without shear, sigma_xx = f'' sin(a x) and
    v = (1 - nu) f''' sin(a x) / (2 mu a^2).
    """
    mu = YOUNG / (2 + 2 * NU)
    displacement, stress = np.zeros_like(x), np.zeros_like(x)
    for m in range(1, 2 * terms, 2):  # even terms vanish by symmetry
        a = m * np.pi / LENGTH
        k, t = a * DEPTH / 2, np.tanh(a * DEPTH / 2)  # all columns are divided by cosh(k)
        amplitude = LOAD / PATCH * 4 / (m * np.pi) * np.sin(m * np.pi / 2) * np.sin(a * PATCH / 2)
        value = [[1, s * t, s * k, k * t] for s in (1, -1)]  # f at the upper and lower face
        slope = [[s * t, 1, 1 + k * t, s * (t + k)] for s in (1, -1)]  # f' / a
        f = np.linalg.solve(value + slope, [amplitude / a**2, 0, 0, 0])
        second = a**2 * np.dot(f, [1, -t, -2 * t - k, 2 + k * t])
        third = a**3 * np.dot(f, [-t, 1, 3 + k * t, -3 * t - k])
        stress += second * np.sin(a * x)
        displacement += (1 - NU) * third / (2 * mu * a**2) * np.sin(a * x)
    return displacement, stress


def bottom(folder):
    """x, vertical displacement and axial stress of the particles on the lower face."""
    at = common.frame(folder)
    face = at["initial"][:, 1] < 1e-9
    return at["initial"][face, 0], at["displacement"][face, 1], at["stress"][face, 0]


def main():
    options = common.arguments(__doc__, "beam.png")
    # The figure asks for the discrete solution, not for that of the step's tolerance.
    exact = ["solver.tolerance=1e-7", "solver.max_evaluations_per_step=4000"]
    controls = {
        "none": ("no control", common.ORANGE, "o"),
        "viscosity": (r"viscosity, $\theta$ = 0.01 per step", common.GREEN, "^"),
        "stiffness": ("default (stiffness)", common.BLUE, "s"),
    }
    figure, panels = plt.subplots(2, 2, figsize=(10, 5.6), sharex=True, layout="constrained")
    deflection, stress = panels[0]
    x = np.linspace(0, LENGTH, 401)
    v, sxx = exact_bottom(x)
    deflection.plot(x, v * 1e3, color="black", linewidth=1, label="exact")
    stress.plot(x, sxx / 1e3, color="black", linewidth=1, label="exact")
    print(f"exact mid-span: v {v[200]:.6e} m, sxx {sxx[200]:.1f} Pa")
    for control, (label, colour, marker) in controls.items():
        folder = common.run(
            options, f"beam-{control}", "beam.toml", f'hourglass.control="{control}"', *exact
        )
        x, v, sxx = bottom(folder)
        style = dict(color=colour, marker=marker, markersize=2.6, linewidth=0.7, label=label)
        deflection.plot(x, v * 1e3, **style)
        stress.plot(x, sxx / 1e3, **style)
        exact_v, exact_sxx = exact_bottom(x)
        panels[1, 0].plot(x, (v - exact_v) * 1e3, **style)
        panels[1, 1].plot(x, (sxx - exact_sxx) / 1e3, **style)
        middle = np.argmin(abs(x - LENGTH / 2))
        print(
            f"{label}: mid-span v {100 * (v[middle] / exact_v[middle] - 1):+.2f} %; alternating part"
            f" of v {alternating(v - exact_v) / abs(exact_v).max():.2e},"
            f" of sxx {alternating(sxx - exact_sxx) / abs(exact_sxx).max():.2e}"
        )
    deflection.set(ylabel="displacement of the lower face [mm]")
    stress.set(ylabel="axial stress of the lower face [kPa]")
    panels[1, 0].set(xlabel="x [m]", ylabel="less the exact one [mm]")
    panels[1, 1].set(xlabel="x [m]", ylabel="less the exact one [kPa]")
    deflection.legend(loc="upper center")
    common.save(figure, options)


def alternating(values):
    """Root mean square of the part that changes sign from particle to particle, ends left out."""
    part = (values[:-2] - 2 * values[1:-1] + values[2:])[2:-2] / 4
    return np.sqrt(np.mean(part**2))


if __name__ == "__main__":
    main()
