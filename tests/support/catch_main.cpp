// SPDX-License-Identifier: GPL-3.0-or-later
// Catch's main with two options of our own: --device cpu|cuda and --threads N, so that every case runs on any back-end.
#define CATCH_CONFIG_RUNNER
#include "gpu/device.h"
#include "gpu/parallel.h"

#include <catch2/catch.hpp>

#include <string>

int main(int argc, char** argv)
{
    Catch::Session session;
    std::string device = "cpu";
    int threads = 2;
    using Catch::clara::Opt;
    session.cli(session.cli() | Opt(device, "cpu|cuda")["--device"]("device that runs the kernels") |
                Opt(threads, "N")["--threads"]("host threads"));
    if (const int rc = session.applyCommandLine(argc, argv); rc != 0) return rc;
    grainfrac::set_threads(threads);
    grainfrac::set_default_device(grainfrac::parse_device(device));
    return session.run();
}
