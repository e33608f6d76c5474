// SPDX-License-Identifier: GPL-3.0-or-later
// Quantities with units, from text to SI, by UDUNITS.
#pragma once

#include <string>

namespace grainfrac {

/// Value in SI of a text such as "15 mm", "2.5 MPa m^0.5", "60 deg", checked against the dimension of `si_unit`
/// ("m", "Pa", "Pa m^0.5", "rad", "1"). Throws std::invalid_argument with a message that says what was found and what
/// is allowed ("\"15 kg\" is a mass; expected a length, e.g. \"1 m\"").
double parse_quantity(const std::string& text, const std::string& si_unit);

}  // namespace grainfrac
