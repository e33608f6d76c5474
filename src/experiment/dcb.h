// SPDX-License-Identifier: GPL-3.0-or-later
// Double cantilever beam: two arms joined along the mid plane up to a starter crack are pulled apart at the cracked
// end.
#pragma once

#include "experiment/experiment.h"

namespace grainfrac {

/// The arms are opened by a pin each ("grip_top", "grip_bottom"): the grain at the arm's mid height that is nearest to
/// test.grip_length from the cracked end moves with the wall, turns freely, and its bonds do not break. So both ends
/// bear the load P and no moment. The crack length a is from the pins to the tip.
Experiment set_up_dcb(const Case& c, Model& model, State& state);

/// Two Timoshenko arms on elastic foundations, ends free to turn: bending stiffness EI, shear stiffness S, width b,
/// foundation k of an arm, Lambda^4 = k/(4 EI), a from the load to the crack tip. With f^2 = 1/Lambda^2 + EI/S
///     Delta = 2P/(3EI) [a^3 + 3 a^2 f + 3 a f^2 + 3 f/(2 Lambda^2)],   G = P^2 (a + f)^2/(b EI);
/// S infinite: f = 1/Lambda (Kanninen 1973, Int. J. Fract. 9, 83).
struct DcbArms {
    double bending = 0.0;     ///< EI of one arm [N m^2]
    double shear = 0.0;       ///< S of one arm [N]
    double foundation = 0.0;  ///< k: force per length and half the opening [N/m^2]
    double width = 0.0;       ///< b [m]

    /// f [m].
    double foundation_length() const;
    /// Delta/P of a crack of length a [m/N].
    double compliance(double a) const;
    /// Crack length of a compliance [m]; where the joint softens, that of a crack without process zone as compliant.
    double crack_length(double compliance) const;
    /// G of a load P [J/m^2].
    double release_rate(double load, double a) const;
    /// Traction of the foundation at the tip [Pa].
    double tip_traction(double load, double a) const;
};

}  // namespace grainfrac
