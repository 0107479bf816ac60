"""solution.vtu and surface.vtu open in VTK with their fields; the cylinder stays above the road.

Usage: solution_vtu_test.py PROGRAM FILE.prm DEGREE
"""
import csv
import json
import math
import subprocess
import sys
import tempfile

from vtkmodules.vtkCommonCore import reference
from vtkmodules.vtkCommonDataModel import vtkCellLocator
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader

program, scene, degree = sys.argv[1], sys.argv[2], int(sys.argv[3])
distance, peak_pressure, angular_cells = 0.8, 0.424857, 120


def check(condition, text):
    if not condition:
        sys.exit("failed: " + text)


def read(directory, name):
    reader = vtkXMLUnstructuredGridReader()
    reader.SetFileName(directory + "/" + name)
    reader.Update()
    return reader.GetOutput()


def run(directory, cells, *settings):
    subprocess.run(
        [program, scene, "--output", directory, "--set", f"Mesh/Degree={degree}",
         "--set", "Mesh/Radial cells=8", "--set", f"Mesh/Angular cells={angular_cells}",
         "--set", "Output/Files=solution, surface, summary", "--set", "Output/Cells=" + cells,
         *(word for setting in settings for word in ("--set", setting))],
        check=True, stdout=subprocess.DEVNULL)


with tempfile.TemporaryDirectory() as directory:
    run(directory, "linear")
    linear = read(directory, "solution.vtu")
    run(directory, "high-order")
    grid, surface, road = (read(directory, name + ".vtu")
                           for name in ("solution", "surface", "road"))
    with open(directory + "/summary.json") as file:
        summary = json.load(file)

check(linear.GetNumberOfCells() == 8 * angular_cells * degree ** 2, "number of linear cells")
check(linear.GetCell(0).GetNumberOfPoints() == 4, "nodes of a linear cell")
nodes_per_cell = (degree + 1) ** 2
check(grid.GetNumberOfCells() == 8 * angular_cells, "number of cells")
for cell in range(grid.GetNumberOfCells()):
    check(grid.GetCell(cell).GetNumberOfPoints() == nodes_per_cell, "nodes of a cell")
whole = grid.GetFieldData()
for name, value in (("omega", 0.5), ("c", distance), ("F", summary["contact"]["force"])):
    check(abs(whole.GetArray(name).GetValue(0) - value) < 1e-15, name)

x_min, x_max, y_min, y_max, z_min, z_max = grid.GetBounds()
check(z_min == 0 and z_max == 0, "plane")
check(0.98 < x_max < 1 and abs(x_min + x_max) < 1e-6, "width")
check(0.999 < y_max < 1, "top")
check(abs(y_min + distance) < 1e-6, "the lowest node touches the road")

fields = grid.GetPointData()
displacement, stress = fields.GetArray("displacement"), fields.GetArray("radial_stress")
vector, radii, angles = (fields.GetArray(name)
                         for name in ("displacement_vector", "radius", "angle"))
low, high = displacement.GetRange()
check(abs(low - (distance - 1)) < 1e-6 and high <= 1e-6, "range of the displacement")

# The squares of the cells' parts of the bound add up to twice the width of the energy bounds.
certified = fields.GetArray("certified_error")
squares = 0
for cell in range(grid.GetNumberOfCells()):
    points = grid.GetCell(cell).GetPointIds()
    values = {certified.GetValue(points.GetId(k)) for k in range(points.GetNumberOfIds())}
    check(len(values) == 1, "one bound for each cell")
    squares += values.pop() ** 2
energy = summary["energy"]
check(abs(squares / (2 * (energy["upper_bound"] - energy["lower_bound"])) - 1) < 1e-5,
      "sum of the cells' bounds")

lowest_stress = 0
for i in range(grid.GetNumberOfPoints()):
    place, moved, u = grid.GetPoint(i), vector.GetTuple(i), displacement.GetValue(i)
    radius, angle = radii.GetValue(i), angles.GetValue(i)
    start = radius * math.cos(angle), radius * math.sin(angle)
    check(0.5 - 1e-6 < radius < 1 + 1e-6, "undeformed radius")
    for k in range(2):
        check(abs(start[k] + moved[k] - place[k]) < 1e-6, "position")
        check(abs(moved[k] - u * start[k] / radius) < 1e-6, "vector of the displacement")
    if radius > 1 - 1e-6:
        lowest_stress = min(lowest_stress, stress.GetValue(i))
