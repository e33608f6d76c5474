// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/input_check.h"

#include "generate/crystal.h"
#include "generate/random_packing.h"
#include "io/input_document.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <tuple>
#include <type_traits>

namespace grainfrac {
namespace {

class Checks {
public:
    Checks(const Case& c, std::vector<InputProblem>& problems) : c_(c), problems_(problems)
    {
        for (const InputProblem& problem : problems_) {
            for (std::string path = problem.key; !path.empty(); path = parent_path(path)) wrong_.insert(path);
        }
    }

    void run()
    {
        collect_names();
        for (std::size_t i = 0; i < c_.parts.size(); ++i) part(c_.parts[i], joined("parts", i));
        pairs("bonds", c_.bonds);
        pairs("contacts", c_.contacts);
        for (std::size_t i = 0; i < c_.bonds.size(); ++i) bond(c_.bonds[i], joined("bonds", i));
        for (std::size_t i = 0; i < c_.walls.size(); ++i) wall(c_.walls[i], joined("walls", i));
        for (std::size_t i = 0; i < c_.grips.size(); ++i) grip(c_.grips[i], joined("grips", i));
        for (std::size_t i = 0; i < c_.stages.size(); ++i) stage(c_.stages[i], i);
        for (std::size_t i = 0; i < c_.calibration.size(); ++i)
            calibration(c_.calibration[i], joined("calibration", i));
        const bool only_calibrates = !c_.calibration.empty() && !given("test") && c_.stages.empty();
        if (right("test.kind") && !only_calibrates) {
            if (c_.test.kind == "custom")
                custom();
            else
                ready_made();
        }
        output();
    }

private:
    bool given(const std::string& key) const { return c_.places.count(key) > 0; }
    /// Nothing is wrong with the key or below it.
    bool right(const std::string& key) const { return wrong_.count(key) == 0; }
    void fail(const std::string& key, std::string message) { problems_.push_back({key, std::move(message)}); }

    /// `names` and, if one is near, which of them was probably meant.
    static std::string choice(const std::string& name, const std::vector<std::string>& names)
    {
        const std::string near = nearest(name, names);
        const std::string hint = near.empty() ? "" : fmt::format("; did you mean \"{}\"?", near);
        return (names.empty() ? "there are none" : fmt::format("there are \"{}\"", fmt::join(names, "\", \""))) + hint;
    }

    static bool is_name(const std::string& name)
    {
        return !name.empty() && std::all_of(name.begin(), name.end(), [](char ch) {
            return (ch >= 'a' && ch <= 'z') || (ch >= 'A' && ch <= 'Z') || (ch >= '0' && ch <= '9') || ch == '_' ||
                   ch == '-';
        });
    }

    /// Enters a name that `between` can hold; parts, materials and walls share one list, so that a name is never two
    /// things.
    void enter_name(const std::string& name, const std::string& key, const std::string& what)
    {
        if (!given(key) || !right(key) || !is_name(name)) names_right_ = false;
        if (!given(key) || !right(key)) return;
        if (!is_name(name))
            return fail(key, fmt::format("the name of {} must consist of letters, digits, _ and -", what));
        const std::vector<std::string> walls = walls_of_test();
        if (std::find(walls.begin(), walls.end(), name) != walls.end())
            return fail(key, fmt::format("this name belongs to the walls of the {} test", c_.test.kind));
        if (const auto [entry, is_new] = owner_.try_emplace(name, what); !is_new) {
            fail(key, fmt::format("{} of this name exists already; parts, materials and walls need different names",
                                  entry->second));
        }
    }

    /// Names of the walls that a ready-made test makes.
    std::vector<std::string> walls_of_test() const
    {
        const std::string& kind = c_.test.kind;
        if (kind == "drop") return {"floor", "sides"};
        if (kind == "uniaxial_tension" || kind == "dcb") return {"grip_top", "grip_bottom"};
        if (kind == "brazilian" || kind == "uniaxial_compression") {
            if (kind == "uniaxial_compression" && c_.test.ends == "gripped") return {"grip_top", "grip_bottom"};
            return {"platen", "platen_top", "platen_bottom"};
        }
        return kind == "custom" ? std::vector<std::string>{}
                                : std::vector<std::string>{"roller", "roller_top", "roller_bottom"};
    }

