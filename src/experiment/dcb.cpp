// SPDX-License-Identifier: GPL-3.0-or-later
#include "experiment/dcb.h"

#include "experiment/specimen.h"
#include "experiment/walls.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace grainfrac {

namespace {

/// Pins stand this many mean spacings from the end: in the first grain or the one behind it.
constexpr double default_grip = 0.5;
/// Shear correction of a rectangular section (Reissner).
constexpr double shear_correction = 5.0 / 6.0;
/// Centres of one row of grains lie within this share of the arm's height.
constexpr double one_row = 1e-6;

/// k_n of bonded faces across the mid plane, per area of that plane: k_n n^2 + k_s (1 - n^2) of inclined faces [Pa/m].
double joint_stiffness(const State& state, int up, double middle)
{
    const InterfaceBonds& f = state.interfaces;
    double stiffness = 0.0, area = 0.0;
    for (int i = 0; i < f.size(); ++i) {
        const bool a_above = state.bodies.position[f.a[i]][up] > middle,
                   b_above = state.bodies.position[f.b[i]][up] > middle;
        if (a_above == b_above) continue;
        const double n = rotate(state.bodies.orientation[f.a[i]], f.normal_a[i])[up];
        stiffness += f.area[i] * (f.normal_stiffness[i] * n * n + f.shear_stiffness[i] * (1.0 - n * n));
        area += f.area[i] * std::fabs(n);
    }
    return area > 0.0 ? stiffness / area : 0.0;
}

/// Distance of the highest and lowest centres of the upper arm's grains: 0 for one row [m].
double height_of_centres(const State& state, int up, double middle)
{
    double low = 1e300, high = -1e300;
    for (int i = 0; i < state.bodies.size(); ++i) {
        const double x = state.bodies.position[i][up];
        if (state.bodies.wall[i] >= 0 || x < middle) continue;
        low = std::min(low, x);
        high = std::max(high, x);
    }
    return high - low;
}

/// Shear modulus of a row of grains that turn with its sections: k_s h of the faces within the arms [Pa].
double row_shear_modulus(const State& state, int up, double middle)
{
    const InterfaceBonds& f = state.interfaces;
    double modulus = 0.0;
    int faces = 0;
    for (int i = 0; i < f.size(); ++i) {
        const Vec3 a = state.bodies.position[f.a[i]], b = state.bodies.position[f.b[i]];
        if ((a[up] > middle) != (b[up] > middle)) continue;
        modulus += f.shear_stiffness[i] * norm(b - a);
        ++faces;
    }
    return faces > 0 ? modulus / faces : 0.0;
}

/// EI of the upper arm from its faces: the energy of the field u = kappa (x y, -x^2/2) in which every grain turns with
/// its section, per length and kappa^2/2. Exact for blocks and for the honeycomb, whose free rows make an arm softer
/// than E b H^3/12; elsewhere an upper bound. 0 without interfaces. Faces are weighted as in mean_section, so that the
/// ends do not count.
double bending_stiffness(const State& state, int up, int along, double middle, double low, double length)
{
    const InterfaceBonds& f = state.interfaces;
    const Bodies& b = state.bodies;
    double s0 = 0.0, s1 = 0.0, s2 = 0.0, across = 0.0;  // sums of k, k y, k y^2; of the field's second component [N]
    for (int i = 0; i < f.size(); ++i) {
        const Vec3 xa = b.position[f.a[i]], xb = b.position[f.b[i]];
        if (xa[up] < middle || xb[up] < middle) continue;
        const Vec3 n = rotate(b.orientation[f.a[i]], f.normal_a[i]);
        const double d = xb[along] - xa[along], center = 0.5 * (xa[along] + xb[along]);
        const double s = std::sin(std::numbers::pi * (center - low) / length);
        const double extra = f.normal_stiffness[i] - f.shear_stiffness[i];
        const double k_along = f.shear_stiffness[i] + extra * n[along] * n[along],
                     k_up = f.shear_stiffness[i] + extra * n[up] * n[up];
        for (int q = f.point_begin[i]; q < f.point_begin[i + 1]; ++q) {
            const Vec3 x = xa + rotate(b.orientation[f.a[i]], state.points.position_a[q]);
            const double weight = s * s * state.points.weight[q] * d * d, y = x[up] - middle;
            s0 += weight * k_along;
            s1 += weight * k_along * y;
            s2 += weight * k_along * y * y;
            const double v = center - x[along];
            across += weight * (k_up * v * v + 2.0 * extra * n[along] * n[up] * v * y);
        }
    }
    return s0 > 0.0 ? (s2 - s1 * s1 / s0 + across) / (0.5 * length) : 0.0;
}

DcbArms arms_of(const Material& m, const State& state, int up, double middle, double height, double width,
                double bending, double joint)
{
    const double E = m.young_modulus, section = width * height, rows = height_of_centres(state, up, middle);
    DcbArms arms;
    arms.width = width;
    arms.bending = bending > 0.0 ? bending : E * section * height * height / 12.0;
    if (rows < one_row * height) {
        arms.shear = row_shear_modulus(state, up, middle) * section;
        arms.foundation = 2.0 * joint * width;
    } else {  // the joint in series with half of the arm (Kanninen: 2 E b/H)
        arms.shear = shear_correction * E / (2.0 * (1.0 + m.poisson_ratio)) * section;
        arms.foundation = width / (0.5 / joint + 0.5 * rows / E);
    }
    return arms;
}

/// G of the crack that is as compliant as the specimen, so that the compliance of a process zone counts (de Moura et
/// al. 2008, J. Compos. Mater. 42, 2069): at the peak load, and as a mean from there on, while the crack grows.
std::vector<NamedResult> results(const Experiment& e, const std::vector<CurvePoint>& curve)
{
    const DcbArms arms{fact(e, "arm_bending_stiffness_N_m2"), fact(e, "arm_shear_stiffness_N"),
                       fact(e, "arm_foundation_N_per_m2"), fact(e, "arm_width_m")};
    const auto peak = std::max_element(curve.begin(), curve.end(),
                                       [](const CurvePoint& a, const CurvePoint& b) { return a.load < b.load; });
    if (peak == curve.end() || peak->load <= 0.0) return {};
    double at_peak = 0.0, sum = 0.0, length = 0.0;
    int points = 0;
    for (auto p = peak; p != curve.end() && p->load > 0.0; ++p) {
        length = arms.crack_length(p->strain * e.specimen.length / p->load);
        const double G = arms.release_rate(p->load, length);
        if (p == peak) at_peak = G;
        sum += G;
        ++points;
    }
    return {{"fracture_energy_J_per_m2", at_peak},
            {"mean_fracture_energy_J_per_m2", sum / points},
            {"last_crack_length_m", length}};
}

}  // namespace

