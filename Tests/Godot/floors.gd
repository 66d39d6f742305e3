# SPDX-License-Identifier: MIT
# A ball of 0.2 kg falls from 0.8 m on what Godot has for floors, and plain balls without a HapticBody strike felt
# bodies that have no velocities of their own: one hit each, as strong as on paper.
#   godot --headless -s floors.gd --fixed-fps 60
extends SceneTree

const MASS := 0.2
const STRENGTH := MASS * sqrt(2 * 9.8 * 0.8) # N s, without bounce
var wrong := 0


func ball(space: int, is_haptic: bool):
	var made = ClassDB.instantiate("RigidBody%dD" % space)
	var shape = ClassDB.instantiate("CollisionShape%dD" % space)
	shape.shape = CircleShape2D.new() if space == 2 else SphereShape3D.new()
	shape.shape.radius = 10.0 if space == 2 else 0.1
	made.add_child(shape)
	made.mass = MASS
	made.linear_damp_mode = 1
	made.position = Vector2(8, -90) if space == 2 else Vector3(0.1, 0.9, 0.1)
	# Half a tick of gravity, as in bounce.gd.
	made.linear_velocity = Vector2(0, -980 / 120.0) if space == 2 else Vector3(0, 9.8 / 120, 0)
	if is_haptic: made.add_child(ClassDB.instantiate("HapticBody"))
	return made


# The top of each floor is at height 0.
func tiles() -> Node:
	var texture := ImageTexture.create_from_image(Image.create(16, 16, false, Image.FORMAT_RGBA8))
	var source := TileSetAtlasSource.new()
	source.texture = texture
	source.texture_region_size = Vector2i(16, 16)
	source.create_tile(Vector2i.ZERO)
	var tile_set := TileSet.new()
	tile_set.add_physics_layer()
	tile_set.add_source(source, 0)
	var data := source.get_tile_data(Vector2i.ZERO, 0)
	data.add_collision_polygon(0)
	data.set_collision_polygon_points(0, 0, PackedVector2Array([Vector2(-8, -8), Vector2(8, -8), Vector2(8, 8), Vector2(-8, 8)]))
	var layer := TileMapLayer.new()
	layer.tile_set = tile_set
	for x in range(-4, 4): layer.set_cell(Vector2i(x, 0), 0, Vector2i.ZERO)
	return layer


func grid() -> Node:
	var library := MeshLibrary.new()
	var shape := BoxShape3D.new()
	shape.size = Vector3.ONE
	library.create_item(0)
	library.set_item_mesh(0, BoxMesh.new())
	library.set_item_shapes(0, [shape, Transform3D()])
	var map := GridMap.new()
	map.cell_size = Vector3.ONE
	map.mesh_library = library
	for x in range(-2, 2): for z in range(-2, 2): map.set_cell_item(Vector3i(x, -1, z), 0)
	return map


func csg() -> Node:
	var box := CSGBox3D.new()
	box.size = Vector3(4, 1, 4)
	box.position.y = -0.5
	box.use_collision = true
	return box


# A body of the physics server, without any node. Its shape has to live as long.
var kept := []


func served(scene: Node) -> Node:
	var shape := RectangleShape2D.new()
	shape.size = Vector2(400, 100)
	var body := PhysicsServer2D.body_create()
	PhysicsServer2D.body_set_mode(body, PhysicsServer2D.BODY_MODE_STATIC)
	PhysicsServer2D.body_add_shape(body, shape.get_rid())
	PhysicsServer2D.body_set_state(body, PhysicsServer2D.BODY_STATE_TRANSFORM, Transform2D(0, Vector2(0, 50)))
	PhysicsServer2D.body_set_space(body, root.find_world_2d().space)
	kept = [shape, body]
	scene.tree_exited.connect(func(): PhysicsServer2D.free_rid(body))
	return Node.new()


func felt(kind: String, space: int) -> Node:
	var made = ClassDB.instantiate("%s%dD" % [kind, space])
	var shape = ClassDB.instantiate("CollisionShape%dD" % space)
	shape.shape = RectangleShape2D.new() if space == 2 else BoxShape3D.new()
	shape.shape.size = Vector2(400, 100) if space == 2 else Vector3(4, 1, 4)
	made.add_child(shape)
	made.position = Vector2(0, 50) if space == 2 else Vector3(0, -0.5, 0)
	var haptic = ClassDB.instantiate("HapticBody")
	haptic.static_mass_kg = 70.0
	made.add_child(haptic)
	return made


func fall(what: String, space: int, ground: Callable, is_haptic: bool):
	var scene := Node.new()
	var hits := []
	var world = ClassDB.instantiate("HapticWorld%dD" % space)
	world.felt.connect(func(hit): hits.append(hit))
	scene.add_child(world)
	var made = ground.call(scene) if ground.get_argument_count() > 0 else ground.call()
	scene.add_child(made)
	root.add_child(scene)
	for i in 3: await physics_frame # TileMapLayer and GridMap build their shapes late
	scene.add_child(ball(space, is_haptic))
	for i in 90: await physics_frame
	var off: float = 100 * (hits[0].strength_n_s / STRENGTH - 1) if hits else INF
	var is_right := hits.size() == 1 and absf(off) < 2
	if not is_right: wrong += 1
	print("%s: %s: %d hits, %+.2f %%" % ["right" if is_right else "WRONG", what, hits.size(), off])
	if not is_right: print(hits, world.explain())
	scene.free()
	await physics_frame


func _initialize():
	await physics_frame
	var engine = ProjectSettings.get_setting("physics/3d/physics_engine")
	await fall("a TileMapLayer", 2, tiles, true)
	await fall("a GridMap in %s" % engine, 3, grid, true)
	await fall("CSG in %s" % engine, 3, csg, true)
	await fall("a body without a node", 2, served, true)
	for kind in ["StaticBody", "AnimatableBody", "CharacterBody"]:
		await fall("a plain ball on a felt %s2D" % kind, 2, felt.bind(kind, 2), false)
		await fall("a plain ball on a felt %s3D in %s" % [kind, engine], 3, felt.bind(kind, 3), false)
	print("%d wrong" % wrong)
	quit(1 if wrong else 0)
