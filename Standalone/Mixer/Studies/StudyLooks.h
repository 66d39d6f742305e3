// SPDX-License-Identifier: GPL-3.0-or-later
// Appearance of a world for a participant: pictures of materials, and display scale.
#pragma once
#include "Host/Views/MaterialTexture.h"
#include "Io/Result.h"
#include "Lab/Study/Protocol.h"
#include <string>
#include <vector>

namespace physvib {

/// That participant's pictures, or an error line. Message thread.
Result<std::vector<MaterialPicture>> materialPictures(const Protocol& protocol,
                                                      const std::string& participant);

/// Empty, or an error if the protocol has a display scale but the display width (metres) is not set (0). Any
/// thread (allocates).
std::string displayScaleFault(const Protocol& protocol, double displayWidthMetres);

} // namespace physvib
