// SPDX-License-Identifier: MIT
// Render controls and panners as parts of JSON files and lines. For the .cpp files of Files.
#pragma once
#include "Core/RenderControl.h"
#include "Files/Json/JsonField.h"
#include "Files/Json/JsonLines.h"
#include <array>
#include <string_view>

namespace physvib {

inline constexpr std::array<std::string_view, 6> controlNames{"layout", "gain", "mute", "stop", "delay", "ceiling"}; // as Kind

/// Layout, law, exponent and field; at most `channels` enchanters. Throws JsonError.
PhantomPanner readPanner(const JsonField& json, int channels);

/// A control without its time; `otherFields` may stand beside it. Throws JsonError.
RenderControl readControl(const JsonField& json, int channels, std::string_view otherField = {});

OrderedJson pannerJson(const PhantomPanner& panner);
OrderedJson controlJson(const RenderControl& control); ///< without its time

} // namespace physvib
