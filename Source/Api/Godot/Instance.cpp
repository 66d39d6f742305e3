// SPDX-License-Identifier: MIT
// The properties of one object.
#include "Api/Godot/Classes.h"

#include <algorithm>
#include <cmath>

namespace physvib::godot {

namespace {
std::uint64_t changes = 0;

// Nil: it cannot be used.
Value converted(const Property& property, const Value& value) {
    if (property.type == GDEXTENSION_VARIANT_TYPE_OBJECT)
        return value.call("is_class", property.hintText).isTrue() ? value : Value();
    const Value its = value.as(property.type);
    // A dictionary is shared until it is copied, and would change without a word.
    return its.type() == GDEXTENSION_VARIANT_TYPE_DICTIONARY ? its.call("duplicate") : its;
}
bool isFinite(const Value& value) {
    if (value.type() == GDEXTENSION_VARIANT_TYPE_PACKED_VECTOR2_ARRAY) {
        const std::vector<Value> all = value.elements();
        return std::all_of(all.begin(), all.end(), isFinite);
    }
    const Vector v = value.vector();
    return std::isfinite(value.real()) && std::isfinite(v[0]) && std::isfinite(v[1]) && std::isfinite(v[2]);
}
bool isWithin(const Property& property, const Value& value) {
    const auto fits = [&](double x) { return x >= property.smallest && x <= property.largest; };
    if (!(property.smallest < property.largest)) return true;
    if (property.type != GDEXTENSION_VARIANT_TYPE_VECTOR2) return fits(value.real());
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
    const bool isNone = property.type == GDEXTENSION_VARIANT_TYPE_OBJECT && value.object() == nullptr &&
                        (value.type() == property.type || value.type() == GDEXTENSION_VARIANT_TYPE_NIL);
    const Value its = converted(property, value);
    if (its.type() == GDEXTENSION_VARIANT_TYPE_NIL && !isNone)
        return report(std::string(property.name) + ": expected a value such as '" +
                      property.standard().text() + "', found " + value.text());
    if (!isFinite(its) || !isWithin(property, its))
        return report(std::string(property.name) + ": expected " + expected(property) + ", found " +
                      value.text());
    values[index] = its;
    ++changes;
    changed();
}

} // namespace physvib::godot
