// SPDX-License-Identifier: GPL-3.0-or-later
// The ParaView layers, read back with VTK's own readers.
#ifdef GF_HAVE_VTK
#include "cleaving_run.h"
#include "io/atomic_file.h"
#include "io/bond_faces.h"
#include "io/paraview.h"
#include "io/shape_surface.h"
#include "sample.h"

#include <catch2/catch.hpp>
#include <vtkCell.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <map>

using namespace grainfrac;

namespace {

template <class Reader, class Data>
vtkSmartPointer<Data> read_xml(const std::filesystem::path& path)
{
    vtkNew<Reader> reader;
    REQUIRE(reader->CanReadFile(path.c_str()) != 0);
    reader->SetFileName(path.c_str());
    reader->Update();
    REQUIRE(reader->GetErrorCode() == 0);
    return reader->GetOutput();
}
const auto read_grid = read_xml<vtkXMLUnstructuredGridReader, vtkUnstructuredGrid>;
const auto read_surface = read_xml<vtkXMLPolyDataReader, vtkPolyData>;

double value(vtkFieldData* data, const char* name, vtkIdType tuple, int component = 0)
{
    vtkDataArray* array = data->GetArray(name);
    INFO(name);
    REQUIRE(array != nullptr);
    return array->GetComponent(tuple, component);
}
Vec3 vector(vtkFieldData* data, const char* name, vtkIdType tuple)
{
    return {value(data, name, tuple, 0), value(data, name, tuple, 1), value(data, name, tuple, 2)};
}

std::vector<Vec3> points_of(vtkCell* cell)
{
    std::vector<Vec3> points;
    for (vtkIdType k = 0; k < cell->GetNumberOfPoints(); ++k) {
        double p[3];
        cell->GetPoints()->GetPoint(k, p);
        points.push_back({p[0], p[1], p[2]});
    }
    return points;
}

/// By the divergence theorem over the faces that VTK sees: right only if they are closed and look outward.
double cell_volume(vtkCell* cell)
{
    double volume = 0.0;
    for (int f = 0; f < cell->GetNumberOfFaces(); ++f) {
        const std::vector<Vec3> face = points_of(cell->GetFace(f));
        volume += dot(area_vector(face), face.front()) / 3.0;
    }
    return volume;
}

}  // namespace

TEST_CASE("grains are polyhedra with their fields", "[output][paraview]")
{
    const sample::World w = sample::make_world();
    const sample::TemporaryFolder folder;
    write_grains(folder / "grains.vtu", w.model, w.state, w.fields);
    const auto grid = read_grid(folder / "grains.vtu");
    REQUIRE(grid->GetNumberOfCells() == 3);
    vtkFieldData* data = grid->GetCellData();
    for (vtkIdType i = 0; i < 3; ++i) {
        CHECK(grid->GetCellType(i) == VTK_POLYHEDRON);
        CHECK(cell_volume(grid->GetCell(i)) == Approx(sample::prism_volume).epsilon(1e-12));
        CHECK(value(data, "grain_id", i) == w.state.bodies.id[static_cast<int>(i)]);
        CHECK(value(data, "material", i) == 0.0);
        CHECK(vector(data, "velocity", i) == w.state.bodies.velocity[static_cast<int>(i)]);
        CHECK(vector(data, "angular_velocity", i) == w.state.bodies.angular_velocity[static_cast<int>(i)]);
    }
    CHECK(value(data, "cluster", 0) == 1.0);
    CHECK(value(data, "displacement", 0, 0) == Approx(-sample::crack_opening).epsilon(1e-9));
    CHECK(norm(vector(data, "rotation", 1)) < 1e-15);
    CHECK(value(data, "damage", 0) == 1.0);
    CHECK(value(data, "damage", 1) == Approx(0.625).epsilon(1e-12));
    CHECK(value(data, "damage", 2) == 0.25);
    const Quat crystal = w.state.bodies.orientation[1] * w.state.bodies.crystal[1];
    CHECK(value(data, "crystal_orientation", 1, 0) == crystal.w);
    CHECK(value(data, "crystal_orientation", 1, 3) == crystal.z);
    CHECK(value(grid->GetFieldData(), "TimeValue", 0) == w.state.time);
}

