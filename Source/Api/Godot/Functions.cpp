// SPDX-License-Identifier: MIT
// Looks up Godot's functions by their names.
#include "Api/Godot/Binding.h"

namespace physvib::godot {

Functions api;

namespace {
template <class Function>
void find(GDExtensionInterfaceGetProcAddress get, const char* name, Function& function, bool& isThere) {
    function = reinterpret_cast<Function>(get(name));
    isThere = isThere && function != nullptr;
}
} // namespace

bool lookUp(GDExtensionInterfaceGetProcAddress get, GDExtensionClassLibraryPtr library) {
    bool all = true, ignored = true;
    api.library = library;
    find(get, "variant_new_nil", api.newNil, all);
    find(get, "variant_new_copy", api.newCopy, all);
    find(get, "variant_destroy", api.destroy, all);
    find(get, "variant_call", api.call, all);
    find(get, "variant_construct", api.construct, all);
    find(get, "variant_get_type", api.getType, all);
    find(get, "variant_get_named", api.getNamed, all);
    find(get, "variant_set_keyed", api.setKeyed, all);
    find(get, "get_variant_from_type_constructor", api.fromType, all);
    find(get, "get_variant_to_type_constructor", api.toType, all);
    find(get, "string_name_new_with_latin1_chars", api.newName, all);
    find(get, "string_new_with_utf8_chars", api.newText, all);
    find(get, "string_to_utf8_chars", api.toUtf8, all);
    find(get, "variant_stringify", api.stringify, all);
    find(get, "global_get_singleton", api.singleton, all);
    find(get, "object_get_instance_from_id", api.instanceFromId, all);
    find(get, "object_get_instance_id", api.instanceId, all);
    find(get, "object_set_instance", api.setInstance, all);
    find(get, "classdb_construct_object2", api.constructObject, all);
    find(get, "classdb_register_extension_class4", api.registerClass, all);
    find(get, "classdb_register_extension_class_method", api.registerMethod, all);
    find(get, "classdb_register_extension_class_property", api.registerProperty, all);
    find(get, "classdb_register_extension_class_property_group", api.registerGroup, all);
    find(get, "classdb_register_extension_class_signal", api.registerSignal, all);
    find(get, "classdb_unregister_extension_class", api.unregisterClass, all);
    find(get, "get_library_path", api.libraryPath, all);
    find(get, "print_warning_with_message", api.printWarning, all);
    find(get, "classdb_get_method_bind", api.methodBind, all);
    find(get, "object_method_bind_ptrcall", api.pointerCall, all);
    find(get, "ref_set_object", api.setReference, all);
    find(get, "editor_help_load_xml_from_utf8_chars", api.loadHelp, ignored); // the editor's alone
    GDExtensionInterfaceVariantGetPtrDestructor destructor = nullptr;
    find(get, "variant_get_ptr_destructor", destructor, all);
    if (all) api.freeText = destructor(GDEXTENSION_VARIANT_TYPE_STRING);
    return all;
}

} // namespace physvib::godot
