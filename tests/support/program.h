// SPDX-License-Identifier: GPL-3.0-or-later
// The program run in a folder of its own, from a shell or as a child that can be killed.
#pragma once

#include "support/workplace.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <spawn.h>
#include <sstream>
#include <string>
#include <sys/wait.h>
#include <unistd.h>
#include <vector>

namespace program_test {

namespace fs = std::filesystem;

using grainfrac::test::Outcome;
using grainfrac::test::text_of;
using grainfrac::test::Workplace;

inline const std::string program = grainfrac::test::program_under_test();
inline const fs::path source = GF_SOURCE_DIR;

/// The program at work in a workplace; killed with it if it still is.
class Child {
public:
    Child(const Workplace& place, const std::vector<std::string>& arguments)
    {
        const fs::path folder = place.folder;
        std::vector<char*> argv{const_cast<char*>(program.c_str())};
        for (const std::string& a : arguments) argv.push_back(const_cast<char*>(a.c_str()));
        argv.push_back(nullptr);
        posix_spawn_file_actions_t actions;
        posix_spawn_file_actions_init(&actions);
        posix_spawn_file_actions_addchdir_np(&actions, folder.c_str());
        posix_spawn_file_actions_addopen(&actions, 0, "/dev/null", O_RDONLY, 0);
        posix_spawn_file_actions_addopen(&actions, 1, "out.txt", O_WRONLY | O_CREAT | O_TRUNC, 0666);
        posix_spawn_file_actions_addopen(&actions, 2, "err.txt", O_WRONLY | O_CREAT | O_TRUNC, 0666);
        const int failed = posix_spawn(&pid_, program.c_str(), &actions, nullptr, argv.data(), environ);
        posix_spawn_file_actions_destroy(&actions);
        REQUIRE(failed == 0);
    }
    ~Child()
    {
        if (!ended_) send(SIGKILL);
        wait();
    }
    Child(const Child&) = delete;
    Child& operator=(const Child&) = delete;

    void send(int signal) const { kill(pid_, signal); }
    bool running()
    {
        if (!ended_) ended_ = waitpid(pid_, &status_, WNOHANG) == pid_;
        return !ended_;
    }
    /// Its exit code, or 128 + the signal that killed it.
    int wait()
    {
        if (!ended_) ended_ = waitpid(pid_, &status_, 0) == pid_;
        return WIFEXITED(status_) ? WEXITSTATUS(status_) : 128 + WTERMSIG(status_);
    }

private:
    pid_t pid_ = -1;
    int status_ = 0;
    bool ended_ = false;
};

/// Four grains upon each other, 1 um apart: settled, pressed, bonded, pressed, let go, and pressed again.
inline const char* const staged_column = R"([materials.sic]
density = 3100
young_modulus = "410 GPa"
poisson_ratio = 0.17
[[parts]]
name = "column"
material = "sic"
side = "0.6 mm"
thickness = "1 mm"
gap = "1 um"
region = { shape = "box", size = ["1.1 mm", "1.3 mm", "4 mm"] }
[[bonds]]
made_in = "bonds_on"
failure = "unbreakable"
[[contacts]]
normal_stiffness = "4e14 Pa/m"
restitution = 0.5
[[walls]]
name = "top"
center = [0, 0, "2 mm"]
normal = [0, 0, -1]
size = ["3 mm", "3 mm"]
[[walls]]
name = "bottom"
center = [0, 0, "-2 mm"]
normal = [0, 0, 1]
size = ["3 mm", "3 mm"]
[[stages]]
name = "settle"
kind = "settle"
gravity = [0, 0, "-1000 m/s^2"]
rest = 0.01
duration = "1 ms"
[[stages]]
name = "compact"
kind = "compact"
move = [{ wall = "top", servo = { stress = "1 MPa", max_speed = "0.2 m/s" } }]
local_damping = 0.3
unbalanced_force_ratio = 0.01
duration = "1 ms"
[[stages]]
name = "bonds_on"
kind = "bond"
bond_distance = "0.1 um"
[[stages]]
name = "press"
move = [{ wall = "top", velocity = [0, 0, "-20 mm/s"] }]
ramp = "10 us"
stress = "50 MPa"
[[stages]]
name = "back"
kind = "unload"
ramp = "10 us"
[[stages]]
name = "again"
move = [{ wall = "top", velocity = [0, 0, "-20 mm/s"] }]
load = "20 N"
[output]
history = "0.5 us"
every = "1 ms"
)";

}  // namespace program_test
