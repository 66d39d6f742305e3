# SPDX-License-Identifier: MIT
# A ball of 0.2 kg falls from 0.8 m and bounces, by the motion that paper has: the hit is at
# t = sqrt(2 h / g), as strong as m v (1 + e). Prints a row of a table: the first hit's error in ms and %, and
# how many of the bounces were told.
#   godot --headless -s bounce.gd -- space=2|3 hz=60
extends SceneTree

const MASS := 0.2
const HEIGHT := 0.8
const RADIUS := 0.1
const BOUNCE := 0.5
const SURE := 0.95 # s
var hz := 60
var space := 2
var is_box := false
var hits := []
var ticks := 0
var world
var ball
var before := 0.0
var bounces := 0
var engine := "GodotPhysics2D"


func _initialize():
	for argument in OS.get_cmdline_user_args():
		if argument.begins_with("hz="): hz = int(argument.substr(3))
		if argument == "box": is_box = true
		if argument.begins_with("space="): space = int(argument.substr(6))
	if space == 3: engine = ProjectSettings.get_setting("physics/3d/physics_engine")
	Engine.physics_ticks_per_second = hz
	var scene := Node.new()
	root.add_child(scene)
	world = ClassDB.instantiate("HapticWorld%dD" % space)
	world.felt.connect(func(hit): hits.append(hit))
	scene.add_child(world)
	scene.add_child(body("StaticBody", 0.0, BOUNCE))
	ball = body("RigidBody", HEIGHT + RADIUS, 0.0)
	ball.mass = MASS
	ball.can_sleep = false
	ball.linear_damp_mode = 1
	ball.add_child(ClassDB.instantiate("HapticBody"))
	# Godot adds gravity to the speed before it moves: half a tick's less, and the ball is on the parabola.
	ball.linear_velocity = (at(9.8 / hz / 2) - at(0))
	scene.add_child(ball)


func at(height: float):
	return Vector2(500, 500 - 100 * height) if space == 2 else Vector3(0, height, 0)


func body(kind: String, height: float, bounce: float):
	var made = ClassDB.instantiate("%s%dD" % [kind, space])
	var shape = ClassDB.instantiate("CollisionShape%dD" % space)
	if kind == "RigidBody" and is_box: # it lands flat, on all of its corners
		shape.shape = RectangleShape2D.new() if space == 2 else BoxShape3D.new()
		shape.shape.size = Vector2.ONE * 200 * RADIUS if space == 2 else Vector3.ONE * 2 * RADIUS
	elif kind == "RigidBody":
		shape.shape = CircleShape2D.new() if space == 2 else SphereShape3D.new()
		shape.shape.radius = RADIUS * (100 if space == 2 else 1)
	else:
		shape.shape = RectangleShape2D.new() if space == 2 else BoxShape3D.new()
		shape.shape.size = Vector2(1000, 200) if space == 2 else Vector3(10, 2, 10)
		height -= 1.0
	made.add_child(shape)
	made.position = at(height)
	made.physics_material_override = PhysicsMaterial.new()
	made.physics_material_override.bounce = bounce
	return made


func _physics_process(_delta):
	ticks += 1
	var speed: float = -ball.linear_velocity.y / 100 if space == 2 else ball.linear_velocity.y
	if speed > before + 1.0 and ticks < hz * SURE + 2: bounces += 1
	before = speed
	if ticks < hz * 1.2: return false
	var seconds := sqrt(2 * HEIGHT / 9.8)
	var strength := MASS * 9.8 * seconds * (1 + BOUNCE)
	var late_ms: float = 1000 * (hits[0].time_s - seconds) if hits else INF
	var wrong: float = 100 * (hits[0].strength_n_s / strength - 1) if hits else INF
	# Godot's 3D engine says no depth beyond the ball's radius, which it passes at 30 ticks.
	var allowed_ms := 5.1 if engine == "GodotPhysics3D" and hz == 30 else 0.5
	# The bounces that the ball's speed shows while they are clearly above the threshold, and none told twice.
	var sure: int = hits.filter(func(hit): return hit.time_s < SURE).size()
	var twice := 0
	for i in range(1, hits.size()): if hits[i].time_s - hits[i - 1].time_s < 0.03: twice += 1
	var is_right: bool = absf(late_ms) < allowed_ms and absf(wrong) < 2 and sure == bounces and bounces > 1 and twice == 0
	print("| %s | %d | %+.2f | %+.2f | %d of %d | %s |" % [engine, hz, late_ms, wrong, sure, bounces,
		"right" if is_right else "WRONG: " + world.explain()])
	quit(0 if is_right else 1)
	return true
