-- SPDX-License-Identifier: GPL-3.0-or-later
-- door.c once more, by Lua's default call: luajit door.lua LIBRARY_OF_ONSETS SECONDS STEPS_PER_S.
local ffi, physvib = require("ffi"), require("physvib")
local onsets, seconds, rate = ffi.load(arg[1]), tonumber(arg[2]), tonumber(arg[3])
ffi.cdef [[
int door_listen(physvib_live);
void door_leave(void);
int64_t door_onset(int);
typedef struct { long s, ns; } door_time;
int clock_gettime(int, door_time*);
int clock_nanosleep(int, int, const door_time*, door_time*);
]]
local live = physvib.open("JACK:system", nil, {field_width_m = 1, field_height_m = 1})
assert(onsets.door_listen(live.name) == 0)
local name = ffi.new("physvib_world[1]")
physvib.call("world_create", nil, name)
local world = {name = name[0]} -- as physvib.attach has it, without LÖVE
function world:take(_, at_once)
    local room, events = ffi.new("physvib_event[256]"), {}
    room[0].size = ffi.sizeof("physvib_event")
    for i = 0, physvib.call("world_take", self.name, room, 256, at_once and 1 or 0) - 1 do events[#events + 1] = ffi.new("physvib_event", room[i]) end
    return events
end
physvib.call("world_set_body", world.name, 0, physvib.filled("body"))
physvib.call("world_set_body", world.name, 1, physvib.filled("body", {is_camera = 1, mass_kg = 1, frequency_hz = 1000, decay_per_s = 200}))
local contact = physvib.filled("contact", {a = 0, b = 1, x_m = 0.5, y_m = 0.5, approach_m_per_s = 3})
local due = ffi.new("door_time")
ffi.C.clock_gettime(1, due)
for step = 0, seconds * rate - 1 do
    contact.fraction = step * 37 % 100 / 100
    due.ns = due.ns + 1e9 / rate
    if due.ns >= 1e9 then due.s, due.ns = due.s + 1, due.ns - 1e9 end
    ffi.C.clock_nanosleep(1, 1, due, nil)
    physvib.call("world_begin_step", world.name, 1 / rate, 9.81)
    if step > rate / 2 and step % math.floor(rate * 0.15) == 0 then
        print(string.format("%d", live:now_ns() + contact.fraction * 1e9 / rate))
        physvib.call("world_touch", world.name, contact)
    end
    physvib.call("world_end_step", world.name)
    live:follow(world)
end
local k = 0
while onsets.door_onset(k) ~= 0 do
    print("- " .. tostring(tonumber(onsets.door_onset(k))))
    k = k + 1
end
local told = live:status()
io.stderr:write(string.format("L %.1f ms, %d played, %d late, %d xruns\n", live:latency_ns() * 1e-6, tonumber(told.played), tonumber(told.late), told.xruns))
onsets.door_leave()
live:close()
os.exit(0) -- without unloading what listens
