// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/stl.h"

#include "geometry/polyhedron.h"

#include <catch2/catch.hpp>

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <sstream>

using namespace grainfrac;

namespace {

using Triangles = std::vector<std::array<Vec3, 3>>;

std::string ascii(const Triangles& triangles)
{
    std::ostringstream out;
    out << "solid a thing\n";
    for (const auto& t : triangles) {
        out << " facet normal 0 0 0\n  outer loop\n";
        for (const Vec3& x : t) out << "   vertex " << x.x << ' ' << x.y << ' ' << x.z << '\n';
        out << "  endloop\n endfacet\n";
    }
    return out.str() + "endsolid a thing\n";
}

/// `header`: some programs begin binary files with "solid" too.
std::string binary(const Triangles& triangles, std::string header = "made by a test")
{
    header.resize(80, ' ');
    std::string out = header;
    const auto put = [&](const auto& x) { out.append(reinterpret_cast<const char*>(&x), sizeof x); };
    put(static_cast<std::uint32_t>(triangles.size()));
    for (const auto& t : triangles) {
        for (int k = 0; k < 3; ++k) put(0.0F);
        for (const Vec3& x : t) {
            for (int k = 0; k < 3; ++k) put(static_cast<float>(x[k]));
        }
        put(std::uint16_t{0});
    }
    return out;
}

Triangles box_triangles(const Vec3& size)
{
    Triangles out;
    const Polyhedron box = make_box(size);
    for (const auto& f : box.faces) {
        const auto at = [&](std::size_t k) { return box.vertices[static_cast<std::size_t>(f[k])]; };
        out.push_back({at(0), at(1), at(2)});
        out.push_back({at(0), at(2), at(3)});
    }
    return out;
}

class StlFile {
public:
    explicit StlFile(const std::string& text)
        : path_(std::filesystem::temp_directory_path() /
                ("grainfrac_stl_" + std::to_string(reinterpret_cast<std::uintptr_t>(this)) + ".stl"))
    {
        std::ofstream(path_, std::ios::binary) << text;
    }
    ~StlFile() { std::filesystem::remove(path_); }
    TriangleMesh read() const { return read_stl(path_); }
    std::string refusal() const
    {
        try {
            read();
        } catch (const std::runtime_error& e) {
            std::string what = e.what();
            return what.substr(what.rfind("\" ") + 2);
        }
        return "";
    }

private:
    std::string path_;
};

double area_of(const std::vector<std::vector<Vec3>>& facets)
{
    double sum = 0.0;
    for (const auto& f : facets) sum += norm(area_vector(f));
    return sum;
}

}  // namespace

TEST_CASE("STL, ASCII and binary, also with a binary header that says solid", "[stl]")
{
    const Triangles box = box_triangles({1, 2, 3});
    for (const std::string& text : {ascii(box), binary(box), binary(box, "solid binary")}) {
        const TriangleMesh mesh = StlFile(text).read();
        CHECK(mesh.vertices.size() == 8);
        CHECK(mesh.triangles.size() == 12);
        CHECK(why_not_closed(mesh).empty());
        const auto facets = convex_facets(mesh, 24);
        CHECK(facets.size() == 6);
        CHECK(area_of(facets) == Approx(22.0));
        for (const auto& f : facets) {
            CHECK(f.size() == 4);
            CHECK(dot(area_vector(f), polygon_centroid(f)) > 0.0);  // outwards
        }
    }
}

TEST_CASE("STL corners that differ in the last digit are one", "[stl]")
{
    Triangles box = box_triangles({1, 1, 1});
    for (std::size_t t = 0; t < box.size(); ++t) box[t][0].x += 1e-7 * static_cast<double>(t % 3);
    const TriangleMesh mesh = StlFile(ascii(box)).read();
    CHECK(mesh.vertices.size() == 8);
    CHECK(why_not_closed(mesh).empty());
}

