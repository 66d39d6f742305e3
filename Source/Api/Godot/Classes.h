// SPDX-License-Identifier: MIT
// A class for Godot as tables of properties and methods, and an instance of it. For Godot's main thread.
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
    const char* group;        ///< heading in the inspector; "": none
    int hint = 0;             ///< Godot's PropertyHint
    const char* hintText = "";
};

/// An instance of one of our classes; Godot's object owns it and destroys it with itself.
class Instance {
public:
    Instance(GDExtensionObjectPtr object, const std::vector<Property>& properties);
    virtual ~Instance() = default;
    Instance(const Instance&) = delete;
    Instance& operator=(const Instance&) = delete;

    virtual void notified(int /*what*/) {}
    virtual void changed() {} ///< called after a property has got another value
    virtual std::vector<std::string> warnings() const { return {}; }

    /// Sets a property. If the value cannot be used, reports what was expected and keeps the old one.
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
    const char* argumentClass = nullptr; ///< of its argument, an object; null: it has no argument
};

struct Class {
    const char* name;
    const char* parent;
    const std::vector<Property>* properties;
    std::vector<Method> methods;
    const char* signal; ///< whose argument is a dictionary `hit`; null: it has no signal
    Instance* (*create)(GDExtensionObjectPtr object);
};

/// `type` has to live as long as the extension.
void registerClass(const Class& type);

constexpr int notifiedCreated = 0, notifiedEnterTree = 10, notifiedExitTree = 11, notifiedPaused = 14,
              notifiedPhysicsProcess = 16, notifiedProcess = 17; ///< Node.NOTIFICATION_...

} // namespace physvib::godot
