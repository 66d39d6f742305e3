// SPDX-License-Identifier: MIT
// Reads and writes objects as JSON by their tables (FieldTable.h). Unknown fields are refused before any
// value is read; ranges are checked while reading. Included by .cpp files only, because JSON compiles slowly.
//
// A module adds kinds of values by its own readCustom(json, kind) and writeCustom(kind, value).
#pragma once
#include "Io/Json/FieldTable.h"
#include "Io/Json/JsonField.h"
#include "Io/Json/JsonText.h"
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace physvib {

/// Reads the value of a field of that kind; throws JsonError.
template <class Kind>
auto readByKind(const JsonField& json, const Kind& kind) {
    if constexpr (requires { kind(json); })
        return kind(json);
    else
        return readCustom(json, kind);
}
template <class Kind, class Value>
OrderedJson writeByKind(const Kind& kind, const Value& value) {
    if constexpr (requires { kind.write(value); })
        return kind.write(value);
    else if constexpr (requires(const JsonField& json) { kind(json); })
        return value;
    else
        return writeCustom(kind, value);
}

// A table visitFields(v, FieldsOf<T>{}) calls these functions of its visitor v, in the order of the file:
//   version(name, newest)            the version of the format; called first
//   field(name, member, kind, Need)  a field; `member` gives std::invoke a reference to its value
//   legacyField(name, member, kind)  the name of the next field in older versions
//   has(name, member)                returns true if the fields that depend on this one follow
//   part(name, Need)                 a list that other code reads and writes; the call only fixes its place
// It may use v.object, whose earlier fields have been read already.

/// Visitor that checks the version, and collects the names of the fields that an object may have.
template <class T>
struct FieldNames {
    const JsonField& json;
    const T& object;
    std::vector<std::string_view> names{};

    void version(std::string_view name, int newest) {
        checkVersion(json, name, newest);
        names.push_back(name);
    }
    void field(std::string_view name, const auto&, const auto&, Need = Need::required) {
        names.push_back(name);
    }
    void legacyField(std::string_view name, const auto&, const auto&) { names.push_back(name); }
    void part(std::string_view name, Need = Need::required) { names.push_back(name); }
    bool has(std::string_view, const auto&) const { return true; }
};

template <class T>
struct TableReader {
    const JsonField& json;
    T& object;

    void version(std::string_view, int) const {}
    void field(std::string_view name, const auto& member, const auto& kind,
               Need need = Need::required) const {
        if (need.isOptional && !json.has(name)) return;
        auto&& target = std::invoke(member, object);
        using Target = std::remove_reference_t<decltype(target)>;
        if constexpr (std::is_scalar_v<Target>)
            target = static_cast<Target>(readByKind(json[name], kind));
        else
            target = readByKind(json[name], kind);
    }
    void legacyField(std::string_view name, const auto& member, const auto& kind) const {
        field(name, member, kind, Need::optional);
    }
    void part(std::string_view, Need = Need::required) const {}
    bool has(std::string_view name, const auto&) const { return json.has(name); }
};

template <class T>
struct TableWriter {
    const T& object;
    OrderedJson json = OrderedJson::object();
    const T defaults{};

    void version(std::string_view name, int newest) { json[std::string(name)] = newest; }
    void field(std::string_view name, const auto& member, const auto& kind, Need need = Need::required) {
        OrderedJson value = writeByKind(kind, std::invoke(member, object));
        if (need.isAlwaysWritten || value != writeByKind(kind, std::invoke(member, defaults)))
            json[std::string(name)] = std::move(value);
    }
    void legacyField(std::string_view, const auto&, const auto&) const {}
    void part(std::string_view name, Need need = Need::required) {
        if (need.isAlwaysWritten) json[std::string(name)] = OrderedJson::array();
    }
    bool has(std::string_view, const auto& member) const {
        return std::invoke(member, object) != std::invoke(member, defaults);
    }
};

template <class T, class Table>
void readTable(const JsonField& json, T& object) {
    json.expectObject();
    FieldNames<T> fieldNames{json, object};
    visitFields(fieldNames, FieldsOf<Table>{});
    json.expectOnly(fieldNames.names);
    TableReader<T> reader{json, object};
    visitFields(reader, FieldsOf<Table>{});
}

template <class T, class Table>
OrderedJson writeTable(const T& object) {
    TableWriter<T> writer{object};
    visitFields(writer, FieldsOf<Table>{});
    return std::move(writer.json);
}

} // namespace physvib
