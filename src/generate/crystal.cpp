// SPDX-License-Identifier: GPL-3.0-or-later
#include "generate/crystal.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <set>
#include <stdexcept>

namespace grainfrac {

namespace {

/// Six turns about c and six half turns about the a and [10-10] directions.
std::array<Quat, 12> hexagonal_symmetry()
{
    std::array<Quat, 12> s;
    for (int k = 0; k < 6; ++k) {
        const double angle = k * std::numbers::pi / 3.0;
        s[static_cast<std::size_t>(k)] = from_axis_angle({0, 0, 1}, angle);
        s[static_cast<std::size_t>(k) + 6] =
            from_axis_angle({std::cos(0.5 * angle), std::sin(0.5 * angle), 0}, std::numbers::pi);
    }
    return s;
}

using Indices = std::array<int, 4>;

/// Of a plane's two sides the one that counts: l > 0, else the angle of the normal from a_1 in [0, 180) degrees.
Indices one_side(const Indices& p)
{
    // y of the normal is proportional to h + 2k = k - i, x to h
    const int y = p[1] - p[2];
    const bool keep = p[3] != 0 ? p[3] > 0 : (y != 0 ? y > 0 : p[0] > 0);
    return keep ? p : Indices{-p[0], -p[1], -p[2], -p[3]};
}

/// Class 6/mmm: any order of h, k, i, and any signs of (h k i) and l.
std::set<Indices> equal_planes(const CrystalPlanes& planes)
{
    std::set<Indices> all;
    std::array<int, 3> basal{planes.h, planes.k, planes.i};
    if (!planes.all_variants) return {one_side({planes.h, planes.k, planes.i, planes.l})};
    std::sort(basal.begin(), basal.end());
    do {
        for (const int sign : {1, -1})
            all.insert(one_side({sign * basal[0], sign * basal[1], sign * basal[2], planes.l}));
    } while (std::next_permutation(basal.begin(), basal.end()));
    return all;
}

/// h a_1* + k a_2* + l c* in units of 1/a.
Vec3 normal_of(const Indices& p, double c_over_a)
{
    return normalized(Vec3{static_cast<double>(p[0]), (p[0] + 2 * p[1]) / std::sqrt(3.0), p[3] / c_over_a});
}

}  // namespace

double hexagonal_misorientation(const Quat& q_a, const Quat& q_b)
{
    static const std::array<Quat, 12> symmetry = hexagonal_symmetry();
    const Quat between = conjugate(q_a) * q_b;
    double least = std::numbers::pi;
    for (const Quat& s : symmetry) least = std::min(least, norm(rotation_vector(between * s)));
    return least;
}

double read_shockley(double theta, double theta_m)
{
    if (theta >= theta_m) return 1.0;
    if (theta <= 0.0) return 0.0;
    const double t = theta / theta_m;
    return t * (1.0 - std::log(t));
}

double boundary_toughness_factor(double theta, double theta_m, double chi)
{
    return 1.0 - chi * read_shockley(theta, theta_m);
}

CrystalPlanes parse_crystal_planes(const std::string& text)
{
    const auto refuse = [&](const std::string& why) {
        throw std::invalid_argument("\"" + text + "\" is no crystal plane: " + why +
                                    "; expected Miller-Bravais indices, e.g. \"{10-10}\" or \"(0001)\"");
    };
    const bool braces = text.size() > 1 && text.front() == '{' && text.back() == '}';
    const bool parentheses = text.size() > 1 && text.front() == '(' && text.back() == ')';
    if (!braces && !parentheses) refuse("it stands neither in {} nor in ()");
    std::vector<int> indices;
    int sign = 1;
    for (std::size_t at = 1; at + 1 < text.size(); ++at) {
        const char c = text[at];
        if (c == '-' && sign > 0) {
            sign = -1;
        } else if (c >= '0' && c <= '9') {
            indices.push_back(sign * (c - '0'));
            sign = 1;
        } else if ((c != ' ' && c != ',') || sign < 0) {
            refuse(std::string("unexpected '") + c + "'");
        }
    }
    if (sign < 0) refuse("a sign without a digit");
    if (indices.size() != 4) refuse("it has " + std::to_string(indices.size()) + " indices, not four");
    if (indices[0] + indices[1] + indices[2] != 0) refuse("the first three indices do not add up to zero");
    if (indices[0] == 0 && indices[1] == 0 && indices[3] == 0) refuse("all indices are zero");
    return {indices[0], indices[1], indices[2], indices[3], braces};
}

std::vector<Vec3> plane_normals(const CrystalPlanes& planes, double c_over_a)
{
    std::vector<Vec3> normals;
    for (const Indices& p : equal_planes(planes)) normals.push_back(normal_of(p, c_over_a));
    const auto angle = [](const Vec3& n) {
        const double a = std::atan2(n.y, n.x);
        return a < 0.0 ? a + 2.0 * std::numbers::pi : a;
    };
    std::sort(normals.begin(), normals.end(), [&](const Vec3& a, const Vec3& b) { return angle(a) < angle(b); });
    return normals;
}

std::vector<Plane> cleavage_planes(const CrystalPlanes& planes, double prism_side, double c_over_a)
{
    const std::vector<Vec3> normals = plane_normals(planes, c_over_a);
    // Only normals along a vertex direction of the prism, of type <11-20>, meet its short diagonals.
    const bool short_diagonals =
        planes.l == 0 && (planes.h == planes.k || planes.k == planes.i || planes.i == planes.h);
    std::vector<Plane> all;
    for (const double offset : {0.0, -0.5 * prism_side, 0.5 * prism_side}) {
        if (offset != 0.0 && !short_diagonals) continue;
        if (offset == 0.0 && !all.empty()) continue;
        for (const Vec3& n : normals) all.push_back({n, offset});
    }
    return all;
}

}  // namespace grainfrac