TEST_CASE("the stress of a grain and what is derived from it", "[output][paraview]")
{
    const sample::World w = sample::make_world();
    const sample::TemporaryFolder folder;
    write_grains(folder / "grains.vtu", w.model, w.state, w.fields);
    const auto grid = read_grid(folder / "grains.vtu");
    vtkFieldData* data = grid->GetCellData();
    const double expected[] = {10e6, -30e6, 5e6, 2e6, 1e6, 0.0};
    for (int c = 0; c < 6; ++c) CHECK(value(data, "stress", 0, c) == expected[c]);
    CHECK(std::string(data->GetArray("stress")->GetComponentName(4)) == "YZ");
    CHECK(value(data, "pressure", 0) == Approx(-5e6));
    const Vec3 s = vector(data, "principal_stress", 0), n = vector(data, "principal_direction_1", 0);
    CHECK(s.x >= s.y);
    CHECK(s.y >= s.z);
    CHECK(s.x + s.y + s.z == Approx(-15e6).epsilon(1e-12));
    const double mises =
        std::sqrt(0.5 * ((s.x - s.y) * (s.x - s.y) + (s.y - s.z) * (s.y - s.z) + (s.z - s.x) * (s.z - s.x)));
    CHECK(value(data, "von_mises", 0) == Approx(mises).epsilon(1e-12));
    // The direction is an eigenvector: 1e-6 of the stress, far above what single precision would lose.
    CHECK(norm(w.fields.stress[0] * n - s.x * n) < 10.0);
    CHECK(norm(n) == Approx(1.0));
}

TEST_CASE("bonds, cracks and contacts", "[output][paraview]")
{
    sample::World w = sample::make_world();
    sample::add_parallel_bond(w.state);
    w.state.slots = {};
    w.state.slots.resize(4);
    w.state.slots.force.host()[1] = -1e6 * w.state.interfaces.area[1] * bond_face(w.state, 1).normal;
    w.state.slots.force.host()[3] = {0, -25, 0};
    const sample::TemporaryFolder folder;
    const double face_area = sample::side * sample::thickness;

    write_bonds(folder / "bonds.vtp", w.state);
    const auto bonds = read_surface(folder / "bonds.vtp");
    REQUIRE(bonds->GetNumberOfCells() == 3);
    vtkFieldData* data = bonds->GetCellData();
    CHECK(bonds->GetCell(0)->GetNumberOfPoints() == 4);
    CHECK(bonds->GetCell(2)->GetNumberOfPoints() == 16);
    CHECK(norm(area_vector(points_of(bonds->GetCell(0)))) == Approx(face_area).epsilon(1e-12));
    const double states[] = {2, 1, 2}, causes[] = {0, -1, 1}, kinds[] = {0, 0, 1};
    for (int i = 0; i < 3; ++i) {
        CHECK(value(data, "state", i) == states[i]);
        CHECK(value(data, "cause", i) == causes[i]);
        CHECK(value(data, "kind", i) == kinds[i]);
    }
    CHECK(value(data, "opening", 0) == Approx(sample::crack_opening).epsilon(1e-9));
    CHECK(value(data, "opening", 1) == Approx(0.0).margin(1e-15));
    CHECK(value(data, "normal_stress", 1) == Approx(1e6).epsilon(1e-12));
    CHECK(value(data, "shear_stress", 1) == Approx(0.0).margin(1e-6));
    CHECK(value(data, "stored_energy", 1) == 3e-4);
    CHECK(value(data, "area", 1) == Approx(face_area).epsilon(1e-12));
    CHECK(value(data, "normal", 0, 0) == Approx(1.0).epsilon(1e-12));

    const std::vector<CrackFace> cracks = collect_cracks(w.model, w.state);
    write_cracks(folder / "cracks.vtp", w.state, cracks);
    const auto faces = read_surface(folder / "cracks.vtp");
    REQUIRE(faces->GetNumberOfCells() == 2);
    data = faces->GetCellData();
    for (const char* name : {"mode", "cause", "time", "first_damage_time", "area", "normal", "opening", "K_I", "K_II",
                             "grain_a", "grain_b"})
        CHECK(data->GetArray(name) != nullptr);
    CHECK(value(data, "time", 0) == 2e-6);
    CHECK(value(data, "time", 1) == 2.5e-6);
    CHECK(value(data, "grain_a", 0) == 2.0);
    CHECK(value(data, "grain_b", 0) == 0.0);
    CHECK(value(data, "cause", 1) == 1.0);

    write_contacts(folder / "contacts.vtp", w.state);
    const auto contacts = read_surface(folder / "contacts.vtp");
    REQUIRE(contacts->GetNumberOfVerts() == 1);
    data = contacts->GetPointData();
    CHECK(vector(data, "force", 0) == Vec3{0, -25, 0});
    CHECK(vector(data, "normal", 0) == Vec3{0, -1, 0});
    CHECK(value(data, "penetration", 0) == 1e-7);
    CHECK(value(data, "body_a", 0) == 2.0);
    CHECK(value(data, "body_b", 0) == 3.0);
}

