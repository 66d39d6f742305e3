// SPDX-License-Identifier: MIT
// Describes a class to Godot by tables of properties and methods (ClassTable), and holds the properties of an
// object of it (Instance). For Godot's main thread.
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
    Variant (*defaultValue)();
    double minimum, maximum; ///< of a number or of each vector part; both 0: any finite number
    const char* group;       ///< heading in the inspector; "": none
    int hint = 0;            ///< Godot's PropertyHint
    const char* hintText = "";
};

/// An instance of one of our classes; Godot's object owns it and destroys it with itself.
class Instance {
public:
    Instance(GDExtensionObjectPtr object, const std::vector<Property>& properties);
    virtual ~Instance() = default;
    Instance(const Instance&) = delete;
    Instance& operator=(const Instance&) = delete;

    virtual void onNotification(int /*what*/) {}
    virtual void onPropertyChanged() {} ///< called after a property has changed
    virtual std::vector<std::string> warnings() const { return {}; }

    /// Sets a property. If the value cannot be used, reports what was expected and keeps the old one.
    void set(std::size_t property, const Variant& value);
    const Variant& get(std::size_t property) const { return values[property]; }
    Variant self() const { return Variant(object); }
    /// Number of property changes so far, of all instances.
    static std::uint64_t changeCount();

protected:
    GDExtensionObjectPtr object;

private:
    const std::vector<Property>& properties;
    std::vector<Variant> values;
};

struct Method {
    const char* name;
    GDExtensionVariantType result; ///< NIL: none
    Variant (*call)(Instance&, const Variant& argument);
    const char* argumentClass = nullptr; ///< of its argument, an object; null: it has no argument
};

struct ClassTable {
    const char* name;
    const char* parent;
    const std::vector<Property>* properties;
    std::vector<Method> methods;
    const char* signal; ///< whose argument is a dictionary `hit`; null: it has no signal
    Instance* (*create)(GDExtensionObjectPtr object);
};

/// `table` has to live as long as the extension.
void registerClass(const ClassTable& table);

constexpr int notifiedCreated = 0, notifiedEnterTree = 10, notifiedExitTree = 11, notifiedPaused = 14,
              notifiedPhysicsProcess = 16, notifiedProcess = 17; ///< Node.NOTIFICATION_...

} // namespace physvib::godot
