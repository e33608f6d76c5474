// SPDX-License-Identifier: GPL-3.0-or-later
// What the command line asked for, and the exit codes that scripts rely on.
#pragma once

#include <string>
#include <vector>

namespace grainfrac {

struct Options {
    std::string file;                    ///< input file
    std::string out;                     ///< result folder or output file; empty: from the input's stem
    std::string device = "auto";         ///< auto | cpu | cuda
    int threads = 0;                     ///< 0: all cores
    std::vector<std::string> overrides;  ///< key.path=value
    bool force = false;                  ///< replace an existing result folder
    bool allow_changes = false;          ///< resume with another input
    bool no_report = false;              ///< leave plots out
    bool quiet = false, verbose = false;
};

namespace exit_code {
inline constexpr int done = 0;
inline constexpr int failure = 1;  ///< outside the input: I/O, memory, device
inline constexpr int wrong_input = 2;
inline constexpr int unstable = 3;       ///< last good state kept
inline constexpr int interrupted = 130;  ///< SIGINT, after a checkpoint
inline constexpr int terminated = 143;   ///< SIGTERM, after a checkpoint
}  // namespace exit_code

int run_command(const Options& options);
int resume_command(const Options& options);
int generate_command(const Options& options);
int check_command(const Options& options);
int calibrate_command(const Options& options);
int schema_command();
/// `kind`: a test.kind or "calibrate".
int new_command(const Options& options, const std::string& kind);
int info_command(const std::string& folder);

}  // namespace grainfrac
