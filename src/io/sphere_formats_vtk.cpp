// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/sphere_formats.h"

#include <fmt/format.h>
#include <vtkDataArray.h>
#include <vtkGenericDataObjectReader.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPointSet.h>
#include <vtkSmartPointer.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <stdexcept>

namespace grainfrac {

namespace {

template <class Reader>
vtkSmartPointer<vtkPointSet> read(const std::filesystem::path& file)
{
    // What VTK would print is said below in one line.
    const int display = vtkObject::GetGlobalWarningDisplay();
    vtkObject::GlobalWarningDisplayOff();
    vtkNew<Reader> reader;
    reader->SetFileName(file.c_str());
    reader->Update();
    vtkObject::SetGlobalWarningDisplay(display);
    return vtkPointSet::SafeDownCast(reader->GetOutputDataObject(0));
}

}  // namespace

std::vector<Ball> read_spheres_vtk(const std::filesystem::path& file)
{
    const std::string extension = file.extension().string();
    const vtkSmartPointer<vtkPointSet> points = extension == ".vtu"   ? read<vtkXMLUnstructuredGridReader>(file)
                                                : extension == ".vtp" ? read<vtkXMLPolyDataReader>(file)
                                                                      : read<vtkGenericDataObjectReader>(file);
    vtkDataArray* radius = points ? points->GetPointData()->GetArray("radius") : nullptr;
    if (radius == nullptr || radius->GetNumberOfComponents() != 1 ||
        radius->GetNumberOfTuples() != points->GetNumberOfPoints()) {
        throw std::runtime_error(
            fmt::format("\"{}\": VTK finds no points with an array \"radius\" in it", file.string()));
    }
    std::vector<Ball> balls;
    for (vtkIdType i = 0; i < points->GetNumberOfPoints(); ++i) {
        double x[3];
        points->GetPoint(i, x);
        balls.push_back({{x[0], x[1], x[2]}, radius->GetTuple1(i)});
    }
    return balls;
}

}  // namespace grainfrac
