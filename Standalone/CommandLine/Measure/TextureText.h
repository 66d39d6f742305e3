// SPDX-License-Identifier: GPL-3.0-or-later
// `physvib material --texture`: prints the surface grains as fields of a scene's material.
#pragma once
#include "Measure/TextureExtractor.h"
#include <string>

namespace physvib {

/// Uses a recording, or the texture model that is nearest to the scraping conditions. Returns an exit code.
int tellTexture(const std::string& path, const Scrape& scrape);

} // namespace physvib
