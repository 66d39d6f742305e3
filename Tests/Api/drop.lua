-- SPDX-License-Identifier: MIT
-- The Lua file by LuaJIT alone: a world that answers as LÖVE's does, in pixels. LUA_PATH and PHYSVIB_LIBRARY are set; arg[1]: the sound.
local metre, world, floor, ball = 30, {}, {}, {}
love = {physics = {getMeter = function() return metre end}}

local function fixture(kind, mass, motion)
    local body = {getType = function() return kind end, getMass = function() return mass end, getGravityScale = function() return 1 end,
                  getPosition = function() return 0.3 * metre, -(motion.height or 0) * metre end,
                  getWorldCenter = function() return 0.3 * metre, -(motion.height or 0) * metre end, getAngularVelocity = function() return 0 end, getAngle = function() return 0 end,
                  getWorldPoint = function() return 0.3 * metre, -(motion.height or 0) * metre end,
                  getLinearVelocity = function() return 0, motion.speed * metre end,
                  getLinearVelocityFromWorldPoint = function() return 0, motion.speed * metre end, isActive = function() return true end, isAwake = function() return true end}
    local shape = {getType = function() return motion.height and "circle" or "chain" end, getRadius = function() return 0 end, getPoint = function() return 0, 0 end}
    return {getBody = function() return body end, getShape = function() return shape end, isSensor = function() return false end, isDestroyed = function() return false end}
end
local falling = {speed = 0, height = 0.8} -- downwards, as LÖVE counts
floor, ball = fixture("static", 0, {speed = 0}), fixture("dynamic", 0.2, falling)

local contact = {getPositions = function() return 0.3 * metre, -falling.height / 2 * metre end, getNormal = function() return 0, -1 end} -- from floor to ball
local callbacks, isTouching = {}, false
function world:getCallbacks() return unpack(callbacks, 1, 4) end
function world:setCallbacks(...) callbacks = {...} end
function world:getBodies() return {} end
function world:getGravity() return 0, 9.81 * metre end
function world:update(dt)
    falling.speed = falling.speed + 9.81 * dt
    local touches = falling.height <= 0
    if touches and not isTouching then callbacks[1](floor, ball, contact) end
    if isTouching and not touches then callbacks[2](floor, ball, contact) end
    isTouching = touches
    if touches then
        callbacks[3](floor, ball, contact)
        local before = falling.speed
        if before > 0 then falling.speed = -0.7 * before end
        callbacks[4](floor, ball, contact, 0.2 * (before - falling.speed) * metre, 0)
    end
    falling.height = falling.height - falling.speed * dt
end

local theirs = 0
world:setCallbacks(function() theirs = theirs + 1 end)
local physvib = require("physvib")
assert(select(2, pcall(physvib.attach, world, {})):find("field_height_m: expected"), "a height, as there is no window")
local haptics = physvib.attach(world, {field_height_m = 2, normalisation_s_per_m = 0.1, hand_mass_kg = 0})
local id = haptics:set(ball, {frequency_hz = 200, decay_per_s = 30, is_camera = true})
for _ = 1, 100 do haptics:update(0.01) end
local events = haptics:take({}, true)

