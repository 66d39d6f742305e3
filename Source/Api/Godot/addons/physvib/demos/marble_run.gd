# SPDX-License-Identifier: MIT
# Marbles roll down planks with grains, and are felt on a controller where they roll. On a sleeve of eight actuators
# as well: add its sound device, such as JACK:system, to `outputs` of the HapticWorld3D.
extends Node3D

const PLANKS := 5
const COLOURS := [Color("e07a5f"), Color("f2cc8f"), Color("81b29a"), Color("5fa8d3"), Color("b8a9c9")]
var made := 0
var lamps := {} # by marble


func _ready():
	$Camera3D.look_at(Vector3(0, 1.35, 0))
	RenderingServer.set_default_clear_color(Color("22223b"))
	for i in PLANKS:
		var side := 1 if i % 2 == 0 else -1
		var plank := board(Vector3(2.4, 0.06, 0.5), Vector3(-0.35 * side, 2.3 - 0.5 * i, 0))
		board(Vector3(0.06, 0.3, 0.5), Vector3(-1.58 * side, 2.58 - 0.5 * i, 0)) # which stops the marbles
		plank.rotation.z = -0.12 * side
		var grain: HapticBody = feel(plank, 120 + 40 * i)
		grain.felt = false # the marbles feel it
		grain.material.grain_m = 0.02 if i % 2 == 0 else 0.06
	_on_timeout()


func body(its: PhysicsBody3D, mesh: PrimitiveMesh, at: Vector3, colour: Color) -> PhysicsBody3D:
	var seen := MeshInstance3D.new()
	seen.mesh = mesh
	mesh.material = StandardMaterial3D.new()
	mesh.material.albedo_color = colour
	mesh.material.roughness = 0.35
	mesh.material.emission_enabled = true
	mesh.material.emission = Color.BLACK
	var shape := CollisionShape3D.new()
	shape.shape = mesh.create_convex_shape() if mesh is BoxMesh else SphereShape3D.new()
	if mesh is SphereMesh: shape.shape.radius = mesh.radius
	its.add_child(shape)
	its.add_child(seen)
	its.position = at
	add_child(its)
	return its


func board(size: Vector3, at: Vector3) -> PhysicsBody3D:
	var box := BoxMesh.new()
	box.size = size
	return body(StaticBody3D.new(), box, at, Color("b08968"))


func feel(its: PhysicsBody3D, frequency: float) -> HapticBody:
	var haptic := HapticBody.new()
	haptic.material = HapticMaterial.new()
	haptic.material.frequency_hz = frequency
	its.add_child(haptic)
	return haptic


func _on_timeout():
	var ball := SphereMesh.new()
	ball.radius = 0.08 + 0.02 * (made % 3)
	ball.height = 2 * ball.radius
	var marble: RigidBody3D = body(RigidBody3D.new(), ball, Vector3(-1.3, 2.75, 0), COLOURS[made % COLOURS.size()])
	marble.mass = 300 * ball.radius ** 3
	marble.axis_lock_linear_z = true
	feel(marble, 260 - 40 * (made % 3))
	lamps[marble] = ball.material
	made += 1


func _process(delta):
	for marble in lamps.keys():
		lamps[marble].emission = lamps[marble].emission.lerp(Color.BLACK, minf(1, 6 * delta))
		if marble.position.y > -1.5: continue
		lamps.erase(marble)
		marble.queue_free()


func _on_felt(hit: Dictionary):
	if hit.body in lamps: lamps[hit.body].emission = lamps[hit.body].albedo_color * clampf(4 * hit.amplitude, 0.2, 1)
