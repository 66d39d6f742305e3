# SPDX-License-Identifier: MIT
# Drums for two hands. With an OpenXR headset (and OpenXR on in the project's settings) the controllers are the sticks,
# and each hit is felt on the hand that made it, in the hertz of the drum. Without one the sticks play by themselves.
extends Node3D

const HERTZ := [60, 90, 130, 190]
const COLOURS := [Color("e07a5f"), Color("f2cc8f"), Color("81b29a"), Color("5fa8d3")]
var hands := {} # left_hand, right_hand: the body that Godot's tracker, or the beat, moves
var drums := []
var lamps := {} # by drum
var seconds := 0.0


func _ready():
	RenderingServer.set_default_clear_color(Color("22223b"))
	var headset := XRServer.find_interface("OpenXR")
	if headset and headset.is_initialized(): get_viewport().use_xr = true
	for i in 4:
		var drum := body(StaticBody3D.new(), CylinderMesh.new(), COLOURS[i])
		drum.position = Vector3(0.3 * (i - 1.5), 0.9, -0.45 - 0.1 * (i % 3 % 2))
		drums.append(drum)
	for hand in ["left_hand", "right_hand"]:
		var stick := body(RigidBody3D.new(), SphereMesh.new(), Color("f2e9e4"))
		stick.mass = 0.1
		stick.gravity_scale = 0.0
		stick.add_child(HapticBody.new())
		stick.get_child(2).part = hand
		stick.get_child(2).material = HapticMaterial.new()
		stick.position = Vector3(0.45 * (-1 if hand == "left_hand" else 1), 1.2, -0.45)
		hands[hand] = stick


func body(made: PhysicsBody3D, mesh: PrimitiveMesh, colour: Color) -> PhysicsBody3D:
	var shape := CollisionShape3D.new()
	if mesh is CylinderMesh:
		mesh.top_radius = 0.13
		mesh.bottom_radius = 0.11
		mesh.height = 0.2
		shape.shape = CylinderShape3D.new()
		shape.shape.radius = 0.13
		shape.shape.height = 0.2
	else:
		mesh.radius = 0.03
		mesh.height = 0.06
		shape.shape = SphereShape3D.new()
		shape.shape.radius = 0.03
	var seen := MeshInstance3D.new()
	seen.mesh = mesh
	mesh.material = StandardMaterial3D.new()
	mesh.material.albedo_color = colour
	mesh.material.emission_enabled = true
	mesh.material.emission = Color.BLACK
	made.add_child(shape)
	made.add_child(seen)
	lamps[made] = mesh.material
	add_child(made)
	return made


# The sticks are bodies, which drums stop: they follow the hands by their velocity.
func _physics_process(delta):
	seconds += delta
	for hand in hands:
		var stick: RigidBody3D = hands[hand]
		var tracker: XRPositionalTracker = XRServer.get_tracker(hand)
		var pose := tracker.get_pose("aim") if tracker else null
		var wanted: Vector3 = XRServer.world_origin * pose.get_adjusted_transform().origin if pose and pose.has_tracking_data else beat(hand)
		stick.linear_velocity = ((wanted - stick.position) / delta).limit_length(8)
		var nearest = drums.reduce(func(a, b): return a if a.position.distance_to(stick.position) < b.position.distance_to(stick.position) else b)
		stick.get_child(2).material.frequency_hz = HERTZ[drums.find(nearest)]
	for each in lamps: lamps[each].emission = lamps[each].emission.lerp(Color.BLACK, 6 * delta)


# Right on each beat, left between: up and down, from drum to drum.
func beat(hand: String) -> Vector3:
	var time := 2.0 * seconds + (0.5 if hand == "left_hand" else 0.0)
	var number := int(time)
	var drum: Vector3 = drums[[0, 1, 0, 1][number % 4] if hand == "left_hand" else [2, 3, 3, 2][number % 4]].position
	return drum + Vector3(0, 0.04 + 0.3 * absf(cos(PI * time)) * (1.0 if number % 2 else 0.7), 0)


func _on_felt(hit: Dictionary):
	if hit.other in lamps: lamps[hit.other].emission = lamps[hit.other].albedo_color * clampf(2 * hit.amplitude, 0.3, 1)
