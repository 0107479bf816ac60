#!/usr/bin/python3
"""Which measured number may the one modulus of the model be calibrated by? Compares Rollwave with a rubber
cover as an elastic solid: a bonded layer in plane strain, without friction on the road.

Usage: tests/calibration.py [ROLLWAVE]     (default build/rollwave; needs Debian's package python3-numpy)
It prints two tables in Markdown: one number fitted at a time, and other scenes with mu from the nip.

The layer of the thickness h is flat, and its road is the parabola x^2/2 (1/b + kappa): K. L. Johnson, Contact
Mechanics, 1985, sections 4.2 and 5.8. A pressure cos(k x) on the surface gives the displacement
C(k) cos(k x), which the layer's potentials f(y) cos(k x) and g(y) sin(k x) have to meet:

    f'' = k^2 (1 - V^2/c_P^2) f,   g'' = k^2 (1 - V^2/c_S^2) g,   u_x = (g' - k f) sin k x,   u_y = (f' - k g) cos k x

with the speed V of the surface and the speeds of pressure waves and shear waves, c_P and c_S. The base y = h does not
move; the surface y = 0 has the given pressure and no shear stress.
"""
import json
import pathlib
import subprocess
import sys
import tempfile

import numpy

rollwave = sys.argv[1] if len(sys.argv) > 1 else 'build/rollwave'
core, cover, width, load = 45., 12., 320., 1500.  # mm, mm, mm, N
young, poisson, density = 4.5, 0.49, 1.2e-9       # N/mm^2, -, t/mm^3
handbook = young / (2 * (1 + poisson))            # the shear modulus


def layer_compliance(k, h, speed=0.):
    """C(k) of the layer, k > 0. At rest both potentials agree and Johnson's formula takes their place."""
    stretched = (1 - 2 * poisson) / (2 - 2 * poisson)  # (c_S / c_P)^2
    if speed == 0:
        kappa, t = 3 - 4 * poisson, numpy.minimum(k * h, 300.)  # beyond, C is that of the half-space
        return (2 * (1 - poisson**2) / (young * k) * (2 * kappa * numpy.sinh(2 * t) - 4 * t) /
                (2 * kappa * numpy.cosh(2 * t) + 1 + kappa**2 + 4 * t**2))
    mach = speed**2 * density / handbook               # (V / c_S)^2
    p, s = k * (1 - mach * stretched)**0.5, k * (1 - mach)**0.5
    one, zero, fade_p, fade_s = numpy.ones_like(k), numpy.zeros_like(k), numpy.exp(-p * h), numpy.exp(-s * h)
    # exp(-p y), exp(-p (h - y)) of f and exp(-s y), exp(-s (h - y)) of g, at the surface and at the base.
    values = {0: (one, fade_p, one, fade_s), h: (fade_p, one, fade_s, one)}
    u_x = {y: numpy.stack([-k * f1, -k * f2, -s * g1, s * g2], 1) for y, (f1, f2, g1, g2) in values.items()}
    u_y = {y: numpy.stack([-p * f1, p * f2, -k * g1, -k * g2], 1) for y, (f1, f2, g1, g2) in values.items()}
    f1, f2, g1, g2 = values[0]
    stress_yy = handbook * numpy.stack([k**2 * (2 - mach) * f1, k**2 * (2 - mach) * f2,
                                        2 * k * s * g1, -2 * k * s * g2], 1)
    stress_xy = handbook * numpy.stack([2 * k * p * f1, -2 * k * p * f2,
                                        (s**2 + k**2) * g1, (s**2 + k**2) * g2], 1)
    equations = numpy.stack([stress_yy, stress_xy, u_x[h], u_y[h]], 1)
    unit_pressure = numpy.stack([-one, zero, zero, zero], 1)[..., None]
    return numpy.einsum('ki,ki->k', u_y[0], numpy.linalg.solve(equations, unit_pressure)[..., 0])


def layer(load=load, **arguments):
    """Nip, indentation, peak pressure and stiffness, a central difference, under a load."""
    less, more = (pressed_layer(factor * load, **arguments)['indentation'] for factor in (0.95, 1.05))
    return {**pressed_layer(load, **arguments), 'stiffness': 0.1 * load / (more - less)}


