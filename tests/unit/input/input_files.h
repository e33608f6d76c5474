// SPDX-License-Identifier: GPL-3.0-or-later
// Input files for the tests of the reader: a good one, and the means to spoil it.
#pragma once

#include "experiment/experiment.h"
#include "io/input.h"

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace grainfrac::test {

inline const char* const brazilian_input = R"([simulation]
title = "disc"
seed = 7

[materials.sic]
density = "3100 kg/m^3"
young_modulus = "410 GPa"
poisson_ratio = 0.16

[[parts]]
name = "disc"
material = "sic"
side = "0.6 mm"
thickness = "5 mm"
region = { shape = "disc", diameter = "15 mm", height = "5 mm" }

[[bonds]]
between = ["disc", "disc"]
tensile_strength = "300 MPa"
cohesion = "600 MPa"
friction = 0.3
fracture_energy_I = 29
fracture_energy_II = "116 J/m^2"

[[contacts]]
friction = 0.2

[test]
kind = "brazilian"
platen_speed = "20 mm/s"
stop = { load_drop = 0.5 }

[output]
every = "10 us"
)";

inline const char* const custom_input = R"([materials.sic]
density = 3100
young_modulus = "410 GPa"
poisson_ratio = 0.16

[[parts]]
name = "block"
material = "sic"
side = "0.6 mm"
thickness = "1.3 mm"
region = { shape = "box", size = ["5 mm", "10 mm", "2 mm"] }

[[walls]]
name = "top"
size = [0.01, 0.01]

[[stages]]
name = "press"
move = [{ wall = "top", velocity = [0, "-20 mm/s", 0] }]
duration = "1 ms"
)";

inline std::string contents(const std::string& file)
{
    std::ifstream in(file, std::ios::binary);
    std::ostringstream out;
    out << in.rdbuf();
    return out.str();
}

/// `text` with `from` replaced by `to`; `from` must be there.
inline std::string replaced(std::string text, const std::string& from, const std::string& to)
{
    const auto at = text.find(from);
    if (at == text.npos) throw std::logic_error("not in the text: " + from);
    return text.replace(at, from.size(), to);
}

/// A file in the temporary folder, gone with the object.
class TemporaryFile {
public:
    explicit TemporaryFile(const std::string& text)
    {
        static int count = 0;
        const auto id = std::to_string(reinterpret_cast<std::uintptr_t>(&count)) + '_' + std::to_string(count++);
        path_ = (std::filesystem::temp_directory_path() / ("grainfrac_input_" + id + ".toml")).string();
        std::ofstream(path_, std::ios::binary) << text;
    }
    ~TemporaryFile() { std::remove(path_.c_str()); }
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;
    const std::string& path() const { return path_; }

private:
    std::string path_;
};

inline Case read_text(const std::string& text, const std::vector<std::string>& overrides = {})
{
    const TemporaryFile file(text);
    std::map<std::string, SourcePlace> places;
    return read_case(file.path(), overrides, places);
}

/// What is reported about the text, with the name of the file as FILE; "" if nothing is wrong.
inline std::string problems_of(const std::string& text, const std::vector<std::string>& overrides = {})
{
    const TemporaryFile file(text);
    std::map<std::string, SourcePlace> places;
    try {
        read_case(file.path(), overrides, places);
        return "";
    } catch (const InputError& e) {
        std::string out = render_problems(e.problems, places, file.path());
        for (std::size_t at; (at = out.find(file.path())) != out.npos;) out.replace(at, file.path().size(), "FILE");
        return out;
    }
}

/// The report of build(), "" if there is none.
inline std::string build_problems_of(const std::string& text)
{
    const TemporaryFile file(text);
    std::map<std::string, SourcePlace> places;
    const Case c = read_case(file.path(), {}, places);
    try {
        build(c, Device::cpu);
        return "";
    } catch (const InputError& e) {
        std::string out = render_problems(e.problems, c.places, c.file);
        const std::string folder = std::filesystem::path(file.path()).parent_path().string();
        for (std::size_t at; (at = out.find(file.path())) != out.npos;) out.replace(at, file.path().size(), "FILE");
        for (std::size_t at; (at = out.find(folder)) != out.npos;) out.replace(at, folder.size(), "FOLDER");
        return out;
    }
}

}  // namespace grainfrac::test
