// SPDX-License-Identifier: GPL-3.0-or-later
// Files of spheres: what is written is read back, each format gives the same, and what is wrong has its place.
#include "generate/packings.h"
#include "generate/sphere_file.h"
#include "io/hdf5_file.h"
#include "io/sphere_formats.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>

using namespace grainfrac;

namespace {

/// A folder that is gone with the object.
struct Folder {
    std::filesystem::path path = std::filesystem::temp_directory_path() /
                                 ("grainfrac_spheres_" + std::to_string(reinterpret_cast<std::uintptr_t>(this)));
    Folder() { std::filesystem::create_directories(path); }
    ~Folder() { std::filesystem::remove_all(path); }
    std::filesystem::path with(const std::string& name, const std::string& text) const
    {
        std::ofstream(path / name, std::ios::binary) << text;
        return path / name;
    }
};

const std::vector<Ball> two = {{{0, 0.5, 0}, 0.5}, {{0.1, -0.25, 1e-3}, 0.25}};

void check_two(const std::vector<Ball>& balls)
{
    REQUIRE(balls.size() == 2);
    for (std::size_t i = 0; i < 2; ++i) {
        CHECK(balls[i].center == two[i].center);
        CHECK(balls[i].radius == two[i].radius);
    }
}

/// What is said of a file of this name and text, its folder left out.
std::string problem(const Folder& folder, const std::string& name, const std::string& text)
{
    try {
        read_spheres(folder.with(name, text), "rock");
        return "";
    } catch (const std::runtime_error& e) {
        std::string what = e.what();
        const std::string path = folder.path.string() + "/";
        for (std::size_t at; (at = what.find(path)) != what.npos;) what.replace(at, path.size(), "");
        return what;
    }
}

const std::string head = "x_m,y_m,z_m,radius_m\n";

}  // namespace

TEST_CASE("a packing that is written is read back, bit for bit", "[packings]")
{
    const Folder folder;
    Case c;
    c.file = (folder.path / "case.toml").string();
    c.materials.resize(1);
    c.materials[0].name = "stone";
    PartSpec p;
    p.name = "rock";
    p.kind = "spheres";
    p.material = "stone";
    p.generator = "random_dense";
    p.diameter = 0.3;
    p.size_ratio = 2.0;
    p.solid_fraction = 0.45;
    p.region.size = {1, 2, 1};
    c.parts = {p, p};
    c.parts[1].name = "other";
    c.parts[1].region.center.x = 3.0;
    const std::vector<SphereSpec> made = generate_spheres(c);
    write_spheres(folder.path / "s.csv", made, c.parts);
    for (PartSpec& part : c.parts) {
        part.generator = "file";
        part.file = "s.csv";
    }
    const std::vector<SphereSpec> read = generate_spheres(c);
    REQUIRE(read.size() == made.size());
    for (std::size_t i = 0; i < read.size(); ++i) {
        CHECK(read[i].position == made[i].position);
        CHECK(read[i].radius == made[i].radius);
        CHECK(read[i].group == made[i].group);
    }
    c.parts[0].region.size = {1, 1, 1};  // the middle of the file's
    const std::vector<SphereSpec> fewer = generate_spheres(c);
    CHECK(fewer.size() < made.size());
    CHECK(std::all_of(fewer.begin(), fewer.end(),
                      [](const SphereSpec& s) { return s.group == 1 || std::fabs(s.position.y) <= 0.5; }));
    c.parts[1].name = "third";
    try {
        generate_spheres(c);
        FAIL("a part that the file does not hold");
    } catch (const InputError& e) {
        CHECK(e.problems[0].key == "parts[1].file");
        CHECK(e.problems[0].message == "\"" + (folder.path / "s.csv").string() +
                                           "\" holds no spheres of part \"third\"; it holds those of \"other\", "
                                           "\"rock\"");
    }
}