check(abs(lowest_stress + peak_pressure) < 0.1 * peak_pressure, "stress under the contact")

# The surface is a closed line; where there is pressure it is on the road. Numbers are single.
check(surface.GetNumberOfCells() == angular_cells * degree, "pieces of the line")
check(surface.GetNumberOfPoints() == angular_cells * degree + 1, "nodes of the surface")
fields = surface.GetPointData()
pressure, gap, displacement = (fields.GetArray(name)
                               for name in ("pressure", "gap", "displacement"))
check(abs(pressure.GetRange()[1] - peak_pressure) < 1e-2 * peak_pressure, "peak pressure")
for i in range(surface.GetNumberOfPoints()):
    x, y, _ = surface.GetPoint(i)
    check(abs(math.hypot(x, y) - 1 - displacement.GetValue(i)) < 1e-6, "radius of the surface")
    if pressure.GetValue(i) != 0:
        check(pressure.GetValue(i) > 0 and abs(y + distance) < 1e-6, "pressure on the road")
        check(abs(gap.GetValue(i)) < 1e-7, "no gap under pressure")
    check(math.isnan(gap.GetValue(i)) == (-y / math.hypot(x, y) <= distance / 2), "gap at the road")
for i in range(road.GetNumberOfPoints()):
    check(abs(road.GetPoint(i)[1] + distance) < 1e-6, "road")

# Nodes obey the road exactly; between them the polynomial through points of a curve of curvature
# below 1 leaves it by no more than h^2 / 8 of the node spacing h.
spacing = 2 * math.pi / (angular_cells * degree)
outline = 0
for cell in range(grid.GetNumberOfCells()):
    points = grid.GetCell(cell)
    for a in [k / 20 for k in range(21)]:
        weights = [0.0] * nodes_per_cell
        position = [0.0, 0.0, 0.0]
        points.EvaluateLocation(reference(0), [1.0, a, 0.0], position, weights)
        outline = min(outline, position[1])
check(outline >= -distance - spacing ** 2 / 8, "outline above the road")

# Between the nodes of few cells: the trace of solution.vtu on r = b is the polynomial through the
# nodal values of contact.csv, its points lie at the deformed places of surface.vtu, and the radial
# stress is the derivative of the displacement.
def lagrange(nodes, values, x):
    return sum(values[i] * math.prod((x - nodes[k]) / (nodes[i] - nodes[k])
                                     for k in range(len(nodes)) if k != i)
               for i in range(len(nodes)))


def number(grid, name, cell, place):
    """A point field of a cell at a place in its coordinates, both from 0 to 1."""
    weights = [0.0] * cell.GetNumberOfPoints()
    position = [0.0, 0.0, 0.0]
    cell.EvaluateLocation(reference(0), [*place, 0.0], position, weights)
    field = grid.GetPointData().GetArray(name)
    return sum(w * field.GetValue(cell.GetPointId(k)) for k, w in enumerate(weights)), position


for probed in range(1, 9) if degree == 1 else []:
    with tempfile.TemporaryDirectory() as directory:
        run(directory, "high-order", f"Mesh/Degree={probed}", "Mesh/Radial cells=1",
            "Mesh/Angular cells=12", "Output/Files=solution, surface, contact")
        grid, surface = read(directory, "solution.vtu"), read(directory, "surface.vtu")
        with open(directory + "/contact.csv") as file:
            nodes = [(float(row["z"]), float(row["u"])) for row in csv.DictReader(file)]
    greatest = max(abs(u) for _, u in nodes)
    stress_range = grid.GetPointData().GetArray("radial_stress").GetRange()
    n_probed = 0
    for k in range(grid.GetNumberOfCells()):
        cell = grid.GetCell(k)
        begin, end = (number(grid, "angle", cell, (1, t))[0] for t in (0, 1))
        own = [node for node in nodes if begin - 1e-5 < node[0] < end + 1e-5]
        for t in [i / 17 for i in range(18)]:
            u, position = number(grid, "displacement", cell, (1, t))
            if len(own) == probed + 1:
                exact = lagrange(*zip(*own), begin + t * (end - begin))
                check(abs(u - exact) < 2e-6 * greatest, f"u between nodes, degree {probed}")
                n_probed += 1
            step = 0.01
            slope = sum(sign * number(grid, "displacement", cell, (0.5 + sign * step, t))[0]
                        for sign in (-1, 1)) / (2 * step * 0.5)
            stress = number(grid, "radial_stress", cell, (0.5, t))[0]
            check(abs(slope - stress) < 2e-3 * (stress_range[1] - stress_range[0]),
                  f"radial stress between nodes, degree {probed}")
        for i in range(surface.GetNumberOfPoints()):
            z = surface.GetPointData().GetArray("angle").GetValue(i)
            if begin <= z <= end:
                u, position = number(grid, "displacement", cell, (1, (z - begin) / (end - begin)))
                check(abs(u - surface.GetPointData().GetArray("displacement").GetValue(i))
                      < 2e-6 * greatest, f"surface, degree {probed}")
    check(n_probed >= 4 * 18, "cells under the contact")

