// SPDX-License-Identifier: GPL-3.0-or-later
// What run, generate and check begin with: the case from its file, with places for messages.
#pragma once

#include "app/options.h"
#include "experiment/experiment.h"
#include "model/case.h"

#include <string>
#include <vector>

namespace grainfrac {

/// InputError with its messages already written to stderr.
struct ReportedInputError {};

/// Case of the options' file with overrides; problems are printed, then ReportedInputError is thrown.
Case load_case(const Options& options);

/// build() whose InputErrors are printed with file and line.
Built build_case(const Case& c, Device device);

/// Step that the run will use: control.time_step, or safety times the bound. Throws InputError if a given step exceeds
/// the bound or if nothing bounds it.
struct ChosenStep {
    double dt = 0.0;        ///< [s]
    double critical = 0.0;  ///< [s]
    std::string limiter;
};
ChosenStep choose_time_step(const Case& c, const Model& model, const State& state);

/// Evaluate the first forces and the time step, so that input that cannot run is refused before anything is written.
void start_check(const Case& c, Built& built);

/// What is to be known of the set-up; then what the input says and hardly means, as "FILE:LINE: KEY = VALUE: message".
std::vector<std::string> plausibility_warnings(const Case& c, const Built& built, const ChosenStep& step);

/// Prints problems of an InputError.
void report(const InputError& e, const Case& c);

}  // namespace grainfrac