    void calibration(const CalibrationSpec& s, const std::string& key)
    {
        const std::string part = joined(key, "part");
        if (!given(part) || !right(part) || !names_right_) return;
        std::vector<std::string> parts;
        for (const PartSpec& p : c_.parts) parts.push_back(p.name);
        if (std::find(parts.begin(), parts.end(), s.part) == parts.end())
            return fail(part, fmt::format("no part of this name; {}", choice(s.part, parts)));
        if (!s.tensile_strength) return;
        for (std::size_t i = 0; i < c_.bonds.size(); ++i) {
            const auto& [a, b] = c_.bonds[i].between;
            if (a == s.part && b == s.part && c_.bonds[i].failure == "unbreakable")
                fail(joined(key, "tensile_strength"), fmt::format("{} is unbreakable", joined("bonds", i)));
        }
    }

    void collect_names()
    {
        for (const InputProblem& problem : problems_) {  // one of these is no table: there are names that are not known
            const std::string& key = problem.key;
            if (key == "materials" || key == "parts" || key == "walls" || key == "grips") names_right_ = false;
        }
        for (const MaterialSpec& m : c_.materials) {
            enter_name(m.name, joined("materials", m.name), "a material");
            for (std::size_t k = 0; k < m.cleavage.planes.size(); ++k) {
                try {
                    parse_crystal_planes(m.cleavage.planes[k]);
                } catch (const std::invalid_argument& e) {
                    fail(fmt::format("{}.cleavage.planes[{}]", joined("materials", m.name), k), e.what());
                }
            }
            const std::string cleavage = joined("materials", m.name) + ".cleavage.", toughness = cleavage + "toughness";
            for (std::size_t k = 0; k < m.cleavage.planes.size(); ++k) {
                const auto first = std::find(m.cleavage.planes.begin(), m.cleavage.planes.end(), m.cleavage.planes[k]);
                if (first - m.cleavage.planes.begin() < static_cast<std::ptrdiff_t>(k))
                    fail(fmt::format("{}planes[{}]", cleavage, k), "is listed already");
            }
            const std::optional<double> residual = m.cleavage.residual_friction;
            if (m.cleavage.new_surface == "pre_cut" && residual && *residual > m.cleavage.friction &&
                right(cleavage + "residual_friction") && right(cleavage + "friction")) {
                fail(cleavage + "residual_friction",
                     fmt::format("must be <= friction, {}, with new_surface = \"pre_cut\": broken planes would create "
                                 "energy",
                                 m.cleavage.friction));
            }
            const std::size_t count = m.cleavage.toughness.size(), families = m.cleavage.planes.size();
            if (families > 0 && count > 1 && count != families && right(toughness)) {
                fail(toughness,
                     fmt::format("has {} values; must have one for all planes, or {} as `planes`", count, families));
            }
            material_names_.push_back(m.name);
        }
        for (std::size_t i = 0; i < c_.parts.size(); ++i) {
            enter_name(c_.parts[i].name, joined("parts", i) + ".name", "a part");
        }
        for (std::size_t i = 0; i < c_.walls.size(); ++i) {
            enter_name(c_.walls[i].name, joined("walls", i) + ".name", "a wall");
            wall_names_.push_back(c_.walls[i].name);
        }
        for (std::size_t i = 0; i < c_.grips.size(); ++i) {
            enter_name(c_.grips[i].name, joined("grips", i) + ".name", "a grip");
            wall_names_.push_back(c_.grips[i].name);
            grip_names_.push_back(c_.grips[i].name);
        }
        std::set<std::string> stages;
        for (std::size_t i = 0; i < c_.stages.size(); ++i) {
            const std::string key = joined("stages", i) + ".name";
            if (!given(key) || !right(key)) continue;
            if (!is_name(c_.stages[i].name)) fail(key, "the name of a stage must consist of letters, digits, _ and -");
            if (!stages.insert(c_.stages[i].name).second) fail(key, "a stage of this name exists already");
            if (c_.stages[i].kind == "bond") bond_stages_.push_back(c_.stages[i].name);
        }
        for (const auto& [name, what] : owner_) pair_names_.push_back(name);
        for (const std::string& name : walls_of_test()) pair_names_.push_back(name);
        pair_names_.emplace_back("*");
    }

