// SPDX-License-Identifier: GPL-3.0-or-later
#include "experiment/fibre_interface.h"

#include "experiment/specimen.h"
#include "fracture/fibre_pressure.h"
#include "generate/fibre_in_grains.h"
#include "generate/fibre_line.h"
#include "generate/sphere_region.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <numbers>

namespace grainfrac {

namespace {

/// Groups of a fibre and its matrix that an entry of [[bonds]] joins as an interface.
struct FibrePair {
    int fibre = -1, matrix = -1;
    const BondRule* rule = nullptr;
};

bool is_fibre(const PartSpec& p)
{
    return p.kind == "spheres" && (p.generator == "chain" || p.generator == "taken");
}

const PartSpec& part_at(const Case& c, int group)
{
    return c.parts[static_cast<std::size_t>(group)];
}

/// Two fibres are no fibre in a matrix.
std::vector<FibrePair> fibre_pairs(const Case& c, const BondTable& table)
{
    std::vector<FibrePair> found;
    const int n = static_cast<int>(c.parts.size());
    for (int a = 0; a < n; ++a) {
        for (int b = 0; b < n; ++b) {
            const BondRule* rule = a == b ? nullptr : table.rule_of(a, b);
            if (rule == nullptr || rule->kind != BondRule::Kind::fibre) continue;
            if (is_fibre(part_at(c, a)) && !is_fibre(part_at(c, b))) found.push_back({a, b, rule});
        }
    }
    return found;
}

struct Extent {
    double low = std::numeric_limits<double>::max(), high = std::numeric_limits<double>::lowest();
};

/// Where a fibre of taken spheres is in its matrix, along its axis: a layer of a lattice stands for one distance;
/// without layers, its region as far as the packing goes.
Extent taken_extent(const State& state, const Model& model, const PartSpec& part, int fibre, int matrix)
{
    const int axis = axis_index(part.region.axis);
    const double h = even_levels(state, fibre, axis);
    Extent e;
    for (int i = 0; i < state.bodies.size(); ++i) {
        const int group = state.bodies.group[i];
        if (group != fibre && (h > 0.0 || group != matrix)) continue;
        const double z = state.bodies.start_position[i][axis],
                     r = h > 0.0 ? 0.5 * h : model.shapes.radius[state.bodies.shape[i]];
        e = {std::min(e.low, z - r), std::max(e.high, z + r)};
    }
    if (h > 0.0) return e;
    const double middle = part.region.center[axis], half = 0.5 * part.region.height;
    return {std::max(e.low, middle - half), std::min(e.high, middle + half)};
}

std::vector<SharedFace> taken_patches(const Case& c, const Model& model, const State& state,
                                      const std::vector<SphereSpec>& spheres, int first_body, const FibrePair& pair,
                                      int entry)
{
    const PartSpec& part = part_at(c, pair.fibre);
    const BondSpec& spec = c.bonds[static_cast<std::size_t>(entry)];
    if (part.region.shape != "cylinder" && part.region.shape != "disc") {
        throw InputError(fmt::format("parts[{}].region.shape", pair.fibre),
                         "must be \"cylinder\" for a fibre with an interface: it has the surface of the cylinder");
    }
    const Extent extent = taken_extent(state, model, part, pair.fibre, pair.matrix);
    FibreLattice fibre;
    fibre.axis = axis_vector(axis_index(part.region.axis));
    fibre.center = part.region.center;
    fibre.radius = 0.5 * part.region.diameter;
    fibre.length = extent.high - extent.low;
    fibre.radial = spec.frame == "surface";
    fibre.same_level = spec.reach == "level";
    std::vector<std::pair<int, int>> across;  // fibre, matrix
    for (auto [i, j] : touching_spheres(spheres, spec.gap_factor)) {
        if (spheres[static_cast<std::size_t>(i)].group != pair.fibre) std::swap(i, j);
        if (spheres[static_cast<std::size_t>(i)].group == pair.fibre &&
            spheres[static_cast<std::size_t>(j)].group == pair.matrix)
            across.emplace_back(first_body + i, first_body + j);
    }
    std::vector<SharedFace> faces = lattice_patches(state, fibre, across);
    if (faces.empty()) {
        throw InputError(fmt::format("bonds[{}].reach", entry),
                         fmt::format("\"{}\" joins no sphere of \"{}\" to one of \"{}\" beside it{}", spec.reach,
                                     part.name, part_at(c, pair.matrix).name,
                                     fibre.same_level ? "; in a packing without layers use \"all\"" : ""));
    }
    return faces;
}

}  // namespace

double even_levels(const State& state, int group, int axis)
{
    std::vector<double> z;
    for (int i = 0; i < state.bodies.size(); ++i) {
        if (state.bodies.group[i] == group) z.push_back(state.bodies.start_position[i][axis]);
    }
    std::sort(z.begin(), z.end());
    if (z.empty()) return 0.0;
    const double round_off = 1e-6 * (z.back() - z.front());
    double least = std::numeric_limits<double>::max(), most = 0.0;
    for (std::size_t i = 1; i < z.size(); ++i) {
        const double gap = z[i] - z[i - 1];
        if (gap <= round_off) continue;
        least = std::min(least, gap);
        most = std::max(most, gap);
    }
    return most > 0.0 && most - least <= 2.0 * round_off ? least : 0.0;
}

std::vector<FibreChain> fibre_chains(const Case& c, const State& state, int group)
{
    const PartSpec& part = part_at(c, group);
    std::vector<int> bodies;
    for (int i = 0; i < state.bodies.size(); ++i) {
        if (state.bodies.group[i] == group) bodies.push_back(i);
    }
    const std::vector<Vec3> line = fibre_polyline(part.fibre);
    const std::size_t copies = part.copies.size() + 1, links = bodies.size() / copies;
    std::vector<FibreChain> chains;
    for (std::size_t copy = 0; copy < copies; ++copy) {
        FibreChain f;
        f.nodes.assign(bodies.begin() + static_cast<std::ptrdiff_t>(copy * links),
                       bodies.begin() + static_cast<std::ptrdiff_t>((copy + 1) * links));
        f.radius = part.fibre.radius.value_or(0.5 * part.diameter);
        const auto at = [&](std::size_t k) { return state.bodies.start_position[f.nodes[k]]; };
        const Vec3 shift = copy == 0 ? Vec3{} : part.copies[copy - 1];
        const auto beyond = [&](const Vec3& end, std::size_t k, std::size_t next) {
            return std::min(norm(end + shift - at(k)), 0.5 * norm(at(next) - at(k)));
        };
        f.way = {beyond(line.front(), 0, 1)};
        for (std::size_t k = 1; k < links; ++k) f.way.push_back(f.way.back() + norm(at(k) - at(k - 1)));
        f.whole = f.way.back() + beyond(line.back(), links - 1, links - 2);
        chains.push_back(std::move(f));
    }
    return chains;
}

std::vector<SharedFace> fibre_patches(const Case& c, const Model& model, const State& state,
                                      const std::vector<SphereSpec>& spheres, int first_body, const BondTable& table)
{
    std::vector<SharedFace> all;
    const auto add = [&](std::vector<SharedFace> faces) {
        all.insert(all.end(), std::make_move_iterator(faces.begin()), std::make_move_iterator(faces.end()));
    };
    for (const FibrePair& pair : fibre_pairs(c, table)) {
        if (part_at(c, pair.fibre).generator == "taken") {
            add(taken_patches(c, model, state, spheres, first_body, pair, table.entry_of(*pair.rule)));
            continue;
        }
        std::vector<char> is_matrix(static_cast<std::size_t>(state.bodies.size()), 0);
        for (int i = 0; i < state.bodies.size(); ++i)
            is_matrix[static_cast<std::size_t>(i)] = state.bodies.group[i] == pair.matrix ? 1 : 0;
        for (const FibreChain& chain : fibre_chains(c, state, pair.fibre))
            add(chain_patches(model, state, chain, is_matrix));
    }
    return all;
}

void finish_fibre_interfaces(const Case& c, Model& model, State& state, const BondTable& table)
{
    InterfaceBonds& f = state.interfaces;
    const SphereBonds& links = state.sphere_bonds;
    for (int i = 0; i < f.size(); ++i) f.bond_before.at(i) = f.bond_after.at(i) = -1;
    for (const FibrePair& pair : fibre_pairs(c, table)) {
        const int entry = table.entry_of(*pair.rule);
        const BondSpec& spec = c.bonds[static_cast<std::size_t>(entry)];
        const PartSpec& part = part_at(c, pair.fibre);
        const bool is_chain = part.generator == "chain";
        struct Node {
            double way = 0.0, section = 0.0;
            int before = -1, after = -1;
        };
        std::map<int, Node> nodes;
        double contraction = 0.0;
        if (is_chain) {
            for (const FibreChain& chain : fibre_chains(c, state, pair.fibre)) {
                for (std::size_t k = 0; k < chain.nodes.size(); ++k)
                    nodes[chain.nodes[k]] = {chain.way[k], std::numbers::pi * chain.radius * chain.radius};
            }
            for (int i = 0; i < links.size(); ++i) {  // nodes of a chain follow each other
                const int a = links.a[i], b = links.b[i];
                if (b != a + 1 || nodes.count(a) == 0 || nodes.count(b) == 0) continue;
                nodes[a].after = nodes[b].before = i;
            }
            const auto material = [&](int g) {
                return model.materials[static_cast<std::size_t>(model.groups[static_cast<std::size_t>(g)].material)];
            };
            if (spec.radial_pressure > 0.0)
                contraction = spec.contraction.value_or(contraction_of(material(pair.fibre), material(pair.matrix)));
        } else if (spec.contraction.value_or(0.0) > 0.0) {
            throw InputError(fmt::format("bonds[{}].contraction", entry),
                             fmt::format("must be 0 for \"{}\": only a fibre of generator \"chain\" knows its axial "
                                         "stress",
                                         part.name));
        }
        model.fibres_contract = model.fibres_contract || contraction > 0.0;
        const double low = is_chain ? 0.0 : taken_extent(state, model, part, pair.fibre, pair.matrix).low;
        for (int i = 0; i < f.size(); ++i) {
            if (f.law[i] != pair.rule->law) continue;
            const int fibre = state.bodies.group[f.a[i]] == pair.fibre ? f.a[i] : f.b[i];
            f.pressure.at(i) = f.pressure_at_rest.at(i) = spec.radial_pressure;
            f.contraction.at(i) = contraction;
            f.opening_limit.at(i) = std::numeric_limits<double>::max();  // the matrix stays beside the fibre
            if (is_chain) {
                const Node& n = nodes.at(fibre);
                f.slip_limit.at(i) = n.way;
                f.fibre_section.at(i) = n.section;
                f.bond_before.at(i) = n.before;
                f.bond_after.at(i) = n.after;
            } else {
                f.slip_limit.at(i) = state.bodies.position[fibre][axis_index(part.region.axis)] - low;
            }
        }
    }
}

void part_fibres(const Case& c, Model& model, const State& state, const BondTable& table)
{
    const auto overlaps = [&](const FibrePair& pair) {
        if (part_at(c, pair.fibre).generator == "taken") return true;
        if (part_at(c, pair.matrix).kind != "grains") return false;
        std::vector<int> grains;
        for (int i = 0; i < state.bodies.size(); ++i) {
            if (state.bodies.group[i] == pair.matrix) grains.push_back(i);
        }
        const std::vector<FibreChain> chains = fibre_chains(c, state, pair.fibre);
        return std::any_of(chains.begin(), chains.end(),
                           [&](const FibreChain& chain) { return grains_reach_in(model, state, chain, grains); });
    };
    for (const FibrePair& pair : fibre_pairs(c, table)) {
        const PartSpec &fibre = part_at(c, pair.fibre), &matrix = part_at(c, pair.matrix);
        const bool told = std::any_of(c.contacts.begin(), c.contacts.end(), [&](const ContactSpec& s) {
            return s.between == std::array{fibre.name, matrix.name} || s.between == std::array{matrix.name, fibre.name};
        });
        if (told || !overlaps(pair)) continue;
        LinearContact& law =
            model.contact_laws.at(model.contact_law_of[entry_of_pair(pair.fibre, pair.matrix, model.groups.size())]);
        law.area_stiffness = law.friction = 0.0;
    }
}

}  // namespace grainfrac
