// SPDX-License-Identifier: MIT
// Godot's variants, strings and method calls, by its C header. Methods are called by name, or by pointer
// where each tick calls them per body. One binary fits Godot 4.4 and later. For Godot's main thread.
#pragma once

#include <gdextension_interface.h>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace physvib::godot {

/// Godot's types of values.
namespace type {
constexpr auto object = GDEXTENSION_VARIANT_TYPE_OBJECT, nil = GDEXTENSION_VARIANT_TYPE_NIL,
               dictionary = GDEXTENSION_VARIANT_TYPE_DICTIONARY, real = GDEXTENSION_VARIANT_TYPE_FLOAT,
               boolean = GDEXTENSION_VARIANT_TYPE_BOOL, text = GDEXTENSION_VARIANT_TYPE_STRING,
               whole = GDEXTENSION_VARIANT_TYPE_INT, vector2 = GDEXTENSION_VARIANT_TYPE_VECTOR2,
               rid = GDEXTENSION_VARIANT_TYPE_RID, vector3 = GDEXTENSION_VARIANT_TYPE_VECTOR3,
               places = GDEXTENSION_VARIANT_TYPE_PACKED_VECTOR2_ARRAY,
               texts = GDEXTENSION_VARIANT_TYPE_PACKED_STRING_ARRAY,
               name = GDEXTENSION_VARIANT_TYPE_STRING_NAME,
               bytes = GDEXTENSION_VARIANT_TYPE_PACKED_BYTE_ARRAY,
               callable = GDEXTENSION_VARIANT_TYPE_CALLABLE;
} // namespace type

using Vector = std::array<double, 3>; ///< a Vector3, or a Vector2 and 0

/// Address of a function, which converts to any function pointer; null if the library lacks it.
struct Symbol {
    void* address;
    template <class Function>
    operator Function() const {
        return reinterpret_cast<Function>(address);
    }
};

/// The functions of Godot that are used here, looked up once when Godot loads the extension.
struct Functions {
    GDExtensionInterfaceGetProcAddress get = nullptr;
    GDExtensionClassLibraryPtr library = nullptr;
    bool isWhole = true;
    Symbol find(const char* name);
    GDExtensionInterfaceVariantNewNil newNil = find("variant_new_nil");
    GDExtensionInterfaceVariantNewCopy newCopy = find("variant_new_copy");
    GDExtensionInterfaceVariantDestroy destroy = find("variant_destroy");
    GDExtensionInterfaceVariantCall call = find("variant_call");
    GDExtensionInterfaceVariantConstruct construct = find("variant_construct");
    GDExtensionInterfaceVariantGetType getType = find("variant_get_type");
    GDExtensionInterfaceVariantGetNamed getNamed = find("variant_get_named");
    GDExtensionInterfaceVariantSetKeyed setKeyed = find("variant_set_keyed");
    GDExtensionInterfaceGetVariantFromTypeConstructor fromType = find("get_variant_from_type_constructor");
    GDExtensionInterfaceGetVariantToTypeConstructor toType = find("get_variant_to_type_constructor");
    GDExtensionInterfaceStringNameNewWithLatin1Chars newName = find("string_name_new_with_latin1_chars");
    GDExtensionInterfaceStringNewWithUtf8Chars newText = find("string_new_with_utf8_chars");
    GDExtensionInterfaceStringToUtf8Chars toUtf8 = find("string_to_utf8_chars");
    GDExtensionInterfaceVariantStringify stringify = find("variant_stringify");
    GDExtensionInterfaceVariantGetPtrDestructor destructor = find("variant_get_ptr_destructor");
    GDExtensionPtrDestructor freeText = nullptr;
    GDExtensionInterfaceGlobalGetSingleton singleton = find("global_get_singleton");
    GDExtensionInterfaceObjectGetInstanceFromId instanceFromId = find("object_get_instance_from_id");
    GDExtensionInterfaceObjectGetInstanceId instanceId = find("object_get_instance_id");
    GDExtensionInterfaceObjectSetInstance setInstance = find("object_set_instance");
    GDExtensionInterfaceClassdbConstructObject2 constructObject = find("classdb_construct_object2");
    GDExtensionInterfaceClassdbRegisterExtensionClass4 registerClass =
        find("classdb_register_extension_class4");
    GDExtensionInterfaceClassdbRegisterExtensionClassMethod registerMethod =
        find("classdb_register_extension_class_method");
    GDExtensionInterfaceClassdbRegisterExtensionClassProperty registerProperty =
        find("classdb_register_extension_class_property");
    GDExtensionInterfaceClassdbRegisterExtensionClassPropertyGroup registerGroup =
        find("classdb_register_extension_class_property_group");
    GDExtensionInterfaceClassdbRegisterExtensionClassSignal registerSignal =
        find("classdb_register_extension_class_signal");
    GDExtensionInterfaceClassdbUnregisterExtensionClass unregisterClass =
        find("classdb_unregister_extension_class");
    GDExtensionInterfaceGetLibraryPath libraryPath = find("get_library_path");
    GDExtensionInterfacePrintWarningWithMessage printWarning = find("print_warning_with_message");
    GDExtensionInterfaceClassdbGetMethodBind methodBind = find("classdb_get_method_bind");
    GDExtensionInterfaceObjectMethodBindPtrcall pointerCall = find("object_method_bind_ptrcall");
    GDExtensionInterfaceRefSetObject setReference = find("ref_set_object");
    GDExtensionsInterfaceEditorHelpLoadXmlFromUtf8Chars loadHelp = nullptr;
};
extern Functions api;
/// Looks up all of them; false: this Godot lacks one.
bool lookUp(GDExtensionInterfaceGetProcAddress get, GDExtensionClassLibraryPtr library);

