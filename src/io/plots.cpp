// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/plots.h"

#include "io/figure.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

namespace grainfrac {

namespace {

Range range_of(const std::vector<Curve>& curves, std::vector<double> Curve::*values)
{
    Range range{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
    for (const Curve& curve : curves) {
        for (const double value : curve.*values) range.add(value);
    }
    return range;
}

double largest(const Range& range)
{
    return std::max(std::fabs(range.low), std::fabs(range.high));
}

std::vector<double> scaled(std::vector<double> values, double factor)
{
    for (double& value : values) value *= factor;
    return values;
}

bool is_zero(const std::vector<double>& values)
{
    return std::all_of(values.begin(), values.end(), [](double value) { return value == 0.0; });
}

}  // namespace

void plot_curves(const std::filesystem::path& stem, const std::string& title, const std::string& x_label,
                 const std::string& y_label, const std::vector<Curve>& curves)
{
    Range x = range_of(curves, &Curve::x), y = range_of(curves, &Curve::y);
    const ScaledLabel sx = scaled_label(x_label, largest(x)), sy = scaled_label(y_label, largest(y));
    y.add(0.0);
    x = Range{x.low * sx.factor, x.high * sx.factor}.widened(0.0);
    x.high += 0.02 * (x.high - x.low);
    y = Range{y.low * sy.factor, y.high * sy.factor}.widened(0.04);
    Frame frame;
    if (curves.size() > 1) frame.right = 0.71;
    draw_figure(stem, [&] {
        draw_title(title);
        draw_axes(frame, x, y, sx.label, sy.label);
        for (std::size_t i = 0; i < curves.size(); ++i)
            draw_line(scaled(curves[i].x, sx.factor), scaled(curves[i].y, sy.factor), curve_ink(i), 2.0);
        std::vector<LegendEntry> legend;
        for (std::size_t i = 0; i < curves.size(); ++i) legend.push_back({curve_ink(i), 2.5, curves[i].label});
        if (curves.size() > 1) draw_legend(frame.right + 0.02, frame.top - 0.02, legend);
    });
}

void plot_load_displacement(const std::filesystem::path& stem, const HistoryTable& history, bool has_platens)
{
    plot_curves(stem, "Load against displacement", has_platens ? "Platen displacement [m]" : "Displacement [m]",
                "Load [N]", {{"load", history.column("displacement_m"), history.column("load_N")}});
}

void plot_wall_forces(const std::filesystem::path& stem, const HistoryTable& walls)
{
    constexpr double seen = 0.02;           // of the largest component: smaller ones lie on the axis
    constexpr std::size_t most_curves = 9;  // as many inks
    std::vector<std::pair<double, Curve>> found;
    for (const std::string& name : walls.names) {
        for (const char axis : {'x', 'y', 'z'}) {
            const std::string tail = std::string("_force_") + axis + "_N";
            if (!name.ends_with(tail)) continue;
            const std::vector<double>& force = walls.column(name);
            double most = 0.0;
            for (const double f : force) most = std::max(most, std::fabs(f));
            found.push_back(
                {most, {name.substr(0, name.size() - tail.size()) + ", " + axis, walls.column("time_s"), force}});
        }
    }
    const auto stronger = [](const auto& a, const auto& b) { return a.first > b.first; };
    std::stable_sort(found.begin(), found.end(), stronger);
    std::vector<Curve> curves;
    for (auto& [most, curve] : found) {
        if (most > 0.0 && most >= seen * found.front().first && curves.size() < most_curves) curves.push_back(curve);
    }
    if (curves.empty()) return;
    plot_curves(stem, "Forces on walls and grips", "Time [s]", "Force [N]", curves);
}

void plot_energies(const std::filesystem::path& stem, const HistoryTable& history)
{
    const std::vector<std::pair<const char*, const char*>> terms{{"external work", "external_work_J"},
                                                                 {"elastic, bonds", "elastic_energy_bonds_J"},
                                                                 {"elastic, contacts", "elastic_energy_contacts_J"},
                                                                 {"kinetic", "kinetic_energy_J"},
                                                                 {"fracture", "fracture_work_J"},
                                                                 {"friction", "friction_work_J"},
                                                                 {"damping", "damping_work_J"},
                                                                 {"gravity", "gravity_work_J"},
                                                                 {"inserted", "inserted_energy_J"}};
    std::vector<Curve> curves;
    for (const auto& [label, column] : terms) {
        const std::vector<double>& values = history.column(column);
        if (!is_zero(values)) curves.push_back({label, history.column("time_s"), values});
    }
    plot_curves(stem, "Energies", "Time [s]", "Energy [J]", curves);
}

void write_plots(const std::filesystem::path& folder, const Model& model, const State& state,
                 const std::vector<CrackFace>& cracks, const std::vector<Fragment>& fragments,
                 const std::vector<Cluster>& clusters)
{
    const std::filesystem::path plots = folder / "plots";
    std::string failures;
    const auto attempt = [&](const std::function<void()>& plot) {
        try {
            plot();
        } catch (const std::exception& error) {
            failures += (failures.empty() ? "" : "; ");
            failures += error.what();
        }
    };
    const bool has_walls = std::filesystem::exists(folder / "walls.csv");
    attempt([&] {
        plot_load_displacement(plots / "load_displacement", read_history_csv(folder / "history.csv"), !has_walls);
    });
    if (has_walls) attempt([&] { plot_wall_forces(plots / "wall_forces", read_history_csv(folder / "walls.csv")); });
    attempt([&] { plot_energies(plots / "energies", read_history_csv(folder / "history.csv")); });
    attempt([&] { plot_crack_map(plots / "crack_map", model, state, cracks); });
    attempt([&] { plot_crack_orientation(plots / "crack_orientation", cracks); });
    attempt([&] { plot_transgranular_share(plots / "transgranular_share", read_history_csv(folder / "history.csv")); });
    attempt([&] { plot_fragment_sizes(plots / "fragment_sizes", fragments, clusters); });
    if (!failures.empty()) throw std::runtime_error(failures);
}

}  // namespace grainfrac
