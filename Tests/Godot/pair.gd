# SPDX-License-Identifier: MIT
# A ball of 0.2 kg strikes another of 0.3 kg at 3 m/s, without gravity. Only the second one is felt; the first has
# no HapticBody, or one that only observes. The hit is as strong as (1 + e) v m M / (m + M), on paper.
#   godot --headless -s pair.gd -- space=2|3 hz=60 observed|alone
extends SceneTree

const SPEED := 3.0
const BOUNCE := 0.5


func ball(space: int, x: float, mass: float, speed: float):
	var unit := 100.0 if space == 2 else 1.0
	var made = ClassDB.instantiate("RigidBody%dD" % space)
	var shape = ClassDB.instantiate("CollisionShape%dD" % space)
	shape.shape = CircleShape2D.new() if space == 2 else SphereShape3D.new()
	shape.shape.radius = 0.1 * unit
	made.add_child(shape)
	made.mass = mass
	made.gravity_scale = 0
	made.can_sleep = false
	made.linear_damp_mode = 1
	made.physics_material_override = PhysicsMaterial.new()
	made.physics_material_override.bounce = BOUNCE / 2 # Godot adds both
	made.position = Vector2(x * unit, 300) if space == 2 else Vector3(x, 1, 0)
	made.linear_velocity = Vector2(speed * unit, 0) if space == 2 else Vector3(speed, 0, 0)
	return made


func _initialize():
	var words := OS.get_cmdline_user_args()
	var space := 3 if "space=3" in words else 2
	for word in words: if word.begins_with("hz="): Engine.physics_ticks_per_second = int(word.substr(3))
	var scene := Node.new()
	var struck = ball(space, 2.0, 0.3, 0.0)
	var striker = ball(space, 1.003, 0.2, SPEED)
	struck.add_child(ClassDB.instantiate("HapticBody"))
	if "observed" in words:
		var observer = ClassDB.instantiate("HapticBody")
		observer.felt = false
		striker.add_child(observer)
	var world = ClassDB.instantiate("HapticWorld%dD" % space)
	var hits := []
	world.felt.connect(func(hit): hits.append(hit))
	for node in [struck, striker, world]: scene.add_child(node)
	root.add_child(scene)
	for i in Engine.physics_ticks_per_second: await physics_frame
	var expected := (1 + BOUNCE) * SPEED * 0.2 * 0.3 / (0.2 + 0.3)
	var wrong: float = 100 * (hits[0].strength_n_s / expected - 1) if hits else INF
	var late_ms: float = 1000 * (hits[0].time_s - 0.797 / SPEED) if hits else INF
	var is_right := hits.size() == 1 and absf(wrong) < 2 and absf(late_ms) < 0.5
	print("%s: pair in %dD at %d ticks/s, striker %s: %+.2f ms, %+.2f %%, %d hits" % ["right" if is_right else "WRONG",
		space, Engine.physics_ticks_per_second, words[-1], late_ms, wrong, hits.size()])
	if not is_right: print(hits, world.explain())
	quit(0 if is_right else 1)
