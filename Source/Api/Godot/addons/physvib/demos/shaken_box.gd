# SPDX-License-Identifier: MIT
# A box of balls that shakes: play, and hold a controller. The arrow keys or the left stick push the balls.
extends Node2D

const FIELD := Rect2(200, 100, 700, 450)
var push := Vector2.ZERO


func _ready():
	RenderingServer.set_default_clear_color(Color("22223b"))
	for wall in [Rect2(200, 80, 700, 20), Rect2(200, 550, 700, 20), Rect2(180, 80, 20, 490), Rect2(900, 80, 20, 490)]:
		add_child(body(StaticBody2D.new(), rectangle(wall.size), wall.get_center()))
	for i in 6:
		var circle := CircleShape2D.new()
		circle.radius = 18 + 4 * i
		var ball: RigidBody2D = body(RigidBody2D.new(), circle, FIELD.position + Vector2(80 + 100 * i, 120))
		ball.mass = 0.05 * (i + 1)
		ball.can_sleep = false
		var felt := HapticBody.new()
		felt.material = HapticMaterial.new()
		felt.material.frequency_hz = 250 - 25 * i # the heavier, the lower
		ball.add_child(felt)
		add_child(ball)


func body(made: PhysicsBody2D, shape: Shape2D, at: Vector2) -> PhysicsBody2D:
	var collision := CollisionShape2D.new()
	collision.shape = shape
	made.add_child(collision)
	made.position = at
	made.physics_material_override = PhysicsMaterial.new()
	made.physics_material_override.bounce = 0.3
	return made


func rectangle(size: Vector2) -> RectangleShape2D:
	var shape := RectangleShape2D.new()
	shape.size = size
	return shape


func _physics_process(_delta):
	push = Input.get_vector("ui_left", "ui_right", "ui_up", "ui_down")
	for child in get_children():
		if child is RigidBody2D: child.apply_central_force(push * 2000 * child.mass)
	queue_redraw()


func _on_felt(hit: Dictionary):
	print("%.3f N s at %s" % [hit.strength_n_s, hit.position])


func _draw():
	draw_rect(FIELD, Color("4a4e69"), false, 6)
	for child in get_children():
		if child is RigidBody2D: draw_circle(child.position, child.get_child(0).shape.radius, Color("81b29a"), true, -1, true)
