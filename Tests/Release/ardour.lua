-- SPDX-License-Identifier: MIT
-- Ardour's shell without a window or a device puts the installed plug-in on a track: ardour7-lua ardour.lua FOLDER ID
AudioEngine:set_backend("None (Dummy)", "", "")
local session = create_session(arg[1], "session", 48000)
local plugin = ARDOUR.LuaAPI.new_plugin(session, arg[2], ARDOUR.PluginType.VST3, "")
assert(not plugin:isnil(), "Ardour does not know " .. arg[2])
local midi, audio = ARDOUR.ChanCount(ARDOUR.DataType("midi"), 1), ARDOUR.ChanCount(ARDOUR.DataType("audio"), 4)
local shared, no_group = pcall(ARDOUR.RouteGroup) -- from Ardour 9 on, which reads through nil; before, nil alone
local track = session:new_midi_track(midi, audio, false, ARDOUR.PluginInfo(), nil, shared and no_group or nil, 1, "PhysVib",
    ARDOUR.PresentationInfo.max_order, ARDOUR.TrackMode.Normal, false, false):front()
assert(track:add_processor_by_index(plugin, 0, nil, true) == 0)
local name = plugin:to_insert():plugin(0):name()
session:save_state("")
close_session()
print("Ardour: " .. name .. " on a track")
io.stdout:flush() -- Ardour 9 cancels its threads as it quits, and then an empty session, too, may end by abort
