// SPDX-License-Identifier: MIT
// Where a door's clips come from: reading files is not this room's, and each door reads what it was given.
#pragma once
#include "Core/EnchanterLayout.h"
#include "Io/Result.h"
#include "Live/Session/ContactSounds.h"
#include <functional>
#include <string>
#include <vector>

namespace physvib {

struct LoadedClip {
    std::vector<ContactRecording> channels; ///< one or more, of one file, at one rate, as long as one
                                            ///< another; their file tells path and hash
    std::vector<EnchanterPlace> shares;     ///< of the field, 0 to 1, one per channel; none: the file has no
                                            ///< places
};

/// By the name in a message: the clip, or one line. Called on the thread of the door.
using ClipSource = std::function<Result<LoadedClip>(const std::string& name)>;

} // namespace physvib
