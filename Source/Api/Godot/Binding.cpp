// SPDX-License-Identifier: MIT
#include "Api/Godot/Binding.h"
#include <map>
#include <set>

namespace physvib::godot {
namespace {
// Interning hashes the text, which calls in each tick would do thousands of times.
Name& nameOf(const char* literal) {
    static std::map<const char*, Name> names;
    return names.try_emplace(literal, literal).first->second;
}
} // namespace

Value& Value::operator=(const Value& other) {
    if (this == &other) return *this;
    api.destroy(data.data());
    api.newCopy(data.data(), other.data.data());
    return *this;
}

Value::Value(bool is) {
    GDExtensionBool typed = is ? 1 : 0;
    api.fromType(GDEXTENSION_VARIANT_TYPE_BOOL)(data.data(), &typed);
}

Value::Value(const char* text) {
    Text typed(text);
    api.fromType(GDEXTENSION_VARIANT_TYPE_STRING)(data.data(), typed.get());
}

Value Value::copyOf(GDExtensionConstVariantPtr variant) {
    Value result;
    api.newCopy(result.raw(), variant);
    return result;
}

Value Value::empty(GDExtensionVariantType type) {
    Value result;
    GDExtensionCallError error{};
    api.construct(type, result.raw(), nullptr, 0, &error);
    return result;
}

Value Value::callable(GDExtensionObjectPtr object, const char* method) {
    const Value target(object), name(GDEXTENSION_VARIANT_TYPE_STRING_NAME, nameOf(method).get());
    const std::array<GDExtensionConstVariantPtr, 2> arguments{target.raw(), name.raw()};
    Value result;
    GDExtensionCallError error{};
    api.construct(GDEXTENSION_VARIANT_TYPE_CALLABLE, result.raw(), arguments.data(), 2, &error);
    return result;
}

Value Value::as(GDExtensionVariantType wanted) const {
    const std::array<GDExtensionConstVariantPtr, 1> arguments{raw()};
    Value result;
    GDExtensionCallError error{};
    api.construct(wanted, result.raw(), arguments.data(), 1, &error);
    return error.error == GDEXTENSION_CALL_OK ? result : Value();
}

Value Value::vector(const Vector& v, bool isSpace) {
    std::array<float, 3> typed{static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2])};
    return {isSpace ? GDEXTENSION_VARIANT_TYPE_VECTOR3 : GDEXTENSION_VARIANT_TYPE_VECTOR2, typed.data()};
}

double Value::real() const {
    double typed = 0.0;
    if (type() == GDEXTENSION_VARIANT_TYPE_FLOAT)
        api.toType(GDEXTENSION_VARIANT_TYPE_FLOAT)(&typed, const_cast<void*>(raw()));
    else
        typed = static_cast<double>(whole());
    return typed;
}

std::int64_t Value::whole() const {
    std::int64_t typed = 0;
    GDExtensionBool is = 0;
    if (type() == GDEXTENSION_VARIANT_TYPE_INT)
        api.toType(GDEXTENSION_VARIANT_TYPE_INT)(&typed, const_cast<void*>(raw()));
    else if (type() == GDEXTENSION_VARIANT_TYPE_BOOL) {
        api.toType(GDEXTENSION_VARIANT_TYPE_BOOL)(&is, const_cast<void*>(raw()));
        typed = is;
    }
    return typed;
}

Vector Value::vector() const {
    std::array<float, 3> typed{};
    if (type() == GDEXTENSION_VARIANT_TYPE_VECTOR2 || type() == GDEXTENSION_VARIANT_TYPE_VECTOR3)
        api.toType(type())(typed.data(), const_cast<void*>(raw()));
    return {typed[0], typed[1], typed[2]};
}

std::vector<Value> Value::elements() const {
    std::vector<Value> all;
    for (int i = 0; i < call("size").whole(); ++i) all.push_back(call("get", i));
    return all;
}

GDExtensionObjectPtr Value::object() const {
    GDExtensionObjectPtr typed = nullptr;
    if (type() == GDEXTENSION_VARIANT_TYPE_OBJECT)
        api.toType(GDEXTENSION_VARIANT_TYPE_OBJECT)(&typed, const_cast<void*>(raw()));
    return typed;
}

std::uint64_t Value::rid() const {
    std::uint64_t typed = 0;
    if (type() == GDEXTENSION_VARIANT_TYPE_RID)
        api.toType(GDEXTENSION_VARIANT_TYPE_RID)(&typed, const_cast<void*>(raw()));
    return typed;
}

std::string Text::utf8() const {
    std::string result(static_cast<std::size_t>(api.toUtf8(&data, nullptr, 0)), '\0');
    api.toUtf8(&data, result.data(), static_cast<GDExtensionInt>(result.size()));
    return result;
}

std::string Value::text() const {
    Text typed;
    api.stringify(raw(), typed.get());
    return typed.utf8();
}

Value Value::member(const char* name) const {
    Value result;
    GDExtensionBool isThere = 0;
    api.getNamed(raw(), nameOf(name).get(), result.raw(), &isThere);
    return result;
}

void Value::set(const Value& key, const Value& value) {
    GDExtensionBool isDone = 0;
    api.setKeyed(raw(), key.raw(), value.raw(), &isDone);
}

Value Value::callWith(const char* name, const GDExtensionConstVariantPtr* arguments,
                      std::size_t count) const {
    Value result;
    GDExtensionCallError error{};
    api.call(const_cast<void*>(raw()), nameOf(name).get(), arguments, static_cast<GDExtensionInt>(count),
             result.raw(), &error);
    return result;
}

void Value::copyTo(GDExtensionVariantPtr variant) const {
    api.destroy(variant);
    api.newCopy(variant, raw());
}

Value singleton(const char* name) { return Value(api.singleton(nameOf(name).get())); }

bool isInEditor() { return singleton("Engine").call("is_editor_hint").isTrue(); }

bool Direct::find(const char* className, const char* method, std::int64_t hash) {
    bind = api.methodBind(nameOf(className).get(), nameOf(method).get(), hash);
    return bind != nullptr;
}

// What is wrong in one tick is wrong in the next one too, and a script may set a wrong value in every frame.
void report(const std::string& line) {
    constexpr std::size_t most = 100, longest = 300; // a value may be a list of thousands
    static std::set<std::string> printed;
    const std::string text = line.substr(0, longest);
    if (printed.size() < most && printed.insert(text).second)
        api.printWarning(text.c_str(), text.c_str(), "", "physvib", 0, 1);
}

// Looks up Godot's functions by their names.

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