local speed = math.sqrt(2 * 9.81 * 0.8)
assert(#events > 0, "nothing was felt")
assert(events[1].fixture == id and theirs > 0, "its callbacks were not called")
assert(math.abs(tonumber(events[1].time_ns) * 1e-9 - 0.399) < 0.002, "onset " .. tonumber(events[1].time_ns))
assert(math.abs(events[1].impulse_n_s - 0.2 * 1.7 * speed) < 0.05 * 0.2 * 1.7 * speed, "impulse " .. events[1].impulse_n_s)
assert(math.abs(events[1].x_m - 0.3) < 1e-6 and math.abs(events[1].y_m - 2) < 0.02, "place " .. events[1].x_m .. ", " .. events[1].y_m)

local later = 0
world:setCallbacks(nil, nil, nil, function() later = later + 1 end) -- others, while it is attached
for _ = 1, 100 do haptics:update(0.01) end
assert(later > 0 and #haptics:take({}, true) > 0, "callbacks that were set later")
-- what a callback is about may be gone: a fixture, a body, or both
local lost = fixture("dynamic", 1, {speed = 0})
lost.getBody = function() return nil end
for _, pair in ipairs {{nil, ball}, {floor, nil}, {lost, ball}, {floor, lost}} do
    for i = 1, 4 do callbacks[i](pair[1], pair[2], contact, 1, 0) end
end
assert(not pcall(physvib.call, "world_end_step", haptics.name), "an error is one of Lua")
assert(haptics:counts().events >= #events and haptics:drops() == 0, "counts")
assert(haptics:explain():find("event"), haptics:explain())
haptics:configure({is_muted = 1})
for _ = 1, 300 do haptics:update(0.01) end
assert(#haptics:take({}, true) == 0, "muted")
-- Gain by itself: the hardest hit is half of full scale. What falls in the first second settles.
haptics:configure({full_scale_impulse_n_s = physvib.automatic})
falling.height, falling.speed = 0.8, 0
for _ = 1, 100 do haptics:update(0.01) end
local hardest = 0
for _, event in ipairs(haptics:take({}, true)) do hardest = math.max(hardest, event.amplitude) end
assert(math.abs(hardest - 0.5) < 1e-9, "automatic: " .. hardest)
haptics:configure({settling_s = 1000})
falling.height, falling.speed = 0.8, 0
for _ = 1, 100 do haptics:update(0.01) end
assert(#haptics:take({}, true) == 0, "settling")
-- Materials and single impacts by name.
assert(#physvib.materials() >= 3 and physvib.material("steel plate", {is_camera = true}).frequency_hz == 430)
local impact = physvib.impact {x_m = 0.1, y_m = 0.2, strength = 0.3, material = "wooden board"}
assert(impact.frequency_hz == 349 and impact.amplitude == 0.3 and impact.x_m == 0.1, "impact")
local is_fine, why = pcall(physvib.impact, {material = "jam"})
assert(not is_fine and why:find('found "jam"', 1, true), why)
-- A hit at the top of the window, where LÖVE's y is 0, is felt at the upper two of four, A and B; also where places have LÖVE's y.
local ffi = require("ffi")
local still = {getCallbacks = function() end, setCallbacks = function() end}
local function felt_at_top(height)
    local x, y = physvib.attach(still, {field_height_m = height}):place(0.5 * metre, 0)
    local top = ffi.new("physvib_event", {frequency_hz = 200, decay_per_s = 30, amplitude = 0.5, x_m = x, y_m = y, fixture = -1, other = -1})
    physvib.save_wav(arg[1], {top}, 0.1, {field_width_m = 1, field_height_m = 1})
    local file = assert(io.open(arg[1], "rb"))
    local samples = file:read("*a"):match("data....(.*)")
    file:close()
    local peaks, felt = {0, 0, 0, 0}, ffi.cast("const float *", samples)
    for i = 0, #samples / 4 - 1 do peaks[i % 4 + 1] = math.max(peaks[i % 4 + 1], math.abs(felt[i])) end
    assert(peaks[1] > 0.1 and peaks[2] > 0.1 and peaks[3] < 1e-6 and peaks[4] < 1e-6, "upside down: " .. table.concat(peaks, " "))
    return y
end
assert(felt_at_top(1) == 1, "y upwards")
physvib.y_down = true
assert(felt_at_top(nil) == 0, "LÖVE's y")
physvib.y_down = false

-- Two controllers: the second one's left grip feels what hits at the left. Commands are sent when they change, and every 0.1 s.
local now, sent = 100, {}
local function joystick(pad)
    return {setVibration = function(_, low, high, seconds) sent[#sent + 1] = {pad = pad, low = low, high = high, seconds = seconds} end}
end
local pads, joysticks = physvib.pads({count = 2, field_width_m = 1, field_height_m = 1, clock = function() return now end}), {joystick(1), joystick(2)}
pads:rumble(joysticks)
assert(#sent == 0, "at rest")
pads:strike(2, ffi.new("physvib_event", {frequency_hz = 90, decay_per_s = 5, amplitude = 1, x_m = 0, fixture = -1, other = -1}))
for _ = 1, 60 do
    now = now + 1 / 60
    pads:rumble(joysticks)
end
assert(#sent > 3 and #sent < 40 and sent[1].pad == 2 and sent[1].low > 0.5 and sent[3].low > sent[3].high and sent[1].seconds == 0.2, "controller 2, left")
pads:stop()
now = now + 1
pads:rumble(joysticks)
assert(sent[#sent].low == 0 and sent[#sent].high == 0, "stopped")
haptics:configure({})
for _ = 1, 500 do haptics:update(0.01) end
isTouching, falling.height, falling.speed = false, 0.8, 0
for _ = 1, 100 do haptics:update(0.01) end
assert(pads:follow(haptics, 1) > 0, "a world's events")
now = now + 1 / 60
assert(pads:pull()[0].high > 0.3 and pads:pull()[1].high == 0, "controller 1 alone")
assert(select(2, pcall(physvib.pads, {clock = os.clock})):find("field: expected"), "a field")
physvib.save_wav(arg[1], events, 1.5, {field_width_m = 1, field_height_m = 1})
print(#events .. " hits, the first at " .. tonumber(events[1].time_ns) * 1e-9 .. " s: " .. arg[1])
