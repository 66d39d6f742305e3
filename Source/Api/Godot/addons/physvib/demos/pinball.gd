# SPDX-License-Identifier: MIT
# A pinball of 1.1 m. Flippers, plunger, bumpers and slingshots move as their solenoids would, so how hard each of them
# strikes the ball is felt as it is; ramps hum. Left and right arrow, or a controller's shoulders, move the flippers;
# holding the down arrow, or A, draws the plunger. Who does nothing for ten seconds is played by the computer. On four
# actuators of a cabinet as well: add their sound device, such as JACK:system, to `outputs` of the HapticWorld2D.
extends Node2D

const TABLE := Rect2(336, 14, 480, 634)
const MIDDLE := 554.0 # of what is left of the plunger's lane
const LANE := Vector2(791, 596) # top of the plunger
const RADIUS := 10.0 # of the ball
const TICKS := 240 # a second; a flipper's tip moves by 5 pixels in each
const COLOURS := {"wall": Color("9a8c98"), "flipper": Color("e07a5f"), "bumper": Color("f2cc8f"), "slingshot": Color("81b29a"),
	"ramp": Color("5fa8d3"), "plunger": Color("b8a9c9")}
const VOICES := {"wall": 240, "flipper": 70, "bumper": 110, "slingshot": 150, "ramp": 200, "plunger": 60} # Hz
const POINTS := {"bumper": 500, "slingshot": 100, "ramp": 5000}
var ball: RigidBody2D
var flippers := [] # left, right
var kickers := {} # body: where it rests, how far it has to go, and which way
var ramps := [] # the path of each
var ridden := -1 # number of the ramp that the ball is on
var outline := PackedVector2Array() # of the table
var plunger: AnimatableBody2D
var drawn := 0.0 # of the plunger, pixels
var score := 0
var lamps := 0 # that are lit: one more after each ramp
var balls := 1
var idle := INF # s since somebody pressed something
var held := [0.0, 0.0] # s for which the computer still holds a flipper
var draws := false # the computer draws the plunger
var still := 0.0 # s for which the ball has hardly moved
var rings := [] # hits that are still seen: place, amplitude, colour, age in s
var felt := [] # the last hits: strength in N s, colour
var before := 60 # ticks a second


func _ready():
	RenderingServer.set_default_clear_color(Color("22223b"))
	before = Engine.physics_ticks_per_second
	Engine.physics_ticks_per_second = TICKS
	var top := TABLE.position.y + 6
	var left := TABLE.position.x + 6
	var right := TABLE.end.x - 6
	outline.append(Vector2(left, 660))
	outline.append_array(arc(Vector2(left + 130, top + 130), 130, PI, 1.5 * PI))
	outline.append_array(arc(Vector2(right - 130, top + 130), 130, 1.5 * PI, TAU))
	outline.append(Vector2(right, 660))
	wall(outline, 12, "wall")
	wall([Vector2(774, 660), Vector2(774, 190)], 8, "wall")
	var gate := wall([Vector2(774, 176), Vector2(806, 136)], 6, "wall") # which lets the ball out of the lane, and not in
	gate.get_child(0).one_way_collision = true
	gate.get_child(0).rotation += PI if gate.get_child(0).global_transform.y.y < 0 else 0.0
	for side in [-1, 1]:
		var at := func(x: float, y: float): return Vector2(MIDDLE + side * x, y)
		wall([at.call(182, 432), at.call(182, 502), at.call(90, 555)], 8, "wall")
		flippers.append(polygon(AnimatableBody2D.new(), flipper(side), at.call(84, 562), "flipper"))
		var sling := polygon(AnimatableBody2D.new(), PackedVector2Array([Vector2(side * 20, -46), Vector2(side * 20, 22), Vector2(side * -22, 46)]),
			at.call(126, 482), "slingshot")
		kickers[sling] = [sling.position, 0.0, Vector2(-side * 0.9, -0.44)]
		var path := PackedVector2Array([at.call(86, 345)])
		for point in arc(Vector2(126, 175), 40, PI, TAU): path.append(at.call(point.x, point.y))
		path.append(at.call(166, 408))
		ramps.append(path)
		for beside in [-16, 16]:
			var rail := aside(path, beside)
			rail.insert(0, rail[0] + Vector2(signf(rail[0].x - path[0].x) * 14, 26)) # the mouth
			var made := wall(rail, 4, "ramp")
			made.collision_layer = 2
			made.collision_mask = 0
	for place in [Vector2(MIDDLE, 135), Vector2(MIDDLE - 42, 210), Vector2(MIDDLE + 42, 210)]:
		var round := PackedVector2Array(arc(Vector2.ZERO, 21, 0, TAU).slice(0, -1))
		var bumper := polygon(AnimatableBody2D.new(), round, place, "bumper")
		kickers[bumper] = [place, 0.0, Vector2.ZERO]
	plunger = polygon(AnimatableBody2D.new(), PackedVector2Array([Vector2(-11, 0), Vector2(11, 0), Vector2(11, 60), Vector2(-11, 60)]), LANE, "plunger")
	ball = RigidBody2D.new()
	ball.add_child(CollisionShape2D.new())
	ball.get_child(0).shape = CircleShape2D.new()
	ball.get_child(0).shape.radius = RADIUS
	ball.mass = 0.08
	ball.gravity_scale = 0.63 # 6.5 degrees of slope
	ball.can_sleep = false
	ball.linear_damp_mode = RigidBody2D.DAMP_MODE_REPLACE
	ball.physics_material_override = material(0.5)
	ball.add_child(HapticBody.new())
	ball.get_child(1).felt = false # it is only observed, so that all others feel it
	ball.position = LANE - Vector2(0, RADIUS + 1)
	add_child(ball)


