// SPDX-License-Identifier: MIT
// The properties of one object.
#include "Api/Godot/Classes.h"

#include <cmath>

namespace physvib::godot {

Instance::Instance(GDExtensionObjectPtr itsObject, const std::vector<Property>& itsProperties)
    : object(itsObject)
    , properties(itsProperties) {
    for (const Property& property : properties) values.push_back(property.standard());
}

namespace {
// Nil: it cannot be used.
Value converted(const Property& property, const Value& value) {
    if (property.type != GDEXTENSION_VARIANT_TYPE_OBJECT) return value.as(property.type);
    return value.call("is_class", property.hintText).isTrue() ? value : Value();
}
bool isFinite(const Value& value) {
    const Vector v = value.vector();
    return std::isfinite(value.real()) && std::isfinite(v[0]) && std::isfinite(v[1]) && std::isfinite(v[2]);
}
} // namespace

void Instance::set(std::size_t index, const Value& value) {
    const Property& property = properties[index];
    const bool isNone = property.type == GDEXTENSION_VARIANT_TYPE_OBJECT && value.object() == nullptr &&
                        (value.type() == property.type || value.type() == GDEXTENSION_VARIANT_TYPE_NIL);
    const Value its = converted(property, value);
    if (its.type() == GDEXTENSION_VARIANT_TYPE_NIL && !isNone)
        return report(std::string(property.name) + ": expected a value such as '" +
                      property.standard().text() + "', found " + value.text());
    const bool isBounded = property.smallest < property.largest;
    if (!isFinite(its) || (isBounded && (its.real() < property.smallest || its.real() > property.largest)))
        return report(std::string(property.name) + ": expected " +
                      (isBounded
                           ? std::to_string(property.smallest) + " to " + std::to_string(property.largest)
                           : "a finite number"));
    values[index] = its;
    changed();
}

} // namespace physvib::godot
