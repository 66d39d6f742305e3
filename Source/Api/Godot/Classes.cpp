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

// Which property a getter or setter is for; Godot passes it back with each call.
struct Accessor {
    const Property* property;
    std::size_t index;
    std::string getter, setter;
};
std::list<Accessor> accessors; // Godot keeps their addresses

// Names and texts of a property, which Godot copies while it registers it.
struct Described {
    Described(GDExtensionVariantType type, const char* literal, int hint = 0, const char* hintText = "")
        : name(literal)
        , className(type == type::object ? hintText : "")
        , text(hintText) {
        info = {type,       name.get(),  className.get(), static_cast<std::uint32_t>(hint),
                text.get(), usageDefault};
    }
    Name name, className;
    Text text;
    GDExtensionPropertyInfo info{};
};

Instance& instanceAt(GDExtensionClassInstancePtr instance) { return *static_cast<Instance*>(instance); }
const Accessor& accessorAt(void* data) { return *static_cast<Accessor*>(data); }

void callSet(void* data, GDExtensionClassInstancePtr instance, const GDExtensionConstVariantPtr* arguments,
             GDExtensionInt count, GDExtensionVariantPtr, GDExtensionCallError* error) {
    if (count == 1) return instanceAt(instance).set(accessorAt(data).index, Value::copyOf(arguments[0]));
    *error = {count < 1 ? GDEXTENSION_CALL_ERROR_TOO_FEW_ARGUMENTS
                        : GDEXTENSION_CALL_ERROR_TOO_MANY_ARGUMENTS,
              0, 1};
}
void pointerSet(void* data, GDExtensionClassInstancePtr instance, const GDExtensionConstTypePtr* arguments,
                GDExtensionTypePtr) {
    const Accessor& at = accessorAt(data);
    instanceAt(instance).set(at.index, Value(at.property->type, const_cast<void*>(arguments[0])));
}
void callGet(void* data, GDExtensionClassInstancePtr instance, const GDExtensionConstVariantPtr*,
             GDExtensionInt, GDExtensionVariantPtr result, GDExtensionCallError*) {
    const Accessor& at = accessorAt(data);
    const Value& value = instanceAt(instance).get(at.index);
    if (at.property->type == type::object) return value.copyTo(result);
    const bool isShared = at.property->type == type::dictionary;
    // Dictionaries are shared, arrays are not: the caller gets a copy of its own.
    (isShared ? value.call("duplicate") : value.as(at.property->type)).copyTo(result);
}
void pointerGet(void* data, GDExtensionClassInstancePtr instance, const GDExtensionConstTypePtr*,
                GDExtensionTypePtr result) {
    const Accessor& at = accessorAt(data);
    const Value& its = instanceAt(instance).get(at.index);
    if (at.property->type == type::object) { // setReference counts it
        if (its.object() != nullptr) api.setReference(result, its.object());
        return;
    }
    const bool isShared = at.property->type == type::dictionary;
    Value value = isShared ? its.call("duplicate") : its.as(at.property->type);
    if (value.type() == at.property->type) api.toType(value.type())(result, value.raw());
}
void callMethod(void* data, GDExtensionClassInstancePtr instance, const GDExtensionConstVariantPtr* arguments,
                GDExtensionInt count, GDExtensionVariantPtr result, GDExtensionCallError* error) {
    const Method& method = *static_cast<Method*>(data);
    const GDExtensionInt expected = method.argumentClass != nullptr ? 1 : 0;
    if (count == expected)
        return method.call(instanceAt(instance), count > 0 ? Value::copyOf(arguments[0]) : Value())
            .copyTo(result);
    *error = {count < expected ? GDEXTENSION_CALL_ERROR_TOO_FEW_ARGUMENTS
                               : GDEXTENSION_CALL_ERROR_TOO_MANY_ARGUMENTS,
              0, static_cast<std::int32_t>(expected)};
}
void pointerMethod(void* data, GDExtensionClassInstancePtr instance, const GDExtensionConstTypePtr* arguments,
                   GDExtensionTypePtr result) {
    const Method& method = *static_cast<Method*>(data);
    Value value = method.call(
        instanceAt(instance),
        method.argumentClass == nullptr ? Value() : Value(type::object, const_cast<void*>(arguments[0])));
    if (value.type() != type::nil) api.toType(value.type())(result, value.raw());
}

