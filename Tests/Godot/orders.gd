# SPDX-License-Identifier: MIT
# Six nodes of a scene that plays are freed in each of their 720 orders, a tick or none apart. And scenes that come
# and go: what they leave in memory. Prints both.
#   godot --headless -s orders.gd --fixed-fps 60 -- changes=2000
extends "checks.gd"

var hits := 0


func felt(made, material: HapticMaterial):
	var haptic := HapticBody.new()
	haptic.material = material
	made.add_child(haptic)
	return haptic


# A floor that is felt, a box on it that bounces, a character, their HapticBody nodes, two worlds.
func six(scene: Node) -> Array:
	var material := HapticMaterial.new()
	material.grain_m = 0.01
	var ground = box("StaticBody2D", Vector2(500, 600), Vector2(1000, 20))
	var falls = box("RigidBody2D", Vector2(500, 569.5), Vector2(40, 40))
	falls.linear_velocity = Vector2(50, 100)
	var of_ground = felt(ground, material)
	var of_box = felt(falls, null)
	var worlds := [HapticWorld2D.new(), HapticWorld2D.new()]
	for world in worlds:
		world.felt.connect(func(_hit): hits += 1)
		world.outputs = ["controllers", "osc:127.0.0.1:19591", "None:no device"]
	var all := [ground, falls, of_ground, of_box, worlds[0], worlds[1]]
	for node in all: if node.get_parent() == null: scene.add_child(node)
	root.add_child(scene)
	return all


func each_order(left: Array, taken: Array, orders: Array):
	if left.is_empty(): orders.append(taken)
	for i in left.size():
		var rest := left.duplicate()
		rest.remove_at(i)
		each_order(rest, taken + [left[i]], orders)


func resident_kb() -> int:
	for line in FileAccess.open("/proc/self/status", FileAccess.READ).get_as_text().split("\n"):
		if line.begins_with("VmRSS:"): return int(line)
	return 0


func _initialize():
	var changes := 200
	for word in OS.get_cmdline_user_args(): if word.begins_with("changes="): changes = int(word.substr(8))
	var orders := []
	each_order(range(6), [], orders)
	for i in orders.size():
		var scene := Node.new()
		var all := six(scene)
		for j in 2: await physics_frame
		for number in orders[i]:
			if is_instance_valid(all[number]): all[number].free()
			if (i + number) % 2: await physics_frame
		scene.free()
	print("%d orders, %d hits" % [orders.size(), hits])
	var before := 0
	for i in changes:
		if i == changes / 4: before = resident_kb() # what is allocated once is there by then
		var scene := Node.new()
		six(scene)
		for j in 2: await physics_frame
		scene.free()
	await physics_frame
	print("%d scenes: %+d KB in the last three quarters" % [changes, resident_kb() - before])
	quit(0 if orders.size() == 720 and hits > 700 else 1)
