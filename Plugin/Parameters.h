// SPDX-License-Identifier: GPL-3.0-or-later
// Table of all plug-in parameters: id, name, unit, range, default, mapping, labels. The plug-in, its editor,
// its saved state and the table in Docs/plugin.md read it.
#pragma once
#include "Core/PanningLaws.h"
#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace physvib {

/// In the order in which hosts list them. New ones go to the end, before `count`: hosts may number them.
enum class Parameter {
    level,
    law,
    exponent,
    gravity,
    tilt,
    material,
    strikeLevel,
    strikeX,
    strikeY,
    bypass,
    beats,
    music,
    musicSides,
    count
};
constexpr auto parameterCount = static_cast<std::size_t>(Parameter::count);

/// How a host's 0 to 1 runs over the range.
enum class ParameterScale {
    linear,
    log,    ///< equal steps are equal ratios; the range is above 0
    choice, ///< one of `choices`, in equal steps over the range; each keeps its place from 0 to 1 (decision
            ///< 34)
    toggle  ///< 0 or 1
};

struct ParameterRow {
    Parameter parameter; ///< its number, which is its place in the table
    std::string_view id; ///< never changes: sessions of hosts hold on to it
    std::string_view name;
    std::string_view shortName; ///< 8 letters at most, for small displays; its first four tell it from the
                                ///< others
    std::string_view unit;
    double least = 0.0;
    double most = 1.0;
    double initial = 0.0;
    ParameterScale scale = ParameterScale::linear;
    std::span<const std::string_view> choices{};
    int version = 1; ///< of the plug-in that has it first: AU sorts by it
    std::string_view help{};
};

/// Any thread.
const ParameterRow& rowOf(Parameter parameter) noexcept;
const std::array<ParameterRow, parameterCount>& allParameters() noexcept;

/// Parameters that belong together, each in one group, in the order of the table; `level` and `bypass` stand
/// by themselves, the latter before the groups that came after it.
struct ParameterGroup {
    std::string_view id; ///< never changes
    std::string_view name;
    std::span<const Parameter> parameters;
};
std::span<const ParameterGroup> parameterGroups() noexcept; ///< any thread

/// Place of the parameter with that id in the table; -1 if there is none. Any thread.
int parameterOfId(std::string_view id) noexcept;

/// A host's value, 0 to 1, from one in the parameter's unit and back; both clamp. Any thread.
double normalised(const ParameterRow& row, double value) noexcept;
double denormalised(const ParameterRow& row, double normal) noexcept;

/// "-12.0 dB", "energy", "on"; and back, with or without the unit. What cannot be read is the default. Any
/// thread.
std::string valueText(const ParameterRow& row, double value);
double valueOf(const ParameterRow& row, std::string_view text);

/// Of a value of `law`. Any thread.
PanningLaw lawOf(double value) noexcept;

/// A level in dB as a gain; the least level is silence. Any thread.
double gainOfLevel(double levelDb) noexcept;

} // namespace physvib
