# SPDX-License-Identifier: MIT
# Plays a demo and takes pictures of it, 640 pixels wide: NAME.webp in the end, and NAME-001.png... of each fourth tick
# of its last ones, for a movie. Those of Docs/godot.md are of tick 260, 75 and 900, and the movies of 620 and (pinball) 1420:
#   xvfb-run godot --rendering-driver opengl3 -s pictures.gd --fixed-fps 60 -- demo=PATH ticks=620 movie=60
#   ffmpeg -framerate 15 -i marble_run-%03d.png -vf scale=480:-1 -loop 0 -c:v libwebp_anim -q:v 35 OUT.webp
extends SceneTree

var given := {"movie": "0"}


func picture() -> Image:
	await RenderingServer.frame_post_draw
	var image := root.get_texture().get_image()
	image.resize(640, 360, Image.INTERPOLATE_LANCZOS)
	return image


# Half a second of pushing upwards, and half a second of rest, where a demo listens to that key.
func frame():
	if Engine.get_process_frames() / 30 % 2 == 1: Input.action_press("ui_up")
	else: Input.action_release("ui_up")
	await process_frame


func _initialize():
	for argument in OS.get_cmdline_user_args(): given[argument.get_slice("=", 0)] = argument.get_slice("=", 1)
	var name: String = given.demo.get_file().get_basename()
	root.add_child(load(given.demo).instantiate())
	for i in int(given.ticks) - 4 * int(given.movie): await frame()
	for i in int(given.movie):
		for j in 4: await frame()
		(await picture()).save_png("res://pictures/%s-%03d.png" % [name, i + 1])
	var image: Image = await picture()
	image.save_webp("res://pictures/%s.webp" % name, true, 0.8)
	var colours := {}
	for x in range(0, 640, 4):
		for y in range(0, 360, 4): colours[image.get_pixel(x, y).to_html()] = true
	print("picture of %s: %d colours" % [name, colours.size()])
	quit(0 if colours.size() > 10 else 1)
