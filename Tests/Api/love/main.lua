-- SPDX-License-Identifier: MIT
-- A game of LÖVE's own: twenty balls fall into a room, twice, with PhysVib and without. Their motion is the same to the bit, callbacks are
-- called as often, and what is felt is what LÖVE's own callbacks say. With PHYSVIB_LIBRARY, and physvib.lua in LUA_PATH.
local physvib = require("physvib")
local metre, dt, steps = 30, 1 / 60, 600

local function room()
    local world = love.physics.newWorld(0, 9.81 * metre)
    local made = {world = world, balls = {}, calls = {0, 0, 0, 0}, blows = {}, step = 0}
    local ground = love.physics.newBody(world, 300, 600, "static")
    for _, at in ipairs({{0, 0, 600, 20}, {-310, -300, 20, 620}, {310, -300, 20, 620}}) do
        love.physics.newFixture(ground, love.physics.newRectangleShape(unpack(at)))
    end
    for i = 1, 20 do
        local ball = love.physics.newFixture(love.physics.newBody(world, 30 + 27 * i, 100 + 97 * i % 400, "dynamic"), love.physics.newCircleShape(8 + i % 4))
        ball:setRestitution(0.6)
        made.balls[i] = ball
    end
    return made
end

local function counter(made, i, more)
    return function(a, b, contact, ...)
        made.calls[i] = made.calls[i] + 1
        if more then more(a, b, contact, ...) end
    end
end

