#!/usr/bin/env python3
"""Draws solution.vtu of a directory with surface and road as ParaView would.

Usage: xvfb-run -a screenshot.py DIRECTORY PICTURE.png
"""
import re
import sys
import vtk

if len(sys.argv) != 3:
    sys.exit(__doc__)
directory, picture = sys.argv[1:]


def read(name):
    reader = vtk.vtkXMLUnstructuredGridReader()
    reader.SetFileName(directory + '/' + name)
    reader.Update()
    return reader.GetOutput()


solution = read('solution.vtu')
surface_filter = vtk.vtkDataSetSurfaceFilter()
surface_filter.SetInputData(solution)
surface_filter.SetNonlinearSubdivisionLevel(3)
surface_filter.Update()
# With units the name is followed by one, as in 'displacement_mm'.
displacement = next(name for name in (solution.GetPointData().GetArrayName(i) for i in range(
    solution.GetPointData().GetNumberOfArrays())) if re.fullmatch('displacement(_(?!vector).*)?', name))
low, high = solution.GetPointData().GetArray(displacement).GetRange()
colours = vtk.vtkColorTransferFunction()
colours.SetColorSpaceToDiverging()
low, high = min(low, 0), max(high, 0)
if low < 0:
    colours.AddRGBPoint(low, 0.230, 0.299, 0.754)
colours.AddRGBPoint(0, 0.865, 0.865, 0.865)
if high > 0:
    colours.AddRGBPoint(high, 0.706, 0.016, 0.150)
mapper = vtk.vtkPolyDataMapper()
mapper.SetInputConnection(surface_filter.GetOutputPort())
mapper.SetScalarModeToUsePointFieldData()
mapper.SelectColorArray(displacement)
mapper.SetLookupTable(colours)
mapper.SetScalarRange(low, high)
field = vtk.vtkActor()
field.SetMapper(mapper)
renderer = vtk.vtkRenderer()
renderer.SetBackground(1, 1, 1)
renderer.AddActor(field)


def line(name, colour, width):
    source = vtk.vtkGeometryFilter()
    source.SetInputData(read(name))
    lines = vtk.vtkPolyDataMapper()
    lines.SetInputConnection(source.GetOutputPort())
    lines.ScalarVisibilityOff()
    actor = vtk.vtkActor()
    actor.SetMapper(lines)
    actor.GetProperty().SetColor(*colour)
    actor.GetProperty().SetLineWidth(width)
    actor.GetProperty().SetRenderLinesAsTubes(True)
    renderer.AddActor(actor)


line('road.vtu', (0.1, 0.1, 0.1), 3)
line('surface.vtu', (0.2, 0.2, 0.2), 2)
bar = vtk.vtkScalarBarActor()
bar.SetLookupTable(colours)
bar.SetTitle(displacement)
bar.SetNumberOfLabels(5)
bar.SetLabelFormat('%.3g')
bar.SetUnconstrainedFontSize(True)
bar.SetVerticalTitleSeparation(16)
for text in (bar.GetTitleTextProperty(), bar.GetLabelTextProperty()):
    text.SetColor(0, 0, 0)
    text.SetFontSize(18)
    text.ItalicOff()
    text.ShadowOff()
bar.SetPosition(0.83, 0.2)
bar.SetHeight(0.6)
bar.SetWidth(0.1)
renderer.AddActor2D(bar)
window = vtk.vtkRenderWindow()
window.SetOffScreenRendering(True)
window.SetSize(900, 640)
window.SetMultiSamples(8)
window.AddRenderer(renderer)
camera = renderer.GetActiveCamera()
camera.ParallelProjectionOn()
b = max(abs(bound) for bound in solution.GetBounds())
camera.SetFocalPoint(0.2 * b, 0, 0)
camera.SetPosition(0.2 * b, 0, b)
camera.SetParallelScale(1.1 * b)
renderer.ResetCameraClippingRange()
window.Render()
image = vtk.vtkWindowToImageFilter()
image.SetInput(window)
image.ReadFrontBufferOff()
writer = vtk.vtkPNGWriter()
writer.SetFileName(picture)
writer.SetInputConnection(image.GetOutputPort())
writer.Write()
