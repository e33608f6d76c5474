// SPDX-License-Identifier: GPL-3.0-or-later
#include "fracture/fibre_pressure.h"

#include "fracture/parallel_law.h"
#include "gpu/parallel.h"

#include <cmath>

namespace grainfrac {

namespace {

struct FibrePressures {
    static constexpr const char* name = "fibre pressures";
    View<const Vec3> position;
    View<const std::int32_t> bond_a, bond_b, cause, kind;
    View<const SphereBondKind> kinds;
    View<const std::int32_t> before, after;
    View<const double> at_rest, contraction, section;
    View<double> pressure;

    /// Pull in a bond of the fibre; both forms of the bond take it from their length.
    GF_FN double pull(int bond) const
    {
        if (cause[bond] != static_cast<int>(BondCause::whole)) return 0.0;
        const SphereBondKind& k = kinds[kind[bond]];
        return k.normal_stiffness * (norm(position[bond_b[bond]] - position[bond_a[bond]]) - k.length);
    }
    GF_FN void operator()(int i) const
    {
        if (contraction[i] == 0.0) return;
        double sum = 0.0;
        int bonds = 0;
        for (const int bond : {before[i], after[i]}) {
            if (bond < 0) continue;
            sum += pull(bond);
            ++bonds;
        }
        const double stress = bonds > 0 ? sum / (bonds * section[i]) : 0.0;
        pressure[i] = larger(0.0, at_rest[i] - contraction[i] * stress);
    }
};

}  // namespace

double contraction_of(const Material& fibre, const Material& matrix)
{
    const double E_f = fibre.young_modulus, nu_f = fibre.poisson_ratio, E_m = matrix.young_modulus,
                 nu_m = matrix.poisson_ratio;
    return nu_f * E_m / ((1.0 - nu_f) * E_m + (1.0 + nu_m) * E_f);
}

void fibre_pressures(const Model& model, State& state)
{
    if (!model.fibres_contract) return;
    const Device d = model.device;
    InterfaceBonds& f = state.interfaces;
    const SphereBonds& p = state.sphere_bonds;
    parallel_for(
        d, f.size(),
        FibrePressures{state.bodies.position.read(d), p.a.read(d), p.b.read(d), p.cause.read(d), p.kind.read(d),
                       p.kinds.read(d), f.bond_before.read(d), f.bond_after.read(d), f.pressure_at_rest.read(d),
                       f.contraction.read(d), f.fibre_section.read(d), f.pressure.write(d)});
}

}  // namespace grainfrac
