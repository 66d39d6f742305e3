// SPDX-License-Identifier: MIT
// Tables of fields: of each its name in files, its place in a struct, its kind, and whether a file may leave
// it out. A table stands beside its struct and needs no JSON; readers, writers and checks visit it.
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

/// Reads and writes every field of `object` by the table of T, or another one; throws JsonError. In
/// FieldJson.h.
template <class T, class Table = T>
void readTable(const class JsonField& json, T& object);
template <class T, class Table = T>
nlohmann::ordered_json writeTable(const T& object);

/// Whether a file may leave a field out, which then has the struct's default.
struct Need {
    bool mayBeLeftOut = false, isAlwaysWritten = true;
    int since = 1; ///< the version of the format that brought the field

    static const Need required; ///< in every file
    static const Need filled;   ///< always written
    static const Need optional; ///< written unless it has its default

    /// The same for a field that files before `version` lack.
    constexpr Need from(int version) const { return {true, isAlwaysWritten, version}; }
    bool operator==(const Need&) const = default;
};
inline constexpr Need Need::required{}, Need::filled{true}, Need::optional{true, false};

/// The accessor of a member's member, for a field.
constexpr auto in(auto outer, auto inner) {
    return [=](auto& object) -> auto& { return std::invoke(inner, std::invoke(outer, object)); };
}

/// The accessor of two members, for one field.
constexpr auto both(auto first, auto second) {
    return [=](auto& object) { return std::tie(std::invoke(first, object), std::invoke(second, object)); };
}

/// Kinds of field values. A kind is called with a JsonField and returns the value; its write() converts the
/// value back if files spell it differently.
namespace kinds {

inline constexpr auto truth = [](const auto& json) { return json.truth(); };
inline constexpr auto text = [](const auto& json) { return json.text(); };
inline constexpr auto number = [](const auto& json) { return json.number(); };
inline constexpr auto positive = [](const auto& json) { return json.positiveNumber(); };
inline constexpr auto name = [](const auto& json) {
    auto found = json.text();
    if (found.empty()) json.fail("expected a name, found an empty string");
    return found;
};
constexpr auto upTo(double most) {
    return [=](const auto& json) { return json.numberUpTo(most); };
}
constexpr auto within(double least, double most) {
    return [=](const auto& json) { return json.numberWithin(least, most); };
}
constexpr auto whole(int least, int most) {
    return [=](const auto& json) { return json.wholeWithin(least, most); };
}

/// An index from 0 that files count from 1; the range is that in files.
struct FromOne {
    int least, most;
    int operator()(const auto& json) const { return static_cast<int>(json.numberWithin(least, most)) - 1; }
    int write(int value) const { return value + 1; }
};

/// An enumeration, by the names of its values.
struct OneOf {
    std::span<const std::string_view> names;
    std::size_t operator()(const auto& json) const { return json.oneOf(names); }
    auto write(auto value) const { return names[static_cast<std::size_t>(value)]; }
};

/// A struct by its own table.
template <class T>
struct Object {
    T operator()(const auto& json) const {
        T object;
        readTable(json, object);
        return object;
    }
    auto write(const T& object) const { return writeTable(object); }
};

/// A list of structs by their table.
template <class T>
struct Objects {
    std::size_t most = std::numeric_limits<std::size_t>::max();
    const char* items = ""; ///< what they are called in errors

    std::vector<T> operator()(const auto& json) const {
        std::vector<T> list;
        if (json.arraySize() > most) json.fail("expected at most " + std::to_string(most) + ' ' + items);
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

/// Kinds that the module's readKind() and writeKind() convert: a T, or a T with an item per channel.
template <class T>
struct Own {};
template <class T>
struct PerChannel {
    int channels;
};

} // namespace physvib