void addMethod(const Class& type, const char* name, void* data, GDExtensionClassMethodCall call,
               GDExtensionClassMethodPtrCall pointer, Described* result, Described* argument) {
    Name className(type.name), methodName(name);
    GDExtensionClassMethodArgumentMetadata plain = GDEXTENSION_METHOD_ARGUMENT_METADATA_NONE;
    GDExtensionClassMethodInfo info{};
    info.name = methodName.get(), info.method_userdata = data, info.call_func = call;
    info.ptrcall_func = pointer, info.method_flags = methodFlagNormal;
    info.has_return_value = result != nullptr;
    info.return_value_info = result != nullptr ? &result->info : nullptr;
    info.argument_count = argument != nullptr ? 1 : 0;
    info.arguments_info = argument != nullptr ? &argument->info : nullptr, info.arguments_metadata = &plain;
    api.registerMethod(api.library, className.get(), &info);
}

void addProperty(const Class& type, std::size_t index) {
    const Property& property = (*type.properties)[index];
    Accessor& at = accessors.emplace_back(
        Accessor{&property, index, std::string("get_") + property.name, std::string("set_") + property.name});
    Described described(property.type, property.name, property.hint, property.hintText);
    Described value(property.type, "value", 0, property.type == type::object ? property.hintText : "");
    addMethod(type, at.getter.c_str(), &at, callGet, pointerGet, &value, nullptr);
    addMethod(type, at.setter.c_str(), &at, callSet, pointerSet, nullptr, &value);
    Name className(type.name), getter(at.getter.c_str()), setter(at.setter.c_str());
    api.registerProperty(api.library, className.get(), &described.info, setter.get(), getter.get());
}

void addGroup(const Class& type, const char* name) {
    Text group(name), prefix("");
    api.registerGroup(api.library, Name(type.name).get(), group.get(), prefix.get());
}

// The creator of an object must send it the notification "created". It is sent by pointer, since a Value of a
// new resource would hold its first reference and free the object when it goes out of scope.
GDExtensionObjectPtr create(void* data, GDExtensionBool isToNotify) {
    const Class& type = *static_cast<Class*>(data);
    GDExtensionObjectPtr object = api.constructObject(Name(type.parent).get());
    api.setInstance(object, Name(type.name).get(), type.create(object));
    static Direct notification;
    static const bool isThere = notification.find("Object", "notification", 4'023'243'586);
    if (isToNotify != 0 && isThere)
        notification.call<std::int64_t>(object, std::int64_t{notifiedCreated}, static_cast<unsigned char>(0));
    return object;
}
void destroy(void*, GDExtensionClassInstancePtr instance) { delete static_cast<Instance*>(instance); }
void notify(GDExtensionClassInstancePtr instance, std::int32_t what, GDExtensionBool) {
    instanceAt(instance).notified(what);
}
void warn(GDExtensionClassInstancePtr instance, const GDExtensionConstTypePtr*, GDExtensionTypePtr result) {
    Value list = Value::empty(type::texts);
    for (const std::string& line : instanceAt(instance).warnings()) list.call("append", line.c_str());
    api.toType(type::texts)(result, list.raw());
}
GDExtensionClassCallVirtual virtualOf(void*, GDExtensionConstStringNamePtr name, std::uint32_t) {
    const Name wanted("_get_configuration_warnings");
    return *static_cast<void* const*>(name) == wanted.interned ? warn : nullptr;
}
} // namespace

