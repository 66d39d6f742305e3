# SPDX-License-Identifier: MIT
# Time per tick of many boxes that rest on a floor, each touching it alone: without the addon, and with a HapticBody
# on each. Prints one row of a table, in ms per tick; it fails only if the boxes do not stay awake.
#   godot --headless -s cost.gd --fixed-fps 60 -- space=2|3
extends SceneTree

const SETTLE := 60
const TICKS := 120
var space := 2


func vector(x: float, y: float, z := 0.0):
	return 100 * Vector2(x, -y) if space == 2 else Vector3(x, y, z)


func box(kind: String, at, size):
	var made = ClassDB.instantiate("%s%dD" % [kind, space])
	var shape = ClassDB.instantiate("CollisionShape%dD" % space)
	shape.shape = ClassDB.instantiate("RectangleShape2D" if space == 2 else "BoxShape3D")
	shape.shape.size = size
	made.add_child(shape)
	made.position = at
	return made


# The fastest of ten stretches: whatever else the machine does makes some slower.
func milliseconds(count: int, is_haptic: bool) -> float:
	var scene := Node.new()
	scene.add_child(box("StaticBody", vector(0, -1, 0), Vector2(400000, 200) if space == 2 else Vector3(200, 2, 200)))
	for i in count:
		var at = vector(1.5 * (i - count / 2.0), 0.5) if space == 2 else vector(1.5 * (i % 32 - 16), 0.5, 1.5 * (i / 32 - 16))
		var falls = box("RigidBody", at, Vector2.ONE * 100 if space == 2 else Vector3.ONE)
		falls.can_sleep = false
		if is_haptic: falls.add_child(ClassDB.instantiate("HapticBody"))
		scene.add_child(falls)
	if is_haptic: scene.add_child(ClassDB.instantiate("HapticWorld%dD" % space))
	root.add_child(scene)
	for i in SETTLE: await physics_frame
	var best := INF
	for i in 10:
		var begin := Time.get_ticks_usec()
		for j in TICKS / 10: await physics_frame
		best = minf(best, (Time.get_ticks_usec() - begin) * 0.001 / (TICKS / 10))
	scene.free()
	await physics_frame
	return best


func _initialize():
	if "space=3" in OS.get_cmdline_user_args(): space = 3
	var engine: String = ProjectSettings.get_setting("physics/3d/physics_engine") if space == 3 else "GodotPhysics2D"
	if engine == "DEFAULT": engine = "GodotPhysics3D"
	var row := "| %s |" % engine
	for count in [10, 100, 1000]:
		var plain := await milliseconds(count, false)
		var haptic := await milliseconds(count, true)
		row += " %.2f / %.2f |" % [plain, haptic]
	print(row)
	quit()
