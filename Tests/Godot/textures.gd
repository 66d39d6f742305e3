# SPDX-License-Identifier: MIT
# A ball rolls, and a box slides, for two seconds over a floor with a grain every 2 cm: as many vibrations as grains
# it passed, as an OSC program gets them. The signal says the hits alone.
#   godot --headless -s textures.gd -- space=2|3 hz=60 rolls|slides
extends SceneTree

const GRAIN := 0.02
const SPEED := 1.5


func made(kind: String, space: int, shape: Shape2D, solid: Shape3D, x: float, y: float, friction: float):
	var body = ClassDB.instantiate("%s%dD" % [kind, space])
	var collision = ClassDB.instantiate("CollisionShape%dD" % space)
	collision.shape = shape if space == 2 else solid
	body.add_child(collision)
	body.position = 100 * Vector2(x, -y) if space == 2 else Vector3(x, y, 0)
	body.physics_material_override = PhysicsMaterial.new()
	body.physics_material_override.friction = friction
	return body


func _initialize():
	var words := OS.get_cmdline_user_args()
	var space := 3 if "space=3" in words else 2
	var rolls := "rolls" in words
	for word in words: if word.begins_with("hz="): Engine.physics_ticks_per_second = int(word.substr(3))
	var unit := 100.0 if space == 2 else 1.0
	var server := PacketPeerUDP.new()
	server.bind(19574, "127.0.0.1")
	var size := Vector3(20, 2, 20)
	var plate := RectangleShape2D.new()
	plate.size = Vector2(size.x, size.y) * 100
	var slab := BoxShape3D.new()
	slab.size = size
	var ground = made("StaticBody", space, plate, slab, 0, -1, 1.0 if rolls else 0.0)
	var circle := CircleShape2D.new()
	circle.radius = 10
	var small := RectangleShape2D.new()
	small.size = Vector2(20, 20)
	var cube := BoxShape3D.new()
	cube.size = Vector3.ONE * 0.2
	var ball := SphereShape3D.new()
	ball.radius = 0.1
	var body = made("RigidBody", space, circle if rolls else small, ball if rolls else cube, -5, 0.1, 1.0 if rolls else 0.0)
	body.linear_velocity = Vector2(SPEED * unit, 0) if space == 2 else Vector3(SPEED, 0, 0)
	if rolls: body.angular_velocity = SPEED / 0.1 if space == 2 else Vector3(0, 0, -SPEED / 0.1)
	body.can_sleep = false
	body.linear_damp_mode = 1
	body.angular_damp_mode = 1
	var haptic = ClassDB.instantiate("HapticBody")
	body.add_child(haptic)
	var rough = ClassDB.instantiate("HapticBody")
	rough.felt = false
	rough.material = ClassDB.instantiate("HapticMaterial")
	rough.material.grain_m = GRAIN
	ground.add_child(rough)
	var world = ClassDB.instantiate("HapticWorld%dD" % space)
	world.outputs = ["osc:127.0.0.1:19574"]
	world.full_scale_n_s = 1.0
	var hits := []
	world.felt.connect(func(hit): hits.append(hit))
	var scene := Node.new()
	for node in [ground, body, world]: scene.add_child(node)
	root.add_child(scene)
	var hz := Engine.physics_ticks_per_second
	var got := 0
	var from := 0.0
	for i in 3 * hz:
		await physics_frame
		if i == hz: from = body.position.x
		while server.get_available_packet_count() > 0:
			server.get_packet()
			if i >= hz: got += 1
	var passed: float = (body.position.x - from) / unit / GRAIN
	var is_right := absf(got - passed) < 0.05 * passed + 2 and passed > 100 and hits.size() <= 1
	print("%s: %s in %dD at %d ticks/s: %d vibrations, %.1f grains passed, %d hits" % ["right" if is_right else "WRONG",
		words[-1], space, hz, got, passed, hits.size()])
	if not is_right: print(hits, world.explain())
	quit(0 if is_right else 1)
