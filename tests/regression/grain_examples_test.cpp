// SPDX-License-Identifier: GPL-3.0-or-later
// Examples in short, by the program: the same input with fewer grains, faster platens, lower falls.
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

namespace fs = std::filesystem;

namespace {

/// summary.json of an example with other values.
nlohmann::json summary_of(const std::string& name, const std::string& values)
{
    std::string folder = (fs::temp_directory_path() / "grainfrac_example_XXXXXX").string();
    REQUIRE(mkdtemp(folder.data()) != nullptr);
    const std::string input = std::string(GF_SOURCE_DIR) + "/examples/" + name + "/" + name + ".toml";
    const std::string command = std::string(GF_PROGRAM) + " run '" + input + "' --out '" + folder +
                                "/out' -q --no-report --threads 1 " + values + " > /dev/null";
    CAPTURE(command);
    REQUIRE(std::system(command.c_str()) == 0);
    std::ifstream in(folder + "/out/summary.json");
    const nlohmann::json s = nlohmann::json::parse(in);
    in.close();
    fs::remove_all(folder);
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
