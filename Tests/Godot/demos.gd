# SPDX-License-Identifier: MIT
# Plays a demo for five seconds and counts what was felt.
#   godot --headless -s demos.gd -- demo=res://addons/physvib/demos/shaken_box.tscn
extends SceneTree


func _initialize():
	var path := ""
	for argument in OS.get_cmdline_user_args():
		if argument.begins_with("demo="): path = argument.substr(5)
	var demo = load(path).instantiate()
	root.add_child(demo)
	var hits := [0]
	for world in demo.get_children().filter(func(node): return node.has_signal("felt")):
		world.felt.connect(func(_hit): hits[0] += 1)
	for i in 5 * Engine.physics_ticks_per_second: await physics_frame
	print("%s: %d hits in 5 s" % [path.get_file(), hits[0]])
	quit(0 if hits[0] > 0 else 1)
