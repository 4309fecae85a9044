#!/usr/bin/python3
"""usage: run_scipy.py LIBRARY [NAME]

Every problem with NAME in its name by scipy's newton_krylov; LIBRARY is that of problems_c.cpp.
Prints the lines that trial.hpp describes, and gives each solve a process of its own as run_all
there does.
"""
import ctypes
import os
import resource
import signal
import sys
import warnings

import numpy
from scipy.optimize import newton_krylov
from scipy.sparse.linalg import LinearOperator

# What newton_krylov is told besides the residual; the first is how it comes.
CONFIGURATIONS = {
    "lgmres 20": dict(method="lgmres"),
    "lgmres 200": dict(method="lgmres", inner_maxiter=200),
    "gmres 200": dict(method="gmres", inner_maxiter=200),
    "bicgstab 200": dict(method="bicgstab", inner_maxiter=200),
    "gmres 200, Wolfe": dict(method="gmres", inner_maxiter=200, line_search="wolfe"),
}
DOUBLES = numpy.ctypeslib.ndpointer(float, ndim=1, flags="C_CONTIGUOUS")


class Met(Exception):
    """The goal was met; scipy's own stopping rule does not count."""


class Exhausted(Exception):
    """No evaluation is left."""


def load(path):
    library = ctypes.CDLL(path)
    trial = ctypes.c_void_p
    for name, result, arguments in [
            ("problems", ctypes.c_int, []), ("name", ctypes.c_char_p, [ctypes.c_int]),
            ("set", ctypes.c_char_p, [ctypes.c_int]), ("max_seconds", ctypes.c_int, []),
            ("open", trial, [ctypes.c_int, ctypes.c_int]), ("close", None, [trial]),
            ("unknowns", ctypes.c_int, [trial]), ("start", None, [trial, DOUBLES]),
            ("goal", ctypes.c_double, [trial]),
            ("evaluate", ctypes.c_int, [trial, DOUBLES, DOUBLES]),
            ("precondition", None, [trial, DOUBLES, DOUBLES]), ("met_at", ctypes.c_int, [trial]),
            ("exhausted", ctypes.c_int, [trial]), ("milliseconds", ctypes.c_double, [trial])]:
        function = getattr(library, "peers_" + name)
        function.restype = result
        function.argtypes = arguments
    return library


def solve(peers, trial, preconditioned, choices):
    """Whether scipy claims success, and in what words."""
    n = peers.peers_unknowns(trial)

    def residual(u):
        r = numpy.empty(n)
        if not peers.peers_evaluate(trial, numpy.ascontiguousarray(u, float).ravel(), r):
            if peers.peers_exhausted(trial):
                raise Exhausted
            r.fill(numpy.nan)
        if peers.peers_met_at(trial):
            raise Met
        return r

    def precondition(r):
        z = numpy.empty(n)
        peers.peers_precondition(trial, numpy.ascontiguousarray(r, float).ravel(), z)
        return z

    if preconditioned:
        choices = dict(choices, inner_M=LinearOperator((n, n), precondition, dtype=float))
    start = numpy.empty(n)
    peers.peers_start(trial, start)
    try:
        newton_krylov(residual, start, f_tol=1e-3 * peers.peers_goal(trial), maxiter=2000,
                      tol_norm=numpy.linalg.norm, **choices)
        return True, "converged"
    except Met:
        return True, "met"
    except Exhausted:
        return False, "evaluations"
    except Exception as error:  # NoConvergence holds an array; others come from deep inside
        return False, type(error).__name__


def run(peers, problem, trial, preconditioned, name, choices):
    line = [peers.peers_name(problem).decode(), peers.peers_set(problem).decode(),
            "factors" if preconditioned else "none", "scipy " + name]
    sys.stdout.flush()
    child = os.fork()
    if child == 0:
        limit = peers.peers_max_seconds()
        resource.setrlimit(resource.RLIMIT_CPU, (limit, limit + 1))
        signal.alarm(20 * limit)
        claimed, note = solve(peers, trial, preconditioned, choices)
        met = peers.peers_met_at(trial)
        ms = peers.peers_milliseconds(trial)
        print(*line, int(claimed), int(met > 0), met, "%.2f" % ms, note, sep=";", flush=True)
        os._exit(0)
    status = os.waitpid(child, 0)[1]
    if status != 0:
        print(*line, 0, 0, 0, "0.00", "ended: takes too long", sep=";", flush=True)


def main():
    if len(sys.argv) not in (2, 3):
        sys.exit(__doc__)
    warnings.simplefilter("ignore")
    numpy.seterr(all="ignore")
    peers = load(sys.argv[1])
    wanted = sys.argv[2] if len(sys.argv) > 2 else ""
    for preconditioned in (False, True):
        for problem in range(peers.peers_problems()):
            if wanted not in peers.peers_name(problem).decode():
                continue
            trial = peers.peers_open(problem, preconditioned)  # each process has its own copy
            for name, choices in CONFIGURATIONS.items():
                run(peers, problem, trial, preconditioned, name, choices)
            peers.peers_close(trial)


main()
