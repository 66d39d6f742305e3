# SPDX-License-Identifier: MIT
# Nodes that come, go and come again, two worlds at once, materials that are shared, properties that change while
# the game plays, motors while it stands still.
#   godot --headless -s nodes.gd --fixed-fps 60
extends "checks.gd"


func felt_box(at: Vector2) -> RigidBody2D:
	var made: RigidBody2D = box("RigidBody2D", at, Vector2(40, 40))
	made.can_sleep = false
	made.add_child(HapticBody.new())
	return made


func world_of(hits: Array) -> HapticWorld2D:
	var world := HapticWorld2D.new()
	world.felt.connect(func(hit): hits.append(hit))
	return world


func ticks(count: int):
	for i in count: await physics_frame


func scene_of(nodes: Array) -> Node:
	var scene := Node.new()
	scene.add_child(box("StaticBody2D", Vector2(500, 600), Vector2(1000, 20)))
	for node in nodes: scene.add_child(node)
	root.add_child(scene)
	return scene


func two_worlds():
	var first := []
	var second := []
	var worlds := [world_of(first), world_of(second)]
	var falls := felt_box(Vector2(500, 500))
	var scene := scene_of([worlds[0], worlds[1], falls])
	await ticks(60)
	check(first.size() == 1 and second.is_empty(), "of two worlds, one tells the hit")
	worlds[0].free()
	await ticks(2)
	falls.linear_velocity = Vector2(0, -300)
	await ticks(60)
	check(first.size() == 1 and second.size() == 1, "the other one does when the first has left")
	scene.free()


func again():
	var hits := []
	var world := world_of(hits)
	var character = box("CharacterBody2D", Vector2(300, 570), Vector2(40, 40)) # on the floor
	character.add_child(HapticBody.new())
	var scene := scene_of([world, felt_box(Vector2(500, 560)), character])
	var walk := func():
		character.velocity += Vector2(0, 980.0 / 60)
		character.move_and_slide()
	var wait := func(count: int):
		for i in count:
			await physics_frame
			if character.is_inside_tree(): walk.call()
	await wait.call(60)
	hits.clear()
	for node in [world, scene, character, scene.get_child(2)]:
		var parent: Node = node.get_parent()
		parent.remove_child(node)
		await wait.call(3)
		parent.add_child(node)
		await wait.call(20)
		check(hits.is_empty(), "a %s that comes again hits nothing: %s" % [node.get_class(), hits])
		hits.clear()
	check(world.time_s() > 1.0, "time goes on")
	scene.free()
	var lands := []
	var stands = box("CharacterBody2D", Vector2(300, 569.9), Vector2(40, 40))
	stands.add_child(HapticBody.new())
	scene = scene_of([world_of(lands), stands])
	for i in 20:
		await physics_frame
		stands.velocity = Vector2(0, 300) # pressed down from the first tick on
		stands.move_and_slide()
	check(lands.is_empty(), "a character that stands from the first tick on hits nothing: %s" % [lands])
	scene.free()


func materials():
	var material := HapticMaterial.new()
	var body := HapticBody.new()
	body.material = material
	check(material.get_reference_count() == 2, "a material in a variable and a HapticBody is held twice")
	for i in 1000:
		var its: HapticMaterial = body.get_material() # typed, so called by pointer
		its.frequency_hz = 100 + i
	check(material.get_reference_count() == 2 and material.frequency_hz == 1099, "a thousand reads later too")
	body.free()
	check(material.get_reference_count() == 1, "the HapticBody has let go of it")
	var parent := HapticBody.new()
	parent.add_child(Node.new())
	var twin := parent.duplicate()
	check(twin.get_child_count() == 1, "a HapticBody is duplicated with its children")
	for node in [parent, twin]: node.free()
	var bouncy := PhysicsMaterial.new()
	var hits := []
	var world := world_of(hits)
	world.physics_materials = {bouncy: material}
	var falls := felt_box(Vector2(500, 500))
	falls.physics_material_override = bouncy
	var scene := scene_of([world, falls])
	await ticks(60)
	check(hits.size() > 0 and is_equal_approx(hits[0].frequency_hz, 1099), "a PhysicsMaterial vibrates as it is mapped")
	material.frequency_hz = 77
	falls.linear_velocity = Vector2(0, -300)
	hits.clear()
	await ticks(60)
	check(hits.size() > 0 and is_equal_approx(hits[0].frequency_hz, 77), "a material that changes is felt as it is now")
	var copy: Dictionary = world.physics_materials
	copy.clear()
	check(world.physics_materials.size() == 1, "a changed copy of the mapping changes nothing")
	for wrong_one in [{bouncy: 3}, {5: material}, {bouncy: bouncy}, {material: material}]:
		world.physics_materials = wrong_one # which is said
		check(world.physics_materials == {bouncy: material}, "what is no HapticMaterial by PhysicsMaterial changes nothing: %s" % [wrong_one])
	world.physics_materials = {bouncy: null}
	check(world.physics_materials == {bouncy: null}, "a row that the editor has just made is kept")
	world.physics_materials = {}
	scene.free()


