// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/view_script.h"

namespace grainfrac {

std::string view_script(bool fibre)
{
    return std::string(R"py(# Opens this result folder in ParaView (5.9 or newer):
#
#   paraview --script=view.py
#   pvpython view.py --save picture.png [--view cleavage] [--time last|first|SECONDS] [--color FIELD] [--size 1600x1200]
#                    [--from x|-y|z] [--whole]
#
# Three views, in ParaView a tab each above the picture, of which the first is in front; --view takes one of them alone:
#   stress     grains coloured by GRAIN_COLOR or --color
#   clusters   grains coloured by what bonds still hold together
#   cleavage   grains coloured by the load over the load that splits them (K/K_c)
# In each, "cracks between grains" (coloured by what broke them) and "cracks through grains" are layers of their own, as
# are walls, bonds and contacts: the eyes beside their names in the Pipeline Browser turn them on and off. Spheres are
# points drawn as balls of their radius, coloured as grains are; bonds between spheres are lines. A fibre in its matrix is
# shown cut open, unless --whole. The picture is seen from z, or from the side where that is less than half as deep.
#
# Written by grainfrac beside the .pvd files, which it finds wherever the folder is moved to. Layers whose .pvd is
# missing are left out. The choices below are meant to be changed.

import argparse
import os
import sys

from paraview.simple import *

GRAIN_COLOR = "von_mises"  # von_mises, pressure, stress:YY, generation, material, damage, velocity, displacement
GRAIN_OPACITY = 1.0        # below 1: cracks inside show through
CRACK_COLORS = {           # between grains, of the field cause
    "tension": (0.84, 0.10, 0.11),
    "shear": (0.13, 0.40, 0.85),
    "mixed": (0.60, 0.25, 0.70),
}
THROUGH_GRAINS = (0.0, 0.62, 0.45)
CLUSTER_COLORS = [         # the largest first
    (0.80, 0.82, 0.85), (0.34, 0.71, 0.91), (0.90, 0.62, 0.00), (0.94, 0.89, 0.26), (0.80, 0.47, 0.65),
    (0.00, 0.45, 0.70), (0.60, 0.45, 0.30), (0.72, 0.85, 0.55), (0.98, 0.75, 0.70),
]
SMALL_CLUSTERS = (0.45, 0.45, 0.45)  # all others
CRACK_EDGE_WIDTH = 4.0     # pixels
LOW_TO_HIGH = [(1.0, 1.0, 1.0), (0.35, 0.38, 0.42)]  # lowest to highest value; cracks stand out
SPHERES_LOW_TO_HIGH = [(0.95, 0.95, 0.80), (0.35, 0.70, 0.70), (0.10, 0.25, 0.50)]  # their own shading takes some contrast
NEGATIVE_TO_POSITIVE = [(0.20, 0.42, 0.70), (1.0, 1.0, 1.0), (0.90, 0.55, 0.10)]  # of one with signs
CLEAVAGE_COLORS = [(1.0, 1.0, 1.0), (1.0, 0.85, 0.50), (0.55, 0.25, 0.02)]  # from 0 to 1
VIEWS = ("stress", "clusters", "cleavage")
SIDES = {"z": (2, 1.0, 0, 1), "-y": (1, -1.0, 0, 2), "x": (0, 1.0, 1, 2)}  # axis and sign to the eye, across, up
SEEN_FROM_THE_SIDE = 2.0   # what is higher than this, over its depth
WITH_FIBRE = 0.5           # the same of a matrix with a fibre in it
HAS_FIBRE = )py") +
           (fibre ? "True" : "False") +
           R"py(
TITLES = {                 # of the colour legends
    "von_mises": "von Mises stress [Pa]", "pressure": "mean stress [Pa]", "stress": "stress%s [Pa]",
    "velocity": "velocity%s [m/s]", "displacement": "displacement%s [m]", "damage": "damage of its bonds",
    "cleavage": "cleavage: K/K_c",
}


def arguments():
    parser = argparse.ArgumentParser(description="Show or draw a grainfrac result folder.", allow_abbrev=False)
    parser.add_argument("--save", metavar="PICTURE", help="draw one view into this file (.png) and leave")
    parser.add_argument("--view", choices=VIEWS, help="this view alone (default: all; with --save: stress)")
    parser.add_argument("--time", default="last", help="last, first, or a time in seconds (the nearest frame is taken)")
    parser.add_argument("--color", default=GRAIN_COLOR, help="field of the grains in view stress; or stress:XX")
    parser.add_argument("--size", default="1600x1200", help="of the picture, in pixels")
    parser.add_argument("--from", dest="side", choices=list(SIDES), help="where the eye is (default: z, or a narrow side)")
    parser.add_argument("--whole", action="store_true", help="do not cut a matrix open that has a fibre in it")
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


def attributes(layer, association):
    return layer.CellData if association == "CELLS" else layer.PointData


def only_mode(cracks, name, mode):
    """The cracks whose field mode has this value."""
    layer = Threshold(registrationName=name, Input=cracks)
    layer.Scalars = ["CELLS", "mode"]
    if "LowerThreshold" in layer.ListProperties():
        layer.LowerThreshold, layer.UpperThreshold = mode - 0.5, mode + 0.5
    else:  # before ParaView 5.10
        layer.ThresholdRange = [mode - 0.5, mode + 0.5]
    return layer


def legend(display, field, view, title, where, height, in_categories=True):
    """The colour legend of a display: where its lower left corner is, and how high it is, in parts of the view."""
    bar = GetScalarBar(GetColorTransferFunction(field, display, separate=display.UseSeparateColorMap == 1), view)
    bar.Title, bar.ComponentTitle, bar.HorizontalTitle = title, "", 1
    bar.WindowLocation, bar.Position, bar.ScalarBarLength = "Any Location", where, height
    bar.Orientation = "Vertical"
    bar.TitleJustification = "Left"
    bar.TitleFontSize = bar.LabelFontSize = 16
    bar.TitleColor = bar.LabelColor = [0.0, 0.0, 0.0]
    bar.RangeLabelFormat = "%.3g"
    ticks, names = ("left/bottom", "right/top") if in_categories else ("right/top", "left/bottom")
    bar.TextPosition = "Ticks %s, annotations %s" % (ticks, names)
    display.SetScalarBarVisibility(view, True)
    return bar


def color_by_categories(display, field, categories, association="CELLS"):
    """`categories`: value, name and colour of each."""
    ColorBy(display, (association, field), separate=True)
    table = GetColorTransferFunction(field, display, separate=True)
    table.InterpretValuesAsCategories = 1
    table.AnnotationsInitialized = 1
    table.Annotations = [text for value, name, _ in categories for text in (str(value), name)]
    table.IndexedColors = [part for _, _, color in categories for part in color]
    table.IndexedOpacities = [1.0] * len(categories)
    return table


def color_by_cluster(display, layer, view, association, with_legend):
    count = int(attributes(layer, association)["cluster"].GetRange()[1]) + 1
    categories = [(k, "0, the largest" if k == 0 else "%d" % k, color) for k, color in enumerate(CLUSTER_COLORS)]
    color_by_categories(display, "cluster", categories[:max(1, count)], association).NanColor = SMALL_CLUSTERS
    if not with_legend:
        display.SetScalarBarVisibility(view, False)
        return
    title = "clusters: %d" % count + ("\n(smaller ones dark)" if count > len(categories) else "")
    legend(display, "cluster", view, title, [0.80, 0.06], min(0.38, 0.06 * max(1, count)))


def usual_range(layer, name, component, association):
    """All but the lowest and the highest 2 % of a field's values: a few crushed grains would take the whole scale."""
    fetched = servermanager.Fetch(layer)
    data = (fetched.GetCellData() if association == "CELLS" else fetched.GetPointData()).GetArray(name)
    index = next((c for c in range(data.GetNumberOfComponents()) if data.GetComponentName(c) == component), None)
    values = []
    for cell in range(data.GetNumberOfTuples()):
        entries = data.GetTuple(cell)
        values.append(entries[index] if index is not None else entries[0] if len(entries) == 1
                      else sum(x * x for x in entries) ** 0.5)
    values.sort()
    low, high = values[int(0.02 * (len(values) - 1))], values[int(0.98 * (len(values) - 1) + 0.5)]
    return (low, high) if high > low else (low, low + max(1.0, abs(low)))


def color_by_field(display, layer, field, view, association, with_legend):
    name, _, component = field.partition(":")
    ColorBy(display, (association, name, component) if component else (association, name))
    if not with_legend:  # the grains' colours, and their legend
        return
    table = GetColorTransferFunction(name)
    if name == "cleavage":
        low, high, colors = 0.0, 1.0, CLEAVAGE_COLORS
    else:
        low, high = usual_range(layer, name, component, association)
        colors = LOW_TO_HIGH if association == "CELLS" else SPHERES_LOW_TO_HIGH
        if low < 0.0:
            colors, high = NEGATIVE_TO_POSITIVE, max(-low, high)
            low = -high
    table.RGBPoints = [part for k, color in enumerate(colors)
                       for part in (low + (high - low) * k / (len(colors) - 1),) + tuple(color)]
    table.ColorSpace = "RGB"
    title = TITLES.get(name, name).replace("%s", " " + component if component else "")
    legend(display, name, view, title, [0.80, 0.06], 0.38, in_categories=False)


def color_by(display, layer, field, view, association="CELLS", with_legend=True):
    data = attributes(layer, association)
    names = [data.GetArray(i).GetName() for i in range(data.GetNumberOfArrays())]
    if field.partition(":")[0] not in names:
        if names:
            print("view.py: there is no field '%s'; there are: %s" % (field, ", ".join(names)))
    elif field == "cluster":
        color_by_cluster(display, layer, view, association, with_legend)
    else:
        color_by_field(display, layer, field, view, association, with_legend)


def show_grains(grains, view, field):
    display = Show(grains, view)
    display.SetRepresentationType("Surface With Edges")
    display.EdgeColor = [0.25, 0.25, 0.25]
    display.LineWidth = 0.5
    display.Opacity = GRAIN_OPACITY
    display.Ambient, display.Diffuse = 0.5, 0.6  # a face seen from the front has the colour of the legend
    if has_cells(grains):
        color_by(display, grains, field, view)


def show_spheres(spheres, view, field, with_legend):
    """Points drawn as balls: a million of them turn smoothly, which glyphs do not."""
    display = Show(spheres, view)
    display.SetRepresentationType("Point Gaussian")
    display.ShaderPreset = "Sphere"
    display.ScaleByArray = 1
    display.SetScaleArray = ["POINTS", "radius"]
    display.UseScaleFunction = 0
    display.GaussianRadius = 1.0
    display.Opacity = GRAIN_OPACITY
    if has_cells(spheres) and field != "cleavage":
        color_by(display, spheres, field, view, "POINTS", with_legend)


def show_cracks(layers, view, field, categories, title, where, height):
    """Faces, and their outlines as thick lines: of a closed crack these are all one sees from outside."""
    for layer in layers:
        display = Show(layer, view)
        display.SetRepresentationType("Surface")
        display.LineWidth = CRACK_EDGE_WIDTH
        if layer.CellData.GetArray(field) is None:  # none broke so yet
            continue
        color_by_categories(display, field, categories)
    if layers[-1].CellData.GetArray(field) is not None:
        legend(display, field, view, title, where, height)


def show_walls(walls, view):
    display = Show(walls, view)
    display.SetRepresentationType("Surface")
    display.Interpolation = "Flat"  # the ends of rollers are flat
    display.ColorArrayName = ["POINTS", ""]  # ColorBy(display, None) fails in ParaView 5.11
    display.AmbientColor = display.DiffuseColor = [0.6, 0.6, 0.6]
    display.Opacity = 0.3


def show_hidden(layer, view, field, representation, association="CELLS"):
    display = Show(layer, view)
    display.SetRepresentationType(representation)
    ColorBy(display, (association, field))
    display.SetScalarBarVisibility(view, False)
    Hide(layer, view)


def go_to(time, layers):
    """To the frame that is meant; returns its time."""
    scene = GetAnimationScene()
    scene.UpdateAnimationUsingDataTimeSteps()
    steps = sorted({t for layer in layers.values() if layer is not None for t in layer.TimestepValues})
    if not steps:
        return 0.0
    if time in ("first", "last"):
        scene.AnimationTime = steps[0 if time == "first" else -1]
    else:
        scene.AnimationTime = min(steps, key=lambda t: abs(t - float(time)))
    return scene.AnimationTime


def bounds_of(layers):
    """Of the grains and spheres together; of spheres one has the centres."""
    boxes = []
    for layer in layers:
        radius = layer.PointData["radius"]
        margin = radius.GetRange()[1] if radius is not None else 0.0
        boxes.append([x + (margin if k % 2 else -margin) for k, x in enumerate(layer.GetDataInformation().GetBounds())])
    return [(max if k % 2 else min)(box[k] for box in boxes) for k in range(6)]


def side_to_look_from(shown, least_height):
    bounds = [layer.GetDataInformation().GetBounds() for layer in shown]  # of centres: a beam that sags has a height
    extent = [max(b[2 * k + 1] for b in bounds) - min(b[2 * k] for b in bounds) for k in range(3)]
    narrow = "-y" if extent[1] <= extent[0] else "x"
    return narrow if extent[2] > least_height * extent[SIDES[narrow][0]] else "z"


def cut_open(layers, shown, side, time):
    """The half of a matrix that is nearer to the eye is left out, the fibre in the middle is not."""
    axis, sign, _, _ = SIDES[side]
    bounds = bounds_of(shown)
    normal = [sign if k == axis else 0.0 for k in range(3)]
    middle = [0.5 * (bounds[2 * k] + bounds[2 * k + 1]) for k in range(3)]
    for name in ("grains", "spheres", "cracks"):
        if not has_cells(layers[name]):
            continue
        half = Clip(registrationName=name + ", cut open", Input=layers[name])
        half.ClipType = "Plane"
        half.ClipType.Normal = normal
        half.ClipType.Origin = middle
        half.Crinkleclip = 1 if name == "grains" else 0
        if name == "spheres":
            half.ClipType.Offset = layers[name].PointData["radius"].GetRange()[1]  # a lattice may lie a little aside
        half.Invert = 1
        half.UpdatePipeline(time)
        Hide(layers[name])
        layers[name] = half


def place_camera(view, shown, side):
    """The layers fill the height, left of the legends."""
    axis, sign, across, up = SIDES[side]
    view.CameraParallelProjection = 1
    view.CameraViewUp = [1.0 if k == up else 0.0 for k in range(3)]
    if not shown:
        ResetCamera(view)
        return
    bounds = bounds_of(shown)
    center = [0.5 * (bounds[2 * k] + bounds[2 * k + 1]) for k in range(3)]
    extent = [bounds[2 * k + 1] - bounds[2 * k] for k in range(3)]
    width, height = view.ViewSize
    # Half of the view's height; the legends take the right quarter.
    scale = 0.55 * max(extent[up], extent[across] * height / (0.74 * width))
    center[across] += 0.11 * 2.0 * scale * width / height
    view.CameraFocalPoint = center
    view.CameraPosition = [x + (sign * 5.0 * max(extent) if k == axis else 0.0) for k, x in enumerate(center)]
    view.CameraParallelScale = scale
    view.CenterOfRotation = center


def open_layers():
    return {name: open_layer(name) for name in ("grains", "spheres", "bonds", "contacts", "cracks", "walls")}


def split_cracks(layers):
    cracks = layers["cracks"]
    for name, mode in (("cracks between grains", 0), ("cracks through grains", 1)):
        if cracks is None:
            layers[name] = None
            continue
        faces = only_mode(cracks, name, mode)
        layers[name] = (faces, ExtractEdges(registrationName=name + ", outlines", Input=faces))


def update(layers, time):
    for layer in layers.values():
        for source in layer if isinstance(layer, tuple) else (layer,):
            if source is not None:
                source.UpdatePipeline(time)


def bodies_of(layers):
    return [layer for layer in (layers["grains"], layers["spheres"]) if has_cells(layer)]


def fill_view(view, layers, field, side):
    # A layer without cells at this time has no fields to be coloured by; it is shown all the same, plainly.
    if layers["grains"] is not None:
        show_grains(layers["grains"], view, field)
    if layers["spheres"] is not None:
        show_spheres(layers["spheres"], view, field, not has_cells(layers["grains"]))
    if layers["cracks"] is not None:
        causes = [(value, name, color) for value, (name, color) in enumerate(CRACK_COLORS.items())]
        show_cracks(layers["cracks between grains"], view, "cause", causes, "cracks between grains", [0.80, 0.74], 0.17)
        show_cracks(layers["cracks through grains"], view, "mode", [(1, "broken", THROUGH_GRAINS)],
                    "cracks through grains", [0.80, 0.56], 0.08)
        Hide(layers["cracks"], view)
    if layers["walls"] is not None:
        show_walls(layers["walls"], view)
    if layers["bonds"] is not None:
        show_hidden(layers["bonds"], view, "damage", "Surface")
    if layers["contacts"] is not None:
        show_hidden(layers["contacts"], view, "normal_force", "Points", "POINTS")
    place_camera(view, bodies_of(layers), side)


def new_view(name, first):
    """A view in a tab of its own."""
    if first:
        view = GetActiveViewOrCreate("RenderView")
        RenameLayout(name, GetLayout(view))
    else:
        layout = CreateLayout(name)
        view = CreateView("RenderView")
        AssignViewToLayout(view=view, layout=layout)
    view.OrientationAxesVisibility = 1
    return view


def main():
    options = arguments()
    width, _, height = options.size.partition("x")
    try:
        LoadPalette("WhiteBackground")
    except Exception:  # another version has other palettes; the picture is the same but for its background
        pass
    layers = open_layers()
    if all(layer is None for layer in layers.values()):
        print("view.py: no .pvd file beside this script")
        return
    fields = {"stress": options.color, "clusters": "cluster", "cleavage": "cleavage"}
    names = [options.view] if options.view else [VIEWS[0]] if options.save else VIEWS
    views = []
    for name in names:
        view = new_view(name, not views)
        if options.save:
            view.ViewSize = [int(width), int(height)]  # or the text is scaled up with the picture
        if not views:
            time = go_to(options.time, layers)
            update(layers, time)
            shown = bodies_of(layers)
            fibre = HAS_FIBRE and has_cells(layers["spheres"])
            side = options.side or (side_to_look_from(shown, WITH_FIBRE if fibre else SEEN_FROM_THE_SIDE) if shown else "z")
            if fibre and not options.whole:
                cut_open(layers, shown, side, time)
            split_cracks(layers)
            update(layers, time)
        fill_view(view, layers, fields[name], side)
        views.append(view)
    SetActiveView(views[0])
    front = layers["grains"] if has_cells(layers["grains"]) else layers["spheres"]
    if front is not None:
        SetActiveSource(front)
    if options.save:
        SaveScreenshot(options.save, views[0], ImageResolution=[int(width), int(height)])
    else:
        for view in views:
            Render(view)


main()
)py";
}

}  // namespace grainfrac
