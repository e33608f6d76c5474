// SPDX-License-Identifier: GPL-3.0-or-later
// Every key of the input file, told once: name, member, unit, allowed values, meaning, source. Defaults are those of
// the structs in model/case.h. The reader, the writer of resolved.toml and the generator of docs/input.md walk these
// descriptions with a visitor V:
//   v("key", member, Facts{...})        a value
//   v.table("key", member, Facts{...})  a sub-table
//   v.array("key", vector, Facts{...})  an array of tables, [[key]]
//   v.named("key", vector, Facts{...})  tables with names, [key.NAME]
// A new key is a member in case.h and a line in one of these files.
#pragma once

#include "io/input_schema_bonds.h"
#include "io/input_schema_materials.h"
#include "io/input_schema_parts.h"
#include "io/input_schema_test.h"
#include "io/input_schema_walls.h"
#include "model/case.h"

namespace grainfrac {

template <class V>
void describe(V& v, ControlSpec& s)
{
    v("time_step_safety", s.time_step_safety, {.range = share_above_0, .meaning = "share of the critical time step"});
    v("time_step", s.time_step,
      {.unit = "s",
       .range = positive,
       .unset = "`time_step_safety` of the critical one",
       .meaning = "a fixed time step"});
    v("local_damping", s.local_damping,
      {.range = share_below_1,
       .meaning = "alpha of the local non-viscous damping; not for dynamic tests",
       .source = "Cundall 1987"});
    v("gravity", s.gravity, {.unit = "m/s^2", .meaning = "acceleration of gravity"});
    v("skin", s.skin,
      {.unit = "m",
       .range = positive,
       .unset = "chosen from the grain size",
       .meaning = "reach of the neighbour list beyond contact; speed only, not results"});
}

template <class V>
void describe(V& v, OutputSpec& s)
{
    v("every", s.every,
      {.unit = "s",
       .range = positive,
       .unset = "a twentieth of the expected run, or `snapshots`",
       .meaning = "simulated time between snapshots"});
    v("snapshots", s.snapshots,
      {.range = {1.0, 1e6},
       .unset = "`every`",
       .meaning = "or their number; needs `test.stop.time` or a stage with a duration"});
    v("history", s.history,
      {.unit = "s",
       .range = positive,
       .unset = "1/2000 of the expected run, or 100 steps",
       .meaning = "simulated time between rows of history.csv"});
    v("checkpoint", s.checkpoint,
      {.unit = "s", .range = not_negative, .meaning = "wall time between checkpoints; 0: none by time"});
    v("checkpoint_steps", s.checkpoint_steps,
      {.range = {1.0, 1e12},
       .unset = "by wall time only",
       .meaning = "most steps between checkpoints, besides `checkpoint`"});
    v("contacts", s.contacts, {.meaning = "write paraview/contacts.pvd"});
}

template <class V>
void describe(V& v, Case& c)
{
    v.table("simulation", c.simulation, {.meaning = "what the run is called and where its random numbers start"});
    v.named("materials", c.materials, {.meaning = "materials, each with a name of its own"});
    v.array("parts", c.parts, {.required = always, .meaning = "what is simulated; at least one"});
    v.array("bonds", c.bonds, {.meaning = "what holds grains together; without an entry that fits, they are loose"});
    v.array("contacts", c.contacts, {.meaning = "how grains push on each other and on walls"});
    v.array("walls", c.walls, {.meaning = "rigid bodies with a prescribed motion"});
    v.array("grips", c.grips,
            {.meaning = "bodies of a part that are held or driven, each set a wall of its own; test `custom`"});
    v.array("stages", c.stages,
            {.meaning = "test `custom`: one after the other, each until the first of its end conditions"});
    v.array("calibration", c.calibration,
            {.meaning = "for `grainfrac calibrate`: a part and the elasticity and strength that it is to have; `run` "
                        "leaves it aside"});
    v.table("test", c.test, {.meaning = "a ready-made experiment: places platens, loads, measures"});
    v.table("control", c.control, {.meaning = "time step, damping, gravity"});
    v.table("output", c.output, {.meaning = "what is written and how often"});
}

}  // namespace grainfrac
