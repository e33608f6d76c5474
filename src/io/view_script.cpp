// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/view_script.h"

namespace grainfrac {

std::string view_script()
{
    return R"py(# Opens this result folder in ParaView (5.9 or newer):
#
#   paraview --script=view.py
#   pvpython view.py --save picture.png [--time last|first|SECONDS] [--color FIELD] [--size 1600x1200]
#
# Written by grainfrac beside the .pvd files, which it finds wherever the folder is moved to. Layers whose .pvd is
# missing are left out. The choices below are meant to be changed.

import argparse
import os
import sys

from paraview.simple import *

GRAIN_COLOR = "von_mises"  # von_mises, pressure, stress:YY, cluster, material, damage, velocity, displacement
GRAIN_OPACITY = 1.0        # below 1: cracks inside show through
CRACK_COLORS = {           # of the field cause
    "tension": (0.84, 0.10, 0.11),
    "shear": (0.13, 0.40, 0.85),
    "mixed": (0.60, 0.25, 0.70),
}
CRACK_EDGE_WIDTH = 4.0     # pixels


def arguments():
    parser = argparse.ArgumentParser(description="Show or draw a grainfrac result folder.", allow_abbrev=False)
    parser.add_argument("--save", metavar="PICTURE", help="draw into this file (.png) and leave")
    parser.add_argument("--time", default="last", help="last, first, or a time in seconds (the nearest frame is taken)")
    parser.add_argument("--color", default=GRAIN_COLOR, help="field of the grains; stress:XX for a component")
    parser.add_argument("--size", default="1600x1200", help="of the picture, in pixels")
    return parser.parse_known_args(getattr(sys, "argv", [""])[1:])[0]  # ParaView's own arguments are none of ours


def open_layer(name):
    """The time series NAME.pvd beside this script, or None."""
    path = os.path.join(os.path.dirname(os.path.abspath(__file__)), name + ".pvd")
    if not os.path.exists(path):
        return None
    reader = PVDReader(registrationName=name, FileName=path)
    reader.UpdatePipeline()
    return reader


def has_cells(reader):
    return reader is not None and reader.GetDataInformation().GetNumberOfCells() > 0


def color_by(display, field, view):
    name, _, component = field.partition(":")
    ColorBy(display, ("CELLS", name, component) if component else ("CELLS", name))
    display.RescaleTransferFunctionToDataRange(False, True)
    display.SetScalarBarVisibility(view, True)


def show_grains(grains, view, field):
    display = Show(grains, view)
    display.SetRepresentationType("Surface With Edges")
    display.EdgeColor = [0.25, 0.25, 0.25]
    display.LineWidth = 0.5
    display.Opacity = GRAIN_OPACITY
    names = [grains.CellData.GetArray(i).GetName() for i in range(grains.CellData.GetNumberOfArrays())]
    if field.partition(":")[0] in names:
        color_by(display, field, view)
    elif names:
        print("view.py: the grains have no field '%s'; there are: %s" % (field, ", ".join(names)))
    return display


def color_cracks(display, view):
    ColorBy(display, ("CELLS", "cause"), separate=True)
    colors = GetColorTransferFunction("cause", display, separate=True)
    colors.InterpretValuesAsCategories = 1
    colors.AnnotationsInitialized = 1
    annotations, indexed = [], []
    for value, (name, rgb) in enumerate(CRACK_COLORS.items()):
        annotations += [str(value), name]
        indexed += list(rgb)
    colors.Annotations = annotations
    colors.IndexedColors = indexed
    colors.IndexedOpacities = [1.0] * len(CRACK_COLORS)


def show_cracks(cracks, view):
    """Faces, and their outlines as thick lines: of a closed crack these are all one sees from outside."""
    surface = Show(cracks, view)
    surface.SetRepresentationType("Surface")
    color_cracks(surface, view)
    edges = ExtractEdges(registrationName="crack edges", Input=cracks)
    lines = Show(edges, view)
    lines.LineWidth = CRACK_EDGE_WIDTH
    color_cracks(lines, view)
    lines.SetScalarBarVisibility(view, True)


def show_walls(walls, view):
    display = Show(walls, view)
    display.SetRepresentationType("Surface")
    display.ColorArrayName = ["POINTS", ""]  # ColorBy(display, None) fails in ParaView 5.11
    display.AmbientColor = display.DiffuseColor = [0.6, 0.6, 0.6]
    display.Opacity = 0.3


def show_hidden(layer, view, field, representation, association="CELLS"):
    display = Show(layer, view)
    display.SetRepresentationType(representation)
    ColorBy(display, (association, field))
    display.SetScalarBarVisibility(view, False)
    Hide(layer, view)


def go_to(time):
    scene = GetAnimationScene()
    scene.UpdateAnimationUsingDataTimeSteps()
    steps = list(GetTimeKeeper().TimestepValues or [])
    if time == "first":
        scene.GoToFirst()
    elif time == "last" or not steps:
        scene.GoToLast()
    else:
        scene.AnimationTime = min(steps, key=lambda t: abs(t - float(time)))


def place_camera(view, layer):
    """Along -z, the layer filling the height."""
    view.CameraParallelProjection = 1
    view.CameraViewUp = [0.0, 1.0, 0.0]
    bounds = layer.GetDataInformation().GetBounds() if has_cells(layer) else None
    if bounds is None or bounds[0] > bounds[1]:
        ResetCamera(view)
        return
    center = [0.5 * (bounds[2 * k] + bounds[2 * k + 1]) for k in range(3)]
    extent = max(bounds[2 * k + 1] - bounds[2 * k] for k in range(3))
    view.CameraFocalPoint = center
    view.CameraPosition = [center[0], center[1], center[2] + 5.0 * extent]
    view.CameraParallelScale = 0.6 * max(bounds[3] - bounds[2], 0.75 * (bounds[1] - bounds[0]))
    view.CenterOfRotation = center


def main():
    options = arguments()
    width, _, height = options.size.partition("x")
    view = GetActiveViewOrCreate("RenderView")
    view.OrientationAxesVisibility = 1
    if options.save:
        view.ViewSize = [int(width), int(height)]  # or the text is scaled up with the picture
    try:
        LoadPalette("WhiteBackground")
    except Exception:  # another version has other palettes; the picture is the same but for its background
        pass
    layers = {name: open_layer(name) for name in ("grains", "bonds", "contacts", "cracks", "walls")}
    if all(layer is None for layer in layers.values()):
        print("view.py: no .pvd file beside this script")
        return
    go_to(options.time)
    for layer in layers.values():
        if layer is not None:
            layer.UpdatePipeline(GetAnimationScene().AnimationTime)
    # A layer without cells at this time has no fields to be coloured by; it is shown all the same, plainly.
    if layers["grains"] is not None:
        show_grains(layers["grains"], view, options.color)
    if layers["cracks"] is not None:
        show_cracks(layers["cracks"], view)
    if layers["walls"] is not None:
        show_walls(layers["walls"], view)
    if layers["bonds"] is not None:
        show_hidden(layers["bonds"], view, "damage", "Surface")
    if layers["contacts"] is not None:
        show_hidden(layers["contacts"], view, "normal_force", "Points", "POINTS")
    place_camera(view, layers["grains"])
    if layers["grains"] is not None:
        SetActiveSource(layers["grains"])
    if options.save:
        SaveScreenshot(options.save, view, ImageResolution=[int(width), int(height)])
    else:
        Render(view)


main()
)py";
}

}  // namespace grainfrac
