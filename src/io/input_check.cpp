// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/input_check.h"

#include "io/input_checks.h"
#include "io/input_document.h"

#include <fmt/format.h>

#include <algorithm>

namespace grainfrac {

namespace {

void check_calibration(Checks& checks, const CalibrationSpec& s, const std::string& key)
{
    const std::string part = joined(key, "part");
    if (!checks.given(part) || !checks.right(part) || !checks.names_right) return;
    std::vector<std::string> parts;
    for (const PartSpec& p : checks.input.parts) parts.push_back(p.name);
    if (std::find(parts.begin(), parts.end(), s.part) == parts.end())
        return checks.fail(part, fmt::format("no part of this name; {}", choice(s.part, parts)));
    if (!s.tensile_strength) return;
    for (std::size_t i = 0; i < checks.input.bonds.size(); ++i) {
        const auto& [a, b] = checks.input.bonds[i].between;
        if (a == s.part && b == s.part && checks.input.bonds[i].failure == "unbreakable")
            checks.fail(joined(key, "tensile_strength"), fmt::format("{} is unbreakable", joined("bonds", i)));
    }
}

void check_output(Checks& checks)
{
    const OutputSpec& o = checks.input.output;
    if (o.every && o.snapshots) return checks.fail("output.snapshots", "give either every or snapshots, not both");
    const bool has_end =
        checks.input.test.stop.time || std::any_of(checks.input.stages.begin(), checks.input.stages.end(),
                                                   [](const StageSpec& s) { return s.duration.has_value(); });
    if (o.snapshots && !has_end && checks.right("test.stop") && checks.right("stages")) {
        checks.fail("output.snapshots", "needs test.stop.time or a stage with a duration; or give every");
    }
}

}  // namespace

std::string choice(const std::string& name, const std::vector<std::string>& names)
{
    const std::string near = nearest(name, names);
    const std::string hint = near.empty() ? "" : fmt::format("; did you mean \"{}\"?", near);
    return (names.empty() ? "there are none" : fmt::format("there are \"{}\"", fmt::join(names, "\", \""))) + hint;
}

bool is_a(const Checks& checks, const char* kind, const std::string& name)
{
    return std::any_of(checks.input.parts.begin(), checks.input.parts.end(),
                       [&](const PartSpec& p) { return (p.name == name || p.material == name) && p.kind == kind; });
}

void check_case(const Case& c, std::vector<InputProblem>& problems)
{
    Checks checks{c, problems, {}, {}, {}, true, {}, {}, {}, {}, {}};
    for (const InputProblem& problem : problems) {
        for (std::string path = problem.key; !path.empty(); path = parent_path(path)) checks.wrong.insert(path);
    }
    check_names(checks);
    check_parts(checks);
    check_bonds(checks);
    check_walls(checks);
    for (std::size_t i = 0; i < c.calibration.size(); ++i)
        check_calibration(checks, c.calibration[i], joined("calibration", i));
    check_test(checks);
    check_output(checks);
}

}  // namespace grainfrac
