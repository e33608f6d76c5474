// SPDX-License-Identifier: GPL-3.0-or-later
// What the user of an unstable run finds: exit code 3, cause and remedy, the culprits, and the last good state.
#include "support/program.h"

#include <catch2/catch.hpp>

using namespace program_test;

TEST_CASE("an unstable run stops, names cause and remedy, and keeps its last good state", "[program]")
{
    const Workplace w;
    REQUIRE(w.run("new drop").code == 0);
    struct Way {
        const char* change;
        const char* cause;
        const char* remedy;
    };
    for (const Way& way :
         {Way{"contacts[0].normal_stiffness='\"2e5 Pa/m\"'", "wall \"floor\" penetrate",
              "raise contacts.normal_stiffness or lower the speed"},
          Way{"parts.grains.velocity='[0, 0, \"-5000 m/s\"]'", "penetrate", "lower the speed"},
          Way{"parts.grains.angular_velocity='[0, 0, \"1e9 rad/s\"]'", "penetrate", "lower the speed"}}) {
        INFO(way.change);
        const Outcome o = w.run(std::string("run drop.toml --force -q --no-report --threads 1 --set ") + way.change);
        CHECK(o.code == 3);
        CHECK(o.err.find("unstable: ") != o.err.npos);
        CHECK(o.err.find(way.cause) != o.err.npos);
        CHECK(o.err.find(way.remedy) != o.err.npos);
        CHECK(w.summary("drop.out")["exit"]["code"] == 3);
#ifdef GF_HAVE_VTK
        const std::string culprits = text_of(w.folder / "drop.out/unstable.vtu");
        CHECK(culprits.find("body_id") != culprits.npos);
#endif
        CHECK_FALSE(fs::is_empty(w.folder / "drop.out/checkpoint"));
    }
}
