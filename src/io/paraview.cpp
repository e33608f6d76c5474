// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/paraview.h"

#include "io/atomic_file.h"
#include "io/bond_faces.h"
#include "io/shape_surface.h"

#include <fmt/format.h>
#include <vtkCallbackCommand.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkIntArray.h>
#include <vtkMath.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLPolyDataWriter.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <stdexcept>

namespace grainfrac {

namespace {

// ---- arrays

template <class Array, std::size_t n, class Value>
void add_columns(vtkFieldData* data, const char* name, const std::vector<int>& rows, Value&& value)
{
    vtkNew<Array> array;
    array->SetName(name);
    array->SetNumberOfComponents(static_cast<int>(n));
    array->SetNumberOfTuples(static_cast<vtkIdType>(rows.size()));
    for (std::size_t k = 0; k < rows.size(); ++k) {
        const auto tuple = value(rows[k]);
        for (std::size_t c = 0; c < n; ++c)
            array->SetTypedComponent(static_cast<vtkIdType>(k), static_cast<int>(c), tuple[c]);
    }
    data->AddArray(array);
}

/// Cell array of `value(row)` over `rows`.
template <class Value>
void add_numbers(vtkFieldData* data, const char* name, const std::vector<int>& rows, Value&& value)
{
    add_columns<vtkDoubleArray, 1>(data, name, rows, [&](int i) { return std::array<double, 1>{value(i)}; });
}
template <class Value>
void add_integers(vtkFieldData* data, const char* name, const std::vector<int>& rows, Value&& value)
{
    add_columns<vtkIntArray, 1>(data, name, rows,
                                [&](int i) { return std::array<int, 1>{static_cast<int>(value(i))}; });
}
template <class Value>
void add_vectors(vtkFieldData* data, const char* name, const std::vector<int>& rows, Value&& value)
{
    add_columns<vtkDoubleArray, 3>(data, name, rows, [&](int i) {
        const Vec3 v = value(i);
        return std::array<double, 3>{v.x, v.y, v.z};
    });
}

void add_time(vtkDataObject* object, const State& state)
{
    add_numbers(object->GetFieldData(), "TimeValue", {0}, [&](int) { return state.time; });
}

void add_names(vtkDataObject* object, const char* name, const std::vector<std::string>& texts)
{
    vtkNew<vtkStringArray> array;
    array->SetName(name);
    for (const std::string& text : texts) array->InsertNextValue(text);
    object->GetFieldData()->AddArray(array);
}

std::vector<int> all_rows(std::size_t n)
{
    std::vector<int> rows(n);
    for (std::size_t i = 0; i < n; ++i) rows[i] = static_cast<int>(i);
    return rows;
}

void add_point(vtkPoints* points, const Vec3& p)
{
    points->InsertNextPoint(p.x, p.y, p.z);
}

// ---- files

/// zlib at its quickest: half the size of LZ4, and other programs than VTK read it too.
template <class Writer, class Data>
void write_xml(const std::filesystem::path& path, Data* data)
{
    std::string complaint;
    vtkNew<vtkCallbackCommand> listener;
    listener->SetClientData(&complaint);
    listener->SetCallback([](vtkObject*, unsigned long, void* text, void* message) {
        if (message != nullptr) *static_cast<std::string*>(text) += static_cast<const char*>(message);
    });
    vtkNew<Writer> writer;
    writer->AddObserver("ErrorEvent", listener);
    writer->SetInputData(data);
    // Inline, not appended: Debian's ParaView 5.11 with its updated libexpat refuses raw data after the header.
    writer->SetDataModeToBinary();
    writer->SetCompressorTypeToZLib();
    writer->SetCompressionLevel(1);
    writer->WriteToOutputStringOn();
    if (writer->Write() == 0 || !complaint.empty())
        throw std::runtime_error(path.string() + ": VTK cannot write it: " + complaint);
    write_file(path, writer->GetOutputString());
}

// ---- grains

std::vector<int> grain_rows(const Model& model, const State& state)
{
    std::vector<int> rows;
    for (int i = 0; i < state.bodies.size(); ++i) {
        if (state.bodies.wall[i] < 0 && !model.grain_shapes[static_cast<std::size_t>(i)].faces.empty())
            rows.push_back(i);
    }
    return rows;
}

std::vector<int> sphere_rows(const Model& model, const State& state)
{
    std::vector<int> rows;
    for (int i = 0; i < state.bodies.size(); ++i) {
        if (is_sphere(model, state.bodies, i)) rows.push_back(i);
    }
    return rows;
}

void add_grain_cell(vtkUnstructuredGrid* grid, vtkPoints* points, const Polyhedron& shape, const Vec3& position,
                    const Quat& orientation)
{
    const vtkIdType first = points->GetNumberOfPoints();
    std::vector<vtkIdType> corners, faces;
    for (const Vec3& v : shape.vertices) {
        corners.push_back(points->GetNumberOfPoints());
        add_point(points, position + rotate(orientation, v));
    }
    for (const auto& loop : shape.faces) {
        faces.push_back(static_cast<vtkIdType>(loop.size()));
        for (const int v : loop) faces.push_back(first + v);
    }
    grid->InsertNextCell(VTK_POLYHEDRON, static_cast<vtkIdType>(corners.size()), corners.data(),
                         static_cast<vtkIdType>(shape.faces.size()), faces.data());
}

void add_grain_identity(vtkFieldData* data, const State& state, const SnapshotFields& fields,
                        const std::vector<int>& rows)
{
    const Bodies& bodies = state.bodies;
    add_integers(data, "grain_id", rows, [&](int i) { return bodies.id[i]; });
    add_integers(data, "fragment_of", rows, [&](int i) { return bodies.origin[i]; });
    add_integers(data, "parent", rows, [&](int i) { return bodies.parent[i]; });
    add_integers(data, "generation", rows, [&](int i) { return bodies.generation[i]; });
    const auto cleavage = [&](int i) {
        return fields.cleavage.empty() ? GrainCleavage{} : fields.cleavage.at(static_cast<std::size_t>(i));
    };
    add_numbers(data, "cleavage", rows, [&](int i) { return cleavage(i).worst.f; });
    add_numbers(data, "K_I", rows, [&](int i) { return cleavage(i).worst.K_I; });
    add_numbers(data, "K_II", rows, [&](int i) { return cleavage(i).worst.K_II; });
    add_integers(data, "cleavage_family", rows, [&](int i) { return cleavage(i).family; });
    add_vectors(data, "cleavage_normal", rows, [&](int i) { return cleavage(i).plane.normal; });
    add_columns<vtkDoubleArray, 4>(data, "crystal_orientation", rows, [&](int i) {
        const Quat q = bodies.orientation[i] * bodies.crystal[i];
        return std::array<double, 4>{q.w, q.x, q.y, q.z};
    });
}

/// What grains and spheres have in common.
void add_body_identity(vtkFieldData* data, const Model& model, const State& state, const SnapshotFields& fields,
                       const std::vector<int>& rows)
{
    const Bodies& bodies = state.bodies;
    add_integers(data, "material", rows,
                 [&](int i) { return model.groups.at(static_cast<std::size_t>(bodies.group[i])).material; });
    add_integers(data, "cluster", rows, [&](int i) { return fields.cluster.at(static_cast<std::size_t>(i)); });
    const std::vector<double> damage = mean_bond_damage(state);
    add_numbers(data, "damage", rows, [&](int i) { return damage[static_cast<std::size_t>(i)]; });
}

void add_material_names(vtkDataObject* object, const Model& model)
{
    std::vector<std::string> names;
    for (const Material& material : model.materials) names.push_back(material.name);
    add_names(object, "material_names", names);
}

void add_body_motion(vtkFieldData* data, const Bodies& bodies, const std::vector<int>& rows)
{
    add_vectors(data, "velocity", rows, [&](int i) { return bodies.velocity[i]; });
    add_vectors(data, "angular_velocity", rows, [&](int i) { return bodies.angular_velocity[i]; });
    add_vectors(data, "displacement", rows, [&](int i) { return bodies.position[i] - bodies.start_position[i]; });
    add_vectors(data, "rotation", rows,
                [&](int i) { return rotation_vector(bodies.orientation[i] * conjugate(bodies.start_orientation[i])); });
}

struct Principal {
    Vec3 value;      ///< largest first [Pa]
    Vec3 direction;  ///< of the largest [-]
};

Principal principal_stress(const Mat3& stress)
{
    double rows[3][3], values[3], vectors[3][3];
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) rows[i][j] = 0.5 * (stress[i][j] + stress[j][i]);
    }
    double* a[] = {rows[0], rows[1], rows[2]};
    double* v[] = {vectors[0], vectors[1], vectors[2]};
    vtkMath::Jacobi(a, values, v);  // sorts the values, largest first
    return {{values[0], values[1], values[2]}, {vectors[0][0], vectors[1][0], vectors[2][0]}};
}

