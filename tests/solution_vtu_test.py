"""solution.vtu opens in VTK with its fields, and the deformed cylinder stays above the road.

Usage: solution_vtu_test.py PROGRAM FILE.prm DEGREE
"""
import json
import math
import subprocess
import sys
import tempfile

from vtkmodules.vtkCommonCore import reference
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader

program, scene, degree = sys.argv[1], sys.argv[2], int(sys.argv[3])
distance, peak_pressure, angular_cells = 0.8, 0.424857, 120


def check(condition, text):
    if not condition:
        sys.exit("failed: " + text)


with tempfile.TemporaryDirectory() as directory:
    subprocess.run(
        [program, scene, "--output", directory, "--set", f"Mesh/Degree={degree}",
         "--set", "Mesh/Radial cells=8", "--set", f"Mesh/Angular cells={angular_cells}",
         "--set", "Output/Files=solution, summary"],
        check=True, stdout=subprocess.DEVNULL)
    reader = vtkXMLUnstructuredGridReader()
    reader.SetFileName(directory + "/solution.vtu")
    reader.Update()
    grid = reader.GetOutput()
    with open(directory + "/summary.json") as file:
        summary = json.load(file)

nodes_per_cell = (degree + 1) ** 2
check(grid.GetNumberOfCells() == 8 * angular_cells, "number of cells")
for cell in range(grid.GetNumberOfCells()):
    check(grid.GetCell(cell).GetNumberOfPoints() == nodes_per_cell, "nodes of a cell")

x_min, x_max, y_min, y_max, z_min, z_max = grid.GetBounds()
check(z_min == 0 and z_max == 0, "plane")
check(0.98 < x_max < 1 and abs(x_min + x_max) < 1e-6, "width")
check(0.999 < y_max < 1, "top")
check(abs(y_min + distance) < 1e-6, "the lowest node touches the road")

fields = grid.GetPointData()
displacement, pressure = fields.GetArray("displacement"), fields.GetArray("pressure")
check(displacement is not None and pressure is not None, "fields by name")
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

surface = []
for i in range(grid.GetNumberOfPoints()):
    x, y, _ = grid.GetPoint(i)
    u, p = displacement.GetValue(i), pressure.GetValue(i)
    radius = math.hypot(x, y) - u
    check(0.5 - 1e-6 < radius < 1 + 1e-6, "undeformed radius")
    check(math.isnan(p) == (radius < 1 - 1e-6), "pressure on the surface and only there")
    if not math.isnan(p):
        surface.append((x, y, p))
        check(p >= 0 and (p == 0 or abs(y + distance) < 1e-6), "pressure only on the road")
check(abs(max(p for _, _, p in surface) - peak_pressure) < 1e-2 * peak_pressure, "peak pressure")

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
print("1 passed, 0 failed")
