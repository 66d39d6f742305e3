# SPDX-License-Identifier: MIT
# Balls fall for some seconds on the device of a JACK server, and what is played is written as a session, which
# `physvib render` makes again.
#   godot --headless -s played.gd -- seconds=4
extends SceneTree


func box(kind: String, at: Vector2, shape: Shape2D):
	var made = ClassDB.instantiate(kind)
	made.add_child(CollisionShape2D.new())
	made.get_child(0).shape = shape
	made.position = at
	made.physics_material_override = PhysicsMaterial.new()
	made.physics_material_override.bounce = 0.4
	return made


func _initialize():
	var seconds := 4.0
	for word in OS.get_cmdline_user_args(): if word.begins_with("seconds="): seconds = float(word.substr(8))
	var world := HapticWorld2D.new()
	var hits := [0]
	world.felt.connect(func(_hit): hits[0] += 1)
	world.outputs = ["JACK:system"]
	world.session_file = "res://played.json"
	world.level_db = 0
	world.full_scale_n_s = 20.0
	root.add_child(world)
	var plate := RectangleShape2D.new()
	plate.size = Vector2(1152, 20)
	root.add_child(box("StaticBody2D", Vector2(576, 640), plate))
	for i in 8:
		var circle := CircleShape2D.new()
		circle.radius = 12 + 2 * i
		var falls = box("RigidBody2D", Vector2(100 + 130 * i, 400 - 40 * i), circle)
		var haptic := HapticBody.new()
		haptic.material = HapticMaterial.new()
		haptic.material.frequency_hz = 80 + 30 * i
		falls.add_child(haptic)
		root.add_child(falls)
	var most := [0.0, 0.0, 0.0, 0.0] # of what left, by the world's receipts
	var look := func():
		var left: Dictionary = world.left()
		for j in left: most[j] = maxf(most[j], left[j])
	process_frame.connect(look)
	await create_timer(seconds).timeout
	process_frame.disconnect(look)
	print("%d hits" % hits[0])
	print("left %s" % " ".join(most.map(func(peak): return "%.6f" % peak)))
	world.outputs = []
	await create_timer(0.1).timeout
	print("without an output %s" % world.left())
	world.free() # which closes the session
	quit()
