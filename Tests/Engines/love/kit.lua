-- SPDX-License-Identifier: MIT
-- LÖVE in the hands of the kit, as Kit.h has it for the other engines: lines in, answers that begin with > out.
local physvib = require("physvib")
local metre = 30
local world, haptics, bodies, ids, made, elasticity, friction = nil, nil, {}, {}, {}, 0, 0
local types = {[0] = "static", "kinematic", "dynamic"}

local function answer(...) io.write("> ", table.concat({...}, " "), "\n") io.flush() end

local function number(id, is_source)
    local fixture = bodies[id]:getFixtures()[1]
    haptics:set(fixture, {frequency_hz = 200, decay_per_s = 30, is_camera = is_source})
    ids[haptics:id(fixture)] = id
end

local verbs = {}
function verbs.type(body, x, _, _, id)
    body:setType(types[x])
    if x == 2 then body:getFixtures()[1]:setDensity(made[id].kg / made[id].area) body:resetMassData() end
end
function verbs.put(body, x, y) body:setPosition(x * metre, -y * metre) end
function verbs.fling(body, x, y, z) body:setLinearVelocity(x * metre, -y * metre) body:setAngularVelocity(-z) end
verbs.moves = verbs.fling
function verbs.mass(body, kg)
    local x, y, mass, inertia = body:getMassData()
    body:setMassData(x, y, kg, inertia * kg / mass)
end
function verbs.lockTurn(body) body:setFixedRotation(true) end
function verbs.gravityScale(body, scale) body:setGravityScale(scale) end
function verbs.remove(body) haptics:remove(body:getFixtures()[1]) body:destroy() end
function verbs.sensor(body, is) body:getFixtures()[1]:setSensor(is ~= 0) end
function verbs.enable(body, is) body:setActive(is ~= 0) end
function verbs.passes(body, is) body:getFixtures()[1]:setFilterData(1, is ~= 0 and 0 or 65535, 0) end
function verbs.sleep(body) body:setSleepingAllowed(true) body:setAwake(false) end

local calls = {}
function calls.world(g, e, mu)
    world, elasticity, friction = love.physics.newWorld(0, g * metre, true), e, mu
    haptics = physvib.attach(world, {field_height_m = 0, full_scale_impulse_n_s = 1})
end
function calls.body(id, is_box, x, y, angle, width, height, kg, vx, vy, spin, type, lock, sensor, bullet)
    local body = love.physics.newBody(world, x * metre, -y * metre, types[type])
    local skin = is_box == 1 and 2 * 0.005 * metre * 2 or 0 -- of polygons: 2 slops of 5 mm, which belongs to what is told
    local shape = is_box == 1 and love.physics.newRectangleShape(width * metre - skin, height * metre - skin) or love.physics.newCircleShape(width / 2 * metre)
    body:setAngle(-angle)
    body:setBullet(bullet == 1)
    body:setFixedRotation(lock == 1)
    bodies[id] = body
    local fixture = love.physics.newFixture(body, shape, 1)
    fixture:setFriction(friction)
    fixture:setRestitution(elasticity)
    fixture:setSensor(sensor == 1)
    local _, _, unit = shape:computeMass(1)
    made[id] = {kg = kg, area = unit}
    if type == 2 then fixture:setDensity(kg / unit) body:resetMassData() end
    if type > 0 then verbs.fling(body, vx, vy, spin) end
    number(id, false)
end
function calls.feel(id) number(id, true) end
function calls.step(seconds) haptics:update(seconds, 30, 10) end
function calls.get(id)
    local body = bodies[id]
    local x, y = body:getWorldCenter()
    local vx, vy = body:getLinearVelocity()
    answer(("%.12g %.12g %.12g %.12g %.12g %.12g"):format(x / metre, -y / metre, vx / metre, -vy / metre, -body:getAngle(), -body:getAngularVelocity()))
end
function calls.take()
    local words = {}
    for _, e in ipairs(haptics:take({}, true)) do words[#words + 1] = ("%d %d %.12g %d"):format(tonumber(e.time_ns), ids[e.fixture], e.impulse_n_s, e.kind) end
    answer(unpack(words))
end
function calls.explain() answer(haptics:explain()) end
function calls.pin(a, b, x, y) love.physics.newRevoluteJoint(bodies[a], bodies[b], x * metre, -y * metre, false) end
function calls.gravity(_, y) world:setGravity(0, y * metre) end

return function()
    love.physics.setMeter(metre)
    local names = {"gravity"}
    for name in pairs(verbs) do names[#names + 1] = name end
    answer(unpack(names))
    for line in io.lines() do
        local word, numbers = line:match("^(%S+)"), {}
        for each in line:gsub("^%S+", ""):gmatch("%S+") do numbers[#numbers + 1] = tonumber(each) or 0 / 0 end
        if calls[word] then calls[word](unpack(numbers)) else verbs[word](bodies[numbers[1]], numbers[2], numbers[3], numbers[4], numbers[1]) end
    end
    love.event.quit(0)
end