TEST_CASE("every format gives the same spheres", "[packings]")
{
    const Folder folder;
    enter_sphere_formats();
    // columns in any order, others left out, blanks, line ends of either kind
    check_two(read_spheres(folder.with("s.csv",
                                       "\xEF\xBB\xBF"
                                       "radius_m, x_m,colour,y_m,z_m\r\n0.5,0,red,.5,0\r\n\r\n 0.25 , "
                                       "0.1,,-0.25,1e-3"),
                           "rock"));
    {
        Hdf5File file = Hdf5File::create(folder.path / "s.h5");
        std::vector<double> x, r;
        for (const Ball& b : two) {
            x.insert(x.end(), {b.center.x, b.center.y, b.center.z});
            r.push_back(b.radius);
        }
        file.write("position", {2, 3}, x.data());
        file.write("radius", {2}, r.data());
        file.close();
    }
    check_two(read_spheres(folder.path / "s.h5", "rock"));
#ifdef GF_HAVE_VTK
    check_two(
        read_spheres(folder.with("s.vtk",
                                 "# vtk DataFile Version 3.0\nspheres\nASCII\nDATASET POLYDATA\nPOINTS 2 double\n0 0.5 "
                                 "0\n0.1 -0.25 1e-3\nPOINT_DATA 2\nSCALARS radius double 1\nLOOKUP_TABLE default\n0.5 "
                                 "0.25\n"),
                     "rock"));
    const auto array = [](const std::string& attributes, const std::string& values) {
        return "<DataArray type=\"Float64\" format=\"ascii\" " + attributes + ">" + values + "</DataArray>";
    };
    const auto xml = [&](const std::string& kind, const std::string& counts, const std::string& cells) {
        return "<VTKFile type=\"" + kind + "\" version=\"1.0\" byte_order=\"LittleEndian\"><" + kind +
               "><Piece NumberOfPoints=\"2\" " + counts + "><PointData>" + array("Name=\"radius\"", "0.5 0.25") +
               "</PointData><Points>" + array("NumberOfComponents=\"3\"", "0 0.5 0 0.1 -0.25 1e-3") + "</Points>" +
               cells + "</Piece></" + kind + "></VTKFile>";
    };
    check_two(read_spheres(folder.with("s.vtp", xml("PolyData", "", "")), "rock"));
    const std::string cells =
        "<Cells><DataArray type=\"Int64\" Name=\"connectivity\" format=\"ascii\"/><DataArray "
        "type=\"Int64\" Name=\"offsets\" format=\"ascii\"/><DataArray type=\"UInt8\" "
        "Name=\"types\" format=\"ascii\"/></Cells>";
    check_two(read_spheres(folder.with("s.vtu", xml("UnstructuredGrid", "NumberOfCells=\"0\"", cells)), "rock"));
    CHECK(problem(folder, "bad.vtk", "nonsense") == "\"bad.vtk\": VTK finds no points with an array \"radius\" in it");
    CHECK(problem(folder, "bad.vtu", "<VTKFile") == "\"bad.vtu\": VTK finds no points with an array \"radius\" in it");
#endif
    CHECK(problem(folder, "bad.h5", "nonsense").find("bad.h5") != std::string::npos);
    {
        Hdf5File file = Hdf5File::create(folder.path / "flat.h5");
        file.write("position", {6}, std::vector<double>(6).data());
        file.write("radius", {2}, std::vector<double>(2).data());
        file.close();
    }
    try {
        read_spheres(folder.path / "flat.h5", "rock");
        FAIL("positions in one row");
    } catch (const std::runtime_error& e) {
        CHECK(std::string(e.what()).ends_with("flat.h5\": position is [6], radius [2]; must be [n, 3] and [n]"));
    }
}

TEST_CASE("wrong files of spheres are refused with file and line", "[packings]")
{
    const Folder folder;
    CHECK(problem(folder, "s.csv", "") ==
          "\"s.csv\", line 1: is empty; the first line must name the columns x_m, y_m, z_m, radius_m");
    CHECK(problem(folder, "s.csv", "x_m;y_m;z_m;radius_m\n") ==
          "\"s.csv\", line 1: has no column x_m; the first line must name the columns x_m, y_m, z_m, radius_m, and "
          "commas part them");
    CHECK(problem(folder, "s.csv", head + "1,2,3\n") == "\"s.csv\", line 2: has 3 cells, the first line 4");
    CHECK(problem(folder, "s.csv", head + "1,2,3,1\n\n1,2,c,1\n") ==
          "\"s.csv\", line 4: \"c\" in column z_m is no finite number");
    CHECK(problem(folder, "s.csv", head + "1,2,3,nan\n") ==
          "\"s.csv\", line 2: \"nan\" in column radius_m is no finite number");
    CHECK(problem(folder, "s.csv", head + "1,2,3,-1\n") == "\"s.csv\", line 2: radius_m must be > 0, is -1");
    CHECK(problem(folder, "s.csv", head) == "\"s.csv\" holds no spheres");
    CHECK(problem(folder, "s.csv", head + "1,2,3,1\n5,5,5,1\n1,2,3,2\n") ==
          "\"s.csv\" holds spheres 1 and 3 at the same place");
    CHECK_THROWS_WITH(read_spheres(folder.path / "none.csv", "rock"),
                      "cannot read \"" + (folder.path / "none.csv").string() + "\"");
    CHECK(problem(folder, "s.xyz", head).starts_with("the name must end in one of .csv"));
}
