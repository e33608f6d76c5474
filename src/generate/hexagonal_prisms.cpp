// SPDX-License-Identifier: GPL-3.0-or-later
#include "generate/hexagonal_prisms.h"

#include "geometry/cut.h"
#include "geometry/mass_properties.h"

#include <algorithm>
#include <map>
#include <numbers>
#include <sstream>
#include <stdexcept>

namespace grainfrac {

namespace {

/// Guard of floor and ceil, and of "centre inside": (2/3)(15.3)/0.6 is 17 and must not become 18 by round-off.
constexpr double count_guard = 1e-9;
/// Cells below this share of a whole one are round-off even if the user allows any sliver.
constexpr double least_sliver_fraction = 1e-9;
/// Half width, in lattice pitches, of the box from which a cell at the surface is cut; doubled until it is large
/// enough.
constexpr double first_box = 3.0;
/// Tags: 0..5 side neighbours at 0, 60, ... deg, 6 and 7 the layer below and above, then neighbours further off.
constexpr int tag_below = 6, tag_above = 7, tag_far_neighbour = 8;
constexpr int tag_box = -2;
constexpr int tag_curved = 1000, tag_end = 2000;

std::string metres(double length)
{
    std::ostringstream out;
    out << length << " m";
    return out.str();
}

void require_positive(double length, const char* name)
{
    if (!(length > 0.0)) throw std::invalid_argument(std::string(name) + " must be positive, is " + metres(length));
}

void check(const Region& region)
{
    if (region.shape == Region::Shape::box) {
        require_positive(region.size.x, "region size x");
        require_positive(region.size.y, "region size y");
        require_positive(region.size.z, "region size z");
        return;
    }
    require_positive(region.diameter, "region diameter");
    require_positive(region.height, "region height");
    if (region.facets < 3) throw std::invalid_argument("region facets must be at least 3");
    if (!(std::fabs(norm(region.axis) - 1.0) < count_guard))
        throw std::invalid_argument("region axis must be a unit vector");
}

/// Full edge lengths of the box around the region (the circle, not its facets).
Vec3 bounding_lengths(const Region& region)
{
    if (region.shape == Region::Shape::box) return region.size;
    Vec3 lengths;
    for (int i = 0; i < 3; ++i) {
        const double a = region.axis[i];
        lengths[i] = region.height * std::fabs(a) + region.diameter * std::sqrt(std::max(0.0, 1.0 - a * a));
    }
    return lengths;
}

/// `upright`: height is not asked for, because layers are counted, not measured.
bool inside(const Region& region, const Vec3& x)
{
    const Vec3 d = x - region.center;
    const double room = 1.0 + count_guard;
    if (region.shape == Region::Shape::box)
        return std::fabs(d.x) <= 0.5 * room * region.size.x && std::fabs(d.y) <= 0.5 * room * region.size.y;
    const double along = dot(d, region.axis);
    if (norm(d - along * region.axis) > 0.5 * room * region.diameter) return false;
    const bool upright = std::fabs(region.axis.z) > 1.0 - count_guard;
    return upright || std::fabs(along) <= 0.5 * room * region.height;
}

struct Site {
    int row = 0, column = 0;
};

/// The in-plane lattice: x = sqrt(3) r i (odd rows) or sqrt(3) r (i - 1/2) (even rows), y = r + 3/2 r (j - 1) from the
/// lower corner of the bounding box, or moved so that a site of even layers lies on the region's centre.
struct Lattice {
    double side, pitch, row_pitch;
    Vec3 corner;
    Vec3 shift;   ///< of odd layers
    Vec3 offset;  ///< of all layers

    Vec3 center(const Site& s, int layer, double z) const
    {
        const Vec3 o = ((layer & 1) ? shift : Vec3{}) + offset;
        return {corner.x + o.x + pitch * ((s.row & 1) ? s.column : s.column - 0.5),
                corner.y + o.y + side + row_pitch * (s.row - 1), z};
    }
};

Lattice make_lattice(const HexagonalPrismSpec& spec)
{
    Lattice l;
    l.side = spec.side;
    l.pitch = std::numbers::sqrt3 * spec.side;
    l.row_pitch = 1.5 * spec.side;
    l.corner = spec.region.center - 0.5 * bounding_lengths(spec.region);
    if (spec.stacking != Stacking::columnar) l.shift.x = 0.5 * l.pitch;
    if (spec.stacking == Stacking::hollow) l.shift.y = 0.5 * spec.side;
    if (spec.centered) {
        const Vec3 in_box = spec.region.center - l.corner;
        const int row = 1 + static_cast<int>(std::lround((in_box.y - l.side) / l.row_pitch));
        const Vec3 first = l.center({row, 0}, 0, spec.region.center.z);
        const int column = static_cast<int>(std::lround((spec.region.center.x - first.x) / l.pitch));
        l.offset = spec.region.center - l.center({row, column}, 0, spec.region.center.z);
    }
    return l;
}

/// Rectangle of rows and columns that holds every site whose cell can reach the region.
struct Window {
    int row0, row1, column0, column1;

