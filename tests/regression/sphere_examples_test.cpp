// SPDX-License-Identifier: GPL-3.0-or-later
// Examples of chains of spheres in short, by the program. Figures: closed forms of docs/theory/sphere_bonds.md,
// sections 3 and 7, and of pull_out.md.
#include "io/history_csv.h"
#include "support/workplace.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace fs = std::filesystem;
using grainfrac::HistoryTable;

namespace {

struct Tables {
    HistoryTable walls, bodies, history;
};

Tables tables_of(const std::string& example, const std::string& values, double energy_error = 1e-3)
{
    const grainfrac::test::Workplace place;
    const std::string folder = place.folder.string();
    const std::string command = std::string(GF_PROGRAM) + " run '" + GF_SOURCE_DIR + "/examples/" + example +
                                ".toml' --out '" + folder + "/out' -q --no-report --threads 1 " + values +
                                " > /dev/null";
    CAPTURE(command);
    REQUIRE(std::system(command.c_str()) == 0);
    const fs::path out = fs::path(folder) / "out";
    Tables t{grainfrac::read_history_csv(out / "walls.csv"), grainfrac::read_history_csv(out / "fragments.csv"),
             grainfrac::read_history_csv(out / "history.csv")};
    CHECK(t.history.column("energy_error").back() < energy_error);
    return t;
}

}  // namespace

TEST_CASE("example damped_pair: the force decays as that of a damped oscillator")
{
    const Tables t = tables_of("damped_pair/damped_pair", "");
    const std::vector<double>&time = t.walls.column("time_s"), &force = t.walls.column("held_force_x_N");
    const double K = 1e7, m = 1000.0, omega = 100.0, zeta = 0.3, c = 2.0 * zeta * std::sqrt(K * m);
    const double x0 = 2e-3, v0 = 0.1, w = omega * std::sqrt(1.0 - zeta * zeta), B = (v0 + zeta * omega * x0) / w;
    double worst = 0.0;
    for (std::size_t i = 0; i < time.size(); ++i) {
        const double s = time[i] - 0.02;
        if (s < 2e-4) continue;
        const double e = std::exp(-zeta * omega * s), x = e * (x0 * std::cos(w * s) + B * std::sin(w * s));
        const double v = e * (B * w * std::cos(w * s) - x0 * w * std::sin(w * s)) - zeta * omega * x;
        worst = std::max(worst, std::fabs(force[i] - (K * x + c * v)));
    }
    CHECK(worst < 5e-3 * K * x0);  // dashpots are of first order; 2.7e-3 with the step of the example
}

TEST_CASE("example chain_beam: every node where the closed form of a bonded chain has it")
{
    const Tables t = tables_of("chain_beam/chain_beam", "");
    CHECK(-t.walls.column("left_force_z_N").back() == Approx(48.0).epsilon(1e-6));
    CHECK(-t.walls.column("right_force_z_N").back() == Approx(48.0).epsilon(1e-6));
    const std::vector<double>& z = t.bodies.column("position_z_m");
    REQUIRE(z.size() == 50);
    const double pi = 3.14159265358979, EI = 1e9 * pi / 4.0, K_s = 5e8 * pi, L = 98.0, h = 2.0;
    double worst = 0.0, most = 0.0;
    for (std::size_t i = 0; i < z.size(); ++i) {
        const double x = h * static_cast<double>(i);
        const double w = x * (L * L * L - 2.0 * L * x * x + x * x * x) / (24.0 * EI) -
                         h * h * x * (L - x) / (12.0 * EI) + x * (L - x) / (2.0 * h * K_s);
        worst = std::max(worst, std::fabs(-z[i] - w));
        most = std::max(most, w);
    }
    CHECK(worst < 1e-6 * most);
}

