// SPDX-License-Identifier: GPL-3.0-or-later
// The Brazilian disc of grains that cleave, in two seconds: 32 weaker grains under fast platens, to a strain at which
// the disc is in pieces.
#pragma once

#include "io/atomic_file.h"
#include "sample.h"

#include <catch2/catch.hpp>

#include <cstdlib>
#include <filesystem>
#include <string>

namespace sample {

inline constexpr double cleaving_side = 15e-3, cleaving_thickness = 18e-3;  // [m]
inline constexpr int cleaving_grains = 32;

/// Leaves the result folder `folder`/run.
inline std::filesystem::path run_cleaving_disc(const TemporaryFolder& folder)
{
    std::string text = read_file(GF_SOURCE_DIR "/examples/brazilian_cleavage/brazilian_cleavage.toml");
    const std::string stop = "load_drop = 0.5, strain = 0.01";
    const std::size_t at = text.find(stop);
    REQUIRE(at != std::string::npos);
    text.replace(at, stop.size(), "strain = 0.0007");
    write_file(folder / "disc.toml", text);
    const std::string input = (folder / "disc.toml").string(), out = (folder / "run").string();
    const std::string command = "'" GF_PROGRAM "' run '" + input + "' -q --no-report --threads 1 --out '" + out +
                                "' --set parts.disc.side='\"15 mm\"' --set test.platen_speed='\"600 mm/s\"'"
                                " --set bonds[0].tensile_strength='\"15 MPa\"' --set bonds[0].cohesion='\"40 MPa\"'"
                                " --set bonds[0].fracture_energy_I='\"12 J/m^2\"'"
                                " --set bonds[0].fracture_energy_II='\"100 J/m^2\"'"
                                " --set materials.sic.cleavage.toughness='\"1.5 MPa m^0.5\"'"
                                " --set output.every='\"60 us\"' > /dev/null 2>&1";
    REQUIRE(std::system(command.c_str()) == 0);
    return out;
}

}  // namespace sample
