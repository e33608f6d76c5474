// SPDX-License-Identifier: GPL-3.0-or-later
// The program: which command, with which options, and one place where every error becomes a message and an exit code.
#include "app/options.h"
#include "app/prepare.h"
#include "app/version.h"
#include "gpu/device.h"
#include "gpu/thread_pool.h"
#include "io/input.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <functional>
#include <new>
#include <string>
#include <thread>
#include <vector>

namespace {

using namespace grainfrac;

void add_run_options(CLI::App& command, Options& o)
{
    command.add_option("--set", o.overrides, "override a key: key.path=value, parsed as TOML; any number")
        ->allow_extra_args(false);
    command.add_option("--device", o.device, "auto, cpu or cuda")
        ->check(CLI::IsMember({"auto", "cpu", "cuda"}))
        ->capture_default_str();
    command.add_option("--threads", o.threads, "host threads; results do not depend on it (default: all cores)")
        ->check(CLI::Range(1, 4096));
    command.add_flag("-q,--quiet", o.quiet, "errors only");
    command.add_flag("-v,--verbose", o.verbose, "say more");
}

void add_case_options(CLI::App& command, Options& o)
{
    command.add_option("FILE", o.file, "input file (TOML)")->required();
    add_run_options(command, o);
}

/// `grainfrac FILE.toml` means `grainfrac run FILE.toml`.
std::vector<std::string> with_command(int argc, char** argv)
{
    std::vector<std::string> args(argv + 1, argv + argc);
    static const std::vector<std::string> commands = {"run",    "generate",  "check", "info",  "resume",
                                                      "report", "calibrate", "new",   "schema"};
    if (!args.empty() && args.front().front() != '-' &&
        std::find(commands.begin(), commands.end(), args.front()) == commands.end()) {
        args.insert(args.begin(), "run");
    }
    std::reverse(args.begin(), args.end());  // the order that CLI11's vector parse takes
    return args;
}

int guarded(const Options& o, const std::function<int()>& command)
{
    try {
        set_threads(o.threads > 0 ? o.threads : std::max(1, static_cast<int>(std::thread::hardware_concurrency())));
        return command();
    } catch (const ReportedInputError&) {
        return exit_code::wrong_input;
    } catch (const InputError& e) {
        fmt::print(stderr, "{}", render_problems(e.problems, {}, o.file));
        return exit_code::wrong_input;
    } catch (const DeviceError& e) {
        fmt::print(stderr, "error: {}\n", e.what());
        return exit_code::failure;
    } catch (const std::bad_alloc&) {
        fmt::print(stderr, "error: out of memory; use fewer grains or interface points\n");
        return exit_code::failure;
    } catch (const std::exception& e) {
        fmt::print(stderr, "error: {}\n", e.what());
        return exit_code::failure;
    }
}

}  // namespace

int main(int argc, char** argv)
{
    CLI::App app{
        "Fracture of brittle polycrystals, fibre composites and granular solids.\n"
        "`grainfrac FILE.toml` is short for `grainfrac run FILE.toml`.",
        "grainfrac"};
    app.footer("Example: grainfrac examples/brazilian/brazilian.toml --set test.platen_speed='\"10 mm/s\"'");
    app.set_version_flag("--version", std::string("grainfrac ") + GRAINFRAC_VERSION);
    app.require_subcommand(1);

    Options o;
    auto* run = app.add_subcommand("run", "simulate");
    add_case_options(*run, o);
    run->add_option("--out", o.out, "result folder (default: <stem>.out in the working directory)");
    run->add_flag("--force", o.force, "replace an existing result folder");
    run->add_flag("--no-report", o.no_report, "no plots at the end");
    run->footer("Example: grainfrac run disc.toml --threads 4 --out results/disc --force");

    auto* generate = app.add_subcommand("generate", "only make grains and spheres and write them");
    add_case_options(*generate, o);
    generate->add_option(
        "--out", o.out,
        "file to write (default: <stem>.microstructure.json for grains, <stem>.spheres.csv for spheres)");
    generate->add_flag("--force", o.force, "replace an existing file");
    generate->footer("Example: grainfrac generate microstructures/disc_187.toml");

    auto* check =
        app.add_subcommand("check", "parse, validate and build; report counts, time step, memory, run time; no run");
    add_case_options(*check, o);
    check->footer("Example: grainfrac check disc.toml");

    auto* calibrate =
        app.add_subcommand("calibrate", "find the bond parameters that give a wanted elasticity and strength");
    add_case_options(*calibrate, o);
    calibrate->add_option("--out", o.out, "result folder (default: <stem>.calibration in the working directory)");
    calibrate->add_flag("--force", o.force, "replace an existing result folder");
    calibrate->add_flag("--no-report", o.no_report, "no plot at the end");
    calibrate->footer("Example: grainfrac calibrate examples/calibrate/hcp.toml");

    std::string kind;
    auto* new_case = app.add_subcommand("new", "write a commented start file for a test, or for calibrate");
    new_case->add_option("TEST", kind, "kind of test")->required()->check(CLI::IsMember(new_case_kinds()));
    new_case->add_option("-o,--out", o.out, "file to write (default: TEST.toml)");
    new_case->add_flag("--force", o.force, "replace an existing file");
    new_case->add_flag("-q,--quiet", o.quiet, "errors only");
    new_case->footer("Example: grainfrac new brazilian -o disc.toml");

    auto* schema = app.add_subcommand("schema", "print a JSON schema of input files, for editors");
    schema->footer(
        "Example: grainfrac schema > grainfrac.schema.json; the line `#:schema ./grainfrac.schema.json` at the top of "
        "an input file tells editors with taplo (Even Better TOML) to complete and check its keys.");

    auto* info = app.add_subcommand("info", "version, build options and devices; or what a result folder holds");
    auto* resume = app.add_subcommand("resume", "go on with a run that was interrupted or killed");
    resume->add_option("DIR", o.out, "result folder")->required();
    add_run_options(*resume, o);
    resume->add_flag("--allow-changes", o.allow_changes, "go on although input.toml or --set changed the input");
    resume->add_flag("--no-report", o.no_report, "no plots at the end");
    resume->footer("Example: grainfrac resume brazilian.out");
    for (const char* later : {"report"}) {
        auto* command = app.add_subcommand(later, "not available in this version")->group("")->prefix_command();
        command->callback([later] { throw CLI::ValidationError(later, "is not available in this version"); });
    }
    std::string folder;
    info->add_option("DIR", folder, "result folder");
    info->footer("Example: grainfrac info brazilian.out");

    try {
        app.parse(with_command(argc, argv));
    } catch (const CLI::ParseError& e) {
        const int rc = app.exit(e);
        return rc == 0 ? exit_code::done : exit_code::wrong_input;
    }
    return guarded(o, [&] {
        if (*run) return run_command(o);
        if (*resume) return resume_command(o);
        if (*generate) return generate_command(o);
        if (*check) return check_command(o);
        if (*calibrate) return calibrate_command(o);
        if (*new_case) return new_command(o, kind);
        if (*schema) return schema_command();
        return info_command(folder);
    });
}
