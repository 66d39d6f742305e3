// SPDX-License-Identifier: MIT
// Checks every field of a scene against its range in SceneFields.h, and reports the first that is outside.
#pragma once
#include "Scene/SceneFields.h"
#include <charconv>
#include <concepts>
#include <string>
#include <vector>

namespace physvib {

namespace detail {

/// The number in at most six digits, the same in every locale.
inline std::string shortNumber(double number) {
    char digits[32];
    return {digits, std::to_chars(digits, digits + sizeof digits, number, std::chars_format::general, 6).ptr};
}

inline std::string rangeError(const std::string& path, double min, double max, double found) {
    return path + ": expected " + shortNumber(min) + " to " + shortNumber(max) + ", found " +
           shortNumber(found);
}

inline std::string itemPath(const std::string& path, std::size_t index) {
    return path + "[" + std::to_string(index) + "]";
}

/// Empty, or the error of a value outside its range; NaN is outside of all ranges.
inline std::string checkRange(const std::string& path, double value, const Bounds& bounds) {
    const bool isInside = value >= bounds.min && value <= bounds.max;
    return isInside ? std::string() : rangeError(path, bounds.min, bounds.max, value);
}
inline std::string checkRange(const std::string& path, int value, const Bounds& bounds) {
    return checkRange(path, static_cast<double>(value), bounds);
}
inline std::string checkRange(const std::string&, std::same_as<bool> auto, const Bounds&) { return {}; }
inline std::string checkRange(const std::string& path, const std::string& text, const Bounds&) {
    return text.empty() ? path + ": expected text, found none" : std::string();
}
inline std::string checkRange(const std::string& path, const Vector& value, const Bounds& bounds) {
    std::string error = checkRange(path + "[0]", value.x, bounds);
    return error.empty() ? checkRange(path + "[1]", value.y, bounds) : error;
}
inline std::string checkRange(const std::string& path, const Interval& value, const Bounds& bounds) {
    if (value.lower > value.upper) return path + ": expected [lower, upper], found them the other way round";
    return checkRange(path, Vector{value.lower, value.upper}, bounds);
}

template <class T>
std::string checkFields(const std::string& path, const T& object, int materials);

/// Visitor that checks the fields of one object; `materials` is the number of materials in the scene.
template <class T>
class RangeCheck {
public:
    RangeCheck(const T& object, std::string path, int materials)
        : object_(object)
        , path_(std::move(path))
        , materials_(materials) {}

    template <class F>
    void field(std::string_view name, F T::*member, const Bounds& bounds, Need need = Need::required) {
        const F& value = object_.*member;
        const bool isDefault = need == Need::optional && value == defaults_.*member;
        if (error.empty() && !isDefault) error = check(pathOf(name), value, bounds);
    }
    void pair(std::string_view name, double T::*first, double T::*second, const Bounds& bounds) {
        if (error.empty()) error = checkRange(pathOf(name), Vector{object_.*first, object_.*second}, bounds);
    }
    template <class E, class Names>
    void choice(std::string_view name, E T::*member, const Names& names) {
        const auto index = static_cast<std::size_t>(object_.*member);
        if (error.empty() && index >= names.size()) error = pathOf(name) + ": expected one of its names";
    }
    void material(std::string_view name, int T::*member) {
        const int index = object_.*member;
        if (error.empty() && (index < 0 || index >= materials_))
            error = pathOf(name) + ": expected one of the " + std::to_string(materials_) +
                    " materials of the scene";
    }
    template <class Variant, class Names>
    void variant(std::string_view, Variant T::*member, const Names&) {
        const auto checkAlternative = [this](const auto& alternative) {
            return checkFields(path_, alternative, materials_);
        };
        if (error.empty()) error = std::visit(checkAlternative, object_.*member);
    }

    std::string error; ///< the first; empty if there is none

private:
    template <class F>
    std::string check(const std::string& path, const F& value, const Bounds& bounds) const {
        if constexpr (requires { checkRange(path, value, bounds); })
            return checkRange(path, value, bounds);
        else
            return checkFields(path, value, materials_);
    }
    template <class F>
    std::string check(const std::string& path, const std::optional<F>& value, const Bounds& bounds) const {
        return value ? check(path, *value, bounds) : std::string();
    }
    template <class F>
    std::string check(const std::string& path, const std::vector<F>& list, const Bounds& bounds) const {
        if (list.size() < bounds.minItems || list.size() > bounds.maxItems)
            return path + ": expected " + std::to_string(bounds.minItems) + " to " +
                   std::to_string(bounds.maxItems) + " items, found " + std::to_string(list.size());
        std::string found;
        for (std::size_t i = 0; i < list.size() && found.empty(); ++i)
            found = check(itemPath(path, i), list[i], bounds);
        return found;
    }
    std::string pathOf(std::string_view name) const {
        return (path_.empty() ? path_ : path_ + ".") + std::string(name);
    }

    const T& object_;
    const T defaults_{};
    std::string path_;
    int materials_;
};

template <class T>
std::string checkFields(const std::string& path, const T& object, int materials) {
    RangeCheck<T> check(object, path, materials);
    visitFields(check, FieldsOf<T>{});
    return std::move(check.error);
}

} // namespace detail

/// The first field outside its range, `bodies[1].fixtures[0].radius_m: expected 0.01 to 100, found 0`; empty
/// if all are inside. Any thread.
inline std::string checkRanges(const Scene& scene) {
    return detail::checkFields("", scene, static_cast<int>(scene.materials.size()));
}
inline std::string checkRanges(const Material& material, const std::string& path) {
    return detail::checkFields(path, material, 0);
}

} // namespace physvib
