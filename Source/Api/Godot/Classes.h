// SPDX-License-Identifier: MIT
// A class of Godot as a table of its properties and methods, and an instance of one. For Godot's main thread.
#pragma once

#include "Api/Godot/Binding.h"

#include <cstddef>
#include <string>
#include <vector>

namespace physvib::godot {

/// A property of a class, with its place in the inspector.
struct Property {
    const char* name;
    GDExtensionVariantType type;
    Value (*standard)();      ///< its default
    double smallest, largest; ///< of a number, or each part of a vector; both 0: any that is finite
    const char* group;        ///< of the inspector; "": none
    int hint = 0;             ///< Godot's PropertyHint
    const char* hintText = "";
};

/// An instance of one of our classes, owned by Godot's object of the same life.
class Instance {
public:
    Instance(GDExtensionObjectPtr object, const std::vector<Property>& properties);
    virtual ~Instance() = default;
    Instance(const Instance&) = delete;
    Instance& operator=(const Instance&) = delete;

    virtual void notified(int /*what*/) {}
    virtual void changed() {} ///< a property has another value
    virtual std::vector<std::string> warnings() const { return {}; }

    /// Keeps the old value, and reports what was expected, if the new one cannot be used.
    void set(std::size_t property, const Value& value);
    const Value& get(std::size_t property) const { return values[property]; }
    Value self() const { return Value(object); }
    /// Rises with each new value of any property of any instance.
    static std::uint64_t revision();

protected:
    GDExtensionObjectPtr object;

private:
    const std::vector<Property>& properties;
    std::vector<Value> values;
};

struct Method {
    const char* name;
    GDExtensionVariantType result; ///< NIL: none
    Value (*call)(Instance&, const Value& argument);
    const char* argumentClass = nullptr; ///< of the one argument, an object; null: there is none
};

struct Class {
    const char* name;
    const char* parent;
    const std::vector<Property>* properties;
    std::vector<Method> methods;
    const char* signal; ///< with a dictionary named `hit`; null: none
    Instance* (*create)(GDExtensionObjectPtr object);
};

/// `type` has to live as long as the extension.
void registerClass(const Class& type);

constexpr int notifiedCreated = 0, notifiedEnterTree = 10, notifiedExitTree = 11, notifiedPaused = 14,
              notifiedPhysicsProcess = 16, notifiedProcess = 17; ///< Node.NOTIFICATION_...

} // namespace physvib::godot