TEST_CASE("spheres are points with their fields, held ones among them", "[output][paraview]")
{
    sample::World w = sample::make_spheres();
    w.fields.stress[0] = {{{10e6, 2e6, 0}, {2e6, -30e6, 1e6}, {0, 1e6, 5e6}}};
    w.state.bodies.velocity.host()[1] = {1, 2, 3};
    w.state.bodies.angular_velocity.host()[2] = {4, 5, 6};
    const sample::TemporaryFolder folder;
    write_spheres(folder / "spheres.vtp", w.model, w.state, w.fields);
    const auto cloud = read_surface(folder / "spheres.vtp");
    REQUIRE(cloud->GetNumberOfVerts() == 3);
    vtkFieldData* data = cloud->GetPointData();
    for (int i = 0; i < 3; ++i) {
        double p[3];
        cloud->GetPoint(i, p);
        CHECK(Vec3{p[0], p[1], p[2]} == w.state.bodies.position[i]);
        CHECK(value(data, "sphere_id", i) == i);
        CHECK(value(data, "radius", i) == sample::sphere_radius);
        CHECK(value(data, "held", i) == (i == 2 ? 1.0 : 0.0));
        CHECK(value(data, "cluster", i) == w.fields.cluster[static_cast<std::size_t>(i)]);
        CHECK(value(data, "part", i) == 0.0);
        CHECK(value(data, "material", i) == 0.0);
    }
    CHECK(value(data, "displacement", 0, 0) == -sample::sphere_gap);
    CHECK(value(data, "rotation", 0, 0) == Approx(0.01).epsilon(1e-12));
    CHECK(vector(data, "velocity", 1) == Vec3{1, 2, 3});
    CHECK(vector(data, "angular_velocity", 2) == Vec3{4, 5, 6});
    CHECK(value(data, "pressure", 0) == Approx(-5e6));
    CHECK(value(data, "stress", 0, 4) == 1e6);
    CHECK(value(data, "von_mises", 0) > 0.0);
    const double damage[] = {0.0, 0.5, 1.0};  // of two equal bonds of the middle sphere one is broken
    for (int i = 0; i < 3; ++i) CHECK(value(data, "damage", i) == Approx(damage[i]).margin(1e-15));
    CHECK(value(cloud->GetFieldData(), "TimeValue", 0) == w.state.time);

    write_walls(folder / "walls.vtp", w.model, w.state);
    CHECK(read_surface(folder / "walls.vtp")->GetNumberOfCells() == 0);
    write_grains(folder / "grains.vtu", w.model, w.state, w.fields);
    CHECK(read_grid(folder / "grains.vtu")->GetNumberOfCells() == 0);
}

TEST_CASE("bonds of spheres are lines with forces and moments", "[output][paraview]")
{
    sample::World w = sample::make_spheres();
    // Pull, shear and moments of known size on sphere 1 from sphere 0, about the contact point.
    const Vec3 force{-100.0, 30.0, 40.0}, moment{5.0, 0.0, -12.0}, arm{0.5 * (1.0 + sample::sphere_gap), 0, 0};
    w.state.slots.resize(2);
    w.state.slots.force.host()[0] = force;
    w.state.slots.torque_b.host()[0] = moment - cross(arm, force);
    const sample::TemporaryFolder folder;
    write_bonds(folder / "bonds.vtp", w.state);
    const auto bonds = read_surface(folder / "bonds.vtp");
    REQUIRE(bonds->GetNumberOfLines() == 2);
    REQUIRE(bonds->GetNumberOfPolys() == 0);
    const std::vector<Vec3> line = points_of(bonds->GetCell(0));
    CHECK(line.at(0) == w.state.bodies.position[0]);
    CHECK(line.at(1) == w.state.bodies.position[1]);
    vtkFieldData* data = bonds->GetCellData();
    const double R = 0.25, A = std::numbers::pi * R * R;
    CHECK(value(data, "kind", 0) == 2.0);
    CHECK(value(data, "normal_force", 0) == Approx(100.0).epsilon(1e-12));
    CHECK(value(data, "shear_force", 0) == Approx(50.0).epsilon(1e-12));
    CHECK(value(data, "twisting_moment", 0) == Approx(5.0).epsilon(1e-12));
    CHECK(value(data, "bending_moment", 0) == Approx(12.0).epsilon(1e-12));
    CHECK(value(data, "normal_stress", 0) == Approx(100.0 / A).epsilon(1e-12));
    CHECK(value(data, "peak_normal_stress", 0) == Approx(100.0 / A + 4.0 * 12.0 / (A * R)).epsilon(1e-12));
    CHECK(value(data, "peak_shear_stress", 0) == Approx(50.0 / A + 2.0 * 5.0 / (A * R)).epsilon(1e-12));
    CHECK(value(data, "opening", 0) == Approx(sample::sphere_gap).epsilon(1e-12));
    CHECK(value(data, "radius", 0) == R);
    CHECK(value(data, "state", 1) == 2.0);
    CHECK(value(data, "cause", 1) == 0.0);
    CHECK(value(data, "failure_time", 1) == 2e-6);
    CHECK(value(data, "normal", 1, 0) == Approx(1.0));

    const std::vector<CrackFace> cracks = collect_cracks(w.model, w.state);
    REQUIRE(cracks.size() == 1);
    CHECK(cracks[0].area == Approx(A).epsilon(1e-14));
    CHECK(norm(polygon_centroid(cracks[0].polygon) - Vec3{1.5, 0, 0}) < 1e-14);
    CHECK(crack_sums(w.state).intergranular_area == Approx(A).epsilon(1e-14));
}