    void part(const PartSpec& p, const std::string& path)
    {
        if (given(path + ".material") && right(path + ".material") &&
            std::find(material_names_.begin(), material_names_.end(), p.material) == material_names_.end()) {
            fail(path + ".material", "no such material; " + choice(p.material, material_names_));
        }
        if (given(path + ".file") && p.file.empty() && right(path + ".file")) fail(path + ".file", "must not be empty");
        orientation(p.orientation, path + ".orientation");
        if (right(path + ".kind") && right(path + ".generator")) spheres_or_grains(p, path);

        if (p.dilation_radius && p.generator == "hexagonal_prisms" && right(path + ".dilation_radius")) {
            const double rho = *p.dilation_radius, inradius = 0.5 * std::min(std::sqrt(3.0) * p.side, p.thickness);
            const bool sides_right =
                p.side > 0.0 && p.thickness > 0.0 && right(path + ".side") && right(path + ".thickness");
            if (sides_right && inradius < 3.0 * rho) {
                fail(
                    path + ".dilation_radius",
                    fmt::format(
                        "must be <= {:.6g} m, a third of the inradius of the prism (side {:.6g} m, thickness {:.6g} m)",
                        inradius / 3.0, p.side, p.thickness));
            }
        }
    }

    /// What goes with only one kind of part.
    void spheres_or_grains(const PartSpec& p, const std::string& path)
    {
        const bool prisms = p.generator == "hexagonal_prisms", file = p.generator == "file";
        if (p.kind == "grains") {
            if (!prisms && !file)
                fail(path + ".generator", "must be one of \"hexagonal_prisms\", \"file\" with kind = \"grains\"");
            if (p.region.shape == "sphere" && right(path + ".region.shape"))
                fail(path + ".region.shape",
                     "must be one of \"box\", \"beam\", \"cylinder\", \"disc\" with kind = \"grains\"");
            return;
        }
        if (prisms && given(path + ".generator")) {
            fail(path + ".generator",
                 "must be one of \"hcp\", \"fcc\", \"random_dense\", \"chain\", \"taken\", \"file\" with kind = "
                 "\"spheres\"");
        }
        if (given(path + ".orientation"))
            fail(path + ".orientation", "has no meaning here; it goes with kind = \"grains\"");
        if (p.generator == "chain" && given(path + ".region"))
            fail(path + ".region", "has no meaning here; it goes with any generator but \"chain\"");
        if (given(path + ".inside") && right(path + ".inside")) host(p, path + ".inside");
        if (p.generator == "chain") chain(p, path);
        if (p.generator == "random_dense" && right(path + ".solid_fraction") && right(path + ".size_ratio")) {
            const double most = densest_random_packing(p.size_ratio);
            if (p.solid_fraction > most) {
                fail(path + ".solid_fraction",
                     fmt::format("must be <= {:.4g}, random close packing at size_ratio = {}; less beside walls", most,
                                 p.size_ratio));
            }
        }
    }

    /// `inside` names a packing; what stands on a line or was taken itself has no room to give.
    void host(const PartSpec& p, const std::string& key)
    {
        std::vector<std::string> hosts;
        for (const PartSpec& other : c_.parts) {
            if (&other != &p && other.kind == "spheres" && other.generator != "chain" && other.generator != "taken")
                hosts.push_back(other.name);
        }
        const bool in_grains = p.generator == "chain" && is_a("grains", p.inside);
        if (!in_grains && std::find(hosts.begin(), hosts.end(), p.inside) == hosts.end()) {
            fail(key,
                 "no other part of this name has kind = \"spheres\" and generator = \"hcp\", \"fcc\", "
                 "\"random_dense\" or \"file\"; " +
                     choice(p.inside, hosts));
        }
    }

    void chain(const PartSpec& p, const std::string& path)
    {
        const FibreSpec& f = p.fibre;
        const std::string fibre = path + ".fibre", points = fibre + ".points", sideways = fibre + ".sideways";
        if (given(fibre) && right(fibre)) {
            if (f.shape == "points") {
                if (f.points.size() < 2)
                    fail(points, fmt::format("has {} points; must have at least 2", f.points.size()));
                for (std::size_t i = 1; i < f.points.size(); ++i) {
                    if (f.points[i] == f.points[i - 1]) fail(joined(points, i), "is the same point as the one before");
                }
            } else if (f.from == f.to) {
                fail(fibre + ".to", "must not be the same point as from");
            } else if (f.shape != "straight" && norm2(cross(f.sideways, f.to - f.from)) == 0.0) {
                fail(given(sideways) ? sideways : fibre,
                     fmt::format("{}must not be zero or along the fibre", given(sideways) ? "" : "sideways: "));
            }
        }
        for (std::size_t i = 0; i < p.copies.size() && right(path + ".copies"); ++i) {
            const bool again = std::find(p.copies.begin(), p.copies.begin() + static_cast<std::ptrdiff_t>(i),
                                         p.copies[i]) != p.copies.begin() + static_cast<std::ptrdiff_t>(i);
            if (norm2(p.copies[i]) == 0.0 || again)
                fail(joined(path + ".copies", i),
                     again ? "is listed already" : "must not be zero: that is the chain itself");
        }
    }