func _exit_tree():
	Engine.physics_ticks_per_second = before


func arc(centre: Vector2, radius: float, from: float, to: float) -> PackedVector2Array:
	var count := ceili(absf(to - from) / 0.05) # so fine that a ball which rolls along it is not felt
	var points := PackedVector2Array()
	for i in count + 1: points.append(centre + radius * Vector2.from_angle(lerpf(from, to, float(i) / count)))
	return points


# The path's right side as one goes along it, or its left one.
func aside(path: PackedVector2Array, far: float) -> PackedVector2Array:
	var points := PackedVector2Array()
	for i in path.size():
		var way := (path[mini(i + 1, path.size() - 1)] - path[maxi(0, i - 1)]).normalized()
		points.append(path[i] + far * way.orthogonal())
	return points


func flipper(side: int) -> PackedVector2Array:
	var points := arc(Vector2.ZERO, 10, 0.52 * PI, 1.48 * PI) # as the tangents of both ends have it
	points.append_array(arc(Vector2(66, 0), 6, -0.48 * PI, 0.48 * PI))
	for i in points.size(): points[i].x *= -side
	return points


func material(bounce: float) -> PhysicsMaterial:
	var made := PhysicsMaterial.new()
	made.bounce = bounce
	made.friction = 0.1
	return made


func feel(made: PhysicsBody2D, kind: String):
	var haptic := HapticBody.new()
	haptic.material = HapticMaterial.new()
	haptic.material.frequency_hz = VOICES[kind]
	if kind == "ramp": haptic.material.grain_m = 0.01
	made.add_child(haptic)
	made.set_meta("kind", kind)
	made.physics_material_override = material(0.0)
	add_child(made)


func wall(points: PackedVector2Array, width: float, kind: String) -> StaticBody2D:
	var made := StaticBody2D.new()
	for i in points.size() - 1:
		var shape := CollisionShape2D.new()
		shape.shape = CapsuleShape2D.new()
		shape.shape.radius = width / 2
		shape.shape.height = points[i].distance_to(points[i + 1]) + width
		shape.position = (points[i] + points[i + 1]) / 2
		shape.rotation = (points[i + 1] - points[i]).angle() - PI / 2
		made.add_child(shape)
	made.set_meta("points", points)
	made.set_meta("width", width)
	feel(made, kind)
	return made


func polygon(made: AnimatableBody2D, points: PackedVector2Array, at: Vector2, kind: String) -> AnimatableBody2D:
	var shape := CollisionShape2D.new()
	shape.shape = ConvexPolygonShape2D.new()
	shape.shape.points = points
	made.add_child(shape)
	made.sync_to_physics = false
	made.position = at
	made.set_meta("points", points)
	feel(made, kind)
	return made


