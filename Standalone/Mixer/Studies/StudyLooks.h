// SPDX-License-Identifier: GPL-3.0-or-later
// What a participant sees of a world: pictures of materials, and how large it is.
#pragma once
#include "Host/Views/MaterialTexture.h"
#include "Io/Result.h"
#include "Lab/Study/Protocol.h"
#include <string>
#include <vector>

namespace physvib {

/// The pictures of that participant, or one line. M.
Result<std::vector<MaterialPicture>> materialPictures(const Protocol& protocol,
                                                      const std::string& participant);

/// Empty, or that a world is to be seen at a scale on a display whose width (metres; 0) nobody has set. Any
/// thread (allocates).
std::string displayScaleFault(const Protocol& protocol, double displayWidthMetres);

} // namespace physvib
