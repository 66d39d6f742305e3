-- SPDX-License-Identifier: MIT
-- Worlds of LÖVE's own in real time on a device that plays for nobody: two worlds at once, slow motion, a pause, a level that is loaded again. Hits
-- keep the distances that they have in their world. With LUA_PATH, PHYSVIB_LIBRARY and PHYSVIB_LIVE_LIBRARY.
local physvib = require("physvib")
local metre, second, gap = 100, 1e9, 0.3 -- however busy the machine is

local function fail(what, ...)
    print(what:format(...))
    os.exit(1)
end

-- A ball that is thrown up again when it has landed, about every `period` seconds.
local function level(period)
    love.physics.setMeter(metre)
    local made = {world = love.physics.newWorld(0, 9.81 * metre), events = {}}
    love.physics.newFixture(love.physics.newBody(made.world, 300, 590, "static"), love.physics.newRectangleShape(600, 20))
    local body = love.physics.newBody(made.world, 300, 570, "dynamic")
    local ball = love.physics.newFixture(body, love.physics.newCircleShape(10))
    made.haptics = physvib.attach(made.world, {field_width_m = 6, field_height_m = 6})
    made.haptics:set(ball, {frequency_hz = 200, decay_per_s = 30, is_camera = true})
    made.own = {} -- the times that its hits have in the world
    made.haptics.take = function(self, list, at_once)
        local taken = getmetatable(self).take(self, list, at_once)
        for _, event in ipairs(taken) do made.own[#made.own + 1] = event.time_ns end
        return taken
    end
    made.throw = function()
        local _, vy = body:getLinearVelocity()
        if body:getY() > 567 and math.abs(vy) < 1 then body:setLinearVelocity(0, -0.5 * 9.81 * metre * period) end
    end
    return made
end

local live = physvib.open("None:no device", {level_db = -40, longest_gap_s = gap}, {field_width_m = 6, field_height_m = 6})
while live:now_ns() < 0.4 * second do love.timer.sleep(0.001) end

-- Plays levels for so many seconds, as 60 frames a second do; `speed` of their time.
local function play(seconds, levels, speed)
    local begin, last = love.timer.getTime(), love.timer.getTime()
    while love.timer.getTime() < begin + seconds do
        love.timer.sleep(1 / 60)
        local now = love.timer.getTime()
        for _, each in ipairs(levels) do
            each.throw()
            each.haptics:update((now - last) * (speed or 1))
            live:follow(each.haptics, each.events)
        end
        last = now
    end
end

-- The distances of hits after the first `from`, s.
local function distances(each, from)
    local found = {}
    for i = from + 2, #each.events do found[#found + 1] = tonumber(each.events[i].time_ns - each.events[i - 1].time_ns) / second end
    return found
end
local function expect_all(name, found, low, high, count)
    if #found < count then fail("%s: %d distances, expected %d", name, #found, count) end
    for i, distance in ipairs(found) do
        if distance < low or distance > high then fail("%s: distance %d is %.3f s, expected %.3f to %.3f", name, i, distance, low, high) end
    end
    print(("%s: %d distances of %.3f to %.3f s"):format(name, #found, math.min(unpack(found)), math.max(unpack(found))))
end

-- Two worlds, the second one 0.8 s younger, further apart than the longest gap. A landing and a throw fall on frames.
local first, young = level(0.25), level(0.2)
play(0.8, {first})
play(1.5, {first, young})
expect_all("first world", distances(first, 0), 0.22, 0.32, 4)
expect_all("younger world", distances(young, 0), 0.17, 0.27, 4)
for name, each in pairs({["first world"] = first, ["younger world"] = young}) do
    for i = 2, #each.events do
        local shift = (each.events[i].time_ns - each.own[i]) - (each.events[1].time_ns - each.own[1])
        if shift ~= 0 then fail("%s: hit %d is %.3f ms out of its rhythm", name, i, tonumber(shift) / 1e6) end
    end
end

-- Slow motion: whoever follows lags by 0.25 s a hit and is aligned again when that is more than the gap, so of two distances in
-- succession one at least is longer by it; the other keeps the rhythm of the world.
local before = #first.events
play(2, {first}, 0.5)
local slow = distances(first, before)
expect_all("slow motion", slow, 0.22, 0.64 + gap, 2)
for i = 2, #slow do
    if slow[i - 1] + slow[i] < 2 * 0.22 + gap then fail("slow motion: distances %d and %d are %.3f and %.3f s", i - 1, i, slow[i - 1], slow[i]) end
end

-- A pause is no update. What was to be felt before it is over, and the next hit comes in its time after it.
before = #first.events
local pause_end = live:now_ns() + 0.7 * second
while live:now_ns() < pause_end do love.timer.sleep(0.001) end
play(1.2, {first})
if tonumber(first.events[before + 2].time_ns) < pause_end - gap * second then fail("a hit within the pause") end
expect_all("after a pause", distances(first, before + 1), 0.22, 0.32, 2)

-- A level that is loaded again is another world, at time 0; the old one may be destroyed.
first.world:destroy()
first = nil
collectgarbage()
local again, reload = level(0.25), live:now_ns()
play(1.2, {again})
if tonumber(again.events[1].time_ns) < reload then fail("a hit before its level") end
expect_all("loaded again", distances(again, 0), 0.22, 0.32, 3)
if live:status().late > 0 then fail("%d late", tonumber(live:status().late)) end
live:close()
os.exit(0)
