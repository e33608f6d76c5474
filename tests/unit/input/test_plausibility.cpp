// SPDX-License-Identifier: GPL-3.0-or-later
// A warning for each thing that is hardly meant, with its numbers; none for any example.
#include "experiment/derived.h"
#include "experiment/plausibility.h"
#include "experiment/specimen.h"
#include "input_files.h"
#include "motion/step.h"
#include "motion/time_step.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace grainfrac;
using namespace grainfrac::test;

namespace {

struct Checked {
    Case input;
    Built built;
    double critical = 0.0;  ///< [s]
};

Checked checked(const Case& c)
{
    Checked x{c, build(c, Device::cpu), 0.0};
    start(x.built.model, x.built.state);
    x.critical = time_step_bound(x.built.model, x.built.state).with_damping;
    return x;
}

std::vector<InputProblem> warnings(const Checked& x)
{
    const ControlSpec& s = x.input.control;
    std::vector<InputProblem> all = implausible_input(x.input);
    const double dt = s.time_step.value_or(s.time_step_safety * x.critical);
    for (const InputProblem& p : implausible_model(x.input, x.built, dt, x.critical)) all.push_back(p);
    return all;
}

std::string listed(const std::vector<InputProblem>& problems)
{
    std::string text;
    for (const InputProblem& p : problems) text += p.key + ": " + p.message + '\n';
    return text;
}

/// A start file, what is set in it, the key that is warned of, and numbers that the message must have.
struct Example {
    const char* start;
    std::vector<std::string> set;
    const char* key;
    std::vector<std::string> parts;
};

const char* const cleavage =
    "materials.sic.cleavage={planes=[\"{10-10}\"],toughness=\"3.5 MPa m^0.5\",flaw_size=\"0.3 mm\"";

const Example examples[] = {
    {"brazilian",
     {"materials.sic.density=\"3.2 kg/m^3\""},
     "materials.sic.density",
     {"3.2 kg/m^3", "\"3.2 g/cm^3\" meant"}},
    {"brazilian", {"materials.sic.density=\"3.1e6 kg/m^3\""}, "materials.sic.density", {"3.1e+06 kg/m^3", "inertia"}},
    {"custom",
     {"materials.sic.young_modulus=\"400 Pa\"", "bonds[0].failure=\"unbreakable\""},
     "materials.sic.young_modulus",
     {"400 Pa", "\"400 GPa\" meant"}},
    {"brazilian", {"materials.sic.poisson_ratio=-0.3"}, "materials.sic.poisson_ratio", {"-0.3", "1/3"}},
    {"brazilian",
     {"materials.other={density=3000,young_modulus=1e11,poisson_ratio=0.2}"},
     "materials.other",
     {"no part"}},
    {"brazilian",
     {"bonds[0].friction=30", "bonds[0].cohesion=\"9000 MPa\"", "bonds[0].softening=\"brittle\""},
     "bonds[0].friction",
     {"30 deg would be 0.577"}},
    {"brazilian", {"contacts[0].friction=5"}, "contacts[0].friction", {"5"}},
    {"uniaxial_compression", {"test.wall_friction=45"}, "test.wall_friction", {"45 deg would be 1"}},
    {"brazilian", {"bonds[0].damping=0.9"}, "bonds[0].damping", {"0.9", "0.445"}},
    {"brazilian",
     {"bonds[0].tensile_strength=\"100 Pa\"", "bonds[0].cohesion=\"400 Pa\""},
     "bonds[0].tensile_strength",
     {"100 Pa", "\"100 MPa\" meant"}},
    {"brazilian",
     {"bonds[0].cohesion=\"60 MPa\"", "bonds[0].friction=0.3", "bonds[0].residual_friction=0.3"},
     "bonds[0].cohesion",
     {"6e+07 Pa", "1e+08 Pa"}},
    {"brazilian",
     {"bonds[0].fracture_energy_I=\"1e6 J/m^2\"", "bonds[0].fracture_energy_II=\"1e6 J/m^2\""},
     "bonds[0].fracture_energy_I",
     {"1e+06 J/m^2"}},
    {"brazilian",
     {"bonds[0].fracture_energy_II=\"20 J/m^2\"", "bonds[0].cohesion=\"100 MPa\""},
     "bonds[0].fracture_energy_II",
     {"20 J/m^2", "29 J/m^2"}},
    {"brazilian",
     {"bonds[0].weibull_modulus=1.0", "bonds[0].softening=\"brittle\""},
     "bonds[0].weibull_modulus",
     {"100 %"}},
    {"brazilian", {"contacts[0].restitution=0.05"}, "contacts[0].restitution", {"400 times", "20 times"}},
    {"three_point_bending", {"control.local_damping=0.8"}, "control.local_damping", {"0.8"}},
    {"custom", {"stages[0].local_damping=0.7"}, "stages[0].local_damping", {"0.7"}},
    {"custom", {"control.gravity=[0,-9810,0]"}, "control.gravity", {"1e+03 times"}},
    {"drop", {"control.local_damping=0.3"}, "control.local_damping", {"0.7 g"}},
    {"drop",
     {"test.stop={rest=0.01}", "output.every=\"1 ms\"", "output.snapshots=\"auto\"", "contacts[0].friction=0",
      "contacts[0].dissipation=\"none\""},
     "test.stop.rest",
     {"never"}},
    {"uniaxial_tension", {"bonds[0].failure=\"unbreakable\"", "test.stop={load_drop=0.5}"}, "test.stop", {"not end"}},
    {"brazilian", {"control.time_step_safety=1"}, "control.time_step_safety", {"at most 0.9"}},
    // what the model is needed for
    {"brazilian",
     {"parts[0].side=\"4 mm\"", "parts[0].at_region_boundary=\"keep\"", "bonds[0].softening=\"brittle\"",
      "test.contact_half_width=\"7 mm\""},
     "parts[0]",
     {"at least 10"}},
    {"brazilian", {"bonds[0].normal_stiffness=\"1e16 Pa/m\""}, "bonds[0].normal_stiffness", {"1e+16 Pa/m", "modulus"}},
    {"brazilian", {"contacts[0].normal_stiffness=\"1e18 Pa/m\""}, "contacts[0].normal_stiffness", {"1e+18 Pa/m"}},
    {"brazilian",
     {"bonds[0].tensile_strength=\"120 MPa\""},
     "bonds[0].fracture_energy_I",
     {"process zone", "0.000826 m", "1.2e+08 Pa", "29 J/m^2"}},
    {"custom",
     {"stages[0].kind=\"load\"", "bonds[0].made_in=\"glue\"", "bonds[0].fracture_energy_I=\"5 J/m^2\"",
      "stages[1]={name=\"glue\",kind=\"bond\",bond_distance=\"1 um\"}"},
     "bonds[0].fracture_energy_I",
     {"sigma_c^2/(2 k_n)", "5 J/m^2", "\"glue\""}},
    {"uniaxial_tension",
     {"test.platen_speed=\"1 m/s\""},
     "test.platen_speed",
     {"0.5 m/s", "17.8 times", "0.02805 m/s", "2.8 passages"}},
    {"custom", {"stages[0].move=[{wall=\"top\",velocity=[0,\"-2 m/s\",0]}]"}, "stages[0]", {"1 m/s"}},
    {"uniaxial_tension", {"test.stop={strain=1e-5}"}, "test.stop", {"strain of 1e-05", "4.1e+06 Pa", "1e+08 Pa"}},
    {"uniaxial_tension", {"test.stop={time=\"10 us\"}"}, "test.stop", {"nothing will break"}},
    {"brazilian",
     {std::string(cleavage) + ",finite_width=false}"},
     "materials.sic.cleavage.flaw_size",
     {"0.0006 m", "finite_width"}},
    {"brazilian",
     {std::string(cleavage) + "}", "materials.sic.cleavage.flaw_size=\"0.64 mm\""},
     "materials.sic.cleavage.flaw_size",
     {"0.00128 m"}},
    {"drop", {"contacts[0].normal_stiffness=\"1e6 Pa/m\""}, "test.drop_height", {"0.14 m/s", "0.0001 m"}},
    {"brazilian", {"control.time_step=\"20 ns\""}, "control.time_step", {"2e-08 s", "0.988"}},
    {"brazilian", {"control.time_step=\"1 ps\""}, "control.time_step", {"left out"}},
    {"uniaxial_tension", {"test.platen_speed=\"1 nm/s\""}, "test.platen_speed", {"steps"}},
    {"brazilian", {"output.every=\"1 ns\""}, "output.every", {"snapshots"}},
};

}  // namespace