    void orientation(const OrientationSpec& o, const std::string& path)
    {
        if (!given(path) || !right(path)) return;
        const int ways = (o.choices.empty() ? 0 : 1) + (o.random.empty() ? 0 : 1) + (o.file.empty() ? 0 : 1);
        if (ways != 1)
            fail(path,
                 fmt::format("has {} of choices, random, file; must have exactly one", ways == 0 ? "none" : "several"));
    }

    /// Names in `between` exist, and no two entries are for the same pair.
    template <class Spec>
    void pairs(const std::string& table, const std::vector<Spec>& entries)
    {
        std::map<std::tuple<std::string, std::string, std::string>, std::string> seen;
        for (std::size_t i = 0; i < entries.size(); ++i) {
            const std::string path = joined(table, i), key = path + ".between";
            if (!right(key)) continue;
            for (std::size_t k = 0; k < 2; ++k) {
                const std::string& name = entries[i].between[k];
                if (!names_right_ || std::find(pair_names_.begin(), pair_names_.end(), name) != pair_names_.end())
                    continue;
                fail(joined(key, k), "no part, material or wall of this name; " + choice(name, pair_names_));
            }
            auto pair = std::minmax(entries[i].between[0], entries[i].between[1]);
            std::string made_in;
            if constexpr (std::is_same_v<Spec, BondSpec>) made_in = entries[i].made_in;
            const auto [entry, is_new] = seen.try_emplace({pair.first, pair.second, made_in}, path);
            if (!is_new) fail(key, fmt::format("{} is for the same pair", entry->second));
        }
    }

    void bond(const BondSpec& b, const std::string& path)
    {
        elasticity(b, path);
        of_spheres(b, path);
        if (given(path + ".made_in") && right(path + ".made_in") && right("stages") &&
            std::find(bond_stages_.begin(), bond_stages_.end(), b.made_in) == bond_stages_.end()) {
            fail(path + ".made_in", "no stage of kind = \"bond\" has this name; " + choice(b.made_in, bond_stages_));
        }
        if (b.failure == "unbreakable" || !right(path + ".failure")) return;
        if (b.failure == "face" && right(path + ".law") && right(path + ".softening")) {
            if (b.law != "interface")
                fail(path + ".failure", fmt::format("\"face\" needs law = \"interface\", not \"{}\"", b.law));
            if (b.softening != "brittle") {
                fail(path + ".failure", fmt::format("\"face\" needs softening = \"brittle\", not \"{}\"", b.softening));
            }
        }
        if (b.law != "interface" && b.softening == "bilinear" && given(path + ".softening") && right(path + ".law")) {
            fail(path + ".softening", fmt::format("\"bilinear\" needs law = \"interface\", not \"{}\"", b.law));
        }
        if (b.shear_stiffness == 0.0 && b.residual_friction && *b.residual_friction > b.friction &&
            right(path + ".residual_friction") && right(path + ".friction")) {
            fail(path + ".residual_friction",
                 fmt::format("must be <= friction, {}: broken bonds would create energy", b.friction));
        }
        const bool strengths_right = b.cohesion > 0.0 && right(path + ".tensile_strength") &&
                                     right(path + ".cohesion") && right(path + ".friction") && right(path + ".onset");
        if (b.onset == "mohr_coulomb" && strengths_right && b.tensile_strength * b.friction > b.cohesion) {
            fail(path + ".tensile_strength",
                 fmt::format("must be <= {:.6g} Pa, cohesion / friction, with onset = \"mohr_coulomb\"",
                             b.cohesion / b.friction));
        }
    }

    bool is_a(const char* kind, const std::string& name) const
    {
        return std::any_of(c_.parts.begin(), c_.parts.end(),
                           [&](const PartSpec& p) { return (p.name == name || p.material == name) && p.kind == kind; });
    }

