-- SPDX-License-Identifier: MIT
-- What PhysVib takes from a game of LÖVE's: the same world, with and without it, in turn, so that whatever else the machine does is in both.
-- Usage: LUA_PATH="Source/Api/Lua/?.lua" PHYSVIB_LIBRARY=build/release/lib/libphysvib.so.1 love Tests/Benchmarks/love [BALLS]
local physvib = require("physvib")
local metre, dt, steps, rounds = 30, 1 / 60, 600, 15

local function room(balls, hasCallbacks)
    local world = love.physics.newWorld(0, 9.81 * metre)
    local ground = love.physics.newBody(world, 300, 600, "static")
    for _, at in ipairs({{0, 0, 600, 20}, {-310, -300, 20, 620}, {310, -300, 20, 620}}) do
        love.physics.newFixture(ground, love.physics.newRectangleShape(unpack(at)))
    end
    local first
    for i = 1, balls do
        local ball = love.physics.newFixture(love.physics.newBody(world, 30 + 97 * i % 540, 560 - 27 * math.floor(i / 20) - 9 * i % 20, "dynamic"), love.physics.newCircleShape(8 + i % 4))
        ball:setRestitution(0.6)
        first = first or ball
    end
    if hasCallbacks then -- those of a game that counts
        local count = 0
        local function counts() count = count + 1 end
        world:setCallbacks(counts, counts, counts, counts)
    end
    return world, first
end

local function seconds(balls, hasCallbacks, isFelt)
    local world, ball = room(balls, hasCallbacks)
    local update = function() world:update(dt) end
    if isFelt then
        local haptics, events = physvib.attach(world, {field_width_m = 20, field_height_m = 20}), {}
        haptics:set(ball, {frequency_hz = 200, decay_per_s = 30, is_camera = true})
        update = function() haptics:update(dt) haptics:take(events) end
    end
    collectgarbage()
    local start = love.timer.getTime()
    for _ = 1, steps do
        update()
        local push = ball:getBody()
        if push:getY() > 580 then push:applyLinearImpulse(0, -300 * push:getMass()) end
    end
    return love.timer.getTime() - start
end

local function median(list)
    table.sort(list)
    return list[math.ceil(#list / 2)]
end

function love.load(arguments)
    love.physics.setMeter(metre)
    for _, balls in ipairs(arguments[1] and {tonumber(arguments[1])} or {1, 20, 100}) do
        for _, hasCallbacks in ipairs({false, true}) do
            local ratios, plain, felt = {}, {}, {}
            for round = 1, rounds do
                local a, b
                if round % 2 == 0 then
                    a = seconds(balls, hasCallbacks, false)
                    b = seconds(balls, hasCallbacks, true)
                else
                    b = seconds(balls, hasCallbacks, true)
                    a = seconds(balls, hasCallbacks, false)
                end
                ratios[round], plain[round], felt[round] = b / a, a / steps, b / steps
            end
            local took = median(felt) - median(plain)
            print(("%3d balls, %s: %.1f us a step without, %.1f with; ratio %.2f (%.2f to %.2f); %.2f %% of a frame of 1/60 s more"):format(balls,
                hasCallbacks and "with callbacks" or "no callbacks  ", 1e6 * median(plain), 1e6 * median(felt), median(ratios), ratios[1], ratios[rounds], 100 * took / dt))
        end
    end
    love.event.quit()
end
