// SPDX-License-Identifier: MIT
// Converts text to outlines, with fonts that are installed on this machine.
#pragma once
#include "Pictures/Image.h"
#include <filesystem>
#include <memory>
#include <string_view>
#include <vector>

namespace physvib::picture {

/// The folders of this system that may contain fonts.
std::vector<std::filesystem::path> fontFolders();

/// A plain and a bold face. If no known font is installed, every width is 0. One thread at a time.
class Letters {
public:
    explicit Letters(const std::vector<std::filesystem::path>& folders = fontFolders());
    ~Letters();
    Letters(const Letters&) = delete;
    Letters& operator=(const Letters&) = delete;

    /// `height` is that of a line, from the highest to the lowest letter. In pixels.
    float width(std::string_view text, float height, bool bold) const;
    /// Outline of a line of text whose baseline begins at (0, 0).
    Path outline(std::string_view text, float height, bool bold) const;
    /// Distance from the top of a line to its baseline, in pixels.
    float ascent(float height, bool bold) const;
    bool empty() const noexcept; ///< no font was found

private:
    struct Fonts;
    std::unique_ptr<Fonts> fonts_;
};

} // namespace physvib::picture
