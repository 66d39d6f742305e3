# SPDX-License-Identifier: MIT
# Three boxes bounce and are felt on controller 0: prints each hit as the motors got it, and the motors' commands in
# each frame, for motors.py. The clock is the player's, which begins at 1 s.
#   godot --headless -s motors.gd --fixed-fps 60
extends "checks.gd"

const FRAMES := 240
var clock := 1.0
var told := [] # since the last frame's commands


func bouncing(kind: String, at: Vector2, size: Vector2, bounce: float):
	var made = box(kind, at, size)
	made.physics_material_override = PhysicsMaterial.new()
	made.physics_material_override.bounce = bounce
	return made


func _initialize():
	var world := HapticWorld2D.new()
	world.full_scale_n_s = 20.0
	world.felt.connect(func(hit):
		told.append("h %.9f %.9f %.6f %.6f %.9f" % [clock + 1.0 / 60 - (world.time_s() - hit.time_s), hit.frequency_hz,
			hit.position.x * 0.01, (648 - hit.position.y) * 0.01, hit.amplitude]))
	root.add_child(world)
	root.add_child(bouncing("StaticBody2D", Vector2(500, 600), Vector2(1000, 20), 0))
	for i in 3:
		var falls = bouncing("RigidBody2D", Vector2(200 + 300 * i, 500 - 100 * i), Vector2(40, 40), 0.6)
		var haptic := HapticBody.new()
		haptic.controller = 0
		haptic.material = HapticMaterial.new()
		haptic.material.frequency_hz = 100 + 50 * i
		falls.add_child(haptic)
		root.add_child(falls)
	for i in FRAMES:
		await process_frame # before the world sends what belongs to this frame
		if i > 0:
			clock += 1.0 / 60
			var weak_and_strong := Input.get_joy_vibration_strength(0)
			print("m %.9f %.4f %.4f" % [clock, weak_and_strong.y, weak_and_strong.x])
			for line in told: print(line) # which the world got after these commands
			told.clear()
	quit()