-- The impulses of what begins with a ball, as LÖVE tells them.
local function listen(made)
    local begun = {}
    made.world:setCallbacks(counter(made, 1, function(_, _, contact) begun[contact] = true end), counter(made, 2), counter(made, 3),
        counter(made, 4, function(a, b, contact, impulse, _, second)
            if begun[contact] and (a == made.balls[1] or b == made.balls[1]) then made.blows[#made.blows + 1] = {made.step, (impulse + (second or 0)) / metre} end
            begun[contact] = nil
        end))
end

local function fail(what, ...)
    print(what:format(...))
    love.event.quit(1)
    error(what:format(...))
end

-- How often a block that hangs is felt when it has been changed and falls by 0.3 m.
function changed(change)
    local metre = love.physics.getMeter()
    local world = love.physics.newWorld(0, 9.81 * metre, true)
    local haptics = physvib.attach(world, {field_width_m = 20, field_height_m = 20})
    love.physics.newFixture(love.physics.newBody(world, 0, 20.5 * metre, "static"), love.physics.newRectangleShape(3000, metre))
    local body = love.physics.newBody(world, 0, 19.6 * metre, "static")
    haptics:set(love.physics.newFixture(body, love.physics.newCircleShape(0.1 * metre), 10), {frequency_hz = 200, decay_per_s = 30, is_camera = true})
    haptics:update(1 / 60)
    change(body)
    for _ = 1, 60 do haptics:update(1 / 60) end
    return #haptics:take({}, true)
end

-- A ball onto a floor at many heights: how far the onset is from where its surface, on its straight way within a step, meets the floor's.
function onset()
    local worst, skin = 0, 0.01 * metre -- of the floor, as of every polygon of Box2D
    for height = 50, 400, 7 do
        local world = love.physics.newWorld(0, 9.81 * metre)
        local floor = love.physics.newFixture(love.physics.newBody(world, 300, 590, "static"), love.physics.newRectangleShape(600, 20))
        local ball = love.physics.newFixture(love.physics.newBody(world, 300, 570 - height, "dynamic"), love.physics.newCircleShape(10))
        local haptics = physvib.attach(world, {field_width_m = 20, field_height_m = 20, normalisation_s_per_m = 1, hand_mass_kg = 0})
        haptics:set(ball, {frequency_hz = 200, decay_per_s = 30, is_camera = true})
        local events, meets = {}, nil
        for step = 0, 150 do
            local _, speed = ball:getBody():getLinearVelocity()
            local gap, down = 570 - skin - ball:getBody():getY(), speed + 9.81 * metre * dt
            if not meets and gap < down * dt then meets = step * dt + gap / down end
            haptics:update(dt)
        end
        haptics:take(events, true)
        worst = math.max(worst, math.abs(tonumber(events[1].time_ns) * 1e-9 - meets))
    end
    return worst
end

-- A pole of 2 m that stands, is pushed over, and whose body is destroyed then without a word: events, and the impulse of its head by that of a rigid
-- pole that holds at its foot, m/3 of the head's speed.
function pole()
    local world = love.physics.newWorld(0, 9.81 * metre)
    local floor = love.physics.newFixture(love.physics.newBody(world, 300, 600, "static"), love.physics.newRectangleShape(600, 20))
    local body = love.physics.newBody(world, 300, 560, "dynamic") -- its foot at 590
    local stick = love.physics.newFixture(body, love.physics.newRectangleShape(3, 2 * metre), 1)
    stick:setFriction(1) floor:setFriction(1)
    local haptics = physvib.attach(world, {field_width_m = 20, field_height_m = 20, normalisation_s_per_m = 1, hand_mass_kg = 0})
    haptics:set(stick, {frequency_hz = 200, decay_per_s = 30, is_camera = true})
    for _ = 1, 30 do haptics:update(dt) end
    body:setAngularVelocity(0.6)
    body:setLinearVelocity(0.6 * metre, 0) -- about its foot
    local standing, fastest, mass = #haptics:take({}, true), 0, body:getMass()
    for _ = 1, 300 do
        haptics:update(dt)
        fastest = math.max(fastest, math.abs(body:getAngularVelocity()))
    end
    local events, hardest = haptics:take({}, true), 0
    for _, event in ipairs(events) do hardest = math.max(hardest, event.impulse_n_s) end
    body:destroy()
    for _ = 1, 3 do haptics:update(dt) end
    if haptics.ids[stick] or next(haptics.starts) then error("a body that was destroyed is still known") end
    return standing, #events, hardest / (mass / 3 * 2 * fastest)
end

-- A ball that may not touch: its attachment says why.
function silent(state, hinder)
    local world = love.physics.newWorld(0, 9.81 * metre)
    love.physics.newFixture(love.physics.newBody(world, 300, 590, "static"), love.physics.newRectangleShape(600, 20))
    local ball = love.physics.newFixture(love.physics.newBody(world, 300, 300, "dynamic"), love.physics.newCircleShape(10))
    local haptics = physvib.attach(world, {field_width_m = 20, field_height_m = 20})
    haptics:set(ball, {frequency_hz = 200, decay_per_s = 30, is_camera = true})
    hinder(ball)
    for _ = 1, 5 do haptics:update(dt) end
    local why = haptics:explain()
    if not why:find("body 0 is " .. state, 1, true) then fail("expected %s, found %s", state, why) end
end

-- Twenty worlds of a game that destroys bodies and fixtures, and sets and removes sources, between steps and within its callbacks.
function meddle(seed)
    math.randomseed(seed)
    local made, gone = room(), {}
    local haptics
    local function within(a, b)
        local fixture = math.random() < 0.5 and a or b
        local body, chance = fixture:getBody(), math.random()
        if body:getType() == "static" or gone[body] or gone[fixture] then return end
        if chance < 0.02 then gone[body] = true body:destroy()
        elseif chance < 0.03 then gone[fixture] = true fixture:destroy()
        elseif chance < 0.2 then haptics:set(fixture, {frequency_hz = 100, decay_per_s = 30, is_camera = chance < 0.15})
        elseif chance < 0.3 then haptics:remove(fixture) end
    end
    made.world:setCallbacks(within, nil, within, within)
    haptics = physvib.attach(made.world, {field_width_m = 20, field_height_m = 20, normalisation_s_per_m = 1, hand_mass_kg = 0})
    local events = 0
    for _ = 1, 300 do
        haptics:update(dt)
        events = events + #haptics:take({})
        local body = love.physics.newBody(made.world, math.random(30, 570), math.random(100, 400), "dynamic")
        for i = 1, math.random(2) do
            local fixture = love.physics.newFixture(body, i == 1 and love.physics.newCircleShape(8) or love.physics.newRectangleShape(20, 10))
            haptics:set(fixture, {frequency_hz = 200, decay_per_s = 30, is_camera = math.random() < 0.5})
        end
        local all = made.world:getBodies()
        local one = all[math.random(#all)]
        if #all > 20 and one:getType() ~= "static" then gone[one] = true one:destroy() end
    end
    return events + #haptics:take({}, true)
end

function love.load()
    love.physics.setMeter(metre)
    local plain, felt = room(), room()
    listen(plain)
    listen(felt)
    local haptics = physvib.attach(felt.world, {field_width_m = 20, field_height_m = 20, normalisation_s_per_m = 1, hand_mass_kg = 0})
    haptics:set(felt.balls[1], {frequency_hz = 200, decay_per_s = 30, is_camera = true})
    local events = {}
    for step = 1, steps do
        plain.step, felt.step = step, step
        if step == 300 then listen(plain) listen(felt) end -- the game sets others
        plain.world:update(dt)
        haptics:update(dt)
        haptics:take(events)
        for i = 1, 20 do
            local x, y = plain.balls[i]:getBody():getPosition()
            local u, v = felt.balls[i]:getBody():getPosition()
            if x ~= u or y ~= v then fail("step %d, ball %d: the motion is another one", step, i) end
        end
    end
    haptics:take(events, true)
    for i = 1, 4 do
        if plain.calls[i] ~= felt.calls[i] or plain.calls[i] == 0 then fail("callback %d: %d calls without, %d with", i, plain.calls[i], felt.calls[i]) end
    end

    -- Each event that was no chain's: its impulse is that of a blow that LÖVE told, whose surfaces met in that step or in the one before.
    local found, heard = 0, 0
    for _, blow in ipairs(felt.blows) do
        if blow[2] > 0.5 * felt.balls[1]:getBody():getMass() then
            heard = heard + 1
            for _, event in ipairs(events) do
                local at = tonumber(event.time_ns) * 1e-9 / dt
                if math.abs(event.impulse_n_s - blow[2]) < 1e-4 * blow[2] and at > blow[1] - 2.01 and at < blow[1] + 0.01 then found = found + 1 break end
            end
        end
    end
    silent("a sensor", function(ball) ball:setSensor(true) end)
    silent("filtered", function(ball) ball:setFilterData(1, 0, 0) end)
    silent("disabled", function(ball) ball:getBody():setActive(false) end)
    silent("asleep", function(ball) ball:getBody():setAwake(false) end)
    for seed = 1, 20 do
        local is_fine, found = pcall(meddle, seed)
        if not is_fine or found == 0 then fail("game %d that meddles: %s", seed, tostring(found)) end
    end
    for what, change in pairs {["let go"] = function(body) body:setType("dynamic") end, lighter = function(body) body:setType("dynamic") body:setMass(0.05 * body:getMass()) end} do
        if changed(change) ~= 1 then fail("%s: it lands once", what) end
    end
    local worst = onset()
    print(("onset %.3f ms from the pencil's"):format(1000 * worst))
    if worst > 0.0002 then fail("expected 0.2 ms") end
    print(("%d events, %d of %d hard blows of LÖVE's among them; %d begins, %d solved"):format(#events, found, heard, felt.calls[1], felt.calls[4]))
    if heard < 3 or found ~= heard then fail("expected all blows") end
    local standing, toppled, part = pole()
    print(("pole: %d events while it stands, %d when it topples, %.2f of a rigid one's"):format(standing, toppled, part))
    if standing > 0 or toppled == 0 or math.abs(part - 1) > 0.2 then fail("expected the pole's head") end
    love.event.quit(0)
end
