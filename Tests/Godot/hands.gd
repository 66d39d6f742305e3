# SPDX-License-Identifier: MIT
# Pulses of XR controllers at a headset that is written here and keeps each of them: the hand that made the hit, the
# material's hertz, a decay as the material's, a weak hit that does not end a strong one, silence, a pause.
#   godot --headless -s hands.gd --fixed-fps 60
extends "checks.gd"

class Headset extends XRInterfaceExtension:
	var pulses := [] # frame, tracker, Hz, amplitude, s
	func _get_name() -> StringName: return &"a headset of the tests"
	func _is_initialized() -> bool: return true
	func _initialize() -> bool: return true
	func _trigger_haptic_pulse(action: String, tracker: StringName, frequency: float, amplitude: float, seconds: float, delay: float):
		if action == "haptic" and delay == 0.0: pulses.append([Engine.get_process_frames(), String(tracker), frequency, amplitude, seconds])

var headset := Headset.new()
var world


func plate(x: float, part: String, frequency: float):
	var made := StaticBody3D.new()
	made.add_child(CollisionShape3D.new())
	made.get_child(0).shape = BoxShape3D.new()
	made.position = Vector3(x, -0.5, 0)
	var haptic = ClassDB.instantiate("HapticBody")
	haptic.part = part
	haptic.material = ClassDB.instantiate("HapticMaterial")
	haptic.material.frequency_hz = frequency
	haptic.material.decay_per_s = 8.0
	made.add_child(haptic)
	root.add_child(made)


func drop(x: float, height: float):
	var made := RigidBody3D.new()
	made.add_child(CollisionShape3D.new())
	made.get_child(0).shape = SphereShape3D.new()
	made.get_child(0).shape.radius = 0.1
	made.position = Vector3(x, height + 0.1, 0)
	root.add_child(made)
	return made


func frames(count: int):
	for i in count: await process_frame


func of(hand: String) -> Array:
	return headset.pulses.filter(func(pulse): return pulse[1] == hand)


# How strong a hand's pulse is in a frame: the last one that was sent, if it still lasts.
func at(hand: String, frame: int) -> float:
	var sent := of(hand).filter(func(pulse): return pulse[0] <= frame)
	return sent[-1][3] if sent and (frame - sent[-1][0]) / 60.0 < sent[-1][4] else 0.0


# The demo by itself, and with a tracker that taps the drum of 190 Hz with the left hand.
func drums():
	var demo = load("res://addons/physvib/demos/drums.tscn").instantiate()
	root.add_child(demo)
	headset.pulses.clear()
	await frames(240)
	var hertz := func(hand): return of(hand).reduce(func(all, pulse): all[roundi(pulse[2])] = true; return all, {}).keys()
	check(hertz.call("left_hand") == [90, 60] and hertz.call("right_hand") == [130, 190], "drums: %s Hz on the left, %s on the right" % [hertz.call("left_hand"), hertz.call("right_hand")])
	var tracker := XRControllerTracker.new()
	tracker.name = "left_hand"
	XRServer.add_tracker(tracker)
	headset.pulses.clear()
	for i in 120:
		var place: Vector3 = demo.drums[3].position + Vector3(0, 0.25 + 0.2 * cos(i / 10.0), 0)
		tracker.set_pose("aim", Transform3D(Basis(), place), Vector3.ZERO, Vector3.ZERO, XRPose.XR_TRACKING_CONFIDENCE_HIGH)
		await physics_frame
	check(190 in hertz.call("left_hand"), "drums: a tracker's hand taps: %s" % [hertz.call("left_hand")])
	XRServer.remove_tracker(tracker)
	demo.free()


func _initialize():
	XRServer.add_interface(headset)
	XRServer.primary_interface = headset
	world = ClassDB.instantiate("HapticWorld3D")
	world.outputs = ["xr"]
	world.full_scale_n_s = 5.0
	root.add_child(world)
	plate(-2, "left_hand", 120)
	plate(0, "right_hand", 250)
	plate(2, "", 60)
	await frames(3)

	var ball = drop(-2, 1.0) # 4.43 N s
	var hits := []
	world.felt.connect(func(hit): hits.append([Engine.get_process_frames(), hit.amplitude]))
	await frames(75)
	ball.queue_free()
	check(hits.size() == 1 and of("left_hand").size() > 10 and of("right_hand").is_empty(), "the left hand alone: %d pulses" % of("left_hand").size())
	check(of("left_hand").all(func(pulse): return absf(pulse[2] - 120) < 1e-6), "in the material's hertz")
	var first: int = of("left_hand")[0][0]
	var worst := 0.0
	for i in 20: worst = maxf(worst, absf(at("left_hand", first + i) - hits[0][1] * exp(-8 * i / 60.0)))
	check(first - hits[0][0] <= 1 and worst < 0.1 * hits[0][1], "at %d frames, and as it decays: %.4f of %.4f off at most" % [first - hits[0][0], worst, hits[0][1]])
	check(of("left_hand")[-1][3] == 0.0, "it ends")

	headset.pulses.clear()
	hits.clear()
	var strong = drop(-2, 1.0)
	await frames(24)
	var weak = drop(-2.3, 0.03)
	await frames(60)
	for each in [strong, weak]: each.queue_free()
	check(hits.size() == 2 and hits[1][1] < 0.5 * hits[0][1], "a strong hit and a weak one: %s" % [hits])
	first = of("left_hand")[0][0]
	check(range(20).all(func(i): return absf(at("left_hand", first + i) - hits[0][1] * exp(-8 * i / 60.0)) < 0.01), "the weak one changes nothing while the strong one rings")

	headset.pulses.clear()
	ball = drop(2, 1.0)
	await frames(90)
	ball.queue_free()
	check(of("left_hand").size() == of("right_hand").size() and of("left_hand").size() > 5 and of("right_hand")[0][2] == 60.0, "without a part: both hands")

	headset.pulses.clear()
	ball = drop(0, 1.0)
	await frames(32)
	check(of("right_hand").size() > 0 and of("left_hand").is_empty() and of("right_hand")[-1][3] > 0, "the right hand alone")
	paused = true
	await frames(3)
	check(of("right_hand")[-1][3] == 0.0 and at("right_hand", Engine.get_process_frames()) == 0.0, "a pause ends it")
	paused = false
	ball.queue_free()

	world.silent = true
	await frames(3)
	headset.pulses.clear()
	ball = drop(0, 1.0)
	await frames(45)
	ball.queue_free()
	check(headset.pulses.is_empty(), "silent: none")
	for node in root.get_children(): node.free()
	await drums()
	world = ClassDB.instantiate("HapticWorld3D")
	world.outputs = ["xr"]
	root.add_child(world)
	plate(0, "right_hand", 250)
	await frames(60)
	headset.pulses.clear()
	XRServer.primary_interface = null
	XRServer.remove_interface(headset)
	drop(0, 1.0)
	await frames(45)
	check(headset.pulses.is_empty(), "without a headset: none, and no error")
	print("%d wrong" % wrong)
	quit(1 if wrong else 0)
