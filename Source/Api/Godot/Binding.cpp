// SPDX-License-Identifier: MIT
// Variants, strings and method calls of Godot, by the functions of its C interface.
#include "Api/Godot/Binding.h"
#include <map>
#include <set>

namespace physvib::godot {
namespace {
// Names are cached: interning hashes the text, and each tick makes thousands of calls.
StringName& intern(const char* literal) {
    static std::map<const char*, StringName> names;
    return names.try_emplace(literal, literal).first->second;
}
} // namespace

Variant& Variant::operator=(const Variant& other) {
    if (this == &other) return *this;
    api.destroyVariant(data.data());
    api.copyVariant(data.data(), other.data.data());
    return *this;
}

Variant::Variant(bool value) {
    GDExtensionBool typed = value ? 1 : 0;
    api.variantFrom(type::boolean)(data.data(), &typed);
}

Variant::Variant(const char* text) {
    String typed(text);
    api.variantFrom(type::text)(data.data(), typed.get());
}

Variant Variant::copyOf(GDExtensionConstVariantPtr variant) {
    Variant result;
    api.copyVariant(result.raw(), variant);
    return result;
}

Variant Variant::empty(GDExtensionVariantType type) {
    Variant result;
    GDExtensionCallError error{};
    api.newVariant(type, result.raw(), nullptr, 0, &error);
    return result;
}

Variant Variant::callable(GDExtensionObjectPtr object, const char* method) {
    const Variant target(object), name(type::name, intern(method).get());
    const std::array<GDExtensionConstVariantPtr, 2> arguments{target.raw(), name.raw()};
    Variant result;
    GDExtensionCallError error{};
    api.newVariant(type::callable, result.raw(), arguments.data(), 2, &error);
    return result;
}

Variant Variant::as(GDExtensionVariantType target) const {
    const std::array<GDExtensionConstVariantPtr, 1> arguments{raw()};
    Variant result;
    GDExtensionCallError error{};
    api.newVariant(target, result.raw(), arguments.data(), 1, &error);
    return error.error == GDEXTENSION_CALL_OK ? result : Variant();
}

Variant Variant::vector(const Vector& v, bool is3d) {
    std::array<float, 3> typed{static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2])};
    return {is3d ? type::vector3 : type::vector2, typed.data()};
}

template <class Typed>
Typed Variant::typed(GDExtensionVariantType target) const {
    Typed typed{};
    if (type() == target) api.variantTo(target)(&typed, const_cast<void*>(raw()));
    return typed;
}
double Variant::real() const {
    return type() == type::real ? typed<double>(type::real) : static_cast<double>(integer());
}
std::int64_t Variant::integer() const {
    return type() == type::boolean ? typed<GDExtensionBool>(type::boolean)
                                   : typed<std::int64_t>(type::integer);
}
Vector Variant::vector() const {
    const auto [x, y, z] = typed<std::array<float, 3>>(type() == type::vector2 ? type() : type::vector3);
    return {x, y, z};
}
GDExtensionObjectPtr Variant::object() const { return typed<GDExtensionObjectPtr>(type::object); }
std::uint64_t Variant::rid() const { return typed<std::uint64_t>(type::rid); }

std::vector<Variant> Variant::elements() const {
    std::vector<Variant> all;
    for (int i = 0; i < call("size").integer(); ++i) all.push_back(call("get", i));
    return all;
}

std::string String::utf8() const {
    std::string result(static_cast<std::size_t>(api.stringToUtf8(&data, nullptr, 0)), '\0');
    api.stringToUtf8(&data, result.data(), static_cast<GDExtensionInt>(result.size()));
    return result;
}

std::string Variant::text() const {
    String typed;
    api.stringify(raw(), typed.get());
    return typed.utf8();
}

Variant Variant::member(const char* name) const {
    Variant result;
    GDExtensionBool isPresent = 0;
    api.getMember(raw(), intern(name).get(), result.raw(), &isPresent);
    return result;
}

void Variant::set(const Variant& key, const Variant& value) {
    GDExtensionBool isSet = 0;
    api.setElement(raw(), key.raw(), value.raw(), &isSet);
}

Variant Variant::callWith(const char* name, const GDExtensionConstVariantPtr* arguments,
                          std::size_t count) const {
    Variant result;
    GDExtensionCallError error{};
    api.invoke(const_cast<void*>(raw()), intern(name).get(), arguments, static_cast<GDExtensionInt>(count),
               result.raw(), &error);
    return result;
}

void Variant::assignTo(GDExtensionVariantPtr variant) const {
    api.destroyVariant(variant);
    api.copyVariant(variant, raw());
}

Variant singleton(const char* name) { return Variant(api.getSingleton(intern(name).get())); }

bool isInEditor() { return singleton("Engine").call("is_editor_hint").isTrue(); }

bool MethodBind::find(const char* className, const char* method, std::int64_t hash) {
    bind = api.getMethodBind(intern(className).get(), intern(method).get(), hash);
    return bind != nullptr;
}

// An error in one tick occurs in the next one too, so each line is printed once.
void warn(const std::string& line) {
    constexpr std::size_t maxLines = 100, maxLength = 300; // a value may be a list of thousands
    static std::set<std::string> printed;
    const std::string text = line.substr(0, maxLength);
    if (printed.size() < maxLines && printed.insert(text).second)
        api.printWarning(text.c_str(), text.c_str(), "", "physvib", 0, 1);
}

Functions api;

AnyFunction Functions::find(const char* name) {
    const AnyFunction found{getAddress == nullptr ? nullptr : reinterpret_cast<void*>(getAddress(name))};
    isComplete = isComplete && found.address != nullptr;
    return found;
}

bool loadFunctions(GDExtensionInterfaceGetProcAddress getAddress, GDExtensionClassLibraryPtr library) {
    api = {getAddress, library};
    if (api.isComplete) api.destroyString = api.getDestructor(type::text);
    api.loadHelp = api.find("editor_help_load_xml_from_utf8_chars"); // only the editor has it
    return api.destroyString != nullptr;
}

} // namespace physvib::godot