double von_mises(const Mat3& s)
{
    const double xy = 0.5 * (s[0].y + s[1].x), yz = 0.5 * (s[1].z + s[2].y), xz = 0.5 * (s[0].z + s[2].x);
    const double d0 = s[0].x - s[1].y, d1 = s[1].y - s[2].z, d2 = s[2].z - s[0].x;
    return std::sqrt(0.5 * (d0 * d0 + d1 * d1 + d2 * d2) + 3.0 * (xy * xy + yz * yz + xz * xz));
}

void add_body_stress(vtkFieldData* data, const std::vector<Mat3>& stress, const std::vector<int>& rows)
{
    const auto of = [&](int i) -> const Mat3& { return stress.at(static_cast<std::size_t>(i)); };
    add_columns<vtkDoubleArray, 6>(data, "stress", rows, [&](int i) {
        const Mat3& s = of(i);
        return std::array<double, 6>{
            s[0].x, s[1].y, s[2].z, 0.5 * (s[0].y + s[1].x), 0.5 * (s[1].z + s[2].y), 0.5 * (s[0].z + s[2].x)};
    });
    const char* names[] = {"XX", "YY", "ZZ", "XY", "YZ", "XZ"};
    for (int c = 0; c < 6; ++c) data->GetAbstractArray("stress")->SetComponentName(c, names[c]);
    add_numbers(data, "pressure", rows, [&](int i) { return trace(of(i)) / 3.0; });
    add_numbers(data, "von_mises", rows, [&](int i) { return von_mises(of(i)); });
    std::vector<Principal> principal(stress.size());
    for (const int i : rows) principal[static_cast<std::size_t>(i)] = principal_stress(of(i));
    add_vectors(data, "principal_stress", rows, [&](int i) { return principal[static_cast<std::size_t>(i)].value; });
    add_vectors(data, "principal_direction_1", rows,
                [&](int i) { return principal[static_cast<std::size_t>(i)].direction; });
}