# At hanging nodes the curve of the coarser cell's side is that of the sides of the finer cells.
with tempfile.TemporaryDirectory() as directory:
    run(directory, "high-order", "Mesh/Radial cells=2", "Mesh/Angular cells=24",
        "Mesh/Adaptive cycles=3", "Output/Files=solution")
    grid = read(directory, "solution.vtu")


def place(cell, coordinates):
    position = [0.0, 0.0, 0.0]
    cell.EvaluateLocation(reference(0), [*coordinates, 0.0], position,
                          [0.0] * cell.GetNumberOfPoints())
    return position


def middle(one, other):
    return tuple((a + b) / 2 for a, b in zip(one, other))


corners = ((0, 0), (1, 0), (1, 1), (0, 1))
sides = {}  # by the places of their ends in (r, z), in both directions
for k in range(grid.GetNumberOfCells()):
    cell = grid.GetCell(k)
    nodes = [tuple(round(grid.GetPointData().GetArray(name).GetValue(cell.GetPointId(i)), 5)
                   for name in ("radius", "angle")) for i in range(4)]
    for i, j in ((0, 1), (1, 2), (2, 3), (3, 0)):
        for one, other in ((i, j), (j, i)):
            sides.setdefault((nodes[one], nodes[other]), []).append(
                (k, corners[one], corners[other]))
n_hanging = 0
ends = {end for end, _ in sides}
for (begin, end), own in sides.items():
    for near in (node for node in ends if len(own) == 1 and max(
            abs(a - b) for a, b in zip(node, middle(begin, end))) < 3e-5):
        for k, one, other in sides.get((begin, near), []):
            coarse, first, last = own[0]
            for t in (0.0, 0.5, 1.0):
                here = place(grid.GetCell(k), [a + t * (b - a) for a, b in zip(one, other)])
                there = place(grid.GetCell(coarse),
                              [a + t / 2 * (b - a) for a, b in zip(first, last)])
                check(math.dist(here, there) < 3e-7, "no crack at a hanging node")
            n_hanging += 1
check(n_hanging > 10, "hanging nodes")

# Cells of four nodes leave no crack either, so that VTK finds every point of a circle.
with tempfile.TemporaryDirectory() as directory:
    run(directory, "linear", "Mesh/Radial cells=2", "Mesh/Angular cells=24",
        "Mesh/Adaptive cycles=3", "Output/Files=solution")
    grid = read(directory, "solution.vtu")
locator = vtkCellLocator()
locator.SetDataSet(grid)
locator.BuildLocator()
for radius in (0.6, 0.7, 0.75):
    for i in range(400):
        z = 2 * math.pi * (i + 0.5) / 400
        check(locator.FindCell([radius * math.cos(z), radius * math.sin(z), 0.0]) >= 0,
              "a cell at every point")

# One piece, also of many cells: some programs read the last piece only.
if degree == 1:
    with tempfile.TemporaryDirectory() as directory:
        run(directory, "linear", "Mesh/Radial cells=100", "Mesh/Angular cells=600",
            "Output/Files=solution")
        with open(directory + "/solution.vtu") as file:
            check(file.read().count("<Piece") == 1, "one piece")

# The cylinder fills a drum: the gap is zero all around.
with tempfile.TemporaryDirectory() as directory:
    run(directory, "linear", "Cylinder/Radial force=2", "Road/Curvature=-0.9",
        "Road/Distance=1.05")
    surface = read(directory, "surface.vtu")
fields = surface.GetPointData()
for i in range(surface.GetNumberOfPoints()):
    check(fields.GetArray("pressure").GetValue(i) > 0, "pressure all around")
    check(abs(fields.GetArray("gap").GetValue(i)) < 1e-7, "no gap inside of a drum")
print("1 passed, 0 failed")
