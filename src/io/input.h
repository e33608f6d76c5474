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

/// The same from a text; `file` is what messages call it, and what paths in it are relative to.
Case read_case_text(const std::string& text, const std::string& file, const std::vector<std::string>& overrides,
                    std::map<std::string, SourcePlace>& places_out);

/// One block per problem: `error: FILE:LINE: KEY = VALUE: MESSAGE` (line and value left out where there is none; for a
/// missing key the line of its table). `severity`: "error", "warning".
std::string render_problems(const std::vector<InputProblem>& problems, const std::map<std::string, SourcePlace>& places,
                            const std::string& file, const char* severity = "error");

/// The case as TOML with every default, in SI base units, comments naming the units: resolved.toml. Reading it back
/// gives the same Case.
std::string to_toml(const Case& c);

/// One entry of [[bonds]], as in to_toml.
std::string bonds_to_toml(const BondSpec& bond);

/// docs/input.md between its markers: every key with meaning, type, unit, default, range, source. A test holds the
/// committed file against this.
std::string input_reference_markdown();

/// JSON schema (draft 7) of input files for editors: names, types, units, allowed values, defaults, meaning. It knows
/// no dimensions, no ranges of quantities with a unit, and nothing that depends on other keys; `check` does.
std::string input_json_schema();

/// Starts of the ready-made inputs of new_case: every test.kind, and "calibrate".
std::vector<std::string> new_case_kinds();
/// A commented start file for a test: values that run as they are, every other key of its tables as a comment with its
/// default. Throws std::invalid_argument for an unknown kind.
std::string new_case(const std::string& kind);

}  // namespace grainfrac