    /// Laws by what they join: spheres have no faces, grains no centre that a spring could hang on.
    void of_spheres(const BondSpec& b, const std::string& path)
    {
        if (!right("parts")) return;
        const bool no_grains =
            std::all_of(c_.parts.begin(), c_.parts.end(), [](const PartSpec& p) { return p.kind == "spheres"; });
        const bool some_sphere = is_a("spheres", b.between[0]) || is_a("spheres", b.between[1]) || no_grains;
        if (b.law == "interface" && some_sphere && !given(path + ".shear_stiffness") && right(path + ".law") &&
            right(path + ".between")) {
            // without it the entry was read as one of grains
            std::erase_if(problems_, [&](const InputProblem& p) { return p.key.rfind(path + '.', 0) == 0; });
            fail(path + ".shear_stiffness", "missing; required for the interface of a fibre, such as \"1e9 Pa/m\"");
        }
        if (!right(path)) return;
        const bool some_grain = is_a("grains", b.between[0]) || is_a("grains", b.between[1]);
        if (b.law == "spring" && !some_sphere)
            fail(path + ".law", "\"spring\" joins spheres; grains take \"interface\", \"parallel\" or \"point\"");
        if (b.law == "point" && some_sphere)
            fail(path + ".law", "\"point\" joins grains; spheres take \"parallel\" or \"spring\"");
        if (b.law != "interface" && some_sphere && some_grain)
            fail(path + ".law", fmt::format("\"{}\" cannot join spheres and grains; use \"interface\"", b.law));
        if (b.shear_ratio && *b.shear_ratio == 0.0 && !some_sphere && right(path + ".shear_ratio"))
            fail(path + ".shear_ratio", "must be > 0 between grains");
        if (b.failure_slip && !b.yield_slip && right(path + ".failure_slip"))
            fail(path + ".yield_slip", "missing; required with failure_slip");
        if (b.failure_slip && b.yield_slip && *b.failure_slip <= *b.yield_slip && right(path + ".failure_slip"))
            fail(path + ".failure_slip", fmt::format("must be > {:.6g} m, the yield_slip", *b.yield_slip));
    }

    /// The rules of "auto" give a negative shear stiffness beyond a certain Poisson's ratio (physics/grains 9).
    void elasticity(const BondSpec& b, const std::string& path)
    {
        if (b.elasticity == "homogeneous" || b.shear_ratio || !right(path + ".elasticity") ||
            !right(path + ".shear_ratio")) {
            return;
        }
        const bool plane = b.elasticity == "plane";
        const double limit = plane ? 1.0 / 3.0 : 1.0 / 4.0;
        for (const MaterialSpec& m : c_.materials) {
            if (!may_join(b, m.name) || m.poisson_ratio < limit || !right(joined("materials", m.name))) continue;
            fail(path + ".elasticity",
                 fmt::format("\"{}\" with shear_ratio = \"auto\" needs poisson_ratio < {}; that of \"{}\" is {}",
                             b.elasticity, plane ? "1/3" : "1/4", m.name, m.poisson_ratio));
        }
    }

    bool may_join(const BondSpec& b, const std::string& material) const
    {
        return std::any_of(c_.parts.begin(), c_.parts.end(), [&](const PartSpec& p) {
            const auto is_it = [&](const std::string& name) {
                return name == "*" || name == p.name || name == material;
            };
            return p.material == material && (is_it(b.between[0]) || is_it(b.between[1]));
        });
    }

    void wall(const WallSpec& w, const std::string& path)
    {
        if (!right(path + ".shape")) return;
        if (w.shape == "plate" && norm2(w.normal) == 0.0 && right(path + ".normal"))
            fail(path + ".normal", "must not be zero");
        if (w.shape == "cylinder" && norm2(w.axis) == 0.0 && right(path + ".axis"))
            fail(path + ".axis", "must not be zero");
        const std::size_t lengths = w.shape == "box" ? 3 : 2;
        if ((w.shape == "box" || w.shape == "plate") && given(path + ".size") && right(path + ".size") &&
            w.size.size() != lengths) {
            fail(path + ".size", fmt::format("has {} entries; a {} must have {} such as [{}\"1 m\", \"1 m\"]",
                                             w.size.size(), w.shape, lengths, lengths == 3 ? "\"1 m\", " : ""));
        }
        const std::set<std::string> open(w.open.begin(), w.open.end());
        if (right(path + ".open") && open.size() != w.open.size()) fail(path + ".open", "names a side twice");
        if (right(path + ".open") && open.size() == 6) fail(path + ".open", "no side of the box is left");
        if (w.shape == "stl" && given(path + ".file") && right(path + ".file") && w.file.empty())
            fail(path + ".file", "must not be empty");
        servo(w.servo, path, w.shape == "plate");
        if (given(path + ".servo") && c_.test.kind != "custom" && right("test.kind")) {
            fail(path + ".servo",
                 fmt::format("a {} test drives its own walls; use test.kind = \"custom\"", c_.test.kind));
        }
    }

