-- SPDX-License-Identifier: MIT
-- A pinball whose cabinet has four exciters: what the ball strikes is felt where it is. Left and right arrow: flippers.
-- love . [DEVICE [SECONDS]]: plays on "JACK:system" or another device; with SECONDS by itself for so long.
local physvib = require("physvib")
local metre, width, height = 70, 392, 770 -- pixels
-- Box2D likes bodies of 0.1 to 10 m, so the table is ten times as large as a real one of 0.56 x 1.1 m, and so is what pulls the ball: gravity along
-- a table that is tilted by 6.5 degrees.
local gravity = 10 * 9.81 * math.sin(math.rad(6.5)) * metre
local world, haptics, live, table_body, ball, seconds
local flippers, lines, bumpers, time, events, balls = {}, {}, {}, 0, {}, 0

local function part(body, shape, restitution, values)
    local fixture = love.physics.newFixture(body, shape, 2.3) -- a flipper has 0.3 kg
    fixture:setRestitution(restitution)
    values.is_camera, values.static_mass_kg = true, 0.3 -- the cabinet's share that moves with it
    haptics:set(fixture, values)
    return fixture
end

local function line(...)
    lines[#lines + 1] = {...}
    part(table_body, love.physics.newEdgeShape(...), 0.4, {frequency_hz = 60, decay_per_s = 25})
end

local function bumper(x, y)
    bumpers[#bumpers + 1] = {x, y}
    part(table_body, love.physics.newCircleShape(x, y, 26), 1.2, {frequency_hz = 150, decay_per_s = 40})
end

local function flipper(x, direction, key)
    local body = love.physics.newBody(world, x, 660, "dynamic")
    body:setGravityScale(0)
    part(body, love.physics.newRectangleShape(32 * direction, 0, 64, 10), 0.3, {frequency_hz = 90, decay_per_s = 30})
    local joint = love.physics.newRevoluteJoint(table_body, body, x, 660, false)
    local down, up = 0.45 * direction, -0.5 * direction
    joint:setLimits(math.min(down, up), math.max(down, up))
    joint:setLimitsEnabled(true)
    joint:setMaxMotorTorque(1e6)
    joint:setMotorEnabled(true)
    flippers[#flippers + 1] = {body = body, joint = joint, direction = direction, key = key}
end

local function serve()
    balls = balls + 1
    ball:setPosition(width - 30, 60)
    ball:setLinearVelocity(-3 * metre - 40 * (balls % 7), 0)
end

function love.load(words)
    seconds = tonumber(words[2])
    love.physics.setMeter(metre)
    world = love.physics.newWorld(0, gravity)
    haptics = physvib.attach(world, {field_width_m = width / metre, drive_gain = 2})
    local layout = physvib.filled("renderer_settings").layout
    physvib.call("layout_preset", "cabinet4", layout)
    live = physvib.open(words[1] or "JACK:system", {steps_per_s = 60, longest_gap_s = 0.05},
        {field_width_m = width / metre, field_height_m = height / metre, layout = layout})
    table_body = love.physics.newBody(world, 0, 0)
    line(0, height, 0, 0)
    line(0, 0, width, 0)
    line(width, 0, width, height)
    line(0, 560, 112, 655)
    line(width, 560, width - 112, 655)
    for _, place in ipairs({{110, 200}, {270, 170}, {190, 330}}) do bumper(unpack(place)) end
    flipper(116, 1, "left")
    flipper(width - 116, -1, "right")
    ball = love.physics.newBody(world, 0, 0, "dynamic")
    ball:setBullet(true)
    love.physics.newFixture(ball, love.physics.newCircleShape(9.5)):setRestitution(0.3)
    ball:setMass(0.08)
    serve()
end

function love.update(dt)
    for _, each in ipairs(flippers) do
        local isUp = love.keyboard.isDown(each.key)
        if seconds then isUp = ball:getY() > 630 end
        each.joint:setMotorSpeed((isUp and -25 or 12) * each.direction)
    end
    haptics:update(math.min(dt, 1 / 30)) -- instead of world:update(dt)
    live:follow(haptics, events)
    if ball:getY() > height + 20 then serve() end
    time = time + dt
    if seconds and time > seconds then
        print(("%d impacts, %d balls, %d late"):format(#events, balls, tonumber(live:status().late)))
        live:close()
        love.event.quit()
    end
end

function love.draw()
    for _, each in ipairs(lines) do love.graphics.line(unpack(each)) end
    for _, each in ipairs(bumpers) do love.graphics.circle("line", each[1], each[2], 26) end
    for _, each in ipairs(flippers) do love.graphics.polygon("fill", each.body:getWorldPoints(each.body:getFixtures()[1]:getShape():getPoints())) end
    love.graphics.circle("fill", ball:getX(), ball:getY(), 9.5)
end
