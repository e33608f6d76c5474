// SPDX-License-Identifier: GPL-3.0-or-later
#include "generate/microstructure.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cstdio>
#include <fstream>
#include <stdexcept>

namespace grainfrac {

namespace {

using nlohmann::json;

constexpr const char* format_name = "grainfrac microstructure 1";

json to_json(const Vec3& a)
{
    return {a.x, a.y, a.z};
}

double finite_number(const json& j, const char* what)
{
    if (!j.is_number() || !std::isfinite(j.get<double>()))
        throw std::runtime_error(fmt::format("{}: a finite number expected", what));
    return j.get<double>();
}

Vec3 vector_from(const json& j, const char* what)
{
    if (!j.is_array() || j.size() != 3) throw std::runtime_error(fmt::format("{}: three numbers expected", what));
    return {finite_number(j[0], what), finite_number(j[1], what), finite_number(j[2], what)};
}

/// Indices of a face's vertices.
std::vector<int> corners_from(const json& j, std::size_t vertices)
{
    std::vector<int> corners;
    for (const json& c : j) {
        if (!c.is_number_integer() || c.get<double>() < 0.0 || c.get<double>() >= static_cast<double>(vertices))
            throw std::runtime_error(fmt::format("faces: numbers of vertices expected, 0 to {}", vertices - 1));
        corners.push_back(c.get<int>());
    }
    return corners;
}

GrainSpec grain_from(const json& j)
{
    GrainSpec g;
    std::vector<Vec3> vertices;
    std::vector<std::vector<int>> faces;
    for (const json& v : j.at("vertices")) vertices.push_back(vector_from(v, "vertices"));
    for (const json& f : j.at("faces")) faces.push_back(corners_from(f, vertices.size()));
    g.shape = make_polyhedron(std::move(vertices), std::move(faces));
    if (const std::string why = why_not_convex(g.shape); !why.empty()) throw std::runtime_error(why);
    g.site = vector_from(j.at("site"), "site");
    const json& q = j.at("crystal");
    if (!q.is_array() || q.size() != 4) throw std::runtime_error("crystal: four numbers w x y z expected");
    g.crystal = normalized(Quat{finite_number(q[0], "crystal"), finite_number(q[1], "crystal"),
                                finite_number(q[2], "crystal"), finite_number(q[3], "crystal")});
    g.dilation_radius = finite_number(j.at("dilation_radius"), "dilation_radius");
    if (g.dilation_radius <= 0.0) throw std::runtime_error("dilation_radius: must be > 0 m");
    return g;
}

}  // namespace

void write_microstructure(const std::filesystem::path& file, const std::vector<GrainSpec>& grains,
                          const std::string& title)
{
    json list = json::array();
    for (const GrainSpec& g : grains) {
        json vertices = json::array();
        for (const Vec3& v : g.shape.vertices) vertices.push_back(to_json(v));
        list.push_back({{"vertices", std::move(vertices)},
                        {"faces", g.shape.faces},
                        {"site", to_json(g.site)},
                        {"crystal", {g.crystal.w, g.crystal.x, g.crystal.y, g.crystal.z}},
                        {"dilation_radius", g.dilation_radius}});
    }
    const json document = {{"format", format_name}, {"title", title}, {"units", "m"}, {"grains", std::move(list)}};
    const std::filesystem::path aside = file.string() + ".tmp";
    {
        std::ofstream out(aside);
        out << document.dump(1) << '\n';
        if (!out.flush()) throw std::runtime_error(fmt::format("cannot write \"{}\"", aside.string()));
    }
    std::filesystem::rename(aside, file);
}

std::vector<GrainSpec> read_microstructure(const std::filesystem::path& file)
{
    std::ifstream in(file);
    if (!in || std::filesystem::is_directory(file))
        throw std::runtime_error(fmt::format("cannot read \"{}\"", file.string()));
    std::vector<GrainSpec> grains;
    try {
        const json document = json::parse(in);
        if (document.at("format") != format_name)
            throw std::runtime_error(fmt::format("format is not \"{}\"", format_name));
        for (const json& j : document.at("grains")) {
            try {
                grains.push_back(grain_from(j));
            } catch (const std::exception& e) {
                throw std::runtime_error(fmt::format("grain {}: {}", grains.size(), e.what()));
            }
        }
    } catch (const std::exception& e) {
        throw std::runtime_error(fmt::format("\"{}\": {}", file.string(), e.what()));
    }
    if (grains.empty()) throw std::runtime_error(fmt::format("\"{}\": holds no grains", file.string()));
    return grains;
}

}  // namespace grainfrac
