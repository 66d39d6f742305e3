// SPDX-License-Identifier: GPL-3.0-or-later
// physvib-lv2-ports INDEX: a control port for each parameter in LV2's description, the first of that number,
// in the parameter's own unit. JUCE describes parameters as properties, which many hosts neither list nor
// automate (decision 173). Lv2Parts.h reads these ports.
#include "Parameters.h"
#include <algorithm>
#include <charconv>
#include <iostream>
#include <string>

namespace physvib {

namespace {

/// The value with a decimal point: without one, LV2's descriptions (Turtle) have an integer.
std::string number(double value) {
    const std::string text = std::to_string(value);
    return text.substr(0, std::max(text.find('.') + 2, text.find_last_not_of('0') + 1));
}

std::string_view groupOf(Parameter which) {
    for (const auto& group : parameterGroups())
        for (const auto one : group.parameters)
            if (one == which) return group.id;
    return {};
}

std::string unitOf(const ParameterRow& row) {
    if (row.unit == "dB") return "units:db";
    if (row.unit == "deg") return "units:degree";
    if (row.unit == "%") return "units:pc";
    return row.unit == "x" ? "units:coef" : "";
}

// Hosts show `lv2:enabled` instead of bypass; its port remains for sessions that have automated it.
std::string portProperties(const ParameterRow& row) {
    if (row.parameter == Parameter::bypass) return "lv2:toggled , lv2:integer , pprop:notOnGUI";
    if (row.scale == ParameterScale::toggle) return "lv2:toggled , lv2:integer";
    if (row.scale == ParameterScale::choice) return "lv2:enumeration";
    return row.scale == ParameterScale::log ? "pprop:logarithmic" : "";
}

// The choices as points of a scale; a place that repeats the choice before it is none.
std::string scaleOf(const ParameterRow& row) {
    std::string points;
    std::string_view before;
    for (std::size_t i = 0; i < row.choices.size(); ++i) {
        if (row.choices[i] == before) continue;
        before = row.choices[i];
        const double part = static_cast<double>(i) / static_cast<double>(row.choices.size() - 1);
        const double value = row.minimum + (row.maximum - row.minimum) * part;
        points += points.empty() ? " [" : " , [";
        points += " rdfs:label \"" + std::string{before} + "\" ; rdf:value " + number(value) + " ]";
    }
    return points;
}

void print(const ParameterRow& row, int index) {
    const auto line = [](const std::string& words) { std::cout << "\t\t" << words << " ;\n"; };
    line("a lv2:InputPort , lv2:ControlPort");
    line("lv2:index " + std::to_string(index));
    line("lv2:symbol \"" + std::string{row.id} + "\"");
    line("lv2:name \"" + std::string{row.name} + "\"");
    line("lv2:shortName \"" + std::string{row.shortName} + "\"");
    line("lv2:default " + number(row.initial));
    line("lv2:minimum " + number(row.minimum));
    line("lv2:maximum " + number(row.maximum));
    line("rdfs:comment \"" + std::string{row.help} + "\"");
    if (const auto unit = unitOf(row); !unit.empty()) line("units:unit " + unit);
    if (const auto all = portProperties(row); !all.empty()) line("lv2:portProperty " + all);
    const std::string group{groupOf(row.parameter)};
    if (!group.empty()) line("pg:group plug:paramgroup_" + group);
    if (const auto points = scaleOf(row); !points.empty()) line("lv2:scalePoint" + points);
}

} // namespace

} // namespace physvib

int main(int count, char** words) {
    using namespace physvib;
    int first = 0;
    const std::string_view word{count == 2 ? words[1] : ""};
    if (std::from_chars(word.data(), word.data() + word.size(), first).ec != std::errc{} || first < 0) {
        std::cerr << "physvib-lv2-ports: expected the number of the first port\n";
        return 2;
    }
    for (const auto& row : allParameters()) {
        if (row.parameter != Parameter{}) std::cout << "\t] , [\n";
        print(row, first + static_cast<int>(row.parameter));
    }
    return std::cout.flush() ? 0 : 1;
}
