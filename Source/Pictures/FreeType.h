// SPDX-License-Identifier: MIT
// RAII wrapper of the FreeType library, and conversion to its units of 1/64 pixel.
#pragma once
#include <ft2build.h>
#include <stdexcept>
#include FT_FREETYPE_H

namespace physvib::picture {

/// One thread at a time.
class FreeType {
public:
    FreeType() {
        if (FT_Init_FreeType(&library_) != 0) throw std::runtime_error{"FreeType could not be started"};
    }
    ~FreeType() { FT_Done_FreeType(library_); }
    FreeType(const FreeType&) = delete;
    FreeType& operator=(const FreeType&) = delete;

    operator FT_Library() const noexcept { return library_; }

private:
    FT_Library library_ = nullptr;
};

} // namespace physvib::picture
