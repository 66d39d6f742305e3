# SPDX-License-Identifier: MIT
# Kicks through contacts that last: a flipper under a resting ball, a platform that jerks, a lever with a rider, a break;
# what rides or rests is silent. In space also seams of boxes and of a GridMap, and a ragdoll's bone.
#   godot --headless -s kicks.gd --fixed-fps 60 -- space=2|3 hz=60
extends "checks.gd"

var space := 2
var hits := []
var scene: Node
var judged := 0
var above := []


func at(x: float, y: float):
	return Vector2(500 + 100 * x, 500 - 100 * y) if space == 2 else Vector3(x, y, 0)


func along(x: float, y: float):
	return Vector2(100 * x, -100 * y) if space == 2 else Vector3(x, y, 0)


func made(kind: String, where, size, is_felt := false, mass := 1.0):
	var body = ClassDB.instantiate(kind if ClassDB.class_exists(kind) else "%s%dD" % [kind, space])
	var shape = ClassDB.instantiate("CollisionShape%dD" % space)
	if size is float:
		shape.shape = CircleShape2D.new() if space == 2 else SphereShape3D.new()
		shape.shape.radius = size * (100 if space == 2 else 1)
	else:
		shape.shape = RectangleShape2D.new() if space == 2 else BoxShape3D.new()
		shape.shape.size = 100 * size if space == 2 else Vector3(size.x, size.y, 1)
	body.add_child(shape)
	body.position = where
	if body.get("mass") != null: body.mass = mass
	if kind == "RigidBody": body.can_sleep = false
	if is_felt: body.add_child(ClassDB.instantiate("HapticBody"))
	return body


func begin(nodes: Array):
	scene = Node.new()
	hits.clear()
	var world = ClassDB.instantiate("HapticWorld%dD" % space)
	world.outputs = PackedStringArray()
	world.felt.connect(func(hit): hits.append(hit))
	scene.add_child(world)
	for node in nodes: scene.add_child(node)
	root.add_child(scene)
	await ticks(Engine.physics_ticks_per_second)
	hits.clear()


func ticks(count: int):
	for i in count: await physics_frame


func strengths() -> Array:
	return hits.map(func(hit): return snappedf(hit.strength_n_s, 0.001))


func end():
	scene.free()
	await ticks(2)


func named(what: String) -> String:
	var engine = "GodotPhysics2D" if space == 2 else ProjectSettings.get_setting("physics/3d/physics_engine")
	return "%s at %d ticks/s: %s: %s" % [engine, Engine.physics_ticks_per_second, what, strengths()]


func platforms():
	var hz := float(Engine.physics_ticks_per_second)
	for what in ["a platform that jerks", "an elevator"]:
		var platform = made("AnimatableBody", at(0, 0), Vector2(2, 0.2))
		platform.sync_to_physics = false
		await begin([platform, made("RigidBody", at(0, 0.35), Vector2(0.5, 0.5), true)])
		var v := 0.0
		for i in int(0.25 * hz):
			v = 3.0 if what != "an elevator" else minf(2.0, v + 2.0 / hz)
			platform.position += along(0, v / hz)
			await physics_frame
		var first: float = hits[0].strength_n_s if hits else 0.0
		# What it carries flies on where the platform stops, and comes down after this.
		check(hits.is_empty() if what == "an elevator" else hits.size() == 1 and absf(first / 3 - 1) < 0.15, named(what))
		await end()


func flipper():
	var hz := float(Engine.physics_ticks_per_second)
	var bat = made("AnimatableBody", at(0, 0), Vector2(2, 0.1))
	bat.sync_to_physics = false
	var ball = made("RigidBody", at(0.8, 0.15), 0.1, true, 0.1)
	await begin([bat, ball, made("StaticBody", at(1.0, 0.3), Vector2(0.1, 1.0))])
	for i in 3:
		if space == 2: bat.rotation -= 15.0 / hz
		else: bat.rotation.z += 15.0 / hz
		await physics_frame
	await ticks(2)
	check(hits.size() >= 1 and hits[0].strength_n_s > 0.5, named("a flipper under a resting ball"))
	await end()


func lever():
	var plank = made("RigidBody", at(0, 0.05), Vector2(2, 0.1), false, 2.0)
	await begin([made("StaticBody", at(0, -0.5), Vector2(20, 1)), plank, made("RigidBody", at(0, 0.35), Vector2(0.5, 0.5), true)])
	plank.linear_velocity = along(0, 4.7)
	await ticks(3)
	check(hits.size() == 1 and absf(hits[0].strength_n_s / (4.7 * 2 / 3) - 1) < 0.15, named("a rider on a plank that is shot up"))
	await end()