TEST_CASE("a warning for what is hardly meant, with its numbers", "[input]")
{
    for (const Example& e : examples) {
        INFO(e.start << ' ' << e.set[0]);
        const std::string text = new_case(e.start);
        REQUIRE(problems_of(text, e.set) == "");
        const std::vector<InputProblem> found = warnings(checked(read_text(text, e.set)));
        INFO(listed(found));
        const auto at = std::find_if(found.begin(), found.end(), [&](const InputProblem& p) {
            return p.key == e.key && std::all_of(e.parts.begin(), e.parts.end(), [&](const std::string& part) {
                       return p.message.find(part) != std::string::npos;
                   });
        });
        CHECK(at != found.end());
    }
}

TEST_CASE("no start file and no small example gives a warning", "[input]")
{
    for (const std::string& kind : new_case_kinds()) {
        if (kind == "calibrate") continue;
        INFO(kind);
        CHECK(listed(warnings(checked(read_text(new_case(kind))))) == "");
    }
}

TEST_CASE("local damping however little where something moves as a whole", "[input]")
{
    const auto said = [](const char* example, const std::vector<std::string>& set) {
        std::map<std::string, SourcePlace> places;
        return listed(
            implausible_input(read_case(std::string(GF_SOURCE_DIR) + "/examples/" + example + ".toml", set, places)));
    };
    const char* const fountain = "chain_fountain/chain_fountain";
    CHECK(said(fountain, {}) == "");
    CHECK(
        said(fountain, {"control.local_damping=0.01"}) ==
        "control.local_damping: in stage \"lift\" \"hand\" draws \"chain\" along, and 0.01 brakes that too, by 0.01 of "
        "the force on it; use the damping of the bonds\n");
    CHECK(said("chain_catenary/chain_catenary", {"control.local_damping=0.1"}) == "");  // its other end is held
    const std::string pair = said("damped_pair/damped_pair", {"stages.free.local_damping=0.1"});
    CHECK(pair.rfind("stages[1].local_damping: in stage \"free\" what \"hand\" held is free, and 0.1", 0) == 0);
    const auto flying = [](const std::vector<std::string>& set) {
        return listed(implausible_input(read_text(new_case("custom"), set)));
    };
    CHECK(flying({"stages[0].kind=\"load\"", "stages[0].local_damping=0.1"}) == "");
    CHECK(flying({"stages[0].kind=\"load\"", "stages[0].local_damping=0.1", "parts[0].velocity=[0,0,1]"})
              .find("moves by itself") != std::string::npos);
    // what falls onto a floor falls: not what rests there already, nor what is pressed
    const std::vector<std::string> onto_floor{"control.gravity=[0,-9.81,0]", "control.local_damping=0.1"};
    const auto stage = [&](std::initializer_list<const char*> more) {
        std::vector<std::string> set = onto_floor;
        set.insert(set.end(), more.begin(), more.end());
        return flying(set);
    };
    CHECK(stage({"stages[0].kind=\"load\"", "stages[0].move=[]"}).find("all falls freely") != std::string::npos);
    CHECK(stage({"stages[0].kind=\"load\""}) == "");
    CHECK(stage({"stages[0].kind=\"load\"", "stages[0].move=[]", "walls[1].velocity=[0,-0.1,0]"}) == "");
    CHECK(stage({"stages[0].kind=\"settle\"", "stages[0].move=[]"}) == "");
    CHECK(stage({"stages[0].kind=\"settle\"", "stages[0].move=[]",
                 "stages[1]={name=\"wait\",kind=\"load\",duration=\"1 ms\"}"}) == "");
    // a release is of its own stage
    const std::string released = said("damped_pair/damped_pair", {"stages.free.local_damping=0.1",
                                                                  "stages[2]={name=\"later\",duration=\"1 ms\","
                                                                  "local_damping=0.1}"});
    CHECK(released.find("stages[1]") != std::string::npos);
    CHECK(released.find("stages[2]") == std::string::npos);
}

