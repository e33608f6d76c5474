// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/input_checks.h"
#include "io/input_document.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace grainfrac {

namespace {

/// Of a wall or of a stage's move: one target, a direction, no velocity besides.
void check_servo(Checks& checks, const ServoSpec& s, const std::string& owner, bool has_normal)
{
    const std::string path = owner + ".servo";
    if (!checks.given(path) || !checks.right(path)) return;
    if (s.force.has_value() == s.stress.has_value()) {
        checks.fail(path, fmt::format("has {} of force, stress; must have exactly one: the push that the wall holds",
                                      s.force ? "both" : "none"));
    }
    if (checks.given(path + ".direction") && norm2(s.direction) == 0.0) {
        checks.fail(path + ".direction", "must not be zero");
    } else if (!checks.given(path + ".direction") && !has_normal) {
        checks.fail(path, "direction is missing; required for a wall that is no plate: where it pushes");
    }
    if (checks.given(owner + ".velocity")) checks.fail(owner + ".velocity", "give either velocity or servo, not both");
}

void check_wall(Checks& checks, const WallSpec& w, const std::string& path)
{
    if (!checks.right(path + ".shape")) return;
    if (w.shape == "plate" && norm2(w.normal) == 0.0 && checks.right(path + ".normal"))
        checks.fail(path + ".normal", "must not be zero");
    if (w.shape == "cylinder" && norm2(w.axis) == 0.0 && checks.right(path + ".axis"))
        checks.fail(path + ".axis", "must not be zero");
    const std::size_t lengths = w.shape == "box" ? 3 : 2;
    if ((w.shape == "box" || w.shape == "plate") && checks.given(path + ".size") && checks.right(path + ".size") &&
        w.size.size() != lengths) {
        checks.fail(path + ".size", fmt::format("has {} entries; a {} must have {} such as [{}\"1 m\", \"1 m\"]",
                                                w.size.size(), w.shape, lengths, lengths == 3 ? "\"1 m\", " : ""));
    }
    const std::set<std::string> open(w.open.begin(), w.open.end());
    if (checks.right(path + ".open") && open.size() != w.open.size()) checks.fail(path + ".open", "names a side twice");
    if (checks.right(path + ".open") && open.size() == 6) checks.fail(path + ".open", "no side of the box is left");
    if (w.shape == "stl" && checks.given(path + ".file") && checks.right(path + ".file") && w.file.empty())
        checks.fail(path + ".file", "must not be empty");
    check_servo(checks, w.servo, path, w.shape == "plate");
    if (checks.given(path + ".servo") && checks.input.test.kind != "custom" && checks.right("test.kind")) {
        checks.fail(path + ".servo",
                    fmt::format("a {} test drives its own walls; use test.kind = \"custom\"", checks.input.test.kind));
    }
}

void check_grip(Checks& checks, const GripSpec& g, const std::string& path)
{
    if (checks.input.test.kind != "custom" && checks.right("test.kind"))
        checks.fail(path,
                    fmt::format("a {} test holds its own bodies; use test.kind = \"custom\"", checks.input.test.kind));
    if (checks.given(path + ".part") && checks.right(path + ".part") && checks.names_right) {
        std::vector<std::string> parts;
        for (const PartSpec& p : checks.input.parts) parts.push_back(p.name);
        if (std::find(parts.begin(), parts.end(), g.part) == parts.end())
            checks.fail(path + ".part", "no such part; " + choice(g.part, parts));
    }
    if (checks.given(path + ".at") && checks.given(path + ".region"))
        checks.fail(path + ".region", "give either at or region, not both");
    const std::string key = path + ".hold";
    if (!checks.given(key) || !checks.right(key)) return;
    if (std::set<std::string>(g.hold.begin(), g.hold.end()).size() != g.hold.size())
        checks.fail(key, "names one of them twice");
}

const WallSpec* wall_named(const Checks& checks, const std::string& name)
{
    for (const WallSpec& w : checks.input.walls) {
        if (w.name == name) return &w;
    }
    return nullptr;
}

/// Whether a wall moves in the stage: one that it names, or one with a motion of its own.
bool moves_a_wall(const Checks& checks, const StageSpec& s)
{
    const auto named = [&](const auto& w) {
        return std::any_of(s.motions.begin(), s.motions.end(), [&](const StageMotion& m) { return m.wall == w.name; });
    };
    return std::any_of(s.motions.begin(), s.motions.end(), [](const StageMotion& m) { return m.moves(); }) ||
           std::any_of(checks.input.walls.begin(), checks.input.walls.end(),
                       [&](const WallSpec& w) { return (norm2(w.velocity) > 0.0 || w.servo.given()) && !named(w); }) ||
           std::any_of(checks.input.grips.begin(), checks.input.grips.end(),
                       [&](const GripSpec& g) { return norm2(g.velocity) > 0.0 && !named(g); });
}

/// A stage in which the walls go back by themselves needs one before it in which they went forth.
void check_way_back(Checks& checks, std::size_t i)
{
    const std::string path = joined("stages", i);
    std::size_t k = i;
    while (k > 0 && !moves_a_wall(checks, checks.input.stages[k - 1])) --k;
    if (k == 0) return checks.fail(path, "no wall moved before; say in move how walls go back");
    for (const WallSpec& w : checks.input.walls) {
        if (w.servo.given())
            checks.fail(path, fmt::format("wall \"{}\" holds a push; say in move how it goes back", w.name));
    }
    for (const StageMotion& m : checks.input.stages[k - 1].motions) {
        if (!m.servo.given()) continue;
        checks.fail(path, fmt::format("wall \"{}\" held a push before; say in move how it goes back", m.wall));
    }
}

void check_stage(Checks& checks, const StageSpec& s, std::size_t i)
{
    const std::string path = joined("stages", i);
    if (s.kind == "bond" && checks.right(path) &&
        std::none_of(checks.input.bonds.begin(), checks.input.bonds.end(),
                     [&](const BondSpec& b) { return b.made_in == s.name; })) {
        checks.fail(path, fmt::format("makes no bonds; required: [[bonds]] with made_in = \"{}\"", s.name));
    }
    std::set<std::string> moved;
    for (std::size_t k = 0; k < s.motions.size(); ++k) {
        const std::string entry = joined(path + ".move", k), key = entry + ".wall";
        if (checks.right(entry) && !checks.given(entry + ".velocity") && !checks.given(entry + ".servo"))
            checks.fail(entry, "must have velocity or servo");
        if (!checks.given(key) || !checks.right(key)) continue;
        const std::string& name = s.motions[k].wall;
        const WallSpec* wall = wall_named(checks, name);
        const bool is_grip =
            std::find(checks.grip_names.begin(), checks.grip_names.end(), name) != checks.grip_names.end();
        if (is_grip && checks.given(entry + ".servo"))
            checks.fail(entry + ".servo", "a grip has no servo; give its velocity");
        if (wall == nullptr && !is_grip) {
            checks.fail(key, "no such wall; " + choice(name, checks.wall_names));
            continue;
        }
        if (!moved.insert(name).second) checks.fail(key, "this wall is moved already in this stage");
        if (!is_grip) check_servo(checks, s.motions[k].servo, entry, wall->shape == "plate");
    }
    for (std::size_t k = 0; k < s.release.size(); ++k) {
        const std::string key = joined(path + ".release", k), &name = s.release[k];
        if (!checks.right(path + ".release")) continue;
        if (std::find(checks.grip_names.begin(), checks.grip_names.end(), name) == checks.grip_names.end())
            checks.fail(key, "no such grip; " + choice(name, checks.grip_names));
        else if (moved.count(name) > 0)
            checks.fail(key, "this grip is moved in this stage; it cannot let go too");
        else if (!checks.released.insert(name).second)
            checks.fail(key, "this grip has let go already");
    }
    for (const std::string& name : moved) {
        if (checks.released.count(name) > 0 && std::find(s.release.begin(), s.release.end(), name) == s.release.end())
            checks.fail(path, fmt::format("grip \"{}\" has let go in an earlier stage; it cannot move", name));
    }
    if (!checks.right(path)) return;
    const bool goes_back = s.kind == "unload" && s.motions.empty();
    if (goes_back) check_way_back(checks, i);
    if (goes_back || moves_a_wall(checks, s)) return;
    const auto needs_motion = [&](const char* key, const std::optional<double>& value) {
        if (value) checks.fail(path + key, "no wall moves in this stage");
    };
    needs_motion(".max_displacement", s.max_displacement);
    needs_motion(".load", s.load);
    needs_motion(".stress", s.stress);
}

}  // namespace

void check_walls(Checks& checks)
{
    const Case& c = checks.input;
    for (std::size_t i = 0; i < c.walls.size(); ++i) check_wall(checks, c.walls[i], joined("walls", i));
    for (std::size_t i = 0; i < c.grips.size(); ++i) check_grip(checks, c.grips[i], joined("grips", i));
    for (std::size_t i = 0; i < c.stages.size(); ++i) check_stage(checks, c.stages[i], i);
}

}  // namespace grainfrac
