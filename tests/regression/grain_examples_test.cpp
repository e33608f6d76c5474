// SPDX-License-Identifier: GPL-3.0-or-later
// Examples in short, by the program: the same input with fewer grains, faster platens, lower falls.
#include "support/workplace.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <string>

namespace {

/// summary.json of an example with other values.
nlohmann::json summary_of(const std::string& name, const std::string& values)
{
    const grainfrac::test::Workplace place;
    const std::string folder = place.folder.string();
    const std::string file = name.find('/') == name.npos ? name + "/" + name : name;
    const std::string input = std::string(GF_SOURCE_DIR) + "/examples/" + file + ".toml";
    const std::string command = std::string(GF_PROGRAM) + " run '" + input + "' --out '" + folder +
                                "/out' -q --no-report --threads 1 " + values + " > /dev/null";
    CAPTURE(command);
    REQUIRE(std::system(command.c_str()) == 0);
    std::ifstream in(folder + "/out/summary.json");
    const nlohmann::json s = nlohmann::json::parse(in);
    CHECK(s["energy"]["largest_relative_error"].get<double>() < 1e-3);
    CHECK(s["energy"]["relative_error"].get<double>() < 1e-3);  // at the end, where a drop bears little load
    return s;
}

double number(const nlohmann::json& s, const char* table, const char* key)
{
    return s[table][key].get<double>();
}

}  // namespace

TEST_CASE("example uniaxial in short: it breaks between grains")
{
    const nlohmann::json s = summary_of("uniaxial", "--set test.platen_speed='\"200 mm/s\"'");
    CHECK(number(s, "test", "nominal_strength_Pa") > 4e8);
    CHECK(s["cracks"]["intergranular_shear"]["number"].get<int>() > 5);
    CHECK(s["fragments"]["number"].get<int>() > 1);
}

TEST_CASE("example uniaxial_cleavage in short: grains split long before the peak")
{
    const nlohmann::json s =
        summary_of("uniaxial_cleavage", "--set test.platen_speed='\"112 mm/s\"' --set test.stop.time='\"36 us\"'");
    CHECK(number(s, "splits", "number") > 2);
    CHECK(number(s, "test", "peak_load_N") > 600);
}

TEST_CASE("example drop in short: first contact after sqrt(2 h/g)")
{
    const nlohmann::json s = summary_of("drop",
                                        "--set test.drop_height='\"0.2 mm\"' --set test.stop.time='\"8 ms\"' --set "
                                        "'parts.grains.region.size=[\"2.2 mm\", \"2.2 mm\", \"2.6 mm\"]'");
    const double first = number(s, "test", "first_contact_s"), fall = std::sqrt(2 * 0.2e-3 / 9.81);
    CHECK(first >= fall * (1 - 1e-9));
    CHECK(first < fall + 21e-6);  // rows are 20 us apart
}

TEST_CASE("example drop_cleavage in short: grains break, the account closes")
{
    const nlohmann::json s = summary_of("drop_cleavage",
                                        "--set test.drop_height='\"2 mm\"' --set test.stop.time='\"23 ms\"' --set "
                                        "'parts.grains.region.size=[\"2.2 mm\", \"4 mm\", \"1.3 mm\"]'");
    CHECK(number(s, "splits", "number") > 0);
    CHECK(number(s, "fragments", "number") >= 8);
}

TEST_CASE("example brazilian_cleavage in short: cracks through grains")
{
    const nlohmann::json s =
        summary_of("brazilian_cleavage",
                   "--set parts.disc.side='\"13.5 mm\"' --set test.platen_speed='\"128 mm/s\"' --set "
                   "bonds[0].tensile_strength='\"35 MPa\"' --set bonds[0].cohesion='\"140 MPa\"'");
    CHECK(number(s, "splits", "number") > 0);
    CHECK(s["cracks"]["transgranular"]["area_m2"].get<double>() > 0);
    CHECK(number(s, "test", "peak_load_N") > 1e4);
}

TEST_CASE("example four_point_bending in short: the first crack on the tension side, between the inner rollers")
{
    const nlohmann::json s = summary_of("four_point_bending", "--set test.platen_speed='\"60 mm/s\"'");
    const auto first = s["cracks"]["first"]["position_m"];
    CHECK(std::fabs(first[0].get<double>()) < 4.6e-3);  // half the inner span, and half a grain
    CHECK(first[1].get<double>() < -1.5e-3);
    CHECK(number(s, "test", "peak_load_N") == Approx(350.0).epsilon(0.03));
}

TEST_CASE("example beam_slender in short: first crack below, strength near that of a face")
{
    const nlohmann::json s = summary_of("beam_slender",
                                        "--set test.platen_speed='\"150 mm/s\"' --set "
                                        "'parts.beam.region.size=[\"40 mm\", \"4.7 mm\", \"1.3 mm\"]' --set "
                                        "test.outer_span='\"36 mm\"' --set test.inner_span='\"18 mm\"'");
    CHECK(s["cracks"]["first"]["position_m"][1].get<double>() < -1.5e-3);
    // five rows, pulled fast: 0.875 of the strength of a face, less what the swing of the beam adds
    CHECK(number(s, "test", "nominal_strength_Pa") == Approx(87.5e6).epsilon(0.2));
}

TEST_CASE("example dcb in short: fracture energy of a zigzag")
{
    const nlohmann::json s = summary_of("toughness/dcb",
                                        "--set test.platen_speed='\"150 mm/s\"' --set test.ramp='\"20 us\"' --set "
                                        "test.stop.strain=0.0042");
    CHECK(number(s, "test", "mean_fracture_energy_J_per_m2") == Approx(11.55).epsilon(0.05));
}

TEST_CASE("example notched_beam in short: the crack starts at the notch")
{
    const nlohmann::json s = summary_of("toughness/notched_beam",
                                        "--set parts.beam.side='\"0.18 mm\"' --set test.platen_speed='\"200 mm/s\"' "
                                        "--set test.ramp='\"6 us\"' --set "
                                        "'contacts[0].normal_stiffness=\"2e15 Pa/m\"' --set "
                                        "'bonds[0].fracture_energy_I=\"60 J/m^2\"' --set "
                                        "'bonds[0].fracture_energy_II=\"60 J/m^2\"'");
    const auto first = s["cracks"]["first"]["position_m"];
    CHECK(std::fabs(first[0].get<double>()) < 0.2e-3);
    CHECK(first[1].get<double>() < 0.0);
    CHECK(number(s, "test", "fracture_toughness_Pa_sqrt_m") > 3e6);
}
