// SPDX-License-Identifier: GPL-3.0-or-later
#include "experiment/dcb.h"

#include "experiment/specimen.h"
#include "experiment/walls.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace grainfrac {

namespace {

/// Grips take the grains whose centre is within this many mean spacings of the end.
constexpr double default_grip = 1.1;

/// Normal stiffness of the bonded faces across the mid plane per area of that plane [Pa/m].
double foundation_stiffness(const State& state, int up, double middle)
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

double fact(const Experiment& e, const std::string& name)
{
    return std::find_if(e.facts.begin(), e.facts.end(), [&](const NamedResult& f) { return f.name == name; })->value;
}

/// G at the peak load, the fracture energy if the crack then began to grow.
std::vector<NamedResult> results(const Experiment& e, const std::vector<CurvePoint>& curve)
{
    double peak = 0.0;
    for (const CurvePoint& p : curve) peak = std::max(peak, p.load);
    const DcbArms arms{fact(e, "effective_crack_length_m"), fact(e, "foundation_length_m"),
                       fact(e, "arm_bending_stiffness_N_m2"), fact(e, "arm_width_m")};
    return {{"fracture_energy_J_per_m2", arms.release_rate(peak)}};
}

}  // namespace

double DcbArms::compliance() const
{
    return (length * length * length / 6.0 + foundation * foundation * foundation / 3.0) / bending;
}

double DcbArms::release_rate(double load) const
{
    return load * load * length * length / (4.0 * width * bending);
}

Experiment set_up_dcb(const Case& c, Model& model, State& state)
{
    const int up = axis_of(c.test.direction), along = up == 0 ? 1 : 0, across = 3 - up - along;
    const Extent x = specimen_extent(model, state);
    const double middle = x.center()[up], length = x.size()[along], width = x.size()[across];
    const double height = 0.5 * mean_section(model, state, along) / width;
    const double grip = c.test.grip_length.value_or(default_grip * model.nominal_length);
    if (c.test.crack_length >= length)
        throw InputError("test.crack_length", fmt::format("must be < {:.6g} m, the length of the arms", length));
    if (state.interfaces.size() == 0)
        throw InputError("test.kind", "a dcb test needs [[bonds]] of law = \"interface\" between the arms");
    const double k_n = foundation_stiffness(state, up, middle);
    if (k_n == 0.0) throw InputError("test.crack_length", "nothing joins the arms beyond the crack; shorten it");

    Experiment e;
    e.kind = c.test.kind;
    e.results = results;
    int walls[2] = {0, 0};
    for (const int sign : {1, -1}) {
        const int wall = add_wall(model, sign > 0 ? "grip_top" : "grip_bottom");
        walls[sign > 0 ? 0 : 1] = wall;
        if (grip_end(model, state, wall, along, -1, grip, {up, sign, middle}) == 0)
            throw InputError("test.grip_length", "no grain has its centre within this length of the end; raise it");
    }
    const double held = 0.5 * (mean_position(state, walls[0], along) + mean_position(state, walls[1], along));
    const double a = x.low[along] + c.test.crack_length - held;
    if (a <= 0.0) throw InputError("test.crack_length", "the crack ends within the grips; lengthen it");

    const double modulus = model.materials[static_cast<std::size_t>(model.groups.front().material)].young_modulus;
    DcbArms arms;
    arms.width = width;
    arms.bending = modulus * width * height * height * height / 12.0;
    arms.foundation = std::pow(4.0 * arms.bending / (2.0 * k_n * width), 0.25);
    arms.length = a + arms.foundation;
    e.specimen.loaded_wall = walls[0];
    e.specimen.opposite_wall = walls[1];
    e.specimen.load_direction = axis_vector(up);
    e.specimen.compression = false;
    e.specimen.length = arms.length;  // strain: opening over the free length, for test.stop
    e.facts = {{"crack_length_m", a},
               {"effective_crack_length_m", arms.length},
               {"foundation_length_m", arms.foundation},
               {"arm_height_m", height},
               {"arm_width_m", width},
               {"arm_bending_stiffness_N_m2", arms.bending},
               {"compliance_m_per_N", arms.compliance()}};
    // the slowest bending wave of an arm, as in bending
    set_loading_stage(c, model, a * std::max(1.0, a / height), e);
    return e;
}

}  // namespace grainfrac
