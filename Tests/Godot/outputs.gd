# SPDX-License-Identifier: MIT
# Several outputs at once, what an OSC program gets, places of actuators, and values of types that do not fit.
#   godot --headless -s outputs.gd
extends "checks.gd"


func ball(at: Vector2) -> RigidBody2D:
	var made := RigidBody2D.new()
	var shape := CollisionShape2D.new()
	shape.shape = CircleShape2D.new()
	made.add_child(shape)
	made.position = at
	made.add_child(ClassDB.instantiate("HapticBody"))
	return made


# Names and values of an OSC message whose address and types are known.
func message(bytes: PackedByteArray) -> Dictionary:
	var stream := StreamPeerBuffer.new()
	stream.big_endian = true
	stream.data_array = bytes
	var text := func() -> String:
		var found := ""
		while true:
			var four: PackedByteArray = stream.get_data(4)[1]
			found += four.get_string_from_ascii()
			if 0 in four: return found
		return found
	var result := {"address": text.call()}
	if text.call() != ",sfsfsffsf": return {}
	for name in ["frequency_hz", "decay_per_s", "place", "y", "level"]:
		if name != "y" and text.call() != name: return {}
		result[name] = stream.get_float()
	result["rest"] = stream.get_available_bytes()
	return result


func _initialize():
	var servers: Array[PacketPeerUDP] = [PacketPeerUDP.new(), PacketPeerUDP.new()]
	for i in 2: servers[i].bind(19571 + i)
	var world = ClassDB.instantiate("HapticWorld2D")
	var hits := []
	world.felt.connect(func(hit): hits.append(hit))
	world.outputs = ["controllers", "phone", "osc:127.0.0.1:19571", "osc:127.0.0.1:19572", "None:no device"]
	check(Array(world.outputs).size() == 5, "five outputs from an array of texts")
	var floor := StaticBody2D.new()
	floor.add_child(CollisionShape2D.new())
	floor.get_child(0).shape = RectangleShape2D.new()
	floor.get_child(0).shape.size = Vector2(1000, 20)
	floor.position = Vector2(500, 600)
	var scene := Node.new()
	for node in [floor, ball(Vector2(300, 500)), world]: scene.add_child(node)
	root.add_child(scene)
	for i in 90: await physics_frame
	for server in servers:
		var got := message(server.get_packet())
		check(got.size() > 0 and got.address == "/physvib/strike" and got.rest == 0, "a message of OSC: %s" % got)
		if got.is_empty() or hits.is_empty(): continue
		var expected := Vector2(hits[0].position.x, 648 - hits[0].position.y) * 0.01
		check(expected.distance_to(Vector2(got.place, got.y)) < 1e-3, "it is where the hit was, in metres of the field")
		check(is_equal_approx(got.frequency_hz, 200) and is_equal_approx(got.decay_per_s, 30), "it vibrates as the body")
		check(absf(got.level - hits[0].amplitude) < 1e-6, "it is as strong as the hit")
		check(server.get_available_packet_count() == hits.size() - 1, "one message a hit")

	# What the camera sees is the field: one that looks 100 pixels to the right moves hits as far to the left.
	var camera := Camera2D.new()
	camera.position = Vector2(576 + 100, 324)
	scene.add_child(camera)
	world.field_from_camera = true
	root.size = Vector2i(1152, 648)
	servers[0].close()
	servers[0].bind(19571)
	hits.clear()
	await physics_frame
	scene.get_child(1).linear_velocity = Vector2(0, -300)
	for i in 60: await physics_frame
	var seen := message(servers[0].get_packet())
	check(hits.size() > 0 and seen.size() > 0, "a hit is played while the camera is the field")
	if hits and seen:
		var share: Vector2 = root.get_canvas_transform() * hits[0].position / root.get_visible_rect().size
		check(Vector2(seen.place, seen.y).distance_to(Vector2(share.x, 1 - share.y) * Vector2(11.52, 6.48)) < 1e-3 and absf(seen.place - hits[0].position.x * 0.01) > 0.5,
			"it is where the screen shows it: %s of %s, %s" % [Vector2(seen.place, seen.y), share, root.get_visible_rect()])
	world.field_from_camera = false

	world.outputs = ["osc:127.0.0.1", "osc:127.0.0.1:99999", "osc::", "osc", "no such device", "", "controllers", "controllers"]
	for i in 3: await physics_frame
	check(hits.size() > 0, "outputs that are not there are reported, and the others play")
	var copy = world.outputs
	copy.append("phone")
	check(not "phone" in world.outputs, "a changed copy of outputs changes nothing")

	check(world.actuator_places().size() == 4, "phone4 has four places: %s" % world.actuator_places())
	world.actuators = [Vector2(0, 0), Vector2(1152, 648)]
	check(world.actuator_places() == PackedVector2Array([Vector2(0, 0), Vector2(1152, 648)]), "places of two of its own")
	var many := PackedVector2Array()
	many.resize(5000)
	world.actuators = many
	for i in 3: await physics_frame
	check(world.actuator_places().is_empty(), "thousands of actuators are reported")
	world.actuators = []
	world.layout = "no such layout"
	for i in 3: await physics_frame
	check(world.actuator_places().is_empty(), "a layout that is not there is reported")

	var body = ClassDB.instantiate("HapticBody")
	var material = ClassDB.instantiate("HapticMaterial")
	for value in [NAN, INF, "text", {}, [], Vector2(NAN, 0), Node, null, 1e300, -1, Callable(), RID()]:
		for object in [body, material, world]:
			for property in object.get_property_list():
				if property.usage & PROPERTY_USAGE_SCRIPT_VARIABLE or not property.name in kept(object): continue
				var before = object.get(property.name)
				object.set(property.name, value)
				var after = object.get(property.name)
				if typeof(after) != property.type and not (property.type == TYPE_OBJECT and after == null):
					check(false, "%s = %s left %s" % [property.name, value, after])
				object.set(property.name, before)
	check(true, "values of other types are converted or change nothing")
	body.material = body
	check(body.material == null, "a node is no material")
	body.free()
	ClassDB.instantiate("HapticWorld3D").free()
	for i in 30: await physics_frame
	scene.free()
	print("%d wrong" % wrong)
	quit(1 if wrong else 0)


func kept(object: Object) -> Array:
	return ClassDB.class_get_property_list(object.get_class(), true).map(func(property): return property.name)