TEST_CASE("example chain_catenary in short: both ends bear half of the string")
{
    // as far as the ends come together, and 600 s of 3000 for the swinging to go down
    const Tables t = tables_of("chain_catenary/chain_catenary",
                               "--set stages.hang.duration='\"600 s\"' --set stages.hang.local_damping=0.7");
    CHECK(t.walls.column("right_position_x_m").back() == Approx(90.0).epsilon(1e-4));
    const double left = t.walls.column("left_force_x_N").back(), right = -t.walls.column("right_force_x_N").back();
    CHECK(left == Approx(62.40).epsilon(0.05));
    CHECK(right == Approx(62.40).epsilon(0.05));
}

TEST_CASE("example chain_fountain in short: the plate pushes a stiff chain up, not a string")
{
    const auto reaction = [](const std::string& example) {
        const Tables t = tables_of("chain_fountain/" + example, "--set stages.lift.max_displacement='\"120 m\"'");
        const std::vector<double>&z = t.walls.column("hand_position_z_m"), &f = t.walls.column("plate_force_z_N"),
              &n = t.walls.column("plate_contacts");
        double sum = 0.0;
        int rows = 0;
        const double weight = 1000.0 * 4.0 / 3.0 * 3.14159265358979 * 9.81;
        for (std::size_t i = 0; i < z.size(); ++i) {
            if (z[i] < 60.0) continue;
            sum += -f[i] - n[i] * weight;
            ++rows;
        }
        return sum / rows / (2094.4 * 40.0 * 40.0);
    };
    CHECK(reaction("chain_fountain") > 0.08);
    CHECK(std::fabs(reaction("chain_string")) < 0.04);  // counted in whole spheres, 0.012 each
}

namespace {

struct Line {
    double slope, start, farthest;
};

/// Of least squares; farthest: the largest distance of y from it.
Line line_through(const std::vector<double>& x, const std::vector<double>& y)
{
    const auto n = static_cast<double>(x.size());
    double sx = 0.0, sy = 0.0, sxx = 0.0, sxy = 0.0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        sx += x[i];
        sy += y[i];
        sxx += x[i] * x[i];
        sxy += x[i] * y[i];
    }
    Line line{};
    line.slope = (n * sxy - sx * sy) / (n * sxx - sx * sx);
    line.start = (sy - line.slope * sx) / n;
    for (std::size_t i = 0; i < x.size(); ++i)
        line.farthest = std::max(line.farthest, std::fabs(line.start + line.slope * x[i] - y[i]));
    return line;
}

/// Force of the plate less what presses on it, in the mean while the end rises from 60 to 190 m [N].
double push_of_plate(const std::string& example, double speed)
{
    const Tables t = tables_of("chain_fountain/" + example, "--set 'stages.lift.move=[{wall=\"hand\",velocity=[0,0," +
                                                                std::to_string(speed) + "]}]'");
    const std::vector<double>&z = t.walls.column("hand_position_z_m"), &f = t.walls.column("plate_force_z_N"),
          &n = t.walls.column("plate_contacts");
    const double weight = 1000.0 * 4.0 / 3.0 * 3.14159265358979 * 9.81;
    double sum = 0.0;
    int rows = 0;
    for (std::size_t i = 0; i < z.size(); ++i) {
        if (z[i] < 60.0 || z[i] > 190.0) continue;
        sum += -f[i] - n[i] * weight;
        ++rows;
    }
    return sum / rows;
}

}  // namespace

TEST_CASE("example chain_fountain: the push of the plate grows with the momentum, by moments alone", "[slow]")
{
    // Biggins & Warner 2014 have 1/2 (1 - 4 I/(m b^2)) for rigid links, 1/6 for three beads; counted here, by what
    // presses on the plate, 0.166 and 0.015. Of a chain that swings as it likes no more can be asked than this share; a
    // string needs no push at all.
    const std::vector<double> speeds{20.0, 40.0, 60.0, 80.0};
    std::vector<double> momentum, stiff, limp;
    for (const double v : speeds) {
        momentum.push_back(2094.4 * v * v);
        stiff.push_back(push_of_plate("chain_fountain", v));
        limp.push_back(push_of_plate("chain_string", v));
    }
    CHECK(line_through(momentum, stiff).slope == Approx(1.0 / 6.0).margin(0.04));
    CHECK(std::fabs(line_through(momentum, limp).slope) < 0.02);
}

