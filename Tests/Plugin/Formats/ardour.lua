-- SPDX-License-Identifier: GPL-3.0-or-later
-- What ardour.sh has Ardour's Lua shell do. ardour.lua make FOLDER lv2|vst3 PLUGIN_ID [PRESET]: a session with the plug-in on
-- a MIDI track, saved. ardour.lua play FOLDER SECONDS: that session, while JACK's transport rolls.
AudioEngine:set_backend("JACK", "ardour", "")

local function make(folder, format, id, preset)
    local session = create_session(folder, "session", 48000)
    local midi, audio = ARDOUR.ChanCount(ARDOUR.DataType("midi"), 1), ARDOUR.ChanCount(ARDOUR.DataType("audio"), 8)
    local track = session:new_midi_track(midi, audio, false, ARDOUR.PluginInfo(), nil, nil, 1, "PhysVib",
        ARDOUR.PresentationInfo.max_order, ARDOUR.TrackMode.Normal, false, false):front()
    local kind = format == "lv2" and ARDOUR.PluginType.LV2 or ARDOUR.PluginType.VST3
    local plugin = ARDOUR.LuaAPI.new_plugin(session, id, kind, preset or "")
    assert(not plugin:isnil(), "Ardour does not know " .. id)
    assert(track:add_processor_by_index(plugin, 0, nil, true) == 0)
    track:panner_shell():set_bypassed(true)
    session:save_state("")
end

local function play(folder, seconds)
    local session = load_session(folder, "session")
    session:cfg():set_external_sync(true)
    local track = session:route_by_name("PhysVib"):to_track()
    track:monitoring_control():set_value(ARDOUR.MonitorChoice.MonitorInput, PBD.GroupControlDisposition.NoGroup)
    print("Ardour: " .. track:n_outputs():n_audio() .. " channels, latency " .. track:signal_latency() .. " frames")
    io.flush()
    sleep(tonumber(seconds))
end

local what = arg[1] == "make" and make or play
what(table.unpack(arg, 2))
