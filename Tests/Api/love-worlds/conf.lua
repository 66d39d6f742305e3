-- SPDX-License-Identifier: MIT
function love.conf(t) -- no window, no sound: neither a display nor a device is wanted
    for _, name in ipairs({"audio", "font", "graphics", "image", "joystick", "keyboard", "mouse", "sound", "touch", "video", "window"}) do t.modules[name] = false end
end
