// SPDX-License-Identifier: MIT
// JSON for people: what fits on a line stands on one line, and numbers are the shortest that read back.
#pragma once
#include "Files/NumberText.h"
#include <cmath>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>

namespace physvib {

using OrderedJson = nlohmann::ordered_json; // fields stay in the order they were added

/// The shortest text that JSON reads back as the same bits: "-0" would be read as an integer. Any thread.
inline std::string jsonNumber(double number) {
    return number == 0.0 && std::signbit(number) ? "-0.0" : numberText(number);
}

namespace detail {

/// The value on one line. Bytes that are no UTF-8 cannot stand in JSON and become U+FFFD.
inline std::string onOneLine(const OrderedJson& value) {
    if (value.is_number_float()) return jsonNumber(value.get<double>());
    if (!value.is_structured()) return value.dump(-1, ' ', false, OrderedJson::error_handler_t::replace);
    std::string text = value.is_array() ? "[" : "{ ";
    for (auto item = value.begin(); item != value.end(); ++item) {
        if (item != value.begin()) text += ", ";
        if (value.is_object()) text += onOneLine(OrderedJson(item.key())) + ": ";
        text += onOneLine(*item);
    }
    return text + (value.is_array() ? "]" : " }");
}

inline void appendLines(std::string& out, const OrderedJson& value, std::size_t indent, std::size_t column) {
    constexpr std::size_t longestLine = 140;
    std::string line = onOneLine(value);
    const bool holdsObjects = value.is_array() && !value.empty() && value.front().is_object();
    const bool isTop = indent == 0 || (indent == 2 && holdsObjects); // a list of bodies is never a line
    const bool isList = value.is_structured() && !value.empty();
    if (!isList || (!isTop && column + line.size() < longestLine)) {
        out += line;
        return;
    }
    const std::string margin(indent + 2, ' ');
    out += value.is_array() ? "[\n" : "{\n";
    for (auto item = value.begin(); item != value.end(); ++item) {
        const std::string name = value.is_object() ? onOneLine(OrderedJson(item.key())) + ": " : "";
        out += margin + name;
        appendLines(out, *item, indent + 2, margin.size() + name.size());
        out += std::next(item) == value.end() ? "\n" : ",\n";
    }
    out += std::string(indent, ' ') + (value.is_array() ? "]" : "}");
}

} // namespace detail

/// The value in lines of up to 140 characters, where its parts allow it; a newline at the end. Any thread.
inline std::string jsonLines(const OrderedJson& value) {
    std::string out;
    detail::appendLines(out, value, 0, 0);
    return out + "\n";
}

} // namespace physvib
