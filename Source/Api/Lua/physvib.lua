-- SPDX-License-Identifier: MIT
-- PhysVib for LÖVE and LuaJIT: one file beside your main.lua, and libphysvib.so.1 where the system finds it (or PHYSVIB_LIBRARY).
--
--     local haptics = require("physvib").attach(world, {field_width_m = 24})
--     haptics:set(ball_fixture, {frequency_hz = 200, decay_per_s = 30, is_camera = true})
--     function love.update(dt) haptics:update(dt) end       -- instead of world:update(dt)
--
-- Lengths of LÖVE are pixels: love.physics.getMeter() of them are a metre. Numbers of this file are SI, as their names say. LÖVE's y points
-- down; places of events have y upwards from the lower edge of the field, as everywhere in PhysVib (physvib.y_down = true: as LÖVE's).
local ffi = require("ffi")
ffi.cdef [[
typedef struct physvib_renderer_name *physvib_renderer;
typedef struct physvib_world_name *physvib_world;
typedef struct physvib_pads_name *physvib_pads;
typedef struct { int64_t time_ns, duration_ns; double frequency_hz, decay_per_s, amplitude, x_m, y_m, impulse_n_s, mass_kg; int fixture, other, kind, sound; double z_m; int part, unused; } physvib_event;
typedef struct { double extent_width_m, extent_height_m, x_m[64], y_m[64]; int count; double z_m[64]; int part[64]; } physvib_layout;
typedef struct { size_t size; int rate_hz, channels, law, limiter; double exponent, field_width_m, field_height_m; physvib_layout layout; } physvib_renderer_settings;
typedef struct { size_t size; int live_modes, pending; int64_t frames, played, late, rejected, refused; } physvib_renderer_status;
typedef struct { size_t size; int is_muted, hits_per_step, at_body, drops_hits_of_removed; double field_width_m, field_x_m, field_y_m, field_radians,
    normalisation_s_per_m, hand_mass_kg, drive_gain, threshold_m_per_s, full_scale_impulse_n_s, settling_s; } physvib_world_settings;
typedef struct { size_t size; int is_camera, voice, surface; double mass_kg, inertia_kg_m2, gravity_scale, frequency_hz, decay_per_s, static_mass_kg, gain,
    hand_mass_kg, overtone_hz[3], overtone_decay_per_s[3], overtone_amplitude[3], grain_m, roughness, rolling; int is_ridged, device, part, unused; } physvib_body;
typedef struct { size_t size; int a, b; double x_m, y_m, normal_x, normal_y, impulse_n_s, tangential_n_s, approach_m_per_s, restitution, effective_mass_kg,
    fraction, gap_m, gap_fraction, along_a_m_per_s, along_b_m_per_s; int is_soft, unused, point_id, is_impulse_of_pair;
    double z_m, normal_z, friction_x_n_s, friction_y_n_s, friction_z_n_s; } physvib_contact;
typedef struct { size_t size; int64_t contacts, below_threshold, no_source, unplayable, muted, dropped, events; double threshold_m_per_s; } physvib_world_counts;
typedef struct { size_t size; int is_missing, is_silent, channels, unused; double level; int64_t muted_channels, late, dropped, rejected; const char *silent_by, *trouble;
    const physvib_renderer_settings *renderer; int64_t without_part; } physvib_output_facts;
const char *physvib_version(void);
const char *physvib_error(void);
int physvib_renderer_settings_init(physvib_renderer_settings *, size_t);
int physvib_world_settings_init(physvib_world_settings *, size_t);
int physvib_body_init(physvib_body *, size_t);
int physvib_contact_init(physvib_contact *, size_t);
int physvib_world_counts_init(physvib_world_counts *, size_t);
const char *physvib_law_name(int);
int physvib_renderer_status_init(physvib_renderer_status *, size_t);
int physvib_layout_preset(const char *, physvib_layout *);
int physvib_layout_load(const char *, physvib_layout *);
int physvib_layout_parse(const char *, physvib_layout *);
int physvib_layout_save(const char *, const char *, const physvib_layout *);
int64_t physvib_events_load(const char *, physvib_event *, int64_t);
int64_t physvib_events_parse(const char *, physvib_event *, int64_t);
int physvib_events_load_field(const char *, double *, double *);
int physvib_events_parse_field(const char *, double *, double *);
int physvib_events_save(const char *, const physvib_event *, int64_t);
int physvib_events_save_field(const char *, const physvib_event *, int64_t, double, double);
int physvib_wav_save(const char *, const float *, int, int64_t, int);
int physvib_render(const physvib_renderer_settings *, const physvib_event *, int64_t, int64_t, float *);
int physvib_renderer_create(const physvib_renderer_settings *, physvib_renderer *);
int physvib_renderer_free(physvib_renderer);
int physvib_renderer_strike(physvib_renderer, const physvib_event *);
const char *physvib_material_name(int);
int physvib_material(const char *, physvib_body *);
int physvib_material_load(const char *, const char *, physvib_body *);
int physvib_sound(const char *);
int physvib_part(const char *);
int physvib_event_of(const char *, double, double, double, physvib_event *);
int physvib_renderer_impact(physvib_renderer, double, double, double);
int physvib_renderer_impact_of(physvib_renderer, const char *, double, double, double);
int physvib_renderer_pull(physvib_renderer, float *const *, int, int);
int physvib_renderer_pull_interleaved(physvib_renderer, float *, int, int);
int physvib_renderer_set_gain(physvib_renderer, int64_t, int, double);
int physvib_renderer_set_mute(physvib_renderer, int64_t, int, int);
int physvib_renderer_set_level(physvib_renderer, int64_t, double);
int physvib_renderer_set_layout(physvib_renderer, int64_t, const physvib_renderer_settings *);
int physvib_renderer_latency_frames(physvib_renderer);
int physvib_renderer_get_status(physvib_renderer, physvib_renderer_status *);
int64_t physvib_play_out_ns(int, int, int, double);
int physvib_renderer_silence(physvib_renderer, int64_t, int64_t);
int physvib_world_create(const physvib_world_settings *, physvib_world *);
int physvib_world_free(physvib_world);
int physvib_world_configure(physvib_world, const physvib_world_settings *);
int physvib_world_set_body(physvib_world, int, const physvib_body *);
int physvib_world_remove_body(physvib_world, int);
int physvib_world_move(physvib_world, int, double, double, double, double, double);
int physvib_world_moved(physvib_world, int, double, double, double);
int physvib_world_move_in_space(physvib_world, int, const double *, const double *, const double *, const double *);
int physvib_world_moved_in_space(physvib_world, int, const double *, const double *);
int physvib_world_pair(physvib_world, int, int, double, double, double);
int physvib_world_begin_step(physvib_world, double, double);
int physvib_world_touch(physvib_world, const physvib_contact *);
int physvib_world_begin(physvib_world, const physvib_contact *);
int physvib_world_push(physvib_world, const physvib_contact *);
int physvib_world_end(physvib_world, int, int);
int physvib_world_end_step(physvib_world);
int64_t physvib_world_time_ns(physvib_world);
int64_t physvib_world_take(physvib_world, physvib_event *, int64_t, int);
int64_t physvib_world_send(physvib_world, physvib_renderer, int64_t, int);
int64_t physvib_world_drops(physvib_world);
int64_t physvib_world_thinned(physvib_world);
int physvib_world_get_counts(physvib_world, physvib_world_counts *);
int physvib_world_device(physvib_world, int);
int physvib_world_explain(physvib_world, char *, size_t);
int physvib_output_facts_init(physvib_output_facts *, size_t);
int physvib_world_explain_output(physvib_world, const physvib_output_facts *, char *, size_t);
int physvib_renderer_explain(physvib_renderer, physvib_world, char *, size_t);
int physvib_world_note(physvib_world, int, int);
typedef struct { double low, high; } physvib_motors;
int physvib_pads_create(int, double, double, const char *, physvib_pads *);
int physvib_pads_free(physvib_pads);
int physvib_pads_strike(physvib_pads, int, const physvib_event *);
int64_t physvib_pads_send(physvib_pads, int, physvib_world, int64_t, int);
int physvib_pads_pull(physvib_pads, int64_t, physvib_motors *, int);
int physvib_pads_stop(physvib_pads);
int physvib_pads_set_level(physvib_pads, double);

typedef struct physvib_live_name *physvib_live;
typedef struct { size_t size; int rate_hz, block_frames, steps_per_s; double longest_gap_s, level_db; char save[1024]; int first_output, unused; } physvib_live_settings;
typedef struct { size_t size; char name[256], about[256]; int kind, channels; } physvib_device;
typedef struct { size_t size; int is_running, is_silent, rate_hz, block_frames, live_modes, losses, xruns; double load, worst_load;
    int64_t played, late, rejected; char trouble[256]; int board, unused; int64_t board_sent, board_lost; } physvib_live_status;
const char *physvib_live_error(void);
int physvib_live_settings_init(physvib_live_settings *, size_t);
int physvib_live_status_init(physvib_live_status *, size_t);
int physvib_live_devices(physvib_device *, int, size_t);
int physvib_live_open(const char *, const physvib_renderer_settings *, const physvib_live_settings *, physvib_live *);
int physvib_live_close(physvib_live);
int64_t physvib_live_now_ns(physvib_live);
int64_t physvib_live_latency_ns(physvib_live);
int physvib_live_strike(physvib_live, const physvib_event *, int64_t);
int physvib_live_impact(physvib_live, double, double, double);
int physvib_live_impact_of(physvib_live, const char *, double, double, double);
int physvib_live_align(physvib_live, physvib_world, int64_t *);
int64_t physvib_live_send_each(const physvib_live *, int, physvib_world, int64_t *);
int physvib_live_set_gain(physvib_live, int, double);
int physvib_live_set_mute(physvib_live, int, int);
int physvib_live_set_layout(physvib_live, const physvib_renderer_settings *);
int physvib_live_set_level(physvib_live, double);
int physvib_live_silence(physvib_live, int);
int physvib_live_get_status(physvib_live, physvib_live_status *);
int physvib_live_explain(physvib_live, physvib_world, char *, size_t);
]]
local library = os.getenv("PHYSVIB_LIBRARY") or "libphysvib.so.1"
local c = ffi.load(library)
local physvib = {c = c, automatic = -1, -- of full_scale_impulse_n_s: learned from the hits, see Docs/gain.md
    version = ffi.string(c.physvib_version())}

-- `name(...)` of a library: a code or a count; of an error, a Lua error of one line.
local function caller(from, prefix)
    return function(name, ...)
        local result = tonumber(from[prefix .. name](...))
        if result < 0 then error("physvib: " .. ffi.string(from[prefix .. "error"]()), 2) end
        return result
    end
end
local call = caller(c, "physvib_")
physvib.call = call

-- A structure as its init has it, and the values given.
local function filled(kind, values, from)
    local made = ffi.new("physvib_" .. kind)
    if (from or c)["physvib_" .. kind .. "_init"](made, ffi.sizeof(made)) < 0 then error("physvib.lua and its library differ in version", 2) end
    for name, value in pairs(values or {}) do made[name] = value end
    return made
end
physvib.filled = filled

-- Settings of a renderer for a world's events. Under physvib.y_down its layout is turned over, so that the top of the window is felt at the
-- upper actuators either way. Set y_down once, before attach and open.
physvib.y_down = false
function physvib.rendered(values)
    local made = filled("renderer_settings", values)
    local layout = made.layout
    for j = 0, physvib.y_down and layout.count - 1 or -1 do layout.y_m[j] = layout.extent_height_m - layout.y_m[j] end
    return made
end

-- How a body of that material vibrates, as `set` takes it; `path`: of a file of materials, else a built-in one. `values` are added to it:
-- haptics:set(fixture, physvib.material("steel plate", {is_camera = true})).
function physvib.material(name, values, path)
    local body = filled("body")
    if path then call("material_load", path, name, body) else call("material", name, body) end
    local made = {}
    for _, field in ipairs {"frequency_hz", "decay_per_s", "grain_m", "roughness", "rolling", "is_ridged"} do made[field] = body[field] end
    for field, value in pairs(values or {}) do made[field] = value end
    return made
end

-- The names of the built-in materials that vibrate.
function physvib.materials()
    local names = {}
    while c.physvib_material_name(#names) ~= nil do names[#names + 1] = ffi.string(c.physvib_material_name(#names)) end
    return names
end

-- One impact as an event at time 0: {x_m = 0.3, y_m = 0.5, strength = 0.8, material = "wooden board"}.
function physvib.impact(hit)
    local event = ffi.new("physvib_event")
    call("event_of", hit.material, hit.x_m or 0, hit.y_m or 0, hit.strength or 0.5, event)
    return event
end

-- Events (a Lua list of physvib_event) to a sound file: 48 kHz, a channel per enchanter.
function physvib.save_wav(path, events, seconds, settings)
    local chosen, frames = physvib.rendered(settings), math.floor(seconds * 48000)
    local list = ffi.new("physvib_event[?]", math.max(1, #events), events)
    local samples = ffi.new("float[?]", frames * chosen.layout.count)
    call("render", chosen, list, #events, frames, samples)
    call("wav_save", path, samples, chosen.layout.count, frames, chosen.rate_hz)
end

local Attachment = {}
Attachment.__index = Attachment

-- `world`: a love.physics world. Its callbacks go on being called: those that are there, and those set later. `settings` of
-- physvib_world_settings, and field_height_m: the y (in metres) at which LÖVE's world ends below; without it that of the window.
function physvib.attach(world, settings)
    local self = setmetatable({world = world, metre = love.physics.getMeter(), ids = {}, next = 0, touching = {}, starts = {}, last_dt = 0}, Attachment)
    local name = ffi.new("physvib_world[1]")
    call("world_create", self:taken(settings), name)
    self.name = ffi.gc(name[0], c.physvib_world_free)
    self.contact = filled("contact")
    self:listen()
    return self
end

-- The settings of the library; the field's height is this file's.
function Attachment:taken(settings)
    local theirs = {}
    for key, value in pairs(settings or {}) do theirs[key] = value end
    local window = love.graphics and love.graphics.getHeight() / self.metre or 0
    local height = theirs.field_height_m or self.height or (window > 0 and window)
    if not (physvib.y_down or height) then error("physvib: field_height_m: expected the field's height in metres, as there is no window", 3) end
    self.height, theirs.field_height_m = height, nil
    self.up = physvib.y_down and 1 or -1
    return filled("world_settings", theirs)
end

-- LÖVE's place as that of an event: metres, y upwards.
function Attachment:place(x, y)
    return x / self.metre, (self.up < 0 and self.height or 0) + self.up * y / self.metre
end

-- A fixture's values: frequency_hz, decay_per_s, is_camera..., see physvib_body; mass_kg is its body's.
function Attachment:set(fixture, values)
    local id = self:id(fixture)
    self:tell(fixture, id, values)
    self.starts[fixture] = values.is_camera and (self.starts[fixture] or {}) or nil -- in a callback: where its step began
    return id
end

-- The device on which a fixture is felt: `device` of its values, 0 at first.
function Attachment:device_of(fixture) return c.physvib_world_device(self.name, self:id(fixture)) end

-- The number of a fixture in events.
function Attachment:id(fixture)
    if not self.ids[fixture] then
        self.ids[fixture], self.next = self.next, self.next + 1
        self:tell(fixture, self.ids[fixture], {})
    end
    return self.ids[fixture]
end

function Attachment:tell(fixture, id, values)
    local body = fixture:getBody()
    local known = filled("body", values)
    known.mass_kg = body:getType() == "dynamic" and body:getMass() or 0
    known.gravity_scale = body:getGravityScale()
    call("world_set_body", self.name, id, known)
end

-- A fixture that is to be felt no more; in a callback: from the end of the step on. One that is destroyed, alone or with its body, need not be named.
function Attachment:remove(fixture)
    if self.leaving then self.leaving[#self.leaving + 1] = fixture return end
    if self.ids[fixture] then call("world_remove_body", self.name, self.ids[fixture]) end
    self.ids[fixture], self.starts[fixture] = nil, nil
end

-- How far a point of a camera has come in this step, pixels along the normal: where Box2D stops what is fast at what it strikes, that tells when.
function Attachment:way(fixture, px, py, nx, ny)
    local start = self.starts[fixture]
    if not (start and start.x) then return 0 end -- made a camera in this step
    local body = fixture:getBody()
    local x, y = body:getPosition()
    local turned = body:getAngle() - start.angle
    local c, s, rx, ry = math.cos(turned), math.sin(turned), px - x, py - y
    return (px - start.x - c * rx - s * ry) * nx + (py - start.y + s * rx - c * ry) * ny
end

function Attachment:listen()
    local theirs = {self.world:getCallbacks()}
    local function thenTheirs(i, ours)
        return function(...)
            ours(...)
            if theirs[i] then theirs[i](...) end
        end
    end
    self.ours = {
        thenTheirs(1, function(a, b, contact) self:begin(a, b, contact) end),
        thenTheirs(2, function(a, b) self:finish(a, b) end),
        thenTheirs(3, function(a, b, contact) self:look(a, b, contact) end),
        thenTheirs(4, function(a, b, contact, ...) self:push(a, b, contact, ...) end),
    }
    self.world:setCallbacks(unpack(self.ours))
end

local least_speed = 0.02 -- m/s; slower points are no impacts, and nobody asks when they met
-- A callback may be about what another one destroyed: its fixture or its body is nil then, or may not be asked.
local function are_there(a, b)
    if not (a and b) or a.isDestroyed and (a:isDestroyed() or b:isDestroyed()) then return false end
    return a:getBody() and b:getBody() and true or false
end
local function pair(a, b) return a < b and a * 1048576 + b or b * 1048576 + a end

function Attachment:begin(a, b, contact)
    if not are_there(a, b) or a:isSensor() or b:isSensor() then return end
    local key = pair(self:id(a), self:id(b))
    local touch = self.touching[key] or {count = 0}
    touch.count, touch.is_new = touch.count + 1, true
    self.touching[key] = touch
end

function Attachment:finish(a, b)
    if not (self.ids[a] and self.ids[b]) then return end
    local key = pair(self.ids[a], self.ids[b])
    local touch = self.touching[key]
    if not touch then return end
    touch.count = touch.count - 1
    if touch.count > 0 then return end
    self.touching[key] = nil
    if touch.is_told then call("world_end", self.name, self.ids[a], self.ids[b]) end
end

-- Where a fixture's surface lies at a point, pixels along the normal; nil for a chain. `side`: 1 if the normal leaves the fixture, -1 if not.
local function surface(fixture, x, y, nx, ny, side)
    local shape, body = fixture:getShape(), fixture:getBody()
    local kind = shape:getType()
    if kind == "chain" then return nil end
    if kind == "circle" then
        local cx, cy = body:getWorldPoint(shape:getPoint())
        return cx * nx + cy * ny + side * shape:getRadius()
    end
    local points, t, best, nearest = {body:getWorldPoints(shape:getPoints())}, x * ny - y * nx, nil, math.huge
    local px, py = points[#points - 1], points[#points]
    for i = 1, #points, 2 do -- each side of it, at its place that is nearest to the point along the surface
        local qx, qy = points[i], points[i + 1]
        local from, to = px * ny - py * nx, qx * ny - qy * nx
        local share = from ~= to and math.max(0, math.min(1, (t - from) / (to - from))) or 0
        local off, height = math.abs(from + share * (to - from) - t), (px + share * (qx - px)) * nx + (py + share * (qy - py)) * ny
        if off < nearest - 1e-3 or (off < nearest + 1e-3 and side * height > side * best) then best, nearest = height, math.min(off, nearest) end
        px, py = qx, qy
    end
    return best + side * shape:getRadius()
end

-- How deep the surfaces overlap at a point of a contact, pixels. LÖVE gives the middle between them, and that is half of it.
local function overlap(a, b, x, y, nx, ny)
    local ofA, ofB = surface(a, x, y, nx, ny, 1), surface(b, x, y, nx, ny, -1)
    if ofA and ofB then return ofA - ofB end
    local middle = x * nx + y * ny
    return 2 * (ofA and ofA - middle or ofB and middle - ofB or 0)
end

-- Before the solver: how fast the bodies near each other at each of the (one or two) points where they meet, and when they met there, in steps
-- from the start of this one. What overlaps at its start met in the step before.
function Attachment:look(a, b, contact)
    if not are_there(a, b) then return end
    local touch = self.touching[pair(self:id(a), self:id(b))]
    if not (touch and (touch.is_new or self.starts[a] or self.starts[b])) then return end
    local nx, ny = contact:getNormal()
    local xs = {contact:getPositions()}
    touch.approach, touch.fraction = {}, {}
    for i = 1, #xs, 2 do
        local x, y = xs[i], xs[i + 1]
        local ax, ay = a:getBody():getLinearVelocityFromWorldPoint(x, y)
        local bx, by = b:getBody():getLinearVelocityFromWorldPoint(x, y)
        local speed, fraction = (ax - bx) * nx + (ay - by) * ny, 0
        if speed > least_speed * self.metre and self.dt > 0 then
            local longest = math.max(self.dt, self.last_dt)
            local seconds = math.max(0, math.min(self.dt, (self:way(a, x, y, nx, ny) - self:way(b, x, y, nx, ny)) / speed)) -
                math.max(0, math.min(longest, overlap(a, b, x, y, nx, ny) / speed))
            fraction = math.max(-1, seconds / (seconds < 0 and self.last_dt > 0 and self.last_dt or self.dt))
        end
        touch.approach[#touch.approach + 1], touch.fraction[#touch.fraction + 1] = speed / self.metre, fraction
    end
    self:move(a)
    self:move(b)
end

-- How far points may slide in a step.
function Attachment:move(fixture)
    local body = fixture:getBody()
    if body:getType() == "static" then return end
    local x, y = self:place(body:getWorldCenter())
    local vx, vy = body:getLinearVelocity()
    call("world_move", self.name, self.ids[fixture], x, y, vx / self.metre, self.up * vy / self.metre, self.up * body:getAngularVelocity())
end

-- LÖVE tells impulses in kg pixels/s: one or two points, normal and tangential. A point that was not there in the step before is a blow if it
-- nears fast, also of bodies that touch already (a pole that topples).
function Attachment:push(a, b, contact, n1, t1, n2, t2)
    if not are_there(a, b) then return end
    local ia, ib = self:id(a), self:id(b)
    local touch = self.touching[pair(ia, ib)]
    local x, y, x2, y2 = contact:getPositions()
    if not (touch and x) then return end
    local told = self.contact
    told.a, told.b = ia, ib
    local nx, ny = contact:getNormal()
    told.normal_x, told.normal_y = nx, self.up * ny
    -- LÖVE's tangent is its normal turned by a quarter to the right, PhysVib's to the left; upwards these are the same.
    told.point_id = -2 -- by place
    for i = 1, x2 and 2 or 1 do
        told.x_m, told.y_m = self:place(i == 1 and x or x2, i == 1 and y or y2)
        told.impulse_n_s, told.tangential_n_s = (i == 1 and n1 or n2 or 0) / self.metre, -self.up * (i == 1 and t1 or t2 or 0) / self.metre
        told.approach_m_per_s = touch.approach and touch.approach[i] or -1e300
        told.fraction = touch.fraction and touch.fraction[i] or -1e300
        call(touch.is_new and "world_begin" or "world_push", self.name, told)
    end
    touch.is_new, touch.is_told, touch.approach, touch.fraction = false, true, nil, nil
end

-- What a fixture was is forgotten when it has been destroyed, with its body too: a few are looked at in each step, cameras always.
function Attachment:sweep()
    for fixture in pairs(self.starts) do
        if fixture.isDestroyed and fixture:isDestroyed() then self:remove(fixture) end
    end
    for _ = 1, 32 do
        if self.looked and self.ids[self.looked] == nil then self.looked = nil end
        local fixture = next(self.ids, self.looked)
        self.looked = fixture
        if not fixture then break end
        if fixture.isDestroyed and fixture:isDestroyed() then self:remove(fixture) end
    end
end

-- world:update(dt, ...), with its numbers of iterations if they are given, and what is felt of it.
function Attachment:update(dt, ...)
    local now = {self.world:getCallbacks()}
    for i = 1, 4 do
        if now[i] ~= self.ours[i] then self:listen() break end -- the game has set others
    end
    self:sweep()
    for fixture, start in pairs(self.starts) do
        local body = fixture:getBody()
        if body then
            start.x, start.y = body:getPosition()
            start.angle = body:getAngle()
        end
    end
    self.dt = dt
    local gx, gy = self.world:getGravity()
    call("world_begin_step", self.name, dt, math.sqrt(gx * gx + gy * gy) / self.metre)
    self.leaving = {}
    self.world:update(dt, ...)
    call("world_end_step", self.name)
    local leaving = self.leaving
    self.leaving, self.last_dt = nil, dt
    for _, fixture in ipairs(leaving) do self:remove(fixture) end
end

-- Its settings from the next step on (is_muted, drive_gain...): all of them, those that are not given as at first.
function Attachment:configure(settings) call("world_configure", self.name, self:taken(settings)) end
-- How two kinds of surfaces (`surface` of their values, above 0) sound together.
function Attachment:pair(surface, other, frequency_hz, decay_per_s, gain) call("world_pair", self.name, surface, other, frequency_hz, decay_per_s, gain or 1) end
-- Hits lost so far because more came in a step than there is room for; grains left out, their power being in the others.
function Attachment:drops() return call("world_drops", self.name) end
function Attachment:thinned() return call("world_thinned", self.name) end
-- What became of all contacts so far: contacts, below_threshold, no_source, unplayable, muted, dropped, events, threshold_m_per_s.
function Attachment:counts()
    local told = filled("world_counts")
    call("world_get_counts", self.name, told)
    return told
end

-- An explanation with the names of this file: `explain(...)` writes the C functions'.
local ours = {{"physvib_world_begin_step and physvib_world_end_step", "haptics:update"}, {"physvib_world_begin_step", "haptics:update"}, {"physvib_world_set_body", "haptics:set"},
    {"physvib_world_touch", "the world's callbacks"}, {"physvib_live_silence", "silence(true)"},
    {"divide lengths by the pixels of a metre %(100, say%)", "call love.physics.setMeter with the pixels of a metre (100, say)"}}
local function explained(explain, ...)
    local text = ffi.new("char[512]")
    local values = {...}
    values[#values + 1], values[#values + 2] = text, 512
    explain(unpack(values))
    local sentence = ffi.string(text)
    for _, name in ipairs(ours) do sentence = sentence:gsub(name[1], name[2]) end
    return sentence
end

-- As Box2D decides: categories and mask as LÖVE's 16 bits, and the group.
local function may_touch(a, b)
    local ca, ma, ga = a:getFilterData()
    local cb, mb, gb = b:getFilterData()
    if ga == gb and ga ~= 0 then return ga > 0 end
    return bit.band(ma, cb) ~= 0 and bit.band(ca, mb) ~= 0
end

-- PHYSVIB_NOTE_..., or nil.
function Attachment:note(fixture)
    local body = fixture:getBody()
    if not body:isActive() then return 2 end
    if fixture:isSensor() then return 0 end
    local others, touchable = 0, 0
    for _, other in ipairs(self.world:getBodies()) do
        for _, theirs in ipairs(other ~= body and other:getFixtures() or {}) do
            others, touchable = others + 1, touchable + (may_touch(fixture, theirs) and 1 or 0)
        end
    end
    if others > 0 and touchable == 0 then return 1 end
    return body:getType() ~= "static" and not body:isAwake() and 3 or nil
end

function Attachment:look_at_sources()
    for fixture in pairs(self.starts) do
        local note = not fixture:isDestroyed() and self:note(fixture)
        if note then call("world_note", self.name, self.ids[fixture], note) end
    end
end

-- Why nothing, or not everything, is felt of what happened since the last call: one sentence. `output`: what is known of an output that plays the
-- events, fields of physvib_output_facts (is_missing, is_silent, silent_by...); of an open device, see its explain.
function Attachment:explain(output)
    self:look_at_sources()
    if output then
        local facts = filled("output_facts", output)
        return explained(function(...) call("world_explain_output", ...) end, self.name, facts)
    end
    return explained(function(...) call("world_explain", ...) end, self.name)
end

local room = ffi.new("physvib_event[256]")
-- The events that are final, appended to `events`; all of them, `at_once`.
function Attachment:take(events, at_once)
    repeat
        local count = call("world_take", self.name, room, 256, at_once and 1 or 0)
        for i = 0, count - 1 do events[#events + 1] = ffi.new("physvib_event", room[i]) end
    until count < 256
    return events
end

local Live = {}
Live.__index = Live

local function live_library() return ffi.load(os.getenv("PHYSVIB_LIVE_LIBRARY") or (library:gsub("libphysvib%.so", "libphysvib-live.so"))) end

-- What physvib.open can open now: {name = "JACK:system", about = "", kind = "sound" or "pad" or "board", channels = 8}...
function physvib.devices()
    local from, most, kinds, all = live_library(), 256, {[0] = "sound", "pad", "board"}, {}
    local found = ffi.new("physvib_device[?]", most)
    local count = from.physvib_live_devices(found, most, ffi.sizeof("physvib_device"))
    for i = 0, math.min(count, most) - 1 do
        all[#all + 1] = {name = ffi.string(found[i].name), about = ffi.string(found[i].about), kind = kinds[found[i].kind], channels = found[i].channels}
    end
    return all
end

-- As Live:follow for an attachment whose fixtures are felt on several devices: those with device = k on lives[k + 1], all others on the first.
function physvib.follow_each(lives, haptics)
    local names, starts = ffi.new("physvib_live[?]", #lives), ffi.new("int64_t[?]", #lives)
    for k, live in ipairs(lives) do names[k - 1], starts[k - 1] = live.name, live.starts[haptics] and live.starts[haptics][0] or 0 end
    local count = lives[1].call("send_each", names, #lives, haptics.name, starts)
    for k, live in ipairs(lives) do live.starts[haptics] = ffi.new("int64_t[1]", starts[k - 1]) end
    return tonumber(count)
end

-- A device, "JACK:system", a board, "BOARD:auto", or both, "JACK:system+BOARD:auto", by libphysvib-live.so.1 beside the other library or
-- named by PHYSVIB_LIVE_LIBRARY. Several may be open, also on one sound card, on other outputs (first_output). `settings` of physvib_live_settings, `renderer` of physvib_renderer_settings.
function physvib.open(device, settings, renderer)
    local from = live_library()
    local self = setmetatable({c = from, call = caller(from, "physvib_live_"), starts = setmetatable({}, {__mode = "k"})}, Live)
    local name = ffi.new("physvib_live[1]")
    self.call("open", device, physvib.rendered(renderer), filled("live_settings", settings, from), name)
    self.name = ffi.gc(name[0], from.physvib_live_close)
    return self
end

-- After each update of a world that goes on with time: what is final is felt L after it happened. Appended to `events`, if they are given,
-- with their session times. Each world has a session time of its own at which it began (`starts`), so it keeps its rhythm beside others.
function Live:follow(haptics, events)
    local start = self.starts[haptics] or ffi.new("int64_t[1]")
    self.starts[haptics] = start
    self.call("align", self.name, haptics.name, start)
    for _, event in ipairs(haptics:take({})) do
        event.time_ns = math.max(0, tonumber(event.time_ns + start[0])) -- before all began: at once
        self:strike(event)
        if events then events[#events + 1] = event end
    end
end

-- One event, at a session time.
function Live:strike(event) self.call("strike", self.name, event, 1) end
-- One impact now: live:impact {x_m = 0.3, y_m = 0.5, strength = 0.8, material = "wooden board"}; strength 0 to 1 of full scale (0.5).
function Live:impact(hit)
    local x, y, strength = hit.x_m or 0, hit.y_m or 0, hit.strength or 0.5
    if hit.material then self.call("impact_of", self.name, hit.material, x, y, strength) else self.call("impact", self.name, x, y, strength) end
end
-- Session time and L, in nanoseconds.
function Live:now_ns() return tonumber(self.c.physvib_live_now_ns(self.name)) end
function Live:latency_ns() return tonumber(self.c.physvib_live_latency_ns(self.name)) end
-- See physvib-live.h.
function Live:set_gain(channel, gain) self.call("set_gain", self.name, channel, gain) end
function Live:set_mute(channel, is_muted) self.call("set_mute", self.name, channel, is_muted and 1 or 0) end
function Live:set_layout(renderer) self.call("set_layout", self.name, physvib.rendered(renderer)) end
function Live:set_level(level_db) self.call("set_level", self.name, level_db) end
function Live:silence(is_silent) self.call("silence", self.name, is_silent == false and 0 or 1) end
function Live:status()
    local told = filled("live_status", nil, self.c)
    self.call("get_status", self.name, told)
    return told
end
-- Why nothing, or not everything, is felt of an attachment on this device: one sentence.
function Live:explain(haptics)
    haptics:look_at_sources()
    return explained(function(...) self.call("explain", ...) end, self.name, haptics.name)
end
function Live:close()
    self.call("close", ffi.gc(self.name, nil))
    self.name = nil
end

local Pads = {}
Pads.__index = Pads

-- Motors of game controllers, by love.joystick: no device of PhysVib's is needed. `settings`: field_width_m and field_height_m; count (1);
-- profile ("pad-generic", see Docs/pads.md); clock (love.timer.getTime). Controllers are counted from 1, as LÖVE's.
function physvib.pads(settings)
    local self = setmetatable({count = settings.count or 1, clock = settings.clock or love.timer.getTime, sent = {}}, Pads)
    local name = ffi.new("physvib_pads[1]")
    call("pads_create", self.count, settings.field_width_m or 0, settings.field_height_m or 0, settings.profile, name)
    self.name, self.motors = ffi.gc(name[0], c.physvib_pads_free), ffi.new("physvib_motors[?]", self.count)
    return self
end

function Pads:now_ns() return self.clock() * 1e9 end
-- An event that one controller feels now.
function Pads:strike(pad, event)
    local now = ffi.new("physvib_event", event)
    now.time_ns = self:now_ns()
    call("pads_strike", self.name, pad - 1, now)
end
-- After each update of a world: all that happened in it is felt by that controller, now.
function Pads:follow(haptics, pad)
    return call("pads_send", self.name, (pad or 1) - 1, haptics.name, self:now_ns() - tonumber(c.physvib_world_time_ns(haptics.name)), 1)
end
-- The commands of a frame: motors[0].low and .high, from 0 to 1, and so on.
function Pads:pull()
    call("pads_pull", self.name, self:now_ns(), self.motors, self.count)
    return self.motors
end
-- Once per frame: sends them to LÖVE's joysticks, controller 1 to joysticks[1]. One lasts 0.2 s, so that motors stop soon if the game does.
function Pads:rumble(joysticks)
    local motors, now = self:pull(), self.clock()
    for pad = 1, self.count do
        local low, high, sent = motors[pad - 1].low, motors[pad - 1].high, self.sent[pad] or {low = 0, high = 0, at = now}
        local isSame = sent.low == low and sent.high == high
        if joysticks[pad] and not (isSame and (low + high == 0 or now < sent.at + 0.1)) then
            joysticks[pad]:setVibration(low, high, 0.2)
            self.sent[pad] = {low = low, high = high, at = now}
        end
    end
end
-- For a pause, or a new level: what was struck is discarded.
function Pads:stop() call("pads_stop", self.name) end
function Pads:set_level(gain) call("pads_set_level", self.name, gain) end

return physvib
