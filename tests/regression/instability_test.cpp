// SPDX-License-Identifier: GPL-3.0-or-later
// What the user of an unstable run finds: exit code 3, cause and remedy, the culprits, and the last good state.
#include "support/program.h"

#include <catch2/catch.hpp>

using namespace program_test;

TEST_CASE("an unstable run stops, names cause and remedy, and keeps its last good state", "[program]")
{
    const Workplace w;
    REQUIRE(w.run("new drop").code == 0);
    REQUIRE(w.run("new custom").code == 0);
    struct Way {
        const char* input;
        const char* change;  // one or more --set
        const char* cause;
        const char* remedy;
    };
    const char* const raise = "raise contacts.normal_stiffness or lower the speed";
    for (const Way& way :
         {Way{"drop", "contacts[0].normal_stiffness='\"2e5 Pa/m\"'", "wall \"floor\" penetrate", raise},
          Way{"drop", "parts.grains.velocity='[0, 0, \"-5000 m/s\"]'", "penetrate", "lower the speed"},
          Way{"drop", "parts.grains.velocity='[\"9000 m/s\", 0, 0]'", "wall \"sides\" penetrate", raise},
          Way{"drop", "parts.grains.angular_velocity='[0, 0, \"1e9 rad/s\"]'", "penetrate", "lower the speed"},
          Way{"drop", "control.gravity='[0, 0, \"-1e9 m/s^2\"]'", "something moves faster than", "time step"},
          Way{"custom", "control.gravity='[0, \"-1e11 m/s^2\", 0]'", "wall \"bottom\" penetrate", raise},
          Way{"custom", "stages[0].move[0].velocity='[0, \"-20000 m/s\", 0]'", "of \"bar\" penetrate", raise},
          Way{"custom",
              "contacts[0].normal_stiffness='\"1e6 Pa/m\"' --set stages[0].move[0].velocity='[0, \"-100 m/s\", 0]'",
              "wall \"top\" penetrate", raise},
          Way{"custom",
              "stages[0].move[0]='{ wall = \"top\", servo = { stress = \"1e13 Pa\", max_speed = \"1e4 m/s\" } }'",
              "wall \"top\" penetrate", raise}}) {
        const std::string input = way.input, folder = input + ".out";
        INFO(input << ": " << way.change);
        const Outcome o = w.run("run " + input + ".toml --force -q --no-report --threads 1 --set " + way.change);
        CHECK(o.code == 3);
        CHECK(o.err.find("unstable: ") != o.err.npos);
        CHECK(o.err.find(way.cause) != o.err.npos);
        CHECK(o.err.find(way.remedy) != o.err.npos);
        CHECK(w.summary(folder)["exit"]["code"] == 3);
#ifdef GF_HAVE_VTK
        const std::string culprits = text_of(w.folder / folder / "unstable.vtu");
        CHECK(culprits.find("body_id") != culprits.npos);
#endif
        CHECK_FALSE(fs::is_empty(w.folder / folder / "checkpoint"));
    }
}
