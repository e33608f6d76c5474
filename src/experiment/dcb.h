// SPDX-License-Identifier: GPL-3.0-or-later
// Double cantilever beam: two arms joined along the mid plane up to a starter crack are pulled apart at the cracked
// end.
#pragma once

#include "experiment/experiment.h"

namespace grainfrac {

/// The end grains of either arm are gripped ("grip_top", "grip_bottom"): they move apart and do not turn. Arms of
/// height H, width b, I = b H^3/12; a from the grips' centres to the crack tip; foundation of the joined part Lambda^4
/// = 2 k_n b/(4 E I) (Kanninen 1973, Int. J. Fract. 9, 83). With ends that cannot turn the moment there is P(a +
/// 1/Lambda)/2, and
///     Delta = P/(EI) [(a + 1/Lambda)^3/6 + 1/(3 Lambda^3)],   G = P^2 (a + 1/Lambda)^2/(4 b E I),
/// a quarter of that of free ends, so that the crack grows while the load falls as 1/(a + 1/Lambda).
Experiment set_up_dcb(const Case& c, Model& model, State& state);

/// Arms on an elastic foundation, ends that do not turn.
struct DcbArms {
    double length = 0.0;      ///< a + 1/Lambda [m]
    double foundation = 0.0;  ///< 1/Lambda [m]
    double bending = 0.0;     ///< E I of one arm [N m^2]
    double width = 0.0;       ///< b [m]

    /// Delta/P [m/N].
    double compliance() const;
    /// G of a load P [J/m^2].
    double release_rate(double load) const;
};

}  // namespace grainfrac
