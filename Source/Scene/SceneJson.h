// SPDX-License-Identifier: MIT
// Reads the structs of a scene from JSON and writes them by the field table in SceneFields.h; fields with
// default values are not written. Included by .cpp files only.
#pragma once
#include "Io/Json/JsonField.h"
#include "Io/Json/JsonText.h"
#include "Io/Text/NumberText.h"
#include "Scene/SceneFields.h"
#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

namespace physvib {

using Materials = std::vector<Material>; // materials that fixtures may refer to

namespace detail {

/// For text, `max` is its length in bytes; lists of texts have no limit.
inline void readValue(const JsonField& json, std::string& out, const Bounds& bounds, const Materials&) {
    const bool isBounded = bounds.max > 0.0 && bounds.max < Bounds{}.max;
    out = isBounded ? json.text(static_cast<std::size_t>(bounds.max)) : json.text();
}
inline void readValue(const JsonField& json, bool& out, const Bounds&, const Materials&) {
    out = json.boolean();
}
inline void readValue(const JsonField& json, double& out, const Bounds&, const Materials&) {
    out = json.number();
}
inline void readValue(const JsonField& json, int& out, const Bounds&, const Materials&) {
    out = json.wholeNumber();
}

inline std::array<double, 2> readPair(const JsonField& json) {
    if (const std::size_t size = json.arraySize(); size != 2)
        json.fail("expected 2 numbers, found " + std::to_string(size) + " items");
    return {json.item(0).number(), json.item(1).number()};
}
inline void readValue(const JsonField& json, Vector& out, const Bounds&, const Materials&) {
    const auto [x, y] = readPair(json);
    out = {x, y};
}
inline void readValue(const JsonField& json, Interval& out, const Bounds&, const Materials&) {
    const auto [lower, upper] = readPair(json);
    out = {lower, upper};
}

template <class T>
void readValue(const JsonField& json, T& out, const Bounds&, const Materials& materials);
template <class T>
void readValue(const JsonField& json, std::optional<T>& out, const Bounds& bounds,
               const Materials& materials) {
    readValue(json, out.emplace(), bounds, materials);
}
template <class T>
void readValue(const JsonField& json, std::vector<T>& out, const Bounds& bounds, const Materials& materials) {
    const std::size_t size = json.arraySize();
    if (size > bounds.maxItems)
        json.fail("expected at most " + std::to_string(bounds.maxItems) + " items, found " +
                  std::to_string(size));
    out.resize(size);
    for (std::size_t i = 0; i < size; ++i) readValue(json.item(i), out[i], bounds, materials);
}

/// Reads the fields of one object. Reports unknown fields before missing ones: a typo causes both.
template <class T>
class FieldReader {
public:
    FieldReader(const JsonField& json, T& object, const Materials& materials)
        : json_(json)
        , object_(object)
        , materials_(materials) {
        json.expectObject();
    }

    template <class F>
    void field(std::string_view name, F T::*member, const Bounds& bounds, Need need = Need::required) {
        if (isPresent(name, need)) readValue(json_[name], object_.*member, bounds, currentMaterials());
    }
    void pair(std::string_view name, double T::*first, double T::*second, const Bounds&) {
        if (!isPresent(name, Need::required)) return;
        const auto numbers = readPair(json_[name]);
        object_.*first = numbers[0];
        object_.*second = numbers[1];
    }
    template <class E, class Names>
    void choice(std::string_view name, E T::*member, const Names& names) {
        if (isPresent(name, Need::optional)) object_.*member = static_cast<E>(json_[name].oneOf(names));
    }
    void material(std::string_view name, int T::*member) {
        if (!isPresent(name, Need::required)) return;
        const std::string materialName = json_[name].text();
        const auto* found = findNamed(materials_, materialName);
        if (found == nullptr)
            json_[name].fail("expected the name of a material, found " + inQuotes(materialName));
        object_.*member = static_cast<int>(found - materials_.data());
    }
    template <class... Kinds, class Names>
    void variant(std::string_view name, std::variant<Kinds...> T::*member, const Names& names) {
        static_assert(sizeof...(Kinds) == std::tuple_size_v<Names>);
        if (!isPresent(name, Need::required)) return;
        const std::size_t kind = json_[name].oneOf(names);
        std::size_t index = 0;
        (..., (index++ == kind ? readAlternative((object_.*member).template emplace<Kinds>()) : void()));
    }

    void finish() const {
        json_.expectOnly(fieldNames_);
        if (!firstMissing_.empty()) static_cast<void>(json_[firstMissing_]); // which throws
    }