TEST_CASE("lines of spheres come before polygons of grains, fields in the same order", "[output][paraview]")
{
    sample::World w = sample::make_world();
    SpherePair pair;  // between two grains: only the order of cells is looked at
    pair.b = 2;
    pair.radius = 1e-4;
    pair.springs = {1.0, 1.0, 0.0, 0.0};
    add_sphere_bond(w.model, w.state, pair);
    const sample::TemporaryFolder folder;
    write_bonds(folder / "bonds.vtp", w.state);
    const auto bonds = read_surface(folder / "bonds.vtp");
    REQUIRE(bonds->GetNumberOfCells() == 3);
    const double kinds[] = {2, 0, 0}, points[] = {2, 4, 4};
    for (int i = 0; i < 3; ++i) {
        CHECK(value(bonds->GetCellData(), "kind", i) == kinds[i]);
        CHECK(bonds->GetCell(i)->GetNumberOfPoints() == points[i]);
    }
}

TEST_CASE("walls are closed surfaces", "[output][paraview]")
{
    const sample::World w = sample::make_world();
    const sample::TemporaryFolder folder;
    write_walls(folder / "walls.vtp", w.model, w.state);
    const auto walls = read_surface(folder / "walls.vtp");
    std::map<int, double> volume;
    for (vtkIdType i = 0; i < walls->GetNumberOfCells(); ++i) {
        const std::vector<Vec3> face = points_of(walls->GetCell(i));
        volume[static_cast<int>(value(walls->GetCellData(), "wall", i))] += dot(area_vector(face), face.front()) / 3.0;
    }
    REQUIRE(volume.size() == 2);
    CHECK(volume[0] == Approx(8.2e-3 * 1e-3 * 6e-3).epsilon(1e-12));                // grown box
    CHECK(volume[1] == Approx(4.0 / 3.0 * std::numbers::pi * 1e-9).epsilon(0.01));  // 48 meridians
    double bounds[6];
    walls->GetBounds(bounds);
    CHECK(bounds[2] == Approx(-sample::side - 1e-3).epsilon(1e-12));
}

TEST_CASE("surfaces of shapes are closed and look outward", "[output][paraview]")
{
    Shapes shapes;
    add_sphere_shape(shapes, 2.0);
    add_cylinder_shape(shapes, {1, 0, 0}, 3.0, 0.5);
    add_shape(shapes, make_hexagonal_prism(1.0, 2.0), 0.25);
    const double grown = 1.0 + 0.25 * 2.0 / std::sqrt(3.0);
    const double expected[] = {4.0 / 3.0 * std::numbers::pi * 8.0,
                               std::numbers::pi * 0.25 * 3.0 + 4.0 / 3.0 * std::numbers::pi * 0.125,
                               1.5 * std::sqrt(3.0) * grown * grown * 2.5};
    for (int s = 0; s < 3; ++s) {
        const Surface surface = shape_surface(shapes, s);
        std::map<std::pair<int, int>, int> edges;
        double volume = 0.0;
        for (const auto& loop : surface.faces) {
            std::vector<Vec3> face;
            for (std::size_t k = 0; k < loop.size(); ++k) {
                face.push_back(surface.points.at(static_cast<std::size_t>(loop[k])));
                ++edges[{loop[k], loop[(k + 1) % loop.size()]}];
            }
            volume += dot(area_vector(face), face.front()) / 3.0;
        }
        for (const auto& [edge, count] : edges) {
            CHECK(count == 1);
            CHECK(edges.count({edge.second, edge.first}) == 1);
        }
        CHECK(volume == Approx(expected[s]).epsilon(s == 2 ? 1e-12 : 0.01));
    }
}

