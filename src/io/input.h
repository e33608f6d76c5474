// SPDX-License-Identifier: GPL-3.0-or-later
// From a TOML file to a Case in SI units, with every mistake reported at once.
#pragma once

#include "model/case.h"

#include <string>
#include <vector>

namespace grainfrac {

/// Read FILE.toml, apply `overrides` ("key.path=value", parsed as TOML, in order), check every key's name, type, unit,
/// dimension and range, and the references between tables. Throws InputError with all problems; each InputProblem::key
/// can be looked up in the places that render_problems needs, which travel in `places_out` even when this throws.
Case read_case(const std::string& file, const std::vector<std::string>& overrides,
               std::map<std::string, SourcePlace>& places_out);

/// One block per problem: `error: FILE:LINE: KEY = VALUE: MESSAGE` (line and value left out where there is none; for a
/// missing key the line of its table).
std::string render_problems(const std::vector<InputProblem>& problems, const std::map<std::string, SourcePlace>& places,
                            const std::string& file);

/// The case as TOML with every default, in SI base units, comments naming the units: resolved.toml. Reading it back
/// gives the same Case.
std::string to_toml(const Case& c);

/// One entry of [[bonds]], as in to_toml.
std::string bonds_to_toml(const BondSpec& bond);

/// docs/input.md between its markers: every key with meaning, type, unit, default, range, source. A test holds the
/// committed file against this.
std::string input_reference_markdown();

}  // namespace grainfrac
