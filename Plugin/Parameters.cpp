// SPDX-License-Identifier: GPL-3.0-or-later
// Conversions of a parameter's values: to and from a host's 0 to 1, text, panning law and gain.
#include "Parameters.h"
#include "Core/Units.h"
#include <charconv>
#include <cmath>

namespace physvib {

namespace {

bool hasChoices(const ParameterRow& row) noexcept { return !row.choices.empty(); }

double choiceStep(const ParameterRow& row) noexcept {
    return (row.maximum - row.minimum) / static_cast<double>(row.choices.size() - 1);
}

std::string_view choiceName(const ParameterRow& row, double value) noexcept {
    return row.choices[static_cast<std::size_t>(
        std::lround((std::clamp(value, row.minimum, row.maximum) - row.minimum) / choiceStep(row)))];
}

} // namespace

const std::array<ParameterRow, parameterCount>& allParameters() noexcept { return parameterTable::rows; }
std::span<const ParameterGroup> parameterGroups() noexcept { return parameterTable::groups; }
const ParameterRow& rowOf(Parameter parameter) noexcept {
    return parameterTable::rows[static_cast<std::size_t>(parameter)];
}

int findParameter(std::string_view id) noexcept {
    const auto& rows = parameterTable::rows;
    const auto found = std::ranges::find(rows, id, &ParameterRow::id);
    return found == rows.end() ? -1 : static_cast<int>(found - rows.begin());
}

double normalised(const ParameterRow& row, double value) noexcept {
    const double v = std::clamp(value, row.minimum, row.maximum);
    if (row.scale == ParameterScale::log)
        return std::log(v / row.minimum) / std::log(row.maximum / row.minimum);
    return (v - row.minimum) / (row.maximum - row.minimum);
}

double denormalised(const ParameterRow& row, double normal) noexcept {
    const double n = std::clamp(normal, 0.0, 1.0);
    if (row.scale == ParameterScale::log) return row.minimum * std::pow(row.maximum / row.minimum, n);
    const double value = row.minimum + n * (row.maximum - row.minimum);
    return hasChoices(row)
               ? row.minimum + choiceStep(row) * std::round((value - row.minimum) / choiceStep(row))
               : value;
}

std::string valueText(const ParameterRow& row, double value) {
    if (hasChoices(row)) return std::string{choiceName(row, value)};
    if (row.unit == "dB" && value <= row.minimum) return "-inf dB";
    std::array<char, 32> digits{};
    const int decimals = row.unit == "x" || row.unit.empty() ? 2 : 1;
    const double shown = std::abs(value) < 0.5 * std::pow(10.0, -decimals) ? 0.0 : value; // not "-0.0"
    const auto end =
        std::to_chars(digits.data(), digits.data() + digits.size(), shown, std::chars_format::fixed, decimals)
            .ptr;
    const std::string number{digits.data(), end};
    return row.unit.empty() ? number : number + " " + std::string{row.unit};
}

double valueFromText(const ParameterRow& row, std::string_view text) {
    const auto word = std::ranges::find(row.choices, text);
    if (hasChoices(row))
        return word == row.choices.end()
                   ? row.initial
                   : row.minimum + choiceStep(row) * static_cast<double>(word - row.choices.begin());
    while (!text.empty() && (text.front() == ' ' || text.front() == '+')) text.remove_prefix(1);
    if (text.starts_with("-inf")) return row.minimum;
    double value = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return error == std::errc{} && std::isfinite(value) ? std::clamp(value, row.minimum, row.maximum)
                                                        : row.initial;
}

PanningLaw lawFromValue(double value) noexcept {
    PanningLaw law{};
    panningLawNamed(choiceName(rowOf(Parameter::law), value), law);
    return law;
}

double gainFromLevelDb(double levelDb) noexcept {
    return levelDb <= parameterTable::silentDb ? 0.0 : fromDecibels(levelDb);
}

} // namespace physvib
