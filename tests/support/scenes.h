// SPDX-License-Identifier: GPL-3.0-or-later
// Small runs in which much happens, and result folders compared bit by bit.
#pragma once

#include "io/hdf5_file.h"
#include "support/program.h"

#include <algorithm>
#include <cstring>
#include <iterator>
#include <set>
#include <stdexcept>

namespace program_test {

/// A run of a second or two that says much.
struct Scene {
    const char* name;
    std::string input;                   ///< text of its file, or the file
    std::vector<std::string> arguments;  ///< besides
};

inline Scene cleaving_disc(int checkpoint_steps = 1000)
{
    return {"a disc of grains that cleave, damage and split",
            (source / "examples/brazilian_cleavage/brazilian_cleavage.toml").string(),
            {"--set", "parts.disc.side=\"15 mm\"", "--set", "test.platen_speed=\"600 mm/s\"", "--set",
             "bonds[0].tensile_strength=\"15 MPa\"", "--set", "bonds[0].cohesion=\"40 MPa\"", "--set",
             "bonds[0].fracture_energy_I=\"12 J/m^2\"", "--set", "bonds[0].fracture_energy_II=\"100 J/m^2\"", "--set",
             "materials.sic.cleavage.toughness=\"1.5 MPa m^0.5\"", "--set", "output.every=\"20 us\"", "--set",
             "output.checkpoint_steps=" + std::to_string(checkpoint_steps)}};
}

inline Scene column_of_stages(int checkpoint_steps = 5000)
{
    return {
        "stages with a servo, bonds made on the way, unloading",
        staged_column,
        {"--set", "output.checkpoint_steps=" + std::to_string(checkpoint_steps), "--set", "output.every=\"50 us\""}};
}

inline Scene fibre(int checkpoint_steps = 3000)
{
    return {"equilibria of a pull-out",
            (source / "examples/fibre_pullout/fibre_pullout.toml").string(),
            {"--set", "parts.matrix.region={shape=\"cylinder\",diameter=\"6 m\",height=\"4 m\",axis=\"z\"}", "--set",
             "parts.fibre.fibre={from=[0,0,\"-2.2 m\"],to=[0,0,\"2.2 m\"],radius=\"1 m\"}", "--set",
             "test.damage_step=0.05", "--set", "output.checkpoint_steps=" + std::to_string(checkpoint_steps), "--set",
             "output.every=4.0", "--set", "test.profiles_at=[0.1,0.5,0.9]"}};
}

inline Scene spheres(int checkpoint_steps = 400)
{
    return {"spheres whose bonds remember their forces",
            R"([materials.glass]
density = 2500
young_modulus = "1 GPa"
poisson_ratio = 0.2
[[parts]]
name = "block"
kind = "spheres"
material = "glass"
generator = "hcp"
diameter = "1 mm"
region = { shape = "box", size = ["4 mm", "4 mm", "8 mm"] }
[[bonds]]
law = "parallel"
form = "incremental"
tensile_strength = "2 MPa"
cohesion = "3 MPa"
[[contacts]]
friction = 0.4
[[walls]]
name = "bottom"
center = [0, 0, "-4.2 mm"]
normal = [0, 0, 1]
size = ["20 mm", "20 mm"]
[[walls]]
name = "top"
center = [0, 0, "4.2 mm"]
normal = [0, 0, -1]
size = ["20 mm", "20 mm"]
[[stages]]
name = "press"
move = [{ wall = "top", velocity = [0, 0, "-400 mm/s"] }]
ramp = "20 us"
max_displacement = "0.12 mm"
[output]
history = "3 us"
every = "60 us"
checkpoint_steps = )" +
                std::to_string(checkpoint_steps) + "\n",
            {}};
}

inline std::vector<std::string> run_arguments(const Workplace& w, const Scene& s, const std::string& out)
{
    std::string file = s.input;
    if (file.find('\n') != file.npos) {
        file = (w.folder / "scene.toml").string();
        std::ofstream(file) << s.input;
    }
    std::vector<std::string> a{"run", file, "--out", out, "--force", "-q", "--no-report", "--threads", "1"};
    a.insert(a.end(), s.arguments.begin(), s.arguments.end());
    return a;
}

inline std::vector<std::string> resume_arguments(const std::string& folder)
{
    return {"resume", folder, "-q", "--no-report", "--threads", "1"};
}

inline void compare_hdf5(const grainfrac::Hdf5File& a, const grainfrac::Hdf5File& b, const std::string& group,
                         std::vector<std::string>& differences)
{
    REQUIRE(a.children(group) == b.children(group));
    for (const std::string& child : a.children(group)) {
        const std::string name = group + (group == "/" ? "" : "/") + child;
        bool dataset = true;
        try {
            (void)a.extents(name);
        } catch (const std::runtime_error&) {
            dataset = false;
        }
        if (!dataset) {
            compare_hdf5(a, b, name, differences);
            continue;
        }
        if (a.extents(name) != b.extents(name)) {
            differences.push_back("results.h5" + name + ": extents");
            continue;
        }
        const std::vector<double> x = a.read<double>(name), y = b.read<double>(name);
        if (!x.empty() && std::memcmp(x.data(), y.data(), x.size() * sizeof(double)) != 0)
            differences.push_back("results.h5" + name);
    }
}

inline nlohmann::json outcome(const fs::path& folder)
{
    nlohmann::json j = nlohmann::json::parse(text_of(folder / "summary.json"));
    for (const char* clock : {"run_time", "peak_memory_B"}) j.erase(clock);
    return j;
}

inline std::set<std::string> files_of(const fs::path& folder)
{
    std::set<std::string> names;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
        const std::string name = fs::relative(entry.path(), folder).string();
        if (entry.is_regular_file() && !name.starts_with("checkpoint/") && name != "run.log") names.insert(name);
    }
    return names;
}

/// Names of what is not the same in two result folders, clocks and the log apart.
inline std::vector<std::string> differences(const fs::path& a, const fs::path& b)
{
    std::vector<std::string> found;
    const std::set<std::string> files = files_of(a), others = files_of(b);
    std::set_symmetric_difference(files.begin(), files.end(), others.begin(), others.end(), std::back_inserter(found));
    if (!found.empty()) return found;
    for (const std::string& name : files) {
        if (name == "summary.json") {
            if (outcome(a) != outcome(b)) found.push_back(name);
        } else if (name == "results.h5") {
            compare_hdf5(grainfrac::Hdf5File::open(a / name), grainfrac::Hdf5File::open(b / name), "/", found);
        } else if (text_of(a / name) != text_of(b / name)) {
            found.push_back(name);
        }
    }
    return found;
}

inline std::string listed(const std::vector<std::string>& names)
{
    std::string text;
    for (const std::string& n : names) text += n + "; ";
    return text;
}

/// Rows of a history.csv that are whole, without its head.
inline std::vector<std::string> history_rows(const fs::path& file)
{
    const std::string text = text_of(file);
    std::vector<std::string> rows;
    bool named = false;
    for (std::size_t begin = 0, end; (end = text.find('\n', begin)) != text.npos; begin = end + 1) {
        if (text[begin] == '#') continue;
        if (named) rows.push_back(text.substr(begin, end - begin));
        named = true;
    }
    return rows;
}

}  // namespace program_test