    /// Of a wall or of a stage's move: one target, a direction, no velocity besides.
    void servo(const ServoSpec& s, const std::string& owner, bool has_normal)
    {
        const std::string path = owner + ".servo";
        if (!given(path) || !right(path)) return;
        if (s.force.has_value() == s.stress.has_value()) {
            fail(path, fmt::format("has {} of force, stress; must have exactly one: the push that the wall holds",
                                   s.force ? "both" : "none"));
        }
        if (given(path + ".direction") && norm2(s.direction) == 0.0) {
            fail(path + ".direction", "must not be zero");
        } else if (!given(path + ".direction") && !has_normal) {
            fail(path, "direction is missing; required for a wall that is no plate: where it pushes");
        }
        if (given(owner + ".velocity")) fail(owner + ".velocity", "give either velocity or servo, not both");
    }

    void grip(const GripSpec& g, const std::string& path)
    {
        if (c_.test.kind != "custom" && right("test.kind"))
            fail(path, fmt::format("a {} test holds its own bodies; use test.kind = \"custom\"", c_.test.kind));
        if (given(path + ".part") && right(path + ".part") && names_right_) {
            std::vector<std::string> parts;
            for (const PartSpec& p : c_.parts) parts.push_back(p.name);
            if (std::find(parts.begin(), parts.end(), g.part) == parts.end())
                fail(path + ".part", "no such part; " + choice(g.part, parts));
        }
        if (given(path + ".at") && given(path + ".region"))
            fail(path + ".region", "give either at or region, not both");
        const std::string key = path + ".hold";
        if (!given(key) || !right(key)) return;
        if (std::set<std::string>(g.hold.begin(), g.hold.end()).size() != g.hold.size())
            fail(key, "names one of them twice");
    }

    const WallSpec* wall_named(const std::string& name) const
    {
        for (const WallSpec& w : c_.walls) {
            if (w.name == name) return &w;
        }
        return nullptr;
    }

    /// Whether a wall moves in the stage: one that it names, or one with a motion of its own.
    bool moves_a_wall(const StageSpec& s) const
    {
        const auto named = [&](const auto& w) {
            return std::any_of(s.motions.begin(), s.motions.end(),
                               [&](const StageMotion& m) { return m.wall == w.name; });
        };
        return std::any_of(s.motions.begin(), s.motions.end(), [](const StageMotion& m) { return m.moves(); }) ||
               std::any_of(
                   c_.walls.begin(), c_.walls.end(),
                   [&](const WallSpec& w) { return (norm2(w.velocity) > 0.0 || w.servo.given()) && !named(w); }) ||
               std::any_of(c_.grips.begin(), c_.grips.end(),
                           [&](const GripSpec& g) { return norm2(g.velocity) > 0.0 && !named(g); });
    }

    void stage(const StageSpec& s, std::size_t i)
    {
        const std::string path = joined("stages", i);
        if (s.kind == "bond" && right(path) &&
            std::none_of(c_.bonds.begin(), c_.bonds.end(), [&](const BondSpec& b) { return b.made_in == s.name; })) {
            fail(path, fmt::format("makes no bonds; required: [[bonds]] with made_in = \"{}\"", s.name));
        }
        std::set<std::string> moved;
        for (std::size_t k = 0; k < s.motions.size(); ++k) {
            const std::string entry = joined(path + ".move", k), key = entry + ".wall";
            if (right(entry) && !given(entry + ".velocity") && !given(entry + ".servo"))
                fail(entry, "must have velocity or servo");
            if (!given(key) || !right(key)) continue;
            const std::string& name = s.motions[k].wall;
            const WallSpec* wall = wall_named(name);
            const bool is_grip = std::find(grip_names_.begin(), grip_names_.end(), name) != grip_names_.end();
            if (is_grip && given(entry + ".servo")) fail(entry + ".servo", "a grip has no servo; give its velocity");
            if (wall == nullptr && !is_grip) {
                fail(key, "no such wall; " + choice(name, wall_names_));
                continue;
            }
            if (!moved.insert(name).second) fail(key, "this wall is moved already in this stage");
            if (!is_grip) servo(s.motions[k].servo, entry, wall->shape == "plate");
        }
        for (std::size_t k = 0; k < s.release.size(); ++k) {
            const std::string key = joined(path + ".release", k), &name = s.release[k];
            if (!right(path + ".release")) continue;
            if (std::find(grip_names_.begin(), grip_names_.end(), name) == grip_names_.end())
                fail(key, "no such grip; " + choice(name, grip_names_));
            else if (moved.count(name) > 0)
                fail(key, "this grip is moved in this stage; it cannot let go too");
            else if (!released_.insert(name).second)
                fail(key, "this grip has let go already");
        }
        for (const std::string& name : moved) {
            if (released_.count(name) > 0 && std::find(s.release.begin(), s.release.end(), name) == s.release.end())
                fail(path, fmt::format("grip \"{}\" has let go in an earlier stage; it cannot move", name));
        }
        if (!right(path)) return;
        const bool goes_back = s.kind == "unload" && s.motions.empty();
        if (goes_back) back(i);
        if (goes_back || moves_a_wall(s)) return;
        const auto needs_motion = [&](const char* key, const std::optional<double>& value) {
            if (value) fail(path + key, "no wall moves in this stage");
        };
        needs_motion(".max_displacement", s.max_displacement);
        needs_motion(".load", s.load);
        needs_motion(".stress", s.stress);
    }