def pressed_layer(load, h=cover, curvature=0., speed=0., n=8192):
    """Nip, indentation and peak pressure under a load, by bisection for the half-width, at whose ends the
    pressure is 0. The surface is periodic with its true circumference and has n points."""
    length = 2 * numpy.pi * (core + cover)
    dx = length / n
    k = 2 * numpy.pi * numpy.fft.rfftfreq(n, dx)
    uniform = h * (1 - 2 * poisson) * (1 + poisson) / (young * (1 - poisson))
    compliance = numpy.fft.irfft(numpy.concatenate([[uniform], layer_compliance(k[1:], h, speed)]), n)

    def pressed(m):
        """Indentation and pressure if the 2 m + 1 points in the middle are in contact."""
        points = numpy.arange(-m, m + 1)
        gap = (points * dx)**2 / 2 * (1 / (core + cover) + curvature)
        matrix = compliance[abs(points[:, None] - points)]
        level, shape = numpy.linalg.solve(matrix, numpy.stack([numpy.ones_like(gap), gap], 1)).T
        indentation = (load / width / dx + shape.sum()) / level.sum()
        return indentation, indentation * level - shape

    fewest, most = 1, n // 8
    while most - fewest > 1:
        middle = (fewest + most) // 2
        fewest, most = (middle, most) if pressed(middle)[1][0] >= 0 else (fewest, middle)
    indentation, pressure = pressed(fewest)
    end = pressure[0]**2 / (pressure[1]**2 - pressure[0]**2)  # p^2 is linear next to an end
    return {'nip': 2 * dx * (fewest + min(end, 1.)), 'indentation': indentation, 'peak': pressure.max()}


def model(mu, load=load, h=cover, curvature=0., speed=0.):
    """The same by Rollwave. The density grows with mu, so that the critical speed is that of the rubber."""
    settings = {'Material/Shear modulus': mu, 'Material/Density': density * mu / handbook,
                'Material/Width': width,
                'Cylinder/Inner radius': core + cover - h, 'Cylinder/Outer radius': core + cover,
                'Cylinder/Angular velocity': speed / (core + cover), 'Road/Load': load,
                'Road/Curvature': curvature, 'Mesh/Radial cells': 3, 'Mesh/Angular cells': 90,
                'Mesh/Wanted relative error': 1e-3, 'Output/Files': 'summary'}
    with tempfile.TemporaryDirectory() as directory:
        scene = pathlib.Path(directory) / 'scene.prm'
        scene.touch()
        options = [text for key, value in settings.items() for text in ('--set', f'{key}={value!r}'.replace("'", ''))]
        subprocess.run([rollwave, scene, '--output', directory, *options], check=True,
                       stdout=subprocess.DEVNULL)
        result = json.loads((pathlib.Path(directory) / 'summary.json').read_text())
    return {'nip': result['contact']['length'], 'indentation': result['scene']['deflection'],
            'peak': result['contact']['peak_pressure'],
            'stiffness': result['contact']['stiffness']['vertical_load']}


def calibrated(name, wanted):
    """The mu with which the model has the wanted number: a secant of the logarithms. At rest the result
    depends on load / mu only."""
    mu = [handbook, 2 * handbook]
    found = [model(value)[name] for value in mu]
    while abs(found[-1] / wanted - 1) > 1e-6:
        slope = numpy.log(found[-1] / found[-2]) / numpy.log(mu[-1] / mu[-2])
        mu.append(mu[-1] * (wanted / found[-1])**(1 / slope))
        found.append(model(mu[-1])[name])
    return float(mu[-1])


def table(titles, rows):
    for row in (titles, ['---'] * len(titles), *rows):
        print('| ' + ' | '.join(row) + ' |')


def difference(value, reference):
    return f'{round(100 * (value / reference - 1)) or 0:+d} %'


def compare(cases):
    """Rows of the cases (text, arguments), with mu from the nip."""
    rows = []
    for text, arguments in cases:
        solid, ours = layer(**arguments), model(by_nip, **arguments)
        rows.append([text, f'{solid["nip"]:.1f}', f'{ours["nip"]:.1f}',
                     *(difference(ours[name], solid[name]) for name in solid)])
    return rows


k = numpy.array([1e-2, 0.1, 1.])
assert numpy.allclose(layer_compliance(k, cover), layer_compliance(k, cover, 1.), rtol=1e-3)

solid = layer()
by_nip, by_indentation = (calibrated(name, solid[name]) for name in ('nip', 'indentation'))
rows = [['(the layer)', f'{handbook:.2f}', *(f'{solid[name]:.3g}' for name in solid), *4 * ['']]]
for text, mu in (('handbook', handbook), ('the nip', by_nip), ('the indentation', by_indentation)):
    ours = model(mu)
    rows.append([text, f'{mu:.2f}', *(f'{ours[name]:.3g}' for name in solid),
                 *(difference(ours[name], solid[name]) for name in solid)])
differences = [f'{name}, difference' for name in solid]
table(['mu by', 'mu', *solid, *differences], rows)
print()
table(['mu by the nip', 'nip of the layer', 'of the model', *differences], compare(
    [(f'load {p:g} N', {'load': p}) for p in (500., 1000., 1500., 2000., 3000.)] +
    [(f'drum with a radius of {1 / kappa:g} mm', {'curvature': kappa}) for kappa in (1 / 200, 1 / 100, 1 / 50)] +
    [(f'surface at {speed:g} m/s', {'speed': 1e3 * speed}) for speed in (10., 20., 25., 30.)] +
    [(f'cover of {h:g} mm', {'h': h}) for h in (6., 9., 18., 24.)]))
