// SPDX-License-Identifier: MIT
// Writes the structs of a scene as JSON, driven by the field table in SceneFields.h; fields with default
// values are omitted. For .cpp files that write JSON.
#pragma once
#include "Io/Json/JsonText.h"
#include "Scene/SceneFields.h"
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace physvib {

namespace detail {

template <class T>
OrderedJson fieldsJson(const T& object, const std::vector<Material>& materials);

template <class T>
class FieldWriter {
public:
    FieldWriter(const T& object, const std::vector<Material>& materials)
        : object_(object)
        , materials_(materials) {}

    template <class F>
    void field(std::string_view name, F T::*member, const Bounds&, Need need) {
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
        return valueJson(*value); // none is the default
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