    /// A stage in which the walls go back by themselves needs one before it in which they went forth.
    void back(std::size_t i)
    {
        const std::string path = joined("stages", i);
        std::size_t k = i;
        while (k > 0 && !moves_a_wall(c_.stages[k - 1])) --k;
        if (k == 0) return fail(path, "no wall moved before; say in move how walls go back");
        for (const WallSpec& w : c_.walls) {
            if (w.servo.given())
                fail(path, fmt::format("wall \"{}\" holds a push; say in move how it goes back", w.name));
        }
        for (const StageMotion& m : c_.stages[k - 1].motions) {
            if (!m.servo.given()) continue;
            fail(path, fmt::format("wall \"{}\" held a push before; say in move how it goes back", m.wall));
        }
    }

    void ready_made()
    {
        const TestSpec& t = c_.test;
        const std::string a_test = fmt::format("a {} test", t.kind);
        for (std::size_t i = 0; i < c_.stages.size(); ++i) {
            fail(joined("stages", i), a_test + " makes its own stages; use test.kind = \"custom\"");
        }
        if (right("test.stop")) {
            if (t.kind == "drop") {
                if (!t.stop.time && !t.stop.rest)
                    fail("test.stop", "the run would never end; required: at least one of time, rest");
                if (t.stop.load_drop) fail("test.stop.load_drop", "has no meaning in a drop test; use time or rest");
                if (t.stop.strain) fail("test.stop.strain", "has no meaning in a drop test; use time or rest");
            } else {
                const bool ends_itself = t.kind == "pull_out" && t.control == "damage";
                const bool has_end = t.stop.load_drop || t.stop.strain || t.stop.time || t.stop.slip || t.stop.damage;
                if (!ends_itself && !has_end)
                    fail("test.stop",
                         fmt::format("the run would never end; required: at least one of load_drop, strain, time{}",
                                     t.kind == "pull_out" ? ", slip, damage" : ""));
                if (t.stop.rest) fail("test.stop.rest", "has no meaning here; it goes with kind = \"drop\"");
            }
        }
        if (t.kind == "brazilian") brazilian();
        if (t.kind == "four_point_bending" || t.kind == "notched_beam") spans();
        if (t.kind == "drop") drop();
        if (t.kind == "pull_out") pull_out();
    }

    void pull_out()
    {
        const TestSpec& t = c_.test;
        const auto named = [&](const std::string& name) {
            return std::find_if(c_.parts.begin(), c_.parts.end(), [&](const PartSpec& p) { return p.name == name; });
        };
        std::vector<std::string> names;
        for (const PartSpec& p : c_.parts) names.push_back(p.name);
        for (const auto& [key, name] : {std::pair<std::string, std::string>{"test.fibre", t.fibre},
                                        std::pair<std::string, std::string>{"test.matrix", t.matrix}}) {
            if (given(key) && right(key) && right("parts") && named(name) == c_.parts.end())
                fail(key, "no such part; " + choice(name, names));
        }
        if (right("test.fibre") && right("parts") && named(t.fibre) != c_.parts.end()) {
            const PartSpec& p = *named(t.fibre);
            if (p.kind != "spheres" || (p.generator != "chain" && p.generator != "taken"))
                fail("test.fibre", "must be a part of spheres with generator = \"chain\" or \"taken\"");
            if (t.fibre == t.matrix && right("test.matrix"))
                fail("test.matrix", "must be another part than test.fibre");
        }
        if (norm2(c_.control.gravity) > 0.0 && t.control != "speed" && right("control.gravity"))
            fail("control.gravity", "has no place in a row of equilibria; use test.control = \"speed\"");
        const bool cleaves = std::any_of(c_.materials.begin(), c_.materials.end(),
                                         [](const MaterialSpec& m) { return !m.cleavage.planes.empty(); });
        if (cleaves && t.control != "speed" && right("test.control"))
            fail("test.control", "must be \"speed\" where grains cleave");
    }