func _physics_process(delta):
	idle += delta
	var wanted := [0.0, 0.0, 0.0] # left, right, plunger
	for i in 3:
		var keys: Array = [["ui_left", JOY_BUTTON_LEFT_SHOULDER], ["ui_right", JOY_BUTTON_RIGHT_SHOULDER], ["ui_down", JOY_BUTTON_A]][i]
		wanted[i] = float(Input.is_action_pressed(keys[0]) or Input.is_joy_button_pressed(0, keys[1]))
		if wanted[i]: idle = 0.0
	if idle > 10: wanted = by_computer(delta)
	for i in 2:
		var side := -1 if i == 0 else 1
		var angle := move_toward(side * flippers[i].rotation, 0.5 if wanted[i] else -0.5, (20 if wanted[i] else 12) * delta)
		flippers[i].rotation = side * angle
	drawn = minf(40, drawn + 50 * delta) if wanted[2] else drawn
	# A spring drives it back, the faster the farther it was drawn.
	plunger.position.y = move_toward(plunger.position.y, LANE.y + (drawn if wanted[2] else 0.0), (60.0 if wanted[2] else 400 + 26 * drawn) * delta)
	if not wanted[2] and plunger.position.y == LANE.y: drawn = 0.0
	for kicker in kickers: # 12 pixels at 2.2 m/s, and back
		var its: Array = kickers[kicker]
		its[1] = maxf(-1, its[1] - delta / 0.01)
		kicker.position = kicker.position.move_toward(its[0] + (12 * its[2] if its[1] > 0 else Vector2.ZERO), (1200 if its[1] > 0 else 200) * delta)
	ride()
	still = still + delta if ball.linear_velocity.length() < 15 and not in_lane() and not (wanted[0] or wanted[1]) else 0.0
	if ball.position.y > 660 or still > 2:
		balls += 1
		ridden = -1
		ball.collision_mask = 1
		ball.global_transform.origin = LANE - Vector2(0, RADIUS + 1) # a new `position` alone does not reach the physics (godot 94633)
		ball.linear_velocity = Vector2.ZERO
		ball.angular_velocity = 0
	for ring in rings: ring[3] += delta
	rings = rings.filter(func(ring): return ring[3] < 0.5)
	queue_redraw()


func in_lane() -> bool:
	return ball.position.x > 778 and ball.position.y > 200


# A ramp lies above the table: who enters it from below leaves the table's bodies, and meets its rails.
func ride():
	if ridden < 0:
		for i in 2:
			var mouth: Vector2 = ramps[i][0]
			if absf(ball.position.x - mouth.x) < 12 and absf(ball.position.y - mouth.y - 14) < 6 and ball.linear_velocity.y < -300: ridden = i
	else:
		var path: PackedVector2Array = ramps[ridden]
		var is_back := absf(ball.position.x - path[0].x) < 30 and ball.position.y > path[0].y + 26
		var is_through := ball.position.y > path[-1].y
		if is_through:
			gain("ramp", path[-1])
			lamps = lamps % 5 + 1
		if is_back or is_through: ridden = -1
	ball.collision_mask = 1 if ridden < 0 else 2


func by_computer(delta: float) -> Array:
	var wanted := [0.0, 0.0, 0.0]
	for i in 2:
		var side := -1 if i == 0 else 1
		held[i] -= delta
		var to: Vector2 = ball.position - flippers[i].position
		var far := -side * to.x
		var aim := 44 + 18 * sin(7 * balls + score / 170.0) # where on the flipper it likes the ball
		if far > aim - 12 and far < 80 and to.y > far * 0.5 - 34 and to.y < 40 and held[i] < -0.2: held[i] = 0.18
		wanted[i] = float(held[i] > 0)
	if in_lane() and ball.linear_velocity.length() < 60 and drawn == 0: draws = true
	if drawn > 31 + 5 * sin(2.0 * balls): draws = false
	wanted[2] = float(draws)
	return wanted


func gain(kind: String, at: Vector2):
	score += POINTS.get(kind, 0)
	if kind == "ramp": rings.append([at, 1.0, COLOURS.ramp, 0.0])


