-- SPDX-License-Identifier: GPL-3.0-or-later
function love.conf(t) -- no window, no sound of its own: neither a display nor a device is wanted
    for _, name in ipairs({"audio", "font", "graphics", "image", "joystick", "keyboard", "mouse", "sound", "touch", "video", "window"}) do t.modules[name] = false end
end
