// SPDX-License-Identifier: MIT
// Registers classes with their properties and methods in Godot, and keeps the property values of instances.
#include "Api/Godot/Classes.h"
#include <algorithm>
#include <cmath>
#include <list>

namespace physvib::godot {
namespace {
constexpr std::uint32_t usageDefault = 6, methodFlagNormal = 1; // Godot's PROPERTY_USAGE_DEFAULT,
                                                                // METHOD_FLAG_NORMAL

// Property of a getter and a setter; Godot passes its address to each call of them.
struct Accessor {
    const Property* property;
    std::size_t index;
    std::string getter, setter;
};
std::list<Accessor> accessors; // a list: Godot keeps the addresses

// Names and texts of a property, which Godot copies while it registers it.
struct PropertyInfo {
    PropertyInfo(GDExtensionVariantType type, const char* literal, int hint = 0, const char* hintText = "")
        : name(literal)
        , className(type == type::object ? hintText : "")
        , text(hintText) {
        info = {type,       name.get(),  className.get(), static_cast<std::uint32_t>(hint),
                text.get(), usageDefault};
    }
    StringName name, className;
    String text;
    GDExtensionPropertyInfo info{};
};

// Godot calls the functions variant...() with Variants, and pointer...() with values in its own layout.
Instance& instanceAt(GDExtensionClassInstancePtr instance) { return *static_cast<Instance*>(instance); }
const Accessor& accessorAt(void* data) { return *static_cast<Accessor*>(data); }

void variantSet(void* data, GDExtensionClassInstancePtr instance, const GDExtensionConstVariantPtr* arguments,
                GDExtensionInt count, GDExtensionVariantPtr, GDExtensionCallError* error) {
    if (count == 1) return instanceAt(instance).set(accessorAt(data).index, Variant::copyOf(arguments[0]));
    *error = {count < 1 ? GDEXTENSION_CALL_ERROR_TOO_FEW_ARGUMENTS
                        : GDEXTENSION_CALL_ERROR_TOO_MANY_ARGUMENTS,
              0, 1};
}
void pointerSet(void* data, GDExtensionClassInstancePtr instance, const GDExtensionConstTypePtr* arguments,
                GDExtensionTypePtr) {
    const Accessor& target = accessorAt(data);
    instanceAt(instance).set(target.index, Variant(target.property->type, const_cast<void*>(arguments[0])));
}
void variantGet(void* data, GDExtensionClassInstancePtr instance, const GDExtensionConstVariantPtr*,
                GDExtensionInt, GDExtensionVariantPtr result, GDExtensionCallError*) {
    const Accessor& target = accessorAt(data);
    const Variant& value = instanceAt(instance).get(target.index);
    if (target.property->type == type::object) return value.assignTo(result);
    const bool isDictionary = target.property->type == type::dictionary;
    // Copies of dictionaries share their content, unlike arrays, so a dictionary is duplicated.
    (isDictionary ? value.call("duplicate") : value.as(target.property->type)).assignTo(result);
}
void pointerGet(void* data, GDExtensionClassInstancePtr instance, const GDExtensionConstTypePtr*,
                GDExtensionTypePtr result) {
    const Accessor& target = accessorAt(data);
    const Variant& stored = instanceAt(instance).get(target.index);
    if (target.property->type == type::object) { // setReference() counts the new reference
        if (stored.object() != nullptr) api.setReference(result, stored.object());
        return;
    }
    const bool isDictionary = target.property->type == type::dictionary;
    Variant value = isDictionary ? stored.call("duplicate") : stored.as(target.property->type);
    if (value.type() == target.property->type) api.variantTo(value.type())(result, value.raw());
}
void variantCall(void* data, GDExtensionClassInstancePtr instance,
                 const GDExtensionConstVariantPtr* arguments, GDExtensionInt count,
                 GDExtensionVariantPtr result, GDExtensionCallError* error) {
    const Method& method = *static_cast<Method*>(data);
    const GDExtensionInt expected = method.argumentClass != nullptr ? 1 : 0;
    if (count == expected)
        return method.call(instanceAt(instance), count > 0 ? Variant::copyOf(arguments[0]) : Variant())
            .assignTo(result);
    *error = {count < expected ? GDEXTENSION_CALL_ERROR_TOO_FEW_ARGUMENTS
                               : GDEXTENSION_CALL_ERROR_TOO_MANY_ARGUMENTS,
              0, static_cast<std::int32_t>(expected)};
}
void pointerCall(void* data, GDExtensionClassInstancePtr instance, const GDExtensionConstTypePtr* arguments,
                 GDExtensionTypePtr result) {
    const Method& method = *static_cast<Method*>(data);
    Variant value = method.call(
        instanceAt(instance),
        method.argumentClass == nullptr ? Variant() : Variant(type::object, const_cast<void*>(arguments[0])));
    if (value.type() != type::nil) api.variantTo(value.type())(result, value.raw());
}

void addMethod(const ClassTable& table, const char* name, void* data, GDExtensionClassMethodCall call,
               GDExtensionClassMethodPtrCall pointer, PropertyInfo* result, PropertyInfo* argument) {
    StringName className(table.name), methodName(name);
    GDExtensionClassMethodArgumentMetadata noMeta = GDEXTENSION_METHOD_ARGUMENT_METADATA_NONE;
    GDExtensionClassMethodInfo info{};
    info.name = methodName.get(), info.method_userdata = data, info.call_func = call;
    info.ptrcall_func = pointer, info.method_flags = methodFlagNormal;
    info.has_return_value = result != nullptr;
    info.return_value_info = result != nullptr ? &result->info : nullptr;
    info.argument_count = argument != nullptr ? 1 : 0;
    info.arguments_info = argument != nullptr ? &argument->info : nullptr, info.arguments_metadata = &noMeta;
    api.registerMethod(api.library, className.get(), &info);
}

void addProperty(const ClassTable& table, std::size_t index) {
    const Property& property = (*table.properties)[index];
    Accessor& target = accessors.emplace_back(
        Accessor{&property, index, std::string("get_") + property.name, std::string("set_") + property.name});
    PropertyInfo description(property.type, property.name, property.hint, property.hintText);
    PropertyInfo value(property.type, "value", 0, property.type == type::object ? property.hintText : "");
    addMethod(table, target.getter.c_str(), &target, variantGet, pointerGet, &value, nullptr);
    addMethod(table, target.setter.c_str(), &target, variantSet, pointerSet, nullptr, &value);
    StringName className(table.name), getter(target.getter.c_str()), setter(target.setter.c_str());
    api.registerProperty(api.library, className.get(), &description.info, setter.get(), getter.get());
}

void addGroup(const ClassTable& table, const char* name) {
    String group(name), prefix("");
    api.registerGroup(api.library, StringName(table.name).get(), group.get(), prefix.get());
}

// The creator of an object must send it the notification "created", by a method with this hash. It is sent by
// pointer: a Variant of a new resource would hold its first reference, and free it at the end of its scope.
GDExtensionObjectPtr create(void* data, GDExtensionBool shouldNotify) {
    const ClassTable& table = *static_cast<ClassTable*>(data);
    GDExtensionObjectPtr object = api.constructObject(StringName(table.parent).get());
    api.setInstance(object, StringName(table.name).get(), table.create(object));
    static MethodBind notification;
    static const bool isFound = notification.find("Object", "notification", 4'023'243'586);
    if (shouldNotify != 0 && isFound)
        notification.call<std::int64_t>(object, std::int64_t{notifiedCreated}, static_cast<unsigned char>(0));
    return object;
}
void destroy(void*, GDExtensionClassInstancePtr instance) { delete static_cast<Instance*>(instance); }
void notify(GDExtensionClassInstancePtr instance, std::int32_t what, GDExtensionBool) {
    instanceAt(instance).onNotification(what);
}
void getWarnings(GDExtensionClassInstancePtr instance, const GDExtensionConstTypePtr*,
                 GDExtensionTypePtr result) {
    Variant list = Variant::empty(type::stringArray);
    for (const std::string& line : instanceAt(instance).warnings()) list.call("append", line.c_str());
    api.variantTo(type::stringArray)(result, list.raw());
}
GDExtensionClassCallVirtual findVirtual(void*, GDExtensionConstStringNamePtr name, std::uint32_t) {
    const StringName warningsMethod("_get_configuration_warnings");
    return *static_cast<void* const*>(name) == warningsMethod.interned ? getWarnings : nullptr;
}
} // namespace

void registerClass(const ClassTable& table) {
    GDExtensionClassCreationInfo4 info{};
    info.is_exposed = 1, info.create_instance_func = create, info.free_instance_func = destroy;
    info.notification_func = notify, info.get_virtual_func = findVirtual;
    info.class_userdata = const_cast<ClassTable*>(&table);
    StringName name(table.name), parent(table.parent);
    api.registerClass(api.library, name.get(), parent.get(), &info);
    std::string group;
    for (std::size_t i = 0; i < table.properties->size(); ++i) {
        const char* nextGroup = (*table.properties)[i].group;
        if (group != nextGroup) addGroup(table, nextGroup);
        group = nextGroup;
        addProperty(table, i);
    }
    for (const Method& method : table.methods) {
        PropertyInfo result(method.result, "");
        PropertyInfo argument(type::object, "object", 0,
                              method.argumentClass != nullptr ? method.argumentClass : "");
        addMethod(table, method.name, const_cast<Method*>(&method), variantCall, pointerCall,
                  method.result == type::nil ? nullptr : &result,
                  method.argumentClass != nullptr ? &argument : nullptr);
    }
    if (table.signal == nullptr) return;
    StringName signal(table.signal);
    const PropertyInfo hit(type::dictionary, "hit");
    api.registerSignal(api.library, name.get(), signal.get(), &hit.info, 1);
}

namespace {
std::uint64_t totalChanges = 0;

// True if all keys and values of a dictionary are of the classes in the property's hint, "n/n:KEY;n/n:VALUE",
// or null, as in a row that the editor has just added.
bool matchesClassHint(const Property& property, const Variant& dictionary) {
    const std::string hint = property.hintText;
    const std::size_t first = hint.find(':') + 1, end = hint.find(';'), second = hint.find(':', end) + 1;
    const auto areOfClass = [&](const char* listMethod, const std::string& className) {
        const std::vector<Variant> all = dictionary.call(listMethod).elements();
        return std::ranges::all_of(all, [&](const Variant& entry) {
            return entry.type() == type::nil || entry.call("is_class", className.c_str()).isTrue();
        });
    };
    return areOfClass("keys", hint.substr(first, end - first)) && areOfClass("values", hint.substr(second));
}

// The value as the property stores it; nil if it cannot be used.
Variant toPropertyType(const Property& property, const Variant& value) {
    if (property.type == type::object)
        return value.call("is_class", property.hintText).isTrue() ? value : Variant();
    const auto isNumber = [](GDExtensionVariantType type) { // Godot converts texts to 0
        return type == type::boolean || type == type::integer || type == type::real;
    };
    if (isNumber(property.type) && !isNumber(value.type())) return {};
    const Variant stored = value.as(property.type);
    if (stored.type() != type::dictionary) return stored;
    // A dictionary is shared until it is copied, so a script could change it without a call of set().
    return matchesClassHint(property, stored) ? stored.call("duplicate") : Variant();
}
bool isFinite(const Variant& value) {
    if (value.type() == type::vector2Array) {
        const std::vector<Variant> all = value.elements();
        return std::all_of(all.begin(), all.end(), isFinite);
    }
    const Vector v = value.vector();
    return std::isfinite(value.real()) && std::isfinite(v[0]) && std::isfinite(v[1]) && std::isfinite(v[2]);
}
bool isInRange(const Property& property, const Variant& value) {
    const auto fits = [&](double x) { return x >= property.minimum && x <= property.maximum; };
    if (!(property.minimum < property.maximum)) return true;
    if (property.type != type::vector2) return fits(value.real());
    return fits(value.vector()[0]) && fits(value.vector()[1]);
}
std::string expectedRange(const Property& property) {
    if (!(property.minimum < property.maximum)) return "finite numbers";
    return Variant(property.minimum).text() + " to " + Variant(property.maximum).text();
}
} // namespace

Instance::Instance(GDExtensionObjectPtr godotObject, const std::vector<Property>& classProperties)
    : object(godotObject)
    , properties(classProperties) {
    for (const Property& property : properties) values.push_back(property.defaultValue());
}

std::uint64_t Instance::changeCount() { return totalChanges; }

void Instance::set(std::size_t index, const Variant& value) {
    const Property& property = properties[index];
    const bool isNull = property.type == type::object && value.object() == nullptr &&
                        (value.type() == property.type || value.type() == type::nil);
    const Variant stored = toPropertyType(property, value);
    if (stored.type() == type::nil && !isNull)
        return warn(std::string(property.name) + ": expected " +
                    (property.type == type::dictionary
                         ? "a HapticMaterial by each PhysicsMaterial"
                         : "a value such as '" + property.defaultValue().text() + "'") +
                    ", found " + value.text());
    if (!isFinite(stored) || !isInRange(property, stored))
        return warn(std::string(property.name) + ": expected " + expectedRange(property) + ", found " +
                    value.text());
    values[index] = stored;
    ++totalChanges;
    onPropertyChanged();
}

} // namespace physvib::godot
