"""Speed and attenuation of plane waves in saturated soil, from amplitude and phase over the height."""

import sys
from dataclasses import replace

import numpy as np
from waves import WAVES

sys.path.insert(0, "..")
import verification as v  # noqa: E402


def measured(wave, run):
    """K from the straight lines of the logarithm of the amplitude, and of the phase, of the last period over the height.

    They are those of a combination of the velocities of soil and water that the other of the two waves does not have.
    """
    other = replace(wave, fast=not wave.fast).solution()[1]
    last = [points for points in v.written(run) if points.time > (wave.periods - 1 + 1e-6) / wave.frequency]
    turns = np.exp(-2j * np.pi * wave.frequency * np.array([points.time for points in last]))
    order = np.argsort(last[0].Z)
    height = last[0].Z[order]
    amplitude = (turns @ np.array([points.vz - points.wz / other for points in last]))[order]
    lower, upper = wave.sampled
    inside = (height > lower * wave.length) & (height < upper * wave.length)
    logarithm = np.log(np.abs(amplitude)) + 1j * np.unwrap(np.angle(amplitude))
    return 1j * np.polyfit(height[inside], logarithm[inside], 1)[0]


runs = v.folders()
finest = v.cells(runs[-1])
figure, axes = v.picture("frequency times conductivity [m/s²]", "speed [m/s]")
reports = []
for name, wave in WAVES.items():
    exact = wave.solution()[0]
    own = [run / name / run.name for run in runs]
    found = np.array([measured(wave, run) for run in own])
    reports.append((f"plane wave {wave}: speed", own, exact.real / found.real - 1, {20: 0.06, 40: 0.01}.get(finest, 5e-3)))
    if wave.decay > 0.015:  # what the start of the wave leaves hides a smaller one
        reports.append((f"plane wave {wave}: attenuation", own, found.imag / exact.imag - 1, {20: 0.1, 40: 0.03}.get(finest, 0.02)))
    axes.loglog(wave.frequency * wave.conductivity, 2 * np.pi * wave.frequency / found[-1].real, "^" if wave.fast else "v",
                color="C0" if wave.Kw > 1e9 else "C1", label=f"{'fast' if wave.fast else 'slow'}, {finest} cells" if wave.Kw > 1e9
                and wave.conductivity > 1e-3 else None)
products = np.geomspace(5e-5, 200, 200)
for Kw, colour in ((2.2e9, "C0"), (20e6, "C1")):
    for fast in (True, False):
        speeds = [2 * np.pi * product / replace(wave, fast=fast, frequency=product, conductivity=1, Kw=Kw).solution()[0].real
                  for product in products]
        axes.loglog(products, speeds, "-", color=colour, linewidth=0.8, label=f"exact, Kw = {Kw / 1e6:g} MPa" if fast else None)
v.save(figure, axes)
for quantity, own, errors, target in reports:
    v.report(quantity, own, errors, target, last=quantity == reports[-1][0])
