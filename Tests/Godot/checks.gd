# SPDX-License-Identifier: MIT
# What several scripts here share: a count of what is wrong, and a body with one rectangle.
extends SceneTree

var wrong := 0


func check(is_right: bool, what: String):
	if not is_right: wrong += 1
	print("%s: %s" % ["right" if is_right else "WRONG", what])


func box(kind: String, at: Vector2, size: Vector2):
	var made = ClassDB.instantiate(kind)
	var shape := CollisionShape2D.new()
	shape.shape = RectangleShape2D.new()
	shape.shape.size = size
	made.add_child(shape)
	made.position = at
	return made
