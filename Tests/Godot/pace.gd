# SPDX-License-Identifier: MIT
extends SceneTree
# The smallest scene, which only looks at the clock: over how much its ticks spread against a pace that never changes. One latency for all
# hits is at least that and a tick. Twenty seconds: godot -s pace.gd
var times: PackedInt64Array = []
var began := 0

func _physics_process(_delta: float) -> bool:
	var now := Time.get_ticks_usec()
	if began == 0:
		began = now
	if now - began > 2000000: # the start's
		times.append(now)
	if now - began < 22000000:
		return false
	var step := 1e6 / Engine.physics_ticks_per_second
	var least := INF
	var most := -INF
	var none := 0
	for i in times.size():
		var lag := times[i] - times[0] - i * step
		least = minf(least, lag)
		most = maxf(most, lag)
		if i > 0 and times[i] - times[i - 1] < 1000:
			none += 1
	print("%d ticks of %.1f ms, %d of them in the frame of the one before; against a constant pace they spread over %.1f ms" % [times.size(), step / 1000, none, (most - least) / 1000])
	return true
