"""Further problems of `trade` whose answers are known: scenes that are made here, in another way than those that are shipped."""

import math

SMALL = '[approximation]\nkinematics = "small_strain"\n'
LOADED = '[drive]\nkind = "load"\nscales = ["traction"]\n'
LINEAR = "[programme]\nsteps = 1\n[solver]\ntolerance = 1e-5\nmax_evaluations_per_step = 4000\n"


def box(lower, upper, spacing):
    return f"[geometry]\ndimension = {len(lower)}\nmin = {lower}\nmax = {upper}\nspacing = {spacing}\n{SMALL}"


def material(young, poisson, more=""):
    return f'[[material]]\nname = "m"\nyoungs_modulus = {young!r}\npoissons_ratio = {poisson!r}\n{more or ELASTIC}'


ELASTIC = 'model = "elastic"\n'


def yields(model, cohesion, angle, more=""):
    return f'model = "{model}"\ncohesion = {cohesion}\nfriction_angle = {angle}\ndilation_angle = {angle}\n{more}'


def support(side, directions):
    named = ", ".join(f'"{axis}"' for axis in directions)
    return f'[[support]]\nname = "{side}"\nside = "{side}"\ndirections = [{named}]\n'


def mirror(axis):
    return f'[[symmetry]]\naxis = "{axis}"\nposition = 0.0\n'


def traction(name, side, start, end, x, y):
    return (f'[[traction]]\nname = "{name}"\nside = "{side}"\nrange_min = [{start!r}]\nrange_max = [{end!r}]\n'
            f"value = [{x!r}, {y!r}]\n")


def around_a_hole(x, y, far):
    """Stresses xx, yy, xy about a hole of radius 1 under a tension along x (Kirsch)."""
    r, turn = math.hypot(x, y), math.atan2(y, x)
    a = 1 / r**2
    rr = far / 2 * (1 - a + (1 - 4 * a + 3 * a * a) * math.cos(2 * turn))
    tt = far / 2 * (1 + a - (1 + 3 * a * a) * math.cos(2 * turn))
    rt = -far / 2 * (1 + 2 * a - 3 * a * a) * math.sin(2 * turn)
    c, s = math.cos(turn), math.sin(turn)
    return rr * c * c + tt * s * s - 2 * rt * s * c, rr * s * s + tt * c * c + 2 * rt * s * c, \
        (rr - tt) * s * c + rt * (c * c - s * s)


def plate_with_a_hole(far=1e3, edge=4.0, pieces=48, young=1e6, nu=0.3):
    """A quarter, its outer faces under the exact tractions in pieces; how the hole opens."""
    text = (box([0.0, 0.0], [edge, edge], 0.1) + material(young, nu) + mirror("x") + mirror("y") +
            '[[cutout]]\nname = "hole"\ncentre = [0.0, 0.0]\nradius = 1.0\n')
    for k in range(pieces):
        start, end = edge * k / pieces, edge * (k + 1) / pieces
        middle = (start + end) / 2
        xx, yy, xy = around_a_hole(edge, middle, far)
        text += traction(f"right {k}", "right", start, end, xx, xy)
        xx, yy, xy = around_a_hole(middle, edge, far)
        text += traction(f"top {k}", "top", start, end, xy, yy)
    shear = young / 2 / (1 + nu)
    opening = far / (8 * shear) * (3 - 4 * nu + 1 + 2 * (1 + 3 - 4 * nu))
    return text + LOADED + LINEAR, opening


def cook():
    """Cook's membrane, plane stress of E = 1 and nu = 1/3 by the plane strain that is the same, sheared by 1; 23.965 is
    what finite elements of high order converge to."""
    nu = 1 / 3
    sides = [("wall", "fixed", [[0, 0], [0, 44]]), ("below", "free", [[0, 0], [48, 44]]),
             ("above", "free", [[48, 60], [0, 44]])]
    text = (f"[geometry]\nspacing = 1.0\n{SMALL}" + material((1 + 2 * nu) / (1 + nu)**2, nu / (1 + nu)) +
            '[[region]]\nmaterial = "m"\noutline = [[0, 0], [48, 44], [48, 60], [0, 44]]\n')
    for name, kind, along in sides:
        text += f'[[side]]\nname = "{name}"\nkind = "{kind}"\nalong = {along}\n'
    text += f'[[side]]\nname = "end"\nkind = "loaded"\nlive_shear = {1 / 16}\nalong = [[48, 44], [48, 60]]\n'
    return text + LOADED + LINEAR


