// SPDX-License-Identifier: GPL-3.0-or-later
// paraview/view.py: the script that opens a result folder in ParaView.
#pragma once

#include <string>

namespace grainfrac {

/// The script's text; it finds the layers beside itself. `fibre`: what is around a fibre is cut open.
std::string view_script(bool fibre);

}  // namespace grainfrac