// ---- points and polygons

/// A vertex at `place(row)` for each row; its fields go on the points, where ParaView's glyphs look for them.
template <class Place>
void add_vertices(vtkPolyData* cloud, const std::vector<int>& rows, Place&& place)
{
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    vtkNew<vtkCellArray> vertices;
    for (const int i : rows) {
        vertices->InsertNextCell(1);
        vertices->InsertCellPoint(points->GetNumberOfPoints());
        add_point(points, place(i));
    }
    cloud->SetPoints(points);
    cloud->SetVerts(vertices);
}

void add_polygon(vtkPoints* points, vtkCellArray* polygons, const std::vector<Vec3>& polygon)
{
    polygons->InsertNextCell(static_cast<int>(polygon.size()));
    for (const Vec3& p : polygon) {
        polygons->InsertCellPoint(points->GetNumberOfPoints());
        add_point(points, p);
    }
}

/// Slots in the order of the cells of the bond layer: lines come before polygons in VTK's numbering.
std::vector<int> bond_cells(const std::vector<BondFacts>& bonds)
{
    std::vector<int> slots = all_rows(bonds.size());
    std::stable_partition(slots.begin(), slots.end(),
                          [&](int s) { return bonds[static_cast<std::size_t>(s)].kind == BondKind::sphere; });
    return slots;
}

