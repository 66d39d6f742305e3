# SPDX-License-Identifier: MIT
# The demos that are games, played by themselves for a minute: the pinball's hits against what the solver did to its
# ball, each of its parts felt, no ball lost through a wall; breakout serves a ball that is lost.
#   godot --headless -s games.gd --fixed-fps 60
extends "checks.gd"


func pinball():
	var demo = load("res://addons/physvib/demos/pinball.tscn").instantiate()
	root.add_child(demo)
	var world = demo.get_node("HapticWorld2D")
	var hits := []
	world.felt.connect(func(hit): hits.append([hit.time_s, hit.strength_n_s, hit.body.get_meta("kind")]))
	var changes := [] # when, N s
	var last := Vector2.ZERO
	var rides := 0
	var outside := 0
	for i in 60 * demo.TICKS:
		var ridden: int = demo.ridden
		var ball: int = demo.balls
		await physics_frame
		var slow := Vector2(0, 980 * demo.ball.gravity_scale / demo.TICKS)
		var change: float = demo.ball.mass * world.metres_per_unit * (demo.ball.linear_velocity - last - slow).length()
		if ball == demo.balls and change > demo.ball.mass * world.threshold_m_per_s: changes.append([world.time_s(), change])
		last = demo.ball.linear_velocity
		rides += int(ridden < 0 and demo.ridden >= 0)
		outside += int(not demo.TABLE.grow(30).has_point(demo.ball.position))
	var kinds := {}
	for hit in hits: kinds[hit[2]] = kinds.get(hit[2], 0) + 1
	check(demo.VOICES.keys().all(func(kind): return kinds.has(kind)), "pinball: each part is felt: %s" % kinds)
	check(rides > 0 and demo.balls > 2 and demo.score > 5000 and outside == 0, "pinball: %d ramps, %d balls, %d points" % [rides, demo.balls, demo.score])
	var sum := func(pairs): return pairs.reduce(func(all, pair): return all + pair[1], 0.0)
	check(absf(sum.call(hits) / sum.call(changes) - 1) < 0.03, "pinball: %d hits of %.2f N s, the ball got %.2f N s" % [hits.size(), sum.call(hits), sum.call(changes)])
	var alike := func(hit): return changes.any(func(change): return absf(change[0] - hit[0]) < 0.02 and absf(change[1] / hit[1] - 1) < 0.1)
	var others := hits.filter(func(hit): return not alike.call(hit))
	check(20 * others.size() < hits.size(), "pinball: %d hits are not within 10 %% of one change of the ball" % others.size())
	demo.free()
	check(Engine.physics_ticks_per_second == 60, "pinball: ticks are as before")


func breakout():
	var demo = load("res://addons/physvib/demos/breakout.tscn").instantiate()
	root.add_child(demo)
	demo.ball.collision_layer = 0 # it flies through all
	demo.ball.collision_mask = 0
	for i in 300: await physics_frame
	check(Rect2(Vector2.ZERO, demo.SIZE).grow(10).has_point(demo.ball.position), "breakout: a lost ball is served again: %v" % demo.ball.position)
	demo.free()


func _initialize():
	await physics_frame
	await pinball()
	await breakout()
	print("%d wrong" % wrong)
	quit(1 if wrong else 0)
