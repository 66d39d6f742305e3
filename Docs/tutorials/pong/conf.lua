-- SPDX-License-Identifier: MIT
function love.conf(t) t.window.width, t.window.height, t.window.title = 960, 540, "Pong" end