std::vector<int> active_contacts(const State& state)
{
    std::vector<int> rows;
    state.for_each_contact([&](int i) {
        if (state.contacts.active[i] == 1) rows.push_back(i);
    });
    return rows;
}

/// A layer or series that this program wrote after `mark`: KIND_NNNNNN.SUFFIX, KIND.pvd.
bool is_later(const std::string& file, const ParaviewMark& mark)
{
    for (const std::string kind : {"grains", "spheres", "bonds", "contacts", "cracks", "walls"}) {
        if (file == kind + ".pvd") return !mark.entries.contains(kind);
        if (!file.starts_with(kind + "_") || !(file.ends_with(".vtu") || file.ends_with(".vtp"))) continue;
        const char *const begin = file.data() + kind.size() + 1, *const end = file.data() + file.size() - 4;
        std::int64_t frame = -1;
        return std::from_chars(begin, end, frame).ptr == end && frame >= mark.frame;
    }
    return false;
}

}  // namespace

void write_grains(const std::filesystem::path& path, const Model& model, const State& state,
                  const SnapshotFields& fields)
{
    const std::vector<int> rows = grain_rows(model, state);
    vtkNew<vtkUnstructuredGrid> grid;
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    for (const int i : rows) {
        const Polyhedron& shape = model.grain_shapes[static_cast<std::size_t>(i)];
        add_grain_cell(grid, points, shape, state.bodies.position[i], state.bodies.orientation[i]);
    }
    grid->SetPoints(points);
    vtkFieldData* data = grid->GetCellData();
    add_grain_identity(data, state, fields, rows);
    add_body_identity(data, model, state, fields, rows);
    add_body_motion(data, state.bodies, rows);
    add_body_stress(data, fields.stress, rows);
    add_time(grid, state);
    add_material_names(grid, model);
    write_xml<vtkXMLUnstructuredGridWriter>(path, grid.Get());
}

void write_spheres(const std::filesystem::path& path, const Model& model, const State& state,
                   const SnapshotFields& fields)
{
    const Bodies& bodies = state.bodies;
    const std::vector<int> rows = sphere_rows(model, state);
    vtkNew<vtkPolyData> cloud;
    add_vertices(cloud, rows, [&](int i) { return bodies.position[i]; });
    vtkFieldData* data = cloud->GetPointData();
    add_integers(data, "sphere_id", rows, [&](int i) { return bodies.id[i]; });
    add_numbers(data, "radius", rows, [&](int i) { return model.shapes.radius[bodies.shape[i]]; });
    add_integers(data, "part", rows, [&](int i) { return bodies.group[i]; });
    add_integers(data, "held", rows, [&](int i) { return bodies.wall[i] >= 0 ? 1 : 0; });
    add_body_identity(data, model, state, fields, rows);
    add_body_motion(data, bodies, rows);
    add_body_stress(data, fields.stress, rows);
    add_time(cloud, state);
    add_material_names(cloud, model);
    std::vector<std::string> parts;
    for (const Group& group : model.groups) parts.push_back(group.name);
    add_names(cloud, "part_names", parts);
    write_xml<vtkXMLPolyDataWriter>(path, cloud.Get());
}

