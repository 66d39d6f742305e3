// SPDX-License-Identifier: MIT
// Encodes images as PNG by libpng.
#include "Pictures/Image.h"
#include <png.h>
#include <stdexcept>

namespace physvib::picture {

std::string Image::png() const {
    png_image head{};
    head.version = PNG_IMAGE_VERSION;
    head.width = static_cast<png_uint_32>(width_);
    head.height = static_cast<png_uint_32>(height_);
    head.format = PNG_FORMAT_RGB;
    png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(head);
    std::string bytes(size, '\0');
    if (!png_image_write_to_memory(&head, bytes.data(), &size, 0, rgb_.data(), 0, nullptr))
        throw std::runtime_error{std::string{"no PNG could be made: "} + head.message};
    bytes.resize(size);
    return bytes;
}

} // namespace physvib::picture
