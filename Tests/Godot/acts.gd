# SPDX-License-Identifier: MIT
# A world that was written as text (Tests/Engines/worlds.py) in Godot, moved and felt: prints a trace as
# Tests/Engines/Trace.h does. In 3D it is locked to the plane.
#   godot --headless -s acts.gd --fixed-fps 240 -- space=2|3 world=FILE
extends SceneTree

var space := 2
var friction := 0.0
var restitution := 0.0
var bodies := {} # by number
var accelerations := [0.0, 0.0, 0.0]
var late := 0.0 # s, half a step: ends of steps lie on the exact path
var scene := Node.new()


func vector(x: float, y: float):
	return 100 * Vector2(x, -y) if space == 2 else Vector3(x, y, 0)


func shape_of(is_ball: bool, width: float, height: float):
	var shape = (CircleShape2D.new() if space == 2 else SphereShape3D.new()) if is_ball else (RectangleShape2D.new() if space == 2 else BoxShape3D.new())
	if is_ball: shape.radius = width / 2 * (100 if space == 2 else 1)
	else: shape.size = 100 * Vector2(width, height) if space == 2 else Vector3(width, height, 0.2 if width < 10 else 10.0)
	return shape


func add(number: int, is_ball: bool, n: Array):
	var mass: float = n[5]
	var body = ClassDB.instantiate("%sBody%dD" % ["Rigid" if mass > 0 else "Static", space])
	var collision = ClassDB.instantiate("CollisionShape%dD" % space)
	collision.shape = shape_of(is_ball, n[3], n[4])
	body.add_child(collision)
	body.physics_material_override = PhysicsMaterial.new()
	body.physics_material_override.friction = friction
	body.physics_material_override.bounce = restitution / 2
	body.position = vector(n[0], n[1])
	if space == 2: body.rotation = -n[2]
	else: body.rotation.z = n[2]
	if mass > 0:
		body.mass = mass
		body.can_sleep = false
		body.linear_damp_mode = 1
		body.angular_damp_mode = 1
		body.linear_velocity = vector(n[6] - late * accelerations[0], n[7] - late * accelerations[1])
		var spin: float = n[8] - late * accelerations[2]
		if space == 2:
			body.angular_velocity = -spin
		else:
			body.angular_velocity = Vector3(0, 0, spin)
			body.axis_lock_linear_z = true
			body.axis_lock_angular_x = true
			body.axis_lock_angular_y = true
			if is_ball: body.inertia = Vector3.ONE * mass * n[3] * n[3] / 8 # as a disc has it
		var haptic := HapticBody.new()
		haptic.felt = n[9] > 0
		body.add_child(haptic)
	bodies[number] = body
	scene.add_child(body)


func pin(a: int, x: float, y: float):
	var joint = PinJoint2D.new() if space == 2 else HingeJoint3D.new()
	joint.position = vector(x, y)
	bodies[a].add_sibling(joint)
	joint.node_a = joint.get_path_to(bodies[a])
	if space == 3: return
	var world := StaticBody2D.new() # which a joint of 2D asks for
	joint.add_sibling(world)
	joint.node_b = joint.get_path_to(world)


func read(path: String) -> Array: # ticks/s and seconds
	var times := [240, 1.0]
	for line in FileAccess.get_file_as_string(path).split("\n", false):
		var words := line.split(" ", false)
		var n := Array(words.slice(1)).map(func(word): return float(word))
		match words[0]:
			"world":
				times = [int(n[0]), n[3]]
				late = 0.5 / n[0]
				restitution = n[1]
				friction = n[2]
			"floor": add(100, false, [0.0, -1.0, 0.0, 40.0, 2.0, 0.0])
			"ball", "box": add(int(n[0]), words[0] == "ball", n.slice(1))
			"pin": pin(int(n[0]), n[2], n[3])
			"falling": accelerations[1] = -9.81
			"starting": accelerations = n
			_: push_error("unknown: " + line)
	return times


func _initialize():
	var path := ""
	for word in OS.get_cmdline_user_args():
		if word.begins_with("space="): space = int(word.substr(6))
		if word.begins_with("world="): path = word.substr(6)
	root.add_child(scene)
	if space == 2: PhysicsServer2D.area_set_param(root.find_world_2d().space, PhysicsServer2D.AREA_PARAM_GRAVITY, 981.0)
	else: PhysicsServer3D.area_set_param(root.find_world_3d().space, PhysicsServer3D.AREA_PARAM_GRAVITY, 9.81)
	Engine.physics_ticks_per_second = 240
	await physics_frame # what is made now moves from the next tick on
	var hits := []
	var world = ClassDB.instantiate("HapticWorld%dD" % space)
	world.outputs = []
	world.felt.connect(func(hit): hits.append(hit))
	scene.add_child(world)
	var times := read(path)
	for step in int(times[0] * times[1]) + 1:
		if step > 0: await physics_frame
		for number in bodies:
			var body = bodies[number]
			if not body.has_method("apply_impulse"): continue
			var at = body.position / (100.0 if space == 2 else 1.0)
			var v = body.linear_velocity / (100.0 if space == 2 else 1.0)
			var sign := -1 if space == 2 else 1
			print("m %d %d %.7f %.7f %.7f %.7f %.7f %.7f" % [step, number, at.x, sign * at.y, v.x, sign * v.y,
				-body.angular_velocity if space == 2 else body.angular_velocity.z, -body.rotation if space == 2 else body.rotation.z])
	for i in 3: await physics_frame # hits come a tick or two later
	for hit in hits:
		var unit := 0.01 if space == 2 else 1.0
		print("e %.9f %d %d %.7f %.7f %.7f 0" % [hit.time_s, bodies.find_key(hit.body), bodies.find_key(hit.other), hit.strength_n_s,
			hit.position.x * unit, hit.position.y * unit])
	quit()
