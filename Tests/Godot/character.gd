# SPDX-License-Identifier: MIT
# A CharacterBody falls on a floor as its script moves it, stands, runs against a wall and stands there. Two hits:
# as strong as mass times speed of that tick, with the time of the meeting within the tick.
#   godot --headless -s character.gd -- space=2|3 hz=60
extends SceneTree

const MASS := 70.0
const RUN := 3.0
var space := 2
var hits := []
var character
var ticks := 0
var world
var landed := 0.0 # s
var fallen := 0.0 # m/s, before the tick that lands


func _initialize():
	for word in OS.get_cmdline_user_args():
		if word.begins_with("hz="): Engine.physics_ticks_per_second = int(word.substr(3))
		if word.begins_with("space="): space = int(word.substr(6))
	var scene := Node.new()
	root.add_child(scene)
	world = ClassDB.instantiate("HapticWorld%dD" % space)
	world.felt.connect(func(hit): hits.append(hit))
	scene.add_child(world)
	scene.add_child(box("StaticBody", vector(0, -1), vector(20, 2))) # its top is at 0
	scene.add_child(box("StaticBody", vector(4, 2), vector(1, 4))) # its side is at 3.5
	character = box("CharacterBody", vector(0, 1.5), vector(1, 1)) # 1 m above the floor
	var haptic = ClassDB.instantiate("HapticBody")
	haptic.static_mass_kg = MASS
	character.add_child(haptic)
	scene.add_child(character)


func vector(x: float, y: float):
	return 100 * Vector2(x, -y) if space == 2 else Vector3(x, y, 0)


func box(kind: String, at, size):
	var made = ClassDB.instantiate("%s%dD" % [kind, space])
	var shape = ClassDB.instantiate("CollisionShape%dD" % space)
	shape.shape = ClassDB.instantiate("RectangleShape2D" if space == 2 else "BoxShape3D")
	shape.shape.size = size.abs() if space == 2 else Vector3(size.x, size.y, 20 if size.x > 1 else 1)
	made.add_child(shape)
	made.position = at
	return made


func _physics_process(delta: float):
	ticks += 1
	var seconds := ticks * delta
	character.velocity += vector(0, -9.8 * delta)
	if seconds > 1: character.velocity = vector(RUN, -9.8 * delta)
	var falling: float = character.velocity.length() * (0.01 if space == 2 else 1.0)
	var height: float = (-character.position.y / 100 if space == 2 else character.position.y) - 0.5
	character.move_and_slide()
	if fallen == 0 and character.is_on_floor():
		fallen = falling
		landed = seconds - delta + height / falling # within the tick it moves straight on
	if seconds < 3: return false
	var expected := [MASS * fallen, MASS * RUN]
	var wrong := [INF, INF]
	for i in mini(2, hits.size()): wrong[i] = 100 * (hits[i].strength_n_s / expected[i] - 1)
	var late_ms: float = 1000 * (hits[0].time_s - landed) if hits else INF
	var is_right: bool = hits.size() == 2 and absf(wrong[0]) < 2 and absf(wrong[1]) < 2 and absf(late_ms) < 0.5
	print("%s: character in %dD at %d ticks/s: %d hits, landing %+.2f ms, %+.2f %%, wall %+.2f %%" % [
		"right" if is_right else "WRONG", space, Engine.physics_ticks_per_second, hits.size(), late_ms, wrong[0], wrong[1]])
	if not is_right: print(hits, world.explain())
	quit(0 if is_right else 1)
	return true
