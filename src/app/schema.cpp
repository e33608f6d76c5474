// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/options.h"
#include "io/input.h"

#include <fmt/format.h>

namespace grainfrac {

int schema_command()
{
    fmt::print("{}", input_json_schema());
    return exit_code::done;
}

}  // namespace grainfrac
