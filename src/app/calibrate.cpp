// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/prepare.h"
#include "app/version.h"
#include "experiment/calibration.h"
#include "gpu/device.h"
#include "io/atomic_file.h"
#include "io/input.h"
#include "io/results.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>

namespace grainfrac {

namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// What came of one [[calibration]].
struct Found {
    const CalibrationSpec* spec = nullptr;
    ElasticTarget target;
    std::vector<Trial> trials;
    BondSpec bond;  ///< the entry of [[bonds]] with what was found
    int entry = -1, bodies = 0, bonds = 0;
    double area = 0.0;               ///< [m^2]
    std::optional<double> strength;  ///< of the sample with the strengths of the input [Pa]

    bool meets_target() const { return meets(target, trials.back().response) && trials.back().response.at_rest; }
};

void print_trial(std::size_t number, const Trial& t)
{
    fmt::print("  {:2}  k_n {:.6g} Pa/m, k_s/k_n {:.6g}: E = {:.6g} Pa, nu = {:.5f}{}\n", number + 1,
               t.bonds.normal_stiffness, t.bonds.shear_ratio, t.response.young_modulus, t.response.poisson_ratio,
               t.response.at_rest ? "" : fmt::format(" (not at rest, residual {:.1g})", t.response.residual));
}

Found calibrate_part(const Case& c, std::size_t i, Device device, bool quiet)
{
    const CalibrationSample sample(c, i, device);
    Found f;
    f.spec = &c.calibration[i];
    f.target = sample.target();
    f.entry = sample.bond_entry();
    f.bodies = sample.bodies();
    f.bonds = sample.bonds();
    f.area = sample.area();
    f.bond = c.bonds[static_cast<std::size_t>(f.entry)];
    if (!quiet) fmt::print("part \"{}\": sample of {} bodies, {} bonds\n", f.spec->part, f.bodies, f.bonds);
    std::size_t number = 0;
    try {
        f.trials = find_bond_constants(f.target, sample.start(), [&](const BondConstants& k) {
            const Response r = sample.pull(k);
            if (!quiet) print_trial(number, {k, r});
            ++number;
            return r;
        });
    } catch (InputError& e) {
        for (InputProblem& p : e.problems)
            if (p.key == "poisson_ratio") p.key = fmt::format("calibration[{}].poisson_ratio", i);
        throw;
    }
    f.bond.between = {f.spec->part, f.spec->part};
    f.bond.normal_stiffness = f.trials.back().bonds.normal_stiffness;
    f.bond.shear_ratio = f.trials.back().bonds.shear_ratio;
    if (f.spec->tensile_strength) {
        const double found = sample.strength(f.trials.back().bonds);
        if (!(found > 0.0))
            throw InputError(fmt::format("calibration[{}].tensile_strength", i),
                             "no bond of the sample can break; give the bonds a tensile_strength and a cohesion");
        f.strength = found;
        const double scale = *f.spec->tensile_strength / found;
        f.bond.tensile_strength *= scale;
        f.bond.cohesion *= scale;
        f.bond.fracture_energy_I *= scale * scale;
        f.bond.fracture_energy_II *= scale * scale;
        if (!quiet)
            fmt::print("      strength of the sample {:.6g} Pa; strengths of the bonds times {:.6g}\n", found, scale);
    }
    return f;
}

std::string trials_csv(const std::vector<Found>& all)
{
    std::string out = fmt::format(
        "# grainfrac {} calibrate; tension is positive\n"
        "part,trial,normal_stiffness_Pa_per_m,shear_ratio,young_modulus_Pa,poisson_ratio,young_modulus_error,"
        "poisson_ratio_error,relaxation_steps,residual\n",
        GRAINFRAC_VERSION);
    for (const Found& f : all) {
        for (std::size_t k = 0; k < f.trials.size(); ++k) {
            const Trial& t = f.trials[k];
            const Response& r = t.response;
            const double wanted = f.target.poisson_ratio.value_or(r.poisson_ratio);
            out += fmt::format("{},{},{},{},{},{},{},{},{},{}\n", f.spec->part, k + 1, t.bonds.normal_stiffness,
                               t.bonds.shear_ratio, r.young_modulus, r.poisson_ratio,
                               r.young_modulus / f.target.young_modulus - 1.0, r.poisson_ratio - wanted, r.steps,
                               r.residual);
        }
    }
    return out;
}

std::string calibrated_toml(const std::vector<Found>& all)
{
    std::string out = "# Found by `grainfrac calibrate`: in place of the entries of these parts in the input.\n";
    for (const Found& f : all) {
        const Response& r = f.trials.back().response;
        out += fmt::format("\n# {}: E = {:.6g} Pa (wanted {:.6g}), nu = {:.5f}{}, {} trial(s){}\n", f.spec->part,
                           r.young_modulus, f.target.young_modulus, r.poisson_ratio,
                           f.target.poisson_ratio ? fmt::format(" (wanted {:.5g})", *f.target.poisson_ratio) : "",
                           f.trials.size(), f.meets_target() ? "" : "; NOT within the tolerance");
        out += bonds_to_toml(f.bond);
    }
    return out;
}

json summary_of(const Found& f)
{
    const Trial& last = f.trials.back();
    json j = {{"part", f.spec->part},
              {"bonds_entry", f.entry},
              {"sample_bodies", f.bodies},
              {"sample_bonds", f.bonds},
              {"measure", f.area > 0.0 ? "section" : "core"},
              {"trials", f.trials.size()},
              {"converged", f.meets_target()},
              {"normal_stiffness_Pa_per_m", last.bonds.normal_stiffness},
              {"shear_ratio", last.bonds.shear_ratio},
              {"young_modulus_Pa", last.response.young_modulus},
              {"young_modulus_wanted_Pa", f.target.young_modulus},
              {"poisson_ratio", last.response.poisson_ratio},
              {"tolerance", f.target.tolerance}};
    if (f.area > 0.0) j["section_m2"] = f.area;
    if (f.target.poisson_ratio) j["poisson_ratio_wanted"] = *f.target.poisson_ratio;
    if (f.strength) {
        j["tensile_strength_wanted_Pa"] = *f.spec->tensile_strength;
        j["tensile_strength_before_Pa"] = *f.strength;
        j["bond_tensile_strength_Pa"] = f.bond.tensile_strength;
        j["bond_cohesion_Pa"] = f.bond.cohesion;
    }
    return j;
}

/// Trials may be wrong by powers of ten and right to a thousandth.
double magnitude(double deviation)
{
    constexpr double least = 1e-6;
    return std::log10(std::max(std::fabs(deviation), least));
}

void plot_convergence(const fs::path& stem, const std::vector<Found>& all)
{
    std::vector<Curve> curves;
    for (const Found& f : all) {
        Curve modulus{f.spec->part + ": E", {}, {}}, poisson{f.spec->part + ": nu", {}, {}};
        for (std::size_t k = 0; k < f.trials.size(); ++k) {
            const Response& r = f.trials[k].response;
            for (Curve* curve : {&modulus, &poisson}) curve->x.push_back(static_cast<double>(k + 1));
            modulus.y.push_back(magnitude(r.young_modulus / f.target.young_modulus - 1.0));
            poisson.y.push_back(magnitude(r.poisson_ratio - f.target.poisson_ratio.value_or(r.poisson_ratio)));
        }
        for (Curve* curve : {&modulus, &poisson}) {  // the last trial as a dash: it may be the only one
            curve->x.push_back(curve->x.back() + 0.05);
            curve->y.push_back(curve->y.back());
        }
        curves.push_back(modulus);
        if (f.target.poisson_ratio) curves.push_back(poisson);
    }
    plot_curves(stem, "Deviation from what is wanted", "Trial", "log10 of E/E_wanted - 1 and of nu - nu_wanted",
                curves);
}

}  // namespace

