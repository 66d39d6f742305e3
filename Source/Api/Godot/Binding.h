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

namespace type {
constexpr auto object = GDEXTENSION_VARIANT_TYPE_OBJECT, nil = GDEXTENSION_VARIANT_TYPE_NIL,
               dictionary = GDEXTENSION_VARIANT_TYPE_DICTIONARY, real = GDEXTENSION_VARIANT_TYPE_FLOAT,
               boolean = GDEXTENSION_VARIANT_TYPE_BOOL, text = GDEXTENSION_VARIANT_TYPE_STRING,
               integer = GDEXTENSION_VARIANT_TYPE_INT, vector2 = GDEXTENSION_VARIANT_TYPE_VECTOR2,
               rid = GDEXTENSION_VARIANT_TYPE_RID, vector3 = GDEXTENSION_VARIANT_TYPE_VECTOR3,
               vector2Array = GDEXTENSION_VARIANT_TYPE_PACKED_VECTOR2_ARRAY,
               stringArray = GDEXTENSION_VARIANT_TYPE_PACKED_STRING_ARRAY,
               name = GDEXTENSION_VARIANT_TYPE_STRING_NAME,
               bytes = GDEXTENSION_VARIANT_TYPE_PACKED_BYTE_ARRAY,
               callable = GDEXTENSION_VARIANT_TYPE_CALLABLE;
} // namespace type

using Vector = std::array<double, 3>; ///< a Vector3, or a Vector2 and 0

/// Address of a function in a library; converts to a pointer to any type of function. Null: it is missing.
struct AnyFunction {
    void* address;
    template <class Function>
    operator Function() const {
        return reinterpret_cast<Function>(address);
    }
};

/// The functions of Godot that are used here, named after what they do; looked up when the extension loads.
struct Functions {
    GDExtensionInterfaceGetProcAddress getAddress = nullptr;
    GDExtensionClassLibraryPtr library = nullptr;
    bool isComplete = true;
    AnyFunction find(const char* name);
    GDExtensionInterfaceVariantNewNil newNilVariant = find("variant_new_nil");
    GDExtensionInterfaceVariantNewCopy copyVariant = find("variant_new_copy");
    GDExtensionInterfaceVariantDestroy destroyVariant = find("variant_destroy");
    GDExtensionInterfaceVariantCall invoke = find("variant_call");
    GDExtensionInterfaceVariantConstruct newVariant = find("variant_construct");
    GDExtensionInterfaceVariantGetType typeOf = find("variant_get_type");
    GDExtensionInterfaceVariantGetNamed getMember = find("variant_get_named");
    GDExtensionInterfaceVariantSetKeyed setElement = find("variant_set_keyed");
    GDExtensionInterfaceGetVariantFromTypeConstructor variantFrom = find("get_variant_from_type_constructor");
    GDExtensionInterfaceGetVariantToTypeConstructor variantTo = find("get_variant_to_type_constructor");
    GDExtensionInterfaceStringNameNewWithLatin1Chars internName = find("string_name_new_with_latin1_chars");
    GDExtensionInterfaceStringNewWithUtf8Chars newString = find("string_new_with_utf8_chars");
    GDExtensionInterfaceStringToUtf8Chars stringToUtf8 = find("string_to_utf8_chars");
    GDExtensionInterfaceVariantStringify stringify = find("variant_stringify");
    GDExtensionInterfaceVariantGetPtrDestructor getDestructor = find("variant_get_ptr_destructor");
    GDExtensionPtrDestructor destroyString = nullptr;
    GDExtensionInterfaceGlobalGetSingleton getSingleton = find("global_get_singleton");
    GDExtensionInterfaceObjectGetInstanceFromId objectFromId = find("object_get_instance_from_id");
    GDExtensionInterfaceObjectGetInstanceId objectId = find("object_get_instance_id");
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
    GDExtensionInterfaceGetLibraryPath getLibraryPath = find("get_library_path");
    GDExtensionInterfacePrintWarningWithMessage printWarning = find("print_warning_with_message");
    GDExtensionInterfaceClassdbGetMethodBind getMethodBind = find("classdb_get_method_bind");
    GDExtensionInterfaceObjectMethodBindPtrcall callByPointer = find("object_method_bind_ptrcall");
    GDExtensionInterfaceRefSetObject setReference = find("ref_set_object");
    GDExtensionsInterfaceEditorHelpLoadXmlFromUtf8Chars loadHelp = nullptr;
};
extern Functions api;
/// Looks up all functions of `api`; false if this Godot lacks one.
bool loadFunctions(GDExtensionInterfaceGetProcAddress getAddress, GDExtensionClassLibraryPtr library);

