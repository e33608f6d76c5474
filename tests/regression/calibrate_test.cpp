// SPDX-License-Identifier: GPL-3.0-or-later
// `grainfrac calibrate` as its user meets it: the example, what it leaves, and wrong input.
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <sys/wait.h>
#include <unistd.h>

namespace fs = std::filesystem;

namespace {

const std::string example = (fs::path(GF_SOURCE_DIR) / "examples/calibrate/calibrate.toml").string();

std::string text_of(const fs::path& file)
{
    std::ifstream in(file);
    std::ostringstream s;
    s << in.rdbuf();
    return s.str();
}

struct Workplace {
    fs::path folder = fs::temp_directory_path() / ("grainfrac_calibrate_" + std::to_string(::getpid()));
    Workplace() { fs::create_directory(folder); }
    ~Workplace()
    {
        std::error_code ignored;
        fs::remove_all(folder, ignored);
    }
    /// Exit code of `calibrate ARGUMENTS`; messages in `err`.
    int calibrate(const std::string& arguments)
    {
        const std::string command =
            "cd " + folder.string() + " && " GF_PROGRAM " calibrate " + arguments + " --threads 1 > out.txt 2> err.txt";
        const int status = std::system(command.c_str());
        err = text_of(folder / "err.txt");
        return WEXITSTATUS(status);
    }
    std::string err;
};

}  // namespace

TEST_CASE("the example of calibration: a matrix by its core, a fibre by its section")
{
    Workplace w;
    REQUIRE(w.calibrate(example) == 0);
    const fs::path out = w.folder / "calibrate.calibration";
    const nlohmann::json s = nlohmann::json::parse(text_of(out / "summary.json"));
    const nlohmann::json &matrix = s["calibration"][0], &fibre = s["calibration"][1];
    CHECK(matrix["converged"] == true);
    CHECK(matrix["trials"] == 1);  // the closed form
    CHECK(matrix["young_modulus_Pa"].get<double>() == Approx(5e9).epsilon(5e-3));
    CHECK(matrix["poisson_ratio"].get<double>() == Approx(0.15).margin(1e-3));
    // all strengths in proportion: 5 MPa gave what was found, 4 MPa is wanted
    const double found = matrix["tensile_strength_before_Pa"].get<double>();
    CHECK(matrix["bond_tensile_strength_Pa"].get<double>() == Approx(5e6 * 4e6 / found).epsilon(1e-12));
    CHECK(fibre["trials"].get<int>() <= 4);
    CHECK(fibre["young_modulus_Pa"].get<double>() == Approx(50e9).epsilon(5e-3));
    CHECK(fibre["section_m2"].get<double>() == Approx(3.14159265));
    CHECK(text_of(out / "trials.csv").find("\nfibre,2,") != std::string::npos);
    CHECK(fs::file_size(out / "plots/convergence.svg") > 1000);

    // What it wrote can stand in the input in place of what was there, and needs no further trial.
    std::string text = text_of(example);
    const auto first = text.find("\n[[bonds]]"), last = text.find("\n[[calibration]]");
    text.replace(first, last - first, "\n" + text_of(out / "calibrated.toml"));
    std::ofstream(w.folder / "again.toml") << text;
    const double k = fibre["normal_stiffness_Pa_per_m"].get<double>();
    const std::string start = " --set calibration[1].start_normal_stiffness=" + std::to_string(k);
    REQUIRE(w.calibrate("again.toml --no-report" + start) == 0);
    const nlohmann::json again = nlohmann::json::parse(text_of(w.folder / "again.calibration/summary.json"));
    CHECK(again["calibration"][0]["tensile_strength_before_Pa"].get<double>() == Approx(4e6).epsilon(1e-4));
    CHECK(again["calibration"][1]["trials"] == 1);
}

TEST_CASE("wrong input of calibrate: exit 2, one message with the place")
{
    Workplace w;
    const auto refused = [&](const std::string& set, const std::string& said) {
        CHECK(w.calibrate(example + " --out a --force --set " + set) == 2);
        INFO(w.err);
        CHECK(w.err.find(said) != std::string::npos);
    };
    refused("calibration[0].part='\"matrx\"'", "did you mean \"matrix\"?");
    refused("calibration[0].poisson_ratio=0.3", "springs in this packing reach at most 0.2");
    refused("calibration[0].poisson_ratio=0.7", "calibration[0].poisson_ratio");
    refused("calibration[0].young_modulus='\"-5 GPa\"'", "must be > 0 Pa");
    refused("calibration[0].width='\"3 m\"'", "too thin for a core");
    refused("calibration[0].measure='\"cor\"'", "did you mean \"core\"?");
    CHECK(w.calibrate(example + " --out b --set calibration[0].max_trials=1 --set calibration[1].max_trials=1") == 1);
    CHECK(w.err.find("not within the tolerance") != std::string::npos);
    std::ofstream(w.folder / "none.toml") << text_of(example).substr(0, text_of(example).find("\n[[calibration]]"));
    CHECK(w.calibrate("none.toml --set test.kind='\"brazilian\"'") == 2);
}

TEST_CASE("calibration of grains from a file, whose interfaces soften")
{
    Workplace w;
    const std::string grains =
        "[simulation]\ntitle = \"grains\"\n[materials.sic]\ndensity = 3100\nyoung_modulus = \"410 GPa\"\n"
        "poisson_ratio = 0.17\n[[parts]]\nname = \"bar\"\nmaterial = \"sic\"\n";
    std::ofstream(w.folder / "grains.toml")
        << grains
        << "generator = \"hexagonal_prisms\"\nside = \"0.6 mm\"\nthickness = \"1 mm\"\nregion = { shape = \"box\", "
           "size = "
           "[\"6 mm\", \"6 mm\", \"12 mm\"] }\nat_region_boundary = \"cut\"\n[[stages]]\nname = \"none\"\nduration = "
           "\"1 us\"\n";
    REQUIRE(std::system(("cd " + w.folder.string() + " && " GF_PROGRAM " generate grains.toml -q").c_str()) == 0);
    const std::string wanted = grains +
                               "generator = \"file\"\nfile = \"grains.microstructure.json\"\n[[bonds]]\nbetween = "
                               "[\"bar\", \"bar\"]\ntensile_strength = \"100 MPa\"\ncohesion = \"300 MPa\"\n"
                               "fracture_energy_I = \"20 J/m^2\"\nfracture_energy_II = \"60 J/m^2\"\n"
                               "[[calibration]]\npart = \"bar\"\nyoung_modulus = \"300 GPa\"\n";
    std::ofstream(w.folder / "file.toml") << wanted;
    CAPTURE(w.err);
    REQUIRE(w.calibrate("file.toml --no-report") == 0);
    const nlohmann::json s =
        nlohmann::json::parse(text_of(w.folder / "file.calibration/summary.json"))["calibration"][0];
    CHECK(s["trials"].get<int>() <= 4);
    CHECK(s["young_modulus_Pa"].get<double>() == Approx(300e9).epsilon(5e-3));
    // With k_s = k_n the columns, 1 mm high, are springs in a row: E = k_n h for the bonds of one layer with the next.
    CHECK(s["normal_stiffness_Pa_per_m"].get<double>() == Approx(300e9 / 1e-3).epsilon(0.01));

    std::ofstream(w.folder / "section.toml") << wanted << "measure = \"section\"\n";
    CHECK(w.calibrate("section.toml --no-report") == 2);
    CHECK(w.err.find("calibration[0].area: missing: the section of a sample from a file is not known") !=
          std::string::npos);
}
