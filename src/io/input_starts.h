// SPDX-License-Identifier: GPL-3.0-or-later
// What the start files of `grainfrac new` set: small specimens that break within seconds.
#pragma once

#include <string>
#include <vector>

namespace grainfrac {

struct InputStart {
    std::string kind;   ///< test.kind, or "calibrate"
    std::string about;  ///< what the file is for
    std::string text;   ///< TOML
};
const std::vector<InputStart>& input_starts();

}  // namespace grainfrac