/// An interned name; `literal` has to live as long as the program, since Godot keeps it.
struct Name {
    explicit Name(const char* literal) { api.newName(&interned, literal, 1); }
    void* get() { return &interned; }
    bool operator==(const Name& other) const = default;
    void* interned = nullptr;
};

/// A String, freed with this.
struct Text {
    Text() = default; ///< for Godot to fill
    explicit Text(const char* utf8Text) { api.newText(&data, utf8Text); }
    ~Text() {
        if (data != nullptr) api.freeText(&data);
    }
    Text(const Text&) = delete;
    Text& operator=(const Text&) = delete;
    void* get() { return &data; }
    std::string utf8() const;
    void* data = nullptr;
};

/// A Variant.
class Value {
public:
    Value() { api.newNil(data.data()); }
    Value(const Value& other) { api.newCopy(data.data(), other.data.data()); }
    Value& operator=(const Value& other);
    ~Value() { api.destroy(data.data()); }
    Value(double number)
        : Value(type::real, &number) {}
    Value(std::int64_t number)
        : Value(type::whole, &number) {}
    Value(int number)
        : Value(std::int64_t{number}) {}
    Value(bool is);
    Value(const char* text);
    Value(GDExtensionObjectPtr object)
        : Value(type::object, &object) {}
    /// `typed`: a value in Godot's own memory layout, as in calls by pointer.
    Value(GDExtensionVariantType type, void* typed) { api.fromType(type)(data.data(), typed); }
    static Value copyOf(GDExtensionConstVariantPtr variant);
    static Value empty(GDExtensionVariantType type);                        ///< such as a dictionary
    static Value callable(GDExtensionObjectPtr object, const char* method); ///< `method` is a literal
    static Value vector(const Vector& v, bool isSpace);
    /// A copy, converted to that type; nil if Godot cannot convert it.
    Value as(GDExtensionVariantType type) const;

    GDExtensionVariantType type() const { return api.getType(data.data()); }
    double real() const;        ///< 0 if it is no number
    std::int64_t whole() const; ///< 0 if it is no number
    bool isTrue() const { return whole() != 0; }
    std::string text() const;
    GDExtensionObjectPtr object() const; ///< null if it is none
    std::uint64_t rid() const;           ///< 0 if it is no RID
    Vector vector() const;               ///< 0 if it is none
    std::vector<Value> elements() const; ///< of an array

    /// A member or property; nil if there is none. `name` is a literal.
    Value member(const char* name) const;
    void set(const Value& key, const Value& value); ///< of a dictionary
    /// Calls a method, whose `name` is a literal; returns nil if it cannot be called.
    template <class... Arguments>
    Value call(const char* name, const Arguments&... arguments) const {
        const std::array<Value, sizeof...(arguments)> values{Value(arguments)...};
        std::array<GDExtensionConstVariantPtr, sizeof...(arguments) + 1> pointers{};
        for (std::size_t i = 0; i < values.size(); ++i) pointers[i] = values[i].raw();
        return callWith(name, pointers.data(), values.size());
    }
    void copyTo(GDExtensionVariantPtr variant) const; ///< which must be initialised
    const void* raw() const { return data.data(); }
    void* raw() { return data.data(); }

private:
    template <class Typed>
    Typed typed(GDExtensionVariantType wanted) const; ///< 0 if it is of another type
    Value callWith(const char* name, const GDExtensionConstVariantPtr* arguments, std::size_t count) const;
    alignas(8) std::array<unsigned char, 24> data{};
};

/// A method that is called by pointer, at a tenth of the cost of a call by name. The types have to be those
/// of Godot's calls by pointer: std::int64_t, double, unsigned char for bool, floats of a vector.
class Direct {
public:
    /// `hash`: of the types of its arguments, from extension_api.json. False: this Godot has no such method.
    bool find(const char* className, const char* method, std::int64_t hash);
    template <class Result, class... Arguments>
    Result call(GDExtensionObjectPtr object, const Arguments&... arguments) const {
        const std::array<GDExtensionConstTypePtr, sizeof...(arguments) + 1> pointers{&arguments...};
        Result result{};
        api.pointerCall(bind, object, pointers.data(), &result);
        return result;
    }

private:
    GDExtensionMethodBindPtr bind = nullptr;
};

Value singleton(const char* name);    ///< such as "Input"
bool isInEditor();                    ///< the editor shows the scene, nothing plays
void report(const std::string& line); ///< prints a warning in Godot; the same line only once per run

} // namespace physvib::godot