# What a signal's handler does to a velocity is no part of the hit that it answers.
func bumper():
	var ball = made("RigidBody", at(0, 1.1), 0.1, true)
	ball.contact_monitor = true
	ball.max_contacts_reported = 4
	ball.body_entered.connect(func(_other): ball.linear_velocity = along(0, 6))
	await begin([])
	for node in [made("StaticBody", at(0, -0.5), Vector2(20, 1)), ball]: scene.add_child(node)
	await ticks(int(0.6 * Engine.physics_ticks_per_second))
	check(hits.size() == 1 and absf(hits[0].strength_n_s / sqrt(2 * 9.8) - 1) < 0.1, named("a ball that body_entered shoots up as it lands, 4.43 N s"))
	await end()


# What a script defers comes before the solver: it fell, and rests now.
func respawn():
	var falls = made("RigidBody", at(0, 20), Vector2(0.5, 0.5), true)
	await begin([made("StaticBody", at(0, -0.5), Vector2(20, 1)), falls])
	falls.global_transform.origin = at(0, 0.25) # a new `position` alone does not reach 2D physics (godot 94633)
	falls.set_deferred("linear_velocity", along(0, 0))
	await ticks(int(0.5 * Engine.physics_ticks_per_second))
	check(hits.is_empty() and falls.position.distance_to(at(0, 0.25)) < (2.0 if space == 2 else 0.02), named("a fall that ends by set_deferred"))
	await end()


# Balls that touch in a row, on a table that is smooth.
func breaks():
	var balls := []
	for i in 6: balls.append(made("RigidBody", at(0.2 * i, 0.1), 0.1, true, 0.17))
	for ball in balls: ball.gravity_scale = 0.0
	balls[0].position = at(-0.6, 0.1)
	await begin(balls)
	balls[0].linear_velocity = along(6, 0)
	await ticks(int(0.3 * Engine.physics_ticks_per_second))
	var felt := {}
	for hit in hits: felt[hit.body] = true
	var missed := balls.filter(func(ball): return ball.linear_velocity.length() > (50 if space == 2 else 0.5) and not felt.has(ball))
	check(missed.is_empty(), named("a row that is struck, %d not felt" % missed.size()))
	await end()


# A ball that rolls smoothly is not felt. Where the engine throws it up, no hit is more than 1.3 times what the solver gave
# it in the ticks about it: Jolt announces edges that the ball then flies over.
func seams(floor_name: String, speed: float):
	var hz := float(Engine.physics_ticks_per_second)
	var nodes := []
	if floor_name == "boxes":
		for i in 60: nodes.append(made("StaticBody", at(-8 + 0.5 * i, -0.25), Vector2(0.5, 0.5)))
	else:
		var library := MeshLibrary.new()
		var cell := BoxShape3D.new()
		cell.size = 0.5 * Vector3.ONE
		library.create_item(0)
		library.set_item_shapes(0, [cell, Transform3D()])
		var map := GridMap.new()
		map.mesh_library = library
		map.cell_size = 0.5 * Vector3.ONE
		map.position.y = -0.5
		for x in range(-20, 40): for z in range(-3, 3): map.set_cell_item(Vector3i(x, 0, z), 0)
		nodes.append(map)
	var ball = made("RigidBody", at(-7, 0.2), 0.2, true)
	ball.linear_damp_mode = 1
	await begin(nodes + [ball])
	ball.linear_velocity = Vector3(speed, 0, 0)
	ball.angular_velocity = Vector3(0, 0, -speed / 0.2)
	var gave := []
	var when := []
	var known := 0
	var last: Vector3 = ball.linear_velocity
	for i in int(1.2 * hz):
		await physics_frame
		gave.append((ball.linear_velocity - last + Vector3(0, 9.8 / hz, 0)).length())
		last = ball.linear_velocity
		for hit in hits.slice(known): when.append(i)
		known = hits.size()
	for j in hits.size(): # what Jolt sees coming it stops in two ticks
		var own: float = gave.slice(maxi(0, when[j] - 4), when[j] + 2).reduce(func(sum, each): return sum + each, 0.0)
		judged += 1
		if hits[j].strength_n_s > 1.3 * own: above.append(hits[j].strength_n_s / own)
	var most := 0.0
	for i in range(1, gave.size()): most = maxf(most, gave[i] + gave[i - 1])
	var is_smooth := most < 2 * 9.8 / hz + 0.15
	check(hits.is_empty() or not is_smooth, named("a ball that rolls at %.0f m/s over %s, the solver gave at most %.2f N s" % [speed, floor_name, most]))
	await end()


