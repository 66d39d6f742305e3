// SPDX-License-Identifier: MIT
// Callback by which an input of messages supplies clips. This module reads no files: each input (lines, OSC)
// reads them from its own folder.
#pragma once
#include "Core/EnchanterLayout.h"
#include "Io/Result.h"
#include "Live/Session/ContactSounds.h"
#include <functional>
#include <string>
#include <vector>

namespace physvib {

struct LoadedClip {
    std::vector<ContactRecording> channels; ///< one or more, of one file, equal in rate and length; their
                                            ///< `file` has path and hash
    std::vector<EnchanterPlace> shares; ///< places as shares of the field, 0 to 1, one per channel; empty:
                                        ///< the file has no places
};

/// Loads the clip of the name in a message, or returns a one-line error. Called on the input's thread.
using ClipSource = std::function<Result<LoadedClip>(const std::string& name)>;

} // namespace physvib
