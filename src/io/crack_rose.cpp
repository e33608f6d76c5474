// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/figure.h"
#include "io/plots.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace grainfrac {

namespace {

constexpr double flat_face = 0.7;  // as in the crack map: faces nearer to the xy plane have no trace
constexpr double page_aspect = 4.0 / 3.0;

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

struct RoseScale {
    double step = 1.0, radius = 1.0;  // of the rings, of the outermost
};

RoseScale scale_for(const CrackRose& rose)
{
    const double largest = *std::max_element(rose.share.begin(), rose.share.end());
    if (!(largest > 0.0)) return {};
    const double step = ring_step(largest);
    return {step, step * std::ceil(largest / step * 0.999)};
}

void draw_rose(const CrackRose& rose, const Frame& frame, Ink fill, Ink edge)
{
    const RoseScale scale = scale_for(rose);
    // The window has the aspect of its frame, so that the rings are round.
    const double radius = scale.radius, width = (frame.right - frame.left) * page_aspect,
                 height = frame.top - frame.bottom;
    const double half = 1.22 * radius / std::min(width, height);
    draw_plain_window(frame, {-half * width, half * width}, {-half * height, half * height});
    const auto circle = [&](double r, Ink ink) {
        std::vector<double> px, py;
        add_arc(px, py, r, 0.0, 2.0 * std::numbers::pi);
        draw_line(px, py, ink, 1.0);
    };
    for (double r = scale.step; r < radius * 1.001; r += scale.step) circle(r, Ink::light_grey);
    for (int degrees = 0; degrees < 360; degrees += 30) {
        const double angle = degrees * std::numbers::pi / 180.0, c = std::cos(angle), s = std::sin(angle);
        draw_line({0.0, radius * c}, {0.0, radius * s}, Ink::light_grey, 1.0);
        draw_text(1.11 * radius * c, 1.11 * radius * s, 0.5, 0.8, fmt::format("{}\u00b0", degrees));
    }
    constexpr double sector = std::numbers::pi / CrackRose::sectors;
    for (int k = 0; k < 2 * CrackRose::sectors; ++k) {
        const double share = rose.share[static_cast<std::size_t>(k % CrackRose::sectors)];
        if (share == 0.0) continue;
        std::vector<double> px{0.0}, py{0.0};
        add_arc(px, py, share, (k - 0.5) * sector, (k + 0.5) * sector);
        px.push_back(0.0);
        py.push_back(0.0);
        fill_polygon(px, py, fill);
        draw_line(px, py, edge, 1.2);
    }
    if (rose.area == 0.0) {
        draw_text(0.0, -0.5 * radius, 0.5, 1.0, "no cracks");
        return;
    }
    // Last, over the sectors; between the directions that lattices of grains prefer.
    constexpr double label = 45.0 * std::numbers::pi / 180.0;
    for (double r = scale.step; r < radius * 1.001; r += scale.step)
        draw_text(r * std::cos(label), r * std::sin(label), 0.5, 0.7, fmt::format("{:g} %", 100.0 * r));
}

std::string area_text(const char* where, const CrackRose& rose)
{
    return fmt::format("{}: {:.4g} mm\u00b2", where, 1e6 * rose.area);
}

}  // namespace

CrackRose crack_rose(const std::vector<CrackFace>& cracks, int mode)
{
    constexpr int sectors = CrackRose::sectors;
    CrackRose rose;
    for (const CrackFace& crack : cracks) {
        if (crack.mode != mode || std::fabs(crack.normal.z) > flat_face) continue;
        // A direction on a sector's border belongs to both; rounding must not choose.
        const double angle = std::atan2(crack.normal.x, -crack.normal.y) / std::numbers::pi * sectors + 0.5;
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

void plot_crack_orientation(const std::filesystem::path& stem, const std::vector<CrackFace>& cracks)
{
    const CrackRose between = crack_rose(cracks, 0), through = crack_rose(cracks, 1);
    draw_figure(stem, [&] {
        draw_title("Directions of the cracks in the xy plane",
                   "share of the crack area in each 10\u00b0; 0\u00b0 is x");
        if (through.area == 0.0) {
            draw_rose(between, {0.05, 0.95, 0.08, 0.90}, Ink::sky, Ink::blue);
            draw_page_text(0.5, 0.04, 0.5, 0.9, area_text("between grains", between));
            return;
        }
        draw_rose(between, {0.01, 0.50, 0.15, 0.87}, Ink::sky, Ink::blue);
        draw_rose(through, {0.50, 0.99, 0.15, 0.87}, Ink::green, Ink::grey);
        draw_page_text(0.255, 0.12, 0.5, 0.9, area_text("between grains", between));
        draw_page_text(0.745, 0.12, 0.5, 0.9, area_text("through grains", through));
    });
}

}  // namespace grainfrac