# Where it stops a ball, the foot of a ramp is no seam, as flat as it may be.
func ramps():
	for degrees in [10, 20, 40]:
		var slope := deg_to_rad(degrees)
		var ramp = made("StaticBody", at(0, 0), Vector2(4, 0.2))
		ramp.rotation.z = slope
		ramp.position = Vector3(2, 0, 0).rotated(Vector3.BACK, slope) + Vector3(0, -0.1, 0).rotated(Vector3.BACK, slope)
		var ball = made("RigidBody", at(-1.5, 0.2), 0.2, true)
		ball.linear_damp_mode = 1
		await begin([made("StaticBody", at(0, -0.5), Vector2(20, 1)), ramp, ball])
		ball.linear_velocity = Vector3(7, 0, 0)
		ball.angular_velocity = Vector3(0, 0, -7 / 0.2)
		await ticks(int(0.335 * Engine.physics_ticks_per_second))
		var share: float = hits[0].strength_n_s / (7 * sin(slope)) if hits else 0.0
		check(share < 1.1 and share > 0.9, named("a ramp of %d degrees, %.2f N s" % [degrees, 7 * sin(slope)]))
		await end()


# A ball that lands, and runs into a wall of the same body in that tick or soon after.
func corners():
	var hz := float(Engine.physics_ticks_per_second)
	var shares := []
	for k in 24:
		var ground = made("StaticBody", at(0, -0.5), Vector2(20, 1))
		var wall = made("StaticBody", at(0, 0), Vector2(1, 1)).get_child(0)
		var other = wall.get_parent()
		other.remove_child(wall)
		other.free()
		ground.add_child(wall)
		wall.position = along(3, 1)
		var ball = made("RigidBody", at(1.87 - 0.72 * k / hz, 0.28), 0.2, true)
		ball.linear_damp_mode = 1
		ball.physics_material_override = PhysicsMaterial.new()
		ball.physics_material_override.friction = 0.0
		await begin([ground])
		ball.linear_velocity = along(5, -0.4)
		scene.add_child(ball)
		await ticks(int(0.3 * hz) + 3)
		shares.append(strengths().max() / 5.0 if hits else 0.0)
		await end()
	check(shares.min() > 0.95 and shares.max() < 1.3, named("a ball that lands beside a wall of the same body, 5 N s, of which %.2f to %.2f" % [shares.min(), shares.max()]))


func ragdoll():
	var skeleton := Skeleton3D.new()
	skeleton.add_bone("bone")
	skeleton.position = at(0, 1.0)
	var bone = made("PhysicalBone3D", at(0, 0), 0.1, true)
	bone.set("bone_name", "bone")
	var simulator := PhysicalBoneSimulator3D.new()
	skeleton.add_child(simulator)
	simulator.add_child(bone)
	await begin([made("StaticBody", at(0, -0.5), Vector2(20, 1)), skeleton])
	simulator.physical_bones_start_simulation()
	await ticks(Engine.physics_ticks_per_second)
	check(hits.size() > 0, named("a ragdoll's bone that falls"))
	await end()


# What sleeps on something that is freed: an error of Godot's in each tick, which godot.sh looks for.
func freed():
	var ground = made("StaticBody", at(0, -0.5), Vector2(20, 1))
	var rests = made("RigidBody", at(0, 0.25), Vector2(0.5, 0.5), true)
	rests.can_sleep = true
	await begin([ground, rests])
	await ticks(2 * Engine.physics_ticks_per_second)
	ground.queue_free()
	await ticks(10)
	check(rests.sleeping and hits.is_empty(), named("sleeps on what was freed"))
	await end()


func words():
	var falls = made("RigidBody", at(0, 1), 0.2, true)
	falls.get_child(1).material = HapticMaterial.new()
	falls.get_child(1).material.preset = "wood"
	await begin([made("StaticBody", at(0, -0.5), Vector2(20, 1))])
	scene.add_child(falls)
	await ticks(Engine.physics_ticks_per_second)
	check(hits.size() == 1, named("an unknown preset has the standard voice"))
	var world := scene.get_child(0)
	world.set("level_db", "loud")
	check(world.level_db == -12.0, "a text is no level")
	await end()


func _initialize():
	for word in OS.get_cmdline_user_args():
		if word.begins_with("space="): space = int(word.substr(6))
		if word.begins_with("hz="): Engine.physics_ticks_per_second = int(word.substr(3))
	await ticks(2)
	for act in [platforms, flipper, lever, bumper, respawn, breaks, corners, freed, words]: await act.call()
	if space == 3:
		await ragdoll()
		await ramps()
		for floor_name in ["boxes", "gridmap"]: for speed in [1.0, 2.0, 4.0, 7.0]: await seams(floor_name, speed)
		check(above.is_empty(), "of %d hits at seams, above what the solver gave: %s" % [judged, above])
	print("%d wrong" % wrong)
	quit(1 if wrong else 0)
