// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/prepare.h"

#include "experiment/plausibility.h"
#include "io/input.h"
#include "motion/time_step.h"

#include <fmt/format.h>

#include <cstdio>

namespace grainfrac {

Case load_case(const Options& o)
{
    std::map<std::string, SourcePlace> places;
    try {
        return read_case(o.file, o.overrides, places);
    } catch (const InputError& e) {
        fmt::print(stderr, "{}", render_problems(e.problems, places, o.file));
        throw ReportedInputError{};
    }
}

void report(const InputError& e, const Case& c)
{
    fmt::print(stderr, "{}", render_problems(e.problems, c.places, c.file));
}

Built build_case(const Case& c, Device device)
{
    try {
        return build(c, device);
    } catch (const InputError& e) {
        report(e, c);
        throw ReportedInputError{};
    }
}

ChosenStep choose_time_step(const Case& c, const Model& model, const State& state)
{
    const TimeStepBound bound = time_step_bound(model, state);
    ChosenStep s{0.0, bound.with_damping, bound.limiter};
    if (c.control.time_step) {
        if (s.critical > 0.0 && *c.control.time_step > s.critical) {
            throw InputError("control.time_step",
                             fmt::format("must be <= {:.4g} s, the stability limit ({})", s.critical, s.limiter));
        }
        s.dt = *c.control.time_step;
    } else {
        if (!(s.critical > 0.0))
            throw InputError("control.time_step", "missing; required here, since nothing in the model bounds the step");
        s.dt = c.control.time_step_safety * s.critical;
    }
    return s;
}

std::vector<std::string> plausibility_warnings(const Case& c, const Built& built, const ChosenStep& step)
{
    std::vector<InputProblem> found = implausible_input(c);
    for (InputProblem& p : implausible_model(c, built, step.dt, step.critical)) found.push_back(std::move(p));
    std::vector<std::string> lines = built.experiment.warnings;
    const std::string_view severity = "warning: ";
    for (const InputProblem& p : found) {
        const std::string line = render_problems({p}, c.places, c.file, "warning");
        lines.push_back(line.substr(severity.size(), line.size() - severity.size() - 1));
    }
    return lines;
}

}  // namespace grainfrac
