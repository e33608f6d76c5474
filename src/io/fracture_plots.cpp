// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/figure.h"
#include "io/plots.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace grainfrac {

namespace {

constexpr int sectors = 18;        // of 10 degrees, over half a turn: a trace has no sense of direction
constexpr double flat_face = 0.7;  // as in the crack map: faces nearer to the xy plane have no trace

struct Rose {
    std::array<double, sectors> share{};  // of the traced area
    double area = 0.0;                    // [m^2]
};

Rose rose_of(const std::vector<CrackFace>& cracks)
{
    Rose rose;
    for (const CrackFace& crack : cracks) {
        if (std::fabs(crack.normal.z) > flat_face) continue;
        // A direction on a sector's border belongs to both; rounding must not choose.
        const double angle = std::atan2(crack.normal.x, -crack.normal.y) / std::numbers::pi * sectors;
        const double place = angle - sectors * std::floor(angle / sectors), nearest = std::round(place);
        const auto add = [&](double sector, double area) {
            rose.share[static_cast<std::size_t>(static_cast<int>(sector + 2 * sectors) % sectors)] += area;
        };
        if (std::fabs(place - nearest) < 1e-6) {
            add(nearest, 0.5 * crack.area);
            add(nearest - 1.0, 0.5 * crack.area);
        } else {
            add(std::floor(place), crack.area);
        }
        rose.area += crack.area;
    }
    for (double& share : rose.share) share /= rose.area > 0.0 ? rose.area : 1.0;
    return rose;
}

void add_arc(std::vector<double>& x, std::vector<double>& y, double radius, double from, double to)
{
    const int steps = std::max(4, static_cast<int>(std::ceil((to - from) / (std::numbers::pi / 90.0))));
    for (int k = 0; k <= steps; ++k) {
        const double angle = from + (to - from) * k / steps;
        x.push_back(radius * std::cos(angle));
        y.push_back(radius * std::sin(angle));
    }
}

/// Distance of the rings: 1, 2 or 5 times a power of ten, three to six of them.
double ring_step(double largest)
{
    const double rough = largest / 4.0, power = std::pow(10.0, std::floor(std::log10(rough)));
    for (const double step : {1.0, 2.0, 5.0}) {
        if (step * power >= rough * 0.999) return step * power;
    }
    return 10.0 * power;
}

}  // namespace

void plot_crack_orientation(const std::filesystem::path& stem, const std::vector<CrackFace>& cracks)
{
    const Rose rose = rose_of(cracks);
    const double largest = *std::max_element(rose.share.begin(), rose.share.end());
    const double step = ring_step(largest > 0.0 ? largest : 1.0), outer = step * std::ceil(largest / step * 0.999);
    const double radius = largest > 0.0 ? outer : 1.0;
    draw_figure(stem, [&] {
        draw_title("Directions of the cracks in the xy plane",
                   "share of the crack area in each 10\u00b0; 0\u00b0 is x");
        // The page is 4:3; the window has the same aspect, so that the rings are round.
        const Range x{-1.6 * radius, 1.6 * radius}, y{-1.2 * radius, 1.2 * radius};
        draw_plain_window({0.05, 0.95, 0.01, 0.91}, x, y);
        constexpr double width = std::numbers::pi / sectors;
        for (int k = 0; k < 2 * sectors; ++k) {
            std::vector<double> px{0.0}, py{0.0};
            add_arc(px, py, rose.share[static_cast<std::size_t>(k % sectors)], k * width, (k + 1) * width);
            px.push_back(0.0);
            py.push_back(0.0);
            fill_polygon(px, py, Ink::sky);
            draw_line(px, py, Ink::blue, 1.2);
        }
        for (double r = step; r < radius * 1.001; r += step) {
            std::vector<double> px, py;
            add_arc(px, py, r, 0.0, 2.0 * std::numbers::pi);
            draw_line(px, py, Ink::light_grey, 1.0);
            draw_text(r * std::cos(1.31), r * std::sin(1.31), 0.5, 0.7, fmt::format("{:g} %", 100.0 * r));
        }
        for (int degrees = 0; degrees < 360; degrees += 30) {
            const double angle = degrees * std::numbers::pi / 180.0, c = std::cos(angle), s = std::sin(angle);
            draw_line({0.0, radius * c}, {0.0, radius * s}, Ink::light_grey, 1.0);
            draw_text(1.09 * radius * c, 1.09 * radius * s, 0.5, 0.85, fmt::format("{}\u00b0", degrees));
        }
        if (rose.area == 0.0) draw_page_text(0.5, 0.46, 0.5, 1.0, "no cracks");
    });
}

void plot_fragment_sizes(const std::filesystem::path& stem, const std::vector<Fragment>& fragments)
{
    std::vector<std::pair<double, double>> pieces;  // diameter of the ball of equal volume [m], mass [kg]
    double mass = 0.0;
    for (const Fragment& fragment : fragments) {
        if (!(fragment.volume > 0.0)) continue;
        pieces.emplace_back(std::cbrt(6.0 * fragment.volume / std::numbers::pi), fragment.mass);
        mass += fragment.mass;
    }
    std::sort(pieces.begin(), pieces.end());
    const Prefix prefix = prefix_for(pieces.empty() ? 1.0 : pieces.back().first);
    std::vector<double> x, y;  // stairs: log10 of the diameter, per cent finer
    double finer = 0.0;
    const auto exponent = [&](double diameter) { return std::log10(diameter * prefix.factor); };
    Range range = pieces.empty() ? Range{} : Range{exponent(pieces.front().first), exponent(pieces.back().first)};
    // Whole decades around the data: with less, the logarithmic axis may show no number at all.
    range = {std::floor(range.low - 0.05), std::ceil(range.high + 0.05)};
    x.push_back(range.low);
    y.push_back(0.0);
    for (const auto& [diameter, piece] : pieces) {
        x.insert(x.end(), {exponent(diameter), exponent(diameter)});
        y.push_back(finer);
        finer += 100.0 * piece / mass;
        y.push_back(finer);
    }
    x.push_back(range.high);
    y.push_back(finer);
    draw_figure(stem, [&] {
        draw_title("Sizes of the fragments",
                   fmt::format("{} fragment{}", pieces.size(), pieces.size() == 1 ? "" : "s"));
        draw_axes({0.11, 0.95, 0.13, 0.88}, range, {0.0, 105.0},
                  "Diameter of the ball of equal volume [" + prefix.name + "m]", "Mass of smaller fragments [%]",
                  {.logarithmic_x = true});
        draw_line(x, y, Ink::blue, 2.5);
    });
}

}  // namespace grainfrac