void write_culprits(const std::filesystem::path& path, const Model& model, const State& state,
                    const std::vector<int>& bodies)
{
    const Bodies& b = state.bodies;
    vtkNew<vtkUnstructuredGrid> grid;
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    for (const int i : bodies) {
        const Polyhedron& shape = model.grain_shapes[static_cast<std::size_t>(i)];
        if (!shape.faces.empty()) {
            add_grain_cell(grid, points, shape, b.position[i], b.orientation[i]);
            continue;
        }
        const vtkIdType point = points->GetNumberOfPoints();
        add_point(points, b.position[i]);
        grid->InsertNextCell(VTK_VERTEX, 1, &point);
    }
    grid->SetPoints(points);
    vtkFieldData* data = grid->GetCellData();
    add_integers(data, "body_id", bodies, [&](int i) { return b.id[i]; });
    add_integers(data, "part", bodies, [&](int i) { return b.group[i]; });
    add_numbers(data, "radius", bodies, [&](int i) { return model.shapes.radius[b.shape[i]]; });
    add_vectors(data, "force", bodies, [&](int i) { return b.force[i]; });
    add_body_motion(data, b, bodies);
    add_time(grid, state);
    write_xml<vtkXMLUnstructuredGridWriter>(path, grid.Get());
}

void write_bonds(const std::filesystem::path& path, const State& state)
{
    const std::vector<BondFacts> facts = all_bond_facts(state);
    const std::vector<int> rows = bond_cells(facts);
    const auto bond = [&](int slot) -> const BondFacts& { return facts[static_cast<std::size_t>(slot)]; };
    vtkNew<vtkPolyData> surface;
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    vtkNew<vtkCellArray> lines, polygons;
    std::vector<BondLoad> loads(facts.size());
    std::vector<Vec3> normals(facts.size());
    std::vector<double> openings(facts.size());
    for (const int slot : rows) {
        const auto i = static_cast<std::size_t>(slot);
        const BondFace face = bond_face(state, slot);
        if (bond(slot).kind == BondKind::sphere) {
            lines->InsertNextCell(2);
            for (const std::int32_t body : {bond(slot).a, bond(slot).b}) {
                lines->InsertCellPoint(points->GetNumberOfPoints());
                add_point(points, state.bodies.position[body]);
            }
        } else {
            add_polygon(points, polygons, face.polygon);
        }
        loads[i] = bond_load(state, slot, bond(slot), face);
        normals[i] = face.normal;
        openings[i] = face.opening;
    }
    surface->SetPoints(points);
    surface->SetLines(lines);
    surface->SetPolys(polygons);
    vtkFieldData* data = surface->GetCellData();
    add_integers(data, "grain_a", rows, [&](int i) { return state.bodies.id[bond(i).a]; });
    add_integers(data, "grain_b", rows, [&](int i) { return state.bodies.id[bond(i).b]; });
    add_integers(data, "kind", rows, [&](int i) { return bond(i).kind; });
    add_integers(data, "state", rows, [&](int i) { return bond(i).stage; });
    add_integers(data, "cause", rows, [&](int i) { return bond(i).cause; });
    add_numbers(data, "damage", rows, [&](int i) { return bond(i).damage; });
    add_numbers(data, "opening", rows, [&](int i) { return openings[static_cast<std::size_t>(i)]; });
    const auto add_load = [&](const char* name, double BondLoad::*member) {
        add_numbers(data, name, rows, [&](int i) { return loads[static_cast<std::size_t>(i)].*member; });
    };
    add_load("normal_force", &BondLoad::normal_force);
    add_load("shear_force", &BondLoad::shear_force);
    add_load("bending_moment", &BondLoad::bending_moment);
    add_load("twisting_moment", &BondLoad::twisting_moment);
    add_load("normal_stress", &BondLoad::normal_stress);
    add_load("shear_stress", &BondLoad::shear_stress);
    add_load("peak_normal_stress", &BondLoad::peak_normal_stress);
    add_load("peak_shear_stress", &BondLoad::peak_shear_stress);
    add_numbers(data, "stored_energy", rows, [&](int i) { return bond(i).stored_energy; });
    add_numbers(data, "fracture_work", rows, [&](int i) { return bond(i).fracture_work; });
    add_numbers(data, "area", rows, [&](int i) { return bond(i).area; });
    add_numbers(data, "radius", rows, [&](int i) { return bond(i).radius; });
    add_numbers(data, "failure_time", rows, [&](int i) { return bond(i).failure_time; });
    add_vectors(data, "normal", rows, [&](int i) { return normals[static_cast<std::size_t>(i)]; });
    add_time(surface, state);
    write_xml<vtkXMLPolyDataWriter>(path, surface.Get());
}

