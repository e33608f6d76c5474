// SPDX-License-Identifier: GPL-3.0-or-later
#include "model/units.h"

#include <catch2/catch.hpp>

#include <stdexcept>
#include <string>

using grainfrac::parse_quantity;

namespace {

std::string refusal(const std::string& text, const std::string& unit)
{
    try {
        parse_quantity(text, unit);
    } catch (const std::invalid_argument& e) {
        return e.what();
    }
    return "";
}

}  // namespace

TEST_CASE("quantities with decimal prefixes are the nearest double", "[units]")
{
    struct Row {
        const char* text;
        const char* unit;
        double value;
    };
    const Row rows[] = {
        {"15 mm", "m", 15e-3},
        {"0.6 mm", "m", 0.6e-3},
        {"-3 m", "m", -3.0},
        {"+.5 mm", "m", 0.5e-3},
        {"1e-3mm", "m", 1e-6},
        {"30 um", "m", 30e-6},
        {"30 µm", "m", 30e-6},
        {"0.35 nm", "m", 0.35e-9},
        {"10 us", "s", 10e-6},
        {"0.1 us", "s", 0.1e-6},
        {"1 ms", "s", 1e-3},
        {"60 s", "s", 60.0},
        {"300 MPa", "Pa", 300e6},
        {"410 GPa", "Pa", 410e9},
        {"475.3 GPa/mm", "Pa/m", 475.3e12},
        {"5e14 Pa/m", "Pa/m", 5e14},
        {"3 N/m^3", "Pa/m", 3.0},
        {"3100 kg/m^3", "kg/m^3", 3100.0},
        {"3.1 g/cm^3", "kg/m^3", 3100.0},
        {"3.1 g/cm3", "kg/m^3", 3100.0},
        {"3.1e-9 tonne / mm^3", "kg/m^3", 3100.0},
        {"29 J/m^2", "J/m^2", 29.0},
        {"0.029 N/mm", "J/m^2", 29.0},
        {"20 mm/s", "m/s", 20e-3},
        {"9.81 m s-2", "m/s^2", 9.81},
        {"2 mm^2", "m^2", 2e-6},
        {"2 kg.m2.s-2", "J", 2.0},
        {"2.5 MPa m^0.5", "Pa m^0.5", 2.5e6},
        {"2.5 MPa*m^(1/2)", "Pa m^0.5", 2.5e6},
        {"2.5 MPa √m", "Pa m^0.5", 2.5e6},
        {"2.5 MPa sqrt(m)", "Pa m^0.5", 2.5e6},
        {"2.5 MN/m^1.5", "Pa m^0.5", 2.5e6},
        {"0.3", "1", 0.3},
        {"1e-3", "1", 1e-3},
        {"30 %", "1", 0.3},
    };
    for (const Row& row : rows) {
        INFO(row.text);
        CHECK(parse_quantity(row.text, row.unit) == row.value);
    }
}

TEST_CASE("quantities with other factors", "[units]")
{
    const double pi = 3.14159265358979323846;
    // factors come from the database with 16 digits
    CHECK(parse_quantity("60 deg", "rad") == Approx(pi / 3).epsilon(1e-15));
    CHECK(parse_quantity("60°", "rad") == Approx(pi / 3).epsilon(1e-15));
    CHECK(parse_quantity("10 rpm", "rad/s") == Approx(pi / 3).epsilon(1e-15));
    CHECK(parse_quantity("90 deg/ms", "rad/s") == Approx(500 * pi).epsilon(1e-15));
    CHECK(parse_quantity("36 km/h", "m/s") == Approx(10.0).epsilon(1e-15));
    CHECK(parse_quantity("2 min", "s") == 120.0);
    CHECK(parse_quantity("1 MPa mm^0.5", "Pa m^0.5") == Approx(1e6 / 31.622776601683793).epsilon(1e-15));
    CHECK(parse_quantity("1 kg^0.5 kg^0.5", "kg") == Approx(1.0).epsilon(1e-15));
}

TEST_CASE("wrong quantities say what was found and what is allowed", "[units]")
{
    CHECK(refusal("15 kg", "m") == "\"15 kg\" is a mass; expected a length, e.g. \"1 m\"");
    CHECK(refusal("15 MPa", "Pa m^0.5") == "\"15 MPa\" is a stress; expected a stress intensity, e.g. \"1 Pa m^0.5\"");
    CHECK(refusal("15", "m") == "\"15\" has no unit; expected a length, e.g. \"1 m\"");
    CHECK(refusal("15 %", "m") == "\"15 %\" is a number without a unit; expected a length, e.g. \"1 m\"");
    CHECK(refusal("0.3 rad", "1") == "\"0.3 rad\" is an angle; expected a plain number, e.g. \"0.5\"");
    CHECK(refusal("5 Hz", "rad/s") == "\"5 Hz\" is a rate; expected an angular velocity, e.g. \"1 rad/s\"");
    CHECK(refusal("5 Hz", "s") == "\"5 Hz\" is a rate; expected a time, e.g. \"1 s\"");
    CHECK(refusal("5 frob", "m") == "\"5 frob\" has an unknown unit \"frob\"; expected a length, e.g. \"1 m\"");
    CHECK(refusal("1,5 mm", "m") ==
          "\"1,5 mm\" has a comma; the decimal separator is a point; expected a length, e.g. \"1 m\"");
    CHECK(refusal("mm", "m") == "\"mm\" does not start with a number; expected a length, e.g. \"1 m\"");
    CHECK(refusal("", "m") == "\"\" is empty; expected a length, e.g. \"1 m\"");
    CHECK(refusal("20 degC", "K") ==
          "\"20 degC\" has a unit with an offset or a logarithm; expected a temperature, e.g. \"1 K\"");
    for (const char* text : {"nan m",
                             "inf m",
                             "-inf m",
                             "1e400 m",
                             "1e308 km",
                             "1e-400 m",
                             "1e99999999999999999999 m",
                             "0x10 m",
                             "3 mm 2",
                             "3 m @ 2",
                             "1 m since 3",
                             "10^3 m",
                             "3 m^0.3",
                             "3 m^",
                             "3 m/",
                             "3 ((((",
                             "3 sqrt(((m)",
                             "3 √",
                             "3 m^(1/0)",
                             "1 m^1/2",
                             "3 m^9999999.5",
                             "3 m^99999999999",
                             "3 m0.5",
                             "3 m)",
                             "3 1e3m",
                             "3 m 1e3",
                             "3 \xFF",
                             "1_000 m",
                             "3 m\xFF\xFE",
                             "3 lg(re 1 mW)"}) {
        INFO(text);
        CHECK(refusal(text, "m") != "");
    }
    CHECK(refusal("1 " + std::string(100000, '('), "m") != "");
    CHECK(refusal("1 m" + std::string(100000, '^'), "m").size() < 250);
    CHECK(refusal(std::string("1 m\0s", 5), "m") != "");
}