void registerClass(const Class& type) {
    GDExtensionClassCreationInfo4 info{};
    info.is_exposed = 1, info.create_instance_func = create, info.free_instance_func = destroy;
    info.notification_func = notify, info.get_virtual_func = virtualOf;
    info.class_userdata = const_cast<Class*>(&type);
    Name name(type.name), parent(type.parent);
    api.registerClass(api.library, name.get(), parent.get(), &info);
    std::string group;
    for (std::size_t i = 0; i < type.properties->size(); ++i) {
        const char* its = (*type.properties)[i].group;
        if (group != its) addGroup(type, its);
        group = its;
        addProperty(type, i);
    }
    for (const Method& method : type.methods) {
        Described result(method.result, "");
        Described argument(type::object, "object", 0,
                           method.argumentClass != nullptr ? method.argumentClass : "");
        addMethod(type, method.name, const_cast<Method*>(&method), callMethod, pointerMethod,
                  method.result == type::nil ? nullptr : &result,
                  method.argumentClass != nullptr ? &argument : nullptr);
    }
    if (type.signal == nullptr) return;
    Name signal(type.signal);
    const Described hit(type::dictionary, "hit");
    api.registerSignal(api.library, name.get(), signal.get(), &hit.info, 1);
}

namespace {
std::uint64_t changes = 0;

// True if each key and value of a dictionary is of the class that the property's hint names, or null, as in a
// row that the editor has just added.
bool isOfItsClasses(const Property& property, const Value& dictionary) {
    const std::string hint = property.hintText;
    const std::size_t first = hint.find(':') + 1, end = hint.find(';'), second = hint.find(':', end) + 1;
    const auto areAll = [&](const char* list, const std::string& name) {
        const std::vector<Value> all = dictionary.call(list).elements();
        return std::ranges::all_of(all, [&](const Value& each) {
            return each.type() == type::nil || each.call("is_class", name.c_str()).isTrue();
        });
    };
    return areAll("keys", hint.substr(first, end - first)) && areAll("values", hint.substr(second));
}

// The value as the property stores it; nil if it cannot be used.
Value converted(const Property& property, const Value& value) {
    if (property.type == type::object)
        return value.call("is_class", property.hintText).isTrue() ? value : Value();
    const auto isNumber = [](GDExtensionVariantType type) { // Godot converts texts to 0
        return type == type::boolean || type == type::whole || type == type::real;
    };
    if (isNumber(property.type) && !isNumber(value.type())) return {};
    const Value its = value.as(property.type);
    if (its.type() != type::dictionary) return its;
    // A dictionary is shared until it is copied, so a script could change it without a call of set().
    return isOfItsClasses(property, its) ? its.call("duplicate") : Value();
}
bool isFinite(const Value& value) {
    if (value.type() == type::places) {
        const std::vector<Value> all = value.elements();
        return std::all_of(all.begin(), all.end(), isFinite);
    }
    const Vector v = value.vector();
    return std::isfinite(value.real()) && std::isfinite(v[0]) && std::isfinite(v[1]) && std::isfinite(v[2]);
}
bool isWithin(const Property& property, const Value& value) {
    const auto fits = [&](double x) { return x >= property.smallest && x <= property.largest; };
    if (!(property.smallest < property.largest)) return true;
    if (property.type != type::vector2) return fits(value.real());
    return fits(value.vector()[0]) && fits(value.vector()[1]);
}
std::string expected(const Property& property) {
    if (!(property.smallest < property.largest)) return "finite numbers";
    return Value(property.smallest).text() + " to " + Value(property.largest).text();
}
} // namespace

Instance::Instance(GDExtensionObjectPtr itsObject, const std::vector<Property>& itsProperties)
    : object(itsObject)
    , properties(itsProperties) {
    for (const Property& property : properties) values.push_back(property.standard());
}

std::uint64_t Instance::revision() { return changes; }

void Instance::set(std::size_t index, const Value& value) {
    const Property& property = properties[index];
    const bool isNone = property.type == type::object && value.object() == nullptr &&
                        (value.type() == property.type || value.type() == type::nil);
    const Value its = converted(property, value);
    if (its.type() == type::nil && !isNone)
        return report(std::string(property.name) + ": expected " +
                      (property.type == type::dictionary
                           ? "a HapticMaterial by each PhysicsMaterial"
                           : "a value such as '" + property.standard().text() + "'") +
                      ", found " + value.text());
    if (!isFinite(its) || !isWithin(property, its))
        return report(std::string(property.name) + ": expected " + expected(property) + ", found " +
                      value.text());
    values[index] = its;
    ++changes;
    changed();
}

} // namespace physvib::godot
