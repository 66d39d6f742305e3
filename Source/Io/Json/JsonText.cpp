// SPDX-License-Identifier: MIT
// Formats JSON with readable line breaks: a list of objects item by item, a short list on one line.
#include "Io/Json/JsonText.h"
#include "Io/Text/NumberText.h"
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>

template class nlohmann::basic_json<nlohmann::ordered_map>;

namespace physvib {

std::string jsonNumber(double number) {
    return number == 0.0 && std::signbit(number) ? "-0.0" : numberText(number);
}

namespace {

void appendLine(std::string& out, const OrderedJson& value);

void appendName(std::string& out, const std::string& name) {
    const auto isPlain = [](char c) { return c >= ' ' && c <= '~' && c != '"' && c != '\\'; };
    if (std::ranges::all_of(name, isPlain))
        out.append(1, '"').append(name).append("\": ");
    else
        appendLine(out, OrderedJson(name)), out += ": ";
}

// Invalid UTF-8 is replaced by U+FFFD, because JSON does not allow it.
void appendLine(std::string& out, const OrderedJson& value) {
    if (value.is_number_float())
        out += jsonNumber(value.get<double>());
    else if (!value.is_structured())
        out += value.dump(-1, ' ', false, OrderedJson::error_handler_t::replace);
    if (!value.is_structured()) return;
    out += value.is_array() ? "[" : "{ ";
    for (auto item = value.begin(); item != value.end(); ++item) {
        if (item != value.begin()) out += ", ";
        if (value.is_object()) appendName(out, item.key());
        appendLine(out, *item);
    }
    out += value.is_array() ? "]" : " }";
}

void appendLines(std::string& out, const OrderedJson& value, std::size_t indent, std::size_t column) {
    constexpr std::size_t longestLine = 140;
    const bool holdsObjects = value.is_array() && !value.empty() && value.front().is_object();
    const bool isTop = indent == 0 || (indent == 2 && holdsObjects); // a list of objects at the top, such as
                                                                     // bodies, is always broken into lines
    const bool isList = value.is_structured() && !value.empty();
    if (!isList || !isTop) {
        const std::string line = jsonLine(value);
        if (!isList || column + line.size() < longestLine) {
            out += line;
            return;
        }
    }
    const std::string margin(indent + 2, ' ');
    out += value.is_array() ? "[\n" : "{\n";
    for (auto item = value.begin(); item != value.end(); ++item) {
        std::string name;
        if (value.is_object()) appendName(name, item.key());
        out += margin + name;
        appendLines(out, *item, indent + 2, margin.size() + name.size());
        out += std::next(item) == value.end() ? "\n" : ",\n";
    }
    out += std::string(indent, ' ') + (value.is_array() ? "]" : "}");
}

} // namespace

std::string jsonLine(const OrderedJson& value) {
    std::string line;
    appendLine(line, value);
    return line;
}

std::string jsonLines(const OrderedJson& value) {
    std::string out;
    appendLines(out, value, 0, 0);
    return out + "\n";
}

} // namespace physvib