namespace {

/// The upper half of the example's ball with the direction of the plates along z, as a table of spheres.
void write_half_ball(const fs::path& file, double R)
{
    const double n[3] = {0.372217, 0.602124, 0.706330}, across = std::hypot(n[0], n[1]), a = std::sqrt(0.5);
    const double e[3] = {-n[1] / across, n[0] / across, 0.0};
    const double f[3] = {n[1] * e[2] - n[2] * e[1], n[2] * e[0] - n[0] * e[2], n[0] * e[1] - n[1] * e[0]};
    std::ofstream out(file);
    out.precision(17);
    out << "x_m,y_m,z_m,radius_m\n";
    const int most = static_cast<int>(R / a) + 1;
    for (int i = -most; i <= most; ++i) {
        for (int j = -most; j <= most; ++j) {
            for (int k = -most; k <= most; ++k) {
                const double p[3] = {i * a, j * a, k * a}, z = p[0] * n[0] + p[1] * n[1] + p[2] * n[2];
                if ((i + j + k) % 2 != 0 || p[0] * p[0] + p[1] * p[1] + p[2] * p[2] > R * R || z < -0.8) continue;
                out << p[0] * e[0] + p[1] * e[1] + p[2] * e[2] << ',' << p[0] * f[0] + p[1] * f[1] + p[2] * f[2] << ','
                    << z << ",0.5\n";
            }
        }
    }
}

/// The example with that half, whose middle keeps its height: what it does by symmetry.
std::string half_ball_case(double R, double speed, double way)
{
    std::ifstream in(std::string(GF_SOURCE_DIR) + "/examples/sphere_on_plane/sphere_on_plane.toml");
    std::string text(std::istreambuf_iterator<char>(in), {});
    const auto replace = [&](const std::string& from, const std::string& to, const std::string& with) {
        const std::size_t begin = text.find(from), end = text.find(to, begin);
        REQUIRE(end != std::string::npos);
        text.replace(begin, end - begin, with);
    };
    const std::string ramp = std::to_string(0.15 / speed);
    replace("generator = \"fcc\"", "[[bonds]]", "generator = \"file\"\nfile = \"ball.csv\"\n\n");
    replace("[[walls]]", "[test]",
            "[[walls]]\nname = \"top\"\ncenter = [0, 0, " + std::to_string(R + 0.5) +
                "]\nnormal = [0, 0, -1]\nsize = [40, 40]\nthickness = 2\n\n[[grips]]\nname = \"middle\"\npart = "
                "\"ball\"\nhold = [\"z\"]\nregion = { shape = \"box\", center = [0, 0, -0.4], size = [50, 50, 0.82] "
                "}\n\n[[stages]]\nname = \"press\"\nmove = [{ wall = \"top\", velocity = [0, 0, " +
                std::to_string(-speed) + "] }]\nramp = " + ramp +
                "\nlocal_damping = 0.2\nduration = " + std::to_string(way / speed + 0.075 / speed) + "\n\n");
    return text;
}

}  // namespace