/// Godot's StringName, a name that is stored once. Godot keeps `literal`, so it must live on.
struct StringName {
    explicit StringName(const char* literal) { api.internName(&interned, literal, 1); }
    void* get() { return &interned; }
    bool operator==(const StringName& other) const = default;
    void* interned = nullptr;
};

/// Godot's String; the destructor frees it.
struct String {
    String() = default; ///< for Godot to fill
    explicit String(const char* utf8Text) { api.newString(&data, utf8Text); }
    ~String() {
        if (data != nullptr) api.destroyString(&data);
    }
    String(const String&) = delete;
    String& operator=(const String&) = delete;
    void* get() { return &data; }
    std::string utf8() const;
    void* data = nullptr;
};

/// Godot's Variant, a value of any of its types.
class Variant {
public:
    Variant() { api.newNilVariant(data.data()); }
    Variant(const Variant& other) { api.copyVariant(data.data(), other.data.data()); }
    Variant& operator=(const Variant& other);
    ~Variant() { api.destroyVariant(data.data()); }
    Variant(double number)
        : Variant(type::real, &number) {}
    Variant(std::int64_t number)
        : Variant(type::integer, &number) {}
    Variant(int number)
        : Variant(std::int64_t{number}) {}
    Variant(bool value);
    Variant(const char* text);
    Variant(GDExtensionObjectPtr object)
        : Variant(type::object, &object) {}
    /// `typed`: a value in Godot's own memory layout, as in calls by pointer.
    Variant(GDExtensionVariantType type, void* typed) { api.variantFrom(type)(data.data(), typed); }
    static Variant copyOf(GDExtensionConstVariantPtr variant);
    static Variant empty(GDExtensionVariantType type);                        ///< such as a dictionary
    static Variant callable(GDExtensionObjectPtr object, const char* method); ///< `method` is a literal
    static Variant vector(const Vector& v, bool is3d);
    /// A copy, converted to that type; nil if Godot cannot convert it.
    Variant as(GDExtensionVariantType type) const;

    GDExtensionVariantType type() const { return api.typeOf(data.data()); }
    double real() const;          ///< 0 if it is no number
    std::int64_t integer() const; ///< 0 if it is no number
    bool isTrue() const { return integer() != 0; }
    std::string text() const;
    GDExtensionObjectPtr object() const;   ///< null if it is none
    std::uint64_t rid() const;             ///< 0 if it is no RID
    Vector vector() const;                 ///< 0 if it is none
    std::vector<Variant> elements() const; ///< of an array

    /// A member or property; nil if there is none. `name` is a literal.
    Variant member(const char* name) const;
    void set(const Variant& key, const Variant& value); ///< of a dictionary
    /// Calls a method, whose `name` is a literal; returns nil if it cannot be called.
    template <class... Arguments>
    Variant call(const char* name, const Arguments&... arguments) const {
        const std::array<Variant, sizeof...(arguments)> values{Variant(arguments)...};
        std::array<GDExtensionConstVariantPtr, sizeof...(arguments) + 1> pointers{};
        for (std::size_t i = 0; i < values.size(); ++i) pointers[i] = values[i].raw();
        return callWith(name, pointers.data(), values.size());
    }
    void assignTo(GDExtensionVariantPtr variant) const; ///< replaces the value of `variant`
    const void* raw() const { return data.data(); }
    void* raw() { return data.data(); }

private:
    template <class Typed>
    Typed typed(GDExtensionVariantType target) const; ///< 0 if it is of another type
    Variant callWith(const char* name, const GDExtensionConstVariantPtr* arguments, std::size_t count) const;
    alignas(8) std::array<unsigned char, 24> data{};
};

/// A method of Godot that is called by pointer, at a tenth of the cost of a call by name. Types are those of
/// such calls: std::int64_t, double, unsigned char for bool, arrays of float for vectors.
class MethodBind {
public:
    /// `hash`: from extension_api.json, identifies the argument types. False: this Godot has no such method.
    bool find(const char* className, const char* method, std::int64_t hash);
    template <class Result, class... Arguments>
    Result call(GDExtensionObjectPtr object, const Arguments&... arguments) const {
        const std::array<GDExtensionConstTypePtr, sizeof...(arguments) + 1> pointers{&arguments...};
        Result result{};
        api.callByPointer(bind, object, pointers.data(), &result);
        return result;
    }

private:
    GDExtensionMethodBindPtr bind = nullptr;
};

Variant singleton(const char* name); ///< one of Godot's servers or globals, such as "Input"
bool isInEditor();                   ///< true in the editor, where the scene does not play
void warn(const std::string& line);  ///< prints a warning in Godot; the same line only once per run

} // namespace physvib::godot
