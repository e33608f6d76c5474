// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/input_checks.h"
#include "io/input_document.h"

#include <fmt/format.h>

#include <algorithm>

namespace grainfrac {

namespace {

void check_pull_out(Checks& checks)
{
    const TestSpec& t = checks.input.test;
    const auto named = [&](const std::string& name) {
        return std::find_if(checks.input.parts.begin(), checks.input.parts.end(),
                            [&](const PartSpec& p) { return p.name == name; });
    };
    std::vector<std::string> names;
    for (const PartSpec& p : checks.input.parts) names.push_back(p.name);
    for (const auto& [key, name] : {std::pair<std::string, std::string>{"test.fibre", t.fibre},
                                    std::pair<std::string, std::string>{"test.matrix", t.matrix}}) {
        if (checks.given(key) && checks.right(key) && checks.right("parts") && named(name) == checks.input.parts.end())
            checks.fail(key, "no such part; " + choice(name, names));
    }
    if (checks.right("test.fibre") && checks.right("parts") && named(t.fibre) != checks.input.parts.end()) {
        const PartSpec& p = *named(t.fibre);
        if (p.kind != "spheres" || (p.generator != "chain" && p.generator != "taken"))
            checks.fail("test.fibre", "must be a part of spheres with generator = \"chain\" or \"taken\"");
        if (t.fibre == t.matrix && checks.right("test.matrix"))
            checks.fail("test.matrix", "must be another part than test.fibre");
    }
    if (norm2(checks.input.control.gravity) > 0.0 && t.control != "speed" && checks.right("control.gravity"))
        checks.fail("control.gravity", "has no place in a row of equilibria; use test.control = \"speed\"");
    const bool cleaves = std::any_of(checks.input.materials.begin(), checks.input.materials.end(),
                                     [](const MaterialSpec& m) { return !m.cleavage.planes.empty(); });
    if (cleaves && t.control != "speed" && checks.right("test.control"))
        checks.fail("test.control", "must be \"speed\" where grains cleave");
}

void check_spans(Checks& checks)
{
    const TestSpec& t = checks.input.test;
    if (!checks.right("test.inner_span") || !checks.right("test.outer_span") || !(t.outer_span > 0.0)) return;
    if (t.kind == "four_point_bending" && checks.given("test.inner_span") && t.inner_span == 0.0)
        return checks.fail("test.inner_span", "must be > 0 m; one loading roller is kind = \"three_point_bending\"");
    if (t.inner_span >= t.outer_span)
        checks.fail("test.inner_span", fmt::format("must be < {:.6g} m, the outer span", t.outer_span));
}

void check_drop(Checks& checks)
{
    const Vec3& g = checks.input.control.gravity;
    const int along = (g.x != 0.0 ? 1 : 0) + (g.y != 0.0 ? 1 : 0) + (g.z != 0.0 ? 1 : 0);
    if (along > 1 && checks.right("control.gravity"))
        checks.fail("control.gravity", "must point along an axis in a drop test; left out it is 9.81 m/s^2 along -z");
}

void check_brazilian(Checks& checks)
{
    if (checks.input.test.direction == "z" && checks.right("test.direction"))
        checks.fail("test.direction", "must be \"x\" or \"y\" in a brazilian test");
    if (checks.input.parts.empty() || !checks.right("parts[0].region")) return;
    const RegionSpec& region = checks.input.parts[0].region;
    const std::string path = "parts[0].region";
    if (!checks.given(path))
        return checks.fail(path, "missing; required with test.kind = \"brazilian\": a disc or cylinder");
    if (region.shape != "cylinder" && region.shape != "disc") {
        return checks.fail(path + ".shape", "must be \"disc\" or \"cylinder\" in a brazilian test");
    }
    if (region.axis != "z") checks.fail(path + ".axis", "must be \"z\" in a brazilian test");
    const auto& half_width = checks.input.test.contact_half_width;
    if (half_width && *half_width > 0.5 * region.diameter && checks.right("test.contact_half_width")) {
        checks.fail("test.contact_half_width",
                    fmt::format("must be <= {:.6g} m, half the diameter of the disc", 0.5 * region.diameter));
    }
    if (checks.input.test.platen == "curved" && checks.input.test.platen_radius > 0.0 &&
        checks.input.test.platen_radius < 0.5 * region.diameter && checks.right("test.platen_radius")) {
        checks.fail("test.platen_radius",
                    fmt::format("must be 0 or >= {:.6g} m, the radius of the disc", 0.5 * region.diameter));
    }
}

void check_ready_made(Checks& checks)
{
    const TestSpec& t = checks.input.test;
    const std::string a_test = fmt::format("a {} test", t.kind);
    for (std::size_t i = 0; i < checks.input.stages.size(); ++i) {
        checks.fail(joined("stages", i), a_test + " makes its own stages; use test.kind = \"custom\"");
    }
    if (checks.right("test.stop")) {
        if (t.kind == "drop") {
            if (!t.stop.time && !t.stop.rest)
                checks.fail("test.stop", "the run would never end; required: at least one of time, rest");
            if (t.stop.load_drop) checks.fail("test.stop.load_drop", "has no meaning in a drop test; use time or rest");
            if (t.stop.strain) checks.fail("test.stop.strain", "has no meaning in a drop test; use time or rest");
        } else {
            const bool ends_itself = t.kind == "pull_out" && t.control == "damage";
            const bool has_end = t.stop.load_drop || t.stop.strain || t.stop.time || t.stop.slip || t.stop.damage;
            if (!ends_itself && !has_end)
                checks.fail("test.stop",
                            fmt::format("the run would never end; required: at least one of load_drop, strain, time{}",
                                        t.kind == "pull_out" ? ", slip, damage" : ""));
            if (t.stop.rest) checks.fail("test.stop.rest", "has no meaning here; it goes with kind = \"drop\"");
        }
    }
    if (t.kind == "brazilian") check_brazilian(checks);
    if (t.kind == "four_point_bending" || t.kind == "notched_beam") check_spans(checks);
    if (t.kind == "drop") check_drop(checks);
    if (t.kind == "pull_out") check_pull_out(checks);
}

/// Every stage ends, or the run does.
void check_custom(Checks& checks)
{
    if (checks.input.stages.empty()) {
        if (checks.right("stages"))
            checks.fail("stages", "missing; required with test.kind = \"custom\": at least one [[stages]]");
        return;
    }
    for (std::size_t i = 0; i < checks.input.stages.size(); ++i) {
        const StageSpec& s = checks.input.stages[i];
        const bool ends = s.duration || s.unbalanced_force_ratio || s.rest || s.load || s.stress || s.load_drop ||
                          s.max_displacement || s.kind == "bond" || s.kind == "unload";
        const bool last = i + 1 == checks.input.stages.size();
        if (ends || (last && checks.input.test.stop.time) || !checks.right(joined("stages", i)) ||
            !checks.right("test.stop"))
            continue;
        checks.fail(joined("stages", i),
                    fmt::format("never ends; required: at least one of duration, max_displacement, load, stress, "
                                "load_drop, unbalanced_force_ratio, rest{}",
                                last ? ", or test.stop.time" : ""));
    }
}

}  // namespace

void check_test(Checks& checks)
{
    const Case& c = checks.input;
    const bool only_calibrates = !c.calibration.empty() && !checks.given("test") && c.stages.empty();
    if (!checks.right("test.kind") || only_calibrates) return;
    if (c.test.kind == "custom")
        check_custom(checks);
    else
        check_ready_made(checks);
}

}  // namespace grainfrac