TEST_CASE("a grip draws nothing along where another holds what is bonded to its part", "[input]")
{
    std::map<std::string, SourcePlace> places;
    Case c = read_case(std::string(GF_SOURCE_DIR) + "/examples/damped_pair/damped_pair.toml", {}, places);
    c.stages.resize(1);
    c.stages[0].local_damping = 0.1;
    CHECK(listed(implausible_input(c)) == "");
    c.parts.push_back(c.parts[0]);
    c.parts[1].name = "mount";
    c.grips[0].part = "mount";
    CHECK(listed(implausible_input(c)) == "");
    c.grips.erase(c.grips.begin());
    CHECK(listed(implausible_input(c)).find("\"hand\" draws \"pair\" along") != std::string::npos);
}

TEST_CASE("a material that no part is of changes nothing, listed first", "[input]")
{
    const auto said = [](const Checked& x) {
        std::string text = listed(implausible_model(x.input, x.built, 0.1 * x.critical, x.critical));
        for (const std::string& line : derived_lines(x.input, x.built)) {
            if (line.find("\"unused\"") == std::string::npos) text += line + '\n';
        }
        return text;
    };
    for (const char* kind : {"uniaxial_tension", "custom", "drop"}) {
        INFO(kind);
        Case c = read_text(new_case(kind));
        if (c.test.kind == "uniaxial_tension") c.test.platen_speed *= 100.0;
        const Checked x = checked(c);
        c.materials.insert(c.materials.begin(), c.materials[0]);
        c.materials[0].name = "unused";
        c.materials[0].density *= 1e-4;
        c.materials[0].young_modulus *= 1e-6;
        const Checked y = checked(c);
        CHECK(said(y) == said(x));
        CHECK(y.built.experiment.quasi_static_speed == x.built.experiment.quasi_static_speed);
        for (std::size_t s = 0; s < x.built.experiment.stages.size(); ++s) {
            const std::vector<Servo>&a = x.built.experiment.stages[s].servos, &b = y.built.experiment.stages[s].servos;
            REQUIRE(a.size() == b.size());
            for (std::size_t w = 0; w < a.size(); ++w) CHECK(a[w].max_speed == b[w].max_speed);
        }
    }
    Case c = read_text(new_case("uniaxial_tension"));
    const double guide = checked(c).built.experiment.quasi_static_speed;
    CHECK(guide > 0.0);
    BondSpec rigid = c.bonds[0];
    rigid.failure = "unbreakable";
    rigid.tensile_strength *= 0.01;
    rigid.between = {"*", "*"};
    c.bonds.push_back(rigid);
    CHECK(quasi_static_speed(c, checked(read_text(new_case("uniaxial_tension"))).built.model) == guide);
}