TEST_CASE("example sphere_on_plane, its half: depth and radius of the contact grow as those of Hertz", "[slow]")
{
    // R = 20 d to a = 5.3 d, three times as fast; the whole ball at the example's speed has 1.8 % (README)
    const double R = 20.0, E = 2.0 * std::sqrt(2.0) * 1e9, speed = 9.0;
    const grainfrac::test::Workplace place;
    write_half_ball(place.folder / "ball.csv", R);
    std::ofstream(place.folder / "ball.toml") << half_ball_case(R, speed, 1.57);
    const std::string folder = place.folder.string(), command = std::string(GF_PROGRAM) + " run '" + folder +
                                                                "/ball.toml' --out '" + folder +
                                                                "/out' -q --no-report --threads 1 > /dev/null";
    CAPTURE(command);
    REQUIRE(std::system(command.c_str()) == 0);
    const HistoryTable walls = grainfrac::read_history_csv(place.folder / "out" / "walls.csv");
    const std::vector<double>&z = walls.column("top_position_z_m"), &force = walls.column("top_force_z_N"),
          &radius = walls.column("top_contact_radius_m");
    std::vector<double> way, load, log_force, log_depth;
    double worst_radius = 0.0, most_radius = 0.0;
    for (std::size_t i = 0; i < z.size(); ++i) {
        const double depth = std::pow(3.0 * std::fabs(force[i]) / (4.0 * E * std::sqrt(R)), 2.0 / 3.0),
                     a = std::sqrt(R * depth);
        most_radius = std::max(most_radius, a);
        if (a < 3.0) continue;
        way.push_back(z[0] - z[i]);
        load.push_back(std::pow(std::fabs(force[i]), 2.0 / 3.0));
        // the points of the contact are weighted by their forces: root 4/5 of the radius under the pressure of Hertz
        if (a >= 5.0) worst_radius = std::max(worst_radius, std::fabs(radius[i] / std::sqrt(0.8) / a - 1.0));
    }
    REQUIRE(way.size() > 20);
    CHECK(most_radius > 5.25);
    const Line line = line_through(way, load);
    CHECK(line.farthest < 0.01 * load.back());
    CHECK(line.slope == Approx(std::pow(4.0 / 3.0 * E * std::sqrt(R), 2.0 / 3.0)).epsilon(0.03));  // 1.9 % above
    for (std::size_t i = 0; i < way.size(); ++i) {
        log_force.push_back(1.5 * std::log(load[i]));
        log_depth.push_back(std::log(way[i] + line.start / line.slope));
    }
    CHECK(line_through(log_depth, log_force).slope == Approx(1.5).margin(0.015));
    CHECK(worst_radius < 0.1);  // 5.5 %
}

namespace {

const char* const short_pull_out =
    "--set parts.matrix.region.height='\"6 m\"' --set parts.matrix.region.diameter='\"6 m\"' --set "
    "test.damage_step=0.04 ";

struct PullOutRun {
    std::string hash;
    double peak, slip, work, error;
};

/// Of the example of a fibre of 6 m along an axis.
PullOutRun pulled(char axis, int threads)
{
    const grainfrac::test::Workplace place;
    const std::string folder = place.folder.string();
    const std::string ends = axis == 'x' ? "'[-2.9, 0, 0]' --set parts.fibre.fibre.to='[2.9, 0, 0]' "
                                         : "'[0, 0, -2.9]' --set parts.fibre.fibre.to='[0, 0, 2.9]' ";
    const std::string along = std::string("'\"") + axis + "\"' ";
    const std::string command = std::string(GF_PROGRAM) + " run '" + GF_SOURCE_DIR +
                                "/examples/fibre_pullout/fibre_pullout.toml' --out '" + folder +
                                "/out' -q --no-report --threads " + std::to_string(threads) + " " + short_pull_out +
                                "--set parts.fibre.fibre.from=" + ends + "--set parts.matrix.region.axis=" + along +
                                "--set parts.matrix.lattice_axis=" + along + " > /dev/null";
    CAPTURE(command);
    REQUIRE(std::system(command.c_str()) == 0);
    std::ifstream in(folder + "/out/summary.json");
    const nlohmann::json s = nlohmann::json::parse(in);
    const nlohmann::json& t = s["test"];
    return {s["state_hash"].get<std::string>(), t["peak_stress_Pa"].get<double>(),
            t["largest_exit_slip_m"].get<double>(), t["work_J_per_m2"].get<double>(),
            s["energy"]["relative_error"].get<double>()};
}

}  // namespace