int calibrate_command(const Options& o)
{
    const Case c = load_case(o);
    const Device device = parse_device(o.device);
    const fs::path out = o.out.empty() ? fs::path(fs::path(o.file).stem().string() + ".calibration") : fs::path(o.out);
    std::vector<Found> all;
    try {
        if (c.calibration.empty())
            throw InputError("calibration",
                             "missing; required: at least one [[calibration]] with part and young_modulus");
        const ResultFolder folder(out, o.force);  // refused before any work
        for (const char* unused : {"paraview", "checkpoint"}) fs::remove(out / unused);
        write_file(out / "resolved.toml", to_toml(c));
        write_file(out / "input.toml", read_file(o.file));
        for (std::size_t i = 0; i < c.calibration.size(); ++i) all.push_back(calibrate_part(c, i, device, o.quiet));
    } catch (const InputError& e) {
        report(e, c);
        throw ReportedInputError{};
    }
    write_file(out / "trials.csv", trials_csv(all));
    write_file(out / "calibrated.toml", calibrated_toml(all));
    json summary = {{"version", GRAINFRAC_VERSION}, {"device", to_string(device)}, {"calibration", json::array()}};
    bool converged = true;
    for (const Found& f : all) {
        summary["calibration"].push_back(summary_of(f));
        converged = converged && f.meets_target();
    }
    write_file(out / "summary.json", summary.dump(2) + "\n");
    if (!o.no_report) plot_convergence(out / "plots" / "convergence", all);
    if (!o.quiet) fmt::print("{}", calibrated_toml(all));
    if (converged) return exit_code::done;
    fmt::print(stderr,
               "error: not within the tolerance after {} trials; raise calibration.max_trials or the tolerance\n",
               all.back().trials.size());
    return exit_code::failure;
}

}  // namespace grainfrac
