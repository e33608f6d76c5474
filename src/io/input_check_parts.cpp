// SPDX-License-Identifier: GPL-3.0-or-later
#include "generate/random_packing.h"
#include "io/input_checks.h"
#include "io/input_document.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace grainfrac {

namespace {

/// `inside` names a packing; what stands on a line or was taken itself has no room to give.
void check_host(Checks& checks, const PartSpec& p, const std::string& key)
{
    std::vector<std::string> hosts;
    for (const PartSpec& other : checks.input.parts) {
        if (&other != &p && other.kind == "spheres" && other.generator != "chain" && other.generator != "taken")
            hosts.push_back(other.name);
    }
    const bool in_grains = p.generator == "chain" && is_a(checks, "grains", p.inside);
    if (!in_grains && std::find(hosts.begin(), hosts.end(), p.inside) == hosts.end()) {
        checks.fail(key,
                    "no other part of this name has kind = \"spheres\" and generator = \"hcp\", \"fcc\", "
                    "\"random_dense\" or \"file\"; " +
                        choice(p.inside, hosts));
    }
}

/// A fibre taken from a packing leaves some of it around itself.
void check_taken(Checks& checks, const PartSpec& p, const std::string& path)
{
    const std::string key = path + ".region.diameter";
    for (const PartSpec& host : checks.input.parts) {
        if (host.name != p.inside || p.region.shape != "cylinder" || host.region.shape != "cylinder" ||
            p.region.axis != host.region.axis || !checks.given(key) || !checks.right(key))
            continue;
        if (p.region.diameter >= host.region.diameter)
            checks.fail(key, fmt::format("{:.6g} m; must be smaller than the {:.6g} m of \"{}\"", p.region.diameter,
                                         host.region.diameter, host.name));
    }
}

void check_chain(Checks& checks, const PartSpec& p, const std::string& path)
{
    const FibreSpec& f = p.fibre;
    const std::string fibre = path + ".fibre", points = fibre + ".points", sideways = fibre + ".sideways";
    if (checks.given(fibre) && checks.right(fibre)) {
        if (f.shape == "points") {
            if (f.points.size() < 2)
                checks.fail(points, fmt::format("has {} points; must have at least 2", f.points.size()));
            for (std::size_t i = 1; i < f.points.size(); ++i) {
                if (f.points[i] == f.points[i - 1])
                    checks.fail(joined(points, i), "is the same point as the one before");
            }
        } else if (f.from == f.to) {
            checks.fail(fibre + ".to", "must not be the same point as from");
        } else if (f.shape != "straight" && norm2(cross(f.sideways, f.to - f.from)) == 0.0) {
            checks.fail(
                checks.given(sideways) ? sideways : fibre,
                fmt::format("{}must not be zero or along the fibre", checks.given(sideways) ? "" : "sideways: "));
        }
    }
    for (std::size_t i = 0; i < p.copies.size() && checks.right(path + ".copies"); ++i) {
        const bool again = std::find(p.copies.begin(), p.copies.begin() + static_cast<std::ptrdiff_t>(i),
                                     p.copies[i]) != p.copies.begin() + static_cast<std::ptrdiff_t>(i);
        if (norm2(p.copies[i]) == 0.0 || again)
            checks.fail(joined(path + ".copies", i),
                        again ? "is listed already" : "must not be zero: that is the chain itself");
    }
}

void check_orientation(Checks& checks, const OrientationSpec& o, const std::string& path)
{
    if (!checks.given(path) || !checks.right(path)) return;
    const int ways = (o.choices.empty() ? 0 : 1) + (o.random.empty() ? 0 : 1) + (o.file.empty() ? 0 : 1);
    if (ways != 1)
        checks.fail(path, fmt::format("has {} of choices, random, file; must have exactly one",
                                      ways == 0 ? "none" : "several"));
}

/// What goes with only one kind of part.
void check_kind(Checks& checks, const PartSpec& p, const std::string& path)
{
    const bool prisms = p.generator == "hexagonal_prisms", file = p.generator == "file";
    if (p.kind == "grains") {
        if (!prisms && !file)
            checks.fail(path + ".generator", "must be one of \"hexagonal_prisms\", \"file\" with kind = \"grains\"");
        if (p.region.shape == "sphere" && checks.right(path + ".region.shape"))
            checks.fail(path + ".region.shape",
                        "must be one of \"box\", \"beam\", \"cylinder\", \"disc\" with kind = \"grains\"");
        return;
    }
    if (prisms && checks.given(path + ".generator")) {
        checks.fail(path + ".generator",
                    "must be one of \"hcp\", \"fcc\", \"random_dense\", \"chain\", \"taken\", \"file\" with kind = "
                    "\"spheres\"");
    }
    if (checks.given(path + ".orientation"))
        checks.fail(path + ".orientation", "has no meaning here; it goes with kind = \"grains\"");
    if (p.generator == "chain" && checks.given(path + ".region"))
        checks.fail(path + ".region", "has no meaning here; it goes with any generator but \"chain\"");
    if (checks.given(path + ".inside") && checks.right(path + ".inside")) check_host(checks, p, path + ".inside");
    if (p.generator == "chain") check_chain(checks, p, path);
    if (p.generator == "taken") check_taken(checks, p, path);
    if (p.generator == "random_dense" && checks.right(path + ".solid_fraction") && checks.right(path + ".size_ratio")) {
        const double most = densest_random_packing(p.size_ratio);
        if (p.solid_fraction > most) {
            checks.fail(path + ".solid_fraction",
                        fmt::format("must be <= {:.4g}, random close packing at size_ratio = {}; less beside walls",
                                    most, p.size_ratio));
        }
    }
}

void check_part(Checks& checks, const PartSpec& p, const std::string& path)
{
    if (checks.given(path + ".material") && checks.right(path + ".material") &&
        std::find(checks.material_names.begin(), checks.material_names.end(), p.material) ==
            checks.material_names.end()) {
        checks.fail(path + ".material", "no such material; " + choice(p.material, checks.material_names));
    }
    if (checks.given(path + ".file") && p.file.empty() && checks.right(path + ".file"))
        checks.fail(path + ".file", "must not be empty");
    check_orientation(checks, p.orientation, path + ".orientation");
    if (checks.right(path + ".kind") && checks.right(path + ".generator")) check_kind(checks, p, path);

    if (p.dilation_radius && p.generator == "hexagonal_prisms" && checks.right(path + ".dilation_radius")) {
        const double rho = *p.dilation_radius, inradius = 0.5 * std::min(std::sqrt(3.0) * p.side, p.thickness);
        const bool sides_right =
            p.side > 0.0 && p.thickness > 0.0 && checks.right(path + ".side") && checks.right(path + ".thickness");
        if (sides_right && inradius < 3.0 * rho) {
            checks.fail(
                path + ".dilation_radius",
                fmt::format(
                    "must be <= {:.6g} m, a third of the inradius of the prism (side {:.6g} m, thickness {:.6g} m)",
                    inradius / 3.0, p.side, p.thickness));
        }
    }
}

}  // namespace

void check_parts(Checks& checks)
{
    for (std::size_t i = 0; i < checks.input.parts.size(); ++i)
        check_part(checks, checks.input.parts[i], joined("parts", i));
}

}  // namespace grainfrac
