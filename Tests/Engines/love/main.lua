-- SPDX-License-Identifier: MIT
-- A world that was written as text, through LÖVE: as Trace.h does it for the other engines. love . WORLD, with PHYSVIB_LIBRARY and LUA_PATH.
local physvib = require("physvib")
local metre, floor_body = 30, 100
local world, haptics, ax, ay, turn, bodies, moving, platform, friction, elasticity, dt, steps

local function number(fixture, id, is_source)
    fixture:setFriction(friction)
    fixture:setRestitution(elasticity)
    haptics:set(fixture, {frequency_hz = 200, decay_per_s = 30, is_camera = is_source})
    bodies.ids[haptics:id(fixture)] = id
end

local function still() return love.physics.newBody(world, 0, 0, "static") end

local function print_motions(step)
    for _, id in ipairs(moving) do
        local body = bodies[id]
        local x, y = body:getWorldCenter()
        local vx, vy = body:getLinearVelocity()
        print(("m %d %d %.7g %.7g %.7g %.7g %.7g %.7g"):format(step, id, x / metre, -y / metre, vx / metre, -vy / metre, -body:getAngularVelocity(), -body:getAngle()))
    end
end

-- Lengths of the world's file are metres, upwards.
local make = {}
function make.world(rate, restitution, mu, seconds)
    dt, steps, friction, elasticity = 1 / rate, math.floor(rate * seconds), mu, restitution
    ax, ay, turn = 0, 0, 0
    world = love.physics.newWorld(0, 9.81 * metre, false)
    bodies, moving, platform = {ids = {}}, {}, nil
    world:setCallbacks(nil, nil, function(a, b, contact)
        if platform == nil or (a:getBody() ~= platform and b:getBody() ~= platform) then return end
        local other = a:getBody() == platform and b:getBody() or a:getBody()
        local _, vy = other:getLinearVelocity()
        if -vy > 0.01 * metre or -other:getY() < -platform:getY() + 0.05 * metre then contact:setEnabled(false) end
    end)
    haptics = physvib.attach(world, {field_height_m = 0, normalisation_s_per_m = 1, hand_mass_kg = 0})
end
function make.body(kind, id, x, y, angle, width, height, mass, vx, vy, spin, source)
    local body = love.physics.newBody(world, x * metre, -y * metre, mass > 0 and "dynamic" or "static")
    body:setAngle(-angle)
    -- Polygons have a skin of 2 slops (of 5 mm), which belongs to what is told.
    local skin = kind == "box" and 2 * 0.005 * metre * 2 or 0
    local shape = kind == "box" and love.physics.newRectangleShape(width * metre - skin, height * metre - skin) or love.physics.newCircleShape(width / 2 * metre)
    local fixture = love.physics.newFixture(body, shape, 1)
    if mass > 0 then
        fixture:setDensity(mass / body:getMass())
        body:resetMassData()
        local late = 0.5 * dt -- ends of steps lie on the exact path
        body:setLinearVelocity((vx - late * ax) * metre, -(vy - late * ay) * metre)
        body:setAngularVelocity(late * turn - spin)
        moving[#moving + 1] = id
    end
    bodies[id] = body
    number(fixture, id, source == 1)
end
function make.ball(...) make.body("ball", ...) end
function make.box(...) make.body("box", ...) end
function make.floor() number(love.physics.newFixture(still(), love.physics.newEdgeShape(-20 * metre, 0.01 * metre, 20 * metre, 0.01 * metre)), floor_body, false) end
function make.tiles(left, right, count)
    local points = {}
    for i = 0, count do
        points[#points + 1] = (left + (right - left) * i / count) * metre
        points[#points + 1] = 0.01 * metre
    end
    local chain = love.physics.newChainShape(false, points)
    chain:setPreviousVertex(points[1] - metre, points[2])
    chain:setNextVertex(points[#points - 1] + metre, points[2])
    number(love.physics.newFixture(still(), chain), floor_body, false)
end
function make.pin(a, b, x, y) love.physics.newRevoluteJoint(bodies[a], b > 0 and bodies[b] or still(), x * metre, -y * metre, false) end
function make.falling() ay = -9.81 end -- those that follow
function make.starting(...) ax, ay, turn = ... end -- the same of others
function make.oneway(id) platform = bodies[id] end

function love.load(words)
    if words[1] == "--kit" then return require("kit")() end
    love.physics.setMeter(metre)
    for line in io.lines(words[1]) do
        local word, rest, numbers = line:match("^(%S+)"), line:gsub("^%S+", ""), {}
        for each in rest:gmatch("%S+") do numbers[#numbers + 1] = tonumber(each) end
        make[word](unpack(numbers))
    end
    print_motions(0)
    for step = 1, steps do
        haptics:update(dt, 30, 3) -- as box2d.cpp
        print_motions(step)
    end
    for _, e in ipairs(haptics:take({}, true)) do
        print(("e %.9f %d %d %.7g %.7g %.7g"):format(tonumber(e.time_ns) * 1e-9, bodies.ids[e.fixture], bodies.ids[e.other] or -1, e.impulse_n_s, e.x_m, e.y_m))
    end
    love.event.quit(0)
end
