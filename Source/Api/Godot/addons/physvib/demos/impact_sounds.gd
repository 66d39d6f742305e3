# SPDX-License-Identifier: MIT
# Sounds that are as loud as the hit, without any actuator: outputs of the HapticWorld3D are empty.
extends Node3D

const FULL := 1.0 # N s: the hit that is played at full volume
var players: Array[AudioStreamPlayer3D] = []


func _ready():
	var ground := add_body(StaticBody3D.new(), Vector3(8, 0.2, 8), Vector3(0, -0.1, 0))
	ground.physics_material_override = PhysicsMaterial.new()
	ground.physics_material_override.bounce = 0.4
	for i in 5:
		var crate := add_body(RigidBody3D.new(), Vector3.ONE * 0.3, Vector3(i - 2, 1 + 0.5 * i, 0))
		crate.rotation = Vector3(0.3 * i, 0.2, 0.1)
		crate.add_child(HapticBody.new())
	for i in 8:
		players.append(AudioStreamPlayer3D.new())
		players[i].stream = click()
		add_child(players[i])
	RenderingServer.set_default_clear_color(Color("22223b"))


func add_body(made: PhysicsBody3D, size: Vector3, at: Vector3) -> PhysicsBody3D:
	var shape := CollisionShape3D.new()
	shape.shape = BoxShape3D.new()
	shape.shape.size = size
	var mesh := MeshInstance3D.new()
	mesh.mesh = BoxMesh.new()
	mesh.mesh.size = size
	mesh.mesh.material = StandardMaterial3D.new()
	mesh.mesh.material.albedo_color = Color("e07a5f") if made is RigidBody3D else Color("4a4e69")
	made.add_child(shape)
	made.add_child(mesh)
	made.position = at
	add_child(made)
	return made


# 50 ms of a decaying sinusoid of 400 Hz.
func click() -> AudioStreamWAV:
	var data := PackedByteArray()
	data.resize(2 * 2205)
	for i in 2205:
		data.encode_s16(2 * i, int(32000 * sin(TAU * 400 * i / 44100.0) * exp(-80 * i / 44100.0)))
	var sound := AudioStreamWAV.new()
	sound.format = AudioStreamWAV.FORMAT_16_BITS
	sound.mix_rate = 44100
	sound.data = data
	return sound


func _on_felt(hit: Dictionary):
	for player in players:
		if player.playing: continue
		player.position = hit.position
		player.volume_db = linear_to_db(clampf(hit.strength_n_s / FULL, 0.001, 1))
		player.play()
		return