TEST_CASE("layers without anything in them are valid files", "[output][paraview]")
{
    const Model model;
    const State state;
    const sample::TemporaryFolder folder;
    write_grains(folder / "grains.vtu", model, state, {});
    write_bonds(folder / "bonds.vtp", state);
    write_contacts(folder / "contacts.vtp", state);
    write_cracks(folder / "cracks.vtp", state, {});
    write_walls(folder / "walls.vtp", model, state);
    CHECK(read_grid(folder / "grains.vtu")->GetNumberOfCells() == 0);
    for (const char* name : {"bonds.vtp", "contacts.vtp", "cracks.vtp", "walls.vtp"})
        CHECK(read_surface(folder / name)->GetNumberOfCells() == 0);
}

TEST_CASE("the series enter each frame with its time", "[output][paraview]")
{
    sample::World w = sample::make_world();
    const sample::TemporaryFolder folder;
    ParaviewSeries series(folder.path());
    series.write_frame(w.model, w.state, w.fields, {}, true);
    w.state.time = 1.5e-5;
    series.write_frame(w.model, w.state, w.fields, {}, false);
    for (const std::string kind : {"grains", "bonds", "contacts", "cracks", "walls"}) {
        const std::string text = read_file(folder / (kind + ".pvd"));
        CHECK(text.find("type=\"Collection\"") != std::string::npos);
        std::vector<std::string> files;
        for (std::size_t at = 0; (at = text.find("file=\"", at)) != std::string::npos; ++at)
            files.push_back(text.substr(at + 6, text.find('"', at + 6) - at - 6));
        REQUIRE(files.size() == (kind == "contacts" ? 1 : 2));
        CHECK(files[0] == kind + "_000000." + (kind == "grains" ? "vtu" : "vtp"));
        for (const std::string& file : files) CHECK(std::filesystem::exists(folder / file));
        CHECK(text.find("timestep=\"3e-06\"") != std::string::npos);
        CHECK((text.find("timestep=\"1.5e-05\"") != std::string::npos) == (kind != "contacts"));
    }
}

TEST_CASE("a series of spheres is written where there are some", "[output][paraview]")
{
    const sample::World w = sample::make_spheres(), grains = sample::make_world();
    const sample::TemporaryFolder folder, other;
    ParaviewSeries(folder.path()).write_frame(w.model, w.state, w.fields, {}, true);
    ParaviewSeries(other.path()).write_frame(grains.model, grains.state, grains.fields, {}, true);
    CHECK(read_file(folder / "spheres.pvd").find("spheres_000000.vtp") != std::string::npos);
    CHECK_FALSE(std::filesystem::exists(other / "spheres.pvd"));
}

TEST_CASE("VTK's readers load every file that a run leaves, and every series names files that there are")
{
    const sample::TemporaryFolder folder;
    const std::filesystem::path run = sample::run_cleaving_disc(folder);
    int grids = 0, surfaces = 0, named = 0;
    for (const auto& entry : std::filesystem::directory_iterator(run / "paraview")) {
        const std::string extension = entry.path().extension().string();
        if (extension == ".vtu") {
            CHECK(read_grid(entry.path())->GetNumberOfCells() > 0);
            ++grids;
        } else if (extension == ".vtp") {
            CHECK(read_surface(entry.path()) != nullptr);
            ++surfaces;
        } else if (extension == ".pvd") {
            std::ifstream in(entry.path());
            const std::string text((std::istreambuf_iterator<char>(in)), {});
            for (std::size_t at = text.find("file=\""); at != std::string::npos; at = text.find("file=\"", at + 6)) {
                const std::string name = text.substr(at + 6, text.find('"', at + 6) - at - 6);
                CHECK(std::filesystem::exists(run / "paraview" / name));
                ++named;
            }
        }
    }
    CHECK(grids >= 4);
    CHECK(surfaces >= 8);
    CHECK(named >= grids + surfaces);
}

#endif
