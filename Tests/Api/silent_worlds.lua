-- SPDX-License-Identifier: MIT
-- Worlds of LÖVE from which nothing is felt, each for one reason: the explanation names it, in Lua's words. In LuaJIT alone, with bodies that
-- answer as LÖVE's do. LUA_PATH and PHYSVIB_LIBRARY are set.
local metre = 30
love = {physics = {getMeter = function() return metre end}}
local physvib = require("physvib")

local function fixture(bodies, kind, mass, state)
    local body = {getType = function() return kind end, getMass = function() return state.mass or mass end, getGravityScale = function() return 1 end,
                  getPosition = function() return 0, 0 end, getWorldCenter = function() return 0, 0 end, getAngularVelocity = function() return 0 end,
                  getAngle = function() return 0 end,
                  getLinearVelocity = function() return 0, state.speed * metre end, getLinearVelocityFromWorldPoint = function() return 0, state.speed * metre end,
                  isActive = function() return state.isActive ~= false end, isAwake = function() return state.isAwake ~= false end}
    local shape = {getType = function() return "chain" end}
    local made = {getBody = function() return body end, getShape = function() return shape end, isSensor = function() return state.isSensor == true end, isDestroyed = function() return false end,
                  getFilterData = function() return 1, state.mask or 65535, 0 end}
    body.getFixtures = function() return {made} end
    bodies[#bodies + 1] = body
    return made
end

-- A ball that meets a floor at the third update, unless `state` says otherwise; its attachment.
local function silent(settings, values, state)
    local callbacks, updates, bodies = {}, 0, {}
    state.speed = state.speed or 3
    local floor, ball = fixture(bodies, "static", 0, {speed = 0}), fixture(bodies, "dynamic", 2, state)
    local contact = {getPositions = function() return (state.x or 0.5) * metre, 0.5 * metre end, getNormal = function() return 0, state.normal or -1 end}
    local world = {getBodies = function() return bodies end, getGravity = function() return 0, (state.gravity or 9.81) * metre end}
    function world:getCallbacks() return unpack(callbacks, 1, 4) end
    function world:setCallbacks(...) callbacks = {...} end
    function world:update()
        updates = updates + 1
        if updates ~= 3 or state.misses then return end
        callbacks[1](floor, ball, contact)
        callbacks[3](floor, ball, contact)
        callbacks[4](floor, ball, contact, (state.impulse or 6) * metre, 0)
    end
    settings = settings or {}
    settings.field_height_m = settings.field_height_m or 1 -- there is no window
    local haptics = physvib.attach(world, settings)
    local told = {frequency_hz = 200, decay_per_s = 30, is_camera = true}
    for name, value in pairs(values) do told[name] = value end
    haptics:set(floor, {})
    haptics:set(ball, told)
    for _ = 1, state.updates or 4 do haptics:update(state.dt or 0.01) end
    return haptics
end

local count = 0
local function expect(said, settings, values, state, output)
    local why = silent(settings, values, state):explain(output)
    assert(why:find(said, 1, true), ("expected %q, found %q"):format(said, why))
    count = count + 1
end
local misses = {misses = true}
expect("No step has been made: make one for each step of the engine (haptics:update)", {}, {}, {updates = 0})
expect("Steps were 0 s long, so nothing moved: give haptics:update the seconds", {}, {}, {dt = 0, misses = true})
expect("seconds, not milliseconds", {}, {}, {dt = 16.7, misses = true})
expect("No contact has begun in 4 steps", {}, {}, misses)
expect("set is_camera", {}, {is_camera = false}, {})
expect("body 1 is a sensor", {}, {}, {misses = true, isSensor = true})
expect("body 1 is filtered", {}, {}, {misses = true, mask = 0})
expect("body 1 is disabled", {}, {}, {misses = true, isActive = false})
expect("body 1 is asleep", {}, {}, {misses = true, isAwake = false})
expect("set mass_kg", {}, {static_mass_kg = 2}, {mass = 0})
expect("part along the reported normal", {}, {}, {speed = 3, normal = 1, impulse = 0})
expect("slower than the threshold of 0.15 m/s (the strongest impact had", {}, {}, {speed = 0.08, impulse = 0.16})
expect("love.physics.setMeter", {}, {}, {gravity = 981, speed = 3, impulse = 6, dt = 0.02})
expect("this looks like pixels; report metres: call love.physics.setMeter", {}, {}, {x = 400})
expect("outside the field of 1 m, as it is at first: set field_width_m", {}, {}, {x = 3})
expect("outside the field of 2 m", {field_width_m = 2}, {}, {x = 3})
expect("set is_muted", {is_muted = 1}, {}, {})
expect("gain of 0", {}, {gain = 0}, {})
expect("set frequency_hz and decay_per_s", {}, {frequency_hz = 0, decay_per_s = 0}, {})
expect("No device plays the events", {}, {}, {}, {is_missing = 1})
expect("Silence is held", {}, {}, {}, {is_silent = 1})
expect("The level of the output is 0", {}, {}, {}, {level = 0})
local haptics = silent({}, {}, {})
assert(haptics:explain():find("1 event was made", 1, true))
haptics:configure({is_muted = 1})
haptics:update(0.01)
assert(haptics:explain():find("No contact has begun in 1 step", 1, true), "what is silent now")
print(count .. " silent worlds are explained")