void write_contacts(const std::filesystem::path& path, const State& state)
{
    const Contacts& contacts = state.contacts;
    const std::vector<int> rows = active_contacts(state);
    vtkNew<vtkPolyData> cloud;
    add_vertices(cloud, rows, [&](int i) { return contacts.point[i].position; });
    vtkFieldData* data = cloud->GetPointData();
    add_integers(data, "body_a", rows, [&](int i) { return state.bodies.id[contacts.a[i]]; });
    add_integers(data, "body_b", rows, [&](int i) { return state.bodies.id[contacts.b[i]]; });
    add_vectors(data, "force", rows, [&](int i) {
        const int slot = state.bond_slots() + i;
        return slot < state.slots.size() ? state.slots.force[slot] : Vec3{};
    });
    add_vectors(data, "normal", rows, [&](int i) { return contacts.point[i].normal; });
    add_numbers(data, "normal_force", rows, [&](int i) { return contacts.normal_force[i]; });
    add_numbers(data, "penetration", rows, [&](int i) { return contacts.point[i].depth; });
    add_numbers(data, "area", rows, [&](int i) { return contacts.point[i].area; });
    add_time(cloud, state);
    write_xml<vtkXMLPolyDataWriter>(path, cloud.Get());
}

void write_cracks(const std::filesystem::path& path, const State& state, const std::vector<CrackFace>& cracks)
{
    const std::vector<int> rows = all_rows(cracks.size());
    const auto crack = [&](int i) -> const CrackFace& { return cracks[static_cast<std::size_t>(i)]; };
    vtkNew<vtkPolyData> surface;
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    vtkNew<vtkCellArray> polygons;
    for (const CrackFace& face : cracks) add_polygon(points, polygons, face.polygon);
    surface->SetPoints(points);
    surface->SetPolys(polygons);
    vtkFieldData* data = surface->GetCellData();
    add_integers(data, "mode", rows, [&](int i) { return crack(i).mode; });
    add_integers(data, "cause", rows, [&](int i) { return crack(i).cause; });
    add_numbers(data, "time", rows, [&](int i) { return crack(i).time; });
    add_numbers(data, "first_damage_time", rows, [&](int i) { return crack(i).first_damage_time; });
    add_numbers(data, "area", rows, [&](int i) { return crack(i).area; });
    add_vectors(data, "normal", rows, [&](int i) { return crack(i).normal; });
    add_numbers(data, "opening", rows, [&](int i) { return crack(i).opening; });
    add_numbers(data, "K_I", rows, [&](int i) { return crack(i).K_I; });
    add_numbers(data, "K_II", rows, [&](int i) { return crack(i).K_II; });
    add_integers(data, "grain_a", rows, [&](int i) { return crack(i).grain_a; });
    add_integers(data, "grain_b", rows, [&](int i) { return crack(i).grain_b; });
    add_time(surface, state);
    write_xml<vtkXMLPolyDataWriter>(path, surface.Get());
}