TEST_CASE("no example gives a warning", "[input][slow]")
{
    int files = 0;
    const std::string folder = std::string(GF_SOURCE_DIR) + "/examples";
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
        if (entry.path().extension() != ".toml") continue;
        INFO(entry.path());
        std::map<std::string, SourcePlace> places;
        const Case c = read_case(entry.path().string(), {}, places);
        ++files;
        if (c.stages.empty() && c.test.kind == "custom") {  // for calibrate
            CHECK(listed(implausible_input(c)) == "");
            continue;
        }
        CHECK(listed(warnings(checked(c))) == "");
    }
    CHECK(files >= 20);
}

TEST_CASE("what bonds imply is the material that they were made for", "[input]")
{
    const auto bonds_of = [](const std::string& kind, const std::vector<std::string>& set) {
        const Checked x = checked(read_text(new_case(kind), set));
        return part_bonds(x.input, x.built, 0, 0);
    };
    const PartBonds homogeneous = bonds_of("brazilian", {"parts[0].at_region_boundary=\"keep\""});
    CHECK(homogeneous.young_modulus.value() == Approx(410e9).epsilon(1e-9));
    CHECK(homogeneous.poisson_ratio.value() == Approx(0.0).margin(1e-12));
    CHECK(homogeneous.spacing == Approx(std::sqrt(3.0) * 0.8e-3).epsilon(1e-9));
    const PartBonds plane = bonds_of("brazilian", {"parts[0].at_region_boundary=\"keep\"",
                                                   "bonds[0].elasticity=\"plane\"", "bonds[0].fracture_energy_II=600"});
    CHECK(plane.young_modulus.value() == Approx(410e9).epsilon(1e-9));
    CHECK(plane.poisson_ratio.value() == Approx(0.17).epsilon(1e-9));
    const PartBonds hcp = bonds_of("pull_out", {});
    CHECK(hcp.young_modulus.value() == Approx(5e9).epsilon(1e-9));
    CHECK(hcp.poisson_ratio.value() == Approx(0.11).epsilon(1e-9));

    // G_I E = K^2, and both scales of the same energy: l_cz/h = E G/(sigma^2 h), snap-back 2 (E/h) G/sigma^2
    const Case c = read_text(new_case("brazilian"), {"parts[0].at_region_boundary=\"keep\""});
    const FractureScales f = fracture_scales(c, homogeneous, 410e9).value();
    CHECK(f.toughness == Approx(std::sqrt(410e9 * 29.0)).epsilon(1e-12));
    CHECK(f.process_zone == Approx(410e9 * 29.0 / 1e16).epsilon(1e-12));
    CHECK(f.snap_back == Approx(2.0 * f.process_zone / homogeneous.spacing).epsilon(1e-9));
}