    void spans()
    {
        const TestSpec& t = c_.test;
        if (!right("test.inner_span") || !right("test.outer_span") || !(t.outer_span > 0.0)) return;
        if (t.kind == "four_point_bending" && given("test.inner_span") && t.inner_span == 0.0)
            return fail("test.inner_span", "must be > 0 m; one loading roller is kind = \"three_point_bending\"");
        if (t.inner_span >= t.outer_span)
            fail("test.inner_span", fmt::format("must be < {:.6g} m, the outer span", t.outer_span));
    }

    void drop()
    {
        const Vec3& g = c_.control.gravity;
        const int along = (g.x != 0.0 ? 1 : 0) + (g.y != 0.0 ? 1 : 0) + (g.z != 0.0 ? 1 : 0);
        if (along > 1 && right("control.gravity"))
            fail("control.gravity", "must point along an axis in a drop test; left out it is 9.81 m/s^2 along -z");
    }

    void brazilian()
    {
        if (c_.test.direction == "z" && right("test.direction"))
            fail("test.direction", "must be \"x\" or \"y\" in a brazilian test");
        if (c_.parts.empty() || !right("parts[0].region")) return;
        const RegionSpec& region = c_.parts[0].region;
        const std::string path = "parts[0].region";
        if (!given(path)) return fail(path, "missing; required with test.kind = \"brazilian\": a disc or cylinder");
        if (region.shape != "cylinder" && region.shape != "disc") {
            return fail(path + ".shape", "must be \"disc\" or \"cylinder\" in a brazilian test");
        }
        if (region.axis != "z") fail(path + ".axis", "must be \"z\" in a brazilian test");
        const auto& half_width = c_.test.contact_half_width;
        if (half_width && *half_width > 0.5 * region.diameter && right("test.contact_half_width")) {
            fail("test.contact_half_width",
                 fmt::format("must be <= {:.6g} m, half the diameter of the disc", 0.5 * region.diameter));
        }
        if (c_.test.platen == "curved" && c_.test.platen_radius > 0.0 &&
            c_.test.platen_radius < 0.5 * region.diameter && right("test.platen_radius")) {
            fail("test.platen_radius",
                 fmt::format("must be 0 or >= {:.6g} m, the radius of the disc", 0.5 * region.diameter));
        }
    }

    /// Every stage ends, or the run does.
    void custom()
    {
        if (c_.stages.empty()) {
            if (right("stages"))
                fail("stages", "missing; required with test.kind = \"custom\": at least one [[stages]]");
            return;
        }
        for (std::size_t i = 0; i < c_.stages.size(); ++i) {
            const StageSpec& s = c_.stages[i];
            const bool ends = s.duration || s.unbalanced_force_ratio || s.rest || s.load || s.stress || s.load_drop ||
                              s.max_displacement || s.kind == "bond" || s.kind == "unload";
            const bool last = i + 1 == c_.stages.size();
            if (ends || (last && c_.test.stop.time) || !right(joined("stages", i)) || !right("test.stop")) continue;
            fail(joined("stages", i),
                 fmt::format("never ends; required: at least one of duration, max_displacement, load, stress, "
                             "load_drop, unbalanced_force_ratio, rest{}",
                             last ? ", or test.stop.time" : ""));
        }
    }

    void output()
    {
        const OutputSpec& o = c_.output;
        if (o.every && o.snapshots) return fail("output.snapshots", "give either every or snapshots, not both");
        const bool has_end =
            c_.test.stop.time ||
            std::any_of(c_.stages.begin(), c_.stages.end(), [](const StageSpec& s) { return s.duration.has_value(); });
        if (o.snapshots && !has_end && right("test.stop") && right("stages")) {
            fail("output.snapshots", "needs test.stop.time or a stage with a duration; or give every");
        }
    }

    const Case& c_;
    std::vector<InputProblem>& problems_;
    std::set<std::string> released_;            ///< grips that let go in the stages so far
    std::set<std::string> wrong_;               ///< paths of problems and of the tables around them
    std::map<std::string, std::string> owner_;  ///< names that `between` can hold, and what they name
    bool names_right_ = true;                   ///< else a name that is not there is not worth a message
    std::vector<std::string> material_names_, wall_names_, grip_names_, pair_names_, bond_stages_;
};

}  // namespace

void check_case(const Case& c, std::vector<InputProblem>& problems)
{
    Checks(c, problems).run();
}

}  // namespace grainfrac
