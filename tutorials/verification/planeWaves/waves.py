#!/usr/bin/python3
"""Plane waves in saturated soil, and the exact ones: writes a wave into the dictionaries of a run.

    waves.py <wave>      (in the folder of the run, whose name is the number of cells per wavelength; Allrun calls it)
"""

import sys
from dataclasses import dataclass
from pathlib import Path
from string import Template

import numpy as np

E, NU, N, RHO_S, RHO_W, GRAVITY = 60e6, 0.25, 0.35, 2650, 1000, 9.81
M = E * (1 - NU) / ((1 + NU) * (1 - 2 * NU))


@dataclass(frozen=True)
class Wave:
    """A harmonic wave exp(i (omega t - K z)) of displacements of water and soil [Biot 1956, without added mass]."""

    fast: bool
    frequency: float
    conductivity: float  # hydraulic [m/s]
    Kw: float

    def __str__(self):
        frequency = f"{self.frequency / 1000:g} kHz" if self.frequency >= 1000 else f"{self.frequency:g} Hz"
        return f"{'fast' if self.fast else 'slow'}, {frequency}, k = {self.conductivity:g} m/s, Kw = {self.Kw / 1e6:g} MPa"

    def solution(self):
        """K, and the velocity of the water over that of the soil."""
        omega, drag = 2 * np.pi * self.frequency, N**2 * RHO_W * GRAVITY / self.conductivity
        stiffness = self.Kw / N * np.outer([N, 1 - N], [N, 1 - N]) + np.diag([0, M])
        inertia = omega**2 * np.diag([N * RHO_W, (1 - N) * RHO_S]) - 1j * omega * drag * np.array([[1, -1], [-1, 1]])
        squares, vectors = np.linalg.eig(np.linalg.solve(stiffness, inertia))
        K = np.sqrt(squares)
        K = np.where(K.imag > 0, -K, K)
        which = np.argmin(K.real) if self.fast else np.argmax(K.real)
        return K[which], vectors[0, which] / vectors[1, which]

    @property
    def length(self):
        """Of the wave [m]."""
        return 2 * np.pi / self.solution()[0].real

    @property
    def decay(self):
        """Of the logarithm of the amplitude, over a wavelength."""
        return -self.solution()[0].imag * self.length

    @property
    def diffuses(self):
        """Whether the wave is gone after one wavelength; a longer column keeps the others from their reflection otherwise."""
        return self.decay > 4

    @property
    def column(self):
        """Height over the wavelength."""
        return 1 if self.diffuses else 5

    @property
    def periods(self):
        """Of the run: the last one is looked at."""
        return 12 if self.diffuses else 5

    @property
    def sampled(self):
        """Heights between which the wave is looked at, over the wavelength: before it has lost 7/8 of its amplitude."""
        return 0.05 if self.diffuses else 0.5, min(2, 2 / self.decay)


WAVES = {
    "slow100Hz": Wave(False, 100, 1e-4, 2.2e9),
    "fast100Hz": Wave(True, 100, 1e-4, 2.2e9),
    "slow10kHz": Wave(False, 1e4, 1e-4, 2.2e9),
    "fast10kHz": Wave(True, 1e4, 1e-4, 2.2e9),
    "slow10kHzGravel": Wave(False, 1e4, 1e-2, 2.2e9),
    "fast10kHzGravel": Wave(True, 1e4, 1e-2, 2.2e9),
    "slow1HzGas": Wave(False, 1, 1e-4, 20e6),
    "slow10kHzGas": Wave(False, 1e4, 1e-4, 20e6),
    "fast10kHzGas": Wave(True, 1e4, 1e-4, 20e6),
}


def main():
    if len(sys.argv) != 2 or sys.argv[1] not in WAVES:
        sys.exit(__doc__)
    wave, cells = WAVES[sys.argv[1]], int(Path.cwd().name)
    K, ratio = wave.solution()
    omega = 2 * np.pi * wave.frequency
    speed = 1e-6 * omega / K.real / max(1, abs(ratio))  # strains of a millionth
    relative = N * (ratio - 1)
    entries = {
        "liquidBulkModulus": wave.Kw, "intrinsicPermeability": wave.conductivity * 1e-3 / (RHO_W * GRAVITY),
        "cellsOfColumn": cells * wave.column, "height": wave.column * wave.length, "width": wave.length / cells,
        "frequency": wave.frequency, "ramp": 2 / wave.frequency, "speed": speed,
        "discharge": speed * abs(relative), "dischargeStart": -np.angle(relative) / omega,
        "endTime": wave.periods / wave.frequency, "writeInterval": 1 / (16 * wave.frequency)}
    values = {key: f"{value:.12g}" for key, value in entries.items()}
    for name in ["0/U", "0/p", "constant/materialProperties", "system/blockMeshDict", "system/controlDict"]:
        file = Path(name)
        file.write_text(Template(file.read_text(encoding="utf-8")).safe_substitute(values), encoding="utf-8")


if __name__ == "__main__":
    main()