    std::vector<std::string_view>& fieldNames() { return fieldNames_; }
    std::string_view firstMissing() const { return firstMissing_; }

private:
    bool isPresent(std::string_view name, Need need) {
        fieldNames_.push_back(name);
        const bool found = json_.has(name);
        if (!found && need == Need::required && firstMissing_.empty()) firstMissing_ = name;
        return found;
    }

    template <class Kind>
    void readAlternative(Kind& kind) {
        FieldReader<Kind> reader(json_, kind, materials_);
        visitFields(reader, FieldsOf<Kind>{});
        fieldNames_.insert(fieldNames_.end(), reader.fieldNames().begin(), reader.fieldNames().end());
        if (firstMissing_.empty()) firstMissing_ = reader.firstMissing();
    }

    /// The materials that fields refer to: those of a scene once they are read.
    const Materials& currentMaterials() const {
        if constexpr (requires(T t) { t.materials; })
            return object_.materials;
        else
            return materials_;
    }

    const JsonField json_;
    T& object_;
    const Materials& materials_;
    std::vector<std::string_view> fieldNames_;
    std::string_view firstMissing_;
};

template <class T>
void readValue(const JsonField& json, T& out, const Bounds&, const Materials& materials) {
    if (std::is_same_v<T, Normalisation> && json.equals("auto")) return; // all members stay nullopt
    FieldReader<T> reader(json, out, materials);
    visitFields(reader, FieldsOf<T>{});
    reader.finish();
}

} // namespace detail

/// Reads the fields of an object; other fields are errors. Checks types and list lengths, but leaves ranges
/// to validate(). Throws JsonError.
template <class T>
T readFields(const JsonField& json) {
    T object;
    const Materials none;
    detail::readValue(json, object, {}, none);
    return object;
}

namespace detail {

template <class T>
OrderedJson fieldsJson(const T& object, const std::vector<Material>& materials);

/// Writes the fields of one object to `json`, without those that have their defaults.
template <class T>
class FieldWriter {
public:
    FieldWriter(const T& object, const std::vector<Material>& materials)
        : object_(object)
        , materials_(materials) {}

    template <class F>
    void field(std::string_view name, F T::*member, const Bounds&, Need need = Need::required) {
        const F& value = object_.*member;
        if (need == Need::required || !(value == defaults_.*member)) add(name, valueJson(value));
    }
    void pair(std::string_view name, double T::*first, double T::*second, const Bounds&) {
        add(name, valueJson(Vector{object_.*first, object_.*second}));
    }
    template <class E, class Names>
    void choice(std::string_view name, E T::*member, const Names& names) {
        const E value = object_.*member;
        if (value != defaults_.*member) add(name, std::string(names[static_cast<std::size_t>(value)]));
    }
    void material(std::string_view name, int T::*member) {
        add(name, materials_[static_cast<std::size_t>(object_.*member)].name);
    }
    template <class Variant, class Names>
    void variant(std::string_view name, Variant T::*member, const Names& names) {
        const Variant& value = object_.*member;
        add(name, std::string(names[value.index()]));
        const auto fieldsOf = [this](const auto& kind) { return fieldsJson(kind, materials_); };
        json.update(std::visit(fieldsOf, value));
    }

    OrderedJson json = OrderedJson::object();

private:
    void add(std::string_view name, OrderedJson value) { json[std::string(name)] = std::move(value); }

    template <class F>
    OrderedJson valueJson(const F& value) const {
        if constexpr (
            requires { OrderedJson(value); } &&
            !requires(int visitor) { visitFields(visitor, FieldsOf<F>{}); })
            return value;
        else
            return fieldsJson(value, materials_);
    }
    OrderedJson valueJson(const Vector& v) const { return OrderedJson::array({v.x, v.y}); }
    OrderedJson valueJson(const Interval& i) const { return OrderedJson::array({i.lower, i.upper}); }
    template <class F>
    OrderedJson valueJson(const std::optional<F>& value) const {
        return valueJson(*value); // called for values only: nullopt is the default
    }
    template <class F>
    OrderedJson valueJson(const std::vector<F>& list) const {
        OrderedJson array = OrderedJson::array();
        for (const F& item : list) array.push_back(valueJson(item));
        return array;
    }

    const T& object_;
    const T defaults_{};
    const std::vector<Material>& materials_;
};

template <class T>
OrderedJson fieldsJson(const T& object, const std::vector<Material>& materials) {
    FieldWriter<T> writer(object, materials);
    visitFields(writer, FieldsOf<T>{});
    return std::move(writer.json);
}

} // namespace detail

} // namespace physvib
