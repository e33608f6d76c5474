// SPDX-License-Identifier: GPL-3.0-or-later
#include "generate/fibre_line.h"

#include "generate/lattice.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace grainfrac {

namespace {

/// Pieces of a sine for its arc length and polyline. The chord of one is off by A (2 pi/n)^2/8 = 7.5e-5 A; the arc
/// length, by Gauss's rule in each, is exact to round-off.
constexpr int pieces_per_wave = 256;
/// With fewer nodes on a wave the chain is another curve.
constexpr double nodes_per_wave = 4.0;
/// Least distance of two nodes over the arc between them: below, the chain cuts the bend off, and nodes touch those
/// beyond their neighbours.
constexpr double least_chord = 0.8;

Vec3 side_of(const FibreSpec& f)
{
    return normalized(tangential(f.sideways, normalized(f.to - f.from)));
}

/// x = from + u t + A sin(k u) s, 0 <= u <= |to - from|.
struct Sine {
    Vec3 from, along, side;
    double length, amplitude, k;

    explicit Sine(const FibreSpec& f)
        : from(f.from),
          along(normalized(f.to - f.from)),
          side(side_of(f)),
          length(norm(f.to - f.from)),
          amplitude(f.amplitude),
          k(2.0 * std::numbers::pi / f.wavelength)
    {
    }
    Vec3 operator()(double u) const { return from + u * along + amplitude * std::sin(k * u) * side; }
    /// ds/du
    double speed(double u) const { return std::hypot(1.0, amplitude * k * std::cos(k * u)); }
    /// Arc length of [u, u + h], by three points of Gauss.
    double arc(double u, double h) const
    {
        const double m = u + 0.5 * h, g = 0.5 * h * std::sqrt(0.6);
        return h / 18.0 * (5.0 * speed(m - g) + 8.0 * speed(m) + 5.0 * speed(m + g));
    }
    int pieces() const
    {
        const double waves = length * k / (2.0 * std::numbers::pi);
        check_count("wavelength", waves);
        return std::max(1, static_cast<int>(std::ceil(waves * pieces_per_wave)));
    }
};

int whole_pieces(double length, double spacing)
{
    check_count("spacing", length / spacing);
    const int n = static_cast<int>(std::lround(length / spacing));
    if (n < 1) {
        throw InputError("spacing", fmt::format("makes a chain of one sphere: must be < {:.6g} m, twice the length of "
                                                "the fibre",
                                                2.0 * length));
    }
    return n;
}

FibreNodes sine_nodes(const FibreSpec& f, double spacing)
{
    if (f.wavelength < nodes_per_wave * spacing) {
        throw InputError("wavelength", fmt::format("must be >= {:.6g} m, four times the spacing of the spheres",
                                                   nodes_per_wave * spacing));
    }
    const Sine sine(f);
    const int m = sine.pieces();
    const double h = sine.length / m;
    std::vector<double> arc{0.0};
    for (int i = 0; i < m; ++i) arc.push_back(arc.back() + sine.arc(i * h, h));
    const int n = whole_pieces(arc.back(), spacing);
    FibreNodes nodes;
    nodes.piece = arc.back() / n;
    for (int i = 0; i <= n; ++i) {
        const double s = std::min(i * nodes.piece, arc.back());
        const auto above = std::lower_bound(arc.begin() + 1, arc.end() - 1, s);
        const auto j = static_cast<int>(above - arc.begin()) - 1;
        const double u = j * h;
        double step = 0.0;
        for (int k = 0; k < 4; ++k)  // Newton; the speed hardly changes within a piece
            step += (s - arc[static_cast<std::size_t>(j)] - sine.arc(u, step)) / sine.speed(u + step);
        nodes.position.push_back(sine(u + step));
    }
    return nodes;
}

FibreNodes polyline_nodes(const std::vector<Vec3>& corners, double spacing)
{
    std::vector<double> arc{0.0};
    for (std::size_t i = 1; i < corners.size(); ++i) arc.push_back(arc.back() + norm(corners[i] - corners[i - 1]));
    const int n = whole_pieces(arc.back(), spacing);
    FibreNodes nodes;
    nodes.piece = arc.back() / n;
    std::size_t j = 1;
    for (int i = 0; i < n; ++i) {
        const double s = arc.back() * i / n;
        while (j + 1 < arc.size() && arc[j] < s) ++j;
        nodes.position.push_back(corners[j - 1] +
                                 (s - arc[j - 1]) / (arc[j] - arc[j - 1]) * (corners[j] - corners[j - 1]));
    }
    nodes.position.push_back(corners.back());
    return nodes;
}

/// Chords that are much shorter than their arcs show a bend that the chain cannot follow.
void check_bends(const FibreSpec& f, const FibreNodes& nodes)
{
    for (std::size_t i = 1; i < nodes.position.size(); ++i) {
        const double chord = norm(nodes.position[i] - nodes.position[i - 1]);
        if (chord >= least_chord * nodes.piece) continue;
        const char* key = f.shape == "wavy" ? "amplitude" : (f.shape == "hooked" ? "hook_angle" : "points");
        throw InputError(key, fmt::format("bends too sharply for the spacing of the spheres: two that are {:.6g} m "
                                          "apart along the fibre are {:.6g} m apart",
                                          nodes.piece, chord));
    }
}

}  // namespace

std::vector<Vec3> fibre_polyline(const FibreSpec& f)
{
    if (f.shape == "points") return f.points;
    if (f.shape == "wavy") {
        const Sine sine(f);
        const int m = sine.pieces();
        std::vector<Vec3> corners;
        for (int i = 0; i <= m; ++i) corners.push_back(sine(sine.length * i / m));
        return corners;
    }
    if (f.shape == "hooked") {
        const Vec3 along = normalized(f.to - f.from), side = side_of(f);
        const Vec3 bend = f.from + f.hook_length * (std::sin(f.hook_angle) * side - std::cos(f.hook_angle) * along);
        return {bend - f.hook_length * along, bend, f.from, f.to};
    }
    return {f.from, f.to};
}

FibreNodes fibre_nodes(const FibreSpec& f, double spacing)
{
    if (f.shape == "hooked" && f.hook_length < spacing)
        throw InputError("hook_length", fmt::format("must be >= {:.6g} m, the spacing of the spheres", spacing));
    FibreNodes nodes = f.shape == "wavy" ? sine_nodes(f, spacing) : polyline_nodes(fibre_polyline(f), spacing);
    check_bends(f, nodes);
    return nodes;
}

double distance_to_polyline(const Vec3& x, const std::vector<Vec3>& corners)
{
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 1; i < corners.size(); ++i) {
        const Vec3 edge = corners[i] - corners[i - 1];
        const double along = std::clamp(dot(x - corners[i - 1], edge) / norm2(edge), 0.0, 1.0);
        nearest = std::min(nearest, norm(x - corners[i - 1] - along * edge));
    }
    return nearest;
}

}  // namespace grainfrac