func hostile():
	var world := HapticWorld2D.new()
	world.actuators = PackedVector2Array([Vector2(NAN, 0), Vector2(INF, 3)])
	check(world.actuators.is_empty(), "actuators at no place are refused")
	for size in [Vector2.ZERO, Vector2(100, 0), Vector2(-5, 7), Vector2(NAN, 1)]:
		world.field_size = size
		check(world.field_size == Vector2(1152, 648), "a field of size %s is refused" % size)
	for preset in Array(world.get_property_list().filter(func(its): return its.name == "layout")[0].hint_string.split(",")):
		world.layout = preset
		check(world.actuator_places().size() > 0, "there is a layout %s" % preset)
	world.free()


# A body of thousands of shapes, a body at no place, and one without any shape.
func shapes():
	var hits := []
	var many = felt_box(Vector2(500, 300))
	for i in 3000:
		var shape := CollisionShape2D.new()
		shape.shape = CircleShape2D.new()
		shape.position = Vector2(i % 50, i / 50)
		many.add_child(shape)
	var nowhere = felt_box(Vector2(NAN, INF))
	nowhere.mass = 1e30
	var empty := RigidBody2D.new()
	empty.add_child(HapticBody.new())
	empty.add_child(HapticBody.new()) # a second one of the same body
	var scene := scene_of([world_of(hits), many, nowhere, empty])
	await ticks(90)
	check(hits.all(func(hit): return is_finite(hit.strength_n_s) and hit.position.is_finite()), "hits of strange bodies are finite: %d" % hits.size())
	scene.free()


# Programs of OSC get one message per hit and receiver, and as many receivers as outputs were opened.
func reopened():
	var server := PacketPeerUDP.new()
	server.bind(19581, "127.0.0.1")
	var hits := []
	var world := world_of(hits)
	world.outputs = ["osc:127.0.0.1:19581"]
	var falls := felt_box(Vector2(500, 500))
	var scene := scene_of([world, falls])
	var ports := {}
	for i in 240:
		world.threshold_m_per_s = 0.15 + 0.0001 * (i % 2)
		world.level_db = -12 - i % 3
		world.silent = i > 200
		if i % 60 == 59: falls.linear_velocity = Vector2(0, -300)
		await physics_frame
		while server.get_available_packet_count() > 0:
			server.get_packet()
			ports[server.get_packet_port()] = true
	check(hits.size() >= 3 and ports.size() == 1, "outputs stay open while other properties change: %d hits, %d sockets" % [hits.size(), ports.size()])
	scene.free()


func motors():
	var world := HapticWorld2D.new()
	world.full_scale_n_s = 100.0
	var falls := felt_box(Vector2(500, 500))
	falls.mass = 20
	falls.get_child(1).controller = 0
	falls.get_child(1).material = HapticMaterial.new()
	falls.get_child(1).material.decay_per_s = 1.0 # for seconds
	var hits := []
	world.felt.connect(func(hit): hits.append(hit))
	var scene := scene_of([world, falls])
	var rumble := func(): return Input.get_joy_vibration_strength(0).length()
	while hits.is_empty(): await physics_frame
	for i in 5: await process_frame
	check(rumble.call() > 0.1, "the motors run: %.2f" % rumble.call())
	paused = true
	for i in 2: await process_frame
	check(rumble.call() == 0, "they rest in a paused game")
	paused = false
	for i in 2: await process_frame
	check(rumble.call() > 0.1, "and go on after it")
	world.silent = true
	for i in 2: await process_frame
	check(rumble.call() == 0, "they rest in silence")
	world.silent = false
	for i in 2: await process_frame
	check(rumble.call() > 0.1, "and go on after it")
	Engine.time_scale = 0
	for i in 600:
		await process_frame
		OS.delay_msec(10)
	check(rumble.call() < 0.1, "they fade while time stands still: %.2f" % rumble.call())
	Engine.time_scale = 1
	scene.free()
	await process_frame
	check(rumble.call() == 0, "they rest when the world has gone")


func explains():
	var world := world_of([])
	var falls: RigidBody2D = box("RigidBody2D", Vector2(500, 500), Vector2(40, 40))
	falls.can_sleep = false
	var scene := scene_of([world, falls])
	await ticks(60)
	var says := func(words: String):
		var why: String = world.explain()
		check(words in why and not "physvib" in why and not "camera" in why, why)
	says.call("add a HapticBody child")
	falls.add_child(HapticBody.new())
	falls.linear_velocity = Vector2(0, -300)
	await ticks(60)
	says.call("nothing is wrong")
	falls.linear_velocity = Vector2(0, -300)
	world.silent = true
	await ticks(60)
	says.call("silent of the world is on")
	scene.free()
	var elsewhere := HapticWorld3D.new()
	scene = scene_of([elsewhere, felt_box(Vector2(500, 500))])
	await ticks(60)
	check("2D needs a HapticWorld2D" in elsewhere.explain(), elsewhere.explain())
	scene.free()


func _initialize():
	await ticks(2)
	await two_worlds()
	await again()
	await materials()
	hostile()
	await shapes()
	await reopened()
	await motors()
	await explains()
	print("%d wrong" % wrong)
	quit(1 if wrong else 0)