    int columns() const { return column1 - column0 + 1; }
    bool holds(const Site& s) const
    {
        return s.row >= row0 && s.row <= row1 && s.column >= column0 && s.column <= column1;
    }
    std::size_t index(const Site& s) const
    {
        return static_cast<std::size_t>(s.row - row0) * static_cast<std::size_t>(columns()) +
               static_cast<std::size_t>(s.column - column0);
    }
};

Window window_around(const Lattice& l, const Vec3& low, const Vec3& high)
{
    return {static_cast<int>(std::floor((low.y - l.corner.y) / l.row_pitch)) - 3,
            static_cast<int>(std::ceil((high.y - l.corner.y) / l.row_pitch)) + 3,
            static_cast<int>(std::floor((low.x - l.corner.x) / l.pitch)) - 3,
            static_cast<int>(std::ceil((high.x - l.corner.x) / l.pitch)) + 3};
}

/// A cell with its site at half its height: distances of sites across faces are those of the tiling.
LatticeCell with_site(Polyhedron shape, const Vec3& in_plane)
{
    double low = shape.vertices[0].z, high = low;
    for (const Vec3& v : shape.vertices) {
        low = std::min(low, v.z);
        high = std::max(high, v.z);
    }
    return {std::move(shape), {in_plane.x, in_plane.y, 0.5 * (low + high)}};
}

std::vector<LatticeCell> whole_cells(const HexagonalPrismSpec& spec)
{
    const Lattice l = make_lattice(spec);
    const Vec3 lengths = bounding_lengths(spec.region);
    const LatticeCounts n = nominal_counts(lengths, spec.side, spec.thickness);
    const bool nominal = spec.lattice == LatticeMode::nominal && !spec.centered;
    const bool all = nominal && spec.region.shape == Region::Shape::box;
    const Window w = nominal ? Window{1, n.rows, 1, n.columns} : window_around(l, l.corner, l.corner + lengths);
    std::vector<LatticeCell> cells;
    for (int layer = 0; layer < n.layers; ++layer)
        for (int row = w.row0; row <= w.row1; ++row)
            for (int column = w.column0; column <= w.column1; ++column) {
                const Vec3 c = l.center({row, column}, layer, l.corner.z + (layer + 0.5) * spec.thickness);
                if (!all && !inside(spec.region, c)) continue;
                Polyhedron cell = make_hexagonal_prism(spec.side, spec.thickness, c);
                if (spec.lattice == LatticeMode::contained &&
                    !std::all_of(cell.vertices.begin(), cell.vertices.end(),
                                 [&](const Vec3& v) { return inside(spec.region, v); }))
                    continue;
                cells.push_back(with_site(std::move(cell), c));
            }
    return cells;
}

/// A slab of the region: from z_low to z_high, beyond the region at its two ends so that the region's own faces remain.
struct Layer {
    int number = 0;  ///< its parity decides the shift
    double z_low = 0.0, z_high = 0.0;
};

/// Where Voronoi cells of one layer are cut from.
struct Cutter {
    Lattice lattice;
    Polyhedron region;
    Window window;
    double sliver_volume;  ///< [m^3]
};

constexpr Site ring_of(const Site& s, int k)
{
    // neighbours at 0, 60, ... deg; odd rows stand half a pitch to the right of even ones
    const int right = s.row & 1;
    switch (k) {
        case 0:
            return {s.row, s.column + 1};
        case 1:
            return {s.row + 1, s.column + right};
        case 2:
            return {s.row + 1, s.column + right - 1};
        case 3:
            return {s.row, s.column - 1};
        case 4:
            return {s.row - 1, s.column + right - 1};
        default:
            return {s.row - 1, s.column + right};
    }
}

/// The cell of a site with all six neighbours, inside the region.
Polyhedron ring_cell(const Cutter& c, const Layer& layer, const Site& s)
{
    const double z = 0.5 * (layer.z_low + layer.z_high);
    const Vec3 center = c.lattice.center(s, layer.number, z);
    const double reach = std::hypot(c.lattice.side, 0.5 * (layer.z_high - layer.z_low));
    for (const Plane& plane : c.region.planes)
        if (dot(plane.normal, center) - plane.offset > reach) return {};
    return clip(make_hexagonal_prism(c.lattice.side, layer.z_high - layer.z_low, center), c.region);
}

double in_plane_reach(const Polyhedron& p, const Vec3& site)
{
    double r = 0.0;
    for (const Vec3& v : p.vertices) r = std::max(r, std::hypot(v.x - site.x, v.y - site.y));
    return r;
}

/// Half-space of points nearer to a than to b; exactly the reverse of the one of b and a, so that both cells share it.
Plane bisector(const Vec3& a, const Vec3& b)
{
    const Vec3 n = normalized(b - a);
    return {n, dot(n, 0.5 * (a + b))};
}

/// The Voronoi cell of a site among the sites that are left, inside the region.
Polyhedron open_cell(const Cutter& c, const Layer& layer, const Site& s, const std::vector<char>& left)
{
    const Lattice& l = c.lattice;
    const Vec3 x = l.center(s, layer.number, 0.5 * (layer.z_low + layer.z_high));
    const auto is_left = [&](const Site& t) { return c.window.holds(t) && left[c.window.index(t)]; };
    for (double half_width = first_box * l.pitch;; half_width *= 2.0) {
        Polyhedron cell = make_box({2.0 * half_width, 2.0 * half_width, layer.z_high - layer.z_low}, x);
        cell.face_tags = {tag_box, tag_box, tag_box, tag_box, tag_below, tag_above};
        for (int k = 0; k < 6; ++k) {
            const Site t = ring_of(s, k);
            if (is_left(t)) cell = clip(cell, {bisector(x, l.center(t, layer.number, x.z))}, k);
        }
        cell = clip(cell, c.region);

        // further sites, nearest first, until they are too far to matter
        struct Other {
            double distance;
            Vec3 x;
        };
        std::vector<Other> others;
        const double far = 2.0 * in_plane_reach(cell, x);
        const int rows = static_cast<int>(far / l.row_pitch) + 1, columns = static_cast<int>(far / l.pitch) + 2;
        for (int i = -rows; i <= rows; ++i)
            for (int j = -columns; j <= columns; ++j) {
                const Site t{s.row + i, s.column + j};
                if (!is_left(t)) continue;
                const Vec3 y = l.center(t, layer.number, x.z);
                const double distance = norm(y - x);
                if (distance > 1.01 * l.pitch && distance < far) others.push_back({distance, y});
            }
        std::stable_sort(others.begin(), others.end(),
                         [](const Other& a, const Other& b) { return a.distance < b.distance; });
        for (const Other& o : others) {
            if (o.distance > 2.0 * in_plane_reach(cell, x)) break;
            cell = clip(cell, {bisector(x, o.x)}, tag_far_neighbour);
        }
        if (std::find(cell.face_tags.begin(), cell.face_tags.end(), tag_box) == cell.face_tags.end()) return cell;
    }
}

/// All cells of a layer, row by row; empty if every one would be a sliver.
std::vector<LatticeCell> layer_cells(const Cutter& c, const Layer& layer)
{
    const Window& w = c.window;
    std::vector<char> left(static_cast<std::size_t>((w.row1 - w.row0 + 1) * w.columns()), 0);
    std::map<std::size_t, Polyhedron> ring_cells;
    for (int row = w.row0; row <= w.row1; ++row)
        for (int column = w.column0; column <= w.column1; ++column) {
            Polyhedron cell = ring_cell(c, layer, {row, column});
            if (cell.faces.empty() || mass_properties(cell).volume < c.sliver_volume) continue;
            const std::size_t i = w.index({row, column});
            left[i] = 1;
            ring_cells.emplace(i, std::move(cell));
        }
    std::vector<LatticeCell> cells;
    for (auto& [i, cell] : ring_cells) {
        const Site s{w.row0 + static_cast<int>(i) / w.columns(), w.column0 + static_cast<int>(i) % w.columns()};
        bool closed = true;
        for (int k = 0; k < 6; ++k) {
            const Site t = ring_of(s, k);
            closed = closed && w.holds(t) && left[w.index(t)];
        }
        cells.push_back(
            with_site(closed ? std::move(cell) : open_cell(c, layer, s, left), c.lattice.center(s, layer.number, 0.0)));
    }
    return cells;
}

std::vector<LatticeCell> cut_cells(const HexagonalPrismSpec& spec)
{
    Cutter c;
    c.lattice = make_lattice(spec);
    c.region = region_polyhedron(spec.region);
    Vec3 low = c.region.vertices[0], high = low;
    for (const Vec3& v : c.region.vertices)
        for (int i = 0; i < 3; ++i) {
            low[i] = std::min(low[i], v[i]);
            high[i] = std::max(high[i], v[i]);
        }
    c.window = window_around(c.lattice, low, high);
    const double t = spec.thickness, height = high.z - low.z;
    const double hexagon = 1.5 * std::numbers::sqrt3 * spec.side * spec.side;
    c.sliver_volume = std::max(spec.sliver_fraction, least_sliver_fraction) * hexagon * std::min(t, height);

    std::vector<Layer> layers;
    const int n = std::max(1, static_cast<int>(std::ceil(height / t - count_guard)));
    for (int k = 0; k < n; ++k) layers.push_back({k, low.z + k * t, k + 1 < n ? low.z + (k + 1) * t : high.z});
    layers.front().z_low -= std::min(t, height);
    layers.back().z_high += std::min(t, height);

    // a slab in which every cell would be a sliver joins the next one towards the middle
    std::vector<std::vector<LatticeCell>> of_layer;
    for (const Layer& layer : layers) of_layer.push_back(layer_cells(c, layer));
    for (std::size_t k = 0; k < layers.size() && layers.size() > 1;) {
        if (!of_layer[k].empty()) {
            ++k;
            continue;
        }
        const std::size_t into = 2 * k < layers.size() - 1 ? k + 1 : k - 1;
        layers[into].z_low = std::min(layers[into].z_low, layers[k].z_low);
        layers[into].z_high = std::max(layers[into].z_high, layers[k].z_high);
        of_layer[into] = layer_cells(c, layers[into]);
        layers.erase(layers.begin() + static_cast<std::ptrdiff_t>(k));
        of_layer.erase(of_layer.begin() + static_cast<std::ptrdiff_t>(k));
        k = 0;
    }
    std::vector<LatticeCell> cells;
    for (auto& list : of_layer) std::move(list.begin(), list.end(), std::back_inserter(cells));
    return cells;
}

}  // namespace

Polyhedron region_polyhedron(const Region& region)
{
    check(region);
    if (region.shape == Region::Shape::box) {
        Polyhedron box = make_box(region.size, region.center);
        for (int& tag : box.face_tags) tag += tag_curved;
        return box;
    }
    const Vec3 u = cross(any_perpendicular(region.axis), region.axis), v = cross(region.axis, u);
    const int n = region.facets;
    const double step = 2.0 * std::numbers::pi / n, corner = 0.5 * region.diameter / std::cos(0.5 * step);
    std::vector<Vec3> polygon;
    for (int i = 0; i < n; ++i)
        polygon.push_back({corner * std::cos((i - 0.5) * step), corner * std::sin((i - 0.5) * step), 0.0});
    Polyhedron p = make_prism(polygon, -0.5 * region.height, 0.5 * region.height);
    for (Vec3& x : p.vertices) x = region.center + x.x * u + x.y * v + x.z * region.axis;
    p = make_polyhedron(std::move(p.vertices), std::move(p.faces));
    for (int i = 0; i < n; ++i) p.face_tags[static_cast<std::size_t>(i)] = tag_curved + i;
    p.face_tags[static_cast<std::size_t>(n)] = tag_end;
    p.face_tags[static_cast<std::size_t>(n) + 1] = tag_end + 1;
    return p;
}

LatticeCounts nominal_counts(const Vec3& box, double side, double thickness)
{
    // Saleme Ruiz 2016, appendix A: m = fix(a/(sqrt(3) r)), n = ceil((2/3)(b + r/2)/r) - 1
    LatticeCounts n;
    n.columns = static_cast<int>(std::floor(box.x / (std::numbers::sqrt3 * side) + count_guard));
    n.rows = static_cast<int>(std::ceil(2.0 / 3.0 * (box.y + 0.5 * side) / side - count_guard)) - 1;
    n.layers = std::max(1, static_cast<int>(std::floor(box.z / thickness + count_guard)));
    return n;
}

std::vector<LatticeCell> hexagonal_prism_lattice(const HexagonalPrismSpec& spec)
{
    require_positive(spec.side, "side");
    require_positive(spec.thickness, "thickness");
    check(spec.region);
    if (spec.sliver_fraction < 0.0 || spec.sliver_fraction >= 1.0)
        throw std::invalid_argument("sliver_fraction must lie in [0, 1)");
    std::vector<LatticeCell> cells = spec.boundary == BoundaryMode::cut ? cut_cells(spec) : whole_cells(spec);
    if (cells.empty()) {
        const Vec3 lengths = bounding_lengths(spec.region);
        throw std::invalid_argument("no cell of side " + metres(spec.side) + " and thickness " +
                                    metres(spec.thickness) + " fits the region of " + metres(lengths.x) + " x " +
                                    metres(lengths.y) + " x " + metres(lengths.z));
    }
    return cells;
}

std::vector<Polyhedron> hexagonal_prism_cells(const HexagonalPrismSpec& spec)
{
    std::vector<Polyhedron> shapes;
    for (LatticeCell& cell : hexagonal_prism_lattice(spec)) shapes.push_back(std::move(cell.shape));
    return shapes;
}

}  // namespace grainfrac
