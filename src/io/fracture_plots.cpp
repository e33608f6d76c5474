// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/figure.h"
#include "io/plots.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace grainfrac {

namespace {

/// Cumulative mass [%] over the logarithm of the size as a stair, from the smallest piece to the largest.
struct Stair {
    std::vector<double> x, y;
};

Stair stair_of(const SizeDistribution& d, double factor)
{
    Stair s;
    for (std::size_t i = 0; i < d.diameter.size(); ++i) {
        const double x = std::log10(d.diameter[i] * factor);
        s.x.insert(s.x.end(), {x, x});
        s.y.insert(s.y.end(), {i == 0 ? 0.0 : s.y.back(), 100.0 * d.mass_up_to[i]});
    }
    return s;
}

/// "[10\u207b\u2076]" for parts in a million.
std::string power_of_ten(double factor)
{
    static const char* digits[] = {"\u2070", "\u00b9", "\u00b2", "\u00b3", "\u2074",
                                   "\u2075", "\u2076", "\u2077", "\u2078", "\u2079"};
    const int exponent = static_cast<int>(std::lround(-std::log10(factor)));
    if (exponent == 0) return "[-]";
    std::string text = exponent < 0 ? "\u207b" : "";
    for (const char c : std::to_string(std::abs(exponent))) text += digits[c - '0'];
    return "[10" + text + "]";
}

}  // namespace

SizeDistribution size_distribution(std::vector<std::pair<double, double>> pieces)
{
    std::sort(pieces.begin(), pieces.end());
    double total = 0.0, finer = 0.0;
    for (const auto& [diameter, mass] : pieces) total += diameter > 0.0 ? mass : 0.0;
    SizeDistribution d;
    for (const auto& [diameter, mass] : pieces) {
        if (!(diameter > 0.0)) continue;
        finer += mass;
        d.diameter.push_back(diameter);
        d.mass_up_to.push_back(finer / total);
    }
    return d;
}

void plot_fragment_sizes(const std::filesystem::path& stem, const std::vector<Fragment>& fragments,
                         const std::vector<Cluster>& clusters)
{
    const auto sizes = [](const auto& entries) {
        std::vector<std::pair<double, double>> pieces;
        for (const auto& e : entries) pieces.emplace_back(e.shape.equivalent_diameter(), e.shape.mass);
        return size_distribution(std::move(pieces));
    };
    const SizeDistribution bodies = sizes(fragments), bonded = sizes(clusters);
    Range range{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
    for (const SizeDistribution* d : {&bodies, &bonded}) {
        for (const double diameter : d->diameter) range.add(diameter);
    }
    if (!(range.high > 0.0)) range = {1.0, 1.0};
    const Prefix prefix = prefix_for(range.high);
    // Whole decades around the data: with less, the logarithmic axis may show no number at all.
    range = {std::floor(std::log10(range.low * prefix.factor) - 0.05),
             std::ceil(std::log10(range.high * prefix.factor) + 0.05)};
    const Stair fine = stair_of(bodies, prefix.factor), coarse = stair_of(bonded, prefix.factor);
    const Frame frame{0.11, 0.72, 0.13, 0.88};
    draw_figure(stem, [&] {
        draw_title("Sizes of the fragments");
        draw_axes(frame, range, {0.0, 105.0}, "Diameter of the ball of equal volume [" + prefix.name + "m]",
                  "Mass of pieces up to this size [%]", {.logarithmic_x = true});
        draw_line(fine.x, fine.y, Ink::red, 2.5);
        draw_line(coarse.x, coarse.y, Ink::blue, 2.5);
        draw_legend(frame.right + 0.02, frame.top - 0.02,
                    {{Ink::red, 2.5, fmt::format("grains and parts ({})", fragments.size())},
                     {Ink::blue, 2.5, fmt::format("bonded clusters ({})", clusters.size())}});
    });
}

TransgranularShare transgranular_share(const HistoryTable& history)
{
    const std::vector<double>&strain = history.column("nominal_strain"), &time = history.column("time_s"),
          &between = history.column("intergranular_area_m2"), &through = history.column("transgranular_area_m2"),
          &work = history.column("fracture_work_J"), &work_through = history.column("transgranular_fracture_work_J");
    TransgranularShare s;
    s.over_strain = std::any_of(strain.begin(), strain.end(), [](double v) { return v != 0.0; });
    s.x = s.over_strain ? strain : time;
    const auto ratio = [](double part, double whole) {
        return whole > 0.0 ? part / whole : std::numeric_limits<double>::quiet_NaN();
    };
    for (std::size_t i = 0; i < history.rows(); ++i) {
        s.of_area.push_back(ratio(through[i], between[i] + through[i]));
        s.of_work.push_back(ratio(work_through[i], work[i]));
    }
    return s;
}

void plot_transgranular_share(const std::filesystem::path& stem, const HistoryTable& history)
{
    TransgranularShare s = transgranular_share(history);
    Range x{0.0, 0.0};
    for (const double v : s.x) x.add(v);
    const Prefix prefix = prefix_for(x.high);
    for (double& v : s.x) v *= prefix.factor;
    x = Range{x.low * prefix.factor, x.high * prefix.factor}.widened(0.0);
    x.high += 0.02 * (x.high - x.low);
    for (auto* values : {&s.of_area, &s.of_work}) {
        for (double& v : *values) v *= 100.0;
    }
    const std::string label =
        s.over_strain ? "Nominal strain " + power_of_ten(prefix.factor) : "Time [" + prefix.name + "s]";
    const bool nothing = std::all_of(s.of_work.begin(), s.of_work.end(), [](double v) { return std::isnan(v); });
    Frame frame;
    frame.right = 0.74;
    draw_figure(stem, [&] {
        draw_title("Share of the cracks that runs through grains");
        draw_axes(frame, x, {0.0, 105.0}, label, "Share [%]");
        draw_line(s.x, s.of_area, curve_ink(0), 2.5);
        draw_line(s.x, s.of_work, curve_ink(1), 2.5);
        if (nothing) draw_page_text(0.5 * (frame.left + frame.right), 0.5, 0.5, 1.0, "no cracks");
        draw_legend(frame.right + 0.02, frame.top - 0.02,
                    {{curve_ink(0), 2.5, "of the crack area"}, {curve_ink(1), 2.5, "of the fracture work"}});
    });
}

}  // namespace grainfrac
