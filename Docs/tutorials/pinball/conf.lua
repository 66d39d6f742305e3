-- SPDX-License-Identifier: MIT
function love.conf(t) t.window.width, t.window.height, t.window.title = 392, 770, "Pinball" end
