// SPDX-License-Identifier: GPL-3.0-or-later
// `physvib material --texture`: grains of a surface, in the words of a scene's material.
#pragma once
#include "Measure/TextureExtractor.h"
#include <string>

namespace physvib {

/// Of a recording, or of the toolkit's model that is nearest to how it was scraped; the code to leave with.
int tellTexture(const std::string& path, const Scrape& scrape);

} // namespace physvib