def stiffer_with_depth(load=10e3, top=2e6, slope=3e6, depth=4.0):
    """A column held on its sides whose stiffness grows with depth (Gibson's soil)."""
    confined = 0.7 / (1.3 * 0.4)
    young = f"{{ at = [0, 0], value = {top}, gradient = [0, {-slope}] }}"
    text = (box([0.0, -depth], [1.0, 0.0], 0.125) + material(0.0, 0.3).replace("0.0", young, 1) +
            support("bottom", "xy") + support("left", "x") + support("right", "x") +
            f'[[traction]]\nname = "load"\nside = "top"\nvalue = [0.0, {-load}]\n')
    return text + LOADED + LINEAR, -load / (slope * confined) * math.log((top + slope * depth) / top)


def passive(cohesion=5e3, angle=20, weight=18e3, height=2.0):
    """A smooth wall pushed into the ground (Rankine); its mean pressure."""
    text = (box([0.0, 0.0], [6.0, height], 0.125) +
            material(10e6, 0.3, yields("drucker_prager", cohesion, angle, f"unit_weight = {weight}\n")) +
            support("bottom", "y") + support("right", "x") +
            '[gravity]\nacceleration = [0, -9.81]\n[initial_stress]\nkind = "geostatic"\n'
            '[drive]\nkind = "displacement"\nside = "left"\ndirection = [1.0, 0.0]\nlateral = "free"\n'
            f"target = 0.2\nwidth = {height}\n[programme]\nsteps = 40\n")
    ratio = math.tan(math.radians(45 + angle / 2))**2
    return text, weight * height / 2 * ratio + 2 * cohesion * math.sqrt(ratio)


def squeezed(cohesion=1e3, angle=30):
    """A block in space between smooth plates; Mohr and Coulomb's unconfined strength."""
    text = (box([0.0, 0.0, 0.0], [1.0, 2.0, 1.0], 0.25) + material(1e6, 0.3, yields("mohr_coulomb", cohesion, angle)) +
            support("bottom", "y") + mirror("x") + mirror("z") +
            '[drive]\nkind = "displacement"\nside = "top"\ndirection = [0.0, -1.0, 0.0]\nlateral = "free"\n'
            "target = 0.02\nwidth = 1.0\n[programme]\nsteps = 10\n")
    return text, 2 * cohesion * math.tan(math.radians(45 + angle / 2))


def surcharged(scenes, angle=20, load=2e3):
    """The strip of the scene with a load beside it (Prandtl, Reissner)."""
    beside = traction("beside", "top", 1.0, 7.0, 0.0, -load)
    text = (scenes / "prandtl_phi20.toml").read_text().replace("[drive]", beside + "[drive]")
    phi = math.radians(angle)
    of_load = math.exp(math.pi * math.tan(phi)) * math.tan(math.pi / 4 + phi / 2)**2
    return text.replace("target = 0.6", "target = 0.9"), 1e3 * (of_load - 1) / math.tan(phi) + load * of_load


def problems(scenes, folder):
    """Name: scene, settings, quantity, exact value and where it is from."""
    def made(name, text, quantity, exact, source):
        path = folder / f"{name.replace(' ', '_')}.toml"
        path.write_text(text)
        return path, [], quantity, exact, source

    hole, gibson, wall, block, strip = (plate_with_a_hole(), stiffer_with_depth(), passive(), squeezed(),
                                        surcharged(scenes))
    clay = ["material.0.model=mohr_coulomb", "material.0.cohesion=1e3", "material.0.friction_angle=0",
            "material.0.dilation_angle=0", "cutout.0.pressure=2e3", "programme.steps=20", "solver.tolerance=1e-3"]
    return {
        "plate with a hole": made("plate with a hole", hole[0], "displacement_x@1,0", hole[1], "Kirsch"),
        "membrane": made("membrane", cook(), "displacement_y@48,52", 23.965, "Cook"),
        "column of Gibson's soil": made("gibson", gibson[0], "displacement_y@0.5,0", gibson[1], "one-dimensional"),
        "strip, smooth": ("prandtl_phi0.toml", ["drive.lateral=free", "drive.method=auto"], "mean_pressure_Pa",
                          1e3 * (2 + math.pi), "Prandtl"),
        "strip, load beside it": made("surcharged", strip[0], "mean_pressure_Pa", strip[1], "Prandtl, Reissner"),
        "passive pressure": made("passive", wall[0], "mean_pressure_Pa", wall[1], "Rankine"),
        "squeezed block in 3D": made("squeezed", block[0], "mean_pressure_Pa", block[1], "Mohr, Coulomb"),
        "cylinder of clay, collapse": ("cylinder.toml", clay, "load_parameter", math.log(2), "plasticity"),
    }
