// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/prepare.h"
#include "app/summary.h"
#include "experiment/calibration.h"
#include "experiment/derived.h"
#include "experiment/resources.h"
#include "gpu/device.h"
#include "io/input.h"
#include "motion/step.h"

#include <fmt/format.h>

#include <chrono>
#include <cstdio>

namespace grainfrac {

namespace {

/// A model of more takes more than a moment to build.
constexpr double many_bodies = 5000.0;
/// Steps timed for the estimate of the run time.
constexpr int timed_steps = 50;

double seconds_per_step(const Built& b, double dt)
{
    Built copy{b.model, b.state, b.experiment, b.cleavage};
    const auto before = std::chrono::steady_clock::now();
    for (int i = 0; i < timed_steps; ++i) step(copy.model, copy.state, dt);
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - before).count() / timed_steps;
}

}  // namespace

void start_check(const Case& c, Built& built)
{
    start(built.model, built.state);
    try {
        choose_time_step(c, built.model, built.state);
    } catch (const InputError& e) {
        report(e, c);
        throw ReportedInputError{};
    }
}

namespace {

/// What `grainfrac calibrate` would do with an input that has nothing to run.
int check_calibration(const Case& c, Device device)
{
    fmt::print("{}\n", to_toml(c));
    for (std::size_t i = 0; i < c.calibration.size(); ++i) {
        try {
            const CalibrationSample sample(c, i, device);
            fmt::print("# calibration of \"{}\": a sample of {} bodies, {} bonds\n", c.calibration[i].part,
                       sample.bodies(), sample.bonds());
        } catch (const InputError& e) {
            report(e, c);
            throw ReportedInputError{};
        }
    }
    return exit_code::done;
}

/// What takes more than a moment to build is said before.
void announce(const Case& c, const Options& o)
{
    try {
        check_resources(c);
    } catch (const InputError& e) {
        report(e, c);
        throw ReportedInputError{};
    }
    const double bodies = expected_bodies(c);
    if (bodies > many_bodies && !o.quiet) fmt::print(stderr, "building about {:.2g} grains and spheres\n", bodies);
}

}  // namespace

int check_command(const Options& o)
{
    const Case c = load_case(o);
    if (!c.calibration.empty() && c.stages.empty() && c.places.count("test") == 0)
        return check_calibration(c, parse_device(o.device));
    announce(c, o);
    Built b = build_case(c, parse_device(o.device));
    start_check(c, b);
    const ChosenStep s = choose_time_step(c, b.model, b.state);
    fmt::print("{}", to_toml(c));
    const BodyCounts n = count_bodies(b.model, b.state);
    fmt::print(
        "\n# grains {}, spheres {}, wall bodies {}, interfaces {} with {} points, parallel bonds {}, sphere bonds {}, "
        "candidate contacts {}\n",
        n.grains, n.spheres, n.walls, b.state.interfaces.size(), b.state.points.size(), b.state.parallels.size(),
        b.state.sphere_bonds.size(), b.state.pairs.size());
    fmt::print("# mean grain spacing {:.4g} m, mass {:.6g} kg\n", b.model.nominal_length,
               total_momentum(b.model, b.state).mass);
    fmt::print("# time step {:.4g} s; stability limit {:.4g} s, set by {}\n", s.dt, s.critical, s.limiter);
    for (const std::string& line : derived_lines(c, b)) fmt::print("# {}\n", line);
    if (b.experiment.quasi_static_speed > 0.0)
        fmt::print("# quasi-static speed of each wall <= {:.3g} m/s\n", b.experiment.quasi_static_speed);
    fmt::print("# memory {:.0f} MB\n", static_cast<double>(peak_memory()) / 1e6);
    const bool takes_steps = !b.experiment.pull_out || !b.experiment.pull_out->quasi_static;
    if (takes_steps && b.experiment.expected_duration > 0.0) {
        const double steps = b.experiment.expected_duration / s.dt;
        fmt::print("# about {:.0f} steps over {:.3g} s, about {:.0f} s of run time on {}\n", steps,
                   b.experiment.expected_duration, steps * seconds_per_step(b, s.dt), to_string(b.model.device));
    }
    std::fflush(stdout);
    for (const std::string& warning : plausibility_warnings(c, b, s)) fmt::print(stderr, "warning: {}\n", warning);
    return exit_code::done;
}

}  // namespace grainfrac