void write_walls(const std::filesystem::path& path, const Model& model, const State& state)
{
    const Bodies& bodies = state.bodies;
    vtkNew<vtkPolyData> surface;
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    vtkNew<vtkCellArray> polygons;
    std::vector<int> rows;  // the body of each polygon
    for (int i = 0; i < bodies.size(); ++i) {
        if (bodies.wall[i] < 0 || is_sphere(model, bodies, i)) continue;  // held spheres stay spheres
        const Surface shape = shape_surface(model.shapes, bodies.shape[i]);
        const vtkIdType first = points->GetNumberOfPoints();
        for (const Vec3& p : shape.points) add_point(points, bodies.position[i] + rotate(bodies.orientation[i], p));
        for (const auto& loop : shape.faces) {
            polygons->InsertNextCell(static_cast<int>(loop.size()));
            for (const int v : loop) polygons->InsertCellPoint(first + v);
            rows.push_back(i);
        }
    }
    surface->SetPoints(points);
    surface->SetPolys(polygons);
    vtkFieldData* data = surface->GetCellData();
    add_integers(data, "wall", rows, [&](int i) { return bodies.wall[i]; });
    add_integers(data, "body", rows, [&](int i) { return bodies.id[i]; });
    add_vectors(data, "velocity", rows, [&](int i) { return bodies.velocity[i]; });
    add_vectors(data, "force", rows, [&](int i) { return bodies.force[i]; });
    add_vectors(data, "displacement", rows, [&](int i) { return bodies.position[i] - bodies.start_position[i]; });
    add_time(surface, state);
    add_names(surface, "wall_names", model.walls);
    write_xml<vtkXMLPolyDataWriter>(path, surface.Get());
}

void ParaviewSeries::write_frame(const Model& model, const State& state, const SnapshotFields& fields,
                                 const std::vector<CrackFace>& cracks, bool contacts)
{
    std::vector<std::pair<std::string, std::string>> written;  // kind, file
    const auto layer = [&](const char* kind, const char* suffix, auto&& write) {
        const std::string file = fmt::format("{}_{:06}.{}", kind, now_.frame, suffix);
        write(folder_ / file);
        written.emplace_back(kind, file);
    };
    layer("grains", "vtu", [&](const auto& file) { write_grains(file, model, state, fields); });
    if (!sphere_rows(model, state).empty())
        layer("spheres", "vtp", [&](const auto& file) { write_spheres(file, model, state, fields); });
    layer("bonds", "vtp", [&](const auto& file) { write_bonds(file, state); });
    if (contacts) layer("contacts", "vtp", [&](const auto& file) { write_contacts(file, state); });
    layer("cracks", "vtp", [&](const auto& file) { write_cracks(file, state, cracks); });
    layer("walls", "vtp", [&](const auto& file) { write_walls(file, model, state); });
    // Entered when all are there, so that the layers that ParaView shows are of one time.
    for (const auto& [kind, file] : written) enter(kind, file, state.time);
    ++now_.frame;
}

void ParaviewSeries::enter(const std::string& kind, const std::string& file, double time)
{
    now_.entries[kind] += fmt::format("    <DataSet timestep=\"{}\" group=\"\" part=\"0\" file=\"{}\"/>\n", time, file);
    write_series(kind);
}

void ParaviewSeries::write_series(const std::string& kind) const
{
    write_file(folder_ / (kind + ".pvd"),
               "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"LittleEndian\">\n"
               "  <Collection>\n" +
                   now_.entries.at(kind) + "  </Collection>\n</VTKFile>\n");
}

ParaviewSeries::ParaviewSeries(std::filesystem::path folder, const ParaviewMark& mark)
    : folder_(std::move(folder)), now_(mark)
{
    for (const auto& [kind, lines] : now_.entries) write_series(kind);
    for (const auto& entry : std::filesystem::directory_iterator(folder_)) {
        if (is_later(entry.path().filename().string(), now_)) std::filesystem::remove(entry.path());
    }
}

std::vector<std::string> missing_frames(const std::filesystem::path& folder, const ParaviewMark& mark)
{
    std::vector<std::string> missing;
    const std::string_view before = " file=\"";
    for (const auto& [kind, lines] : mark.entries) {
        for (auto at = lines.find(before); at != lines.npos; at = lines.find(before, at)) {
            at += before.size();
            const std::string file = lines.substr(at, lines.find('"', at) - at);
            if (!std::filesystem::is_regular_file(folder / file)) missing.push_back(file);
        }
    }
    return missing;
}

}  // namespace grainfrac
