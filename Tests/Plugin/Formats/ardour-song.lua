-- SPDX-License-Identifier: GPL-3.0-or-later
-- What ardour-song.sh has Ardour's Lua shell do, without a device. make FOLDER lv2|vst3 PLUGIN_ID [PRESET]: a session with the
-- plug-in on a MIDI track, a track for its side chain and one that records it. play FOLDER SONG_FOLDER COLUMN: the song's
-- automation (column 3 of automation.txt: in units, 4: from 0 to 1), recorded live. stems FOLDER SONG_FOLDER: exports it.
local block, channels = 512, 4
AudioEngine:set_backend("None (Dummy)", "", "")
AudioEngine:set_buffer_size(block)

local function tracks(session)
    return session:route_by_name("PhysVib"):to_track(), session:route_by_name("Music"):to_track(), session:route_by_name("Take"):to_track()
end

local function count(kind, number) return ARDOUR.ChanCount(ARDOUR.DataType(kind), number) end

local function make(folder, format, id, preset)
    local session = create_session(folder, "song", 48000)
    local last, normal = ARDOUR.PresentationInfo.max_order, ARDOUR.TrackMode.Normal
    local track = session:new_midi_track(count("midi", 1), count("audio", channels), false, ARDOUR.PluginInfo(), nil, nil, 1,
        "PhysVib", last, normal, false, false):front()
    session:new_audio_track(1, 1, nil, 1, "Music", last, normal, false)
    session:new_audio_track(channels, channels, nil, 1, "Take", last, normal, false)
    local kind = format == "lv2" and ARDOUR.PluginType.LV2 or ARDOUR.PluginType.VST3
    local plugin = ARDOUR.LuaAPI.new_plugin(session, id, kind, preset or "")
    assert(not plugin:isnil(), "Ardour does not know " .. id)
    assert(track:add_processor_by_index(plugin, 0, nil, true) == 0)
    assert(track:add_sidechain(plugin))
    session:save_state("")
end

local function automate(insert, path, column)
    local points = {}
    for line in io.lines(path) do
        local words = {}
        for word in line:gmatch("%S+") do words[#words + 1] = word end
        points[words[1]] = points[words[1]] or {}
        table.insert(points[words[1]], { frame = tonumber(words[2]), value = tonumber(words[column]) })
    end
    local plugin, names = insert:plugin(0), { level = "Level", strike_x = "Strike shift x", music = "Music" }
    for n = 0, plugin:parameter_count() - 1 do
        local number = plugin:nth_parameter(n, false)
        for id, name in pairs(names) do
            if plugin:parameter_is_input(number) and plugin:parameter_label(number) == name then
                local list = ARDOUR.LuaAPI.plugin_automation(insert, n)
                list:set_interpolation(Evoral.InterpolationStyle.Discrete)
                for _, point in ipairs(points[id]) do
                    list:add(Temporal.timepos_t(point.frame), point.value, false, true)
                end
                local parameter = Evoral.Parameter(ARDOUR.AutomationType.PluginAutomation, 0, number)
                local control = insert:to_automatable():automation_control(parameter, false)
                control:set_automation_state(ARDOUR.AutoState.Play)
                names[id] = nil
            end
        end
    end
    assert(next(names) == nil, "no parameter " .. tostring(next(names)))
end

local function connect(from, to)
    for n = 0, channels - 1 do
        assert(from:output():audio(n):connect(to:input():audio(n):name()) == 0)
    end
end

local function play(folder, song, column)
    local session = load_session(folder, "song")
    local instrument, music, take = tracks(session)
    local master = session:master_out()
    for _, route in ipairs({ instrument, music, take, master }) do
        if not route:panner_shell():isnil() then route:panner_shell():set_bypassed(true) end
    end
    for _, route in ipairs({ instrument, music, take }) do
        for n = 0, route:n_outputs():n_audio() - 1 do route:output():audio(n):disconnect(master:input():audio(n % 2):name()) end
    end
    local insert = instrument:nth_plugin(0):to_insert()
    local side = insert:sidechain_input()
    for n = 0, side:n_ports():n_audio() - 1 do -- a VST3's has two
        assert(side:audio(n):connect(music:output():audio(0):name()) == 0)
    end
    local pins = insert:input_map(0)
    local last = side:n_ports():n_audio() - 1
    -- Both of an LV2's on the only one.
    for pin = 0, 1 do pins:set(ARDOUR.DataType("audio"), pin, math.min(pin, last)) end
    insert:set_input_map(0, pins)
    automate(insert, song .. "/automation.txt", tonumber(column))
    connect(instrument, take)
    print("Ardour: " .. instrument:n_outputs():n_audio() .. " channels, latency " .. instrument:signal_latency() .. " frames")
    take:rec_enable_control():set_value(1, PBD.GroupControlDisposition.NoGroup)
    session:maybe_enable_record(false)
    session:request_roll(ARDOUR.TransportRequestSource.TRS_UI)
    sleep(14)
    session:request_stop(false, false, ARDOUR.TransportRequestSource.TRS_UI)
    sleep(1)
    print("Ardour: xruns " .. session:get_xrun_count())
    take:rec_enable_control():set_value(0, PBD.GroupControlDisposition.NoGroup)
    session:save_state("")
    io.flush()
end

local function stems(folder, song)
    local export = load_session(folder, "song"):simple_export()
    assert(export:set_preset("5d1a1d3e-6f0c-4a57-9d3b-2f6c3f7a9e11"), "Ardour has not found the preset")
    export:set_folder(song .. "/export")
    export:set_range(0, 576000)
    assert(export:run_export(), "Ardour did not export")
end

local what = { make = make, play = play, stems = stems }
what[arg[1]](table.unpack(arg, 2))
