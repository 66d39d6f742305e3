# SPDX-License-Identifier: MIT
# The output `sound`, in real time: what a bus of Godot's gets of a ball that bounces at a quarter of the field, against the hits that the world tells: as far apart, and
# left and right by the law of energy.
#   godot --headless -s sound.gd
extends "checks.gd"


func _initialize():
	AudioServer.add_bus()
	AudioServer.set_bus_name(1, "Touch")
	var capture := AudioEffectCapture.new()
	capture.buffer_length = 10
	AudioServer.add_bus_effect(1, capture)
	var world = ClassDB.instantiate("HapticWorld2D")
	var hits := []
	var told := [] # ms of the system
	world.felt.connect(func(hit): hits.append(hit); told.append(Time.get_ticks_msec()))
	world.field_size = Vector2(1000, 648)
	world.outputs = ["sound:Touch"]
	var floor = box("StaticBody2D", Vector2(500, 600), Vector2(1000, 20))
	floor.physics_material_override = PhysicsMaterial.new()
	floor.physics_material_override.bounce = 0.7
	var ball = box("RigidBody2D", Vector2(250, 400), Vector2(20, 20))
	ball.lock_rotation = true
	ball.add_child(ClassDB.instantiate("HapticBody"))
	var scene := Node.new()
	for node in [floor, ball, world]: scene.add_child(node)
	root.add_child(scene)
	var until := Time.get_ticks_msec() + 4000
	var samples := PackedVector2Array()
	var slowest := 0
	var reached := 0
	var last := Time.get_ticks_msec()
	while Time.get_ticks_msec() < until:
		await process_frame
		slowest = maxi(slowest, Time.get_ticks_msec() - last)
		last = Time.get_ticks_msec()
		var more := capture.get_buffer(capture.get_frames_available())
		if reached == 0 and Array(more).any(func(sample): return absf(sample.x) > 1e-4): reached = last
		samples.append_array(more)
	var rate := AudioServer.get_mix_rate()
	check(hits.size() >= 3, "the ball is felt: %d hits" % hits.size())
	check(reached - told[0] < 300, "the ear is %d ms behind `felt`" % (reached - told[0]))
	var onsets := []
	var quiet := 0
	var left := 0.0
	var right := 0.0
	var before := 0.0
	for i in samples.size():
		var sample := samples[i]
		left += sample.x * sample.x
		right += sample.y * sample.y
		# An onset is a jump of what a falling sinusoid reaches within its longest period.
		var strength := absf(sample.x)
		if strength > 1e-4 and (onsets.is_empty() or (i - onsets[-1] > 0.1 * rate and strength > 1.5 * before)): onsets.append(i)
		before = maxf(strength, before * exp(-20.0 / rate))
		quiet = i
	check(samples.size() > 3 * rate, "%d frames reached the bus, the slowest frame took %d ms" % [samples.size(), slowest])
	check(left > 0 and absf(sqrt(right / left) - sqrt(0.25 / 0.75)) < 0.01, "right to left %.4f, due %.4f" % [sqrt(right / left), sqrt(0.25 / 0.75)])
	for i in range(1, mini(3, mini(onsets.size(), hits.size()))):
		var heard: float = (onsets[i] - onsets[i - 1]) / rate
		var due: float = hits[i].time_s - hits[i - 1].time_s
		check(absf(heard - due) < 0.002, "hit %d is heard %.4f s after the one before, due %.4f s" % [i, heard, due])
	check(onsets.size() >= 3, "%d onsets" % onsets.size())
	world.silent = true
	for i in 10: await process_frame
	capture.clear_buffer()
	ball.linear_velocity = Vector2(0, -400)
	until = Time.get_ticks_msec() + 1500
	var loudest := 0.0
	while Time.get_ticks_msec() < until:
		await process_frame
		for sample in capture.get_buffer(capture.get_frames_available()): loudest = maxf(loudest, absf(sample.x))
	check(loudest < 1e-6, "silent: %.9f" % loudest)
	world.silent = false
	scene.queue_free()
	await process_frame
	print("%d wrong" % wrong)
	quit(0 if wrong == 0 else 1)
