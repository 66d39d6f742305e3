# SPDX-License-Identifier: MIT
# Takes a picture of the editor for each node of the scene that is chosen, drags an actuator, and leaves.
@tool
extends EditorPlugin


func _enter_tree():
	look.call_deferred()


func frames(count: int):
	for i in count: await get_tree().process_frame


func picture(name: String):
	await frames(30)
	get_viewport().get_texture().get_image().save_png("res://picture-%s.png" % name)


func choose(node: Node):
	EditorInterface.get_selection().clear()
	EditorInterface.get_selection().add_node(node)
	EditorInterface.edit_node(node)
	await frames(30)


func mouse(at: Vector2, is_down: bool, moved := Vector2.ZERO):
	var event = InputEventMouseButton.new() if moved == Vector2.ZERO else InputEventMouseMotion.new()
	event.position = at
	event.global_position = at
	event.button_mask = MOUSE_BUTTON_MASK_LEFT if is_down else 0
	if event is InputEventMouseButton:
		event.button_index = MOUSE_BUTTON_LEFT
		event.pressed = is_down
	else:
		event.relative = moved
	get_viewport().push_input(event, true)
	await frames(3)


# Sections of the inspector, from below, as each pushes those under it.
func unfold():
	for height in [281, 256, 231]:
		await mouse(Vector2(1257, height), true)
		await mouse(Vector2(1257, height), false)


func look():
	await frames(200)
	EditorInterface.open_scene_from_path("res://looked_at.tscn")
	EditorInterface.set_main_screen_editor("2D")
	await frames(100)
	var scene := EditorInterface.get_edited_scene_root()
	for path in ["Ball/HapticBody", "HapticWorld2D", "Alone"]:
		await choose(scene.get_node(path))
		if path == "HapticWorld2D": await unfold()
		await picture(path.get_file())
	await choose(scene.get_node("Ball/HapticBody"))
	EditorInterface.edit_resource(scene.get_node("Ball/HapticBody").material)
	await picture("HapticMaterial")
	var world = scene.get_node("HapticWorld2D")
	await choose(world)
	var view := EditorInterface.get_editor_viewport_2d()
	var to_window: Transform2D = Transform2D(0, view.get_parent().global_position) * view.global_canvas_transform
	var from: Vector2 = to_window * world.actuator_places()[0]
	await mouse(from, true)
	await mouse(from + Vector2(60, 40), true, Vector2(60, 40))
	await mouse(from + Vector2(60, 40), false)
	print("dragged: %s" % [world.actuators])
	await picture("dragged")
	EditorInterface.open_scene_from_path("res://warned.tscn")
	await frames(100)
	for tree in EditorInterface.get_base_control().find_children("*", "Tree", true, false): print_warnings(tree.get_root(), "")
	get_tree().quit()


# What the scene's tree warns of, as one reads it over the sign.
func print_warnings(item: TreeItem, path: String):
	while item:
		var its := path + "/" + item.get_text(0)
		for i in item.get_button_count(0):
			var text := item.get_button_tooltip_text(0, i).replace("\n", " ")
			if "onfiguration warning" in text: print("warned: %s %s" % [its, text])
		print_warnings(item.get_first_child(), its)
		item = item.get_next()
