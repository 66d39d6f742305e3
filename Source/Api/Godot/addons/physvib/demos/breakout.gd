# SPDX-License-Identifier: MIT
# Breakout for two. Each player feels the own paddle on the own controller,
# and bricks, softly, both. Arrow keys or the first controller below, A and D or the second above; who does
# nothing is played by the computer.
extends Node2D

const SIZE := Vector2(1152, 648)
const SPEED := 420.0
const COLOURS := [Color("e07a5f"), Color("f2cc8f"), Color("81b29a"), Color("5fa8d3")]
var ball: RigidBody2D
var paddles := []
var played := [false, false]
var glow := [0.0, 0.0]
var scores := [0, 0]
var last := 0 # who struck the ball


func _ready():
	RenderingServer.set_default_clear_color(Color("22223b"))
	for x in [-10, SIZE.x + 10]: body(StaticBody2D.new(), Vector2(20, SIZE.y), Vector2(x, SIZE.y / 2))
	for i in 2:
		paddles.append(body(AnimatableBody2D.new(), Vector2(150, 18), Vector2(SIZE.x / 2, SIZE.y - 40 if i == 0 else 40.0)))
		feel(paddles[i], 1.0, i)
	for row in 4:
		for column in 12:
			var brick := body(StaticBody2D.new(), Vector2(80, 26), Vector2(92 + 88 * column, 273 + 34 * row))
			brick.set_meta("colour", COLOURS[row])
			feel(brick, 0.3, -1)
	ball = body(RigidBody2D.new(), Vector2(20, 20), Vector2(SIZE.x / 2, 500))
	ball.gravity_scale = 0
	ball.mass = 0.1
	ball.linear_velocity = Vector2(0.4, 1) * SPEED
	ball.lock_rotation = true
	feel(ball, 1.0, -1)
	ball.get_child(1).felt = false # it is only observed, so that paddles and bricks feel it


func body(made: PhysicsBody2D, size: Vector2, at: Vector2) -> PhysicsBody2D:
	made.add_child(CollisionShape2D.new())
	made.get_child(0).shape = RectangleShape2D.new()
	made.get_child(0).shape.size = size
	made.position = at
	made.physics_material_override = PhysicsMaterial.new()
	made.physics_material_override.friction = 0
	made.physics_material_override.bounce = 1 if made is RigidBody2D else 0
	add_child(made)
	return made


func feel(made: PhysicsBody2D, gain: float, controller: int):
	var haptic := HapticBody.new()
	haptic.gain = gain
	haptic.controller = controller
	haptic.material = HapticMaterial.new()
	haptic.material.frequency_hz = 90 if controller >= 0 else 220
	made.add_child(haptic)


func _physics_process(delta):
	for i in 2:
		var way := Input.get_joy_axis(i, JOY_AXIS_LEFT_X)
		if i == 0: way += Input.get_axis("ui_left", "ui_right")
		else: way += float(Input.is_key_pressed(KEY_D)) - float(Input.is_key_pressed(KEY_A))
		if absf(way) > 0.2: played[i] = true
		elif not played[i]: way = clampf((ball.position.x + 30 * sin(ball.position.y) - paddles[i].position.x) / 40, -1, 1)
		paddles[i].position.x = clampf(paddles[i].position.x + 520 * way * delta, 75, SIZE.x - 75)
		glow[i] = move_toward(glow[i], 0, 3 * delta)
	if ball.position.y < 0 or ball.position.y > SIZE.y:
		ball.global_transform.origin = Vector2(SIZE.x / 2, 500 if ball.position.y > SIZE.y else 150) # godot 94633
		ball.linear_velocity = Vector2(0.4, 1)
	var steep := 0.4 * SPEED
	if absf(ball.linear_velocity.y) < steep: ball.linear_velocity.y = steep * (1 if ball.linear_velocity.y >= 0 else -1)
	ball.linear_velocity = ball.linear_velocity.normalized() * SPEED
	queue_redraw()


func _on_felt(hit: Dictionary):
	if hit.body in paddles:
		last = paddles.find(hit.body)
		glow[last] = 1.0
	elif hit.body != null:
		scores[last] += 1
		hit.body.queue_free()


func _draw():
	for child in get_children():
		if not child is PhysicsBody2D: continue
		var size: Vector2 = child.get_child(0).shape.size
		var colour: Color = child.get_meta("colour", Color("f2e9e4"))
		if child in paddles: colour = colour.lerp(Color("ffb703"), glow[paddles.find(child)])
		draw_rect(Rect2(child.position - size / 2, size), colour)
	for i in 2: draw_string(ThemeDB.fallback_font, Vector2(24, SIZE.y - 24 if i == 0 else 44.0), str(scores[i]), HORIZONTAL_ALIGNMENT_LEFT, -1, 28, Color("9a8c98"))