func _on_felt(hit: Dictionary):
	if hit.body == null: return
	var kind: String = hit.body.get_meta("kind")
	rings.append([hit.position, clampf(hit.amplitude, 0.1, 1), COLOURS[kind], 0.0])
	felt.append([hit.strength_n_s, COLOURS[kind]])
	if felt.size() > 24: felt.pop_front()
	if not kickers.has(hit.body) or kickers[hit.body][1] > -1: return
	gain(kind, hit.position)
	var its: Array = kickers[hit.body]
	its[1] = 1.0
	if kind == "bumper": its[2] = (ball.position - its[0]).normalized().rotated(0.4 * sin(score)) # so that it does not come back


func _draw():
	draw_colored_polygon(outline, Color("2b2d4a"))
	for i in 5:
		var at := Vector2(MIDDLE, 470) + 110 * Vector2.from_angle(-PI / 2 + 0.32 * (i - 2))
		draw_circle(at, 9, Color(COLOURS.bumper, 0.9 if i < lamps else 0.25), true, -1, true)
	for path in ramps: for i in 3: # where to aim
		var tip: Vector2 = path[0] + Vector2(0, 44 + 22 * i)
		draw_colored_polygon([tip, tip + Vector2(-8, 14), tip + Vector2(8, 14)], Color(COLOURS.ramp, 0.5 - 0.13 * i))
	for child in get_children():
		if child.has_meta("kind") and child.collision_layer != 2: draw_body(child)
	if ridden < 0: draw_ball(1.0)
	for path in ramps:
		draw_set_transform(Vector2(5, 7))
		draw_polyline(path, Color(0, 0, 0, 0.25), 34, true)
		draw_set_transform(Vector2.ZERO)
		draw_polyline(path, Color(COLOURS.ramp, 0.3), 28, true)
	for child in get_children():
		if child.has_meta("kind") and child.collision_layer == 2: draw_body(child)
	if ridden >= 0: draw_ball(1.2)
	for ring in rings:
		var age: float = ring[3] / 0.5
		draw_arc(ring[0], 10 + 60 * ring[1] * age, 0, TAU, 48, Color(ring[2], 1 - age), 4 * (1 - age) + 1, true)
	write(Vector2(48, 90), "%06d" % score, 56, "f2e9e4")
	write(Vector2(50, 130), "ball %d" % balls, 24, "9a8c98")
	write(Vector2(50, 580), "left, right: flippers", 20, "9a8c98")
	write(Vector2(50, 610), "down: plunger", 20, "9a8c98")
	write(Vector2(860, 390), "%.2f N s" % (felt[-1][0] if felt else 0.0), 24, "9a8c98")
	draw_line(Vector2(860, 612), Vector2(1100, 612), Color("4a4e69"), 2)
	for i in felt.size():
		var high: float = clampf(400 * felt[i][0], 2, 200)
		draw_rect(Rect2(860 + 10 * i, 610 - high, 7, high), felt[i][1])


func write(at: Vector2, text: String, size: int, colour: String):
	draw_string(ThemeDB.fallback_font, at, text, HORIZONTAL_ALIGNMENT_LEFT, -1, size, Color(colour))


func draw_body(child: Node2D):
	var points: PackedVector2Array = child.get_meta("points")
	var kind: String = child.get_meta("kind")
	var colour: Color = COLOURS[kind]
	if child.has_meta("width"):
		draw_polyline(points, colour, child.get_meta("width"), true)
		for point in [points[0], points[-1]]: draw_circle(point, child.get_meta("width") / 2, colour, true, -1, true)
		return
	if kickers.has(child): colour = colour.lerp(Color.WHITE, 0.6 * clampf(kickers[child][1] + 1, 0, 1))
	draw_set_transform(child.position, child.rotation)
	draw_colored_polygon(points, colour)
	draw_polyline(points + PackedVector2Array([points[0]]), colour, 2, true)
	if kind == "bumper":
		draw_circle(Vector2.ZERO, 14, Color("22223b"), true, -1, true)
		draw_circle(Vector2.ZERO, 10, colour, true, -1, true)
	draw_set_transform(Vector2.ZERO)


func draw_ball(size: float):
	draw_circle(ball.position + 4 * size * Vector2.ONE, RADIUS * size, Color(0, 0, 0, 0.3), true, -1, true)
	draw_circle(ball.position, RADIUS * size, Color("f2e9e4"), true, -1, true)
	draw_circle(ball.position - 3 * size * Vector2.ONE, 2.5 * size, Color.WHITE, true, -1, true)