TEST_CASE("example fibre_pullout in short: same bits on two threads, same path along another axis")
{
    const PullOutRun one = pulled('z', 1), two = pulled('z', 2), turned = pulled('x', 1);
    CHECK(one.hash == two.hash);
    CHECK(one.error < 1e-3);
    // equilibria are found to 1e-6 of the mean force
    CHECK(turned.peak == Approx(one.peak).epsilon(1e-4));
    CHECK(turned.slip == Approx(one.slip).epsilon(1e-4));
    CHECK(turned.work == Approx(one.work).epsilon(1e-3));
    CHECK(one.slip == Approx(3e-3).epsilon(0.01));  // a fibre shorter than 9.7 m never slips further
}

TEST_CASE("example fibre_pullout in short: what is broken slides until little is left in the matrix")
{
    // A step of the slide takes more than half of a piece, and in the end friction acts metres from the nodes.
    std::ifstream in(std::string(GF_SOURCE_DIR) + "/examples/fibre_pullout/fibre_pullout.toml");
    std::string text(std::istreambuf_iterator<char>(in), {});
    const std::string key = "failure_slip    = \"3 mm\"\n";
    REQUIRE(text.find(key) != std::string::npos);
    text.insert(text.find(key) + key.size(), "residual_shear = \"0.1 MPa\"\nnormal_stiffness = 1e9\n");
    const grainfrac::test::Workplace place;
    const std::string folder = place.folder.string();
    std::ofstream(folder + "/slide.toml") << text;
    const std::string command =
        std::string(GF_PROGRAM) + " run '" + folder + "/slide.toml' --out '" + folder +
        "/out' -q --no-report --threads 1 " + short_pull_out +
        "--set parts.fibre.fibre.from='[0, 0, -2.9]' --set parts.fibre.fibre.to='[0, 0, 2.9]' " +
        "--set test.damage_step=0.3 --set test.slide_step=0.5 --set test.stop.slip=5 > /dev/null";
    CAPTURE(command);
    REQUIRE(std::system(command.c_str()) == 0);
    const HistoryTable t = grainfrac::read_history_csv(fs::path(folder) / "out" / "pull_out.csv");
    std::ifstream summary_file(folder + "/out/summary.json");
    const double length = nlohmann::json::parse(summary_file)["test"]["embedded_length_m"].get<double>();
    const std::vector<double>&slip = t.column("embedded_slip_m"), &stress = t.column("end_stress_Pa");
    CHECK(slip.back() > 5.0);
    for (std::size_t i = 0; i < slip.size(); ++i) {
        if (slip[i] < 0.25) continue;
        CHECK(stress[i] == Approx(2.0 * 0.1e6 * (length - slip[i])).epsilon(1e-3));  // 2 tau_r (L - s)/a
    }
}

TEST_CASE("example fibre_in_grains in short: a fibre slides past grains that reach into it")
{
    // every second layer has a corner of three prisms where the fibre is
    const grainfrac::test::Workplace place;
    const std::string folder = place.folder.string();
    const std::string command =
        std::string(GF_PROGRAM) + " run '" + GF_SOURCE_DIR + "/examples/fibre_in_grains/fibre_in_grains.toml' --out '" +
        folder +
        "/out' -q --no-report --threads 1 --set parts.matrix.stacking='\"hollow\"' "
        "--set parts.matrix.region.height='\"40 um\"' --set parts.matrix.region.diameter='\"60 um\"' "
        "--set parts.fibre.fibre.from='[0, 0, \"-20 um\"]' --set parts.fibre.fibre.to='[0, 0, \"30 um\"]' "
        "--set test.displacement_step='\"0.05 um\"' --set test.stop.slip='\"10 um\"' > /dev/null";
    CAPTURE(command);
    REQUIRE(std::system(command.c_str()) == 0);
    const HistoryTable t = grainfrac::read_history_csv(fs::path(folder) / "out" / "pull_out.csv");
    const std::vector<double>&slip = t.column("embedded_slip_m"), &stress = t.column("end_stress_Pa");
    CHECK(slip.back() > 9.9e-6);
    for (std::size_t i = 0; i < slip.size(); ++i) {
        if (slip[i] > 1e-6) CHECK(stress[i] == Approx(2.0 * 10e6 * (40e-6 - slip[i]) / 8.5e-6).epsilon(1e-3));
    }
}
