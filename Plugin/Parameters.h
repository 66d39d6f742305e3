// SPDX-License-Identifier: GPL-3.0-or-later
// Values of parameters: a host's 0 to 1, the parameter's unit, and words.
#pragma once
#include "ParameterTable.h"
#include <string>
#include <string_view>

namespace physvib {

/// Any thread.
const ParameterRow& rowOf(Parameter parameter) noexcept;
const std::array<ParameterRow, parameterCount>& allParameters() noexcept;

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
