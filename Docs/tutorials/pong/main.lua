-- SPDX-License-Identifier: MIT
-- Pong for two: in your own controller you feel where the ball meets your paddle. Sticks, or W, S and the arrow keys.
-- love . SECONDS plays by itself for so long.
local physvib = require("physvib")
local metre, width, height, reach = 600, 960, 540, 60 -- pixels
local world, haptics, pads, ball, seconds
local paddles, time = {}, 0

local function serve(direction)
    ball:setPosition(width / 2, height / 2)
    ball:setLinearVelocity(direction * metre, 0.3 * metre)
end

local function fixture(body, shape)
    local made = love.physics.newFixture(body, shape)
    made:setRestitution(1)
    made:setFriction(0)
    return made
end

function love.load(words)
    seconds = tonumber(words[1])
    love.physics.setMeter(metre)
    world = love.physics.newWorld(0, 0)
    haptics = physvib.attach(world, {field_width_m = width / metre})
    pads = physvib.pads({count = 2, field_width_m = 2 * reach / metre, field_height_m = height / metre})
    for _, y in ipairs({-10, height + 10}) do
        fixture(love.physics.newBody(world, width / 2, y), love.physics.newRectangleShape(2 * width, 20))
    end
    ball = love.physics.newBody(world, 0, 0, "dynamic")
    ball:setBullet(true)
    fixture(ball, love.physics.newCircleShape(10))
    ball:setMass(0.05)
    for i, x in ipairs({24, width - 24}) do
        local body = love.physics.newBody(world, x, height / 2, "kinematic")
        local felt = fixture(body, love.physics.newRectangleShape(12, 2 * reach))
        local id = haptics:set(felt, {is_camera = true, frequency_hz = 120, decay_per_s = 25, static_mass_kg = 0.1})
        paddles[i] = {body = body, id = id, hits = 0, strongest = 0, up = i == 1 and "w" or "up", down = i == 1 and "s" or "down"}
    end
    serve(1)
end

-- How far a player pushes: -1 is up, 1 is down.
local function stick(paddle, joystick)
    if seconds then return (ball:getY() - paddle.body:getY()) / 20 end
    local tilt = joystick and joystick:getGamepadAxis("lefty") or 0
    local keys = (love.keyboard.isDown(paddle.down) and 1 or 0) - (love.keyboard.isDown(paddle.up) and 1 or 0)
    return keys + (math.abs(tilt) > 0.2 and tilt or 0)
end

-- Each player feels the hits of the own paddle: its upper end in the left grip, its lower end in the right grip.
local function feel()
    for _, event in ipairs(haptics:take({}, true)) do
        for i, paddle in ipairs(paddles) do
            if event.fixture == paddle.id then
                local _, y = haptics:place(paddle.body:getPosition())
                event.x_m = y - event.y_m + reach / metre
                pads:strike(i, event)
                paddle.hits = paddle.hits + 1
            end
        end
    end
    pads:rumble(love.joystick.getJoysticks())
    for i, paddle in ipairs(paddles) do
        paddle.strongest = math.max(paddle.strongest, pads.motors[i - 1].low, pads.motors[i - 1].high)
    end
end

function love.update(dt)
    dt = math.min(dt, 1 / 30)
    for i, paddle in ipairs(paddles) do
        local y, speed = paddle.body:getY(), 720 * math.max(-1, math.min(1, stick(paddle, love.joystick.getJoysticks()[i])))
        if (y < reach and speed < 0) or (y > height - reach and speed > 0) then speed = 0 end
        paddle.body:setLinearVelocity(0, speed)
    end
    haptics:update(dt) -- instead of world:update(dt)
    feel()
    local x, vx, vy = ball:getX(), ball:getLinearVelocity()
    if math.abs(vx) < metre then ball:setLinearVelocity(vx < 0 and -metre or metre, vy) end -- never slower than served
    if x < 0 or x > width then serve(x < 0 and 1 or -1) end
    time = time + dt
    if seconds and time > seconds then
        print(("%d + %d hits, strongest %.2f, %.2f"):format(paddles[1].hits, paddles[2].hits, paddles[1].strongest, paddles[2].strongest))
        love.event.quit()
    end
end

function love.draw()
    love.graphics.circle("fill", ball:getX(), ball:getY(), 10)
    for _, paddle in ipairs(paddles) do
        love.graphics.rectangle("fill", paddle.body:getX() - 6, paddle.body:getY() - reach, 12, 2 * reach)
    end
end
