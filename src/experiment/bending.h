// SPDX-License-Identifier: GPL-3.0-or-later
// Bending of a beam over rollers: three-point, four-point, and three- or four-point with a notch.
#pragma once

#include "experiment/experiment.h"

namespace grainfrac {

/// Two supports "roller_bottom", outer_span apart, and one or two loading rollers "roller_top", inner_span apart; each
/// touches the beam without overlap. The load acts along test.direction, the beam lies along x (along y if the load
/// acts along x). With P the total load, a the distance of outer and inner roller (half of outer_span for one), w and t
/// height and thickness of the beam, L the outer span:
///     sigma = 3 P a/(t w^2)  (3 P L/(2 t w^2) for one roller),
///     epsilon = 3 w delta/(a (3 L - 4 a)), delta the way of the loading rollers  (6 w delta/L^2 for one roller),
/// the stress and strain of the outermost fibre of an elastic beam between the loading rollers. The compliance of the
/// rollers' contacts is part of delta.
Experiment set_up_bending(const Case& c, Model& model, State& state);

/// Stress intensity of an edge crack of depth alpha W in bending over sigma sqrt(pi a), sigma = 6 M/(B W^2).
/// `span_ratio`: span over height S/W under one roller, 0 for pure bending.
/// Pure bending: 1.122 - 1.40 alpha + 7.33 alpha^2 - 13.08 alpha^3 + 14.0 alpha^4 (Tada, Paris and Irwin), alpha <=
/// 0.6. S/W = 4: (1.99 - alpha(1 - alpha)(2.15 - 3.93 alpha + 2.7 alpha^2))/(sqrt(pi)(1 + 2 alpha)(1 - alpha)^1.5)
/// (ASTM E399). Between them linear in W/S; below S/W = 4 as at 4.
double notch_factor(double alpha, double span_ratio);

}  // namespace grainfrac
