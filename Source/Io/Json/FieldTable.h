// SPDX-License-Identifier: MIT
// Tables of fields: a field's name in files, its member in a struct, the kind of its value, and whether a
// file may omit it. A table stands beside its struct and needs no JSON; readers, writers and checks visit it.
#pragma once
#include <functional>
#include <limits>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

namespace physvib {

/// visitFields(v, FieldsOf<T>{}) calls v once per field of T, in the order in which they are written.
template <class T>
struct FieldsOf {};

/// Reads or writes all fields of `object` by a table (FieldJson.h); throws JsonError.
template <class T, class Table = T>
void readTable(const class JsonField& json, T& object);
template <class T, class Table = T>
nlohmann::ordered_json writeTable(const T& object);

/// Whether files must have a field; one that a file omits has the struct's default.
struct Need {
    bool isOptional = false, isAlwaysWritten = true;
    int since = 1; ///< the version of the format that brought the field

    static const Need required; ///< in every file
    static const Need filled;   ///< always written, but may be missing in files that are read
    static const Need optional; ///< may be missing; not written if it equals its default

    /// The need of a field that files of versions before `version` do not have.
    constexpr Need from(int version) const { return {true, isAlwaysWritten, version}; }
    bool operator==(const Need&) const = default;
};
inline constexpr Need Need::required{}, Need::filled{true}, Need::optional{true, false};

/// Accessor of the member `inner` of the member `outer`, for one field.
constexpr auto nest(auto outer, auto inner) {
    return [=](auto& object) -> auto& { return std::invoke(inner, std::invoke(outer, object)); };
}

/// Accessor of two members as a tuple of references, for one field.
constexpr auto memberPair(auto first, auto second) {
    return [=](auto& object) { return std::tie(std::invoke(first, object), std::invoke(second, object)); };
}

/// Kinds of field values. A kind is called with a JsonField and returns the value; its write() converts the
/// value back if files spell it differently.
namespace kinds {

inline constexpr auto boolean = [](const auto& json) { return json.boolean(); };
inline constexpr auto text = [](const auto& json) { return json.text(); };
inline constexpr auto number = [](const auto& json) { return json.number(); };
inline constexpr auto positive = [](const auto& json) { return json.positiveNumber(); };
inline constexpr auto name = [](const auto& json) {
    auto value = json.text();
    if (value.empty()) json.fail("expected a name, found an empty string");
    return value;
};
constexpr auto upTo(double max) {
    return [=](const auto& json) { return json.numberUpTo(max); };
}
constexpr auto range(double min, double max) {
    return [=](const auto& json) { return json.numberWithin(min, max); };
}
constexpr auto wholeNumber(int min, int max) {
    return [=](const auto& json) { return json.wholeNumberWithin(min, max); };
}

/// An index that counts from 0 in memory and from 1 in files; `min` and `max` are as in files.
struct OneBased {
    int min, max;
    int operator()(const auto& json) const { return json.wholeNumberWithin(min, max) - 1; }
    int write(int value) const { return value + 1; }
};

/// Kind of an enumeration, which files name by `names`.
struct OneOf {
    std::span<const std::string_view> names;
    std::size_t operator()(const auto& json) const { return json.oneOf(names); }
    auto write(auto value) const { return names[static_cast<std::size_t>(value)]; }
};

/// Kind of a struct that has a table of its own.
template <class T>
struct Object {
    T operator()(const auto& json) const {
        T object;
        readTable(json, object);
        return object;
    }
    auto write(const T& object) const { return writeTable(object); }
};

/// Kind of a list of structs that have a table.
template <class T>
struct Objects {
    std::size_t max = std::numeric_limits<std::size_t>::max();
    const char* items = ""; ///< their plural noun in error messages

    std::vector<T> operator()(const auto& json) const {
        std::vector<T> list;
        if (json.arraySize() > max) json.fail("expected at most " + std::to_string(max) + ' ' + items);
        for (std::size_t i = 0; i < json.arraySize(); ++i) readTable(json.item(i), list.emplace_back());
        return list;
    }
    auto write(const std::vector<T>& list) const {
        std::vector<decltype(writeTable(list.front()))> array;
        for (const T& object : list) array.push_back(writeTable(object));
        return array;
    }
};

} // namespace kinds

/// Kinds that a module's own readCustom() and writeCustom() convert: a T, or a T with one item per channel.
template <class T>
struct Custom {};
template <class T>
struct PerChannel {
    int channels;
};

} // namespace physvib
