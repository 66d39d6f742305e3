# SPDX-License-Identifier: MIT
# Actuators of the chosen HapticWorld2D in the 2D editor: letters in the field, which can be dragged. Nodes work
# without this plugin.
@tool
extends EditorPlugin

const RADIUS := 12.0 # pixels of the screen
const COLOUR := Color(0.2, 0.75, 0.7)
var world: Node
var dragged := -1
var before: PackedVector2Array


func _enter_tree():
	EditorInterface.get_inspector().property_edited.connect(_on_edited)


func _exit_tree():
	EditorInterface.get_inspector().property_edited.disconnect(_on_edited)


func _on_edited(_property: String):
	update_overlays()


func _handles(object: Object) -> bool:
	return object.is_class("HapticWorld2D")


func _edit(object: Object):
	world = object
	dragged = -1
	update_overlays()


func _make_visible(is_visible: bool):
	if not is_visible: _edit(null)


func to_screen() -> Transform2D:
	return EditorInterface.get_editor_viewport_2d().global_canvas_transform


func _forward_canvas_draw_over_viewport(overlay: Control):
	if not is_instance_valid(world): return
	var screen := to_screen()
	overlay.draw_rect(screen * Rect2(world.field_corner, world.field_size), COLOUR, false, 2)
	var places: PackedVector2Array = world.actuator_places()
	for j in places.size():
		var at := screen * places[j]
		var letter := char(65 + j) if j < 26 else str(j)
		overlay.draw_circle(at, RADIUS, COLOUR)
		overlay.draw_string(overlay.get_theme_default_font(), at + Vector2(-RADIUS, 5), letter,
			HORIZONTAL_ALIGNMENT_CENTER, 2 * RADIUS, 14, Color.BLACK)


func _forward_canvas_gui_input(event: InputEvent) -> bool:
	if not is_instance_valid(world): return false
	if event is InputEventMouseButton and event.button_index == MOUSE_BUTTON_LEFT:
		if event.pressed: return take(event.position)
		if dragged >= 0: return drop()
	if event is InputEventMouseMotion and dragged >= 0:
		var places: PackedVector2Array = world.actuator_places()
		var field := Rect2(world.field_corner, world.field_size)
		places[dragged] = (to_screen().affine_inverse() * event.position).clamp(field.position, field.end)
		world.actuators = places
		update_overlays()
		return true
	return false


func take(mouse: Vector2) -> bool:
	var places: PackedVector2Array = world.actuator_places()
	for j in places.size():
		if mouse.distance_to(to_screen() * places[j]) <= RADIUS: dragged = j
	before = world.actuators
	return dragged >= 0


func drop() -> bool:
	var undo := get_undo_redo()
	undo.create_action("Move actuator %s" % char(65 + dragged))
	undo.add_do_property(world, "actuators", world.actuators)
	undo.add_undo_property(world, "actuators", before)
	undo.commit_action(false)
	dragged = -1
	return true
