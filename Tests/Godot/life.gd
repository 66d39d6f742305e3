# SPDX-License-Identifier: MIT
# What games do to a world: freed bodies in signals, frozen and sleeping bodies, pause, slow motion, new scenes,
# values that cannot be used. And bodies that move to the bit as they do without the addon.
#   godot --headless -s life.gd
extends "checks.gd"


# A floor and ten boxes that fall on it, and turn.
func scene_of(is_haptic: bool) -> Node:
	var scene := Node.new()
	scene.add_child(box("StaticBody2D", Vector2(500, 600), Vector2(1000, 20)))
	for i in 10:
		var falls = box("RigidBody2D", Vector2(100 + 80 * i, 300 - 20 * i), Vector2(40, 40))
		falls.rotation = 0.1 * i
		if is_haptic: falls.add_child(ClassDB.instantiate("HapticBody"))
		scene.add_child(falls)
	if is_haptic:
		var world = ClassDB.instantiate("HapticWorld2D")
		world.name = "World"
		scene.add_child(world)
	return scene


func ticks(count: int):
	for i in count: await physics_frame


func places(scene: Node) -> Array:
	return scene.get_children().filter(func(node): return node is RigidBody2D).map(
		func(body): return [body.position, body.rotation, body.linear_velocity])


func run(is_haptic: bool, act: Callable) -> Dictionary:
	var scene := scene_of(is_haptic)
	var hits := []
	if is_haptic: scene.get_node("World").felt.connect(func(hit): hits.append(hit.strength_n_s))
	root.add_child(scene)
	await act.call(scene)
	var result := {"places": places(scene), "hits": hits.duplicate()}
	scene.free()
	await ticks(2)
	return result


func _initialize():
	var wait := func(_scene): await ticks(90)
	await ticks(2) # the first scene would begin within a tick
	var plain := await run(false, wait)
	var again := await run(false, wait)
	check(plain.places == again.places, "ten boxes move alike twice, without the addon")
	var haptic := await run(true, wait)
	check(plain.places == haptic.places, "ten boxes move as without the addon, to the bit")
	check(haptic.hits.size() >= 10, "%d hits of ten boxes" % haptic.hits.size())

	var freed := await run(true, func(scene):
		scene.get_node("World").felt.connect(func(hit): if is_instance_valid(hit.body): hit.body.free())
		await ticks(90))
	check(freed.places.is_empty(), "each box is freed by its first hit")

	await run(true, func(scene):
		scene.get_node("World").felt.connect(func(_hit): if scene.has_node("World"): scene.get_node("World").queue_free())
		await ticks(90))
	check(true, "a world is freed by its own signal")

	var frozen := await run(true, func(scene):
		for body in scene.get_children(): if body is RigidBody2D: body.freeze = true
		await ticks(90))
	check(frozen.hits.is_empty(), "frozen boxes hit nothing")

	var still := await run(true, func(_scene):
		await ticks(10)
		paused = true
		await ticks(90))
	check(still.hits.is_empty(), "a paused game hits nothing")
	paused = false

	var slow := await run(true, func(scene):
		Engine.time_scale = 0.5
		await ticks(180)
		check(absf(scene.get_node("World").time_s() - 1.5) < 0.03, "time passes half as fast in slow motion"))
	Engine.time_scale = 1.0
	check(slow.hits.size() >= 10, "%d hits in slow motion" % slow.hits.size())

	var rest := await run(true, func(_scene):
		await ticks(600))
	check(rest.hits.size() < 60, "%d hits until ten boxes sleep" % rest.hits.size())

	var node = ClassDB.instantiate("HapticWorld2D")
	node.level_db = NAN
	node.threshold_m_per_s = -5.0
	node.metres_per_unit = INF
	check(node.level_db == -12.0 and node.metres_per_unit == 0.01, "what cannot be used changes nothing")
	check(node.threshold_m_per_s == 0.15, "nor does what is out of range")
	node.free()
	for i in 30: await run(true, func(_scene): await ticks(3))
	check(true, "thirty scenes came and went")
	print("%d wrong" % wrong)
	quit(1 if wrong else 0)
