// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/wall_history.h"

#include "io/csv_row.h"

#include <fmt/format.h>

#include <cmath>

namespace grainfrac {

namespace {

/// Sums over the contact points of a wall, weighted by force.
struct Gyration {
    double weight = 0.0;
    Vec3 first;  // moments about a point near by: small differences of large numbers lose digits
    double second = 0.0;
    Vec3 origin;
    int points = 0;

    void add(double f, const Vec3& x)
    {
        if (points++ == 0) origin = x;
        const Vec3 d = x - origin;
        weight += f;
        first += f * d;
        second += f * norm2(d);
    }
    double radius2() const { return weight > 0.0 ? second / weight - norm2(first / weight) : 0.0; }
};

template <class Visit>
void for_each_column(const std::string& name, const WallRow& r, Visit&& visit)
{
    visit(name + "_force_x_N", r.force.x);
    visit(name + "_force_y_N", r.force.y);
    visit(name + "_force_z_N", r.force.z);
    visit(name + "_position_x_m", r.position.x);
    visit(name + "_position_y_m", r.position.y);
    visit(name + "_position_z_m", r.position.z);
    visit(name + "_contacts", r.contacts);
    visit(name + "_contact_radius_m", r.contact_radius);
}

std::string head(const RunFacts& facts, const Model& model)
{
    std::string names = "time_s";
    for (const std::string& wall : model.walls)
        for_each_column(wall, {}, [&](const std::string& name, auto) { names += ',' + name; });
    return fmt::format(
        "# grainfrac {}\n# test: {}\n# seed: {}\n# input: {}\n"
        "# forces are those on the wall or grip; SI units, named at the end of each column\n{}\n",
        facts.version, facts.test_kind, facts.seed, facts.input_hash, names);
}

}  // namespace

std::vector<WallRow> wall_rows(const Model& model, const State& state)
{
    const Bodies& b = state.bodies;
    std::vector<WallRow> rows(model.walls.size());
    std::vector<Gyration> spread(model.walls.size());
    for (int i = 0; i < b.size(); ++i) {
        if (b.wall[i] < 0) continue;
        WallRow& r = rows[static_cast<std::size_t>(b.wall[i])];
        r.force += b.force[i];
        if (b.inverse_mass[i] > 0.0) r.force -= b.mass[i] * model.gravity;
        r.position += b.position[i];
        ++r.bodies;
    }
    const Contacts& c = state.contacts;
    state.for_each_contact([&](int i) {
        const double force = norm(state.slots.force[state.bond_slots() + i]);
        if (c.active[i] != 1 || force == 0.0) return;
        for (const int body : {c.a[i], c.b[i]}) {
            if (b.wall[body] < 0) continue;
            spread[static_cast<std::size_t>(b.wall[body])].add(force, c.point[i].position);
        }
    });
    for (std::size_t w = 0; w < rows.size(); ++w) {
        if (rows[w].bodies > 0) rows[w].position *= 1.0 / rows[w].bodies;
        rows[w].contacts = spread[w].points;
        rows[w].contact_radius = std::sqrt(2.0 * std::fmax(0.0, spread[w].radius2()));
    }
    return rows;
}

WallHistory::WallHistory(std::filesystem::path path, const RunFacts& facts, const Model& model)
    : file_(std::move(path), head(facts, model))
{
}

void WallHistory::append(const Model& model, const State& state)
{
    std::string line;
    append_cell(line, state.time);
    for (const WallRow& r : wall_rows(model, state))
        for_each_column("", r, [&](const std::string&, auto value) { append_cell(line, value); });
    file_.append(line + '\n');
}

}  // namespace grainfrac
