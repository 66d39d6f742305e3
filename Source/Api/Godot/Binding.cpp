// SPDX-License-Identifier: MIT
#include "Api/Godot/Binding.h"
#include <map>
#include <set>

namespace physvib::godot {
namespace {
// Names are cached: interning hashes the text, and each tick makes thousands of calls.
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
    api.fromType(type::boolean)(data.data(), &typed);
}

Value::Value(const char* text) {
    Text typed(text);
    api.fromType(type::text)(data.data(), typed.get());
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
    const Value target(object), name(type::name, nameOf(method).get());
    const std::array<GDExtensionConstVariantPtr, 2> arguments{target.raw(), name.raw()};
    Value result;
    GDExtensionCallError error{};
    api.construct(type::callable, result.raw(), arguments.data(), 2, &error);
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
    return {isSpace ? type::vector3 : type::vector2, typed.data()};
}

template <class Typed>
Typed Value::typed(GDExtensionVariantType wanted) const {
    Typed typed{};
    if (type() == wanted) api.toType(wanted)(&typed, const_cast<void*>(raw()));
    return typed;
}
double Value::real() const {
    return type() == type::real ? typed<double>(type::real) : static_cast<double>(whole());
}
std::int64_t Value::whole() const {
    return type() == type::boolean ? typed<GDExtensionBool>(type::boolean) : typed<std::int64_t>(type::whole);
}
Vector Value::vector() const {
    const auto [x, y, z] = typed<std::array<float, 3>>(type() == type::vector2 ? type() : type::vector3);
    return {x, y, z};
}
GDExtensionObjectPtr Value::object() const { return typed<GDExtensionObjectPtr>(type::object); }
std::uint64_t Value::rid() const { return typed<std::uint64_t>(type::rid); }

std::vector<Value> Value::elements() const {
    std::vector<Value> all;
    for (int i = 0; i < call("size").whole(); ++i) all.push_back(call("get", i));
    return all;
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

// An error in one tick occurs in the next one too, so each line is printed once.
void report(const std::string& line) {
    constexpr std::size_t most = 100, longest = 300; // a value may be a list of thousands
    static std::set<std::string> printed;
    const std::string text = line.substr(0, longest);
    if (printed.size() < most && printed.insert(text).second)
        api.printWarning(text.c_str(), text.c_str(), "", "physvib", 0, 1);
}

Functions api;

Symbol Functions::find(const char* name) {
    const Symbol found{get == nullptr ? nullptr : reinterpret_cast<void*>(get(name))};
    isWhole = isWhole && found.address != nullptr;
    return found;
}

bool lookUp(GDExtensionInterfaceGetProcAddress get, GDExtensionClassLibraryPtr library) {
    api = {get, library};
    if (api.isWhole) api.freeText = api.destructor(type::text);
    api.loadHelp = api.find("editor_help_load_xml_from_utf8_chars"); // only the editor has it
    return api.freeText != nullptr;
}

} // namespace physvib::godot
