// SPDX-License-Identifier: GPL-3.0-or-later
#include "generate/packings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace grainfrac {

namespace {

/// Hexagonal close packing about the centre of a cylinder along z: as many levels as round(height/h), a sphere on the
/// axis in every second one.
std::vector<Vec3> hcp_sites(const PartSpec& p)
{
    const double d = p.diameter, h = std::sqrt(2.0 / 3.0) * d, R = 0.5 * p.region.diameter;
    const int levels = std::max(1, static_cast<int>(std::lround(p.region.height / h)));
    const int reach = static_cast<int>(R / d * 2.0 / std::sqrt(3.0)) + 2;
    std::vector<Vec3> sites;
    for (int k = 0; k < levels; ++k) {
        const double z = (k - 0.5 * (levels - 1)) * h;
        for (int j = -reach; j <= reach; ++j) {
            for (int i = -2 * reach; i <= 2 * reach; ++i) {
                Vec3 x{d * (i + 0.5 * j), d * std::sqrt(0.75) * j, z};
                if (k % 2 != 0) x.y += d / std::sqrt(3.0);
                if (std::hypot(x.x, x.y) <= R * (1.0 + 1e-12)) sites.push_back(p.region.center + x);
            }
        }
    }
    return sites;
}

}  // namespace

std::vector<SphereSpec> generate_spheres(const Case& c)
{
    std::vector<SphereSpec> all;
    for (std::size_t k = 0; k < c.parts.size(); ++k) {
        const PartSpec& p = c.parts[k];
        if (p.kind != "spheres") continue;
        SphereSpec s;
        s.radius = 0.5 * p.diameter;
        s.group = static_cast<std::int32_t>(k);
        while (c.materials[static_cast<std::size_t>(s.material)].name != p.material) ++s.material;
        s.velocity = p.velocity;
        s.angular_velocity = p.angular_velocity;
        if (p.generator == "chain") {
            const FibreSpec& f = p.fibre;
            const double spacing = f.spacing.value_or(p.diameter), length = norm(f.to - f.from);
            const int n = static_cast<int>(std::lround(length / spacing)) + 1;
            for (int i = 0; i < n; ++i) {
                s.position = f.from + (static_cast<double>(i) / (n - 1)) * (f.to - f.from);
                if (f.radius) s.section_radius = *f.radius;
                s.piece = length / (n - 1);
                all.push_back(s);
            }
            if (p.inside.empty()) continue;
            const Vec3 t = normalized(f.to - f.from);
            std::erase_if(all, [&](const SphereSpec& x) {
                return c.parts[static_cast<std::size_t>(x.group)].name == p.inside &&
                       norm(tangential(x.position - f.from, t)) < *f.radius * (1.0 - 1e-9);
            });
        } else {
            for (const Vec3& x : hcp_sites(p)) {
                s.position = x;
                all.push_back(s);
            }
        }
    }
    return all;
}

}  // namespace grainfrac
