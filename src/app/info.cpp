// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/options.h"
#include "app/version.h"
#include "gpu/device.h"
#include "gpu/thread_pool.h"
#include "model/case.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <fstream>

namespace grainfrac {

namespace {

void print_build()
{
    fmt::print("grainfrac {}\n", GRAINFRAC_VERSION);
    fmt::print("  build     {}, {}\n", GRAINFRAC_BUILD_TYPE, GRAINFRAC_COMPILER);
    fmt::print("  threads   {}\n", threads());
#ifdef GF_HAVE_VTK
    fmt::print("  VTK       yes\n");
#else
    fmt::print("  VTK       no: ParaView files are not written\n");
#endif
    if (!built_with_cuda()) {
        fmt::print("  CUDA      no: built without a CUDA toolkit\n");
        return;
    }
    const std::vector<DeviceInfo> devices = cuda_devices();
    fmt::print("  CUDA      yes, {}\n",
               devices.empty() ? "no device found on this machine" : fmt::format("{} device(s)", devices.size()));
    for (const DeviceInfo& d : devices) {
        fmt::print("            {}: {:.1f} GiB, compute capability {}.{}\n", d.name,
                   static_cast<double>(d.memory) / 1073741824.0, d.compute_capability / 10, d.compute_capability % 10);
    }
}

int print_folder(const std::filesystem::path& folder)
{
    if (!std::filesystem::is_directory(folder))
        throw InputError("DIR", fmt::format("\"{}\" is no folder", folder.string()));
    std::ifstream in(folder / "summary.json");
    if (in) {
        const nlohmann::json summary = nlohmann::json::parse(in, nullptr, false);
        if (summary.is_discarded())
            throw std::runtime_error(fmt::format("\"{}\" is damaged", (folder / "summary.json").string()));
        fmt::print("{}\n", summary.dump(2));
    } else if (std::filesystem::exists(folder / "resolved.toml")) {
        fmt::print("{0}: a run that has not ended (no summary.json); if it is not at work: grainfrac resume {0}\n",
                   folder.string());
    } else {
        throw InputError("DIR",
                         fmt::format("\"{}\" holds no results of grainfrac (neither summary.json nor resolved.toml)",
                                     folder.string()));
    }
    return exit_code::done;
}

}  // namespace

int info_command(const std::string& folder)
{
    if (!folder.empty()) return print_folder(folder);
    print_build();
    return exit_code::done;
}

}  // namespace grainfrac