double DcbArms::foundation_length() const
{
    return std::sqrt(std::sqrt(4.0 * bending / foundation) + bending / shear);
}

double DcbArms::compliance(double a) const
{
    const double f = foundation_length(), bare2 = std::sqrt(4.0 * bending / foundation);  // 1/Lambda^2
    return 2.0 / (3.0 * bending) * (a * (a * (a + 3.0 * f) + 3.0 * f * f) + 1.5 * f * bare2);
}

double DcbArms::crack_length(double wanted) const
{
    const double f = foundation_length(), bare2 = std::sqrt(4.0 * bending / foundation);
    return std::cbrt(1.5 * bending * wanted + f * f * f - 1.5 * f * bare2) - f;
}

double DcbArms::release_rate(double load, double a) const
{
    const double arm = a + foundation_length();
    return load * load * arm * arm / (width * bending);
}

double DcbArms::tip_traction(double load, double a) const
{
    return load * (a + foundation_length()) * std::sqrt(foundation / bending) / width;
}

Experiment set_up_dcb(const Case& c, Model& model, State& state)
{
    const int up = axis_of(c.test.direction), along = up == 0 ? 1 : 0, across = 3 - up - along;
    const Extent x = specimen_extent(model, state);
    const double middle = x.center()[up], length = x.size()[along], width = x.size()[across];
    const double height = 0.5 * mean_section(model, state, along) / width;
    if (c.test.crack_length >= length)
        throw InputError("test.crack_length", fmt::format("must be < {:.6g} m, the length of the arms", length));
    const double grip = c.test.grip_length.value_or(std::min(default_grip * model.nominal_length, c.test.crack_length));
    if (grip > c.test.crack_length)
        throw InputError("test.grip_length",
                         fmt::format("must be <= {:.6g} m: the pins stand before the crack tip", c.test.crack_length));
    if (state.interfaces.size() == 0)
        throw InputError("test.kind", "a dcb test needs [[bonds]] of law = \"interface\" between the arms");
    const double joint = joint_stiffness(state, up, middle);
    if (joint == 0.0) throw InputError("test.crack_length", "nothing joins the arms beyond the crack; shorten it");

    const DcbArms arms =
        arms_of(model.materials[static_cast<std::size_t>(model.groups.front().material)], state, up, middle, height,
                width, bending_stiffness(state, up, along, middle, x.low[along], length), joint);
    Experiment e;
    e.kind = c.test.kind;
    e.results = results;
    int walls[2] = {0, 0};
    double pin = 0.0;
    for (const int side : {0, 1}) {
        walls[side] = add_wall(model, side == 0 ? "grip_top" : "grip_bottom");
        Vec3 place = x.center();
        place[along] = x.low[along] + grip;
        place[up] += (side == 0 ? 0.5 : -0.5) * height;
        const int body = pin_grain(model, state, walls[side], place, {up, side == 0 ? 1 : -1, middle});
        if (body < 0) throw InputError("test.crack_length", "no grain of an arm is left free to be pinned");
        pin += 0.5 * state.bodies.position[body][along];
    }
    const double a = x.low[along] + c.test.crack_length - pin;
    if (a <= 0.0) throw InputError("test.crack_length", "the crack ends before the pins; lengthen it");

    e.specimen.loaded_wall = walls[0];
    e.specimen.opposite_wall = walls[1];
    e.specimen.load_direction = axis_vector(up);
    e.specimen.compression = false;
    e.specimen.length = a + arms.foundation_length();  // strain: opening over the free length, for test.stop
    e.facts = {{"crack_length_m", a},
               {"foundation_length_m", arms.foundation_length()},
               {"arm_height_m", height},
               {"arm_width_m", width},
               {"arm_bending_stiffness_N_m2", arms.bending},
               {"arm_shear_stiffness_N", arms.shear},
               {"arm_foundation_N_per_m2", arms.foundation},
               {"compliance_m_per_N", arms.compliance(a)}};
    // the slowest bending wave of an arm, as in bending
    set_loading_stage(c, model, a * std::max(1.0, a / height), e);
    return e;
}

}  // namespace grainfrac