TEST_CASE("STL files that are none, or hold no surface", "[stl]")
{
    const Triangles box = box_triangles({1, 1, 1});
    for (const char* text : {"", "hello\n", "solid nothing\nendsolid nothing\n"})
        CHECK(StlFile(text).refusal() == "has no triangles: it is empty, or no STL file");
    const std::string whole = ascii(box), packed = binary(box);
    CHECK(StlFile(whole.substr(0, whole.size() / 2)).refusal() ==
          "is no STL file, neither ASCII nor binary, or it ends too early");
    CHECK(StlFile(packed.substr(0, packed.size() / 2)).refusal() ==
          "is no STL file, neither ASCII nor binary, or it ends too early");
    Triangles wrong = box;
    wrong[3][1].y = std::numeric_limits<double>::quiet_NaN();
    CHECK(StlFile(binary(wrong)).refusal() == "has a coordinate that is not a finite number");
    wrong[3][1].y = std::numeric_limits<double>::infinity();
    CHECK(StlFile(binary(wrong)).refusal() == "has a coordinate that is not a finite number");
    CHECK(StlFile(binary({{Vec3{1, 1, 1}, Vec3{1, 1, 1}, Vec3{1, 1, 1}}})).refusal() == "has no extent");
    CHECK_THROWS_WITH(read_stl("/no/such.stl"), "\"/no/such.stl\" cannot be opened: No such file or directory");
    CHECK_THROWS_WITH(read_stl("/tmp"), "\"/tmp\" is a directory");
}

TEST_CASE("surfaces with a border, or with walls inside", "[stl]")
{
    Triangles box = box_triangles({1, 1, 1});
    const std::array<Vec3, 3> last = box.back();
    box.pop_back();
    CHECK(why_not_closed(StlFile(ascii(box)).read()) == "3 edges belong to one triangle only");
    box.push_back({last[0], last[2], last[1]});  // turned round
    CHECK(why_not_closed(StlFile(ascii(box)).read()) != "");
    box.back() = last;
    box.push_back(last);
    CHECK(why_not_closed(StlFile(ascii(box)).read()) ==
          "3 edges join more than two triangles, or two that are wound differently");
}

TEST_CASE("flat facets: one polygon where it is convex, convex pieces elsewhere", "[stl]")
{
    // a square of 5 x 5 squares whose diagonals alternate: inner vertices everywhere
    Triangles square, angle;
    const auto at = [](int i, int j) { return Vec3{0.1 * i, 0.1 * j, 0.0}; };
    for (int i = 0; i < 5; ++i) {
        for (int j = 0; j < 5; ++j) {
            Triangles two{{at(i, j), at(i + 1, j), at(i + 1, j + 1)}, {at(i, j), at(i + 1, j + 1), at(i, j + 1)}};
            if ((i + j) % 2 == 0) {
                two = {{at(i, j), at(i + 1, j), at(i, j + 1)}, {at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)}};
            }
            for (const auto& t : two) {
                square.push_back(t);
                if (i < 2 || j < 2) angle.push_back(t);
            }
        }
    }
    const auto facets = convex_facets(StlFile(ascii(square)).read(), 24);
    REQUIRE(facets.size() == 1);
    CHECK(facets[0].size() == 4);
    const auto pieces = convex_facets(StlFile(ascii(angle)).read(), 24);
    CAPTURE(pieces.size());
    CHECK(pieces.size() > 1);
    CHECK(pieces.size() < 16);
    CHECK(area_of(pieces) == Approx(0.25 - 0.09));
    for (const auto& p : pieces) CHECK(p.size() >= 3);
    // a disc of 60 sides has more corners than a contact can take
    Triangles disc;
    const auto rim = [](int k) {
        const double a = 2.0 * 3.14159265358979323846 * k / 60;
        return Vec3{std::cos(a), std::sin(a), 0.0};
    };
    for (int k = 0; k < 60; ++k) disc.push_back({Vec3{}, rim(k), rim(k + 1)});
    for (const auto& p : convex_facets(StlFile(ascii(disc)).read(), 24)) CHECK(p.size() <= 24);
}

TEST_CASE("a flat plate with a hole is a few convex facets, however many triangles it has", "[stl]")
{
    Triangles plate;
    constexpr int n = 30;
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j < n; ++j) {
            if (i >= n / 3 && i < 2 * n / 3 && j >= n / 3 && j < 2 * n / 3) continue;
            const auto at = [&](int k, int l) {
                return Vec3{static_cast<double>(i + k), static_cast<double>(j + l), 0.0};
            };
            plate.push_back({at(0, 0), at(1, 0), at(1, 1)});
            plate.push_back({at(0, 0), at(1, 1), at(0, 1)});
        }
    }
    const auto facets = convex_facets(StlFile(ascii(plate)).read(), 24);
    CAPTURE(facets.size());
    CHECK(facets.size() < 100);
    CHECK(area_of(facets) == Approx(n * n * 8.0 / 9.0));
}
