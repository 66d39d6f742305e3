-- SPDX-License-Identifier: GPL-3.0-or-later
-- A game of LÖVE's own in real time: balls fall into a room, and what one of them feels is played on a device. Writes what should
-- have been heard: the events at the times that the device was told. Usage: love FOLDER EXPECTED.raw SECONDS
local ffi = require("ffi")
local physvib = require("physvib")
local metre, rate, second = 30, 48000, 1e9

local world, live, haptics, balls, path, seconds, began
local told, clock, pushes, steps, blows = {}, 0, 0, {}, {}

function love.load(arguments)
    path, seconds = arguments[1], tonumber(arguments[2])
    love.physics.setMeter(metre)
    world = love.physics.newWorld(0, 9.81 * metre)
    local ground = love.physics.newBody(world, 300, 600, "static")
    for _, at in ipairs({{0, 0, 600, 20}, {-310, -300, 20, 620}, {310, -300, 20, 620}}) do
        love.physics.newFixture(ground, love.physics.newRectangleShape(unpack(at)))
    end
    balls = {}
    for i = 1, 12 do
        balls[i] = love.physics.newFixture(love.physics.newBody(world, 30 + 44 * i, 100 + 97 * i % 400, "dynamic"), love.physics.newCircleShape(8 + i % 4))
        balls[i]:setRestitution(0.9)
    end
    local begun = {} -- the game's own callbacks: which blows the ball takes, and in which step
    world:setCallbacks(function(_, _, contact) begun[contact] = true end, nil, nil, function(a, b, contact, impulse, _, second_impulse)
        if begun[contact] and (a == balls[1] or b == balls[1]) then blows[#blows + 1] = {step = #steps + 1, impulse = (impulse + (second_impulse or 0)) / metre} end
        begun[contact] = nil
    end)
    haptics = physvib.attach(world, {field_width_m = 20, field_height_m = 20, full_scale_impulse_n_s = physvib.automatic})
    haptics:set(balls[1], {frequency_hz = 200, decay_per_s = 30, is_camera = true})
    live = physvib.open("JACK:system", {level_db = 0, steps_per_s = 60, longest_gap_s = 0.3}, -- however busy the machine is
        {field_width_m = 20, field_height_m = 20})
    while live:now_ns() < 1.5 * second do love.timer.sleep(0.001) end -- its level comes up in a ramp
    love.timer.step()
    began = live:now_ns()
end

local last = 0
function love.update(dt)
    love.timer.sleep(math.max(0, last + 1 / 60 - love.timer.getTime())) -- as a display would make it wait
    last = love.timer.getTime()
    clock = clock + dt
    haptics:update(dt)
    steps[#steps + 1] = clock
    live:follow(haptics, told)
    local push = math.floor(clock / 0.37) -- somebody plays
    if push > pushes then
        pushes = push
        balls[1]:getBody():setLinearVelocity(push % 2 == 0 and 150 or -150, 300)
    end
    if live:now_ns() > began + seconds * second then finish() end
end

-- How many events are blows that LÖVE told of, within the step in which it told or the one before, by the game's own clock. Not those that others handed on,
-- of which it tells less.
local function ownClockAgrees(starts)
    local found = 0
    for _, event in ipairs(told) do
        local at = (tonumber(event.time_ns) - starts) / second
        for _, blow in ipairs(blows) do
            local first = steps[blow.step - 2] or 0 -- surfaces may have met in the step before
            if math.abs(event.impulse_n_s - blow.impulse) < 0.02 * blow.impulse and at > first - 1e-6 and at < steps[blow.step] + 1e-6 then found = found + 1 break end
        end
    end
    return found
end

function finish()
    local count, start = #told, tonumber(live.starts[haptics][0])
    while tonumber(live:status().played) < count do love.timer.sleep(0.005) end
    local stop = live:now_ns() + live:latency_ns() + 0.7 * second -- the last hit has rung out
    while live:now_ns() < stop do love.timer.sleep(0.005) end
    local status, latency = live:status(), live:latency_ns()
    live:close()
    local settings = physvib.rendered({field_width_m = 20, field_height_m = 20})
    local frames = math.ceil(stop / second * rate)
    local samples, mixed = ffi.new("float[?]", 4 * frames), ffi.new("float[?]", 4 * frames)
    table.sort(told, function(a, b) return a.time_ns < b.time_ns end)
    local list = ffi.new("physvib_event[?]", math.max(1, count), told)
    local file = {}
    for i, shift in ipairs({0, 417}) do -- as told, and 0.02 frame later
        for n = 0, count - 1 do list[n].time_ns = told[n + 1].time_ns + shift end
        physvib.call("render", settings, list, count, frames, samples)
        for n = 0, frames - 1 do
            for j = 0, 3 do mixed[4 * n + j] = samples[j * frames + n] end
        end
        file[i] = assert(io.open(path .. (i == 1 and "" or ".later"), "wb"))
        file[i]:write(ffi.string(mixed, 16 * frames))
        file[i]:close()
    end
    local own = ownClockAgrees(start)
    print(("%d hits in %.1f s, %d late, L %.1f ms; %d of them are blows of LÖVE's within their step"):format(count, clock, tonumber(status.late), latency * 1e-6, own))
    love.event.quit(count > 5 and status.late == 0 and own * 2 > count and 0 or 1)
    love.update = function() end
end
