// SPDX-License-Identifier: MIT
// The desk of a mixer as a part of session files. For the .cpp files of Files.
#pragma once
#include "Files/JsonField.h"
#include "Files/JsonLines.h"
#include "Files/Mix.h"

namespace physvib {

/// Everything but scene and seed, which are those of the session's last take. Throws JsonError.
Mix readMix(const JsonField& json);
OrderedJson mixJson(const Mix& mix);

} // namespace physvib
