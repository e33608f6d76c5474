// SPDX-License-Identifier: GPL-3.0-or-later
// The input that a run began with, kept in its checkpoints: what a run that goes on is built from, and compared with.
#pragma once

#include "gpu/device.h"
#include "model/case.h"

#include <cstdint>
#include <string>
#include <vector>

namespace grainfrac {

struct RunOrigin {
    std::string file;                    ///< input file, absolute: files that it names are searched beside it
    std::string resolved;                ///< resolved.toml
    std::vector<std::string> overrides;  ///< of the command line
    std::vector<std::string> files;      ///< that the input names, absolute
    std::vector<std::uint64_t> checksums;
    std::string device;

    template <class Visit>
    void for_each_member(Visit&& visit)
    {
        auto& [a, b, c, d, e, f] = *this;
        visit("file", a);
        visit("resolved", b);
        visit("overrides", c);
        visit("files", d);
        visit("checksums", e);
        visit("device", f);
    }
};

/// `resolved`: resolved.toml of the case. Throws std::runtime_error for a file that the input names and that is not
/// there.
RunOrigin origin_of(const Case& c, const std::vector<std::string>& overrides, const std::string& resolved,
                    Device device);

/// A key whose value is another one.
struct InputChange {
    std::string key, before, now;  ///< values as in resolved.toml, "" if it is not there
    bool in_course = false;        ///< it can change in the course of a run: nothing that was built depends on it
};
/// What differs between two inputs, files by their contents.
std::vector<InputChange> changes(const RunOrigin& before, const RunOrigin& now);

}  // namespace grainfrac
